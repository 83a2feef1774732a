// The strip of crossed triangles in the plane, as the library unfolds it.

import type { Drawing } from "../../stage/drawing";

export interface Strip {
    readonly triangles: readonly { readonly triangle: number; readonly corners: readonly (readonly number[])[] }[];
    readonly borders: readonly (readonly number[])[];
    readonly line: readonly (readonly number[])[];
    readonly space: readonly (readonly number[])[];
}

export interface Bounds {
    readonly min: readonly number[];
    readonly max: readonly number[];
}

/** A strip with the weights of its first place, which stand so far outside the corners. `frameSize`: the length of the walker's arrows;
 * 0 for none. */
export function drawStrip(drawing: Drawing, strip: Strip, weights: readonly number[], outside: number, frameSize: number): void {
    strip.triangles.forEach(({ corners }, i) =>
        drawing.polygon(corners.flat(), { color: i === 0 ? "good" : "accent", fill: i === 0 ? 0.3 : 0.14, width: 1 }),
    );
    for (let i = 0; i + 1 < strip.borders.length; i += 2)
        drawing.line([...(strip.borders[i] ?? []), ...(strip.borders[i + 1] ?? [])], { color: "text", width: 3 });
    const [start = [0, 0]] = strip.line;
    const end = strip.line.at(-1) ?? start;
    const first = strip.triangles[0]?.corners ?? [];
    for (const corner of first) drawing.line([...start, ...corner], { color: "good", dashed: true, width: 1 });
    drawing.line(strip.line.flat(), { color: "mark", width: 3 });
    if (frameSize > 0)
        for (const [x = 0, y = 0] of [start, end]) {
            drawing.arrow([x, y], [x, y + frameSize], { color: "a", width: 3 });
            drawing.arrow([x, y], [x - frameSize, y], { color: "b", width: 3 });
        }
    const middle = [0, 1].map((axis) => first.reduce((sum, corner) => sum + (corner[axis] ?? 0) / 3, 0));
    first.forEach((corner, i) => {
        const out = corner.map((x, axis) => x - (middle[axis] ?? 0));
        drawing.text(
            corner.map((x, axis) => x + (outside * (out[axis] ?? 0)) / Math.hypot(...out)),
            (weights[i] ?? 0).toFixed(2),
            { color: "good" },
        );
    });
    drawing.point(start, { color: "mark", width: 4 });
    drawing.point(end, { color: "mark", width: 4 });
}

/** The box around the line of a strip, with some distance. */
export function boxOf(strip: Strip): Bounds {
    const points = strip.line.length > 0 ? strip.line : [[0, 0]];
    const [low, high] = [
        [0, 1].map((axis) => Math.min(...points.map((point) => point[axis] ?? 0))),
        [0, 1].map((axis) => Math.max(...points.map((point) => point[axis] ?? 0))),
    ] as const;
    const border = 1 + 0.08 * Math.max(...high.map((x, axis) => x - (low[axis] ?? 0)));
    return { min: low.map((x) => x - border), max: high.map((x) => x + border) };
}

/** Whether a box holds another one that is not much smaller: the larger one has at most so many times its size. */
export function holds(outer: Bounds, inner: Bounds, times: number): boolean {
    const size = ({ min, max }: Bounds): number => Math.max(...max.map((x, axis) => x - (min[axis] ?? 0)));
    return (
        inner.min.every((x, axis) => x >= (outer.min[axis] ?? 0)) &&
        inner.max.every((x, axis) => x <= (outer.max[axis] ?? 0)) &&
        size(outer) <= times * size(inner)
    );
}
