// How pieces are drawn, and taken in hand.

import type { Abut } from "../../library";
import type { AnyShape, Questions } from "../../questions";
import { drawShape, turn } from "../../shapes/catalogue";
import type { Pose } from "../../shapes/puzzles";
import type { ColorName, Drawing } from "../../stage/drawing";
import type { Handle, Pane } from "../../stage/pane";

export function drawPiece(abut: Abut, pane: Pane, drawing: Drawing, shape: AnyShape, color: ColorName, isMoved: boolean): void {
    if (pane.dimension === 2) drawShape(abut, pane, drawing, shape, { color, fill: isMoved ? 0.6 : 0.25, width: isMoved ? 3 : 1.5 });
    else {
        drawShape(abut, pane, drawing, shape, { color, fill: 1, width: 0 });
        drawShape(abut, pane, drawing, shape, { color: "text" });
    }
}

/** Where a piece runs into another one on its way. */
export function drawBlock(ask: Questions, drawing: Drawing, piece: AnyShape, other: AnyShape, way: readonly number[]): void {
    const hit = ask.sweep(piece, way, other);
    if (!hit) return;
    const tip = hit.point.map((x, i) => x + (0.5 * (way[i] ?? 0)) / Math.hypot(...way));
    drawing.arrow(hit.point, tip, { color: "bad", width: 3, onTop: true });
    drawing.point(hit.point, { color: "bad", width: 4, onTop: true });
}

/** A handle of a piece in the goal; `change` takes its new pose. */
export function pieceHandle(abut: Abut, i: number, shape: AnyShape, { position, rotation }: Pose, change: (pose: Pose) => void): Handle {
    return {
        id: `piece${i}`,
        label: `Piece ${i + 1} in the goal`,
        at: position,
        shape,
        move: (to) => change({ position: to, rotation }),
        turn(angle, axis) {
            const turned = { kind: "", size: 1, position: [...position], rotation: [...rotation] };
            turn(abut, turned, angle, axis);
            change(turned);
        },
    };
}
