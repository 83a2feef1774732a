// The panel beside the views: controls, answers, what they mean, and the code that asks.

export interface SliderOptions {
    readonly label: string;
    readonly min: number;
    readonly max: number | (() => number);
    readonly step?: number;
    /** Steps are even in the logarithm; `min` is above 0. */
    readonly logarithmic?: boolean;
    readonly unit?: string;
    /** Whether it is there at present; always if this is left out. */
    shown?(): boolean;
    get(): number;
    set(value: number): void;
}

/** In milliseconds. */
const refreshPeriod = 60;

let nextId = 0;

function element<K extends keyof HTMLElementTagNameMap>(name: K, className: string, text = ""): HTMLElementTagNameMap[K] {
    const result = document.createElement(name);
    if (className) result.className = className;
    if (text) result.textContent = text;
    return result;
}

/** A number to read: as many digits as make sense, and a minus of full width. */
export function readable(value: number): string {
    if (!Number.isFinite(value)) return String(value);
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(3) : value.toFixed(size >= 100 ? 2 : 4);
    return text.replace(/^-/, "\u2212");
}

export class Panel {
    private readonly controls = element("div", "controls");
    private readonly answers = element("dl", "answers");
    private readonly meaning = element("p", "meaning");
    private readonly code = element("div", "code");
    private readonly actions = element("div", "actions");
    private readonly refreshers: (() => void)[] = [];
    private readonly answerCells = new Map<string, HTMLElement>();
    private readonly pendingAnswers = new Map<HTMLElement, string>();
    private refreshing = 0;
    private refreshed = 0;

    constructor(
        private readonly root: HTMLElement,
        title: string,
        meaning: string,
        private readonly changed: () => void,
    ) {
        this.meaning.textContent = meaning;
        root.replaceChildren(element("h2", "", title), this.meaning, this.controls, this.answers, this.actions, this.code);
    }

    slider(options: SliderOptions): void {
        const { row, input, output } = this.row(options.label, element("input", ""), true);
        const max = (): number => (typeof options.max === "function" ? options.max() : options.max);
        const toSlider = (value: number): number => (options.logarithmic ? Math.log10(value) : value);
        input.type = "range";
        input.min = String(toSlider(options.min));
        input.max = String(toSlider(max()));
        input.step = String(options.step ?? (toSlider(max()) - toSlider(options.min)) / 200);
        input.addEventListener("input", () => {
            options.set(options.logarithmic ? 10 ** Number(input.value) : Number(input.value));
            this.changed();
        });
        this.refreshers.push(() => {
            row.hidden = !(options.shown?.() ?? true);
            const text = `${readable(options.get()).replace(/\.?0+$/, "")}${options.unit ?? ""}`;
            if (output.textContent !== text) output.textContent = text;
            input.max = String(toSlider(max()));
            input.value = String(toSlider(options.get()));
        });
    }

    toggle(label: string, get: () => boolean, set: (value: boolean) => void): void {
        const { input } = this.row(label, element("input", ""), false);
        input.type = "checkbox";
        input.addEventListener("change", () => {
            set(input.checked);
            this.changed();
        });
        this.refreshers.push(() => (input.checked = get()));
    }

    /** `choices`: what is stored, and what is read. */
    choice(label: string, choices: Readonly<Record<string, string>>, get: () => string, set: (value: string) => void): void {
        const { input } = this.row(label, element("select", ""), false);
        for (const [value, text] of Object.entries(choices)) {
            const option = element("option", "", text);
            option.value = value;
            input.append(option);
        }
        input.addEventListener("change", () => {
            set(input.value);
            this.changed();
        });
        this.refreshers.push(() => (input.value = get()));
    }

    button(label: string, press: () => void): HTMLButtonElement {
        const result = element("button", "", label);
        result.type = "button";
        result.addEventListener("click", press);
        this.actions.append(result);
        return result;
    }

    /** Any element of an exhibit, such as a chart, among the controls. */
    insert(child: HTMLElement): void {
        this.controls.append(child);
    }

    /** Shows a number, several, or text under a name, at its place from before if it has one. */
    answer(name: string, value: number | ArrayLike<number> | string | boolean): void {
        let cell = this.answerCells.get(name);
        if (!cell) {
            cell = element("dd", "");
            this.answers.append(element("dt", "", name), cell);
            this.answerCells.set(name, cell);
        }
        const text =
            typeof value === "string" ? value : typeof value === "number" ? readable(value) : typeof value === "boolean" ? (value ? "yes" : "no") : Array.from(value, readable).join("  ");
        this.pendingAnswers.set(cell, text);
    }

    setMeaning(text: string): void {
        if (this.meaning.textContent !== text) this.meaning.textContent = text;
    }

    /** Blocks of code, each with a name and a button that copies it. */
    setCode(blocks: Readonly<Record<string, string>>): void {
        for (const [name, text] of Object.entries(blocks)) {
            let block = this.code.querySelector<HTMLElement>(`[data-name="${name}"]`);
            if (!block) {
                block = this.makeCode(name);
                this.code.append(block);
            }
            const pre = block.querySelector("code");
            if (pre && pre.textContent !== text) pre.textContent = text;
        }
    }

    /** Controls and answers show the present state, soon: text that changes in every frame costs more than a view, and is not read. */
    refresh(): void {
        this.refreshing ||= window.setTimeout(() => this.refreshNow(), Math.max(0, this.refreshed + refreshPeriod - performance.now()));
    }
    private refreshNow(): void {
        this.refreshing = 0;
        this.refreshed = performance.now();
        for (const refresh of this.refreshers) refresh();
        for (const [cell, text] of this.pendingAnswers) if (cell.textContent !== text) cell.textContent = text;
        this.pendingAnswers.clear();
    }
    dispose(): void {
        clearTimeout(this.refreshing);
        this.root.replaceChildren();
    }

    private row<E extends HTMLInputElement | HTMLSelectElement>(label: string, input: E, hasOutput: boolean): { row: HTMLElement; input: E; output: HTMLOutputElement } {
        const row = element("div", "row");
        const name = element("label", "", label);
        const output = element("output", "");
        input.id = `control${++nextId}`;
        name.htmlFor = input.id;
        row.append(name, input);
        if (hasOutput) {
            output.htmlFor.add(input.id);
            row.append(output);
        }
        this.controls.append(row);
        return { row, input, output };
    }
    private makeCode(name: string): HTMLElement {
        const block = element("details", "");
        block.dataset["name"] = name;
        block.open = name === "C++";
        const copy = element("button", "copy", "Copy");
        copy.type = "button";
        const pre = element("pre", "");
        pre.tabIndex = 0;
        pre.append(element("code", ""));
        copy.addEventListener("click", () => {
            void navigator.clipboard.writeText(pre.textContent ?? "").then(() => {
                copy.textContent = "Copied";
                setTimeout(() => (copy.textContent = "Copy"), 1500);
            });
        });
        block.append(element("summary", "", name), copy, pre);
        return block;
    }
}
