// The broad phases that the exhibit offers: how each is called, and what it does.

export interface Structure {
    readonly name: string;
    /** As the functions of play/wasm number it. */
    readonly index: number;
    readonly cpp: string;
    readonly header: string;
    readonly meaning: string;
}

const common =
    "Boxes that don't overlap can't hold shapes that touch, so a broad phase finds all pairs of boxes that overlap, each once and exactly.";

export const structures: Readonly<Record<string, Structure>> = {
    brute_force: {
        name: "brute force",
        index: 0,
        cpp: "BruteForce<2>",
        header: "brute_force",
        meaning: `${common} Brute force tests each box against all others, sixteen at a time. It is the fastest for a handful of boxes, and its time grows with the square of their number.`,
    },
    grid: {
        name: "grid",
        index: 1,
        cpp: "Grid<2>",
        header: "grid",
        meaning: `${common} The grid puts a copy of each box into the cells that it touches, and tests those in one cell only. It suits boxes of similar sizes that all move.`,
    },
    layered_grid: {
        name: "layered grid",
        index: 2,
        cpp: "LayeredGrid<2>",
        header: "layered_grid",
        meaning: `${common} The layered grid stores each box once, on the finest level whose cells are larger than it, and a box queries its own level and the coarser ones. It suits boxes of very different sizes that all move.`,
    },
    sweep_and_prune: {
        name: "sweep and prune",
        index: 3,
        cpp: "SweepAndPrune<2>",
        header: "sweep_and_prune",
        meaning: `${common} Sweep and prune sorts the boxes by where they begin along one axis, and tests those whose intervals overlap. Columns along the other axis divide long lists.`,
    },
    bvh: {
        name: "tree of boxes (BVH)",
        index: 4,
        cpp: "Bvh<2>",
        header: "bvh",
        meaning: `${common} Each node of the tree has a box around up to eight children, so one test rules out a whole branch. An update refits the boxes, and rebuilds branches that have become worse.`,
    },
    bsp: {
        name: "planes (BSP)",
        index: 5,
        cpp: "Bsp<2>",
        header: "bsp",
        meaning: `${common} Each plane parts the boxes into those below it, those above it, and those that straddle it. An update builds all planes anew, so it suits boxes that never move.`,
    },
    temporal: {
        name: "temporal, over a grid",
        index: 6,
        cpp: "Temporal<2, abut::Grid<2>>",
        header: "temporal",
        meaning: `${common} Each box has a top speed, so a gap g between two boxes can't close before g / (v + w): until then the pair is not tested. A ring shows how far a box may go before anything about it can change; it shrinks and fades until then.`,
    },
};

export function structureOf(id: string): Structure {
    return structures[id] ?? (structures["grid"] as Structure);
}
