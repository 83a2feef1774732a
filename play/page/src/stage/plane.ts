// A piece of a plane, or of a line in 2D, across its normal.

import type { ColorName, Drawing } from "./drawing";

/** `half`: from the middle to an end. In space it is a square. */
export function drawPlane(drawing: Drawing, middle: readonly number[], normal: readonly number[], half: number, color: ColorName): void {
    const sides = acrossOf(normal);
    const corner = (signs: readonly number[]): number[] =>
        middle.map((x, i) => x + half * signs.reduce((sum, sign, k) => sum + sign * (sides[k]?.[i] ?? 0), 0));
    if (drawing.dimension === 2) drawing.line([...corner([-1]), ...corner([1])], { color, dashed: true });
    else drawing.polygon([...corner([-1, -1]), ...corner([1, -1]), ...corner([1, 1]), ...corner([-1, 1])], { color, fill: 0.15 });
}

/** Unit vectors across a unit vector. */
export function acrossOf(normal: readonly number[]): number[][] {
    const [x = 0, y = 0, z = 0] = normal;
    if (normal.length === 2) return [[-y, x]];
    const first = Math.abs(x) > 0.7 ? [-y, x, 0] : [0, -z, y];
    const length = Math.hypot(...first);
    const [u = 0, v = 0, w = 0] = first.map((c) => c / length);
    return [
        [u, v, w],
        [y * w - z * v, z * u - x * w, x * v - y * u],
    ];
}
