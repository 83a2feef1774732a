// A pane of the plane, drawn by the browser's canvas.

import type { Abut } from "../library";
import { replay, type Drawing, type Numbers, type Palette, type Style } from "./drawing";
import { isGrabbed, Knobs, Redraw, type Handle, type Pane } from "./pane";
import { Pointers, Tap } from "./pointers";
import { isSoftware } from "./software";

export class Pane2 implements Pane {
    readonly dimension = 2;
    readonly element = document.createElement("div");
    onPress: Pane["onPress"] = null;
    onTap: Pane["onTap"] = null;
    /** For exhibits with pictures of their own, which lie under the rest. `place` returns pixels. */
    underlay: ((pen: CanvasRenderingContext2D, place: (at: Numbers) => [number, number]) => void) | null = null;
    private readonly canvas = document.createElement("canvas");
    private readonly knobs: Knobs;
    private readonly redraw = new Redraw(() => this.paint());
    private readonly observer = new ResizeObserver(() => this.resize());
    private readonly pointers: Pointers;
    private handles: readonly Handle[] = [];
    private body: (drawing: Drawing) => void = () => {};
    private center: [number, number];
    private reach: number;
    private fitted: readonly [Numbers, Numbers] | null = null;
    private width = 1;
    private height = 1;

    constructor(
        private readonly abut: Abut,
        private readonly palette: Palette,
        title: string,
        center: readonly number[] = [0, 0],
        reach = 5,
    ) {
        this.center = [center[0] ?? 0, center[1] ?? 0];
        this.reach = reach;
        this.element.className = "pane";
        this.canvas.setAttribute("role", "img");
        this.canvas.setAttribute("aria-label", title);
        const caption = document.createElement("h2");
        caption.textContent = title;
        this.element.append(this.canvas, caption);
        this.knobs = new Knobs(this.element, () => ({ right: [1, 0], up: [0, 1], towards: [0, 0], unit: 4 * this.pixel() }));
        this.pointers = new Pointers(this.element, {
            down: (x, y) => this.down(x, y),
            zoom: (factor, x, y) => this.zoom(factor, x, y),
            turn: (angle) => this.knobs.focused()?.turn?.(angle, []),
        });
        this.observer.observe(this.element);
    }

    draw(handles: readonly Handle[], body: (drawing: Drawing) => void): void {
        this.handles = handles;
        this.body = body;
        this.redraw.cancel();
        this.paint();
    }
    shown(): { min: number[]; max: number[] } {
        const half = [(this.reach * this.width) / this.height, this.reach] as const;
        return { min: [this.center[0] - half[0], this.center[1] - half[1]], max: [this.center[0] + half[0], this.center[1] + half[1]] };
    }
    pixel(): number {
        return (2 * this.reach) / this.height;
    }
    fit(min: Numbers, max: Numbers): void {
        this.fitted = [min, max];
        const size = [0, 1].map((i) => Math.max((max[i] ?? 0) - (min[i] ?? 0), 1e-6));
        this.center = [((min[0] ?? 0) + (max[0] ?? 0)) / 2, ((min[1] ?? 0) + (max[1] ?? 0)) / 2];
        this.reach = 0.6 * Math.max(size[1] ?? 1, ((size[0] ?? 1) * this.height) / this.width);
        this.redraw.request();
    }
    dispose(): void {
        this.observer.disconnect();
        this.redraw.cancel();
        this.pointers.dispose();
        this.element.remove();
    }

    private toWorld(x: number, y: number): [number, number] {
        return [this.center[0] + (x - this.width / 2) * this.pixel(), this.center[1] - (y - this.height / 2) * this.pixel()];
    }
    private toPixels(at: Numbers): [number, number] {
        return [this.width / 2 + ((at[0] ?? 0) - this.center[0]) / this.pixel(), this.height / 2 - ((at[1] ?? 0) - this.center[1]) / this.pixel()];
    }

    /** What a press at a place takes in hand: a function for each later place. */
    private down(x: number, y: number): (x: number, y: number, last: boolean) => void {
        const at = this.toWorld(x, y);
        const handle = this.grabbed(at, 14 * this.pixel());
        if (handle) {
            this.knobs.focus(handle.id);
            const offset = [(handle.at[0] ?? 0) - at[0], (handle.at[1] ?? 0) - at[1]] as const;
            return (toX, toY) => {
                const to = this.toWorld(toX, toY);
                this.handles.find((one) => one.id === handle.id)?.move([to[0] + offset[0], to[1] + offset[1]]);
            };
        }
        if (this.onPress) {
            const press = this.onPress;
            press(at, "down");
            return (toX, toY, last) => press(this.toWorld(toX, toY), last ? "up" : "move");
        }
        const start = [...this.center] as const;
        const tap = new Tap(x, y);
        return (toX, toY, last) => {
            tap.move(toX, toY);
            if (tap.isOne(last)) this.onTap?.(at);
            if (!tap.hasMoved) return;
            this.fitted = null;
            this.center = [start[0] - (toX - x) * this.pixel(), start[1] + (toY - y) * this.pixel()];
            this.redraw.request();
        };
    }
    private grabbed(at: [number, number], reach: number): Handle | undefined {
        const far = (handle: Handle): number => Math.hypot((handle.at[0] ?? 0) - at[0], (handle.at[1] ?? 0) - at[1]);
        const near = this.handles.filter((handle) => far(handle) <= reach).sort((a, b) => far(a) - far(b))[0];
        return near ?? this.handles.find((handle) => handle.shape !== undefined && isGrabbed(this.abut, handle.shape, at, 0.5 * reach));
    }

    private zoom(factor: number, x: number, y: number): void {
        const before = this.toWorld(x, y);
        this.fitted = null;
        this.reach = Math.min(Math.max(this.reach / factor, 1e-3), 1e6);
        const after = this.toWorld(x, y);
        this.center = [this.center[0] + before[0] - after[0], this.center[1] + before[1] - after[1]];
        this.redraw.request();
    }
    private resize(): void {
        const isFirst = this.width === 1;
        this.width = Math.max(this.element.clientWidth, 1);
        this.height = Math.max(this.element.clientHeight, 1);
        // The reach that was wished for is that of the smaller side.
        if (isFirst) this.reach *= Math.max(1, this.height / this.width);
        const ratio = Math.min(devicePixelRatio, 2);
        this.canvas.width = Math.round(this.width * ratio);
        this.canvas.height = Math.round(this.height * ratio);
        if (this.fitted) this.fit(...this.fitted);
        this.paint();
    }

    private paint(): void {
        // The processor draws a canvas that is read back faster than one that a software graphics card has.
        const pen = this.canvas.getContext("2d", { alpha: false, willReadFrequently: isSoftware() });
        if (!pen) return;
        const ratio = this.canvas.width / this.width;
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        pen.fillStyle = this.palette.css("back");
        pen.fillRect(0, 0, this.width, this.height);
        this.grid(pen);
        this.underlay?.(pen, (at) => this.toPixels(at));
        this.body(new CanvasDrawing(pen, this.palette, (at, i) => this.toPixels([at[i] ?? 0, at[i + 1] ?? 0])));
        this.knobs.show(this.handles, (at) => this.toPixels(at));
    }
    /** Lines a power of ten apart, and the axes. */
    private grid(pen: CanvasRenderingContext2D): void {
        const { min, max } = this.shown();
        const unit = 10 ** Math.floor(Math.log10(this.reach * 0.8));
        for (const axis of [0, 1] as const)
            for (let i = Math.ceil((min[axis] ?? 0) / unit); i * unit <= (max[axis] ?? 0); ++i) {
                const from = this.toPixels(axis === 0 ? [i * unit, min[1] ?? 0] : [min[0] ?? 0, i * unit]);
                const to = this.toPixels(axis === 0 ? [i * unit, max[1] ?? 0] : [max[0] ?? 0, i * unit]);
                pen.beginPath();
                pen.moveTo(from[0], from[1]);
                pen.lineTo(to[0], to[1]);
                pen.lineWidth = i === 0 ? 1.5 : 1;
                pen.strokeStyle = this.palette.css("grid");
                pen.stroke();
            }
    }
}

/** For exhibits that draw on the canvas themselves. */
export function asPane2(pane: Pane | undefined): Pane2 {
    if (pane instanceof Pane2) return pane;
    throw new TypeError("the pane is none of the plane");
}

/** Draws on a canvas of the browser; `pixels` places the point that begins at an index. */
class CanvasDrawing implements Drawing {
    readonly dimension = 2;
    constructor(
        private readonly pen: CanvasRenderingContext2D,
        private readonly palette: Palette,
        private readonly pixels: (points: Numbers, index: number) => [number, number],
    ) {}

    line(points: Numbers, style: Style): void {
        this.path(points);
        this.stroke(style);
    }
    segments(points: Numbers, style: Style): void {
        this.pen.beginPath();
        for (let i = 0; i + 3 < points.length; i += 4) {
            this.pen.moveTo(...this.pixels(points, i));
            this.pen.lineTo(...this.pixels(points, i + 2));
        }
        this.stroke(style);
    }
    polygon(points: Numbers, style: Style): void {
        this.path(points);
        this.pen.closePath();
        if (style.fill) {
            this.pen.globalAlpha = style.fill;
            this.pen.fillStyle = this.palette.css(style.color);
            this.pen.fill();
        }
        this.stroke(style);
    }
    triangles(points: Numbers, indices: Numbers, style: Style): void {
        this.pen.beginPath();
        for (let i = 0; i + 2 < indices.length; i += 3) {
            this.pen.moveTo(...this.pixels(points, 2 * (indices[i] ?? 0)));
            this.pen.lineTo(...this.pixels(points, 2 * (indices[i + 1] ?? 0)));
            this.pen.lineTo(...this.pixels(points, 2 * (indices[i + 2] ?? 0)));
            this.pen.closePath();
        }
        this.pen.globalAlpha = style.fill ?? 1;
        this.pen.fillStyle = this.palette.css(style.color);
        this.pen.fill();
        this.pen.globalAlpha = 1;
    }
    point(at: Numbers, style: Style): void {
        const [x, y] = this.pixels(at, 0);
        this.pen.beginPath();
        this.pen.arc(x, y, 2.5 + (style.width ?? 1.5), 0, 2 * Math.PI);
        this.pen.globalAlpha = style.alpha ?? 1;
        this.pen.fillStyle = this.palette.css(style.color);
        this.pen.fill();
        this.pen.globalAlpha = 1;
    }
    arrow(from: Numbers, to: Numbers, style: Style): void {
        const [x, y] = this.pixels(to, 0);
        const [fromX, fromY] = this.pixels(from, 0);
        const length = Math.hypot(x - fromX, y - fromY);
        this.line([...Array.from(from), ...Array.from(to)], style);
        if (length < 1e-6) return;
        const size = Math.min(length, 9 + (style.width ?? 1.5));
        const along = [((x - fromX) / length) * size, ((y - fromY) / length) * size] as const;
        this.pen.beginPath();
        this.pen.moveTo(x, y);
        this.pen.lineTo(x - along[0] + 0.45 * along[1], y - along[1] - 0.45 * along[0]);
        this.pen.lineTo(x - along[0] - 0.45 * along[1], y - along[1] + 0.45 * along[0]);
        this.pen.closePath();
        this.pen.fillStyle = this.palette.css(style.color);
        this.pen.fill();
    }
    text(at: Numbers, text: string, style: Style, [right, up]: readonly [number, number] = [0, 0]): void {
        const [atX, atY] = this.pixels(at, 0);
        const [x, y] = [atX + right, atY - up];
        this.pen.font = "600 13px system-ui, sans-serif";
        this.pen.textAlign = "center";
        this.pen.textBaseline = "middle";
        this.pen.lineWidth = 4;
        this.pen.strokeStyle = this.palette.css("back");
        this.pen.setLineDash([]);
        this.pen.strokeText(text, x, y);
        this.pen.fillStyle = this.palette.css(style.color);
        this.pen.fillText(text, x, y);
    }
    commands(commands: Float32Array, style: Style): void {
        replay(this, commands, style);
    }

    private path(points: Numbers): void {
        this.pen.beginPath();
        for (let i = 0; i + 1 < points.length; i += 2) {
            const [x, y] = this.pixels(points, i);
            if (i === 0) this.pen.moveTo(x, y);
            else this.pen.lineTo(x, y);
        }
    }
    private stroke(style: Style): void {
        if (style.width === 0) return;
        this.pen.globalAlpha = style.alpha ?? 1;
        this.pen.lineWidth = style.width ?? 1.5;
        this.pen.lineJoin = "round";
        this.pen.setLineDash(style.dashed ? [6, 4] : []);
        this.pen.strokeStyle = this.palette.css(style.color);
        this.pen.stroke();
        this.pen.globalAlpha = 1;
    }
}
