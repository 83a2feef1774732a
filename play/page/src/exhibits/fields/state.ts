// What the link of the exhibit of fields holds.

import type { Rings } from "../../shapes/rings";

export interface State {
    space: boolean;
    rings: Rings;
    mesh: string;
    /** The side of a cell, in the plane and in space. */
    cell2: number;
    cell3: number;
    gradients: boolean;
    probe2: number[];
    probe3: number[];
    lamp2: number[];
    lamp3: number[];
    softness: number;
    axis: string;
    /** Where the slice lies, as a share of the field's box. */
    slice: number;
    particles: number;
    playing: boolean;
}
