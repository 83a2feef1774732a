// A platformer: a character on a tile map with slopes, steps and one-way platforms, and on a platform that moves.

import type { Context, Exhibit, Running } from "../../exhibit";
import { floats } from "../../library";
import { drawShape } from "../../shapes/catalogue";
import { StillShapes } from "../../shapes/still_shapes";
import { Joystick } from "../../stage/joystick";
import { Frames, frame, gravity, moverCode, moverControls, moverDefaults, walkSpeed, type MoverOptions } from "./mover_options";

interface State {
    position: number[];
    velocity: number[];
    /** Seconds for which the platform has moved. */
    time: number;
    runs: boolean;
    options: MoverOptions;
}

/** From the top. */
const rows = [
    "#............................#",
    "#............................#",
    "#.................===........#",
    "#............................#",
    "#............##............==#",
    "#......===...................#",
    "#............................#",
    "#..===.......................#",
    "#................/##L........#",
    "#.........-...../####L...-#..#",
    "##############################",
] as const;
/** The numbers of abut_tile. */
const tiles: Readonly<Record<string, number>> = { ".": 0, "#": 1, "-": 4, L: 6, "/": 7, "=": 13 };
const columns = rows[0].length;
const lift = { half: [1.2, 0.15], from: [22.6, 1.6], to: [24.2, 5.4], period: 7 } as const;

/** A jump is three tiles high. */
const jumpSpeed = 12.5;

const initial: State = { position: [3, 2], velocity: [0, 0], time: 0, runs: true, options: moverDefaults };

export const platformer: Exhibit<State> = {
    meaning:
        "The character is moved by what it wants, and the library slides it along walls, over steps and slopes, and onto platforms, without ever leaving it inside anything. One-way platforms hold it from above only. It stays on ground that moves, and the seams between tiles stop it nowhere.",
    initial,
    panes: () => [{ title: "Arrow keys or A, D: walk. Up or W: jump", dimension: 2, center: [8, 4.4], reach: 7 }],
    start,
};

function start({ abut, state, panel, panes, changed }: Context<State>): Running {
    const pane = panes[0] as (typeof panes)[0];
    const world = new abut.World2();
    const numbers = [...rows].reverse().flatMap((row) => Array.from(row, (tile) => tiles[tile] ?? 0));
    const level = abut.TileMap(numbers, columns, [1, 1]);
    world.add(level, { fixed: true });
    const still = new StillShapes(abut, 2, [level], { color: "soft", fill: 0.25 });
    const liftShape = abut.Box2([0, 0], lift.half);
    const liftId = world.add(liftShape);
    const hero = abut.Capsule2([0, -0.35], [0, 0.35], 0.35);
    let mover = new abut.PlayMover2(state.options);
    const frames = new Frames();
    const joystick = new Joystick(pane.element, "Joystick: left and right walk, up jumps", changed);
    let grounded = false;
    let rides = false;
    let crushed = false;

    moverControls(panel, state.options, () => {
        mover.dispose();
        mover = new abut.PlayMover2(state.options);
    });
    panel.toggle(
        "Runs",
        () => state.runs,
        (value) => (state.runs = value),
    );
    panel.button("Start again", () => {
        begin();
        changed();
    });

    function begin(): void {
        state.position = [...initial.position];
        state.velocity = [...initial.velocity];
    }

    function liftAt(time: number): number[] {
        const share = 0.5 - 0.5 * Math.cos((2 * Math.PI * time) / lift.period);
        return lift.from.map((x, i) => x + share * ((lift.to[i] ?? 0) - x));
    }
    function move(): void {
        state.time += frame;
        world.move(liftId, { position: liftAt(state.time) });
        const [right, up] = joystick.direction;
        const [, vy = 0] = state.velocity;
        const velocity = [walkSpeed * right, (grounded && up > 0.4 ? jumpSpeed : vy) - gravity * frame];
        const moved = mover.move(
            world,
            hero,
            state.position,
            velocity.map((v) => v * frame),
        );
        state.position = Array.from(moved.position);
        grounded = moved.grounded;
        crushed = moved.crushed;
        rides = grounded && moved.ground.index === liftId.index;
        state.velocity = [velocity[0] ?? 0, grounded ? 0 : (moved.motion[1] ?? 0) / frame];
        // Over a wall, and down.
        if ((state.position[1] ?? 0) < -5) begin();
    }
    world.move(liftId, { position: liftAt(state.time) });

    return {
        draw() {
            const [x = 0] = state.position;
            const middle = Math.min(Math.max(x, 8), columns - 8);
            pane.fit([middle - 8, -0.5], [middle + 8, rows.length - 1]);
            const touches = Array.from(floats(mover.touches()));
            pane.draw([], (drawing) => {
                still.draw(drawing);
                drawShape(abut, pane, drawing, abut.at(liftShape, { position: liftAt(state.time) }), { color: "b", fill: 0.4 });
                drawShape(abut, pane, drawing, abut.at(hero, { position: state.position }), { color: "a", fill: 0.4 });
                for (let i = 0; i < touches.length; i += 5) {
                    const [px = 0, py = 0, nx = 0, ny = 0, isGround = 0] = touches.slice(i, i + 5);
                    drawing.arrow([px, py], [px + 0.6 * nx, py + 0.6 * ny], { color: isGround ? "good" : "mark", width: 2 });
                }
            });
            panel.answer("position", state.position);
            panel.answer(
                "stands on",
                crushed ? "nothing: it is crushed" : rides ? "the platform that moves" : grounded ? "the tile map" : "nothing",
            );
            panel.answer("touches", String(touches.length / 5));
        },
        advance(seconds) {
            if (!state.runs) return false;
            frames.advance(seconds, move);
            return true;
        },
        answers: () => ({ position: state.position, grounded, rides, crushed }),
        code: () =>
            moverCode(2, state.options, {
                cpp: "{{0, -0.35f}, {0, 0.35f}, 0.35f}",
                javascript: "abut.Capsule2([0, -0.35], [0, 0.35], 0.35)",
                jumpSpeed,
            }),
        dispose() {
            joystick.dispose();
            mover.dispose();
            world.dispose();
        },
    };
}
