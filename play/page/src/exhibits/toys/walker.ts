// A first-person walker in a small level.

import type { Context, Exhibit, Running } from "../../exhibit";
import { floats } from "../../library";
import { drawShape } from "../../shapes/catalogue";
import { StillShapes } from "../../shapes/still_shapes";
import { Joystick } from "../../stage/joystick";
import type { Pane3 } from "../../stage/pane3";
import { level3 } from "./level3";
import { Frames, frame, gravity, moverCode, moverControls, moverDefaults, walkSpeed, type MoverOptions } from "./mover_options";

interface State {
    position: number[];
    velocity: number[];
    /** The direction of the view, in radians. */
    yaw: number;
    pitch: number;
    /** Seconds for which the lift has moved. */
    time: number;
    outside: boolean;
    runs: boolean;
    options: MoverOptions;
}

/** The height of the eyes above the middle. */
const eyes = 0.6;
const turnSpeed = 1.8;
/** A jump is as high as the upper crate. */
const jumpSpeed = 7.5;
const fieldOfView = 65;
const lift = { half: [1, 0.1, 1], low: [7.6, 0.1, 0], rise: 1.9, period: 8 } as const;

const initial: State = {
    position: [-8, 0.95, 1.5],
    velocity: [0, 0, 0],
    yaw: -1.4,
    pitch: 0.1,
    time: 0,
    outside: false,
    runs: true,
    options: moverDefaults,
};

export const walker: Exhibit<State> = {
    meaning:
        "A capsule walks through boxes and a mesh, moved by the same character controller as in the plane. It climbs stairs up to its step height, walks up ramps that aren't too steep, slides along walls, and rides the lift. Nothing of the level is prepared for it: the shapes of the world are enough.",
    initial,
    panes: ({ outside }) => [{ title: "Arrows or W, A, S, D: walk and turn. Drag: look", dimension: 3, reach: outside ? 7 : 1.5 }],
    start,
};

function start({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const pane = panes[0] as Pane3;
    pane.camera.three.fov = fieldOfView;
    const world = new abut.World3();
    const parts = level3(abut);
    for (const { shape } of parts) world.add(shape as never, { fixed: true });
    const still = parts.map(({ shape, color }) => new StillShapes(abut, 3, [shape], { color, fill: 1 }));
    const liftShape = abut.Box3([0, 0, 0], lift.half);
    const liftId = world.add(liftShape);
    const hero = abut.Capsule3([0, -0.5, 0], [0, 0.5, 0], 0.4);
    let mover = new abut.PlayMover3(state.options);
    const frames = new Frames();
    const joystick = new Joystick(pane.element, "Joystick: up and down walk, left and right turn", changed);
    let grounded = false;
    let rides = false;
    let jumps = false;

    panel.toggle(
        "From outside",
        () => state.outside,
        (value) => {
            state.outside = value;
            // From outside, the view is from above.
            state.pitch = value ? 0.7 : initial.pitch;
            look();
            restart();
        },
    );
    moverControls(panel, state.options, () => {
        mover.dispose();
        mover = new abut.PlayMover3(state.options);
    });
    panel.toggle(
        "Runs",
        () => state.runs,
        (value) => (state.runs = value),
    );
    panel.button("Jump", () => {
        jumps = true;
        changed();
    });
    panel.button("Start again", () => {
        begin();
        changed();
    });

    function begin(): void {
        state.position = [...initial.position];
        state.velocity = [...initial.velocity];
        look();
    }

    function liftAt(time: number): number[] {
        const [x, y, z] = lift.low;
        return [x, y + lift.rise * (0.5 - 0.5 * Math.cos((2 * Math.PI * time) / lift.period)), z];
    }
    /** Points the camera by the state. */
    function look(): void {
        const [x = 0, y = 0, z = 0] = state.position;
        if (state.outside) pane.camera.target.set(x, y, z);
        pane.camera.standAt(state.outside ? null : [x, y + eyes, z], [state.yaw, state.pitch]);
    }
    function move(): void {
        state.time += frame;
        world.move(liftId, { position: liftAt(state.time) });
        const [right, forward] = joystick.direction;
        state.yaw -= turnSpeed * frame * right;
        const [, vy = 0] = state.velocity;
        const jump = grounded && jumps;
        if (jump) jumps = false;
        const speed = -walkSpeed * forward;
        const velocity = [speed * Math.sin(state.yaw), (jump ? jumpSpeed : vy) - gravity * frame, speed * Math.cos(state.yaw)];
        const moved = mover.move(
            world,
            hero,
            state.position,
            velocity.map((v) => v * frame),
        );
        state.position = Array.from(moved.position);
        grounded = moved.grounded;
        rides = grounded && moved.ground.index === liftId.index;
        state.velocity = [velocity[0] ?? 0, grounded ? 0 : (moved.motion[1] ?? 0) / frame, velocity[2] ?? 0];
        // Over a wall, and down.
        if ((state.position[1] ?? 0) < -5) begin();
    }
    world.move(liftId, { position: liftAt(state.time) });
    look();

    return {
        draw() {
            // A drag has turned the camera by itself.
            [state.yaw, state.pitch] = pane.camera.angles;
            look();
            const touches = Array.from(floats(mover.touches()));
            pane.draw([], (drawing) => {
                for (const part of still) part.draw(drawing);
                drawShape(abut, pane, drawing, abut.at(liftShape, { position: liftAt(state.time) }), { color: "good", fill: 1 });
                if (state.outside)
                    drawShape(abut, pane, drawing, abut.at(hero, { position: state.position }), { color: "mark", fill: 0.5 });
                for (let i = 0; i < touches.length; i += 7)
                    drawing.point(touches.slice(i, i + 3), { color: touches[i + 6] ? "good" : "mark", width: 2 });
            });
            panel.answer("position", state.position);
            panel.answer("stands on", rides ? "the lift" : grounded ? "the level" : "nothing");
            panel.answer("touches", String(touches.length / 7));
        },
        advance(seconds) {
            if (!state.runs) return false;
            [state.yaw, state.pitch] = pane.camera.angles;
            frames.advance(seconds, move);
            look();
            return true;
        },
        answers: () => ({ position: state.position, grounded, rides, yaw: state.yaw }),
        code: () =>
            moverCode(3, state.options, {
                cpp: "{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.4f}",
                javascript: "abut.Capsule3([0, -0.5, 0], [0, 0.5, 0], 0.4)",
                jumpSpeed,
            }),
        dispose() {
            joystick.dispose();
            mover.dispose();
            world.dispose();
        },
    };
}
