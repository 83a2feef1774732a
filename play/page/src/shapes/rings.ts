// An outline with holes, whose points can be dragged.

import type { Drawing, Style } from "../stage/drawing";
import type { Handle } from "../stage/pane";
import { cppPoints } from "./source_text";

/** Rings of points, x y x y ...; the first is the outline and the others are holes. */
export type Rings = number[][];

const circle = (count: number, radius: (i: number) => number, x = 0, y = 0): number[] =>
    Array.from({ length: count }, (_, i) => {
        const angle = (2 * Math.PI * i) / count;
        return [Math.fround(x + radius(i) * Math.cos(angle)), Math.fround(y + radius(i) * Math.sin(angle))];
    }).flat();

export const ringChoices: Readonly<Record<string, { readonly name: string; readonly rings: Rings }>> = {
    plate: {
        name: "plate with holes",
        rings: [
            [-2.4, -1.6, 2.4, -1.6, 2.4, 0.2, 1.5, 0.6, 2.2, 1.6, 0.4, 1.6, 0, 0.9, -0.5, 1.6, -2.4, 1.6, -1.8, 0.1],
            circle(5, () => 0.5, -1, -0.6),
            [0.5, -1.1, 1.8, -0.9, 1, -0.6, 1.3, 0, 0.4, -0.2],
        ],
    },
    star: { name: "star", rings: [circle(14, (i) => (i % 2 === 0 ? 2.1 : 0.9))] },
    gear: { name: "gear with a bore", rings: [circle(40, (i) => (i % 4 < 2 ? 2.1 : 1.6)), circle(12, () => 0.6)] },
    comb: {
        name: "comb",
        rings: [
            [
                -2.4, -1.6, 2.4, -1.6, 2.4, 1.4, 1.8, 1.4, 1.8, -0.8, 0.9, -0.8, 0.9, 1.4, 0.3, 1.4, 0.3, -0.8, -0.6, -0.8, -0.6, 1.4, -1.2,
                1.4, -1.2, -0.8, -1.8, -0.8, -1.8, 1.4, -2.4, 1.4,
            ],
        ],
    },
};

/** A handle for each point; `moved` follows a change. */
export function ringHandles(rings: Rings, moved: () => void): Handle[] {
    return rings.flatMap((ring, k) =>
        Array.from({ length: ring.length / 2 }, (_, i) => ({
            id: `ring${k}point${i}`,
            label: `Point ${i + 1} of ${k === 0 ? "the outline" : `hole ${k}`}`,
            at: ring.slice(2 * i, 2 * i + 2),
            move: (to: number[]) => {
                ring.splice(2 * i, 2, Math.fround(to[0] ?? 0), Math.fround(to[1] ?? 0));
                moved();
            },
        })),
    );
}

/** Adds the middle of the longest edge of the outline to it. */
export function addPoint(rings: Rings): void {
    const [ring = []] = rings;
    const count = ring.length / 2;
    const point = (i: number): [number, number] => [ring[2 * (i % count)] ?? 0, ring[2 * (i % count) + 1] ?? 0];
    const length = (i: number): number => Math.hypot(point(i + 1)[0] - point(i)[0], point(i + 1)[1] - point(i)[1]);
    const longest = Array.from({ length: count }, (_, i) => i).reduce((best, i) => (length(i) > length(best) ? i : best), 0);
    const middle = point(longest).map((x, axis) => Math.fround((x + (point(longest + 1)[axis] ?? 0)) / 2));
    ring.splice(2 * longest + 2, 0, ...middle);
}

export function drawRings(drawing: Drawing, rings: Rings, style: Style): void {
    for (const ring of rings) drawing.line([...ring, ...ring.slice(0, 2)], style);
}

/** Two lines of C++: `outline` and `holes`. */
export function cppRings([outline = [], ...holes]: Rings): string[] {
    return [
        `const auto outline = ${cppPoints(outline, 2)};`,
        `const std::vector<std::vector<abut::Vec2>> holes{${holes.map((hole) => cppPoints(hole, 2)).join(", ")}};`,
    ];
}
