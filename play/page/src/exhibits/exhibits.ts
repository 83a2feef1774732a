// All exhibits, in the order of the menu. Each is loaded when it is first opened.

import type { AnyExhibit } from "../exhibit";

export interface Entry {
    /** Stands in the link. */
    readonly id: string;
    readonly title: string;
    load(): Promise<AnyExhibit>;
}

export const exhibits: readonly Entry[] = [
    { id: "two-shapes", title: "Two shapes", load: async () => (await import("./two_shapes")).twoShapes },
    { id: "steps", title: "Step by step", load: async () => (await import("./steps/steps")).steps },
    { id: "sweep", title: "Sweep", load: async () => (await import("./sweep/sweep")).sweep },
    { id: "closest-features", title: "Closest features", load: async () => (await import("./closest_features")).closestFeatures },
    { id: "early-out", title: "Early out", load: async () => (await import("./early_out/early_out")).earlyOut },
    { id: "broad-phases", title: "Broad phases", load: async () => (await import("./broad_phases/broad_phases")).broadPhases },
    { id: "fields", title: "Fields", load: async () => (await import("./fields/fields")).fields },
    { id: "walk-mesh", title: "Walk mesh", load: async () => (await import("./walk_mesh/walk_mesh")).walkMesh },
    { id: "decomposition", title: "Decomposition", load: async () => (await import("./decomposition/decomposition")).decomposition },
    { id: "rearrangement", title: "Rearrangement", load: async () => (await import("./rearrangement/rearrangement")).rearrangement },
    { id: "ghosts", title: "Ghosts", load: async () => (await import("./ghosts/ghosts")).ghosts },
    { id: "toys", title: "Toys", load: async () => (await import("./toys/toys")).toys },
    { id: "scene-viewer", title: "Scene viewer", load: async () => (await import("./scene_viewer/scene_viewer")).sceneViewer },
];
