// Sweep: when two moving shapes touch first, as a ray into the Minkowski difference or by advancing in time.

import type { Context, Exhibit, Running } from "../../exhibit";
import { spaceToggle } from "../../panel/space_toggle";
import { Questions, type AnyShape, type Hit, type Motion } from "../../questions";
import {
    cppShape,
    drawShape,
    localShapeOf,
    poseOf,
    shapeChoices,
    shapeControls,
    shapeHandle,
    shapeOf,
    type ShapeState,
} from "../../shapes/catalogue";
import { Difference } from "../../shapes/difference";
import { cppFloat, cppPose, cppShape as cppPlain, cppTest, cppVec, expectFloat, expectVec, javascriptText } from "../../shapes/source_text";
import type { Drawing } from "../../stage/drawing";
import type { Handle } from "../../stage/pane";
import { drawPlane } from "../../stage/plane";
import { distancesOf, stopsOf, traceOf, type Stop, type SweepStep } from "../../trace";
import { drawTimeChart } from "./time_chart";

/** A shape with its motion: `turn` in radians, in space about the z axis. */
interface Mover {
    shape: ShapeState;
    move: number[];
    turn: number;
}
interface State {
    space: boolean;
    rotates: boolean;
    time: number;
    a2: Mover;
    b2: Mover;
    a3: Mover;
    b3: Mover;
}

const meanings = {
    straight:
        "As A moves along B, the origin moves back along a ray through the Minkowski difference. " +
        "The shapes touch where the ray enters it: that fraction of the motion is the time of impact. " +
        "The search stops at planes that the ray crosses no later than the difference, so it never passes a hit.",
    rotating:
        "Shapes that rotate change their Minkowski difference all the time, so the search advances in time. " +
        "From each stop it goes on as far as a moving plane proves that nothing touches. " +
        "It ends where the distance is 0 within the tolerance, or at the end of the motion.",
};

export const sweep: Exhibit<State> = {
    meaning: meanings.straight,
    initial: {
        space: false,
        rotates: false,
        time: 0.3,
        a2: { shape: { kind: "box", position: [-2, 0.6], rotation: [0.9689124, 0.247404], size: 0.6 }, move: [3.6, -0.8], turn: 2 },
        b2: { shape: { kind: "hexagon", position: [1.3, -0.9], rotation: [1, 0], size: 0.7 }, move: [-0.4, 0.9], turn: 0 },
        a3: {
            shape: { kind: "box", position: [-1.8, 0.5, 0], rotation: [0.1, 0.2, 0.1, 0.9695359], size: 0.6 },
            move: [3.4, -0.6, 0],
            turn: 2,
        },
        b3: { shape: { kind: "rock", position: [1.2, -0.7, 0.1], rotation: [0, 0, 0, 1], size: 0.7 }, move: [-0.4, 0.8, 0], turn: 0 },
    },
    panes: ({ space, rotates }) => [
        { title: "The world", dimension: space ? 3 : 2, reach: 2.9 },
        rotates
            ? { title: "Distance over time", dimension: 2, center: [0, 1], reach: 2.5 }
            : {
                  title: "Minkowski difference A − B at the start",
                  dimension: space ? 3 : 2,
                  center: space ? [-1.6, 0.6, 0] : [-1.6, 0.6],
                  reach: 3.2,
              },
    ],
    start,
};

/** Times at which the chart has the distance. */
const samples = 81;
/** Of the whole motion, each second. */
const playSpeed = 0.35;

function start(context: Context<State>): Running {
    const { abut, state, panel, panes, changed, restart } = context;
    const [world, second] = panes as [(typeof panes)[0], (typeof panes)[0]];
    const [a, b] = state.space ? [state.a3, state.b3] : [state.a2, state.b2];
    const dimension = state.space ? 3 : 2;
    const ask = new Questions(abut);
    const difference = new Difference(abut);
    let hit: Hit | null = null;
    let stops: Stop[] = [];
    let isPlaying = false;

    panel.setMeaning(state.rotates ? meanings.rotating : meanings.straight);
    spaceToggle(context);
    panel.toggle(
        "With rotation",
        () => state.rotates,
        (value) => {
            state.rotates = value;
            restart();
        },
    );
    panel.slider({ label: "Time", min: 0, max: 1, get: () => state.time, set: (time) => (state.time = time) });
    for (const [name, mover] of [
        ["A", a],
        ["B", b],
    ] as const) {
        shapeControls(panel, name, mover.shape, shapeChoices(dimension));
        panel.slider({
            label: `Rotation of ${name}`,
            min: -7,
            max: 7,
            unit: " rad",
            shown: () => state.rotates,
            get: () => mover.turn,
            set: (turn) => (mover.turn = Math.fround(turn)),
        });
    }
    const play = panel.button("Play", () => {
        isPlaying = !isPlaying;
        if (isPlaying && state.time >= 1) state.time = 0;
        changed();
    });

    const motionOf = ({ shape, move, turn }: Mover): Motion => {
        const angle = state.rotates ? turn : 0;
        return { from: poseOf(shape), move, turn: state.space ? [0, 0, angle] : angle };
    };
    const placed = (mover: Mover, time: number): AnyShape => {
        const { position, rotation } = ask.poseAt(motionOf(mover), time);
        return ask.at(localShapeOf(mover.shape), position, rotation);
    };
    const relative = (): number[] => a.move.map((x, i) => x - (b.move[i] ?? 0));

    function query(): Hit | null {
        if (state.rotates) return ask.sweepMotion(localShapeOf(a.shape), motionOf(a), localShapeOf(b.shape), motionOf(b));
        return ask.sweep(shapeOf(abut, a.shape), a.move, shapeOf(abut, b.shape), b.move);
    }

    function draw(): void {
        hit = query();
        stops = state.rotates ? stopsOf(abut, localShapeOf(a.shape), motionOf(a), localShapeOf(b.shape), motionOf(b)) : [];
        world.draw(handles(), drawWorld);
        second.draw([], state.rotates ? drawChart : drawDifference);
        panel.answer("hit", hit !== null);
        panel.answer("fraction", hit?.fraction ?? "none");
        panel.answer("distance", hit?.distance ?? "none");
        panel.answer("point", hit?.point ?? "none");
        panel.answer("normal", hit?.normal ?? "none");
        panel.answer("started inside", hit?.started_inside ?? false);
        if (state.rotates) panel.answer("stops", String(stops.length));
        play.textContent = isPlaying ? "Pause" : "Play";
    }

    function handles(): Handle[] {
        return (
            [
                ["a", a],
                ["b", b],
            ] as const
        ).flatMap(([id, mover]) => [
            {
                id: `end-${id}`,
                label: `The end of the motion of ${id.toUpperCase()}`,
                at: mover.shape.position.map((x, i) => x + (mover.move[i] ?? 0)),
                move(to: number[]): void {
                    mover.move = to.map((x, i) => Math.fround(x - (mover.shape.position[i] ?? 0)));
                    changed();
                },
            },
            shapeHandle(abut, id, mover.shape, changed),
        ]);
    }
    function drawWorld(drawing: Drawing): void {
        for (const [name, mover, color] of [
            ["A", a, "a"],
            ["B", b, "b"],
        ] as const) {
            const start = mover.shape.position;
            drawShape(abut, world, drawing, placed(mover, 0), { color, alpha: 0.5, fill: 0.1 });
            for (const { time } of stops.slice(1, 9)) drawShape(abut, world, drawing, placed(mover, time), { color, alpha: 0.25 });
            drawShape(abut, world, drawing, placed(mover, state.time), { color, fill: 0.35 });
            if (hit) drawShape(abut, world, drawing, placed(mover, hit.fraction), { color: "mark", alpha: 0.8 });
            drawing.arrow(
                start,
                start.map((x, i) => x + (mover.move[i] ?? 0)),
                { color, width: 2, onTop: true },
            );
            drawing.text(start, name, { color });
        }
        if (!hit) return;
        drawing.arrow(
            hit.point,
            hit.point.map((x, i) => x + 0.6 * (hit?.normal[i] ?? 0)),
            { color: "good", width: 3, onTop: true },
        );
        drawing.point(hit.point, { color: "mark", width: 3, onTop: true });
    }
    function drawDifference(drawing: Drawing): void {
        const origin = new Array<number>(dimension).fill(0);
        const along = (fraction: number): number[] => relative().map((x) => -fraction * x);
        drawShape(abut, second, drawing, difference.of(a.shape, b.shape), { color: "accent", fill: 0.2 });
        const trace = traceOf(abut, "sweep", shapeOf(abut, a.shape), shapeOf(abut, b.shape), relative());
        for (const { position, normal, distance } of trace.filter((step): step is SweepStep => step.kind === "sweep")) {
            drawing.point(position, { color: "good", width: 2, onTop: true });
            drawPlane(
                drawing,
                position.map((x, i) => x - distance * (normal[i] ?? 0)),
                normal,
                1.2,
                "good",
            );
        }
        drawing.arrow(origin, along(1), { color: "soft", width: 2, onTop: true });
        drawing.point(origin, { color: "text", width: 3, onTop: true });
        drawing.point(along(state.time), { color: "text", width: 4, onTop: true });
        if (hit) drawing.point(along(hit.fraction), { color: "mark", width: 4, onTop: true });
        drawing.text(origin, "origin", { color: "text" }, [0, -16]);
        drawing.text(along(state.time), "at this time", { color: "text" }, [0, 18]);
    }
    function drawChart(drawing: Drawing): void {
        const distances = distancesOf(abut, localShapeOf(a.shape), motionOf(a), localShapeOf(b.shape), motionOf(b), samples);
        drawTimeChart(drawing, { distances, stops, time: state.time, impact: hit?.fraction ?? null });
    }

    /** The question in C++, with its shapes. */
    function cppLines(): string[] {
        const vec = (values: readonly number[]): string => `abut::Vec${dimension}${cppVec(values)}`;
        if (!state.rotates)
            return [
                `const auto a = ${cppShape(a.shape)};`,
                `const auto b = ${cppShape(b.shape)};`,
                `const auto hit = abut::sweep(a, ${vec(a.move)}, b, ${vec(b.move)});`,
            ];
        const motion = (mover: Mover): string => {
            const { from, move, turn } = motionOf(mover);
            const angle = typeof turn === "number" ? cppFloat(turn) : cppVec(turn);
            return `abut::Motion${dimension}{${cppPose(from)}, ${cppVec(move)}, ${angle}}`;
        };
        return [
            `const auto a = ${cppPlain(localShapeOf(a.shape))};`,
            `const auto b = ${cppPlain(localShapeOf(b.shape))};`,
            `const auto hit = abut::sweep(a, ${motion(a)}, b, ${motion(b)});`,
        ];
    }
    function test(): string {
        const lines = [...cppLines(), `ASSERT_EQ(hit.has_value(), ${hit !== null});`];
        if (hit)
            lines.push(
                expectFloat("hit->fraction", hit.fraction),
                expectFloat("hit->distance", hit.distance),
                ...expectVec("hit->point", hit.point),
                ...expectVec("hit->normal", hit.normal),
                `EXPECT_EQ(hit->started_inside, ${hit.started_inside});`,
            );
        return cppTest("Sweep", lines);
    }
    function javascript(): string {
        const shape = (mover: Mover): string => javascriptText(state.rotates ? localShapeOf(mover.shape) : shapeOf(abut, mover.shape));
        const motion = (mover: Mover): string => javascriptText(state.rotates ? motionOf(mover) : mover.move);
        return [
            `const a = ${shape(a)};`,
            `const b = ${shape(b)};`,
            `const hit = abut.${state.rotates ? "sweep_motion" : "sweep"}(`,
            `    a, ${motion(a)},`,
            `    b, ${motion(b)});`,
        ].join("\n");
    }

    return {
        draw,
        advance(seconds) {
            if (!isPlaying) return false;
            state.time = Math.min(state.time + playSpeed * seconds, 1);
            isPlaying = state.time < 1;
            return isPlaying;
        },
        answers: () => ({ ...hit, hit: hit !== null, stops }),
        code: () => ({
            cpp: `#include <abut/abut.hpp>\n\n${cppLines().join("\n")}\n// hit->fraction, hit->point, hit->normal`,
            javascript: javascript(),
        }),
        test,
        dispose: () => difference.dispose(),
    };
}
