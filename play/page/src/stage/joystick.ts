// A joystick over a pane: dragged by mouse or touch, or pressed by the arrow keys or W, A, S and D.

const directions: Readonly<Record<string, readonly [number, number]>> = {
    ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
    KeyA: [-1, 0], KeyD: [1, 0], KeyW: [0, 1], KeyS: [0, -1],
};

export class Joystick {
    private readonly button = document.createElement("button");
    private readonly stick = document.createElement("span");
    private readonly pressed = new Set<string>();
    private readonly end = new AbortController();
    private dragged: readonly [number, number] = [0, 0];

    /** `changed` is called when it leaves its center. The keys also work while nothing on the page has the focus. */
    constructor(parent: HTMLElement, label: string, private readonly changed: () => void) {
        this.button.type = "button";
        this.button.className = "joystick";
        this.button.title = label;
        this.button.setAttribute("aria-label", label);
        this.button.append(this.stick);
        parent.append(this.button);
        const options = { signal: this.end.signal };
        this.button.addEventListener("pointerdown", (event) => this.down(event), options);
        this.button.addEventListener("pointermove", (event) => this.move(event), options);
        for (const name of ["pointerup", "pointercancel"] as const) this.button.addEventListener(name, () => this.drag([0, 0]), options);
        // After a press on the pane the keys are its own, unless a handle has them.
        parent.addEventListener("pointerdown", () => parent.contains(document.activeElement) || this.button.focus({ preventScroll: true }), options);
        addEventListener("keydown", (event) => this.key(event, true), options);
        addEventListener("keyup", (event) => this.key(event, false), options);
        addEventListener("blur", () => this.pressed.clear(), options);
    }

    /** To the right and up, each from -1 to 1. */
    get direction(): readonly [number, number] {
        let [right, up] = this.dragged;
        for (const key of this.pressed) {
            const along = directions[key] ?? [0, 0];
            right += along[0];
            up += along[1];
        }
        return [Math.min(Math.max(right, -1), 1), Math.min(Math.max(up, -1), 1)];
    }
    get isActive(): boolean {
        return this.direction.some((part) => part !== 0);
    }
    dispose(): void {
        this.end.abort();
        this.button.remove();
    }

    private down(event: PointerEvent): void {
        // The pane below must not take the pointer.
        event.stopPropagation();
        this.button.setPointerCapture(event.pointerId);
        this.move(event);
    }
    private move(event: PointerEvent): void {
        if (!this.button.hasPointerCapture(event.pointerId)) return;
        event.stopPropagation();
        const frame = this.button.getBoundingClientRect();
        const right = (event.clientX - frame.left) / (frame.width / 2) - 1;
        const up = 1 - (event.clientY - frame.top) / (frame.height / 2);
        const length = Math.max(Math.hypot(right, up), 1);
        this.drag([right / length, up / length]);
    }
    private drag(direction: readonly [number, number]): void {
        this.dragged = direction;
        this.show();
        this.changed();
    }
    private key(event: KeyboardEvent, isDown: boolean): void {
        if (!(event.code in directions)) return;
        const hasFocus = document.activeElement === this.button || document.activeElement === document.body;
        if (!isDown) this.pressed.delete(event.code);
        else if (!hasFocus || event.ctrlKey || event.altKey || event.metaKey) return;
        else {
            this.pressed.add(event.code);
            event.preventDefault();
        }
        this.show();
        this.changed();
    }
    private show(): void {
        const [right, up] = this.direction;
        this.stick.style.transform = `translate(${22 * right}px, ${-22 * up}px)`;
    }
}
