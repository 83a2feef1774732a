// Collects what is drawn in space: faces and thin lines as batches, and what has a size in pixels to be made for each view.

import { DoubleSide, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Vector3, type Object3D } from "three";
import { Batch } from "./batch";
import type { Camera } from "./camera";
import { replay, type Drawing, type Numbers, type Palette, type Style } from "./drawing";

type Point3 = [number, number, number];
interface WideLine { from: Point3; to: Point3; style: Style; hasHead: boolean }
interface Mark { at: Point3; style: Style }
export interface Label { at: Point3; text: string; color: string; shift: readonly [number, number] }

const light = new Vector3(0.35, 0.8, 0.5).normalize();
// Lines up to this width are left to the graphics card, which draws them one pixel wide.
const thin = 1.5;

export class Drawing3 implements Drawing {
    readonly dimension = 3;
    readonly labels: Label[] = [];
    private readonly wide: WideLine[] = [];
    private readonly marks: Mark[] = [];
    private readonly opaque = faces({ polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }, 0);
    private readonly clear = faces({ transparent: true, depthWrite: false, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }, 1);
    private readonly thin = lines(2);
    private readonly sized = faces({ transparent: true }, 3);
    private readonly above = faces({ transparent: true, depthTest: false, depthWrite: false }, 4);
    private readonly batches = [this.opaque, this.clear, this.thin, this.sized, this.above];

    constructor(private readonly palette: Palette) {}

    get objects(): Object3D[] {
        return this.batches.map((batch) => batch.object);
    }
    begin(): void {
        for (const batch of [this.opaque, this.clear, this.thin]) batch.clear();
        this.wide.length = 0;
        this.marks.length = 0;
        this.labels.length = 0;
    }
    end(): void {
        for (const batch of [this.opaque, this.clear, this.thin]) batch.upload();
    }
    dispose(): void {
        for (const batch of this.batches) batch.dispose();
    }

    line(points: Numbers, style: Style): void {
        for (let i = 0; i + 5 < points.length; i += 3) this.piece(pointAt(points, i), pointAt(points, i + 3), style, false);
    }
    segments(points: Numbers, style: Style): void {
        for (let i = 0; i + 5 < points.length; i += 6) this.piece(pointAt(points, i), pointAt(points, i + 3), style, false);
    }
    polygon(points: Numbers, style: Style): void {
        const count = points.length / 3;
        if (style.fill) for (let i = 2; i < count; ++i) this.face(points, 0, i - 1, i, style);
        for (let i = 0; i < count; ++i) this.piece(pointAt(points, 3 * i), pointAt(points, 3 * ((i + 1) % count)), style, false);
    }
    triangles(points: Numbers, indices: Numbers, style: Style): void {
        for (let i = 0; i + 2 < indices.length; i += 3) this.face(points, indices[i] ?? 0, indices[i + 1] ?? 0, indices[i + 2] ?? 0, { fill: 1, ...style });
    }
    point(at: Numbers, style: Style): void {
        this.marks.push({ at: pointAt(at, 0), style });
    }
    arrow(from: Numbers, to: Numbers, style: Style): void {
        this.wide.push({ from: pointAt(from, 0), to: pointAt(to, 0), style, hasHead: true });
    }
    text(at: Numbers, text: string, style: Style, shift: readonly [number, number] = [0, 0]): void {
        this.labels.push({ at: pointAt(at, 0), text, color: this.palette.css(style.color), shift });
    }
    commands(commands: Float32Array, style: Style): void {
        replay(this, commands, style);
    }

    /** What has a size in pixels, as seen by this viewer. */
    resize(camera: Camera): void {
        this.sized.clear();
        this.above.clear();
        const { towards } = camera.axes();
        for (const { from, to, style, hasHead } of this.wide) this.strip(new Vector3(...from), new Vector3(...to), style, hasHead, camera, towards);
        for (const { at, style } of this.marks) this.disc(new Vector3(...at), style, camera);
        this.sized.upload();
        this.above.upload();
    }

    private piece(from: Point3, to: Point3, style: Style, hasHead: boolean): void {
        if (style.width === 0) return;
        if ((style.width ?? thin) > thin || style.dashed || style.onTop) {
            this.wide.push({ from, to, style, hasHead });
            return;
        }
        const color = this.palette.rgb(style.color);
        for (const end of [from, to]) this.thin.add(...end, ...color, style.alpha ?? 1);
    }
    private face(points: Numbers, a: number, b: number, c: number, style: Style): void {
        const corners = [pointAt(points, 3 * a), pointAt(points, 3 * b), pointAt(points, 3 * c)] as const;
        const [p, q, r] = corners;
        const normal = new Vector3(q[0] - p[0], q[1] - p[1], q[2] - p[2]).cross(new Vector3(r[0] - p[0], r[1] - p[1], r[2] - p[2])).normalize();
        const shade = 0.62 + 0.38 * Math.abs(normal.dot(light));
        const [red, green, blue] = this.palette.rgb(style.color);
        const fill = style.fill ?? 1;
        const batch = fill < 1 ? this.clear : this.opaque;
        for (const corner of corners) batch.add(...corner, red * shade, green * shade, blue * shade, fill);
    }

    private strip(from: Vector3, to: Vector3, style: Style, hasHead: boolean, camera: Camera, towards: Vector3): void {
        const along = to.clone().sub(from);
        const length = along.length();
        if (!(length > 0)) return;
        along.divideScalar(length);
        const side = along.clone().cross(towards);
        if (side.lengthSq() < 1e-12) return;
        side.normalize();
        // As if all of it were as far away as its middle.
        const pixel = this.pixelAt(from.clone().lerp(to, 0.5), camera);
        const half = (0.5 * (style.width ?? thin) + 0.25) * pixel;
        const head = hasHead ? Math.min(length, (8 + 2 * (style.width ?? thin)) * pixel) : 0;
        const end = length - head;
        const dash = style.dashed ? 7 * pixel : Infinity;
        for (let at = 0, drawn = 0; at < end && drawn < 256; at += 1.7 * dash, ++drawn)
            this.quad(from.clone().addScaledVector(along, at), from.clone().addScaledVector(along, Math.min(at + dash, end)), side.clone().multiplyScalar(half), style);
        if (!hasHead) return;
        const neck = to.clone().addScaledVector(along, -head);
        side.multiplyScalar(0.4 * head);
        this.triangle(neck.clone().add(side), neck.clone().sub(side), to, style);
    }
    private quad(from: Vector3, to: Vector3, side: Vector3, style: Style): void {
        const [a, b, c, d] = [from.clone().sub(side), to.clone().sub(side), to.clone().add(side), from.clone().add(side)];
        this.triangle(a, b, c, style);
        this.triangle(a, c, d, style);
    }
    private disc(center: Vector3, style: Style, camera: Camera): void {
        const { right, up } = camera.axes();
        const radius = (2.5 + (style.width ?? thin)) * this.pixelAt(center, camera);
        const corner = (i: number): Vector3 =>
            center.clone().addScaledVector(right, radius * Math.cos((i * Math.PI) / 4)).addScaledVector(up, radius * Math.sin((i * Math.PI) / 4));
        for (let i = 0; i < 8; ++i) this.triangle(center, corner(i), corner(i + 1), style);
    }
    private triangle(a: Vector3, b: Vector3, c: Vector3, style: Style): void {
        const color = this.palette.rgb(style.color);
        const batch = style.onTop ? this.above : this.sized;
        for (const corner of [a, b, c]) batch.add(corner.x, corner.y, corner.z, ...color, style.alpha ?? 1);
    }
    private pixelAt(place: Vector3, camera: Camera): number {
        return (camera.pixel() * camera.three.position.distanceTo(place)) / camera.three.position.distanceTo(camera.target);
    }
}

function pointAt(points: Numbers, index: number): Point3 {
    return [points[index] ?? 0, points[index + 1] ?? 0, points[index + 2] ?? 0];
}
function faces(options: object, order: number): Batch {
    // In two passes three.js would draw clear faces twice, and look for its program anew in each.
    const material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, forceSinglePass: true, ...options });
    return new Batch((geometry, own) => new Mesh(geometry, own), material, order);
}
function lines(order: number): Batch {
    return new Batch((geometry, material) => new LineSegments(geometry, material), new LineBasicMaterial({ vertexColors: true, transparent: true }), order);
}
