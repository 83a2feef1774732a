// The shapes that exhibits offer: plain data for the link, and what it means for the library and in C++.

import type { Abut } from "../library";
import { floats } from "../library";
import type { AnyShape } from "../questions";
import type { Panel } from "../panel/panel";
import type { Drawing, Style } from "../stage/drawing";
import type { Handle, Pane } from "../stage/pane";
import { seededPoints } from "./seeded_points";
import { cppShape as cppPlain, type PlainShape } from "./source_text";

export { cppFloat, cppVec } from "./source_text";

/** A shape of an exhibit. In the plane `position` has two numbers, and `rotation` the cosine and sine of an angle; in space three, and the
 * unit quaternion x y z w. */
export interface ShapeState {
    kind: string;
    position: number[];
    rotation: number[];
    size: number;
    /** Of a kind that is made from a seed; 1 if there is none. */
    seed?: number;
}

/** How a kind is made: a plain shape of the npm package about the origin, about as large as its size, which is half of what is widest. */
interface Kind {
    readonly name: string;
    /** Whether it is made from a seed. */
    readonly isSeeded?: boolean;
    /** Whether it has vertices, edges and faces. */
    readonly hasCorners?: boolean;
    make(size: number, seed: number): PlainShape;
}

const scaled = (points: readonly (readonly number[])[], size: number): number[] =>
    points.flatMap((point) => point.map((x) => Math.fround(x * size)));
const ring = (count: number): number[][] =>
    Array.from({ length: count }, (_, i) => [Math.cos((2 * Math.PI * i) / count), Math.sin((2 * Math.PI * i) / count)]);

const triangle2 = [
    [-0.9, -0.7],
    [1, -0.5],
    [0.1, 1],
];
const wedge3 = [
    [-0.8, -0.6, -0.6],
    [0.8, -0.6, -0.6],
    [0.8, -0.6, 0.6],
    [-0.8, -0.6, 0.6],
    [-0.8, 0.7, -0.6],
    [-0.8, 0.7, 0.6],
];
const rock3 = [
    [0.9, 0, 0.1],
    [-0.7, 0.3, 0.2],
    [0.1, 0.9, -0.2],
    [0, -0.8, 0.3],
    [0.2, 0.1, 0.9],
    [-0.1, -0.2, -0.9],
    [0.6, 0.6, 0.5],
    [-0.5, -0.6, -0.4],
    [0.5, -0.5, -0.6],
    [-0.5, 0.6, 0.6],
];

const kinds2: Readonly<Record<string, Kind>> = {
    ball: { name: "circle", make: (s) => ({ type: "ball2", center: [0, 0], radius: s }) },
    box: { name: "box", hasCorners: true, make: (s) => ({ type: "box2", center: [0, 0], half: [s, 0.7 * s] }) },
    capsule: { name: "capsule", make: (s) => ({ type: "capsule2", a: [-0.6 * s, 0], b: [0.6 * s, 0], radius: 0.4 * s }) },
    triangle: { name: "triangle", hasCorners: true, make: (s) => ({ type: "polygon", points: scaled(triangle2, s) }) },
    hexagon: { name: "hexagon", hasCorners: true, make: (s) => ({ type: "polygon", points: scaled(ring(6), s) }) },
    segment: { name: "segment", hasCorners: true, make: (s) => ({ type: "segment2", a: [-s, 0], b: [s, 0] }) },
    rounded: {
        name: "rounded triangle",
        hasCorners: true,
        make: (s) => ({ type: "rounded", shape: { type: "polygon", points: scaled(triangle2, 0.7 * s) }, radius: 0.3 * s }),
    },
    ellipse: {
        name: "ellipse (stretched circle)",
        make: (s) => ({ type: "stretched", shape: { type: "ball2", center: [0, 0], radius: s }, scale: [1, 0.5] }),
    },
    seeded: {
        name: "polygon of a seed",
        isSeeded: true,
        hasCorners: true,
        make: (s, seed) => ({ type: "polygon", points: scaled(seededPoints(seed, 2, 14), s) }),
    },
};
const kinds3: Readonly<Record<string, Kind>> = {
    ball: { name: "ball", make: (s) => ({ type: "ball3", center: [0, 0, 0], radius: s }) },
    box: { name: "box", hasCorners: true, make: (s) => ({ type: "box3", center: [0, 0, 0], half: [s, 0.7 * s, 0.5 * s] }) },
    capsule: { name: "capsule", make: (s) => ({ type: "capsule3", a: [-0.6 * s, 0, 0], b: [0.6 * s, 0, 0], radius: 0.4 * s }) },
    cylinder: { name: "cylinder", make: (s) => ({ type: "cylinder", a: [0, -0.7 * s, 0], b: [0, 0.7 * s, 0], radius: 0.6 * s }) },
    cone: { name: "cone", make: (s) => ({ type: "cone", a: [0, -0.7 * s, 0], b: [0, 0.9 * s, 0], radius: 0.7 * s }) },
    wedge: { name: "wedge", hasCorners: true, make: (s) => ({ type: "polyhedron", points: scaled(wedge3, s) }) },
    rock: { name: "rock", hasCorners: true, make: (s) => ({ type: "polyhedron", points: scaled(rock3, s) }) },
    rounded: {
        name: "rounded box",
        hasCorners: true,
        make: (s) => ({ type: "rounded", shape: { type: "box3", center: [0, 0, 0], half: [0.7 * s, 0.5 * s, 0.3 * s] }, radius: 0.25 * s }),
    },
    ellipsoid: {
        name: "ellipsoid (stretched ball)",
        make: (s) => ({ type: "stretched", shape: { type: "ball3", center: [0, 0, 0], radius: s }, scale: [1, 0.5, 0.7] }),
    },
    seeded: {
        name: "polyhedron of a seed",
        isSeeded: true,
        hasCorners: true,
        make: (s, seed) => ({ type: "polyhedron", points: scaled(seededPoints(seed, 3, 20), s) }),
    },
};

const kindsOf = (dimension: number): Readonly<Record<string, Kind>> => (dimension === 2 ? kinds2 : kinds3);
const kindOf = (state: ShapeState): Kind => {
    const kinds = kindsOf(state.position.length);
    return (kinds[state.kind] ?? kinds["ball"]) as Kind;
};

/** What `Panel.choice` takes. */
export function shapeChoices(
    dimension: 2 | 3,
    accept: (kind: { readonly hasCorners?: boolean }) => boolean = () => true,
): Record<string, string> {
    return Object.fromEntries(Object.entries(kindsOf(dimension)).flatMap(([id, kind]) => (accept(kind) ? [[id, kind.name]] : [])));
}

/** The controls of a shape: its kind, its size, and its seed if it has one. */
export function shapeControls(panel: Panel, name: string, state: ShapeState, choices: Record<string, string>): void {
    panel.choice(
        name.charAt(0).toUpperCase() + name.slice(1),
        choices,
        () => state.kind,
        (kind) => (state.kind = kind),
    );
    panel.slider({ label: `Size of ${name}`, min: 0.2, max: 2, get: () => state.size, set: (size) => (state.size = Math.fround(size)) });
    panel.slider({
        label: `Seed of ${name}`,
        min: 1,
        max: 100,
        step: 1,
        shown: () => kindOf(state).isSeeded ?? false,
        get: () => seedOf(state),
        set: (seed) => (state.seed = seed),
    });
}

/** A number of the link may be anything. */
function seedOf(state: ShapeState): number {
    return Number.isInteger(state.seed) ? (state.seed as number) : 1;
}

/** The plain shape of the npm package about the origin. */
export function localShapeOf(state: ShapeState): PlainShape {
    return kindOf(state).make(state.size, seedOf(state));
}
/** The same, at its place. */
export function shapeOf(abut: Abut, state: ShapeState): AnyShape {
    return abut.at(localShapeOf(state) as never, poseOf(state) as never);
}
export function poseOf(state: ShapeState): { position: number[]; rotation: number[] } {
    return { position: state.position, rotation: state.rotation };
}

/** The same in C++: an expression. */
export function cppShape(state: ShapeState): string {
    return cppPlain({ type: "at", shape: localShapeOf(state), pose: poseOf(state) });
}

/** Turns the rotation of a shape by an angle; in space about an axis. */
export function turn(abut: Abut, state: ShapeState, angle: number, axis: readonly number[]): void {
    if (state.position.length === 2) {
        const [c, s] = abut.Turn.by(angle);
        const [x, y] = state.rotation as [number, number];
        state.rotation = normalized([c * x - s * y, s * x + c * y]);
    } else {
        const [px, py, pz, pw] = abut.Turn.about(axis as never, angle);
        const [qx, qy, qz, qw] = state.rotation as [number, number, number, number];
        state.rotation = normalized([
            pw * qx + px * qw + py * qz - pz * qy,
            pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw,
            pw * qw - px * qx - py * qy - pz * qz,
        ]);
    }
}
function normalized(values: number[]): number[] {
    const length = Math.hypot(...values);
    return values.map((x) => Math.fround(x / length));
}

/** A handle that moves, turns and scales the shape of a state. */
export function shapeHandle(abut: Abut, id: string, state: ShapeState, changed: () => void): Handle {
    return {
        id,
        label: `Shape ${id.toUpperCase()}, a ${kindOf(state).name}`,
        get at() {
            return state.position;
        },
        shape: shapeOf(abut, state),
        move(to) {
            state.position = to.map(Math.fround);
            changed();
        },
        turn(angle, axis) {
            turn(abut, state, angle, axis);
            changed();
        },
        scale(factor) {
            state.size = Math.fround(Math.min(Math.max(state.size * factor, 0.1), 5));
            changed();
        },
    };
}

/** Draws any shape of the library as the library does. */
export function drawShape(abut: Abut, pane: Pane, drawing: Drawing, shape: AnyShape, style: Style): void {
    const { min, max } = pane.shown();
    const isFilled = (style.fill ?? 0) > 0;
    const bytes =
        pane.dimension === 2
            ? abut.play_draw2(shape as never, min as never, max as never, isFilled)
            : abut.play_draw3(shape as never, min as never, max as never, isFilled);
    drawing.commands(floats(bytes), style);
}
