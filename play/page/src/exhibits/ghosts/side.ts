// Contacts as arrows, and the angles of their normals to straight up; both views of the exhibit share it.

import type { Abut } from "../../library";
import type { Drawing } from "../../stage/drawing";
import { StillShapes } from "../../shapes/still_shapes";
import type { Floor } from "./floors";

/** A point of a contact with the normal that pushes up the thing on the floor. */
export interface TouchPoint {
    readonly at: readonly number[];
    readonly normal: readonly number[];
    readonly isOfFloor: boolean;
}

/** The angle between a normal and up, in radians. */
export function leaning(normal: readonly number[]): number {
    return Math.acos(Math.min(Math.max(normal[1] ?? 0, -1), 1));
}
const ghostAngle = 0.02;
/** The floor is flat, so a normal that leans is none of its surface. */
export function isGhost(point: TouchPoint): boolean {
    return point.isOfFloor && leaning(point.normal) > ghostAngle;
}

/** The parts of a floor, with their seams. */
export function stillFloor(abut: Abut, dimension: 2 | 3, floor: Floor): StillShapes {
    return new StillShapes(abut, dimension, floor.parts, { color: "soft", fill: dimension === 2 ? 0.15 : 0 });
}
export function drawPoints(drawing: Drawing, points: readonly TouchPoint[]): void {
    for (const point of points) {
        const color = isGhost(point) ? "bad" : "good";
        drawing.arrow(
            point.at,
            point.at.map((x, i) => x + 0.8 * (point.normal[i] ?? 0)),
            { color, width: 2.5, onTop: true },
        );
        drawing.point(point.at, { color, width: 1, onTop: true });
    }
}
