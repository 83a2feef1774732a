// The view in the plane. y points down, as in the files.

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
    type View,
} from "./report";

type Point = readonly [number, number];

/** The outline of an object as a path: lines that meet are joined, so that an area can be filled. */
function pathOf(object: SceneObject): Path2D {
    const path = new Path2D();
    if (!object.mesh) {
        const [x0 = 0, y0 = 0, x1 = 0, y1 = 0] = object.box;
        path.rect(x0, y0, x1 - x0, y1 - y0);
        return path;
    }
    const points = pointsOf(object.mesh);
    const lines = new Uint32Array(bytesOf(object.mesh.elements));
    const next = new Map<number, number[]>();
    const starts: number[] = [];
    for (let i = 0; i + 1 < lines.length; i += 2) {
        const from = lines[i] ?? 0;
        const ends = next.get(from);
        if (ends) ends.push(lines[i + 1] ?? 0);
        else next.set(from, [lines[i + 1] ?? 0]);
        starts.push(from);
    }
    for (const start of starts) {
        let at = next.get(start)?.pop();
        if (at === undefined) continue;
        path.moveTo(points[2 * start] ?? 0, points[2 * start + 1] ?? 0);
        while (at !== undefined) {
            path.lineTo(points[2 * at] ?? 0, points[2 * at + 1] ?? 0);
            at = next.get(at)?.pop();
        }
    }
    return path;
}

export class View2 implements View {
    readonly element = document.createElement("div");
    private readonly canvas = document.createElement("canvas");
    private readonly labels = document.createElement("div");
    private readonly paths: readonly Path2D[];
    private finding: Finding | undefined;
    private center: Point = [0, 0];
    private radius = 1;
    private pending = 0;
    private readonly observer = new ResizeObserver(() => this.draw());

    constructor(private readonly report: Report) {
        this.element.className = "canvas";
        this.labels.className = "labels";
        this.labels.setAttribute("aria-hidden", "true");
        this.element.append(this.canvas, this.labels);
        this.paths = report.objects.map(pathOf);
        this.canvas.addEventListener("pointermove", (event) => {
            if (event.buttons !== 1) return;
            const scale = this.scale();
            this.center = [this.center[0] - event.movementX / scale, this.center[1] - event.movementY / scale];
            this.draw();
        });
        this.canvas.addEventListener("wheel", (event) => {
            event.preventDefault();
            this.zoom(Math.exp(-event.deltaY / 500));
        });
        this.observer.observe(this.element);
        this.show(undefined);
    }

    show(finding: Finding | undefined): void {
        this.finding = finding;
        if (finding) {
            this.center = [finding.position[0] ?? 0, finding.position[1] ?? 0];
            this.radius = 1.5 * radiusOf(this.report, finding);
        } else {
            const low = [Infinity, Infinity];
            const high = [-Infinity, -Infinity];
            for (const { box } of this.report.objects)
                for (const axis of [0, 1]) {
                    low[axis] = Math.min(low[axis] ?? 0, box[axis] ?? 0);
                    high[axis] = Math.max(high[axis] ?? 0, box[2 + axis] ?? 0);
                }
            const [x0 = 0, y0 = 0] = low;
            const [x1 = 0, y1 = 0] = high;
            this.center = this.report.objects.length > 0 ? [(x0 + x1) / 2, (y0 + y1) / 2] : [0, 0];
            this.radius = Math.max(Math.hypot(x1 - x0, y1 - y0) / 2, 1e-6) || 1;
        }
        this.draw();
    }

    setTime(): void {}

    zoom(factor: number): void {
        this.radius /= factor;
        this.draw();
    }

    turn(x: number, y: number): void {
        this.center = [this.center[0] + 0.2 * x * this.radius, this.center[1] - 0.2 * y * this.radius];
        this.draw();
    }

    dispose(): void {
        this.observer.disconnect();
        cancelAnimationFrame(this.pending);
    }

    /** Pixels a unit. */
    private scale(): number {
        return Math.min(this.element.clientWidth, this.element.clientHeight) / (2 * this.radius);
    }

    private draw(): void {
        this.pending ||= requestAnimationFrame(() => {
            this.pending = 0;
            this.drawNow();
        });
    }

    private drawNow(): void {
        const { clientWidth, clientHeight } = this.element;
        const pixels = Math.min(devicePixelRatio, 2);
        this.canvas.width = clientWidth * pixels;
        this.canvas.height = clientHeight * pixels;
        const context = this.canvas.getContext("2d");
        if (!context) return;
        const scale = this.scale();
        const [x, y] = this.center;
        context.setTransform(
            scale * pixels, 0, 0, scale * pixels,
            (clientWidth / 2 - x * scale) * pixels, (clientHeight / 2 - y * scale) * pixels,
        );
        const parties = this.finding?.parties ?? [];
        const involved = new Set(parties.flat());
        this.paths.forEach((_, i) => {
            if (!involved.has(i)) this.drawObject(context, i, "#94a3b8", 1 / scale);
        });
        this.labels.replaceChildren();
        parties.forEach((party, i) => {
            const color = partyColors[i % 2] ?? markColor;
            for (const index of party) this.drawObject(context, index, color, 2 / scale);
            const object = this.report.objects[party[0] ?? -1];
            if (!object) return;
            const [x0 = 0, y0 = 0, x1 = 0, y1 = 0] = object.box;
            this.addLabel(lastName(object.name), `party${i % 2}`, [(x0 + x1) / 2, (y0 + y1) / 2]);
        });
        if (this.finding) this.mark(context, this.finding, 1 / scale);
    }

    private drawObject(context: CanvasRenderingContext2D, index: number, color: string, width: number): void {
        const path = this.paths[index];
        const object = this.report.objects[index];
        if (!path || !object) return;
        context.lineWidth = width;
        context.strokeStyle = color;
        context.fillStyle = color;
        if (object.mesh?.filled) {
            context.globalAlpha = 0.25;
            context.fill(path, "evenodd");
        }
        context.globalAlpha = object.mesh ? 1 : 0.4;
        context.stroke(path);
        context.globalAlpha = 1;
    }

    private mark(context: CanvasRenderingContext2D, finding: Finding, pixel: number): void {
        context.strokeStyle = context.fillStyle = markColor;
        context.lineWidth = 2 * pixel;
        const places = finding.points.length > 0 ? finding.points : [finding.position];
        for (const [x = 0, y = 0] of places) {
            context.beginPath();
            context.arc(x, y, 5 * pixel, 0, 2 * Math.PI);
            context.fill();
        }
        const [x = 0, y = 0] = finding.position;
        const [nx = 0, ny = 0] = finding.normal ?? [];
        const length = Math.max(finding.depth ?? 0, 0.35 * this.radius);
        context.beginPath();
        if (finding.normal) {
            const [tx, ty] = [x + length * nx, y + length * ny];
            const head = 0.2 * length;
            context.moveTo(x, y);
            context.lineTo(tx, ty);
            context.moveTo(tx - head * (nx + 0.5 * ny), ty - head * (ny - 0.5 * nx));
            context.lineTo(tx, ty);
            context.lineTo(tx - head * (nx - 0.5 * ny), ty - head * (ny + 0.5 * nx));
        } else if (finding.points.length === 2) {
            const [a = [], b = []] = finding.points;
            context.moveTo(a[0] ?? 0, a[1] ?? 0);
            context.lineTo(b[0] ?? 0, b[1] ?? 0);
        }
        context.stroke();
        if (finding.depth !== undefined)
            this.addLabel(rounded(finding.depth), "mark", [x + 1.15 * length * nx, y + 1.15 * length * ny]);
    }

    private addLabel(text: string, className: string, at: Point): void {
        const { clientWidth, clientHeight } = this.element;
        const scale = this.scale();
        const inside = (value: number, size: number): number => Math.min(Math.max(value, 0.08 * size), 0.92 * size);
        const x = inside(clientWidth / 2 + (at[0] - this.center[0]) * scale, clientWidth);
        const y = inside(clientHeight / 2 + (at[1] - this.center[1]) * scale, clientHeight);
        const element = label(text, className);
        element.style.transform = `translate(-50%, -50%) translate(${x}px, ${y}px)`;
        this.labels.append(element);
    }
}
