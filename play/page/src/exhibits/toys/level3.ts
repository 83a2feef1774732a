// The walker's level: a floor with walls and crates, and a mesh with stairs, a landing and a ramp.

import type { Abut } from "../../library";
import type { AnyShape } from "../../questions";
import type { ColorName } from "../../stage/drawing";

export interface LevelPart {
    readonly shape: AnyShape;
    readonly color: ColorName;
}

const half = 11;
const wallHeight = 1.6;
/** Along x: eight steps up, the landing, and the ramp down. */
const stairs = { start: -3, count: 8, run: 0.4, rise: 0.25, landing: 2, ramp: 4.5, z: [-1.5, 1.5] } as const;

export function level3(abut: Abut): LevelPart[] {
    const box = (center: readonly number[], size: readonly number[], color: ColorName): LevelPart => ({
        shape: abut.Box3(center, size),
        color,
    });
    const walls = [-1, 1].flatMap((side) => [
        box([side * (half + 0.25), wallHeight, 0], [0.25, wallHeight, half + 0.5], "soft"),
        box([0, wallHeight, side * (half + 0.25)], [half, wallHeight, 0.25], "soft"),
    ]);
    const { points, triangles } = stairsAndRamp();
    return [
        box([0, -0.25, 0], [half, 0.25, half], "grid"),
        ...walls,
        box([-6, 0.5, 5], [0.5, 0.5, 0.5], "b"),
        box([-4.8, 0.5, 5.2], [0.5, 0.5, 0.5], "b"),
        box([-5.4, 1.25, 5.1], [0.25, 0.25, 0.25], "b"),
        box([3, 1, 6], [2.5, 1, 0.2], "b"),
        box([-1, 0.1, -6], [1.5, 0.1, 1.5], "b"),
        box([-1, 0.3, -6.5], [1, 0.1, 1], "b"),
        {
            shape: abut.at(abut.Box3([0, 0, 0], [0.3, 1.5, 2]), { position: [6, 1.5, -6], rotation: abut.Turn.about([0, 1, 0], 0.6) }),
            color: "b",
        },
        { shape: abut.Cylinder([6, 0, 7], [6, 2.5, 7], 0.7), color: "b" },
        { shape: abut.Mesh(points, triangles), color: "a" },
    ];
}

/** A profile along x that is drawn out along z: the surface to walk on, and its two sides. */
function stairsAndRamp(): { points: number[][]; triangles: number[] } {
    const top = stairs.count * stairs.rise;
    const edge = stairs.start + stairs.count * stairs.run + stairs.landing;
    const profile = [[stairs.start, 0]];
    for (let i = 0; i < stairs.count; ++i)
        profile.push([stairs.start + i * stairs.run, (i + 1) * stairs.rise], [stairs.start + (i + 1) * stairs.run, (i + 1) * stairs.rise]);
    profile.push([edge, top], [edge + stairs.ramp, 0]);
    const points: number[][] = [];
    const triangles: number[] = [];
    const quad = (corners: readonly number[][]): void => {
        const first = points.length;
        points.push(...corners);
        triangles.push(first, first + 1, first + 2, first, first + 2, first + 3);
    };
    for (let i = 0; i + 1 < profile.length; ++i) {
        const [[x0 = 0, y0 = 0] = [], [x1 = 0, y1 = 0] = []] = [profile[i], profile[i + 1]];
        const [near, far] = stairs.z;
        quad([
            [x0, y0, near],
            [x0, y0, far],
            [x1, y1, far],
            [x1, y1, near],
        ]);
        if (x1 === x0) continue;
        // Under the ramp one corner is on the floor, so the area there is one triangle.
        for (const z of stairs.z) {
            if (y1 > 0)
                quad([
                    [x0, 0, z],
                    [x1, 0, z],
                    [x1, y1, z],
                    [x0, y0, z],
                ]);
            else {
                const first = points.length;
                points.push([x0, 0, z], [x1, 0, z], [x0, y0, z]);
                triangles.push(first, first + 1, first + 2);
            }
        }
    }
    return { points, triangles };
}
