// The cost of an order as an area: each test is a step as wide as its time, and as high as the share of inputs that reach it.

import type { Abut } from "../../library";
import type { Drawing } from "../../stage/drawing";

const colors = ["a", "b", "mark"] as const;

export const rowHeight = 1.35;

/** `tests` are times and pass rates; `width` is that of a chart of all times. `top` is the upper border of the row. */
export function drawSteps(
    abut: Abut,
    drawing: Drawing,
    title: string,
    names: readonly string[],
    tests: readonly number[],
    order: readonly number[],
    width: number,
    top: number,
    pixel: number,
): void {
    const whole = Math.max(
        tests.reduce((sum, number, i) => sum + (i % 2 === 0 ? number : 0), 0),
        1e-9,
    );
    const bottom = top - 1;
    drawing.line([0, bottom, width, bottom], { color: "text", width: 1.5 });
    drawing.text([width / 2, top + 12 * pixel], title, { color: "text" });
    let x = 0;
    let before = 0;
    order.forEach((test, i) => {
        const time = tests[2 * test] ?? 0;
        const cost = abut.play_expected_cost(tests, order.slice(0, i + 1));
        const height = time > 0 ? (cost - before) / time : 0;
        const next = x + (width * time) / whole;
        const color = colors[test] ?? "a";
        drawing.polygon([x, bottom, next, bottom, next, bottom + height, x, bottom + height], { color, fill: 0.4, width: 1.5 });
        if (next - x > 16 * pixel) drawing.text([(x + next) / 2, bottom + Math.max(height / 2, 9 * pixel)], names[test] ?? "", { color });
        x = next;
        before = cost;
    });
}
