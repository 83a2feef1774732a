// How far a check has come, with a button that ends it.

import { el } from "../../../../viewer/src/elements";
import type { Progress } from "./messages";

export class ProgressBar {
    private readonly bar = el("progress", { "aria-label": "Progress of the check" });
    private readonly text = el("p", { class: "note", role: "status" });
    private readonly stop = el("button", { type: "button" }, "Stop");
    readonly element = el("div", { class: "progress" }, this.bar, this.stop);
    readonly note = this.text;

    constructor(onStop: () => void) {
        this.stop.addEventListener("click", onStop);
        this.element.hidden = true;
    }

    start(scene: string): void {
        this.text.classList.remove("failed");
        this.text.textContent = `Checking ${scene} ...`;
        this.bar.removeAttribute("value");
        this.element.hidden = false;
    }
    show({ what, done, all }: Progress): void {
        this.bar.value = done / all;
        this.text.textContent = `${what[0]?.toUpperCase() ?? ""}${what.slice(1)} ${done} of ${all} ...`;
    }
    /** With a sentence if it failed. */
    end(problem = ""): void {
        this.element.hidden = true;
        this.text.classList.toggle("failed", problem !== "");
        this.text.textContent = problem;
    }
}
