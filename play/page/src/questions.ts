// The library's questions for shapes of either dimension. The package's types name the dimension; exhibits mostly don't.

import type { Abut } from "./library";

/** A plain shape of the package, or a handle of one. */
export type AnyShape = object;

export interface Feature {
    part: number;
    index: number;
    kind: number;
}
export interface Closest {
    distance: number;
    normal: number[];
    on_a: number[];
    on_b: number[];
    feature_a: Feature;
    feature_b: Feature;
}
export interface Certificate {
    holds: boolean;
    margin: number;
    plane: number;
    common: number[];
    off_common: number;
}
export interface Contact {
    normal: number[];
    depth: number;
    points: { position: number[]; depth: number; feature: number }[];
}
export interface Hit {
    fraction: number;
    distance: number;
    point: number[];
    normal: number[];
    started_inside: boolean;
    feature: Feature;
}
export interface Ray {
    origin: number[];
    direction: number[];
    length: number;
}
export interface Polytope {
    type: "polygon" | "polyhedron";
    points: Float32Array;
    triangles?: Uint32Array;
    area: number;
    volume: number;
    centroid: number[];
}
export interface Pose {
    position: number[];
    rotation: number[];
}
/** `turn`: an angle in radians, in space times its axis. */
export interface Motion {
    from: Pose;
    move: number[];
    turn: number | number[];
}

export class Questions {
    constructor(private readonly abut: Abut) {}

    overlaps(a: AnyShape, b: AnyShape): boolean {
        return this.abut.overlaps(a as never, b as never);
    }
    closest(a: AnyShape, b: AnyShape | readonly number[]): Closest {
        return this.abut.closest(a as never, b as never) as unknown as Closest;
    }
    certify(a: AnyShape, b: AnyShape, answer: Closest): Certificate {
        return this.abut.certify(a as never, b as never, answer as never) as unknown as Certificate;
    }
    contact(a: AnyShape, b: AnyShape, margin = 0): Contact | null {
        return this.abut.contact(a as never, b as never, { margin } as never) as unknown as Contact | null;
    }
    contacts(a: AnyShape, b: AnyShape, margin = 0): Contact[] {
        return this.abut.each_contact(a as never, b as never, { margin } as never) as unknown as Contact[];
    }
    sweep(a: AnyShape, motionA: readonly number[], b: AnyShape, motionB?: readonly number[]): Hit | null {
        return this.abut.sweep(a as never, motionA as never, b as never, motionB as never) as unknown as Hit | null;
    }
    /** Each shape is about the origin of the frame that its motion moves. */
    sweepMotion(a: AnyShape, motionA: Motion, b: AnyShape, motionB: Motion): Hit | null {
        return this.abut.sweep_motion(a as never, motionA as never, b as never, motionB as never) as unknown as Hit | null;
    }
    poseAt(motion: Motion, fraction: number): Pose {
        const { Motion2, Motion3 } = this.abut;
        const pose = motion.move.length === 2 ? Motion2.pose_at(motion as never, fraction) : Motion3.pose_at(motion as never, fraction);
        return pose as unknown as Pose;
    }
    raycast(ray: Ray, shape: AnyShape): Hit | null {
        return this.abut.raycast(ray as never, shape as never) as unknown as Hit | null;
    }
    contains(shape: AnyShape, point: readonly number[]): boolean {
        return this.abut.contains(shape as never, point as never);
    }
    /** A polygon or polyhedron of a convex shape; of a curved one to within a tolerance. */
    polytope(shape: AnyShape, tolerance: number): Polytope {
        return this.abut.polytope(shape as never, tolerance) as unknown as Polytope;
    }
    minkowskiDifference(a: AnyShape, b: AnyShape): Polytope {
        return this.abut.minkowski_difference(a as never, b as never) as unknown as Polytope;
    }
    intersection(a: AnyShape, b: AnyShape): Polytope | null {
        return this.abut.intersection(a as never, b as never) as unknown as Polytope | null;
    }
    /** The shape moved by a position and turned by a rotation. */
    at(shape: AnyShape, position: readonly number[], rotation: readonly number[]): AnyShape {
        return this.abut.at(shape as never, { position, rotation } as never) as unknown as AnyShape;
    }
}
