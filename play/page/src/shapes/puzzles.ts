// Arrangements of convex pieces to take apart.

import { json, type Abut } from "../library";
import type { AnyShape } from "../questions";
import { seededPoints } from "./seeded_points";

export interface Pose {
    position: number[];
    rotation: number[];
}
/** A piece about its own center, with its pose in the arrangement. */
export interface Piece {
    readonly shape: AnyShape;
    readonly pose: Pose;
    /** Of a ball around the center. */
    readonly radius: number;
    /** From the center to the end of a stick, where there is one. */
    readonly end?: readonly number[];
}
export interface Puzzle {
    readonly name: string;
    readonly dimension: 2 | 3;
    /** Whether there are others by other numbers. */
    readonly isRandom: boolean;
    readonly isPacked: boolean;
    readonly direction: readonly number[];
    make(abut: Abut, seed: number, count: number): Piece[];
}

interface PlanePiece extends Pose {
    readonly points: number[][];
}
function planePieces(bytes: Uint8Array): Piece[] {
    return json<PlanePiece[]>(bytes).map(({ points, position, rotation }) => ({
        shape: { type: "polygon", points: points.flat() },
        pose: { position, rotation },
        radius: Math.max(...points.map((point) => Math.hypot(...point))),
    }));
}

/** The lowest corner and the highest. */
type Box = readonly [number[], number[]];

function boxPiece(abut: Abut, [min, max]: Box): Piece {
    const half = max.map((x, i) => (x - (min[i] ?? 0)) / 2);
    const longest = Math.max(...half);
    const isStick = half.filter((x) => 2 * x > longest).length === 1;
    return {
        shape: abut.Box3([0, 0, 0], half),
        end: half.map((x) => (isStick && x === longest ? 0.9 * x : 0)),
        pose: { position: max.map((x, i) => (x + (min[i] ?? 0)) / 2), rotation: [0, 0, 0, 1] },
        radius: Math.hypot(...half),
    };
}
/** Cuts the largest box across its longest side, again and again. */
function cutCube(seed: number, count: number): Box[] {
    const size = ([min, max]: Box): number[] => max.map((x, i) => x - (min[i] ?? 0));
    const volume = (box: Box): number => size(box).reduce((product, x) => product * x, 1);
    const boxes: Box[] = [
        [
            [-1, -1, -1],
            [1, 1, 1],
        ],
    ];
    for (const [part = 0] of seededPoints(seed, 1, count - 1)) {
        const largest = boxes.reduce((best, box, i) => (volume(box) > volume(boxes[best] as Box) + 1e-9 ? i : best), 0);
        const box = boxes[largest] as Box;
        const sides = size(box);
        const axis = sides.indexOf(Math.max(...sides));
        const cut = Math.fround((box[0][axis] ?? 0) + (sides[axis] ?? 0) * (0.5 + 0.2 * part));
        const withCut = (corner: number[]): number[] => corner.map((x, i) => (i === axis ? cut : x));
        boxes[largest] = [box[0], withCut(box[1])];
        boxes.push([withCut(box[0]), box[1]]);
    }
    return boxes;
}
const sticks: readonly Box[] = [
    [
        [-5, -1, 0],
        [5, 0, 1],
    ],
    [
        [0, -5, -1],
        [1, 5, 0],
    ],
    [
        [-1, 0, -5],
        [0, 1, 5],
    ],
].map(([min, max]) => [min!.map((x) => x / 4), max!.map((x) => x / 4)]);

export const puzzles: Readonly<Record<string, Puzzle>> = {
    square: {
        name: "a cut square",
        dimension: 2,
        isRandom: true,
        isPacked: true,
        direction: [0, 1],
        make: (abut, seed, count) => planePieces(abut.play_cut_square(seed, count)),
    },
    thrown: {
        name: "thrown sticks",
        dimension: 2,
        isRandom: true,
        isPacked: false,
        direction: [0, 1],
        make: (abut, seed, count) => planePieces(abut.play_thrown_sticks(seed, count)),
    },
    three: {
        name: "three sticks in space",
        dimension: 3,
        isRandom: false,
        isPacked: false,
        direction: [1, 1, 1],
        make: (abut) => sticks.map((box) => boxPiece(abut, box)),
    },
    cube: {
        name: "a cut cube",
        dimension: 3,
        isRandom: true,
        isPacked: true,
        direction: [0, 1, 0],
        make: (abut, seed, count) => cutCube(seed, count).map((box) => boxPiece(abut, box)),
    },
};

/** The whole arrangement after a quarter of a revolution, in space about the second axis. */
export function quarterTurn({ position, rotation }: Pose): Pose {
    const [x = 0, y = 0, z = 0] = position;
    if (position.length === 2) return { position: [-y, x], rotation: [-(rotation[1] ?? 0), rotation[0] ?? 1] };
    return { position: [z, y, -x], rotation: [0, Math.fround(Math.SQRT1_2), 0, Math.fround(Math.SQRT1_2)] };
}
/** Each piece beside the one before, along the first axis. */
export function inARow(pieces: readonly Piece[]): Pose[] {
    const width = pieces.reduce((sum, { radius }) => sum + 2 * radius, 0);
    let left = -width / 2;
    return pieces.map(({ pose, radius }) => {
        const x = left + radius;
        left += 2 * radius;
        return { position: pose.position.map((_, axis) => (axis === 0 ? Math.fround(x) : 0)), rotation: [...pose.rotation] };
    });
}
