// Bounded shapes that don't change, which the library draws once for all frames.

import { floats, type Abut } from "../library";
import type { AnyShape } from "../questions";
import type { Drawing, Style } from "../stage/drawing";

const far = 1e4;

export class StillShapes {
    private readonly commands: Float32Array;

    constructor(
        abut: Abut,
        dimension: 2 | 3,
        shapes: readonly AnyShape[],
        private readonly style: Style,
    ) {
        const isFilled = (style.fill ?? 0) > 0;
        // Parts outside of the box are left out.
        const [min, max] = [-far, far].map((x) => new Array<number>(dimension).fill(x)) as [number[], number[]];
        const parts = shapes.map((shape) =>
            floats(
                dimension === 2 ? abut.play_draw2(shape as never, min, max, isFilled) : abut.play_draw3(shape as never, min, max, isFilled),
            ).slice(),
        );
        this.commands = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
        let end = 0;
        for (const part of parts) {
            this.commands.set(part, end);
            end += part.length;
        }
    }
    draw(drawing: Drawing): void {
        drawing.commands(this.commands, this.style);
    }
}
