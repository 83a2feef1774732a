// A walker: a place on the mesh, with a frame that is carried along.

import { Quaternion, Vector3 } from "three";
import type { Abut } from "../../library";

export type WalkMesh = InstanceType<Abut["WalkMesh"]>;
export type Walked = ReturnType<WalkMesh["walk"]>;
export type Path = ReturnType<WalkMesh["path"]>;

export interface Place {
    triangle: number;
    weights: number[];
}
/** Plain data. `forward` and `up` are unit vectors; the walker may stand on the side opposite to the normal. */
export interface WalkerState {
    place: Place;
    forward: number[];
    up: number[];
}

const rounded = (vector: Vector3): number[] => vector.toArray().map(Math.fround);
export const scaled = (vector: readonly number[], factor: number): number[] => vector.map((x) => x * factor);

export class Walker {
    constructor(
        private readonly mesh: WalkMesh,
        readonly state: WalkerState,
    ) {
        if (!this.isAligned) this.align();
    }

    get position(): number[] {
        return this.mesh.to_world(this.state.place);
    }
    get left(): number[] {
        return leftOf(this.state.forward, this.state.up);
    }
    get isBelow(): boolean {
        return new Vector3(...this.mesh.normal(this.state.place)).dot(new Vector3(...this.state.up)) < 0;
    }
    /** The walk, its end not taken. */
    ahead(length: number): Walked {
        return this.mesh.walk(this.state.place, scaled(this.state.forward, length));
    }
    /** Goes ahead, or back for a length below 0. */
    walk(length: number): Walked {
        const walked = this.ahead(length);
        this.state.place = placeOf(walked);
        this.state.forward = carried(walked, this.state.forward);
        this.state.up = carried(walked, this.state.up);
        this.align();
        return walked;
    }
    /** To the left, by an angle in radians. */
    turn(angle: number): void {
        this.state.forward = rounded(new Vector3(...this.state.forward).applyAxisAngle(new Vector3(...this.state.up), angle));
    }
    /** Looks into a direction, as far as it lies in the triangle. */
    look(direction: readonly number[]): void {
        this.state.forward = [...direction];
        this.align();
    }
    put(place: Place): void {
        this.state.place = place;
        this.align();
    }

    /** Whether the frame lies in the triangle; that of a link may not. */
    private get isAligned(): boolean {
        const normal = new Vector3(...this.mesh.normal(this.state.place));
        const [forward, up] = [new Vector3(...this.state.forward), new Vector3(...this.state.up)];
        return (
            Math.abs(forward.length() - 1) < 1e-4 && Math.abs(forward.dot(normal)) < 1e-3 && Math.abs(Math.abs(up.dot(normal)) - 1) < 1e-3
        );
    }
    /** Keeps the frame in the triangle, on the side on which the walker stands. */
    private align(): void {
        const up = new Vector3(...this.mesh.normal(this.state.place));
        if (this.isBelow) up.negate();
        const forward = new Vector3(...this.state.forward).projectOnPlane(up);
        if (forward.lengthSq() < 1e-6) forward.set(1, 0.3, 0.2).projectOnPlane(up);
        this.state.up = rounded(up);
        this.state.forward = rounded(forward.normalize());
    }
}

export function placeOf({ place }: Walked): Place {
    return { triangle: place.triangle, weights: Array.from(place.weights) };
}
/** A direction at the start of a walk, at its end. */
export function carried(walked: Walked, direction: readonly number[]): number[] {
    const [x = 0, y = 0, z = 0, w = 1] = Array.from(walked.turn);
    return rounded(new Vector3(...direction).applyQuaternion(new Quaternion(x, y, z, w)));
}
export function leftOf(forward: readonly number[], up: readonly number[]): number[] {
    return new Vector3(...up).cross(new Vector3(...forward)).toArray();
}
