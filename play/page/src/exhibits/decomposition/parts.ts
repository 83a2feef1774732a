// How parts are shown: in colours that differ, and apart from each other.

import type { ColorName } from "../../stage/drawing";

export const partColors: readonly ColorName[] = ["a", "b", "good", "mark", "soft"];

/** How far a part moves away from the origin: by a share of its distance. */
export function apart(centroid: readonly number[], share: number): number[] {
    return centroid.map((x) => share * x);
}
