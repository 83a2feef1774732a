// What the link of the exhibit of decomposition holds.

import type { Rings } from "../../shapes/rings";

export interface State {
    space: boolean;
    /** The name of a choice; "own" after its points were dragged, and "file" for a mesh that was read. */
    outline: string;
    mesh: string;
    rings: Rings;
    /** The concavity of outlines is a length, that of meshes a share of half the longest side. */
    notch: number;
    concavity: number;
    conforming: boolean;
    max_parts: number;
    max_vertices: number;
    apart: number;
}
