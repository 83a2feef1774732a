// The break-even curve: up to which cost a test should come first, by its pass rate.

import type { Abut } from "../../library";
import { floats } from "../../library";
import type { Drawing } from "../../stage/drawing";

/** A test against the one after it: its pass rate, and its cost in units of the other's. */
export interface Place {
    readonly name: string;
    readonly pass: number;
    readonly ratio: number;
    readonly color: "a" | "b" | "mark" | "good";
}

/** The chart is so wide, and so high; higher costs are drawn at its upper border. */
export const chartWidth = 2;
export const chartHeight = 1.6;

export function chartPoint(pass: number, ratio: number): [number, number] {
    return [chartWidth * pass, Math.min(ratio, chartHeight)];
}

/** `isRedundant`: the curve of worth_pretesting, else that of best_order against a test with this pass rate. */
export function drawBreakEven(
    abut: Abut,
    drawing: Drawing,
    nextPass: number,
    isRedundant: boolean,
    places: readonly Place[],
    pixel: number,
): void {
    const curve = floats(abut.play_break_even(1, nextPass, isRedundant));
    const area = [0, 0];
    const border: number[] = [];
    for (let i = 0; i + 1 < curve.length; i += 2) {
        const point = chartPoint(curve[i] ?? 0, curve[i + 1] ?? 0);
        area.push(...point);
        if (point[1] < chartHeight) border.push(...point);
    }
    drawing.polygon(area, { color: "good", width: 0.5, fill: 0.15 });
    drawing.line(border, { color: "good", width: 2.5 });
    drawing.line([0, chartHeight, 0, 0, chartWidth, 0], { color: "text", width: 1.5 });
    drawing.line([0, 1, chartWidth, 1], { color: "soft", width: 1, dashed: true });
    const below = (pixels: number): number => -pixels * pixel;
    drawing.text([0, below(14)], "0 %", { color: "soft" });
    drawing.text([chartWidth, below(14)], "100 %", { color: "soft" });
    drawing.text([chartWidth / 2, below(14)], "inputs that pass", { color: "soft" });
    drawing.text([chartWidth / 2, chartHeight + 0.25], "cost, as a multiple of the next test's", { color: "soft" });
    drawing.text([chartWidth * 0.15, 0.5], "pays first", { color: "good" });
    drawing.text([chartWidth * 0.85, 0.6], "pays later", { color: "soft" });
    places.forEach(({ name, pass, ratio, color }, i) => {
        const [x, y] = chartPoint(pass, ratio);
        // Names on alternating sides, as points may be close to each other.
        const side = (i % 2 === 0 ? 1 : -1) * (14 + 4 * name.length) * pixel;
        drawing.point([x, y], { color, width: 4, onTop: true });
        drawing.text([x + side, y + 8 * pixel], name, { color });
    });
}
