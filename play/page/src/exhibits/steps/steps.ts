// Step by step: what GJK, EPA, SAT, clipping and a sweep do, from the library's own trace.

import type { Context, Exhibit, Running } from "../../exhibit";
import { readable } from "../../panel/panel";
import { Questions, type AnyShape } from "../../questions";
import { cppShape, drawShape, shapeChoices, shapeControls, shapeHandle, shapeOf, type ShapeState } from "../../shapes/catalogue";
import { Difference } from "../../shapes/difference";
import { cppFloat, cppTest, cppVec, expectFloat, javascriptText } from "../../shapes/source_text";
import type { Drawing } from "../../stage/drawing";
import type { Handle } from "../../stage/pane";
import { questions, traceOf, type Question, type Step } from "../../trace";
import { drawInDifference, drawInWorld, stepText } from "./draw_step";

interface State {
    space: boolean;
    question: string;
    /** How many steps are shown. */
    step: number;
    a2: ShapeState;
    b2: ShapeState;
    a3: ShapeState;
    b3: ShapeState;
    motion2: number[];
    motion3: number[];
}

export const steps: Exhibit<State> = {
    meaning:
        "The library records every step that an engine takes, and changes no answer by it. " +
        "GJK and EPA search the Minkowski difference for the point nearest to the origin; " +
        "SAT compares intervals on axes; " +
        "clipping cuts one shape by the borders of the other. " +
        "Where two boxes in space are compared, the axes come first, and the search that gives the points follows.",
    initial: {
        space: false,
        question: "closest",
        step: 1,
        a2: { kind: "seeded", position: [-0.7, 0.2], rotation: [1, 0], size: 1.2, seed: 4 },
        b2: { kind: "hexagon", position: [0.8, -0.1], rotation: [0.9689124, 0.247404], size: 0.9 },
        a3: { kind: "box", position: [-0.6, 0.2, 0], rotation: [0.1, 0.2, 0.1, 0.9695359], size: 1 },
        b3: { kind: "box", position: [0.8, -0.1, 0.2], rotation: [0, 0, 0, 1], size: 0.9 },
        motion2: [3, 0.3],
        motion3: [3, 0.3, 0],
    },
    panes: ({ space, question }) => [
        { title: "The world", dimension: space ? 3 : 2, reach: 2.4 },
        ...(question === "intersection"
            ? []
            : [{ title: "Minkowski difference A − B", dimension: space ? 3 : 2, center: [-0.9, 0.2, 0], reach: 2.8 } as const]),
    ],
    start,
};

/** A step while it plays, in seconds. */
const pace = 0.8;
/** How far the polytopes of curved shapes may be off. */
const tolerance = 0.02;

function start({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const [world, differencePane] = panes as [(typeof panes)[0], (typeof panes)[0] | undefined];
    const [a, b, motion] = state.space ? [state.a3, state.b3, state.motion3] : [state.a2, state.b2, state.motion2];
    const dimension = state.space ? 3 : 2;
    const question = (state.question in questions ? state.question : "closest") as Question;
    const ask = new Questions(abut);
    const difference = new Difference(abut);
    let trace: Step[] = [];
    let isPlaying = false;
    let waited = 0;

    panel.choice(
        "Question",
        { closest: "closest", contact: "contact", intersection: "intersection", sweep: "sweep of A" },
        () => question,
        (value) => {
            state.question = value;
            state.step = 1;
            restart();
        },
    );
    panel.toggle(
        "In space",
        () => state.space,
        (value) => {
            state.space = value;
            state.step = 1;
            restart();
        },
    );
    panel.slider({ label: "Step", min: 0, max: () => trace.length, step: 1, get: shownCount, set: (step) => (state.step = step) });
    shapeControls(panel, "A", a, shapeChoices(dimension));
    shapeControls(panel, "B", b, shapeChoices(dimension));
    const go = (by: number): void => {
        isPlaying = false;
        state.step = Math.min(Math.max(shownCount() + by, 0), trace.length);
        changed();
    };
    panel.button("Back", () => go(-1));
    panel.button("Forward", () => go(1));
    const play = panel.button("Play", () => {
        isPlaying = !isPlaying;
        waited = 0;
        if (isPlaying && shownCount() === trace.length) state.step = 0;
        changed();
    });

    function shownCount(): number {
        return Math.min(Math.max(Math.round(state.step), 0), trace.length);
    }
    /** The shapes as the question takes them: an intersection is one of polytopes. */
    function shapes(): [AnyShape, AnyShape] {
        const both = [shapeOf(abut, a), shapeOf(abut, b)] as [AnyShape, AnyShape];
        return question === "intersection" ? [ask.polytope(both[0], tolerance), ask.polytope(both[1], tolerance)] : both;
    }

    function draw(): void {
        const both = shapes();
        trace = traceOf(abut, question, ...both, motion);
        const shown = trace.slice(0, shownCount());
        const step = shown.at(-1);
        world.draw(handles(), (drawing) => {
            drawShape(abut, world, drawing, both[0], { color: "a", fill: 0.25 });
            drawShape(abut, world, drawing, both[1], { color: "b", fill: 0.25 });
            if (question === "sweep") drawMotion(drawing, both[0], step);
            drawInWorld(
                drawing,
                shown,
                a.position.map((x, i) => (x + (b.position[i] ?? 0)) / 2),
            );
            if (shown.length === trace.length) drawAnswer(drawing, both);
            drawing.text(a.position, "A", { color: "a" });
            drawing.text(b.position, "B", { color: "b" });
        });
        differencePane?.draw([], (drawing) => {
            const origin = new Array<number>(dimension).fill(0);
            drawShape(abut, differencePane, drawing, difference.of(a, b), { color: "accent", fill: 0.12, alpha: 0.6 });
            drawInDifference(drawing, shown);
            drawing.point(origin, { color: "text", width: 3, onTop: true });
            drawing.text(origin, "origin", { color: "text" }, [0, -16]);
        });
        panel.answer("step", `${shown.length} of ${trace.length}`);
        panel.answer("this step", step ? stepText(step) : "Nothing is known yet.");
        panel.answer("answer", answerText(both));
        play.textContent = isPlaying ? "Pause" : "Play";
    }
    function handles(): Handle[] {
        const end: Handle = {
            id: "motion",
            label: "The end of A's motion",
            at: a.position.map((x, i) => x + (motion[i] ?? 0)),
            move(to) {
                to.forEach((x, i) => (motion[i] = Math.fround(x - (a.position[i] ?? 0))));
                changed();
            },
        };
        return [...(question === "sweep" ? [end] : []), shapeHandle(abut, "a", a, changed), shapeHandle(abut, "b", b, changed)];
    }
    function drawMotion(drawing: Drawing, shape: AnyShape, step: Step | undefined): void {
        drawing.arrow(
            a.position,
            a.position.map((x, i) => x + (motion[i] ?? 0)),
            { color: "soft", width: 2, onTop: true },
        );
        // The origin moves back along the ray as A moves on.
        if (step?.kind === "sweep")
            drawShape(
                abut,
                world,
                drawing,
                moved(
                    shape,
                    step.position.map((x) => -x),
                ),
                { color: "mark", width: 2 },
            );
    }
    function moved(shape: AnyShape, by: readonly number[]): AnyShape {
        return ask.at(shape, by, state.space ? [0, 0, 0, 1] : [1, 0]);
    }

    function drawAnswer(drawing: Drawing, both: readonly [AnyShape, AnyShape]): void {
        if (question === "closest") {
            const closest = ask.closest(...both);
            drawing.line([...closest.on_a, ...closest.on_b], { color: "mark", width: 3, onTop: true });
        } else if (question === "contact") {
            for (const { position } of ask.contact(...both)?.points ?? [])
                drawing.point(position, { color: "mark", width: 3, onTop: true });
        } else if (question === "intersection") {
            const overlap = ask.intersection(...both);
            if (overlap) drawShape(abut, world, drawing, overlap, { color: "good", fill: 0.5, width: 3 });
        } else {
            const hit = ask.sweep(both[0], motion, both[1]);
            if (hit) drawing.point(hit.point, { color: "mark", width: 3, onTop: true });
        }
    }
    function answerText(both: readonly [AnyShape, AnyShape]): string {
        switch (question) {
            case "closest":
                return `distance ${readable(ask.closest(...both).distance)}`;
            case "contact": {
                const contact = ask.contact(...both);
                return contact ? `depth ${readable(contact.depth)}, points: ${contact.points.length}` : "no contact";
            }
            case "intersection": {
                const overlap = ask.intersection(...both);
                return overlap
                    ? `${state.space ? "volume" : "area"} ${readable(state.space ? overlap.volume : overlap.area)}`
                    : "no overlap";
            }
            case "sweep": {
                const hit = ask.sweep(both[0], motion, both[1]);
                return hit ? `hit at ${readable(hit.fraction)} of the motion` : "no hit";
            }
        }
    }

    function test(): string {
        const both = shapes();
        const lines = [...declarations(), `abut::Trace<${dimension}> trace;`];
        if (question === "closest")
            lines.push(
                "const auto answer = abut::closest(a, b, {.trace = &trace});",
                expectFloat("answer.distance", ask.closest(...both).distance),
            );
        if (question === "contact")
            lines.push(
                "const auto answer = abut::contact(a, b, {.trace = &trace});",
                expectFloat("answer.depth", ask.contact(...both)?.depth ?? 0),
            );
        if (question === "intersection") {
            const overlap = ask.intersection(...both);
            const [type, size] = state.space ? ["Polyhedron", "volume"] : ["Polygon", "area"];
            lines.push(`abut::${type} overlap;`, `EXPECT_EQ(abut::intersection(a, b, overlap, {.trace = &trace}), ${overlap !== null});`);
            if (overlap)
                lines.push(
                    `EXPECT_FLOAT_EQ(static_cast<float>(overlap.${size}()), ${cppFloat(state.space ? overlap.volume : overlap.area)});`,
                );
        }
        if (question === "sweep") {
            const hit = ask.sweep(both[0], motion, both[1]);
            lines.push(
                `const auto hit = abut::sweep(a, abut::Vec${dimension}${cppVec(motion)}, b, {.trace = &trace});`,
                `ASSERT_EQ(hit.has_value(), ${hit !== null});`,
            );
            if (hit) lines.push(expectFloat("hit->fraction", hit.fraction));
        }
        return cppTest("StepByStep", [...lines, `EXPECT_EQ(trace.steps.size(), ${trace.length}u);`]);
    }
    function declarations(): string[] {
        const whole = (state_: ShapeState): string =>
            question === "intersection" ? `abut::polytope(${cppShape(state_)}, ${cppFloat(tolerance)})` : cppShape(state_);
        return [`const auto a = ${whole(a)};`, `const auto b = ${whole(b)};`];
    }

    const calls: Record<Question, string> = {
        closest: "abut::closest(a, b, {.trace = &trace});",
        contact: "abut::contact(a, b, {.trace = &trace});",
        intersection: `abut::${state.space ? "Polyhedron" : "Polygon"} overlap;\nabut::intersection(a, b, overlap, {.trace = &trace});`,
        sweep: `abut::sweep(a, abut::Vec${dimension}${cppVec(motion)}, b, {.trace = &trace});`,
    };
    return {
        draw,
        advance(seconds) {
            if (!isPlaying) return false;
            waited += seconds;
            if (waited >= pace) {
                waited -= pace;
                state.step = shownCount() + 1;
            }
            isPlaying = shownCount() < trace.length;
            return isPlaying;
        },
        answers: () => ({ steps: trace, shown: shownCount(), answer: answerText(shapes()) }),
        code: () => ({
            cpp: [
                "#include <abut/abut.hpp>",
                "",
                ...declarations(),
                `abut::Trace<${dimension}> trace;`,
                calls[question],
                "for (const auto& step : trace.steps)",
                `    if (const auto* gjk = std::get_if<abut::GjkStep<${dimension}>>(&step)) show(gjk->points, gjk->closest);`,
            ].join("\n"),
            javascript: [
                "// The package answers without a record of the steps.",
                `const a = ${javascriptText(shapeOf(abut, a))};`,
                `const b = ${javascriptText(shapeOf(abut, b))};`,
                `const answer = abut.${question}(${question === "sweep" ? `a, ${javascriptText(motion)}, b` : "a, b"});`,
            ].join("\n"),
        }),
        test,
        dispose: () => difference.dispose(),
    };
}
