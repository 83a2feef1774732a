// Early out lab: which test should come first, as predicted and as measured.

import type { Context, Exhibit, Running } from "../../exhibit";
import { floats, indices } from "../../library";
import { Bars } from "../../panel/bars";
import type { Handle } from "../../stage/pane";
import { within } from "../../within";
import { chartHeight, chartPoint, chartWidth, drawBreakEven, type Place } from "./break_even";
import { Measurement } from "./measurement";
import { drawSteps, rowHeight } from "./steps";

interface State {
    tests: string;
    three: boolean;
    /** Rounds of a calculation for tests A, B and C, and the share of the inputs that pass. */
    rounds: number[];
    passes: number[];
    alike: number;
    vertices: number;
    elongation: number;
    distance: number;
}

const meanings = {
    calculations:
        "Inputs must pass all tests, so the order changes the cost and never the answer. The cost of an order is t₁ + p₁ t₂ + p₁ p₂ t₃: the area of the steps, least where t / (1 − p) ascends. Each calculation really runs: branches that the processor mispredicts add some nanoseconds, and where tests depend on each other the formula is wrong, so EarlyOut orders them by samples.",
    shapes: "Bounding circles and boxes pass all pairs whose polygons overlap, so they are redundant, and pay only if they refuse enough. A test before another pays where its time is less than (1 − p) times the other's: below the curve. All of them really run, and cost more than predicted: circles and boxes refuse much the same pairs, and the polygons that remain take longer.",
};

export const earlyOut: Exhibit<State> = {
    meaning: meanings.calculations,
    initial: {
        tests: "calculations",
        three: true,
        rounds: [60, 20, 20],
        passes: [0.25, 0.5, 0.8],
        alike: 0,
        vertices: 12,
        elongation: 2,
        distance: 4,
    },
    panes: ({ tests }) => [
        { title: tests === "shapes" ? "Pairs, by the test that refuses them" : "The area of the steps is the cost", dimension: 2 },
        { title: tests === "shapes" ? "Break even before the polygons" : "Break even against B", dimension: 2 },
    ],
    start,
};

const letters = ["A", "B", "C"];
const shapeNames = ["circle", "box", "polygon"];

function start({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const [picture, curve] = panes as [(typeof panes)[0], (typeof panes)[0]];
    const isShapes = state.tests === "shapes";
    const names = isShapes ? shapeNames : letters.slice(0, state.three ? 3 : 2);
    const orders = isShapes ? [[2], [0, 2], [1, 2], [0, 1, 2], [1, 0, 2]] : permutations(names.map((_, i) => i));
    const bars = new Bars("Nanoseconds an input", ["predicted", "measured"], (value) => value.toFixed(1));
    let tests = makeTests();
    let measured = measure();
    let described = description();
    let learned: number[] = [];

    panel.setMeaning(isShapes ? meanings.shapes : meanings.calculations);
    panel.choice(
        "Tests",
        { calculations: "calculations", shapes: "bounds of polygons" },
        () => state.tests,
        (kind) => {
            state.tests = kind;
            restart();
        },
    );
    if (isShapes) {
        panel.slider({
            label: "Corners",
            min: 3,
            max: 48,
            step: 1,
            get: () => state.vertices,
            set: (vertices) => (state.vertices = vertices),
        });
        panel.slider({
            label: "Elongation",
            min: 1,
            max: 12,
            step: 0.5,
            get: () => state.elongation,
            set: (elongation) => (state.elongation = elongation),
        });
        panel.slider({
            label: "Apart, at most",
            min: 0.5,
            max: 8,
            step: 0.25,
            get: () => state.distance,
            set: (distance) => (state.distance = distance),
        });
    } else {
        panel.toggle(
            "Three tests",
            () => state.three,
            (three) => {
                state.three = three;
                restart();
            },
        );
        names.forEach((name, i) => {
            panel.slider({
                label: `Rounds of ${name}`,
                min: 1,
                max: 300,
                step: 1,
                get: () => roundsOf(i),
                set: (rounds) => (state.rounds[i] = rounds),
            });
            panel.slider({
                label: `${name} passes`,
                min: 0,
                max: 1,
                step: 0.01,
                get: () => passOf(i),
                set: (pass) => (state.passes[i] = pass),
            });
        });
        panel.slider({ label: "Dependence", min: 0, max: 1, step: 0.05, get: () => state.alike, set: (alike) => (state.alike = alike) });
    }
    panel.insert(bars.element);
    panel.button("Measure again", () => {
        begin();
        changed();
    });
    picture.fit(...pictureBox());
    curve.fit([-0.15, -0.2], [chartWidth + 0.15, chartHeight + 0.35]);

    /** What the measurements depend on. */
    function description(): string {
        return JSON.stringify([state.rounds, state.passes, state.alike, state.vertices, state.elongation, state.distance]);
    }
    function makeTests(): InstanceType<typeof abut.PlayEarlyOut> {
        if (isShapes)
            return abut.PlayEarlyOut.shapes(
                Math.round(within(state.vertices, 3, 48)),
                within(state.elongation, 1, 12),
                within(state.distance, 0.5, 8),
            );
        return abut.PlayEarlyOut.calculated(
            names.flatMap((_, i) => [roundsOf(i), passOf(i)]),
            within(state.alike, 0, 1),
        );
    }
    function measure(): Measurement {
        const alone = names.map((_, i) => [i]);
        const others = orders.filter((order) => order.length > 1);
        return new Measurement((order, repeats) => tests.run(order, repeats), tests.inputs(), [...alone, ...others]);
    }
    function roundsOf(test: number): number {
        return Math.round(within(state.rounds[test] ?? 1, 1, 300));
    }
    function passOf(test: number): number {
        return within(state.passes[test] ?? 1, 0, 1);
    }
    function begin(): void {
        tests.dispose();
        tests = makeTests();
        measured = measure();
        learned = [];
    }
    const nameOf = (order: readonly number[]): string => order.map((i) => names[i]).join(", ");
    /** Time and pass rate of each test, as measured by itself. */
    const costs = (): number[] => names.flatMap((_, i) => [measured.time([i]), measured.pass([i])]);
    const predicted = (order: readonly number[]): number => abut.play_expected_cost(costs(), order);
    /** By the formula, among the orders shown. */
    const bestOrder = (): readonly number[] =>
        isShapes
            ? orders.reduce((best, order) => (predicted(order) < predicted(best) ? order : best))
            : [...indices(abut.play_best_order(costs()))];

    function pictureBox(): [number[], number[]] {
        return isShapes
            ? [
                  [0, -6.5],
                  [8, 0.6],
              ]
            : [
                  [0, -2 * rowHeight + 0.2],
                  [2.6, 0.3],
              ];
    }
    function drawPicture(): void {
        picture.draw([], (drawing) => {
            if (isShapes) {
                (["a", "b", "good", "mark"] as const).forEach((color, i) => {
                    drawing.commands(floats(tests.draw(i, true)), { color, fill: 0.3, width: 1.2 });
                    drawing.text([2 * i + 1, -6.3], names[i] ?? "overlap", { color });
                });
                return;
            }
            const given = names.map((_, i) => i);
            drawSteps(abut, drawing, `${nameOf(given)}: ${predicted(given).toFixed(1)} ns`, names, costs(), given, 2.6, 0, picture.pixel());
            const best = bestOrder();
            drawSteps(
                abut,
                drawing,
                `the best, ${nameOf(best)}: ${predicted(best).toFixed(1)} ns`,
                names,
                costs(),
                best,
                2.6,
                -rowHeight,
                picture.pixel(),
            );
        });
    }

    /** Tests before the last one of shapes; of calculations, A and C against B. */
    function places(): Place[] {
        const colors = ["a", "b", "mark"] as const;
        const against = isShapes ? 2 : 1;
        return names.flatMap((name, i) => {
            if (isShapes && i === against) return [];
            const [pass, ratio] = isShapes
                ? [measured.pass([i]), measured.time([i]) / Math.max(measured.time([against]), 1e-9)]
                : [passOf(i), roundsOf(i) / roundsOf(against)];
            return [{ name, pass, ratio, color: colors[i] ?? "a" }];
        });
    }
    function handles(): Handle[] {
        if (isShapes) return [];
        return places().map((place, i) => ({
            id: `test${i}`,
            label: `Test ${place.name}: left and right for how many inputs pass, up and down for its cost`,
            at: chartPoint(place.pass, place.ratio),
            move([x = 0, y = 0]) {
                state.passes[i] = Math.fround(within(x / chartWidth, 0, 1));
                // The cost of B is the unit.
                if (i !== 1) state.rounds[i] = Math.round(within(y * roundsOf(1), 1, 300));
                changed();
            },
        }));
    }

    return {
        advance() {
            if (described !== description()) {
                described = description();
                begin();
            }
            const start = performance.now();
            while (!measured.isDone && performance.now() - start < 8) measured.advance();
            if (measured.isDone && learned.length === 0) learned = [...indices(tests.learn(names.map((_, i) => measured.time([i]))))];
            return !measured.isDone;
        },
        draw() {
            drawPicture();
            curve.draw(handles(), (drawing) => drawBreakEven(abut, drawing, isShapes ? 1 : passOf(1), isShapes, places(), curve.pixel()));
            const best = nameOf(bestOrder());
            bars.show(
                orders.map((order) => ({
                    label: nameOf(order),
                    values: [predicted(order), measured.has(order) ? measured.time(order) : NaN],
                    marked: nameOf(order) === best,
                })),
            );
            panel.answer("measured", measured.isDone ? "all runs" : `${Math.round(100 * measured.progress)} % of the runs`);
            names.forEach((name, i) =>
                panel.answer(name, `${measured.time([i]).toFixed(1)} ns, passes ${(100 * measured.pass([i])).toFixed(1)} %`),
            );
            panel.answer("best by formula", best);
            panel.answer("EarlyOut chooses", learned.length > 0 ? nameOf(learned) : "...");
            if (isShapes)
                for (const i of [0, 1])
                    panel.answer(
                        `${names[i]} pays`,
                        abut.play_worth_pretesting(measured.time([i]), measured.pass([i]), measured.time([2])),
                    );
        },
        code: () => ({ cpp: isShapes ? cppShapes : cppOf(names, costs()), javascript }),
        dispose: () => tests.dispose(),
    };
}

function permutations(items: readonly number[]): number[][] {
    if (items.length <= 1) return [[...items]];
    return items.flatMap((first) => permutations(items.filter((item) => item !== first)).map((rest) => [first, ...rest]));
}

function cppOf(names: readonly string[], costs: readonly number[]): string {
    const tests = names.map((_, i) => `{${(costs[2 * i] ?? 0).toFixed(1)}, ${(costs[2 * i + 1] ?? 0).toFixed(3)}}`).join(", ");
    const calls = names.map((name) => `test_${name.toLowerCase()}`).join(", ");
    return `#include <abut/query/early_out.hpp>

const std::array<abut::TestCost, ${names.length}> tests{{${tests}}};  // {time, pass}
abut::best_order(tests);
abut::expected_cost(tests, abut::best_order(tests));

// Or measured as the game runs:
abut::EarlyOut all{${calls}};
for (const Input& input : inputs)
    if (all.measured(input)) act_on(input);
all.reorder();  // between frames`;
}
const cppShapes = `#include <abut/query/early_out.hpp>

// Times and pass rates as measured: a redundant test first?
if (abut::worth_pretesting(circle_time, circle_pass, polygon_time))
    result = abut::overlaps(circle_a, circle_b) && abut::overlaps(a, b);
else
    result = abut::overlaps(a, b);`;
const javascript = `// A World measures by itself whether to test bounding balls before shapes.
const world = new abut.World2();
world.add(a);
world.add(b);
const { began } = world.update();`;
