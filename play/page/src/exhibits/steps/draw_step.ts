// One step of an engine: in the world, in the Minkowski difference, and in words.

import { readable } from "../../panel/panel";
import type { Drawing, Style } from "../../stage/drawing";
import { acrossOf, drawPlane } from "../../stage/plane";
import type { AxisStep, Step } from "../../trace";

const sum = (a: readonly number[], b: readonly number[], factor = 1): number[] => a.map((x, i) => x + factor * (b[i] ?? 0));
const dot = (a: readonly number[], b: readonly number[]): number => a.reduce((total, x, i) => total + x * (b[i] ?? 0), 0);
const scaled = (a: readonly number[], factor: number): number[] => a.map((x) => factor * x);

/** What the step says. */
export function stepText(step: Step): string {
    switch (step.kind) {
        case "gjk": {
            const simplex = `GJK: a simplex of ${step.points.length} ${step.points.length === 1 ? "point" : "points"}`;
            const isInside = step.points.length > step.closest.length;
            return isInside ? `${simplex} that holds the origin.` : `${simplex}, ${readable(Math.hypot(...step.closest))} from the origin.`;
        }
        case "penetration":
            return (
                `EPA: the face nearest to the origin is ${readable(step.distance)} away, ` +
                `and A − B reaches ${readable(step.extent)} along its normal.`
            );
        case "axis": {
            const gap = step.min_b - step.max_a;
            return `SAT: on this axis the intervals ${gap > 0 ? `are ${readable(gap)} apart` : `overlap by ${readable(-gap)}`}.`;
        }
        case "clip":
            return "Clipping: what lies in front of the border is cut away.";
        case "sweep": {
            const gap = readable(Math.abs(step.distance) < 1e-6 ? 0 : step.distance);
            return `Advance: the shapes are ${gap} apart here, and nothing touches before the ray reaches the plane.`;
        }
    }
}

/** `middle`: between the shapes. */
export function drawInWorld(drawing: Drawing, steps: readonly Step[], middle: readonly number[]): void {
    const step = steps.at(-1);
    if (step?.kind === "axis") drawIntervals(drawing, step, middle);
    if (step?.kind !== "clip") return;
    // In space the trace has the face that each cut adds.
    if (drawing.dimension === 3)
        for (const before of steps.slice(0, -1))
            if (before.kind === "clip") drawPoints(drawing, before.points, { color: "good", fill: 0.15, alpha: 0.6 });
    drawPlane(drawing, sum(middle, step.normal, step.offset - dot(step.normal, middle)), step.normal, 1.5, "mark");
    drawPoints(drawing, step.points, { color: "good", fill: 0.45, width: 3, onTop: true });
}

/** The projections of A and B onto the axis, beside the shapes. */
function drawIntervals(drawing: Drawing, { axis, min_a, max_a, min_b, max_b }: AxisStep, middle: readonly number[]): void {
    const aside = acrossOf(axis)[0] ?? [];
    const place = (along: number, off: number): number[] => sum(sum(middle, axis, along - dot(axis, middle)), aside, off);
    const [low, high] = [Math.min(min_a, min_b), Math.max(max_a, max_b)];
    drawing.line([...place(low - 0.4, 1.7), ...place(high + 0.4, 1.7)], { color: "soft", dashed: true });
    drawing.line([...place(min_a, 1.7), ...place(max_a, 1.7)], { color: "a", width: 5, onTop: true });
    drawing.line([...place(min_b, 1.85), ...place(max_b, 1.85)], { color: "b", width: 5, onTop: true });
    const color = min_b > max_a ? "good" : "bad";
    for (const end of [max_a, min_b]) drawing.line([...place(end, -1.5), ...place(end, 2)], { color, dashed: true });
}

export function drawInDifference(drawing: Drawing, steps: readonly Step[]): void {
    const step = steps.at(-1);
    if (!step) return;
    const origin = new Array<number>(drawing.dimension).fill(0);
    const style: Style = { color: "mark", width: 3, fill: 0.25, onTop: true };
    const earlier = (kind: Step["kind"]): Step[] => steps.slice(0, -1).filter((one) => one.kind === kind);
    switch (step.kind) {
        case "gjk":
            for (const one of earlier("gjk").slice(-1))
                if (one.kind === "gjk") drawPoints(drawing, one.points, { color: "soft", dashed: true });
            drawPoints(drawing, step.points, style);
            drawing.line([...origin, ...step.closest], { color: "good", width: 2, dashed: true, onTop: true });
            drawing.point(step.closest, { color: "good", width: 3, onTop: true });
            break;
        case "penetration":
            for (const one of earlier("penetration")) if (one.kind === "penetration") drawPoints(drawing, one.points, { color: "soft" });
            drawPoints(drawing, step.points, style);
            drawing.arrow(origin, scaled(step.normal, step.distance), { color: "bad", width: 3, onTop: true });
            drawPlane(drawing, scaled(step.normal, step.extent), step.normal, 1, "good");
            break;
        case "axis":
            for (const end of [step.min_a - step.max_b, step.max_a - step.min_b])
                drawPlane(drawing, scaled(step.axis, end), step.axis, 2, "mark");
            drawing.line([...scaled(step.axis, step.min_a - step.max_b), ...scaled(step.axis, step.max_a - step.min_b)], style);
            break;
        case "sweep":
            for (const one of earlier("sweep")) if (one.kind === "sweep") drawing.point(one.position, { color: "soft", width: 2 });
            drawing.line([...origin, ...step.position], style);
            drawing.point(step.position, style);
            drawing.line([...step.position, ...sum(step.position, step.normal, -step.distance)], { color: "good", dashed: true });
            drawPlane(drawing, sum(step.position, step.normal, -step.distance), step.normal, 1.5, "good");
            break;
        case "clip":
    }
}

/** A point, a line, a flat polygon, or the edges of a tetrahedron. */
function drawPoints(drawing: Drawing, points: readonly number[][], style: Style): void {
    const isTetrahedron = drawing.dimension === 3 && points.length === 4 && !isFlat(points);
    if (points.length === 2) drawing.line(points.flat(), style);
    else if (isTetrahedron)
        drawing.segments(
            points.flatMap((point, i) => points.slice(i + 1).flatMap((other) => [...point, ...other])),
            style,
        );
    else if (points.length > 2) drawing.polygon(points.flat(), style);
    for (const point of points) drawing.point(point, { color: style.color, alpha: style.alpha ?? 1, onTop: style.onTop ?? false });
}
function isFlat(points: readonly number[][]): boolean {
    const [u, v, w] = [1, 2, 3].map((i) => sum(points[i] ?? [], points[0] ?? [], -1)) as [number[], number[], number[]];
    const across = [0, 1, 2].map((i) => (u[(i + 1) % 3] ?? 0) * (v[(i + 2) % 3] ?? 0) - (u[(i + 2) % 3] ?? 0) * (v[(i + 1) % 3] ?? 0));
    return Math.abs(dot(across, w)) < 1e-4 * Math.hypot(...across);
}
