// A bullet that is farther on at each step than a wall is thick.

import type { Context, Exhibit, Running } from "../../exhibit";
import type { AnyShape } from "../../questions";
import { cppFloat, cppVec, drawShape } from "../../shapes/catalogue";
import type { Handle } from "../../stage/pane";

interface State {
    origin: number[];
    /** In radians. */
    angle: number;
    /** Units that it moves in a step. */
    step: number;
    /** Half of a wall's thickness. */
    half: number;
    continuous: boolean;
}

const radius = 0.12;
const maxSteps = 40;
const walls = [-1.5, 1, 3.5] as const;
/** Half of what the bullet may cross. */
const reach = 6;

export const bullet: Exhibit<State> = {
    meaning:
        "The bullet jumps from circle to circle, one for each update of the world. Without help it tunnels: no circle touches the wall, so nothing is reported. A continuous item also reports all that it touched between two updates, with the time of impact, so it stops at the first wall, at any speed.",
    initial: { origin: [-5, -1.2], angle: 0.15, step: 1.7, half: 0.03, continuous: true },
    panes: () => [{ title: "A bullet and thin walls", dimension: 2, reach: 4.6 }],
    start,
};

interface Flight {
    /** At each update. */
    places: number[][];
    /** The first wall that it touched: the place of the bullet, the point, the update, and the fraction of its motion. */
    impact: { at: number[]; point: number[]; update: number; fraction: number } | null;
    /** The walls that it has passed without a report. */
    missed: number;
}

function start({ abut, state, panel, panes, changed }: Context<State>): Running {
    const pane = panes[0] as (typeof panes)[0];
    pane.fit([-5.5, -3.8], [5.5, 3.8]);
    panel.toggle(
        "Continuous",
        () => state.continuous,
        (value) => (state.continuous = value),
    );
    panel.slider({
        label: "Step",
        min: 0.05,
        max: 6,
        logarithmic: true,
        get: () => state.step,
        set: (step) => (state.step = Math.fround(step)),
    });
    panel.slider({
        label: "Half of a wall",
        min: 0.001,
        max: 0.3,
        logarithmic: true,
        get: () => state.half,
        set: (half) => (state.half = Math.fround(half)),
    });
    panel.slider({ label: "Angle", min: -0.6, max: 0.6, get: () => state.angle, set: (angle) => (state.angle = angle) });
    const ball = abut.Ball2([0, 0], radius);
    let flight: Flight = { places: [], impact: null, missed: 0 };

    function wallShapes(): AnyShape[] {
        return walls.map((x) => abut.Box2([x, 0], [state.half, 3.6]));
    }
    function direction(): [number, number] {
        return abut.Turn.by(state.angle);
    }
    /** Moves the bullet through a world until it hits something. */
    function fly(): Flight {
        const world = new abut.World2();
        for (const wall of wallShapes()) world.add(wall as never, { fixed: true });
        const id = world.add(ball, { continuous: state.continuous, pose: { position: state.origin } });
        const [x, y] = direction();
        const at = (steps: number): number[] => [
            (state.origin[0] ?? 0) + steps * state.step * x,
            (state.origin[1] ?? 0) + steps * state.step * y,
        ];
        const result: Flight = { places: [], impact: null, missed: 0 };
        for (let update = 0; update < maxSteps && result.impact === null; ++update) {
            const place = at(update);
            if (Math.abs(place[0] ?? 0) > reach || Math.abs(place[1] ?? 0) > reach) break;
            world.move(id, { position: place });
            const { began, fractions } = world.update();
            result.places.push(place);
            if (began.length === 0) continue;
            // The bullet stops at the first of several walls.
            const fraction = Math.min(...fractions);
            const first = world.impacts().find(({ hit }) => hit.fraction === fraction);
            const stop = update === 0 ? place : at(update - 1 + fraction);
            result.impact = { at: stop, point: first ? Array.from(first.hit.point) : stop, update, fraction };
        }
        const last = result.impact?.at ?? result.places[result.places.length - 1] ?? state.origin;
        result.missed = walls.filter((wall) => wall > (state.origin[0] ?? 0) && wall + radius < (last[0] ?? 0)).length;
        world.dispose();
        return result;
    }
    function gun(): Handle {
        return {
            id: "gun",
            label: "Where the bullet starts",
            at: state.origin,
            move(to) {
                state.origin = [
                    Math.fround(Math.min(Math.max(to[0] ?? 0, -reach), 5)),
                    Math.fround(Math.min(Math.max(to[1] ?? 0, -3.5), 3.5)),
                ];
                changed();
            },
            turn(angle) {
                state.angle = Math.min(Math.max(state.angle + angle, -0.6), 0.6);
                changed();
            },
        };
    }

    return {
        draw() {
            flight = fly();
            const { places, impact, missed } = flight;
            pane.draw([gun()], (drawing) => {
                for (const wall of wallShapes()) drawShape(abut, pane, drawing, wall, { color: "b", fill: 0.5 });
                const end = impact?.at ?? places[places.length - 1] ?? state.origin;
                drawing.line([...state.origin, ...end], { color: "soft", dashed: true });
                places.forEach((position, i) => {
                    const isPast = impact !== null && i === impact.update && impact.fraction < 1;
                    drawShape(
                        abut,
                        pane,
                        drawing,
                        abut.at(ball, { position }),
                        isPast ? { color: "soft", fill: 0.1 } : { color: "a", fill: 0.35 },
                    );
                });
                if (!impact) return;
                drawShape(abut, pane, drawing, abut.at(ball, { position: impact.at }), { color: "mark", fill: 0.7 });
                drawing.point(impact.point, { color: "mark", width: 1 });
                drawing.text([impact.at[0] ?? 0, (impact.at[1] ?? 0) + 0.45], "hit", { color: "mark" });
            });
            panel.answer("updates", String(places.length));
            panel.answer("hit", impact ? `in update ${impact.update}, at ${impact.fraction.toFixed(4)} of it` : "none");
            panel.answer("point", impact?.point ?? "none");
            panel.answer("walls passed", String(missed));
        },
        answers: () => ({ ...flight }),
        code: () => ({
            cpp: `#include <abut/abut.hpp>

abut::World2 world;
for (const float x : {${walls.map(cppFloat).join(", ")}}) world.add(abut::Box2{{x, 0}, {${cppFloat(state.half)}, 3.6f}}, {.fixed = true});
const abut::Vec2 origin${cppVec(state.origin)}, step = ${cppFloat(state.step)} * abut::Vec2${cppVec(direction())};
const abut::Id bullet = world.add(abut::Circle{{0, 0}, ${cppFloat(radius)}}, {.pose = {origin}, .continuous = ${state.continuous}});
for (int i = 0; i < ${maxSteps}; ++i) {
    world.move(bullet, {origin + static_cast<float>(i) * step});
    const abut::Events events = world.update();
    // events.began, events.fractions; world.impacts() has the points and normals
}`,
            javascript: `const bullet = world.add(abut.Ball2([0, 0], ${radius}), { continuous: ${state.continuous} });
world.move(bullet, { position });
const { began, fractions } = world.update();
const hits = world.impacts();`,
        }),
    };
}
