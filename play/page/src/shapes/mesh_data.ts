// A triangle mesh as numbers, and what is needed to show values on it.

export interface MeshData {
    readonly points: Float32Array;
    /** Three point numbers each. */
    readonly triangles: Uint32Array;
}

/** The box around the points: its lowest corner and its highest. */
export function boxOf({ points }: MeshData): { min: number[]; max: number[]; longest: number } {
    const [min, max] = [
        [Infinity, Infinity, Infinity],
        [-Infinity, -Infinity, -Infinity],
    ];
    points.forEach((x, i) => {
        min[i % 3] = Math.min(min[i % 3] ?? 0, x);
        max[i % 3] = Math.max(max[i % 3] ?? 0, x);
    });
    return { min, max, longest: Math.max(...max.map((x, i) => x - (min[i] ?? 0))) };
}

// A triangle becomes at most this many rows of smaller ones.
const maxRows = 24;

/** The same surface with edges of at most about `length`, so that a value at each point shows what happens within its triangles. */
export function refined({ points, triangles }: MeshData, length: number): MeshData {
    const morePoints = Array.from(points);
    const result: number[] = [];
    const at = (corner: number, axis: number): number => points[3 * corner + axis] ?? 0;
    for (let t = 0; t + 2 < triangles.length; t += 3) {
        const [a = 0, b = 0, c = 0] = triangles.subarray(t, t + 3);
        const edge = (p: number, q: number): number => Math.hypot(at(q, 0) - at(p, 0), at(q, 1) - at(p, 1), at(q, 2) - at(p, 2));
        const rows = Math.min(Math.ceil(Math.max(edge(a, b), edge(b, c), edge(c, a)) / length), maxRows);
        if (rows <= 1) {
            result.push(a, b, c);
            continue;
        }
        const first = morePoints.length / 3;
        for (let i = 0; i <= rows; ++i)
            for (let j = 0; j <= i; ++j)
                for (let axis = 0; axis < 3; ++axis)
                    morePoints.push((at(a, axis) * (rows - i) + at(b, axis) * (i - j) + at(c, axis) * j) / rows);
        const index = (i: number, j: number): number => first + (i * (i + 1)) / 2 + j;
        for (let i = 0; i < rows; ++i)
            for (let j = 0; j <= i; ++j) {
                result.push(index(i, j), index(i + 1, j), index(i + 1, j + 1));
                if (j < i) result.push(index(i, j), index(i + 1, j + 1), index(i, j + 1));
            }
    }
    return { points: Float32Array.from(morePoints), triangles: Uint32Array.from(result) };
}
