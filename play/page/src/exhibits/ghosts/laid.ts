// A shape that is laid on the floor: its contacts with one surface, and with each part by itself.

import type { Abut } from "../../library";
import { Questions, type Contact } from "../../questions";
import { cppShape, drawShape, poseOf, localShapeOf, shapeHandle, shapeOf, turn, type ShapeState } from "../../shapes/catalogue";
import { cppTest, expectFloat, expectVec } from "../../shapes/source_text";
import type { Pane } from "../../stage/pane";
import { halfLength, type Floor } from "./floors";
import { stillFloor, drawPoints, isGhost, leaning, type TouchPoint } from "./side";

/** The shape turns back before the end of the floor. */
const end = halfLength - 2;

interface WorldContact {
    readonly a: { readonly index: number };
    readonly contact: Contact;
}

export class LaidShape {
    private readonly questions: Questions;
    private readonly still;
    private readonly parts: InstanceType<Abut["World2"]> | InstanceType<Abut["World3"]>;
    private readonly item: { readonly index: number; readonly generation: number };
    private direction = 1;
    private contacts: Contact[] = [];
    private filtered: TouchPoint[] = [];
    private unfiltered: TouchPoint[] = [];
    private angles = [0, 0];
    private ghosts = 0;

    constructor(
        private readonly abut: Abut,
        private readonly floor: Floor,
        private readonly shape: ShapeState,
    ) {
        this.questions = new Questions(abut);
        this.still = stillFloor(abut, shape.position.length === 2 ? 2 : 3, floor);
        this.parts = shape.position.length === 2 ? new abut.World2({ filter_edges: false }) : new abut.World3({ filter_edges: false });
        for (const part of floor.parts) this.parts.add(part as never, { fixed: true } as never);
        this.item = this.parts.add(localShapeOf(shape) as never);
    }

    /** Lays the shape so deep in the floor, and finds its contacts. */
    find(depth: number): void {
        const lowest = this.abut.bounds(shapeOf(this.abut, this.shape) as never).min as ArrayLike<number>;
        this.shape.position[1] = Math.fround((this.shape.position[1] ?? 0) - (lowest[1] ?? 0) - depth);
        this.shape.position[0] = Math.min(Math.max(this.shape.position[0] ?? 0, -end), end);
        const shape = shapeOf(this.abut, this.shape);
        this.contacts = this.questions.contacts(shape, this.floor.shape);
        this.filtered = this.contacts.flatMap((contact) => pointsOf(contact, -1));
        this.parts.set_shape(this.item, localShapeOf(this.shape) as never);
        this.parts.move(this.item, poseOf(this.shape) as never);
        this.parts.update();
        const contacts = this.parts.contacts() as unknown as WorldContact[];
        this.unfiltered = contacts.flatMap(({ a, contact }) => pointsOf(contact, a.index === this.item.index ? -1 : 1));
        const largest = (points: readonly TouchPoint[]): number =>
            points.reduce((angle, { normal }) => Math.max(angle, leaning(normal)), 0);
        this.angles = [this.filtered, this.unfiltered].map((points, i) => Math.max(this.angles[i] ?? 0, largest(points)));
        this.ghosts += this.unfiltered.filter(isGhost).length;
    }
    /** Slides or rolls on, to and fro. */
    advance(distance: number, rolls: boolean): void {
        const x = this.shape.position[0] ?? 0;
        if (Math.abs(x) >= end) this.direction = x > 0 ? -1 : 1;
        const step = this.direction * distance;
        this.shape.position[0] = Math.fround(x + step);
        if (rolls) turn(this.abut, this.shape, -step / this.shape.size, [0, 0, 1]);
    }

    draw(panes: readonly [Pane, Pane], changed: () => void): void {
        const shape = shapeOf(this.abut, this.shape);
        panes.forEach((pane, i) =>
            pane.draw([{ ...shapeHandle(this.abut, "shape", this.shape, changed), label: "The shape on the floor" }], (drawing) => {
                this.still.draw(drawing);
                drawShape(this.abut, pane, drawing, shape, { color: "a", fill: 0.3 });
                drawPoints(drawing, i === 0 ? this.filtered : this.unfiltered);
            }),
        );
    }
    answers(): Readonly<Record<string, number>> {
        return {
            "points, with": this.filtered.length,
            "points, without": this.unfiltered.length,
            "ghosts now, with": this.filtered.filter(isGhost).length,
            "ghosts now, without": this.unfiltered.filter(isGhost).length,
            "largest angle, with": this.angles[0] ?? 0,
            "largest angle, without": this.angles[1] ?? 0,
            "ghosts so far, without": this.ghosts,
        };
    }
    /** Lines of C++ for the floor and the shape. */
    cppLines(): string[] {
        return [...this.floor.cppLines, `const auto floor = ${this.floor.cpp};`, `const auto shape = ${cppShape(this.shape)};`];
    }
    test(): string {
        const d = this.shape.position.length;
        const lines = [
            ...this.cppLines(),
            `std::vector<abut::Contact<${d}>> contacts;`,
            `abut::each_contact(shape, floor, [&](const abut::Contact<${d}>& contact) { contacts.push_back(contact); });`,
            `ASSERT_EQ(contacts.size(), ${this.contacts.length}u);`,
        ];
        this.contacts.forEach(({ normal, points }, i) => {
            lines.push(...expectVec(`contacts[${i}].normal`, normal), `ASSERT_EQ(contacts[${i}].points.size(), ${points.length}u);`);
            points.forEach(({ position, depth }, k) => {
                const point = `contacts[${i}].points[${k}]`;
                lines.push(...expectVec(`${point}.position`, position), expectFloat(`${point}.depth`, depth));
            });
        });
        return cppTest("EachContact", lines);
    }
    dispose(): void {
        this.parts.dispose();
    }
}

function pointsOf(contact: Contact, sign: number): TouchPoint[] {
    const normal = contact.normal.map((x) => sign * x);
    return contact.points.map(({ position }) => ({ at: position, normal, isOfFloor: true }));
}
