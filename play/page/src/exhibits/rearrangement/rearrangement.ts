// Convex pieces taken apart along a direction, or moved from one arrangement to another.

import type { Context, Exhibit, Running } from "../../exhibit";
import { json } from "../../library";
import { Questions, type AnyShape } from "../../questions";
import { inARow, puzzles, quarterTurn, type Piece, type Pose, type Puzzle } from "../../shapes/puzzles";
import type { ColorName, Drawing } from "../../stage/drawing";
import type { Handle, Pane } from "../../stage/pane";
import { Pane3 } from "../../stage/pane3";
import { orderCode, planCode } from "./code";
import { drawBlock, drawPiece, pieceHandle } from "./drawing";
import { boxAround, boxAt, moveAt, posesAt, type Move } from "./moves";
import { orderTest, overlapTest, planTest } from "./tests";

interface State {
    puzzle: string;
    /** "apart" or "rearrange" */
    task: string;
    seed: number;
    count: number;
    gap: number;
    /** "turned", "row" or "own" */
    goal: string;
    /** The poses of the user's own goal: position and rotation of each piece. */
    own: number[][];
    direction: number[];
    /** Moves done, with the part of the next one. */
    moment: number;
    playing: boolean;
    speed: number;
}
interface Plan {
    readonly moves: readonly Move[];
    /** Pieces that block one another, each blocked by the next. */
    readonly cycle: readonly number[];
    readonly overlapping: readonly number[];
    readonly order: readonly number[];
}

const colors: readonly ColorName[] = ["a", "b", "good", "mark"];
const maxCount = 24;
// Where a piece has left the picture.
const far = 6;

export const rearrangement: Exhibit<State> = {
    meaning:
        "A disassembly order moves convex pieces away along one direction, one at a time, and none runs into another one. " +
        "In the plane there is always such an order; in space three sticks can lie so that each is blocked by the next, " +
        "and the library names this cycle. A rearrangement is a list of straight moves and rotations in place, " +
        "in which each translation was tested by a sweep against all other pieces.",
    initial: {
        puzzle: "square",
        task: "apart",
        seed: 5,
        count: 9,
        gap: 0,
        goal: "turned",
        own: [],
        direction: [0, 1, 0],
        moment: 0,
        playing: false,
        speed: 1,
    },
    panes: ({ puzzle, task }) => {
        const { dimension } = puzzleOf(puzzle);
        const reach = dimension === 2 ? 2.2 : 3.2;
        const now = {
            title: task === "rearrange" ? "The pieces now" : dimension === 2 ? "Numbered in the order of leaving" : "The pieces",
            dimension,
            reach,
        };
        return task === "apart" ? [now] : [now, { title: "The goal", dimension, reach }];
    },
    start,
};

function puzzleOf(name: string): Puzzle {
    return puzzles[name] ?? puzzles["square"]!;
}

function start({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const puzzle = puzzleOf(state.puzzle);
    const { dimension } = puzzle;
    const isApart = state.task === "apart";
    const [now, goal] = panes as [Pane, Pane | undefined];
    const ask = new Questions(abut);
    // The direction (1, 1, 1) is seen from the side.
    for (const pane of panes) if (pane instanceof Pane3) pane.camera.orbit(0.9, 0);
    let planned = "";
    let fitted: readonly [string, string] = ["", ""];
    let pieces = makePieces();
    let from: Pose[] = [];
    let to: Pose[] = [];
    let plan: Plan = { moves: [], cycle: [], overlapping: [], order: [] };
    let clearance = Infinity;

    const restartAtFirst = (): void => {
        Object.assign(state, { moment: 0, playing: false });
        restart();
    };
    panel.choice(
        "Pieces",
        Object.fromEntries(Object.entries(puzzles).map(([id, { name }]) => [id, name])),
        () => state.puzzle,
        (id) => {
            const next = puzzleOf(id);
            Object.assign(state, { puzzle: id, own: [], goal: "turned", direction: [...next.direction, 0].slice(0, 3) });
            restartAtFirst();
        },
    );
    panel.choice(
        "Task",
        { apart: "take apart", rearrange: "rearrange" },
        () => state.task,
        (task) => {
            state.task = task;
            restartAtFirst();
        },
    );
    if (!isApart)
        panel.choice(
            "Goal",
            { turned: "a quarter turn", row: "in a row", own: "as you drag it" },
            () => state.goal,
            (value) => setGoal(value),
        );
    if (puzzle.isRandom) {
        panel.slider({ label: "Number", min: 2, max: maxCount, step: 1, get: () => state.count, set: (count) => anew({ count }) });
        panel.slider({ label: "Arrangement", min: 1, max: 50, step: 1, get: () => state.seed, set: (seed) => anew({ seed }) });
    }
    if (puzzle.isPacked)
        panel.slider({ label: "Gap", min: 0, max: 0.5, get: () => state.gap, set: (gap) => anew({ gap: Math.fround(gap) }) });
    if (isApart && dimension === 3)
        panel.choice(
            "Direction",
            { "1,1,1": "(1, 1, 1)", "1,0,0": "(1, 0, 0)", "0,1,0": "(0, 1, 0)", "0,0,1": "(0, 0, 1)", own: "as you drag it" },
            directionName,
            (name) => {
                if (name !== "own") setDirection(name.split(",").map(Number));
            },
        );
    panel.slider({
        label: "Progress",
        min: 0,
        max: 100,
        step: 0.1,
        unit: " %",
        get: () => Math.round((1000 * state.moment) / Math.max(plan.moves.length, 1)) / 10,
        set: (percent) => Object.assign(state, { playing: false, moment: Math.fround((percent * plan.moves.length) / 100) }),
    });
    panel.slider({
        label: "Moves a second",
        min: 0.25,
        max: 8,
        logarithmic: true,
        get: () => state.speed,
        set: (speed) => (state.speed = Math.fround(speed)),
    });
    const play = panel.button("Play", () => {
        if (!state.playing && state.moment >= plan.moves.length) state.moment = 0;
        state.playing = !state.playing;
        changed();
    });
    panel.button("Step back", () => step(Math.ceil(state.moment) - 1));
    panel.button("Step", () => step(Math.floor(state.moment) + 1));
    panel.button("To the start", () => step(0));

    function makePieces(): Piece[] {
        // A link can hold any numbers.
        const whole = (value: number, max: number): number => Math.min(Math.max(Math.round(value), 1), max);
        return puzzle.make(abut, whole(state.seed, 50), whole(state.count, maxCount));
    }
    function step(moment: number): void {
        Object.assign(state, { playing: false, moment: Math.min(Math.max(moment, 0), plan.moves.length) });
        changed();
    }
    /** Other pieces: all that follows from them begins again. */
    function anew(changes: Partial<State>): void {
        Object.assign(state, changes, { moment: 0, playing: false, own: [], goal: state.goal === "own" ? "turned" : state.goal });
        pieces = makePieces();
    }
    function setGoal(value: string): void {
        if (value === "own") state.own = to.map(({ position, rotation }) => [...position, ...rotation]);
        Object.assign(state, { goal: value, moment: 0, playing: false });
    }
    function setDirection(direction: readonly number[]): void {
        const length = Math.hypot(...direction);
        if (!(length > 1e-3)) return;
        Object.assign(state, { direction: direction.map((x) => Math.fround(x / length)), moment: 0, playing: false });
        if (state.direction.length === 2) state.direction.push(0);
    }
    function directionName(): string {
        const [first = 1] = state.direction.filter((x) => Math.abs(x) > 1e-6);
        const name = state.direction.map((x) => Number((x / first).toFixed(4))).join(",");
        return first > 0 && ["1,1,1", "1,0,0", "0,1,0", "0,0,1"].includes(name) ? name : "own";
    }
    function direction(): number[] {
        const result = state.direction.slice(0, dimension);
        return Math.hypot(...result) > 1e-3 && result.length === dimension ? result : [...puzzle.direction];
    }

    function goalPoses(): Pose[] {
        const own = state.own.filter(
            (numbers) => Array.isArray(numbers) && numbers.length === (dimension === 2 ? 4 : 7) && numbers.every(Number.isFinite),
        );
        if (state.goal === "own" && own.length === pieces.length)
            return own.map((numbers) => ({ position: numbers.slice(0, dimension), rotation: numbers.slice(dimension) }));
        return state.goal === "row" ? inARow(pieces) : from.map(quarterTurn);
    }
    /** The library's plan, made again only if the question has changed. */
    function replan(): void {
        const key = JSON.stringify([state.seed, state.count, state.gap, state.goal, state.own, state.direction]);
        if (key === planned) return;
        planned = key;
        from = pieces.map(({ pose }) => ({
            position: pose.position.map((x) => Math.fround(x * (puzzle.isPacked ? 1 + state.gap : 1))),
            rotation: pose.rotation,
        }));
        to = goalPoses();
        plan = isApart ? planApart() : planRearranged();
        state.moment = Math.min(Math.max(state.moment, 0), plan.moves.length);
    }
    function planApart(): Plan {
        const placed = pieces.map(({ shape }, i) => placedAt(shape, from[i] as Pose));
        const bytes =
            dimension === 2
                ? abut.play_removal_order2(placed as never, direction())
                : abut.play_removal_order3(placed as never, direction());
        const { order, cycle } = json<{ order: number[]; cycle: number[] }>(bytes);
        const length = Math.hypot(...direction());
        const moves = order.map((shape) => {
            const begin = from[shape] as Pose;
            return {
                shape,
                from: begin,
                to: { ...begin, position: begin.position.map((x, i) => x + (far * (direction()[i] ?? 0)) / length) },
            };
        });
        return { moves, cycle, overlapping: [], order };
    }
    function planRearranged(): Plan {
        const shapes = pieces.map(({ shape }) => shape);
        const bytes =
            dimension === 2
                ? abut.play_rearrange2(shapes as never, from as never, to as never, direction())
                : abut.play_rearrange3(shapes as never, from as never, to as never, direction());
        const { moves, stuck, overlapping } = json<{ moves: Move[]; stuck: number[]; overlapping: number[] }>(bytes);
        return { moves, cycle: stuck, overlapping, order: [] };
    }
    function placedAt(shape: AnyShape, { position, rotation }: Pose): AnyShape {
        return ask.at(shape, position, rotation);
    }

    function draw(): void {
        replan();
        const poses = posesAt(from, plan.moves, state.moment);
        const shapes = pieces.map(({ shape }, i) => placedAt(shape, poses[i] as Pose));
        const moved = state.moment > 0 ? moveAt(plan.moves, state.moment) : undefined;
        const gone = new Set(isApart ? plan.moves.slice(0, Math.floor(state.moment)).map(({ shape }) => shape) : []);
        clearance =
            moved && !gone.has(moved.shape)
                ? Math.min(
                      ...shapes.map((shape, i) =>
                          i === moved.shape || gone.has(i) ? Infinity : ask.closest(shapes[moved.shape] as AnyShape, shape).distance,
                      ),
                  )
                : Infinity;
        fit();
        now.draw(isApart ? [directionHandle()] : [], (drawing) => {
            shapes.forEach((shape, i) => {
                if (!gone.has(i)) drawNumbered(now, drawing, i, shape, poses[i] as Pose, moved?.shape === i);
            });
            if (isApart) drawDirection(drawing);
            const way = direction().map((x) => (far * x) / Math.hypot(...direction()));
            const next = (i: number): number => plan.cycle[(i + 1) % plan.cycle.length] ?? 0;
            plan.cycle.forEach((piece, i) => drawBlock(ask, drawing, shapes[piece] as AnyShape, shapes[next(i)] as AnyShape, way));
        });
        if (goal) drawGoal(goal);
        play.textContent = state.playing ? "Pause" : "Play";
        play.disabled = plan.moves.length === 0;
        answer(moved);
    }
    function answer(moved: Move | undefined): void {
        panel.answer("pieces", String(pieces.length));
        panel.answer(
            "moves",
            plan.overlapping.length > 0
                ? `no plan: pieces ${plan.overlapping.map((i) => i + 1).join(", ")} overlap`
                : String(plan.moves.length),
        );
        panel.answer("cycle", plan.cycle.length > 0 ? [...plan.cycle, plan.cycle[0] ?? 0].map(nameOf).join(" is blocked by ") : "none");
        panel.answer(
            "move",
            state.moment > 0 && moved
                ? `${Math.ceil(state.moment)} of ${plan.moves.length}, of piece ${nameOf(moved.shape)}`
                : "at the start",
        );
        panel.answer("clearance", Number.isFinite(clearance) ? clearance : "nothing moves");
    }
    /** The place in the order, a letter in a cycle, or the number of the piece. */
    function nameOf(i: number): string {
        if (plan.cycle.includes(i)) return String.fromCharCode(65 + plan.cycle.indexOf(i));
        const place = plan.order.indexOf(i);
        return isApart ? (place < 0 ? "–" : String(place + 1)) : String(i + 1);
    }
    function drawNumbered(pane: Pane, drawing: Drawing, i: number, shape: AnyShape, { position }: Pose, isMoved: boolean): void {
        drawPiece(abut, pane, drawing, shape, colors[i % colors.length] ?? "a", isMoved);
        const end = isApart ? (pieces[i]?.end ?? []) : [];
        // In space a number of a hidden piece would be misread.
        if (dimension === 2 || isMoved || pieces.length <= 3)
            drawing.text(
                position.map((x, axis) => x + (end[axis] ?? 0)),
                nameOf(i),
                { color: "text" },
            );
    }
    function drawGoal(pane: Pane): void {
        const shapes = pieces.map(({ shape }, i) => placedAt(shape, to[i] as Pose));
        const handles = to.map((pose, i) => pieceHandle(abut, i, shapes[i] as AnyShape, pose, (changes) => changeGoal(i, changes)));
        pane.draw(handles, (drawing) =>
            shapes.forEach((shape, i) => {
                const color = plan.overlapping.includes(i) ? "bad" : (colors[i % colors.length] ?? "a");
                drawPiece(abut, pane, drawing, shape, color, false);
                if (dimension === 2) drawing.text(to[i]?.position ?? [], String(i + 1), { color: "text" });
            }),
        );
    }
    function changeGoal(i: number, { position, rotation }: Pose): void {
        if (state.goal !== "own") setGoal("own");
        state.own[i] = [...position, ...rotation].map(Math.fround);
        Object.assign(state, { moment: 0, playing: false });
        changed();
    }
    const arrowLength = dimension === 2 ? 1.75 : 2.2;
    function arrowTip(): number[] {
        const along = direction();
        return along.map((x) => (arrowLength * x) / Math.hypot(...along));
    }
    function directionHandle(): Handle {
        return {
            id: "direction",
            label: "Direction in which the pieces leave",
            at: arrowTip(),
            move: (to) => {
                setDirection(to);
                changed();
            },
        };
    }
    function drawDirection(drawing: Drawing): void {
        const tip = arrowTip();
        drawing.arrow(
            tip.map((x) => 0.8 * x),
            tip,
            { color: "accent", width: 4, onTop: true },
        );
    }
    /** The pieces fill the view. The goal stays where it is while its pieces are dragged. */
    function fit(): void {
        if (isApart) return;
        const radii = pieces.map(({ radius }) => radius);
        const keys = [JSON.stringify([planned, state.moment]), JSON.stringify([state.seed, state.count, state.gap, state.goal])] as const;
        if (keys[0] !== fitted[0]) {
            const { min, max } = boxAt(from, plan.moves, state.moment, radii);
            now.fit(min, max);
        }
        if (keys[1] !== fitted[1] && (state.goal !== "own" || fitted[1] === "")) {
            const { min, max } = boxAround(to, radii);
            goal?.fit(min, max);
        }
        fitted = keys;
    }

    return {
        draw,
        advance(seconds) {
            if (!state.playing) return false;
            state.moment = Math.min(state.moment + state.speed * seconds, plan.moves.length);
            state.playing = state.moment < plan.moves.length;
            changed();
            return state.playing;
        },
        answers: () => ({
            moves: plan.moves,
            order: plan.order,
            cycle: plan.cycle,
            overlapping: plan.overlapping,
            clearance: Number.isFinite(clearance) ? clearance : null,
        }),
        test: () => {
            const shapes = pieces.map(({ shape }) => shape);
            if (isApart)
                return orderTest(
                    shapes.map((shape, i) => placedAt(shape, from[i] as Pose)),
                    direction(),
                    plan,
                );
            return plan.overlapping.length > 0
                ? overlapTest(shapes, to, plan.overlapping)
                : planTest(shapes, from, to, direction(), plan.moves);
        },
        code: () => (isApart ? orderCode(direction()) : planCode(direction())),
    };
}
