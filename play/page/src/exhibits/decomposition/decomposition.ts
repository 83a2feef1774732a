// Decomposition: a mesh or an outline as convex parts.

import type { Exhibit } from "../../exhibit";
import { ringChoices, type Rings } from "../../shapes/rings";
import { startMesh } from "./mesh";
import { startOutline } from "./outline";

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

export const decomposition: Exhibit<State> = {
    meaning:
        "Games move convex shapes, so a mesh or an outline with notches becomes a few convex parts that cover it. The parts cover every point of the surface, and where a part bridges a notch, the surface lies deep within it: the redder, the deeper. More parts and less concavity bring them closer to the surface, for more work in every query.",
    initial: {
        space: true,
        outline: "plate",
        mesh: "knot",
        rings: structuredClone(ringChoices["plate"]?.rings ?? []),
        notch: 0,
        concavity: 0.05,
        conforming: false,
        max_parts: 16,
        max_vertices: 32,
        apart: 0.4,
    },
    panes: ({ space }) =>
        space
            ? [
                  { title: "The surface, and how deep it lies in the parts", dimension: 3, reach: 3.2 },
                  { title: "The parts", dimension: 3, reach: 3.2 },
              ]
            : [
                  { title: "The outline: drag its points", dimension: 2, reach: 3 },
                  { title: "The parts", dimension: 2, reach: 4 },
              ],
    start(context) {
        const { state, panel, restart } = context;
        panel.toggle(
            "In space",
            () => state.space,
            (value) => {
                state.space = value;
                restart();
            },
        );
        return state.space ? startMesh(context) : startOutline(context);
    },
};
