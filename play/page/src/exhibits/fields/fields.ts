// Fields: the signed distance to a surface, sampled once and known everywhere.

import type { Exhibit } from "../../exhibit";
import { spaceToggle } from "../../panel/space_toggle";
import { ringChoices } from "../../shapes/rings";
import { startMesh } from "./mesh";
import { startOutline } from "./outline";
import type { State } from "./state";

export const fields: Exhibit<State> = {
    meaning:
        "A field holds the signed distance to a surface on a grid: below zero inside, and 0 on the surface. One look-up gives the distance at any point, the direction in which it grows, and the closest point of the surface, at the same cost for ten triangles as for a million. A ray to a lamp steps by these distances, and the narrowest gap on its way is the softness of the shadow.",
    initial: {
        space: true,
        rings: structuredClone(ringChoices["plate"]?.rings ?? []),
        mesh: "knot",
        cell2: 0.06,
        cell3: 0.1,
        gradients: false,
        probe2: [0.2, 2.1],
        probe3: [0, 0.6, 0],
        lamp2: [1.6, 2.6],
        lamp3: [2.4, 2.4, 0.6],
        softness: 0.1,
        axis: "z",
        slice: 0.5,
        particles: 10_000,
        playing: false,
    },
    panes: ({ space }) =>
        space
            ? [
                  { title: "Distance in a slice", dimension: 3, reach: 2.6 },
                  { title: "Soft shadow and particles, by shaders", dimension: 3, reach: 3.4 },
              ]
            : [
                  { title: "Distance: drag the points", dimension: 2, reach: 3 },
                  { title: "Soft shadow", dimension: 2, reach: 3 },
              ],
    start(context) {
        spaceToggle(context);
        return context.state.space ? startMesh(context) : startOutline(context);
    },
};
