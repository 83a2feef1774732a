// Broad phases: which boxes overlap, and what each structure leaves to be tested.

import type { Context, Exhibit, Running } from "../../exhibit";
import { floats, indices, json } from "../../library";
import { Palette } from "../../stage/drawing";
import type { Handle } from "../../stage/pane";
import { asPane2 } from "../../stage/pane2";
import { pixelColor, Pixels } from "../../stage/pixels";
import { within } from "../../within";
import { drawBorders, drawBoxes, drawLines, drawRings, type Boxes } from "./draw_boxes";
import { Stopwatch } from "./stopwatch";
import { structureOf, structures } from "./structures";

interface State {
    structure: string;
    scene: string;
    count: number;
    overlaps: number;
    speed: number;
    moving: boolean;
    lines: boolean;
    levels: number;
    /** The middle of a box to query, and half of its edge. */
    probe: number[];
    probeHalf: number;
}
interface TemporalCounts {
    updates: number;
    searches: number;
    looks: number;
    plain_searches: number;
    plain_looks: number;
}

export const broadPhases: Exhibit<State> = {
    meaning: structureOf("grid").meaning,
    initial: {
        structure: "grid",
        scene: "even",
        count: 2000,
        overlaps: 1,
        speed: 0.05,
        moving: true,
        lines: true,
        levels: 6,
        probe: [30, 30],
        probeHalf: 3,
    },
    panes: () => [{ title: "Boxes, and what the structure makes of them", dimension: 2, center: [50, 50], reach: 60 }],
    start,
};

/** Frames between two counts of the pairs that are left to test. */
const framesPerCount = 30;

function start({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const pane = asPane2(panes[0]);
    const palette = new Palette(document.documentElement);
    const pixels = new Pixels();
    const structure = structureOf(state.structure);
    const isTemporal = state.structure === "temporal";
    const phase = new abut.PlayBroadPhase(structure.index);
    const watches = { build: new Stopwatch(), update: new Stopwatch(), pairs: new Stopwatch() };
    let scattered = "";
    let pairs = 0;
    let candidatePairs = 0;
    let steps = 0;
    let boxes: Boxes = { corners: new Float32Array(), pairs: new Uint32Array() };
    let tests = { of: 0, instead: 0 };

    state.count = Math.round(within(state.count, 10, 20000));
    state.overlaps = within(state.overlaps, 0.1, 6);
    state.speed = within(state.speed, 0.0005, 0.5);
    state.probeHalf = within(state.probeHalf, 0.1, 50);
    if (!(state.structure in structures)) state.structure = "grid";
    panel.setMeaning(structure.meaning);
    panel.choice(
        "Structure",
        Object.fromEntries(Object.entries(structures).map(([id, { name }]) => [id, name])),
        () => state.structure,
        (id) => {
            state.structure = id;
            restart();
        },
    );
    panel.choice(
        "Scene",
        { even: "similar sizes", skewed: "clusters, all sizes" },
        () => state.scene,
        (scene) => {
            state.scene = scene;
            restart();
        },
    );
    panel.slider({
        label: "Boxes",
        min: 10,
        max: 20000,
        logarithmic: true,
        get: () => state.count,
        set: (count) => (state.count = Math.round(count)),
    });
    if (state.scene !== "skewed") {
        panel.slider({
            label: "Overlaps each",
            min: 0.1,
            max: 6,
            step: 0.1,
            get: () => state.overlaps,
            set: (overlaps) => (state.overlaps = overlaps),
        });
        panel.slider({
            label: "Speed a frame",
            min: 0.0005,
            max: 0.5,
            logarithmic: true,
            get: () => state.speed,
            set: (speed) => (state.speed = Math.fround(speed)),
        });
    }
    panel.toggle(
        "Moving",
        () => state.moving,
        (moving) => (state.moving = moving),
    );
    panel.toggle(
        isTemporal ? "Rings" : "Inner lines",
        () => state.lines,
        (lines) => (state.lines = lines),
    );
    if (!isTemporal && state.structure !== "brute_force" && state.structure !== "grid")
        panel.slider({
            label: "Levels shown",
            min: 1,
            max: 16,
            step: 1,
            get: () => state.levels,
            set: (levels) => (state.levels = levels),
        });
    if (!isTemporal) panel.insert(legend());
    panel.button("One step", () => {
        step();
        changed();
    });
    pane.underlay = (pen, place) => {
        palette.refresh();
        pixels.begin(pen, place);
        drawBoxes(pixels, palette, boxes);
        if (isTemporal) {
            if (state.lines) drawRings(pixels, palette, boxes.corners, floats(phase.not_before()), floats(phase.top_speeds()));
        } else {
            if (state.lines) drawLines(pixels, palette, floats(phase.lines()), state.levels);
            drawBorders(pixels, boxes.corners, indices(phase.candidates(probeBox())), pixelColor(palette.rgb("text"), 1), 1);
            drawBorders(pixels, boxes.corners, indices(phase.overlapping(probeBox())), pixelColor(palette.rgb("b"), 1), 2);
        }
        pixels.end(pen);
    };

    /** Places the boxes anew if their description has changed. */
    function scatter(): void {
        const wanted = JSON.stringify([state.scene, state.count, state.overlaps, state.speed]);
        if (wanted === scattered) return;
        scattered = wanted;
        if (state.scene === "skewed") phase.scatter_skewed(state.count);
        else phase.scatter(state.count, state.overlaps, 1, state.speed);
        steps = 0;
        tests = { of: 0, instead: 0 };
        for (const watch of Object.values(watches)) watch.clear();
        for (let i = 0; i < 3; ++i) watches.build.measure(() => phase.build());
        pairs = watches.pairs.measure(() => phase.find_pairs());
        read();
        countCandidates();
        const { min, max } = phase.bounds();
        pane.fit(min, max);
    }
    function step(): void {
        scatter();
        phase.step();
        const before = isTemporal ? counts() : undefined;
        watches.update.measure(() => phase.update());
        pairs = watches.pairs.measure(() => phase.find_pairs());
        if (before) {
            const after = counts();
            tests = { of: after.looks - before.looks, instead: after.plain_looks - before.plain_looks };
        }
        ++steps;
        read();
        if (steps % framesPerCount === 0) countCandidates();
    }
    function read(): void {
        boxes = { corners: floats(phase.boxes()), pairs: indices(phase.pairs()) };
    }
    function countCandidates(): void {
        if (!isTemporal) candidatePairs = phase.candidate_pairs();
    }
    const counts = (): TemporalCounts => json<TemporalCounts>(phase.counts());
    function probeBox(): { min: [number, number]; max: [number, number] } {
        const [x = 0, y = 0] = state.probe;
        const half = state.probeHalf;
        return { min: [x - half, y - half], max: [x + half, y + half] };
    }

    function handles(): Handle[] {
        if (isTemporal) return [];
        return [
            {
                id: "probe",
                label: "A box to query",
                at: state.probe,
                shape: abut.Aabb2(probeBox().min, probeBox().max),
                move(to) {
                    state.probe = to.map(Math.fround);
                    changed();
                },
                scale(factor) {
                    state.probeHalf = Math.fround(within(state.probeHalf * factor, 0.1, 50));
                    changed();
                },
            },
        ];
    }

    return {
        advance() {
            if (state.moving) step();
            return state.moving;
        },
        draw() {
            scatter();
            pane.draw(handles(), (drawing) => {
                if (isTemporal) return;
                const { min, max } = probeBox();
                const [left, low, right, high] = [...min, ...max];
                drawing.polygon([left, low, right, low, right, high, left, high], { color: "b", width: 3, fill: 0.1 });
            });
            const { build, update, pairs: search } = watches;
            panel.answer("pairs found", grouped(pairs));
            if (isTemporal) {
                panel.answer("pairs tested", `${grouped(tests.of)}, without top speeds ${grouped(tests.instead)}`);
            } else {
                panel.answer("left to test", grouped(Math.round(candidatePairs)));
                panel.answer(
                    "the query finds",
                    `${indices(phase.overlapping(probeBox())).length} of ${indices(phase.candidates(probeBox())).length} left to test`,
                );
            }
            panel.answer("build", milliseconds(build.mean));
            panel.answer("update", milliseconds(update.mean));
            panel.answer("find all pairs", milliseconds(search.mean));
            panel.answer("library, a frame", milliseconds(update.mean + search.mean));
        },
        answers: () => ({ structure: state.structure, boxes: boxes.corners.length / 4 }),
        code: () => ({ cpp: cppOf(structure, isTemporal), javascript }),
        dispose: () => phase.dispose(),
    };
}

function legend(): HTMLElement {
    const result = document.createElement("p");
    result.className = "meaning";
    result.textContent =
        "A line links the boxes of a pair. The thick box is a query to drag: it finds the boxes with thick borders. The structure leaves these to be tested, and those with black or white borders.";
    return result;
}
const grouped = (value: number): string => value.toLocaleString("en");
const milliseconds = (value: number): string => `${value.toFixed(3)} ms`;

function cppOf({ cpp, header }: { cpp: string; header: string }, isTemporal: boolean): string {
    const include = isTemporal ? "#include <abut/broad_phase/grid.hpp>\n" : "";
    const [build, update] = isTemporal ? ["build(boxes, top_speeds)", "update(boxes, seconds)"] : ["build(boxes)", "update(boxes)"];
    return `${include}#include <abut/broad_phase/${header}.hpp>

abut::${cpp} phase;
phase.${build};  // std::vector<abut::Aabb2>

// In each frame:
phase.${update};
phase.each_pair([](std::uint32_t i, std::uint32_t j) { test(i, j); });`;
}
const javascript = `// A World has its own broad phase, which it chooses by the boxes.
const world = new abut.World2();
const ids = boxes.map(({ min, max }) => world.add(abut.Aabb2(min, max)));

// In each frame:
world.move(ids[0], { position: [1, 0], rotation: [1, 0] });
const { began, stayed, ended } = world.update();`;
