// Closest features: the Voronoi regions of a shape, and the vertex, edge or face whose region holds a point.

import type { Context, Exhibit, Running } from "../exhibit";
import { floats } from "../library";
import { spaceToggle } from "../panel/space_toggle";
import { Questions, type AnyShape, type Closest, type Feature } from "../questions";
import { cppShape, drawShape, shapeChoices, shapeControls, shapeHandle, shapeOf, type ShapeState } from "../shapes/catalogue";
import { cppTest, cppVec, expectFloat, expectVec, javascriptText } from "../shapes/source_text";
import { areasOf, type Drawing } from "../stage/drawing";
import type { Handle } from "../stage/pane";

interface State {
    space: boolean;
    a2: ShapeState;
    a3: ShapeState;
    point2: number[];
    point3: number[];
}

export const closestFeatures: Exhibit<State> = {
    meaning:
        "The Voronoi region of a feature holds every point that is nearer to it than to any other vertex, edge or face. " +
        "The point's region names the feature on which its closest point lies. " +
        "A rounded shape has the regions of its core.",
    initial: {
        space: false,
        a2: { kind: "triangle", position: [-0.2, -0.1], rotation: [0.9689124, 0.247404], size: 1.3 },
        a3: { kind: "wedge", position: [0, 0, 0], rotation: [0.1, 0.2, 0.1, 0.9695359], size: 1.1 },
        point2: [1.3, 0.9],
        point3: [1, 1.1, 0.8],
    },
    panes: ({ space }) => [{ title: "The shape and the regions of its features", dimension: space ? 3 : 2, reach: 2.4 }],
    start,
};

/** As the library numbers the kinds of features. */
const kindNames = ["a round place", "vertex", "edge", "face"] as const;
/** More vertices than this have no numbers. */
const maxLabels = 24;

function start(context: Context<State>): Running {
    const { abut, state, panel, panes, changed } = context;
    const [pane] = panes as [(typeof panes)[0]];
    const [a, point] = state.space ? [state.a3, state.point3] : [state.a2, state.point2];
    const dimension = state.space ? 3 : 2;
    spaceToggle(context);
    shapeControls(
        panel,
        "shape",
        a,
        shapeChoices(dimension, (kind) => kind.hasCorners ?? false),
    );
    for (let i = 0; i < dimension; ++i)
        panel.slider({
            label: `Point ${"xyz".charAt(i)}`,
            min: -3,
            max: 3,
            get: () => point[i] ?? 0,
            set: (value) => (point[i] = Math.fround(value)),
        });
    const ask = new Questions(abut);
    let answer: Closest | undefined;

    const pointHandle = (): Handle => ({
        id: "point",
        label: "The point",
        at: point,
        move(to) {
            to.forEach((x, i) => (point[i] = Math.fround(x)));
            changed();
        },
    });

    function draw(): void {
        const shape = shapeOf(abut, a);
        const closest = ask.closest(shape, point);
        answer = closest;
        pane.draw([pointHandle(), shapeHandle(abut, "a", a, changed)], (drawing) => {
            if (state.space) drawWalls(drawing, shape, closest.feature_a);
            else drawRegions(drawing, shape);
            drawShape(abut, pane, drawing, shape, { color: "a", fill: state.space ? 0.6 : 0, width: 2 });
            drawing.commands(featureOf(shape, closest.feature_a), { color: "mark", width: 5, fill: 0.5, onTop: true });
            drawVertexNumbers(drawing, shape);
            drawing.line([...point, ...closest.on_a], { color: "mark", width: 2, dashed: true, onTop: true });
            drawing.point(closest.on_a, { color: "mark", width: 3, onTop: true });
            drawing.point(point, { color: "text", width: 4, onTop: true });
        });
        panel.answer("closest feature", featureName(closest.feature_a));
        panel.answer("distance", closest.distance);
        panel.answer("closest point", closest.on_a);
        panel.answer("normal", closest.normal);
    }

    /** Edges and vertices have two colours; the region that holds the point is stronger. */
    function drawRegions(drawing: Drawing, shape: AnyShape): void {
        // The regions end outside of the view, so that their ends are not seen.
        const [{ min, max }, margin] = [pane.shown(), 4 * pane.pixel()];
        const [low, high] = [min.map((x) => x - margin), max.map((x) => x + margin)];
        const commands = floats(abut.play_draw_voronoi2(shape as never, low as never, high as never, true));
        for (const { points, isFaint } of areasOf(commands, 2)) {
            const holdsPoint = ask.contains({ type: "polygon", points }, point);
            drawing.polygon(points, { color: isFaint ? "b" : "a", fill: holdsPoint ? 0.4 : 0.12, alpha: 0.5 });
        }
    }
    /** The borders of all regions, and the walls around the one that holds the point. */
    function drawWalls(drawing: Drawing, shape: AnyShape, { kind, index }: Feature): void {
        const { min, max } = pane.shown();
        drawing.commands(floats(abut.play_draw_voronoi3(shape as never, min as never, max as never, false)), {
            color: "soft",
            alpha: 0.45,
        });
        drawing.commands(floats(abut.play_draw_region3(shape as never, kind, index)), { color: "b", fill: 0.3 });
    }
    function featureOf(shape: AnyShape, { kind, index }: Feature): Float32Array {
        return floats((state.space ? abut.play_draw_feature3 : abut.play_draw_feature2)(shape as never, kind, index));
    }
    function drawVertexNumbers(drawing: Drawing, shape: AnyShape): void {
        for (let i = 0; i < maxLabels; ++i) {
            const commands = featureOf(shape, { part: 0, kind: 1, index: i });
            if (commands.length === 0) return;
            drawing.text(commands.subarray(2), String(i), { color: "text" }, [0, 16]);
        }
    }

    function test(): string {
        const { distance, on_a, feature_a } = answer ?? ask.closest(shapeOf(abut, a), point);
        return cppTest("ClosestFeature", [
            `const auto a = ${cppShape(a)};`,
            `const auto answer = abut::closest(a, abut::Vec${dimension}${cppVec(point)});`,
            expectFloat("answer.distance", distance),
            ...expectVec("answer.on_a", on_a),
            `EXPECT_EQ(static_cast<int>(answer.feature_a.kind), ${feature_a.kind});  // ${featureName(feature_a)}`,
            `EXPECT_EQ(answer.feature_a.index, ${feature_a.index}u);`,
        ]);
    }

    return {
        draw,
        answers: () => ({ ...answer, name: answer && featureName(answer.feature_a) }),
        code: () => ({
            cpp: [
                "#include <abut/abut.hpp>",
                "",
                `auto a = ${cppShape(a)};`,
                `auto answer = abut::closest(a, abut::Vec${dimension}${cppVec(point)});`,
                "// answer.feature_a.kind, answer.feature_a.index",
            ].join("\n"),
            javascript: [
                `const a = ${javascriptText(shapeOf(abut, a))};`,
                `const { feature_a, distance } = abut.closest(a, ${javascriptText(point)});`,
            ].join("\n"),
        }),
        test,
    };
}

/** An edge has the numbers of its two vertices in one. */
function featureName({ kind, index }: Feature): string {
    const name = kindNames[kind] ?? "a round place";
    if (kind === 2) return `${name} from vertex ${index & 0xffff} to vertex ${index >>> 16}`;
    return kind === 0 ? name : `${name} ${index}`;
}
