// Lag compensation: a shot is judged by where the shooter saw the runner.

import type { Context, Exhibit, Running } from "../../exhibit";
import { cppFloat, cppVec, drawShape } from "../../shapes/catalogue";
import type { Drawing } from "../../stage/drawing";

interface State {
    /** The number of ticks since the runner started. */
    tick: number;
    /** The age of the picture that the shooter sees, in milliseconds. */
    delay: number;
    speed: number;
    shooter: number[];
    runs: boolean;
}

const ticksPerSecond = 64;
const heldTicks = 64;
const players = 2n;
const bodyRadius = 0.4;
/** The runner goes up and down here, half of the time behind the wall. */
const track = { x: 4.2, half: 3.2 } as const;
const wall = { center: [2.2, 1.6], half: [0.25, 1.9] } as const;

export const lag: Exhibit<State> = {
    meaning:
        "The shooter sees the runner where he was a moment ago, and aims there. The server records the world at each tick and judges the shot in the past, between two ticks if need be, so it hits what the shooter saw. In the present the same shot would miss, or hit the wall.",
    initial: { tick: 40, delay: 200, speed: 5, shooter: [-4.5, -1], runs: true },
    panes: () => [{ title: "From above", dimension: 2, reach: 4.6 }],
    start,
};

interface Shot {
    readonly seen: number[];
    readonly now: number[];
    readonly past: { readonly hits: boolean; readonly end: number[] };
    readonly present: { readonly hits: boolean; readonly end: number[] };
    readonly tick: number;
    readonly fraction: number;
}

function start({ abut, state, panel, panes, changed }: Context<State>): Running {
    const pane = panes[0] as (typeof panes)[0];
    pane.fit([-5.2, -4], [5.2, 4]);
    const world = new abut.World2();
    const body = abut.Ball2([0, 0], bodyRadius);
    const wallShape = abut.Box2(wall.center, wall.half);
    world.add(wallShape, { fixed: true });
    const shooter = world.add(body, { layers: players, pose: { position: state.shooter } });
    const runner = world.add(body, { layers: players });
    const history = new abut.PlayHistory2(world, heldTicks, players);
    /** A link may hold any number. */
    state.tick = Math.max(Math.round(state.tick), 0);
    let recorded = 0;
    let time = 0;
    let shot: Shot | null = null;

    panel.slider({ label: "Delay", min: 0, max: 800, step: 5, unit: " ms", get: () => state.delay, set: (delay) => (state.delay = delay) });
    panel.slider({
        label: "Runner",
        min: 0,
        max: 12,
        step: 0.5,
        unit: " /s",
        get: () => state.speed,
        set: (speed) => (state.speed = speed),
    });
    panel.toggle(
        "Runs",
        () => state.runs,
        (value) => (state.runs = value),
    );
    panel.button("One tick on", () => {
        tickOn();
        changed();
    });

    /** To and fro between the ends of the track. */
    function runnerAt(tick: number): number[] {
        const way = ((tick / ticksPerSecond) * state.speed) % (4 * track.half);
        return [track.x, way < 2 * track.half ? way - track.half : 3 * track.half - way];
    }
    function record(tick: number): void {
        world.move(runner, { position: runnerAt(tick) });
        world.move(shooter, { position: state.shooter });
        world.update();
        history.record();
        ++recorded;
    }
    function tickOn(): void {
        record(++state.tick);
    }
    // The ticks before the one of the link, so that there is a past.
    for (let tick = state.tick - heldTicks + 1; tick <= state.tick; ++tick) record(Math.max(tick, 0));

    function shoot(): Shot {
        const { first, last } = history.ticks();
        const seenAt = Math.max(last - (state.delay / 1000) * ticksPerSecond, first);
        const tick = Math.floor(seenAt);
        const fraction = seenAt - tick;
        const then = history.at(tick, fraction);
        const seen = Array.from(then.options(runner).pose.position);
        const ray = abut.Ray2.between(state.shooter, seen);
        const long = { ...ray, length: 12 };
        const judged = (judge: typeof world): { hits: boolean; end: number[] } => {
            const hit = judge.raycast(long, { ignore: shooter });
            const end = hit ? hit.hit.point : state.shooter.map((x, i) => x + long.length * (ray.direction[i] ?? 0));
            return { hits: hit?.id.index === runner.index, end: Array.from(end) };
        };
        const result: Shot = {
            seen,
            now: Array.from(world.options(runner).pose.position),
            past: judged(then),
            present: judged(world),
            tick,
            fraction,
        };
        then.dispose();
        return result;
    }
    function drawScene(drawing: Drawing, { seen, now, past, present }: Shot): void {
        drawShape(abut, pane, drawing, wallShape, { color: "soft", fill: 0.4 });
        drawing.line([track.x, -track.half, track.x, track.half], { color: "grid", dashed: true });
        drawShape(abut, pane, drawing, abut.at(body, { position: state.shooter }), { color: "a", fill: 0.4 });
        drawShape(abut, pane, drawing, abut.at(body, { position: seen }), { color: "mark", fill: 0.12 });
        drawShape(abut, pane, drawing, abut.at(body, { position: now }), { color: "b", fill: 0.4 });
        drawing.line([...state.shooter, ...present.end], { color: "soft", dashed: true });
        drawing.arrow(state.shooter, past.end, { color: past.hits ? "good" : "bad", width: 2.5 });
        drawing.text([(seen[0] ?? 0) + 0.5, (seen[1] ?? 0) - 0.62], "seen", { color: "mark" });
        drawing.text([(now[0] ?? 0) + 0.5, (now[1] ?? 0) + 0.62], "now", { color: "b" });
        drawing.text([state.shooter[0] ?? 0, (state.shooter[1] ?? 0) + 0.65], "shooter", { color: "a" });
    }

    return {
        draw() {
            const result = shoot();
            shot = result;
            const move = (to: number[]): void => {
                state.shooter = [Math.fround(Math.min(Math.max(to[0] ?? 0, -5), 1)), Math.fround(Math.min(Math.max(to[1] ?? 0, -4), 4))];
                changed();
            };
            pane.draw(
                [{ id: "shooter", label: "The shooter", at: state.shooter, shape: abut.at(body, { position: state.shooter }), move }],
                (drawing) => drawScene(drawing, result),
            );
            panel.answer("tick now", String(state.tick));
            panel.answer("seen", `tick ${state.tick - recorded + 1 + result.tick} + ${result.fraction.toFixed(2)}`);
            panel.answer("by the past", result.past.hits ? "hits the runner" : "misses");
            panel.answer("by the present", result.present.hits ? "hits the runner" : "misses");
        },
        advance(seconds) {
            if (!state.runs) return false;
            for (time += seconds; time > 0; time -= 1 / ticksPerSecond) tickOn();
            return true;
        },
        answers: () => ({ ...shot }),
        code: () => ({
            cpp: `#include <abut/abut.hpp>

constexpr std::uint64_t players = 2;  // the layer of all that is recorded
abut::History2 past(world, ${heldTicks}, {.layers = players});
// Each tick:
world.update();
const std::uint64_t now = past.record();

// A shot arrives: the shooter saw the world ${state.delay} ms ago.
const double seen = static_cast<double>(now) - ${cppFloat(state.delay / 1000)} * ${ticksPerSecond};
const auto tick = static_cast<std::uint64_t>(seen);
const abut::World2& then = past.at(tick, static_cast<float>(seen - static_cast<double>(tick)));
const abut::Vec2 eye${cppVec(state.shooter)};
const auto hit = then.raycast({eye, glm::normalize(then.pose(runner).position - eye), 12}, {.ignore = shooter});
const bool is_hit = hit && hit->id == runner;`,
            javascript: `// The package has no History yet; this page has it from a module of its own.
const hit = then.raycast({ origin: eye, direction, length: 12 }, { ignore: shooter });`,
        }),
        dispose() {
            history.dispose();
            world.dispose();
        },
    };
}
