// Decomposition: a mesh or an outline as convex parts.

import type { Exhibit } from "../../exhibit";
import { spaceToggle } from "../../panel/space_toggle";
import { ringChoices } from "../../shapes/rings";
import { startMesh } from "./mesh";
import { startOutline } from "./outline";
import type { State } from "./state";

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
        spaceToggle(context);
        return context.state.space ? startMesh(context) : startOutline(context);
    },
};
