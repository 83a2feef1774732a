// The viewer of a pane of space: turns around a target or stands at a place, and never over the poles.

import { PerspectiveCamera, Vector3 } from "three";
import type { Numbers } from "./drawing";

export class Camera {
    readonly three = new PerspectiveCamera(40, 1, 0.01, 1000);
    readonly target = new Vector3();
    private yaw = 0.6;
    private pitch = 0.4;
    private distance = 1;
    private height = 1;
    private width = 1;
    private eye: Vector3 | null = null;

    constructor(center: Numbers, reach: number) {
        this.target.set(center[0] ?? 0, center[1] ?? 0, center[2] ?? 0);
        this.distance = this.distanceOf(reach);
        this.place();
    }

    get reach(): number {
        return this.distance * Math.tan((this.three.fov * Math.PI) / 360);
    }
    pixel(): number {
        return (2 * this.reach) / this.height;
    }
    resize(width: number, height: number): void {
        [this.width, this.height] = [width, height];
        this.three.aspect = width / height;
        this.place();
    }
    orbit(right: number, up: number): void {
        this.yaw -= right;
        this.pitch = Math.min(Math.max(this.pitch + up, -1.5), 1.5);
        this.place();
    }
    pan(right: number, up: number): void {
        const axes = this.axes();
        this.target.addScaledVector(axes.right, -right).addScaledVector(axes.up, -up);
        this.place();
    }
    /** The yaw and the pitch, in radians. */
    get angles(): [number, number] {
        return [this.yaw, this.pitch];
    }
    /** Stands at a place and looks by these angles. From then on a drag turns the head, until the place is null. */
    standAt(eye: Numbers | null, angles: readonly [number, number]): void {
        this.eye = eye && new Vector3(eye[0], eye[1], eye[2]);
        this.yaw = angles[0];
        this.pitch = Math.min(Math.max(angles[1], -1.5), 1.5);
        this.place();
    }
    zoom(factor: number): void {
        this.distance = Math.min(Math.max(this.distance / factor, 1e-2), 1e5);
        this.place();
    }
    fit(min: Numbers, max: Numbers): void {
        const low = new Vector3(min[0], min[1], min[2]);
        const high = new Vector3(max[0], max[1], max[2]);
        this.target.copy(low).add(high).multiplyScalar(0.5);
        this.distance = this.distanceOf(Math.max((0.55 * low.distanceTo(high)) / Math.min(1, this.three.aspect), 1e-3));
        this.place();
    }

    /** Unit vectors to the right, up, and towards the viewer. */
    axes(): { right: Vector3; up: Vector3; towards: Vector3 } {
        const [right, up, towards] = [new Vector3(), new Vector3(), new Vector3()];
        this.three.matrixWorld.extractBasis(right, up, towards);
        return { right, up, towards };
    }
    /** Pixels from the upper left corner; null if it is behind the viewer. */
    toPixels(at: Numbers, offset = 0): [number, number] | null {
        const place = new Vector3(at[offset], at[offset + 1], at[offset + 2]).project(this.three);
        if (place.z > 1 || place.z < -1) return null;
        return [((place.x + 1) / 2) * this.width, ((1 - place.y) / 2) * this.height];
    }
    /** The ray through a pixel: its start, and a direction of length 1. */
    ray(x: number, y: number): { origin: Vector3; direction: Vector3 } {
        const origin = this.three.position.clone();
        const direction = new Vector3((2 * x) / this.width - 1, 1 - (2 * y) / this.height, 0.5).unproject(this.three).sub(origin).normalize();
        return { origin, direction };
    }
    /** Where the ray through a pixel meets the plane through a point that faces the viewer. */
    onPlane(x: number, y: number, through: Vector3): Vector3 {
        const { origin, direction } = this.ray(x, y);
        const { towards } = this.axes();
        const along = through.clone().sub(origin).dot(towards) / direction.dot(towards);
        return origin.addScaledVector(direction, along);
    }

    private distanceOf(reach: number): number {
        return reach / Math.tan((this.three.fov * Math.PI) / 360);
    }
    private place(): void {
        const { three, target, yaw, pitch, distance } = this;
        const towards = new Vector3(Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch));
        if (this.eye) target.copy(this.eye).addScaledVector(towards, -distance);
        three.position.copy(target).addScaledVector(towards, distance);
        three.near = distance / 100;
        three.far = distance * 100;
        three.lookAt(target);
        three.updateProjectionMatrix();
        three.updateMatrixWorld();
    }
}
