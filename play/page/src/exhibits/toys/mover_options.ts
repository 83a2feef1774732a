// The options of a character, which both games with one share, and how it moves.

import type { Panel } from "../../panel/panel";

export interface MoverOptions {
    step_height: number;
    steepest: number;
    stick: number;
}
export const moverDefaults: MoverOptions = { step_height: 0.3, steepest: 0.87, stick: 0.3 };

export const walkSpeed = 5;
export const gravity = 24;
/** The time of a move, in seconds. */
export const frame = 1 / 60;

export function moverControls(panel: Panel, options: MoverOptions, set: () => void): void {
    const slider = (label: string, name: keyof MoverOptions, max: number, unit = ""): void =>
        panel.slider({
            label,
            min: 0,
            max,
            step: 0.01,
            unit,
            get: () => options[name],
            set(value) {
                options[name] = Math.fround(value);
                set();
            },
        });
    slider("Step height", "step_height", 1);
    slider("Steepest", "steepest", 1.5, " rad");
    slider("Stick", "stick", 1);
}

/** Calls `move` for each frame of the time that has passed. */
export class Frames {
    private time = 0;
    advance(seconds: number, move: () => void): void {
        for (this.time += seconds; this.time > 0; this.time -= frame) move();
    }
}

export function moverCode(
    dimension: 2 | 3,
    { step_height, steepest, stick }: MoverOptions,
    hero: { cpp: string; javascript: string; jumpSpeed: number },
): { cpp: string; javascript: string } {
    const number = (value: number): string => `${Number(value.toFixed(4))}${Number.isInteger(value) ? ".f" : "f"}`;
    return {
        cpp: `#include <abut/abut.hpp>

abut::Mover${dimension} mover({.step_height = ${number(step_height)}, .steepest = ${number(steepest)}, .stick = ${number(stick)}});
const abut::Capsule${dimension} hero${hero.cpp};
// Each frame:
velocity.y -= ${gravity}.f * dt;
const auto moved = mover.move(world, hero, position, velocity * dt);
position = moved.position;
if (moved.grounded) velocity.y = jumps ? ${number(hero.jumpSpeed)} : 0.f;
// moved.ground, moved.touches`,
        javascript: `// The package has no Mover yet; this page has it from a module of its own.
const hero = ${hero.javascript};
const { position, grounded } = mover.move(world, hero, before, motion);`,
    };
}
