// The field of an outline with holes: distances, the gradient and the closest point, and the light of a lamp.

import type { Context, Running } from "../../exhibit";
import { cppRings, drawRings, ringChoices, ringHandles } from "../../shapes/rings";
import { cppFloat, cppTest, cppVec, expectFloat, expectVec, javascriptText } from "../../shapes/source_text";
import { Palette, type Drawing } from "../../stage/drawing";
import { asPane2, type Pane2 } from "../../stage/pane2";
import { gridOf, Raster, type Grid } from "../../stage/raster";
import type { State } from "./state";
import { drawSample, lampHandle, probeHandle, showSample, type Sample } from "./probe";

const lineSpacing = 0.25;
const minCell = 0.03;
// The sides of the squares that are evaluated, in pixels.
const [pixelsOfDistance, pixelsOfLight] = [3, 5];

export function startOutline({ abut, state, panel, panes, changed }: Context<State>): Running {
    const [distances, lights] = [asPane2(panes[0]), asPane2(panes[1])];
    const palette = new Palette(document.documentElement);
    const [bands, glow] = [new Raster(), new Raster()];
    let field: InstanceType<typeof abut.Field2> | undefined;
    let baked = "";
    let problem = "";
    let answer: Sample | undefined;

    // A link may hold any number.
    state.cell2 = Math.max(state.cell2, Math.fround(minCell));
    panel.choice(
        "Outline",
        { own: "as dragged", ...Object.fromEntries(Object.entries(ringChoices).map(([id, { name }]) => [id, name])) },
        nameOfRings,
        (id) => {
            const choice = ringChoices[id];
            if (choice) state.rings = structuredClone(choice.rings);
        },
    );
    panel.slider({
        label: "Cell",
        min: minCell,
        max: 0.5,
        logarithmic: true,
        get: () => state.cell2,
        set: (value) => (state.cell2 = Math.fround(value)),
    });
    panel.toggle(
        "Gradients",
        () => state.gradients,
        (value) => (state.gradients = value),
    );
    panel.slider({ label: "Softness", min: 0, max: 0.5, get: () => state.softness, set: (value) => (state.softness = Math.fround(value)) });

    function nameOfRings(): string {
        const text = JSON.stringify(state.rings);
        return Object.entries(ringChoices).find(([, { rings }]) => JSON.stringify(rings) === text)?.[0] ?? "own";
    }
    /** The field goes this many cells beyond the outline: 1.5 units. */
    const padding = (): number => Math.ceil(1.5 / state.cell2);
    /** Bakes the field if what it shows has changed. */
    function bake(): void {
        const wanted = JSON.stringify([state.rings, state.cell2, state.gradients]);
        if (wanted === baked) return;
        baked = wanted;
        field?.dispose();
        field = undefined;
        problem = "";
        try {
            field = abut.Field2.bake_outline(state.rings[0] ?? [], state.rings.slice(1), {
                cell: state.cell2,
                padding: padding(),
                dense: true,
                gradients: state.gradients,
            });
        } catch (error) {
            problem = error instanceof Error ? error.message : String(error);
        }
    }

    function draw(): void {
        bake();
        palette.refresh();
        const probe = state.probe2 as [number, number];
        answer = field && {
            ...field.sample(probe),
            closest: field.closest(probe),
            light: field.shadow(probe, state.lamp2 as [number, number], state.softness),
        };
        distances.draw([probeHandle(state.probe2, changed), ...ringHandles(state.rings, changed)], drawProbe);
        lights.draw([lampHandle(state.lamp2, changed), probeHandle(state.probe2, changed)], drawLamp);
        showSample(panel, answer);
        panel.answer("problem", problem || "none");
    }
    function drawProbe(drawing: Drawing): void {
        drawRings(drawing, state.rings, { color: "text", width: 2 });
        if (answer) drawSample(drawing, state.probe2, answer);
    }
    function drawLamp(drawing: Drawing): void {
        drawRings(drawing, state.rings, { color: "text", width: 2 });
        drawing.line([...state.probe2, ...state.lamp2], { color: "soft", dashed: true });
        drawing.point(state.probe2, { color: "text", width: 2.5 });
        drawing.point(state.lamp2, { color: "b", width: 6 });
    }

    /** Distances in two colours, with lines at even distances. */
    function paintDistances(grid: Grid): void {
        const values = field?.distance_many(grid.points) ?? new Float32Array(grid.points.length / 2);
        const [inside, outside] = [palette.rgb("a"), palette.rgb("b")];
        const thickness = 1.3 * pixelsOfDistance * distances.pixel();
        bands.paint(
            grid,
            (i) => ((values[i] ?? 0) < 0 ? inside : outside),
            (i) => {
                const distance = values[i] ?? 0;
                const off = Math.abs(distance - lineSpacing * Math.round(distance / lineSpacing));
                return field ? 0.08 + 0.4 * Math.exp(-1.5 * Math.abs(distance)) + 0.35 * Math.max(0, 1 - off / thickness) : 0;
            },
        );
    }
    /** The light that arrives, weaker with the distance from the lamp as it looks in a room. */
    function paintLight(grid: Grid): void {
        const lamp = state.lamp2 as [number, number];
        const values = field?.shadow_many(grid.points, lamp, state.softness) ?? new Float32Array(grid.points.length / 2);
        const color = palette.rgb("b");
        glow.paint(
            grid,
            () => color,
            (i) => {
                const far = Math.hypot((grid.points[2 * i] ?? 0) - lamp[0], (grid.points[2 * i + 1] ?? 0) - lamp[1]);
                return (0.75 * (values[i] ?? 0)) / (1 + 0.05 * far * far);
            },
        );
    }
    /** A picture that is painted anew where the view or what it shows has changed. */
    function underlay(pane: Pane2, raster: Raster, spacing: number, paint: (grid: Grid) => void): Pane2["underlay"] {
        let painted = "";
        return (pen, place) => {
            const wanted = JSON.stringify([pane.shown(), baked, state.lamp2, state.softness, palette.css("back")]);
            if (wanted !== painted) paint(gridOf(pane.shown(), spacing * pane.pixel()));
            painted = wanted;
            raster.show(pen, place);
        };
    }
    distances.underlay = underlay(distances, bands, pixelsOfDistance, paintDistances);
    lights.underlay = underlay(lights, glow, pixelsOfLight, paintLight);

    function bakeLines(): string[] {
        const lookup = state.gradients ? ", .lookup = abut::FieldLookup::gradient" : "";
        return [
            ...cppRings(state.rings),
            `const abut::FieldOptions<2> options{.cell = ${cppFloat(state.cell2)}, .padding = ${padding()}, .store = abut::FieldStore::dense${lookup}};`,
            "const auto field = abut::bake_field(outline, holes, options);",
        ];
    }
    return {
        draw,
        answers: () => ({ ...answer }),
        code: () => ({
            cpp: [
                "#include <abut/abut.hpp>\n#include <abut/bake.hpp>\n",
                ...bakeLines(),
                `const auto sample = field->sample(${cppVec(state.probe2)});   // .distance, .normal`,
                `const abut::Vec2 on_surface = field->closest(${cppVec(state.probe2)});`,
                `const float light = field->shadow(${cppVec(state.probe2)}, ${cppVec(state.lamp2)}, ${cppFloat(state.softness)});`,
            ].join("\n"),
            javascript: [
                `const outline = ${javascriptText(state.rings[0])};`,
                `const holes = ${javascriptText(state.rings.slice(1))};`,
                `const options = { cell: ${state.cell2}, padding: ${padding()}, dense: true, gradients: ${state.gradients} };`,
                "const field = abut.Field2.bake_outline(outline, holes, options);",
                `const { distance, normal } = field.sample(${javascriptText(state.probe2)});`,
                `const light = field.shadow(${javascriptText(state.probe2)}, ${javascriptText(state.lamp2)}, ${state.softness});`,
            ].join("\n"),
        }),
        test: () =>
            cppTest(
                "FieldOfTheOutline",
                [
                    ...bakeLines(),
                    ...(answer
                        ? [
                              "ASSERT_TRUE(field);",
                              `const abut::Vec2 point${cppVec(state.probe2)};`,
                              expectFloat("field->distance(point)", answer.distance),
                              ...expectVec("field->closest(point)", answer.closest),
                              expectFloat(`field->shadow(point, ${cppVec(state.lamp2)}, ${cppFloat(state.softness)})`, answer.light),
                          ]
                        : ["EXPECT_FALSE(field);"]),
                ],
                ["abut/bake.hpp"],
            ),
        dispose: () => field?.dispose(),
    };
}
