// What is wrong with a page as it stands: run in the browser by page.evaluate.

/** Sentences about text that is cut off, things outside of the screen, and controls on top of one another. */
export function layoutFaults() {
    const faults = [];
    const root = document.documentElement;
    if (root.scrollWidth > innerWidth + 1) faults.push(`the page is ${root.scrollWidth} pixels wide on a screen of ${innerWidth}`);
    const name = (element) => `<${element.tagName.toLowerCase()}> "${(element.textContent || element.getAttribute("aria-label") || "").trim().slice(0, 40)}"`;
    const isShown = (element) => element.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true });
    const texts = [...document.querySelectorAll("button:not(.knob), label, output, dt, dd, h1, h2, summary, p, nav a")].filter(isShown);
    for (const element of texts)
        if (element.scrollWidth > element.clientWidth + 2 && getComputedStyle(element).display !== "inline") faults.push(`${name(element)} is cut off`);
    const controls = [...document.querySelectorAll("#panel button, #panel input, #panel select, #panel summary, #panel label, #panel output")].filter(isShown);
    const boxes = controls.map((element) => element.getBoundingClientRect());
    for (let i = 0; i < controls.length; ++i)
        for (let k = i + 1; k < controls.length; ++k) {
            const [p, q] = [boxes[i], boxes[k]];
            const overlap = Math.min(p.right, q.right) - Math.max(p.left, q.left) > 2 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 2;
            const nested = controls[i].contains(controls[k]) || controls[k].contains(controls[i]);
            // A button that copies stands on the line of its summary.
            const isCopy = [controls[i], controls[k]].some((one) => one.classList.contains("copy"));
            if (overlap && !nested && !isCopy) faults.push(`${name(controls[i])} lies on ${name(controls[k])}`);
        }
    return faults;
}

/** All that the keyboard has to reach, as strings that name it. Groups of radio buttons count once. */
export function focusable() {
    window.nameOf ??= (element) => {
        window.numbers ??= new WeakMap();
        if (!window.numbers.has(element)) window.numbers.set(element, (window.nextNumber = (window.nextNumber ?? 0) + 1));
        return `${element.tagName.toLowerCase()} ${window.numbers.get(element)} "${(element.getAttribute("aria-label") ?? element.textContent ?? "").trim().slice(0, 30)}"`;
    };
    return [...document.querySelectorAll("a[href], button, input, select, textarea, summary, [tabindex='0']")]
        .filter((element) => !element.disabled && element.checkVisibility({ checkVisibilityCSS: true }) && element.type !== "file")
        .map(window.nameOf);
}
