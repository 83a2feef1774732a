// One run of the small physics engine with crates on a floor, and what was seen of it.

import { floats, type Abut } from "../../library";
import { isGhost, type TouchPoint } from "./side";

export const half = 0.5;
export const stepsPerSecond = 240;

export interface Place {
    readonly position: readonly number[];
    readonly rotation: readonly number[];
}

export class Engine {
    points: TouchPoint[] = [];
    /** Counts over all steps. */
    ghosts = 0;
    /** The largest height of the first crate's middle. */
    highest = half;
    private physics;
    private boxes = new Float32Array();

    constructor(
        private readonly abut: Abut,
        private readonly dimension: 2 | 3,
        private readonly filters: boolean,
        private readonly parts: readonly object[],
    ) {
        this.physics = this.make();
    }

    /** Starts anew with crates at these places. The counts go on. */
    begin(places: readonly Place[]): void {
        this.physics.dispose();
        this.physics = this.make();
        for (const part of this.parts) this.physics.add_fixed(part as never);
        for (const place of places) this.physics.add_box(place as never, new Array<number>(this.dimension).fill(half));
        this.read();
    }
    step(): void {
        this.physics.step(1 / stepsPerSecond);
        this.read();
        this.highest = Math.max(this.highest, this.position(0)[1] ?? half);
        this.ghosts += this.points.filter(isGhost).length;
    }
    setVelocity(box: number, velocity: readonly number[]): void {
        this.physics.set_velocity(box, velocity);
    }
    /** The share of the contact points that were there in the step before. */
    persistence(): number {
        return this.physics.persistence();
    }
    dispose(): void {
        this.physics.dispose();
    }

    get count(): number {
        return this.boxes.length / this.stride;
    }
    position(box: number): number[] {
        return Array.from(this.boxes.subarray(box * this.stride, box * this.stride + this.dimension));
    }
    rotation(box: number): number[] {
        return Array.from(this.boxes.subarray(box * this.stride + this.dimension, (box + 1) * this.stride - this.dimension));
    }
    velocity(box: number): number[] {
        return Array.from(this.boxes.subarray((box + 1) * this.stride - this.dimension, (box + 1) * this.stride));
    }

    /** A position, a rotation and a velocity. */
    private get stride(): number {
        return this.dimension === 2 ? 6 : 10;
    }
    private make(): InstanceType<Abut["PlayPhysics2"]> | InstanceType<Abut["PlayPhysics3"]> {
        return this.dimension === 2 ? new this.abut.PlayPhysics2(this.filters) : new this.abut.PlayPhysics3(this.filters);
    }
    private read(): void {
        this.boxes = floats(this.physics.boxes()).slice();
        const numbers = Array.from(floats(this.physics.contacts()));
        const stride = 2 * this.dimension + 2;
        this.points = Array.from({ length: numbers.length / stride }, (_, i) => {
            const point = numbers.slice(i * stride, (i + 1) * stride);
            return { at: point.slice(0, this.dimension), normal: point.slice(this.dimension, -2), isOfFloor: point[stride - 1] === 1 };
        });
    }
}
