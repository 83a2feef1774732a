// The Minkowski difference A - B of two shapes, which changes only if one of them turns, grows or becomes another.

import type { Abut } from "../library";
import { Questions, type AnyShape } from "../questions";
import { localShapeOf, type ShapeState } from "./catalogue";
import type { PlainShape } from "./source_text";

/** How far the polytope of a cylinder or another curved core may be off, by the dimension. */
const tolerances = { 2: 0.003, 3: 0.02 } as const;

export class Difference {
    private readonly ask: Questions;
    private key = "";
    private atOrigin: { dispose(): void } | undefined;

    constructor(private readonly abut: Abut) {
        this.ask = new Questions(abut);
    }

    /** The difference of the shapes at their places. */
    of(a: ShapeState, b: ShapeState): AnyShape {
        const key = JSON.stringify([a, b].map(({ position, ...rest }) => [position.length, rest]));
        if (key !== this.key || !this.atOrigin) {
            this.atOrigin?.dispose();
            this.atOrigin = this.build(a, b);
            this.key = key;
        }
        const rotation = a.rotation.map((_, i) => (i === (a.rotation.length === 2 ? 0 : 3) ? 1 : 0));
        return this.ask.at(
            this.atOrigin,
            a.position.map((x, i) => x - (b.position[i] ?? 0)),
            rotation,
        );
    }
    dispose(): void {
        this.atOrigin?.dispose();
    }

    private build(a: ShapeState, b: ShapeState): { dispose(): void } {
        const tolerance = a.position.length === 2 ? tolerances[2] : tolerances[3];
        const [first, second] = [a, b].map((state) => {
            const { core, radius } = coreOf(localShapeOf(state));
            const turned = this.ask.at(
                core,
                state.position.map(() => 0),
                state.rotation,
            );
            return { radius, polytope: this.ask.polytope(turned, tolerance) };
        }) as [{ radius: number; polytope: AnyShape }, { radius: number; polytope: AnyShape }];
        const sharp = this.ask.minkowskiDifference(first.polytope, second.polytope);
        const radius = first.radius + second.radius;
        return this.abut.build((radius > 0 ? { type: "rounded", shape: sharp, radius } : sharp) as never) as { dispose(): void };
    }
}

/** A shape as a core and the radius of a ball around each point of it: the radius of a difference is the sum of both. */
function coreOf(shape: PlainShape): { core: PlainShape; radius: number } {
    const points = (...names: string[]): PlainShape => {
        const numbers = names.flatMap((name) => shape[name] as number[]);
        return { type: shape.type.endsWith("2") ? "polygon" : "polyhedron", points: numbers };
    };
    switch (shape.type) {
        case "ball2":
        case "ball3":
            return { core: points("center"), radius: shape["radius"] as number };
        case "capsule2":
        case "capsule3":
            return { core: points("a", "b"), radius: shape["radius"] as number };
        case "rounded":
            return { core: shape["shape"] as PlainShape, radius: shape["radius"] as number };
        default:
            return { core: shape, radius: 0 };
    }
}
