// Two shapes: how far apart or how deep, and the same in the Minkowski difference.

import type { Context, Exhibit, Running } from "../exhibit";
import { spaceToggle } from "../panel/space_toggle";
import { Questions, type AnyShape, type Certificate, type Closest, type Contact, type Polytope } from "../questions";
import { cppShape, drawShape, shapeChoices, shapeControls, shapeHandle, shapeOf, type ShapeState } from "../shapes/catalogue";
import { Difference } from "../shapes/difference";
import { cppFloat, cppTest, expectFloat, expectVec, javascriptText } from "../shapes/source_text";
import { drawPlane } from "../stage/plane";

interface State {
    space: boolean;
    contacts: boolean;
    overlap: boolean;
    a2: ShapeState;
    b2: ShapeState;
    a3: ShapeState;
    b3: ShapeState;
}

/** All that the library says about the two. */
interface Answer {
    closest: Closest;
    certificate: Certificate;
    overlaps: boolean;
    contact: Contact | null;
    overlap: Polytope | null;
}

export const twoShapes: Exhibit<State> = {
    meaning:
        "The distance is the gap between the shapes, or below zero the shortest move that separates them. " +
        "The Minkowski difference holds every difference of a point of A and a point of B, " +
        "so the shapes overlap exactly where it holds the origin. " +
        "The shortest vector from the origin to its border is the answer: the normal and the distance at once.",
    initial: {
        space: false,
        contacts: true,
        overlap: false,
        a2: { kind: "box", position: [-1.2, 0.3], rotation: [0.9689124, 0.247404], size: 1 },
        b2: { kind: "hexagon", position: [1.4, -0.2], rotation: [1, 0], size: 0.9 },
        a3: { kind: "box", position: [-1, 0.3, 0], rotation: [0.1, 0.2, 0.1, 0.9695359], size: 1 },
        b3: { kind: "rock", position: [1.2, -0.1, 0.2], rotation: [0, 0, 0, 1], size: 0.9 },
    },
    panes: ({ space }) => [
        { title: "The world", dimension: space ? 3 : 2, reach: 2.3 },
        { title: "Minkowski difference A − B", dimension: space ? 3 : 2, center: [-1.3, 0.2, 0], reach: 2.8 },
    ],
    start,
};

/** How far the polytopes of curved shapes may be off. */
const tolerance = 0.01;

function start(context: Context<State>): Running {
    const { abut, state, panel, panes, changed } = context;
    const [world, differencePane] = panes as [(typeof panes)[0], (typeof panes)[0]];
    const [a, b] = state.space ? [state.a3, state.b3] : [state.a2, state.b2];
    const dimension = state.space ? 3 : 2;
    spaceToggle(context);
    shapeControls(panel, "A", a, shapeChoices(dimension));
    shapeControls(panel, "B", b, shapeChoices(dimension));
    panel.toggle(
        "Contact points",
        () => state.contacts,
        (value) => (state.contacts = value),
    );
    panel.toggle(
        state.space ? "Overlap and volume" : "Overlap and area",
        () => state.overlap,
        (value) => (state.overlap = value),
    );
    const ask = new Questions(abut);
    const difference = new Difference(abut);
    let answer: Answer | undefined;

    function query(shapeA: AnyShape, shapeB: AnyShape): Answer {
        const closest = ask.closest(shapeA, shapeB);
        return {
            closest,
            certificate: ask.certify(shapeA, shapeB, closest),
            overlaps: ask.overlaps(shapeA, shapeB),
            contact: state.contacts ? ask.contact(shapeA, shapeB) : null,
            overlap:
                state.overlap && closest.distance < 0
                    ? ask.intersection(ask.polytope(shapeA, tolerance), ask.polytope(shapeB, tolerance))
                    : null,
        };
    }

    function draw(): void {
        const shapes = [shapeOf(abut, a), shapeOf(abut, b)] as const;
        answer = query(...shapes);
        drawWorld(shapes, answer);
        drawDifference(answer.closest);
        write(answer);
    }

    function drawWorld(shapes: readonly [AnyShape, AnyShape], { closest, certificate, contact, overlap }: Answer): void {
        world.draw([shapeHandle(abut, "a", a, changed), shapeHandle(abut, "b", b, changed)], (drawing) => {
            drawShape(abut, world, drawing, shapes[0], { color: "a", fill: 0.3 });
            drawShape(abut, world, drawing, shapes[1], { color: "b", fill: 0.3 });
            if (overlap) drawShape(abut, world, drawing, overlap, { color: "bad", fill: 0.5, width: 2 });
            if (closest.distance > 0)
                drawPlane(
                    drawing,
                    closest.on_a.map((x, i) => (x + (closest.on_b[i] ?? 0)) / 2),
                    closest.normal,
                    1.6,
                    "good",
                );
            else drawing.point(certificate.common, { color: "good", width: 3, onTop: true });
            for (const { position, depth } of contact?.points ?? []) {
                const half = (contact?.normal ?? []).map((x) => 0.5 * depth * x);
                drawing.line([...position.map((x, i) => x - (half[i] ?? 0)), ...position.map((x, i) => x + (half[i] ?? 0))], {
                    color: "accent",
                    width: 2,
                    onTop: true,
                });
                drawing.point(position, { color: "accent", width: 2, onTop: true });
            }
            drawing.line([...closest.on_a, ...closest.on_b], { color: closest.distance < 0 ? "bad" : "mark", width: 3, onTop: true });
            drawing.point(closest.on_a, { color: "a", width: 3, onTop: true });
            drawing.point(closest.on_b, { color: "b", width: 3, onTop: true });
            drawing.text(a.position, "A", { color: "a" });
            drawing.text(b.position, "B", { color: "b" });
        });
    }

    function drawDifference({ distance, normal }: Closest): void {
        const origin = new Array<number>(dimension).fill(0);
        differencePane.draw([], (drawing) => {
            drawShape(abut, differencePane, drawing, difference.of(a, b), { color: "accent", fill: 0.2 });
            drawing.arrow(
                origin,
                normal.map((x) => -x * distance),
                { color: distance < 0 ? "bad" : "mark", width: 3, onTop: true },
            );
            drawing.point(origin, { color: "text", width: 3, onTop: true });
            drawing.text(origin, "origin", { color: "text" }, [0, -16]);
        });
    }

    function write({ closest, certificate, overlaps, contact, overlap }: Answer): void {
        panel.answer("distance", closest.distance);
        panel.answer("normal", closest.normal);
        panel.answer("on A", closest.on_a);
        panel.answer("on B", closest.on_b);
        panel.answer("overlaps", overlaps);
        panel.answer(
            "certificate",
            !certificate.holds
                ? "does not hold"
                : closest.distance > 0
                  ? "a plane between them"
                  : "a common point, and a move that separates",
        );
        panel.answer("contact points", contact ? String(contact.points.length) : state.contacts ? "none" : "not asked");
        panel.answer(
            state.space ? "overlap volume" : "overlap area",
            !state.overlap ? "not asked" : overlap ? (state.space ? overlap.volume : overlap.area) : 0,
        );
    }

    function test(): string {
        const { closest, overlaps, contact, overlap } = answer ?? query(shapeOf(abut, a), shapeOf(abut, b));
        const lines = [
            `const auto a = ${cppShape(a)};`,
            `const auto b = ${cppShape(b)};`,
            "const auto answer = abut::closest(a, b);",
            expectFloat("answer.distance", closest.distance),
            ...expectVec("answer.normal", closest.normal),
            ...expectVec("answer.on_a", closest.on_a),
            ...expectVec("answer.on_b", closest.on_b),
            `EXPECT_EQ(abut::overlaps(a, b), ${overlaps});`,
            "EXPECT_TRUE(abut::certify(a, b, answer).holds);",
        ];
        if (contact)
            lines.push(
                "const auto contact = abut::contact(a, b);",
                expectFloat("contact.depth", contact.depth),
                `EXPECT_EQ(contact.points.size(), ${contact.points.length}u);`,
            );
        if (overlap) {
            const [type, size] = state.space ? ["Polyhedron", "volume"] : ["Polygon", "area"];
            const polytope = (name: string): string => `abut::polytope(${name}, ${cppFloat(tolerance)})`;
            lines.push(
                `abut::${type} overlap;`,
                `ASSERT_TRUE(abut::intersection(${polytope("a")}, ${polytope("b")}, overlap));`,
                `EXPECT_FLOAT_EQ(static_cast<float>(overlap.${size}()), ${cppFloat(state.space ? overlap.volume : overlap.area)});`,
            );
        }
        return cppTest("TwoShapes", lines);
    }

    return {
        draw,
        answers: () => ({
            ...answer?.closest,
            overlaps: answer?.overlaps,
            certified: answer?.certificate.holds,
            contact: answer?.contact,
            overlap: answer?.overlap && { area: answer.overlap.area, volume: answer.overlap.volume },
        }),
        code: () => ({
            cpp: [
                "#include <abut/abut.hpp>",
                "",
                `auto a = ${cppShape(a)};`,
                `auto b = ${cppShape(b)};`,
                "auto answer = abut::closest(a, b);  // .distance .normal .on_a .on_b",
                "bool certain = abut::certify(a, b, answer).holds;",
            ].join("\n"),
            javascript: [
                `const a = ${javascriptText(shapeOf(abut, a))};`,
                `const b = ${javascriptText(shapeOf(abut, b))};`,
                "const { distance, normal, on_a, on_b } = abut.closest(a, b);",
            ].join("\n"),
        }),
        test,
        dispose: () => difference.dispose(),
    };
}
