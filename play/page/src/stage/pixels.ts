// A picture made pixel by pixel: for thousands of things at once, which the browser's canvas draws too slowly.

import type { Numbers } from "./drawing";

/** As in memory: red, green, blue and opacity. */
export type PixelColor = number;

export function pixelColor([red, green, blue]: readonly [number, number, number], opacity: number): PixelColor {
    const byte = (value: number): number => Math.round(255 * value) & 255;
    return ((byte(opacity) << 24) | (byte(blue) << 16) | (byte(green) << 8) | byte(red)) >>> 0;
}

export class Pixels {
    private readonly canvas = document.createElement("canvas");
    private image = new ImageData(1, 1);
    private words = new Uint32Array(this.image.data.buffer);
    private left = 0;
    private top = 0;
    private scale = 1;
    /** Of lines, in pixels. */
    private thickness = 1;

    /** Clears the picture. It covers the canvas of the pen; `place` is that of an underlay. */
    begin(pen: CanvasRenderingContext2D, place: (at: Numbers) => [number, number]): void {
        const { width, height } = pen.canvas;
        if (this.image.width !== width || this.image.height !== height) {
            this.image = new ImageData(width, height);
            this.words = new Uint32Array(this.image.data.buffer);
            Object.assign(this.canvas, { width, height });
        } else this.words.fill(0);
        const ratio = pen.getTransform().a;
        const origin = place([0, 0]);
        this.left = ratio * origin[0];
        this.top = ratio * origin[1];
        this.scale = ratio * (place([1, 0])[0] - origin[0]);
        this.thickness = Math.max(1, Math.round(ratio));
    }
    /** Draws the picture. */
    end(pen: CanvasRenderingContext2D): void {
        this.canvas.getContext("2d")?.putImageData(this.image, 0, 0);
        pen.save();
        pen.resetTransform();
        pen.drawImage(this.canvas, 0, 0);
        pen.restore();
    }

    /** The area of a box of the world. */
    fill(minX: number, minY: number, maxX: number, maxY: number, color: PixelColor): void {
        this.rectangle(this.x(minX), this.y(maxY), this.x(maxX), this.y(minY), color);
    }
    /** The border of a box of the world. */
    border(minX: number, minY: number, maxX: number, maxY: number, color: PixelColor, width = 1): void {
        const [left, top, right, bottom] = [this.x(minX), this.y(maxY), this.x(maxX), this.y(minY)];
        const size = width * this.thickness;
        this.rectangle(left, top, right, top + size, color);
        this.rectangle(left, bottom - size, right, bottom, color);
        this.rectangle(left, top, left + size, bottom, color);
        this.rectangle(right - size, top, right, bottom, color);
    }
    /** A line of the world. */
    line(fromX: number, fromY: number, toX: number, toY: number, color: PixelColor, width = 1): void {
        const [x, y, endX, endY] = [this.x(fromX), this.y(fromY), this.x(toX), this.y(toY)];
        const size = width * this.thickness;
        if (x === endX || y === endY) {
            this.rectangle(Math.min(x, endX), Math.min(y, endY), Math.max(x, endX) + size, Math.max(y, endY) + size, color);
            return;
        }
        const steps = Math.min(Math.max(Math.abs(endX - x), Math.abs(endY - y)), 1e4);
        for (let i = 0; i <= steps; ++i) {
            const [atX, atY] = [Math.round(x + ((endX - x) * i) / steps), Math.round(y + ((endY - y) * i) / steps)];
            this.rectangle(atX, atY, atX + size, atY + size, color);
        }
    }
    /** A circle of the world. */
    ring(x: number, y: number, radius: number, color: PixelColor): void {
        const [atX, atY, size] = [this.left + this.scale * x, this.top - this.scale * y, this.scale * radius];
        if (atX + size < 0 || atY + size < 0 || atX - size > this.image.width || atY - size > this.image.height) return;
        const steps = Math.min(Math.max(Math.ceil(6.3 * size), 8), 4000);
        const [cosine, sine] = [Math.cos((2 * Math.PI) / steps), Math.sin((2 * Math.PI) / steps)];
        let [right, up] = [size, 0];
        for (let i = 0; i < steps; ++i) {
            const pixelX = Math.round(atX + right);
            const pixelY = Math.round(atY + up);
            this.rectangle(pixelX, pixelY, pixelX + this.thickness, pixelY + this.thickness, color);
            const turned = cosine * right - sine * up;
            up = sine * right + cosine * up;
            right = turned;
        }
    }

    private x(value: number): number {
        return Math.round(this.left + this.scale * value);
    }
    private y(value: number): number {
        return Math.round(this.top - this.scale * value);
    }
    /** In pixels; at least one wide and high. */
    private rectangle(left: number, top: number, right: number, bottom: number, color: PixelColor): void {
        const { width, height } = this.image;
        const [begin, end] = [Math.max(left, 0), Math.min(Math.max(right, left + 1), width)];
        const last = Math.min(Math.max(bottom, top + 1), height);
        if (begin >= end) return;
        for (let row = Math.max(top, 0); row < last; ++row) {
            const stop = row * width + end;
            // A call of `fill` takes longer than a few pixels.
            if (end - begin > 32) this.words.fill(color, row * width + begin, stop);
            else for (let i = row * width + begin; i < stop; ++i) this.words[i] = color;
        }
    }
}
