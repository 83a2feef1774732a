// Mouse, touch and wheel of one element: one finger drags, two fingers zoom and turn.

export interface PointerActions {
    /** A press, in pixels from the upper left corner. Returns what follows the pointer until it is lifted. */
    down(x: number, y: number, button: number): (x: number, y: number, last: boolean) => void;
    zoom(factor: number, x: number, y: number): void;
    /** By an angle in radians, counterclockwise. */
    turn(angle: number): void;
}

export class Pointers {
    private readonly places = new Map<number, [number, number]>();
    private follow: ((x: number, y: number, last: boolean) => void) | null = null;
    private readonly end = new AbortController();

    constructor(
        private readonly element: HTMLElement,
        private readonly actions: PointerActions,
    ) {
        const options = { signal: this.end.signal };
        element.addEventListener("pointerdown", (event) => this.down(event), options);
        element.addEventListener("pointermove", (event) => this.move(event), options);
        for (const name of ["pointerup", "pointercancel"] as const) element.addEventListener(name, (event) => this.up(event), options);
        element.addEventListener("wheel", (event) => this.wheel(event), { ...options, passive: false });
    }
    dispose(): void {
        this.end.abort();
    }

    private place(event: MouseEvent): [number, number] {
        const frame = this.element.getBoundingClientRect();
        return [event.clientX - frame.left, event.clientY - frame.top];
    }
    private down(event: PointerEvent): void {
        const place = this.place(event);
        this.element.setPointerCapture(event.pointerId);
        this.places.set(event.pointerId, place);
        // A second finger ends the drag of the first.
        if (this.places.size === 1) this.follow = this.actions.down(place[0], place[1], event.button);
        else this.release(place);
        event.preventDefault();
    }
    private move(event: PointerEvent): void {
        const before = this.places.get(event.pointerId);
        if (!before) return;
        const place = this.place(event);
        if (this.places.size === 2) this.pinch(event.pointerId, before, place);
        else this.follow?.(place[0], place[1], false);
        this.places.set(event.pointerId, place);
    }
    private up(event: PointerEvent): void {
        this.places.delete(event.pointerId);
        this.release(this.place(event));
    }
    private release(place: [number, number]): void {
        this.follow?.(place[0], place[1], true);
        this.follow = null;
    }
    private pinch(id: number, before: [number, number], after: [number, number]): void {
        const other = [...this.places].find(([one]) => one !== id)?.[1];
        if (!other) return;
        const from = [before[0] - other[0], before[1] - other[1]] as const;
        const to = [after[0] - other[0], after[1] - other[1]] as const;
        const lengths = [Math.hypot(...from), Math.hypot(...to)] as const;
        if (lengths[0] < 1 || lengths[1] < 1) return;
        this.actions.zoom(lengths[1] / lengths[0], (after[0] + other[0]) / 2, (after[1] + other[1]) / 2);
        // Pixels grow downwards.
        this.actions.turn(-Math.atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]));
    }
    private wheel(event: WheelEvent): void {
        event.preventDefault();
        const [x, y] = this.place(event);
        if (event.shiftKey) this.actions.turn(-0.002 * (event.deltaY + event.deltaX));
        else this.actions.zoom(Math.exp(-0.0015 * event.deltaY), x, y);
    }
}

/** Tells a short press from a drag: it moves by a few pixels at most. */
export class Tap {
    hasMoved = false;

    constructor(
        private readonly x: number,
        private readonly y: number,
    ) {}
    move(x: number, y: number): void {
        this.hasMoved ||= Math.hypot(x - this.x, y - this.y) > 4;
    }
    isOne(last: boolean): boolean {
        return last && !this.hasMoved;
    }
}
