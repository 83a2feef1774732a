// A picture of values on a grid, spread over a box of the plane.

import type { Numbers } from "./drawing";

/** Points in rows from the upper left corner of a box to the lower right one. */
export interface Grid {
    readonly columns: number;
    readonly rows: number;
    readonly min: readonly number[];
    readonly max: readonly number[];
    readonly points: Float32Array;
}

/** The middles of cells with a side of about `spacing`. */
export function gridOf({ min, max }: { min: readonly number[]; max: readonly number[] }, spacing: number): Grid {
    const [left = 0, low = 0] = min;
    const [right = 1, high = 1] = max;
    const columns = Math.max(Math.round((right - left) / spacing), 1);
    const rows = Math.max(Math.round((high - low) / spacing), 1);
    const points = new Float32Array(2 * columns * rows);
    for (let row = 0, i = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column) {
            points[i++] = left + ((column + 0.5) * (right - left)) / columns;
            points[i++] = high - ((row + 0.5) * (high - low)) / rows;
        }
    return { columns, rows, min, max, points };
}

export class Raster {
    private readonly canvas = document.createElement("canvas");
    private grid: Grid | undefined;

    /** `colorOf` gives a color, red, green and blue from 0 to 1, and `opacityOf` its opacity, for each point of the grid. */
    paint(grid: Grid, colorOf: (index: number) => readonly number[], opacityOf: (index: number) => number): void {
        this.grid = grid;
        this.canvas.width = grid.columns;
        this.canvas.height = grid.rows;
        const image = new ImageData(grid.columns, grid.rows);
        for (let i = 0; i < grid.columns * grid.rows; ++i) {
            const color = colorOf(i);
            for (let k = 0; k < 3; ++k) image.data[4 * i + k] = 255 * (color[k] ?? 0);
            image.data[4 * i + 3] = 255 * opacityOf(i);
        }
        this.canvas.getContext("2d")?.putImageData(image, 0, 0);
    }
    /** As an underlay of a pane. */
    show(pen: CanvasRenderingContext2D, place: (at: Numbers) => [number, number]): void {
        if (!this.grid) return;
        const { min, max } = this.grid;
        const [left, bottom] = place(min);
        const [right, top] = place(max);
        pen.imageSmoothingEnabled = true;
        pen.drawImage(this.canvas, left, top, right - left, bottom - top);
    }
}
