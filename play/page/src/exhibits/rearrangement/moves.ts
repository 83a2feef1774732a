// Moves of pieces, one after the other, at any moment between the first and the last.

import { Quaternion } from "three";
import type { Pose } from "../../shapes/puzzles";

export interface Move {
    readonly shape: number;
    readonly from: Pose;
    readonly to: Pose;
}

export interface Box {
    readonly min: readonly number[];
    readonly max: readonly number[];
}

/** All poses at a moment: the whole part counts moves that are done, the rest is the part of the next one. */
export function posesAt(start: readonly Pose[], moves: readonly Move[], moment: number): Pose[] {
    const result = [...start];
    moves.forEach(({ shape, from, to }, i) => {
        if (i < moment) result[shape] = i + 1 <= moment ? to : between(from, to, moment - i);
    });
    return result;
}
/** The move that is under way or was the last. */
export function moveAt(moves: readonly Move[], moment: number): Move | undefined {
    return moves[Math.max(Math.ceil(moment) - 1, 0)];
}

function between(from: Pose, to: Pose, part: number): Pose {
    const position = from.position.map((x, i) => x + part * ((to.position[i] ?? 0) - x));
    if (from.rotation.every((x, i) => x === to.rotation[i])) return { position, rotation: to.rotation };
    if (from.rotation.length === 4) {
        const rotation = new Quaternion(...from.rotation).slerp(new Quaternion(...to.rotation), part);
        return { position, rotation: rotation.toArray() };
    }
    const [start, end] = [from, to].map(({ rotation }) => Math.atan2(rotation[1] ?? 0, rotation[0] ?? 1)) as [number, number];
    let angle = end - start;
    if (Math.abs(angle) > Math.PI) angle -= 2 * Math.PI * Math.sign(angle);
    return { position, rotation: [Math.cos(start + part * angle), Math.sin(start + part * angle)] };
}

/** A box around balls at poses. */
export function boxAround(poses: readonly Pose[], radii: readonly number[]): Box {
    const dimension = poses[0]?.position.length ?? 2;
    const bound = (sign: number, axis: number): number =>
        sign * Math.max(...poses.map(({ position }, i) => sign * (position[axis] ?? 0) + (radii[i] ?? 0)));
    const axes = Array.from({ length: dimension }, (_, axis) => axis);
    return { min: axes.map((axis) => bound(-1, axis)), max: axes.map((axis) => bound(1, axis)) };
}
/** The box around all pieces at a moment; it changes evenly from move to move. */
export function boxAt(start: readonly Pose[], moves: readonly Move[], moment: number, radii: readonly number[]): Box {
    const done = Math.floor(moment);
    const [before, after] = [done, Math.ceil(moment)].map((count) => boxAround(posesAt(start, moves, count), radii)) as [Box, Box];
    const mix = (a: readonly number[], b: readonly number[]): number[] => a.map((x, i) => x + (moment - done) * ((b[i] ?? 0) - x));
    return { min: mix(before.min, after.min), max: mix(before.max, after.max) };
}
