// Crates that are pushed or stand in a stack, in two engines: with the filter and without it.

import type { Abut } from "../../library";
import { drawShape } from "../../shapes/catalogue";
import type { Handle, Pane } from "../../stage/pane";
import { Engine, half, stepsPerSecond, type Place } from "./engine";
import { halfLength, type Floor } from "./floors";
import { stillFloor, drawPoints } from "./side";

/** Read at each step. */
export interface CrateOptions {
    /** The height of the stack. */
    readonly crates: number;
    /** The speed of the push along x. */
    readonly speed: number;
}

export const maxCrates = 8;
/** A pushed crate starts here, and again when it has come to the other end. */
export const start = 1 - halfLength;

export class Crates {
    private readonly engines: readonly [Engine, Engine];
    private readonly still;
    private time = 0;
    /** A crate that is dragged, where to, and the seconds for which that still acts. */
    private pull: { readonly crate: number; readonly to: readonly number[]; rest: number } | null = null;

    constructor(
        private readonly abut: Abut,
        floor: Floor,
        private readonly dimension: 2 | 3,
        private readonly isPushed: boolean,
        private readonly options: CrateOptions,
    ) {
        this.engines = [new Engine(abut, dimension, true, [floor.shape]), new Engine(abut, dimension, false, floor.parts)];
        this.still = stillFloor(abut, dimension, floor);
        this.restart();
    }

    restart(): void {
        for (const engine of this.engines) engine.begin(this.places());
    }
    advance(seconds: number): void {
        for (this.time += seconds; this.time > 0; this.time -= 1 / stepsPerSecond) {
            if (this.pull && (this.pull.rest -= 1 / stepsPerSecond) < 0) this.pull = null;
            for (const engine of this.engines) this.step(engine);
        }
    }

    draw(panes: readonly [Pane, Pane], changed: () => void): void {
        const crate = this.dimension === 2 ? this.abut.Box2([0, 0], [half, half]) : this.abut.Box3([0, 0, 0], [half, half, half]);
        panes.forEach((pane, i) => {
            const engine = this.engines[i as 0 | 1];
            const placed = Array.from({ length: engine.count }, (_, k) => {
                const pose = { position: engine.position(k), rotation: engine.rotation(k) };
                return this.abut.at(crate as never, pose as never);
            });
            const handles = placed.map((shape, k): Handle => ({
                id: `crate${k}`,
                label: `Crate ${k + 1}`,
                at: engine.position(k),
                shape,
                move: (to) => {
                    this.pull = { crate: k, to, rest: 0.25 };
                    changed();
                },
            }));
            pane.draw(handles, (drawing) => {
                this.still.draw(drawing);
                for (const shape of placed) drawShape(this.abut, pane, drawing, shape, { color: "a", fill: 0.3 });
                drawPoints(drawing, engine.points);
            });
        });
    }
    answers(): Readonly<Record<string, number>> {
        const [filtered, unfiltered] = this.engines;
        const common = {
            "points now, with": filtered.points.length,
            "points now, without": unfiltered.points.length,
            "ghosts so far, with": filtered.ghosts,
            "ghosts so far, without": unfiltered.ghosts,
        };
        if (this.isPushed) return { ...common, "highest, with": filtered.highest, "highest, without": unfiltered.highest };
        return { ...common, "points as before, with": filtered.persistence(), "points as before, without": unfiltered.persistence() };
    }
    dispose(): void {
        for (const engine of this.engines) engine.dispose();
    }

    /** One crate at an end of the floor, or a stack beside a seam whose crates are tilted a little, to and fro. */
    private places(): Place[] {
        if (this.isPushed) return [this.place(start, half, 0)];
        const count = Math.min(this.options.crates, maxCrates);
        return Array.from({ length: count }, (_, i) => this.place(0.1, half + 0.05 + 1.05 * i, i % 2 === 0 ? 0.02 : -0.02));
    }
    private place(x: number, y: number, tilt: number): Place {
        if (this.dimension === 2) return { position: [x, y], rotation: this.abut.Turn.by(tilt) };
        return { position: [x, y, 0.1], rotation: this.abut.Turn.about([0, 0, 1], tilt) };
    }
    private step(engine: Engine): void {
        if (this.isPushed) {
            if ((engine.position(0)[0] ?? 0) > -start) engine.begin(this.places());
            engine.setVelocity(0, [this.options.speed, ...engine.velocity(0).slice(1)]);
        }
        if (this.pull && this.pull.crate < engine.count) {
            const { crate, to } = this.pull;
            const at = engine.position(crate);
            engine.setVelocity(
                crate,
                at.map((x, i) => Math.min(Math.max(10 * ((to[i] ?? 0) - x), -8), 8)),
            );
        }
        engine.step();
    }
}
