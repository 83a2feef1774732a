// Draws thousands of boxes, and what a structure makes of them.

import type { ColorName, Palette } from "../../stage/drawing";
import { pixelColor, type PixelColor, type Pixels } from "../../stage/pixels";

/** Boxes as the library writes them: the lower corner and the upper one of each. */
export interface Boxes {
    readonly corners: Float32Array;
    /** Two indices each. */
    readonly pairs: Uint32Array;
}

/** A box by its index. */
function cornersOf(corners: Float32Array, i: number): [number, number, number, number] {
    return [corners[4 * i] ?? 0, corners[4 * i + 1] ?? 0, corners[4 * i + 2] ?? 0, corners[4 * i + 3] ?? 0];
}

/** All boxes, those of a pair in another colour, and a line between the centers of each pair. */
export function drawBoxes(pixels: Pixels, palette: Palette, { corners, pairs }: Boxes): void {
    const isPaired = new Uint8Array(corners.length / 4);
    for (const item of pairs) isPaired[item] = 1;
    const colors = (["a", "mark"] as const).map(
        (name) => [pixelColor(palette.rgb(name), 0.25), pixelColor(palette.rgb(name), 0.8)] as const,
    );
    for (let i = 0; i < isPaired.length; ++i) pixels.fill(...cornersOf(corners, i), colors[isPaired[i] ?? 0]?.[0] ?? 0);
    for (let i = 0; i < isPaired.length; ++i) pixels.border(...cornersOf(corners, i), colors[isPaired[i] ?? 0]?.[1] ?? 0);
    const link = pixelColor(palette.rgb("mark"), 1);
    for (let i = 0; i + 1 < pairs.length; i += 2) {
        const a = cornersOf(corners, pairs[i] ?? 0);
        const b = cornersOf(corners, pairs[i + 1] ?? 0);
        pixels.line((a[0] + a[2]) / 2, (a[1] + a[3]) / 2, (b[0] + b[2]) / 2, (b[1] + b[3]) / 2, link);
    }
}

/** The borders of some of the boxes. */
export function drawBorders(pixels: Pixels, corners: Float32Array, items: Uint32Array, color: PixelColor, width: number): void {
    for (const item of items) pixels.border(...cornersOf(corners, item), color, width);
}

/** The inner lines of a structure, up to a level: level, and both ends of each. */
export function drawLines(pixels: Pixels, palette: Palette, lines: Float32Array, levels: number): void {
    const names: readonly ColorName[] = ["text", "good", "b", "accent", "soft"];
    const colors = names.map((name) => pixelColor(palette.rgb(name), 0.75));
    // The first levels lie on top.
    for (let level = Math.min(levels, 64) - 1; level >= 0; --level)
        for (let i = 0; i + 4 < lines.length; i += 5)
            if (lines[i] === level)
                pixels.line(
                    lines[i + 1] ?? 0,
                    lines[i + 2] ?? 0,
                    lines[i + 3] ?? 0,
                    lines[i + 4] ?? 0,
                    colors[Math.min(level, colors.length - 1)] ?? 0,
                    level < 2 ? 2 : 1,
                );
}

/** A ring around each box, as wide as it may move before anything about it can change. It fades until then. */
export function drawRings(pixels: Pixels, palette: Palette, corners: Float32Array, times: Float32Array, speeds: Float32Array): void {
    let longest = 0;
    for (const time of times) if (time < Infinity) longest = Math.max(longest, time);
    const rgb = palette.rgb("good");
    for (let i = 0; i < times.length; ++i) {
        const time = times[i] ?? 0;
        const travel = time * (speeds[i] ?? 0);
        // At rest a box has no ring, and a fast one is tested in each update.
        if (!(travel > 0 && time < Infinity)) continue;
        const [minX, minY, maxX, maxY] = cornersOf(corners, i);
        pixels.ring(
            (minX + maxX) / 2,
            (minY + maxY) / 2,
            0.5 * Math.hypot(maxX - minX, maxY - minY) + travel,
            pixelColor(rgb, 0.15 + (0.85 * time) / longest),
        );
    }
}
