// A view of the stage with things to take in hand: what panes of the plane and of space share.

import type { Abut } from "../library";
import type { Drawing, Numbers } from "./drawing";

/** A thing that can be dragged, turned and scaled by mouse, touch and keys. */
export interface Handle {
    /** Stays the same from frame to frame. */
    readonly id: string;
    /** Read to those who can't see it. */
    readonly label: string;
    /** Where its knob is shown. */
    readonly at: Numbers;
    /** What can be grabbed besides the knob: any shape of the library. */
    readonly shape?: unknown;
    move(to: number[]): void;
    /** By an angle in radians; in space about the axis given, of length 1. */
    turn?(angle: number, axis: number[]): void;
    scale?(factor: number): void;
}

export interface Pane {
    readonly dimension: 2 | 3;
    readonly element: HTMLElement;
    /** Clears the pane, calls `body`, and shows what it has drawn. */
    draw(handles: readonly Handle[], body: (drawing: Drawing) => void): void;
    /** The visible part of the world: its lowest corner and its highest. In space a box around what is near the center. */
    shown(): { min: number[]; max: number[] };
    /** The size of one pixel at the center, in world units. */
    pixel(): number;
    /** Moves the view so that a box fills it, also when the pane changes its size, until the user moves the view. */
    fit(min: Numbers, max: Numbers): void;
    /** What a press on empty space does; `at` is on the plane through the center that faces the viewer. Null: the view moves. */
    onPress: ((at: number[], phase: "down" | "move" | "up") => void) | null;
    /** What a short press on empty space does, that moves neither a thing nor the view: `at` as above. */
    onTap: ((at: number[]) => void) | null;
    dispose(): void;
}

/** Draws again before the next refresh of the screen, however often it was wanted. */
export class Redraw {
    private pending = 0;
    constructor(private readonly body: () => void) {}
    request(): void {
        this.pending ||= requestAnimationFrame(() => {
            this.pending = 0;
            this.body();
        });
    }
    cancel(): void {
        cancelAnimationFrame(this.pending);
        this.pending = 0;
    }
}

/** The knobs of handles as buttons over the canvas: for keyboards, screen readers and tests. Returns what was focused. */
export class Knobs {
    private readonly buttons = new Map<string, HTMLButtonElement>();
    private handles: readonly Handle[] = [];

    constructor(
        private readonly parent: HTMLElement,
        private readonly step: () => { right: number[]; up: number[]; towards: number[]; unit: number },
    ) {}

    /** `place` returns pixels from the upper left corner, or null out of sight. */
    show(handles: readonly Handle[], place: (at: Numbers) => [number, number] | null): void {
        this.handles = handles;
        for (const [id, button] of this.buttons)
            if (!handles.some((handle) => handle.id === id)) {
                button.remove();
                this.buttons.delete(id);
            }
        for (const handle of handles) {
            const button = this.buttons.get(handle.id) ?? this.make(handle.id);
            const pixels = place(handle.at);
            if (button.title !== handle.label) {
                button.title = handle.label;
                button.setAttribute("aria-label", `${handle.label}: arrows move it${handle.turn ? ", Q and E turn it" : ""}${handle.scale ? ", plus and minus scale it" : ""}`);
            }
            button.hidden = pixels === null;
            if (pixels) button.style.transform = `translate(${pixels[0].toFixed(1)}px, ${pixels[1].toFixed(1)}px)`;
        }
    }

    /** The handle whose knob has the focus. */
    focused(): Handle | undefined {
        return this.handles.find((handle) => this.buttons.get(handle.id) === document.activeElement);
    }
    focus(id: string): void {
        this.buttons.get(id)?.focus({ preventScroll: true });
    }

    private make(id: string): HTMLButtonElement {
        const button = document.createElement("button");
        button.type = "button";
        button.className = "knob";
        button.dataset["handle"] = id;
        button.addEventListener("keydown", (event) => {
            const handle = this.handles.find((one) => one.id === id);
            if (handle && this.press(handle, event.key, event.shiftKey ? 5 : 1)) event.preventDefault();
        });
        this.parent.append(button);
        this.buttons.set(id, button);
        return button;
    }

    private press(handle: Handle, key: string, times: number): boolean {
        const { right, up, towards, unit } = this.step();
        const along = (direction: number[], sign: number): true => {
            handle.move(Array.from(handle.at, (x, i) => x + sign * times * unit * (direction[i] ?? 0)));
            return true;
        };
        switch (key) {
            case "ArrowLeft": return along(right, -1);
            case "ArrowRight": return along(right, 1);
            case "ArrowDown": return along(up, -1);
            case "ArrowUp": return along(up, 1);
            case "PageUp": return along(towards, -1);
            case "PageDown": return along(towards, 1);
            case "q": case "Q": handle.turn?.(0.02 * times, towards); return true;
            case "e": case "E": handle.turn?.(-0.02 * times, towards); return true;
            case "+": case "=": handle.scale?.(1 + 0.02 * times); return true;
            case "-": handle.scale?.(1 - 0.02 * times); return true;
            default: return false;
        }
    }
}

/** Whether a shape of the library holds a point of the plane; thin shapes and open ones within the reach of a pointer. */
export function isGrabbed(abut: Abut, shape: unknown, point: number[], reach: number): boolean {
    // The types of shapes are the library's own matter.
    const closest = abut.closest(shape as never, point as never) as { distance: number } | null;
    return closest !== null && closest.distance <= reach;
}
