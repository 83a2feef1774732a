// Ghosts: contacts with the internal edges of a floor, with the filter and without it.

import type { Context, Exhibit, Running } from "../../exhibit";
import { shapeChoices, type ShapeState } from "../../shapes/catalogue";
import type { Pane } from "../../stage/pane";
import { contactCode, physicsCode } from "./code";
import { Crates, maxCrates } from "./crates";
import { floorChoices, floorOf } from "./floors";
import { LaidShape } from "./laid";

interface State {
    space: boolean;
    /** "slide" and "roll": a shape that is laid on the floor; "push" and "stack": crates in the physics engine. */
    motion: string;
    floor2: string;
    floor3: string;
    shape2: ShapeState;
    shape3: ShapeState;
    depth: number;
    speed: number;
    crates: number;
    runs: boolean;
}

export const ghosts: Exhibit<State> = {
    meaning:
        "The floor is flat, so every contact should push straight up. A part by itself also has sides, and a shape that reaches over a seam is pushed along the floor by the side of the next part: a ghost collision, drawn in red. The library reports the normals of the surface that all parts form together, so nothing catches on a seam.",
    initial: {
        space: false,
        motion: "slide",
        floor2: "tiles",
        floor3: "mesh",
        shape2: { kind: "box", position: [-0.4, 0.3], rotation: [1, 0], size: 0.6 },
        shape3: { kind: "box", position: [-0.4, 0.3, 0.1], rotation: [0, 0, 0, 1], size: 0.6 },
        depth: 0.15,
        speed: 0.8,
        crates: 6,
        runs: true,
    },
    panes: ({ space, motion }) => {
        const view = space
            ? ({ dimension: 3, center: [0, motion === "stack" ? 2.6 : 0.4, 0], reach: motion === "stack" ? 4.6 : 2 } as const)
            : ({ dimension: 2, center: [0, motion === "stack" ? 3 : 0.8], reach: motion === "stack" ? 5.5 : 4.2 } as const);
        return [
            { title: "With the filter", ...view },
            { title: "Without: each part by itself", ...view },
        ];
    },
    start,
};

const motions: Readonly<Record<string, string>> = {
    slide: "a sliding shape",
    roll: "a rolling shape",
    push: "a pushed crate",
    stack: "a stack of crates",
};

function start({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const views = panes as readonly [Pane, Pane];
    const dimension = state.space ? 3 : 2;
    const shape = state.space ? state.shape3 : state.shape2;
    const isPhysics = state.motion === "push" || state.motion === "stack";
    const again =
        <T>(set: (value: T) => void) =>
        (value: T): void => {
            set(value);
            restart();
        };
    panel.toggle(
        "In space",
        () => state.space,
        again((value) => (state.space = value)),
    );
    panel.choice(
        "What moves",
        motions,
        () => state.motion,
        again((value) => (state.motion = value)),
    );
    if (state.space)
        panel.choice(
            "Floor",
            floorChoices(3),
            () => state.floor3,
            again((value) => (state.floor3 = value)),
        );
    else
        panel.choice(
            "Floor",
            floorChoices(2),
            () => state.floor2,
            again((value) => (state.floor2 = value)),
        );

    const floor = floorOf(abut, dimension, state.space ? state.floor3 : state.floor2);
    const scene = isPhysics ? new Crates(abut, floor, dimension, state.motion === "push", state) : new LaidShape(abut, floor, shape);
    if (scene instanceof Crates) addCrateControls(scene);
    else {
        panel.choice(
            "Shape",
            shapeChoices(dimension),
            () => shape.kind,
            (kind) => (shape.kind = kind),
        );
        panel.slider({ label: "Size", min: 0.2, max: 1.5, get: () => shape.size, set: (size) => (shape.size = Math.fround(size)) });
        panel.slider({ label: "Depth", min: 0, max: 0.3, step: 0.005, get: () => state.depth, set: (depth) => (state.depth = depth) });
    }
    if (state.motion !== "stack")
        panel.slider({
            label: "Speed",
            min: 0,
            max: 6,
            step: 0.1,
            unit: " /s",
            get: () => state.speed,
            set: (speed) => (state.speed = speed),
        });
    panel.toggle(
        "Runs",
        () => state.runs,
        (value) => (state.runs = value),
    );

    function addCrateControls(crates: Crates): void {
        if (state.motion === "stack") {
            const setCount = (count: number): void => {
                state.crates = count;
                crates.restart();
            };
            panel.slider({ label: "Crates", min: 1, max: maxCrates, step: 1, get: () => state.crates, set: setCount });
        }
        panel.button("Start again", () => {
            crates.restart();
            changed();
        });
    }

    return {
        draw() {
            if (scene instanceof LaidShape) scene.find(state.depth);
            scene.draw(views, changed);
            for (const [name, value] of Object.entries(scene.answers()))
                panel.answer(name, Number.isInteger(value) ? String(value) : value);
        },
        advance(seconds) {
            if (!state.runs) return false;
            if (scene instanceof Crates) scene.advance(seconds);
            else scene.advance(state.speed * seconds, state.motion === "roll");
            return true;
        },
        answers: () => (state.runs ? {} : scene.answers()),
        code: () =>
            scene instanceof Crates
                ? physicsCode(floor, dimension, state.motion === "push", state)
                : contactCode(scene.cppLines(), floor, dimension),
        ...(scene instanceof LaidShape ? { test: () => scene.test() } : {}),
        dispose: () => scene.dispose(),
    };
}
