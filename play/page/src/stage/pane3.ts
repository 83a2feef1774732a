// A pane of space, drawn by three.js. The left button or one finger turns the view, the right button or two fingers move it.

import { ColorManagement, LinearSRGBColorSpace, Scene, Vector3, WebGLRenderer } from "three";
import type { Abut } from "../library";
import { Camera } from "./camera";
import type { Drawing, Numbers, Palette } from "./drawing";
import { Drawing3 } from "./drawing3";
import { Knobs, Redraw, type Handle, type Pane } from "./pane";
import { Pointers, Tap } from "./pointers";
import { isSoftware } from "./software";

// Colours of the style sheet go to the screen as they are.
ColorManagement.enabled = false;

export class Pane3 implements Pane {
    readonly dimension = 3;
    readonly element = document.createElement("div");
    onPress: Pane["onPress"] = null;
    onTap: Pane["onTap"] = null;
    /** For exhibits with things of their own: shaders, instances. They are drawn with the rest. */
    readonly scene = new Scene();
    readonly renderer: WebGLRenderer;
    readonly camera: Camera;
    private readonly drawing: Drawing3;
    private readonly labels = document.createElement("div");
    private readonly knobs: Knobs;
    private readonly redraw = new Redraw(() => this.render());
    private readonly observer = new ResizeObserver(() => this.resize());
    private readonly pointers: Pointers;
    private handles: readonly Handle[] = [];
    private fitted: readonly [Numbers, Numbers] | null = null;
    private wasSized = false;

    constructor(
        private readonly abut: Abut,
        private readonly palette: Palette,
        title: string,
        center: readonly number[] = [0, 0, 0],
        reach = 4,
    ) {
        this.renderer = new WebGLRenderer({ antialias: !isSoftware(), alpha: false });
        this.renderer.outputColorSpace = LinearSRGBColorSpace;
        this.renderer.setPixelRatio(isSoftware() ? 1 : Math.min(devicePixelRatio, 2));
        this.camera = new Camera(center, reach);
        this.drawing = new Drawing3(palette);
        this.scene.add(...this.drawing.objects);
        this.element.className = "pane";
        const canvas = this.renderer.domElement;
        canvas.setAttribute("role", "img");
        canvas.setAttribute("aria-label", title);
        const caption = document.createElement("h2");
        caption.textContent = title;
        this.labels.className = "labels";
        this.labels.setAttribute("aria-hidden", "true");
        this.element.append(canvas, caption, this.labels);
        this.knobs = new Knobs(this.element, () => {
            const { right, up, towards } = this.camera.axes();
            return { right: right.toArray(), up: up.toArray(), towards: towards.toArray(), unit: 4 * this.pixel() };
        });
        this.pointers = new Pointers(this.element, {
            down: (x, y, button) => this.down(x, y, button),
            zoom: (factor) => {
                this.fitted = null;
                this.camera.zoom(factor);
                this.redraw.request();
            },
            turn: (angle) => this.knobs.focused()?.turn?.(angle, this.camera.axes().towards.toArray()),
        });
        this.element.addEventListener("contextmenu", (event) => event.preventDefault());
        this.observer.observe(this.element);
    }

    draw(handles: readonly Handle[], body: (drawing: Drawing) => void): void {
        this.handles = handles;
        if (!this.wasSized) this.resize();
        this.drawing.begin();
        body(this.drawing);
        this.drawing.end();
        this.redraw.cancel();
        this.render();
    }
    shown(): { min: number[]; max: number[] } {
        const { target, reach } = this.camera;
        const half = 2 * reach;
        return { min: target.toArray().map((x) => x - half), max: target.toArray().map((x) => x + half) };
    }
    pixel(): number {
        return this.camera.pixel();
    }
    fit(min: Numbers, max: Numbers): void {
        this.fitted = [min, max];
        this.camera.fit(min, max);
        this.redraw.request();
    }
    dispose(): void {
        this.observer.disconnect();
        this.redraw.cancel();
        this.pointers.dispose();
        this.drawing.dispose();
        this.renderer.dispose();
        this.renderer.forceContextLoss();
        this.element.remove();
    }

    private down(x: number, y: number, button: number): (x: number, y: number, last: boolean) => void {
        const handle = button === 0 ? this.grabbed(x, y) : undefined;
        if (handle) {
            this.knobs.focus(handle.id);
            const start = new Vector3(handle.at[0], handle.at[1], handle.at[2]);
            const offset = start.clone().sub(this.camera.onPlane(x, y, start));
            return (toX, toY) => {
                const to = this.camera.onPlane(toX, toY, start).add(offset);
                this.handles.find((one) => one.id === handle.id)?.move(to.toArray());
            };
        }
        if (this.onPress && button === 0) {
            const press = this.onPress;
            const at = (px: number, py: number): number[] => this.camera.onPlane(px, py, this.camera.target).toArray();
            press(at(x, y), "down");
            return (toX, toY, last) => press(at(toX, toY), last ? "up" : "move");
        }
        let before = [x, y] as const;
        const tap = new Tap(x, y);
        return (toX, toY, last) => {
            tap.move(toX, toY);
            if (tap.isOne(last)) this.onTap?.(this.camera.onPlane(x, y, this.camera.target).toArray());
            if (!tap.hasMoved) return;
            this.fitted = null;
            const [right, up] = [toX - before[0], toY - before[1]];
            before = [toX, toY];
            if (button === 2) this.camera.pan(right * this.pixel(), -up * this.pixel());
            else this.camera.orbit(0.008 * right, 0.008 * up);
            this.redraw.request();
        };
    }
    private grabbed(x: number, y: number): Handle | undefined {
        const far = (handle: Handle): number => {
            const at = this.camera.toPixels(handle.at);
            return at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
        };
        const near = this.handles.filter((handle) => far(handle) <= 14).sort((a, b) => far(a) - far(b))[0];
        if (near) return near;
        const { origin, direction } = this.camera.ray(x, y);
        const ray = { origin: origin.toArray(), direction: direction.toArray(), length: this.camera.three.far };
        const hits = this.handles.flatMap((handle) => {
            if (handle.shape === undefined) return [];
            const hit = this.abut.raycast(ray as never, handle.shape as never) as { distance: number } | null;
            return hit ? [{ handle, distance: hit.distance }] : [];
        });
        return hits.sort((a, b) => a.distance - b.distance)[0]?.handle;
    }

    private resize(): void {
        const { clientWidth, clientHeight } = this.element;
        if (clientWidth === 0 || clientHeight === 0) return;
        this.renderer.setSize(clientWidth, clientHeight, false);
        // The reach that was wished for is that of the smaller side.
        if (!this.wasSized) this.camera.zoom(Math.min(1, clientWidth / clientHeight));
        this.wasSized = true;
        this.camera.resize(clientWidth, clientHeight);
        if (this.fitted) this.fit(...this.fitted);
        this.render();
    }
    private showLabels(): void {
        const { labels } = this.drawing;
        while (this.labels.children.length > labels.length) this.labels.lastElementChild?.remove();
        labels.forEach(({ at, text, color, shift }, i) => {
            const element = (this.labels.children[i] as HTMLElement | undefined) ?? this.labels.appendChild(document.createElement("span"));
            const place = this.camera.toPixels(at);
            element.hidden = place === null;
            if (!place) return;
            if (element.textContent !== text) element.textContent = text;
            if (element.style.color !== color) element.style.color = color;
            element.style.transform = `translate(-50%, -50%) translate(${(place[0] + shift[0]).toFixed(1)}px, ${(place[1] - shift[1]).toFixed(1)}px)`;
        });
    }
    private render(): void {
        this.renderer.setClearColor(this.palette.css("back"));
        this.drawing.resize(this.camera);
        this.renderer.render(this.scene, this.camera.three);
        this.showLabels();
        this.knobs.show(this.handles, (at) => this.camera.toPixels(at));
    }
}

/** For exhibits that draw with three.js themselves. */
export function asPane3(pane: Pane | undefined): Pane3 {
    if (pane instanceof Pane3) return pane;
    throw new TypeError("the pane is none of space");
}
