// The picture of the scene with its buttons and keys, and below it the timeline of what moves.

import { el } from "./elements";
import type { Finding, Report, View } from "./report";
import { Timeline } from "./timeline";
import { View2 } from "./view2";
import { View3 } from "./view3";

export class ScenePane {
    /** The picture, and the timeline of an animated scene. */
    readonly elements: readonly HTMLElement[];
    private readonly view: View | undefined;
    private readonly timeline: Timeline | undefined;
    private finding: Finding | undefined;

    constructor(report: Report, onFinding: (finding: Finding) => void) {
        this.view = viewOf(report);
        const picture = el("div", { class: "view", role: "group", "aria-label": "View of the finding" });
        if (this.view) picture.append(this.view.element, this.buttons(this.view));
        else picture.append(el("p", { class: "fine" }, "This browser has no WebGL, so there is no picture."));
        if (this.view) takeKeys(this.view);
        if (report.samples.length > 1) this.timeline = new Timeline(report, (seconds) => this.view?.setTime(seconds), onFinding);
        this.elements = this.timeline ? [picture, this.timeline.element] : [picture];
    }

    /** Shows a finding, or the whole scene. */
    show(finding: Finding | undefined): void {
        this.finding = finding;
        this.view?.show(finding);
        if (finding) this.timeline?.show(finding);
    }
    dispose(): void {
        this.timeline?.stop();
        this.view?.dispose();
    }

    private buttons(view: View): HTMLElement {
        const buttons = el("div", { class: "buttons" });
        const button = (text: string, name: string, act: () => void): void => {
            const element = el("button", { type: "button", "aria-label": name, title: name }, text);
            element.addEventListener("click", act);
            buttons.append(element);
        };
        button("+", "Zoom in", () => view.zoom(1.25));
        button("\u2212", "Zoom out", () => view.zoom(0.8));
        button("\u2302", "Whole scene", () => view.show(undefined));
        button("\u25ce", "Back to the finding", () => view.show(this.finding));
        return buttons;
    }
}

function viewOf(report: Report): View | undefined {
    try {
        return report.dimension === 3 ? new View3(report) : new View2(report);
    } catch {
        return undefined;
    }
}

function takeKeys(view: View): void {
    const canvas = view.element.querySelector("canvas");
    canvas?.setAttribute("tabindex", "0");
    canvas?.setAttribute("role", "img");
    canvas?.setAttribute("aria-label", "The scene; arrow keys turn it, + and - zoom");
    const turns: Readonly<Record<string, readonly [number, number]>> = {
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        ArrowUp: [0, 1],
        ArrowDown: [0, -1],
    };
    canvas?.addEventListener("keydown", (event) => {
        const turn = turns[event.key];
        if (turn) view.turn(...turn);
        else if (event.key === "+" || event.key === "=") view.zoom(1.25);
        else if (event.key === "-") view.zoom(0.8);
        else return;
        event.preventDefault();
    });
}
