// The view in space: objects near the finding, the rest as boxes, contact points, normal and depth.

import {
    AmbientLight,
    BoxGeometry,
    BufferAttribute,
    BufferGeometry,
    Color,
    ColorManagement,
    ConeGeometry,
    CylinderGeometry,
    DirectionalLight,
    DoubleSide,
    EdgesGeometry,
    Group,
    LineBasicMaterial,
    LineSegments,
    LinearSRGBColorSpace,
    Matrix4,
    Mesh,
    MeshBasicMaterial,
    MeshLambertMaterial,
    Object3D,
    PerspectiveCamera,
    Points,
    PointsMaterial,
    Quaternion,
    Scene,
    Vector3,
    WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import {
    bytesOf,
    label,
    lastName,
    markColor,
    partyColors,
    pointsOf,
    radiusOf,
    rounded,
    type Finding,
    type Report,
    type SceneObject,
    type Vector,
    type View,
} from "./report";

const contextColor = "#94a3b8";

function vector(v: Vector): Vector3 {
    return new Vector3(v[0] ?? 0, v[1] ?? 0, v[2] ?? 0);
}

/** An object of the scene with its poses. */
class Shown {
    readonly group = new Group();
    readonly mesh: Mesh | undefined;
    readonly edges: LineSegments | undefined;
    readonly center: Vector3;
    readonly radius: number;
    private readonly poses: Float32Array | undefined;

    constructor(readonly data: SceneObject) {
        const low = vector(data.box);
        const high = vector(data.box.slice(3));
        this.center = low.clone().add(high).multiplyScalar(0.5);
        this.radius = low.distanceTo(high) / 2;
        if (data.poses) this.poses = new Float32Array(bytesOf(data.poses));
        if (data.mesh) {
            const geometry = new BufferGeometry();
            geometry.setAttribute("position", new BufferAttribute(pointsOf(data.mesh), 3));
            geometry.setIndex(new BufferAttribute(new Uint32Array(bytesOf(data.mesh.elements)), 1));
            this.mesh = new Mesh(geometry, new MeshLambertMaterial({ side: DoubleSide, flatShading: true }));
            this.group.add(this.mesh);
            this.group.matrixAutoUpdate = false;
            this.edges = new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial());
            this.group.add(this.edges);
        }
        this.paint(undefined);
    }

    /** In the colour of its party, or as context. */
    paint(color: string | undefined): void {
        if (!this.mesh || !this.edges) return;
        const material = this.mesh.material as MeshLambertMaterial;
        material.color = new Color(color ?? contextColor);
        material.transparent = true;
        material.opacity = color ? 0.6 : 0.22;
        material.depthWrite = false;
        const lines = this.edges.material as LineBasicMaterial;
        lines.color = new Color(color ?? contextColor);
        lines.transparent = true;
        lines.opacity = color ? 1 : 0.45;
    }

    /** Places it between two samples. */
    place(sample: number, share: number): void {
        if (!this.poses) return;
        const matrix = this.pose(sample);
        if (share > 0 && this.poses.length > 12 * (sample + 1)) {
            const from = [new Vector3(), new Quaternion(), new Vector3()] as const;
            const to = [new Vector3(), new Quaternion(), new Vector3()] as const;
            matrix.decompose(...from);
            this.pose(sample + 1).decompose(...to);
            matrix.compose(from[0].lerp(to[0], share), from[1].slerp(to[1], share), from[2].lerp(to[2], share));
        }
        this.group.matrix.copy(matrix);
        this.group.matrixWorldNeedsUpdate = true;
    }

    private pose(sample: number): Matrix4 {
        const p = this.poses ?? new Float32Array(12);
        const first = Math.min(12 * sample, p.length - 12);
        const at = (i: number): number => p[first + i] ?? 0;
        return new Matrix4().set(
            at(0), at(3), at(6), at(9),
            at(1), at(4), at(7), at(10),
            at(2), at(5), at(8), at(11),
            0, 0, 0, 1,
        );
    }
}

/** The edges of the boxes of all objects without a mesh, as one thing to draw. */
function contextBoxes(objects: readonly SceneObject[]): LineSegments {
    const edges = new EdgesGeometry(new BoxGeometry(1, 1, 1)).getAttribute("position");
    const boxes = objects.filter((object) => !object.mesh);
    const points = new Float32Array(boxes.length * edges.count * 3);
    let next = 0;
    for (const { box } of boxes)
        for (let i = 0; i < edges.count; ++i)
            for (let axis = 0; axis < 3; ++axis) {
                const low = box[axis] ?? 0;
                const high = box[3 + axis] ?? 0;
                points[next++] = low + (edges.getComponent(i, axis) + 0.5) * (high - low);
            }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(points, 3));
    return new LineSegments(geometry, new LineBasicMaterial({ color: contextColor, transparent: true, opacity: 0.3 }));
}

/** An arrow of a thickness that shows. */
function arrow(from: Vector3, direction: Vector3, length: number): Group {
    const material = new MeshBasicMaterial({ color: markColor });
    const shaft = new Mesh(new CylinderGeometry(0.02 * length, 0.02 * length, 0.8 * length), material);
    shaft.position.y = 0.4 * length;
    const head = new Mesh(new ConeGeometry(0.06 * length, 0.2 * length, 24), material);
    head.position.y = 0.9 * length;
    const group = new Group().add(shaft, head);
    group.position.copy(from);
    group.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), direction.clone().normalize());
    return group;
}

/** Drawn over everything else. */
function onTop<T extends Object3D>(thing: T): T {
    thing.traverse((part) => {
        part.renderOrder = 1;
        const material = (part as Mesh).material;
        if (material && !Array.isArray(material)) {
            material.depthTest = false;
            material.transparent = true;
        }
    });
    return thing;
}

export class View3 implements View {
    readonly element = document.createElement("div");
    private readonly labels = document.createElement("div");
    private readonly renderer: WebGLRenderer;
    private readonly scene = new Scene();
    private readonly camera = new PerspectiveCamera(45, 1, 0.01, 1000);
    private readonly controls: OrbitControls;
    private readonly shown: readonly Shown[];
    private readonly named: { element: HTMLElement; at: () => Vector3 }[] = [];
    private marks = new Group();
    private pending = 0;
    private readonly observer = new ResizeObserver(() => this.resize());

    /** Throws if there is no WebGL. */
    constructor(private readonly report: Report) {
        this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
        // A page that takes colours as they are shows them so.
        if (!ColorManagement.enabled) this.renderer.outputColorSpace = LinearSRGBColorSpace;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.element.className = "canvas";
        this.labels.className = "labels";
        this.labels.setAttribute("aria-hidden", "true");
        this.element.append(this.renderer.domElement, this.labels);
        this.camera.up.copy(vector(report.up));
        this.shown = report.objects.map((object) => new Shown(object));
        for (const object of this.shown) if (object.mesh) this.scene.add(object.group);
        this.scene.add(contextBoxes(report.objects), new AmbientLight(0xffffff, 1.6), this.camera);
        const lamp = new DirectionalLight(0xffffff, 2.2);
        lamp.position.set(0.4, 0.8, 1);
        this.camera.add(lamp);
        this.controls = new OrbitControls(this.camera, this.renderer.domElement);
        this.controls.addEventListener("change", () => this.draw());
        this.observer.observe(this.element);
        this.setTime(report.samples[0] ?? 0);
        this.show(undefined);
    }

    show(finding: Finding | undefined): void {
        this.labels.replaceChildren();
        this.named.length = 0;
        this.scene.remove(this.marks);
        this.marks = new Group();
        this.scene.add(this.marks);
        for (const object of this.shown) object.paint(undefined);
        if (!finding) {
            this.showAll();
            return;
        }
        finding.parties.forEach((party, i) => {
            const color = partyColors[i % 2];
            const objects = party.map((index) => this.shown[index]).filter((object) => object !== undefined);
            for (const object of objects) object.paint(color);
            const first = objects[0];
            if (first) this.addLabel(lastName(first.data.name), `party${i % 2}`, () => this.topOf(first));
        });
        this.mark(finding);
        this.turnTo(finding);
    }

    setTime(seconds: number): void {
        const samples = this.report.samples;
        let sample = 0;
        while (sample + 1 < samples.length && (samples[sample + 1] ?? 0) <= seconds) ++sample;
        const from = samples[sample] ?? 0;
        const to = samples[sample + 1] ?? from;
        const share = to > from ? Math.max(0, (seconds - from) / (to - from)) : 0;
        for (const object of this.shown) object.place(sample, share);
        this.draw();
    }

    zoom(factor: number): void {
        const offset = this.camera.position.clone().sub(this.controls.target);
        this.camera.position.copy(this.controls.target).addScaledVector(offset, 1 / factor);
        this.controls.update();
        this.draw();
    }

    turn(x: number, y: number): void {
        const offset = this.camera.position.clone().sub(this.controls.target);
        offset.applyAxisAngle(this.camera.up, x * 0.2);
        const side = this.camera.up.clone().cross(offset).normalize();
        const turned = offset.clone().applyAxisAngle(side, -y * 0.2);
        // Not over the pole.
        const height = turned.clone().normalize().dot(this.camera.up);
        if (Math.abs(height) < 0.99) offset.copy(turned);
        this.camera.position.copy(this.controls.target).add(offset);
        this.controls.update();
        this.draw();
    }

    dispose(): void {
        this.observer.disconnect();
        cancelAnimationFrame(this.pending);
        this.controls.dispose();
        this.renderer.dispose();
        this.renderer.forceContextLoss();
    }

    /** A little below the highest point in the middle of an object. */
    private topOf(object: Shown): Vector3 {
        let { center, radius } = object;
        if (object.mesh) {
            const geometry = object.mesh.geometry;
            if (!geometry.boundingSphere) geometry.computeBoundingSphere();
            const sphere = geometry.boundingSphere?.clone().applyMatrix4(object.group.matrix);
            if (sphere) ({ center, radius } = sphere);
        }
        return center.clone().addScaledVector(this.camera.up, 0.5 * radius);
    }

    private addLabel(text: string, className: string, at: () => Vector3): void {
        const element = label(text, className);
        this.labels.append(element);
        this.named.push({ element, at });
    }

    /** Points, normal and depth. */
    private mark(finding: Finding): void {
        const places = finding.points.length > 0 ? finding.points : [finding.position];
        const geometry = new BufferGeometry().setFromPoints(places.map(vector));
        const dots = new Points(geometry, new PointsMaterial({ color: markColor, size: 9, sizeAttenuation: false }));
        this.marks.add(onTop(dots));
        const start = vector(finding.position);
        const length = Math.max(finding.depth ?? 0, 0.5 * radiusOf(this.report, finding));
        if (finding.normal) this.marks.add(onTop(arrow(start, vector(finding.normal), length)));
        if (finding.points.length === 2 && !finding.normal)
            this.marks.add(onTop(new LineSegments(geometry, new LineBasicMaterial({ color: markColor }))));
        if (finding.depth !== undefined)
            this.addLabel(rounded(finding.depth), "mark", () =>
                finding.normal ? start.clone().addScaledVector(vector(finding.normal), 1.4 * length) : start.clone(),
            );
    }

    /** Looks at the finding from the side, so that the normal is not foreshortened, and from above. */
    private turnTo(finding: Finding): void {
        const up = this.camera.up;
        const normal = finding.normal ? vector(finding.normal) : undefined;
        let side = normal ? up.clone().cross(normal) : new Vector3(0.5, 0.3, 1);
        if (side.length() < 0.3) side = new Vector3(up.z, up.x, up.y);
        // Of both sides the one that files show first: the front is +z, or -y where z is up.
        if (side.z - side.y < 0) side.negate();
        const direction = side.normalize().addScaledVector(up, 0.45).normalize();
        if (normal) direction.addScaledVector(normal, 0.35).normalize();
        this.look(vector(finding.position), direction, 1.6 * radiusOf(this.report, finding));
    }

    private showAll(): void {
        const low = new Vector3(Infinity, Infinity, Infinity);
        const high = low.clone().negate();
        for (const { data } of this.shown) {
            low.min(vector(data.box));
            high.max(vector(data.box.slice(3)));
        }
        if (this.shown.length === 0) low.copy(high.set(0, 0, 0));
        const front = Math.abs(this.camera.up.z) > 0.5 ? new Vector3(0, -1, 0) : new Vector3(0, 0, 1);
        const side = this.camera.up.clone().cross(front);
        const direction = front.addScaledVector(side, 0.6).addScaledVector(this.camera.up, 0.5).normalize();
        this.look(low.clone().add(high).multiplyScalar(0.5), direction, Math.max(low.distanceTo(high) / 2, 1e-6));
    }

    private look(at: Vector3, direction: Vector3, radius: number): void {
        const distance = radius / Math.sin((this.camera.fov * Math.PI) / 360);
        this.controls.target.copy(at);
        this.camera.position.copy(at).addScaledVector(direction, distance);
        this.camera.near = distance / 1000;
        this.camera.far = distance * 1000;
        this.camera.updateProjectionMatrix();
        this.controls.update();
        this.draw();
    }

    private resize(): void {
        const { clientWidth, clientHeight } = this.element;
        if (clientWidth === 0 || clientHeight === 0) return;
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    /** Draws once before the next refresh of the screen. */
    private draw(): void {
        this.pending ||= requestAnimationFrame(() => {
            this.pending = 0;
            this.renderer.render(this.scene, this.camera);
            this.placeLabels();
        });
    }

    private placeLabels(): void {
        const { clientWidth, clientHeight } = this.element;
        for (const { element, at } of this.named) {
            const place = at().project(this.camera);
            // A name stays in sight when its object is wider than the picture.
            const x = Math.min(Math.max((place.x + 1) / 2, 0.12), 0.88) * clientWidth;
            const y = Math.min(Math.max((1 - place.y) / 2, 0.06), 0.94) * clientHeight;
            element.style.transform = `translate(-50%, -50%) translate(${x}px, ${y}px)`;
            element.hidden = place.z > 1;
        }
    }
}
