// What a field says of one point, and how it is shown.

import type { Panel } from "../../panel/panel";
import type { Drawing, Numbers } from "../../stage/drawing";
import type { Handle } from "../../stage/pane";

export interface Sample {
    readonly distance: number;
    /** The direction in which the distance grows, of length 1. */
    readonly normal: Numbers;
    /** A point of the surface. */
    readonly closest: Numbers;
    /** The share of the lamp's light that arrives. */
    readonly light: number;
}

export function drawSample(drawing: Drawing, at: readonly number[], { normal, closest }: Sample): void {
    drawing.line([...at, ...Array.from(closest)], { color: "mark", width: 2.5, onTop: true });
    drawing.arrow(
        at,
        at.map((x, i) => x + 0.5 * (normal[i] ?? 0)),
        { color: "good", width: 2.5, onTop: true },
    );
    drawing.point(closest, { color: "mark", width: 2, onTop: true });
    drawing.point(at, { color: "text", width: 2.5, onTop: true });
}

export function showSample(panel: Panel, sample: Sample | undefined): void {
    panel.answer("distance", sample?.distance ?? "none");
    panel.answer("gradient", sample?.normal ?? "none");
    panel.answer("closest", sample?.closest ?? "none");
    panel.answer("light", sample?.light ?? "none");
}

/** A handle that moves a point of the state. */
export function pointHandle(id: string, label: string, at: number[], changed: () => void): Handle {
    return {
        id,
        label,
        at,
        move(to) {
            at.splice(0, at.length, ...to.map(Math.fround));
            changed();
        },
    };
}
export const probeHandle = (at: number[], changed: () => void): Handle => pointHandle("probe", "The point that is measured", at, changed);
export const lampHandle = (at: number[], changed: () => void): Handle => pointHandle("lamp", "The lamp", at, changed);
