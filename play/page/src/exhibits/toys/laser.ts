// A laser from mirror to mirror.

import type { Context, Exhibit, Running } from "../../exhibit";
import { json } from "../../library";
import { cppFloat, cppShape, cppVec, drawShape, shapeHandle, shapeOf, type ShapeState } from "../../shapes/catalogue";
import type { AnyShape } from "../../questions";
import type { Handle } from "../../stage/pane";

interface State {
    origin: number[];
    /** The direction of the ray, in radians. */
    angle: number;
    mirrors: ShapeState[];
    maxHits: number;
}

/** Half of the room's width and height. */
const room = [6, 4] as const;
/** Longer than any path that ends within the largest number of hits. */
const length = 1e5;

export const laser: Exhibit<State> = {
    meaning:
        "Each hit of the ray gives a point and a normal, and the next straight piece is the reflection there. Blue shapes and the walls above and below are mirrors, and the ray ends at the walls on the left and right. A mirror that was just left isn't hit again, however close the next one is, so the ray gets out of corners too.",
    initial: {
        origin: [-5.2, -2.6],
        angle: 1.02,
        mirrors: [
            { kind: "ball", position: [-1.6, 0.4], rotation: [1, 0], size: 0.9 },
            { kind: "box", position: [1.9, -0.9], rotation: [0.8253356, 0.5646425], size: 1 },
            { kind: "triangle", position: [3.9, 1.6], rotation: [1, 0], size: 0.9 },
            { kind: "capsule", position: [-3.6, 2.1], rotation: [0.9553365, -0.2955202], size: 0.8 },
        ],
        maxHits: 60,
    },
    panes: () => [{ title: "A room with mirrors", dimension: 2, reach: 5.4 }],
    start,
};

interface Path {
    points: number[][];
    normals: number[][];
    items: number[];
}

function start({ abut, state, panel, panes, changed }: Context<State>): Running {
    const pane = panes[0] as (typeof panes)[0];
    pane.fit([-room[0] - 0.4, -room[1] - 0.4], [room[0] + 0.4, room[1] + 0.4]);
    panel.slider({ label: "Angle", min: -Math.PI, max: Math.PI, get: () => state.angle, set: (angle) => (state.angle = angle) });
    panel.slider({ label: "Hits, at most", min: 1, max: 200, step: 1, get: () => state.maxHits, set: (hits) => (state.maxHits = hits) });
    const [w, h] = room;
    const walls = [-1, 1].map((side): AnyShape => abut.Box2([side * (w + 0.2), 0], [0.2, h + 0.4]));
    const mirrorWalls = [-1, 1].map((side): AnyShape => abut.Box2([0, side * (h + 0.2)], [w, 0.2]));
    let path: Path = { points: [], normals: [], items: [] };

    function follow(mirrors: readonly AnyShape[]): Path {
        const world = new abut.World2();
        for (const wall of walls) world.add(wall as never);
        for (const mirror of [...mirrorWalls, ...mirrors]) world.add(mirror as never, { user: 1n });
        const ray = { origin: state.origin, direction: abut.Turn.by(state.angle), length };
        const result = json<Path>(abut.play_laser2(world, ray, Math.min(Math.max(state.maxHits, 1), 1000)));
        world.dispose();
        return result;
    }
    function emitter(): Handle {
        return {
            id: "laser",
            label: "The laser",
            at: state.origin,
            move(to) {
                state.origin = to.map((x, i) => Math.fround(Math.min(Math.max(x, 0.1 - (room[i] ?? 1)), (room[i] ?? 1) - 0.1)));
                changed();
            },
            turn(angle) {
                const turned = state.angle + angle;
                state.angle = turned - 2 * Math.PI * Math.round(turned / (2 * Math.PI));
                changed();
            },
        };
    }

    return {
        draw() {
            const mirrors = state.mirrors.map((mirror) => shapeOf(abut, mirror));
            path = follow(mirrors);
            const handles = state.mirrors.map((mirror, i): Handle => ({
                ...shapeHandle(abut, `mirror${i}`, mirror, changed),
                label: `Mirror ${i + 1}`,
            }));
            pane.draw([emitter(), ...handles], (drawing) => {
                for (const wall of walls) drawShape(abut, pane, drawing, wall, { color: "soft", fill: 0.5 });
                for (const mirror of [...mirrorWalls, ...mirrors]) drawShape(abut, pane, drawing, mirror, { color: "a", fill: 0.2 });
                drawing.line(path.points.flat(), { color: "mark", width: 2 });
                for (const point of path.points.slice(1)) drawing.point(point, { color: "mark", width: 1 });
                drawing.arrow(
                    state.origin,
                    state.origin.map((x, i) => x + 0.7 * (abut.Turn.by(state.angle)[i] ?? 0)),
                    { color: "text", width: 2.5 },
                );
            });
            panel.answer("hits", String(path.items.length));
            panel.answer("on mirrors", String(path.items.length - (endsAtWall() ? 1 : 0)));
            panel.answer("ends", endsAtWall() ? "at a wall" : "at the last hit that is allowed");
            panel.answer("end", path.points[path.points.length - 1] ?? []);
        },
        answers: () => ({ ...path }),
        code: () => ({
            cpp: `#include <abut/abut.hpp>

enum Kind : std::uint64_t { is_wall, is_mirror };
abut::World2 room;
${state.mirrors.map((mirror) => `room.add(${cppShape(mirror)}, {.user = is_mirror});`).join("\n")}
const abut::Ray2 ray{${cppVec(state.origin)}, ${cppVec(abut.Turn.by(state.angle))}, ${cppFloat(length)}};
int hits = 0;
abut::follow_laser(room, ray, [&](const abut::Ray2& piece, const abut::WorldHit<2>& hit) {
    // piece.origin, hit.hit.point, hit.hit.normal
    return room.user(hit.id) == is_mirror && ++hits < ${state.maxHits};
});`,
            javascript: `const world = new abut.World2();
for (const mirror of mirrors) world.add(mirror, { user: 1n });
let ray = { origin: ${JSON.stringify(state.origin.map(Math.fround))}, direction: abut.Turn.by(${state.angle.toFixed(4)}), length: ${length} };
for (let found; (found = world.raycast(ray)); ) ray = abut.reflect(ray, found.hit);`,
        }),
    };

    /** The walls were added first. */
    function endsAtWall(): boolean {
        return (path.items[path.items.length - 1] ?? Infinity) <= walls.length;
    }
}
