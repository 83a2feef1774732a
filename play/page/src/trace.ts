// The steps of the engines, as play/wasm writes them.

import { floats, json, type Abut } from "./library";
import type { AnyShape, Motion } from "./questions";

export interface GjkStep {
    kind: "gjk";
    points: number[][];
    closest: number[];
}
export interface PenetrationStep {
    kind: "penetration";
    points: number[][];
    normal: number[];
    distance: number;
    extent: number;
}
export interface AxisStep {
    kind: "axis";
    axis: number[];
    min_a: number;
    max_a: number;
    min_b: number;
    max_b: number;
}
export interface ClipStep {
    kind: "clip";
    normal: number[];
    offset: number;
    points: number[][];
}
export interface SweepStep {
    kind: "sweep";
    position: number[];
    normal: number[];
    distance: number;
}
export type Step = GjkStep | PenetrationStep | AxisStep | ClipStep | SweepStep;

/** The questions whose steps can be seen, by the numbers of play/wasm. */
export const questions = { closest: 0, contact: 1, sweep: 2, intersection: 3 } as const;
export type Question = keyof typeof questions;

export function traceOf(abut: Abut, question: Question, a: AnyShape, b: AnyShape, motion: readonly number[]): Step[] {
    const trace = motion.length === 2 ? abut.play_trace2 : abut.play_trace3;
    return json<Step[]>(trace(questions[question], a as never, b as never, motion as never));
}

/** A stop of a sweep with rotation. */
export interface Stop {
    time: number;
    distance: number;
    normal: number[];
}
export function stopsOf(abut: Abut, a: AnyShape, motionA: Motion, b: AnyShape, motionB: Motion): Stop[] {
    const stops = motionA.move.length === 2 ? abut.play_sweep_stops2 : abut.play_sweep_stops3;
    return json<Stop[]>(stops(a as never, motionA as never, b as never, motionB as never));
}

/** The signed distances at even times of both motions, from 0 to 1. */
export function distancesOf(abut: Abut, a: AnyShape, motionA: Motion, b: AnyShape, motionB: Motion, count: number): Float32Array {
    const distances = motionA.move.length === 2 ? abut.play_distances2 : abut.play_distances3;
    return floats(distances(a as never, motionA as never, b as never, motionB as never, count));
}
