// Surfaces to walk on: triangles in space, y up.

type Point = readonly [number, number, number];

export interface Surface {
    readonly name: string;
    readonly points: readonly Point[];
    /** Three indices each. */
    readonly triangles: readonly number[];
    /** Where a walker starts, and where it looks. */
    readonly start: Point;
    readonly ahead: Point;
    readonly goal: Point;
    /** Half of its height as it is first shown, the angle by which it is seen more from above, and the length of a readable step. */
    readonly reach: number;
    readonly pitch: number;
    readonly step: number;
}

interface Triangles {
    points: Point[];
    triangles: number[];
}

/** Squares of two triangles each, with holes. `at` places the corner in a column and a row. */
function addSheet(
    to: Triangles,
    columns: number,
    rows: number,
    at: (column: number, row: number) => Point,
    isThere: (column: number, row: number) => boolean = () => true,
): void {
    const first = to.points.length;
    for (let row = 0; row <= rows; ++row) for (let column = 0; column <= columns; ++column) to.points.push(at(column, row));
    for (let row = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column) {
            if (!isThere(column, row)) continue;
            const a = first + row * (columns + 1) + column;
            const [b, c, d] = [a + 1, a + columns + 1, a + columns + 2];
            to.triangles.push(a, c, b, b, c, d);
        }
}

/** Hills with pits, and a bridge over them. */
function hills(): Surface {
    const [columns, rows] = [20, 14];
    const height = (x: number, z: number): number =>
        0.7 * Math.sin(0.55 * x + 0.4) * Math.cos(0.5 * z) + 0.35 * Math.sin(0.9 * z - 0.4 * x);
    const ground = (column: number, row: number): Point => [
        column - columns / 2,
        height(column - columns / 2, row - rows / 2),
        row - rows / 2,
    ];
    // The bridge joins the ground at two pits, at their outer edges.
    const [from, to, side] = [4, 16, 6];
    const isPit = (column: number, row: number): boolean =>
        ((column === from || column === to - 1) && row >= side && row < side + 2) ||
        (column >= 8 && column < 10 && row >= 10 && row < 12) ||
        (row === 3 && column >= 11 && column < 16);
    const result: Triangles = { points: [], triangles: [] };
    addSheet(result, columns, rows, ground, (column, row) => !isPit(column, row));
    addSheet(result, to - from, 2, (column, row) => {
        const part = column / (to - from);
        const [start, end] = [ground(from, side + row), ground(to, side + row)];
        if (part === 0) return start;
        if (part === 1) return end;
        return [from + column - columns / 2, start[1] * (1 - part) + end[1] * part + 12 * part * (1 - part), side + row - rows / 2];
    });
    return {
        ...result,
        name: "hills and a bridge",
        start: [-8, 0, -0.2],
        ahead: [1, 0, -0.04],
        goal: [7, 0, -5],
        reach: 7.5,
        pitch: 0.35,
        step: 9,
    };
}

/** A strip with half a turn of twist. */
function moebius(): Surface {
    const [columns, rows] = [32, 3];
    const result: Triangles = { points: [], triangles: [] };
    addSheet(result, columns, rows, (column, row) => {
        // The last column is the first one, upside down.
        const line = column === columns ? rows - row : row;
        const around = (2 * Math.PI * (column % columns)) / columns;
        const across = 1.1 * ((2 * line) / rows - 1);
        const out = 3 + across * Math.cos(around / 2);
        return [out * Math.cos(around), across * Math.sin(around / 2), out * Math.sin(around)];
    });
    return {
        ...result,
        name: "Moebius strip",
        start: [1.336, -0.288, 2.081],
        ahead: [-0.966, -0.23, 0.12],
        goal: [-2.2, 0.8, -2],
        reach: 3.8,
        pitch: 0.15,
        step: 14,
    };
}

/** The faces of a cube in squares; `place` moves the points. */
function cube(count: number, place: (point: Point) => Point): Triangles {
    const result: Triangles = { points: [], triangles: [] };
    for (const axis of [0, 1, 2])
        for (const sign of [-1, 1])
            addSheet(result, count, count, (column, row) => {
                const [u, v] = [(2 * column) / count - 1, (2 * row) / count - 1];
                const point = [0, 0, 0];
                point[axis] = sign;
                point[(axis + 1) % 3] = sign < 0 ? u : v;
                point[(axis + 2) % 3] = sign < 0 ? v : u;
                return place(point as unknown as Point);
            });
    return result;
}
function planet(): Surface {
    const result = cube(8, (point) => {
        const length = Math.hypot(...point);
        const [x, y, z] = point.map((coordinate) => coordinate / length) as unknown as Point;
        const radius = 3 + 0.3 * Math.sin(3.3 * x + 1) * Math.cos(3.9 * y) + 0.25 * Math.sin(4.1 * z + y);
        return [radius * x, radius * y, radius * z];
    });
    return { ...result, name: "planet", start: [1, 3, 2], ahead: [1, 0, -0.4], goal: [-2, 1, 2], reach: 4.6, pitch: 0, step: 8 };
}

export const surfaces: Readonly<Record<string, () => Surface>> = {
    hills,
    moebius,
    planet,
    cube: () => ({
        ...cube(1, ([x, y, z]) => [2 * x, 2 * y, 2 * z]),
        name: "cube",
        start: [0.4, 2, 0.9],
        ahead: [1, 0, 0.3],
        goal: [-0.7, -2, 1.4],
        reach: 3.9,
        pitch: 0,
        step: 7,
    }),
};
