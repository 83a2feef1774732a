// An outline with holes, whose points can be dragged, and its convex parts.

import type { Context, Running } from "../../exhibit";
import { json } from "../../library";
import { addPoint, cppRings, drawRings, ringChoices, ringHandles } from "../../shapes/rings";
import { cppTest, javascriptText } from "../../shapes/source_text";
import type { Drawing } from "../../stage/drawing";
import { apart, partColors } from "./parts";
import type { State } from "./state";

interface Decomposition {
    readonly report: {
        reflex_corners: number;
        pieces: number;
        min_pieces: number;
        optimal: number;
        area: number;
        area_added: number;
        filled_holes: number;
    };
    readonly parts: { points: number[][]; centroid: number[] }[];
}
const none: Decomposition = {
    report: { reflex_corners: 0, pieces: 0, min_pieces: 0, optimal: 0, area: 0, area_added: 0, filled_holes: 0 },
    parts: [],
};

export function startOutline({ abut, state, panel, panes, changed }: Context<State>): Running {
    const [input, output] = panes as [(typeof panes)[0], (typeof panes)[0]];
    panel.setMeaning(
        "Games move convex shapes, so an outline with notches and holes becomes a few convex parts that cover it. All cuts run between its points, so nothing is rounded, and without concavity the parts neither overlap nor extend beyond it. With concavity, notches shallower than that length stay in one part: there are fewer parts, and they add a little area.",
    );
    panel.choice(
        "Outline",
        { own: "as dragged", ...Object.fromEntries(Object.entries(ringChoices).map(([id, { name }]) => [id, name])) },
        () => state.outline,
        (outline) => {
            const choice = ringChoices[outline];
            state.outline = outline;
            if (choice) state.rings = structuredClone(choice.rings);
        },
    );
    panel.slider({ label: "Concavity", min: 0, max: 1, get: () => state.notch, set: (value) => (state.notch = Number(value.toFixed(3))) });
    panel.toggle(
        "Conforming",
        () => state.conforming,
        (value) => (state.conforming = value),
    );
    panel.slider({ label: "Pulled apart", min: 0, max: 1, get: () => state.apart, set: (value) => (state.apart = value) });
    panel.button("Add a point", () => {
        addPoint(state.rings);
        moved();
    });
    let answer = none;

    const exact = (): boolean => state.notch === 0;
    function moved(): void {
        state.outline = "own";
        changed();
    }
    function decompose(): string {
        const ends = state.rings.map((_, k) => state.rings.slice(0, k + 1).flat().length / 2);
        try {
            answer = json<Decomposition>(abut.play_decompose_outline(state.rings.flat(), ends, state.conforming && exact(), state.notch));
            return "";
        } catch (error) {
            answer = none;
            return error instanceof Error ? error.message : String(error);
        }
    }

    function draw(): void {
        const problem = decompose();
        const { report, parts } = answer;
        input.draw(ringHandles(state.rings, moved), (drawing) =>
            drawRings(drawing, state.rings, { color: problem ? "bad" : "text", width: 2 }),
        );
        output.draw([], (drawing) => parts.forEach((part, i) => drawPart(drawing, part, i)));
        panel.answer("parts", `${parts.length}${report.optimal ? ", the fewest" : ""}`);
        panel.answer("at least", String(report.min_pieces));
        panel.answer("reflex corners", String(report.reflex_corners));
        panel.answer("area", report.area);
        panel.answer("area added", report.area_added);
        panel.answer("problem", problem || "none");
    }
    function drawPart(drawing: Drawing, { points, centroid }: Decomposition["parts"][0], index: number): void {
        const move = apart(centroid, state.apart);
        drawing.polygon(
            points.flatMap((point) => point.map((x, i) => x + (move[i] ?? 0))),
            { color: partColors[index % partColors.length] ?? "a", fill: 0.35 },
        );
    }

    function decomposeLines(): string[] {
        const options = `{.concavity = ${state.notch}, .conforming = ${state.conforming && exact()}}`;
        return [...cppRings(state.rings), `const auto parts = abut::decompose(outline, holes, ${options});`];
    }
    return {
        draw,
        answers: () => ({ parts: answer.parts.length, ...answer.report }),
        code: () => ({
            cpp: ["#include <abut/bake.hpp>\n", ...decomposeLines()].join("\n"),
            javascript: [
                `const outline = ${javascriptText(state.rings[0])};`,
                `const holes = ${javascriptText(state.rings.slice(1))};`,
                `const parts = abut.decompose_outline(outline, holes, ${state.notch});`,
            ].join("\n"),
        }),
        test: () =>
            cppTest(
                "DecomposesTheOutline",
                [
                    ...decomposeLines(),
                    ...(answer.parts.length > 0
                        ? ["ASSERT_TRUE(parts);", `EXPECT_EQ(parts->size(), ${answer.parts.length}u);`]
                        : ["EXPECT_FALSE(parts);"]),
                ],
                ["abut/bake.hpp"],
            ),
    };
}
