// A walker on a mesh: steps and paths over a surface, and the triangles that they cross, unfolded into the plane.

import type { Context, Exhibit, Running } from "../../exhibit";
import { floats, json } from "../../library";
import { surfaces } from "../../shapes/surfaces";
import type { Drawing } from "../../stage/drawing";
import { Joystick } from "../../stage/joystick";
import type { Handle } from "../../stage/pane";
import type { Pane3 } from "../../stage/pane3";
import { walkCode } from "./code";
import { pathTest, stepTest } from "./tests";
import { boxOf, drawStrip, holds, type Bounds, type Strip } from "./strip";
import { carried, leftOf, scaled, Walker, type Path, type Place, type Walked, type WalkerState } from "./walker";

interface State {
    surface: string;
    /** "step" or "path" */
    question: string;
    /** The view goes with the walker. */
    near: boolean;
    step: number;
    walker: WalkerState;
    goal: Place;
}

// No place of any mesh: each surface has a start of its own.
const nowhere: Place = { triangle: -1, weights: [1, 0, 0] };
const metNames = ["nothing", "a border, and slid along it", "a corner, and stopped there", "its limit of edges"];
const turnSpeed = 2.2;

export const walkMesh: Exhibit<State> = {
    meaning:
        "A place on a walk mesh is a triangle and three weights, so a walker never falls through the floor or ends up on the bridge " +
        "above. A step goes straight over the surface: the triangles that it crosses, unfolded into the plane, form a strip in which it " +
        "is one straight line. The walker's frame is carried along and keeps its direction in that plane, so after a round trip it can " +
        "come back rotated, or on the other side of the surface.",
    initial: {
        surface: "hills",
        question: "step",
        near: false,
        step: 9,
        walker: { place: nowhere, forward: [1, 0, 0], up: [0, 1, 0] },
        goal: nowhere,
    },
    panes: ({ surface }) => [
        { title: "The surface", dimension: 3, reach: surfaceOf(surface).reach },
        { title: "The strip of triangles, unfolded", dimension: 2, reach: 6 },
    ],
    start,
};

function surfaceOf(name: string): ReturnType<(typeof surfaces)[string]> {
    return (surfaces[name] ?? surfaces["hills"])!();
}

function start({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const [space, plane] = panes as [Pane3, (typeof panes)[0]];
    const surface = surfaceOf(state.surface);
    const points = surface.points.flat();
    const mesh = new abut.WalkMesh(points, surface.triangles);
    const edges = [true, false].map((border) => floats(abut.play_walk_edges(mesh, border)));
    if (!isPlace(state.walker.place))
        state.walker = { place: mesh.nearest(surface.start) as Place, forward: [...surface.ahead], up: [0, 0, 0] };
    if (!isPlace(state.goal)) state.goal = mesh.nearest(surface.goal) as Place;
    const walker = new Walker(mesh, state.walker);
    space.camera.orbit(0, surface.pitch);
    showFromAfar();
    if (state.near) showFromNear();
    let trail: readonly (readonly number[])[] = [walker.position];
    let following = false;
    let shown: Bounds | undefined;
    let seen: Record<string, unknown> = {};

    panel.choice(
        "Surface",
        Object.fromEntries(Object.entries(surfaces).map(([id, make]) => [id, make().name])),
        () => state.surface,
        (id) => {
            Object.assign(state, {
                surface: id,
                step: surfaceOf(id).step,
                walker: { place: nowhere, forward: [1, 0, 0], up: [0, 1, 0] },
                goal: nowhere,
            });
            restart();
        },
    );
    panel.choice(
        "Shown",
        { step: "a step ahead", path: "the path to the goal" },
        () => state.question,
        (value) => (state.question = value),
    );
    panel.toggle(
        "View follows",
        () => state.near,
        (value) => {
            state.near = value;
            if (value) showFromNear();
            else showFromAfar();
        },
    );
    panel.slider({
        label: "Step",
        min: 0.5,
        max: 2.5 * surface.step,
        get: () => state.step,
        set: (value) => (state.step = Math.fround(value)),
    });
    panel.button("Walk the step", () =>
        move(() => {
            addToTrail(stripAhead().space);
            walker.walk(state.step);
        }),
    );
    panel.button("Walk to the goal", () => {
        following = true;
        changed();
    });
    panel.button("Erase the trail", () => move(() => (trail = [walker.position])));
    const joystick = new Joystick(space.element, "Joystick: arrow up and down walk, left and right turn", changed);
    space.onTap = (at) => move(() => (state.goal = placeAt(at)));

    function showFromAfar(): void {
        const bound = (choose: (...values: number[]) => number): number[] =>
            ([0, 1, 2] as const).map((axis) => choose(...surface.points.map((point) => point[axis])));
        space.fit(bound(Math.min), bound(Math.max));
    }
    function showFromNear(): void {
        const half = 0.3 * surface.reach;
        space.fit(
            walker.position.map((x) => x - half),
            walker.position.map((x) => x + half),
        );
    }
    function isPlace({ triangle, weights }: Place): boolean {
        return (
            Number.isInteger(triangle) &&
            triangle >= 0 &&
            3 * triangle < surface.triangles.length &&
            weights.length === 3 &&
            weights.every((x) => x >= 0) &&
            weights.some((x) => x > 0)
        );
    }
    function move(body: () => void): void {
        body();
        changed();
    }
    /** The place of the mesh that is seen at a point of the view. */
    function placeAt(point: readonly number[]): Place {
        const origin = space.camera.three.position.toArray();
        const direction = point.map((x, i) => x - (origin[i] ?? 0));
        const { out, found } = mesh.nearest_along({ origin, direction, length: Infinity });
        return (found ? out : mesh.nearest(point)) as Place;
    }
    function walkBy(length: number): void {
        walker.walk(length);
        addToTrail([walker.position]);
    }
    function addToTrail(positions: readonly (readonly number[])[]): void {
        trail = [...trail, ...positions].slice(-4000);
    }
    /** Goes on along the path, by so much; false at its end. */
    function follow(length: number): boolean {
        const path = mesh.path(state.walker.place, state.goal);
        const [start] = path.places;
        if (!start || (path.out?.length ?? 0) < 1e-3) return false;
        // A walker on an edge goes on in the triangle beyond.
        if (start.triangle !== state.walker.place.triangle) walker.put(start as Place);
        // The walk is straight up to the first corner in the plane, over all edges before it. A point that is nearer than this gives no
        // direction, and the walker already has it.
        const to = walker.position.map((x, i) => (path.points[3 + i] ?? x) - x);
        if (Math.hypot(...to) > 1e-3) walker.look(to);
        const corner = pathStrip().line[1] ?? [0, 0];
        walkBy(Math.min(length, Math.hypot(...corner)));
        return true;
    }
    function pathStrip(): Strip {
        return json<Strip>(abut.play_path_strip(mesh, state.walker.place, state.goal, walker.isBelow));
    }
    function stripAhead(): Strip {
        return json<Strip>(abut.play_walk_strip(mesh, state.walker.place, scaled(state.walker.forward, state.step), walker.isBelow));
    }
    function handles(): Handle[] {
        return [
            {
                id: "walker",
                label: "Walker",
                at: walker.position,
                move: (to) =>
                    move(() => {
                        walker.put(placeAt(to));
                        trail = [walker.position];
                    }),
                turn: (angle) => move(() => walker.turn(angle)),
            },
            { id: "goal", label: "Goal", at: mesh.to_world(state.goal), move: (to) => move(() => (state.goal = placeAt(to))) },
        ];
    }
    function draw(): void {
        const isPath = state.question === "path";
        const walked = walker.ahead(state.step);
        const path = mesh.path(state.walker.place, state.goal);
        const strip = isPath ? pathStrip() : stripAhead();
        if (state.near) space.camera.target.fromArray(walker.position);
        space.camera.pan(0, 0);
        space.draw(handles(), (drawing) => drawSurface(drawing, strip, isPath ? null : walked));
        const box = boxOf(strip);
        if (!shown || !holds(shown, box, 1.6)) {
            shown = box;
            plane.fit(box.min, box.max);
        }
        plane.draw([], (drawing) =>
            drawStrip(drawing, strip, state.walker.place.weights, 16 * plane.pixel(), isPath ? 0 : 0.09 * state.step),
        );
        answer(walked, path);
        seen = {
            place: state.walker.place,
            walked: { ...walked, place: { ...walked.place } },
            path: path.out?.length ?? null,
            triangles: strip.triangles.map(({ triangle }) => triangle),
        };
    }
    function answer(walked: Walked, path: Path): void {
        panel.answer("triangle", String(state.walker.place.triangle));
        panel.answer("weights", state.walker.place.weights);
        panel.answer("walked", walked.length);
        panel.answer("lost", walked.lost);
        panel.answer("met", metNames[walked.met] ?? "");
        panel.answer("edges crossed", String(walked.crossings));
        panel.answer(
            "at the end",
            walked.mirrored !== walker.isBelow ? "below: on the side opposite to the normal" : "above: on the side of the normal",
        );
        panel.answer("path to the goal", path.out ? path.out.length : "there is none");
    }
    function drawSurface(drawing: Drawing, strip: Strip, walked: Walked | null): void {
        drawing.triangles(points, surface.triangles, { color: "grid" });
        drawing.segments(edges[1] ?? [], { color: "soft", alpha: 0.35 });
        drawing.segments(edges[0] ?? [], { color: "text" });
        strip.triangles.forEach(({ triangle }, i) =>
            drawing.triangles(points, surface.triangles.slice(3 * triangle, 3 * triangle + 3), {
                color: i === 0 ? "good" : "accent",
                fill: i === 0 ? 0.45 : 0.28,
            }),
        );
        drawing.line(trail.flat(), { color: "b" });
        drawing.line(strip.space.flat(), { color: "mark", width: 3 });
        const size = 0.09 * surface.reach;
        drawFrame(drawing, walker.position, state.walker.forward, state.walker.up, 1.6 * size);
        if (walked)
            drawFrame(drawing, Array.from(walked.position), carried(walked, state.walker.forward), carried(walked, state.walker.up), size);
        const goal = mesh.to_world(state.goal);
        drawing.point(goal, { color: "mark", width: 5, onTop: true });
        drawing.text(goal, "goal", { color: "mark" });
    }

    return {
        draw,
        advance(seconds) {
            const [right, up] = joystick.direction;
            if (joystick.isActive) {
                following = false;
                walker.turn(-right * turnSpeed * seconds);
                if (up !== 0) walkBy(0.45 * surface.step * up * seconds);
            } else if (following) following = follow(0.45 * surface.step * seconds);
            if (joystick.isActive || following) changed();
            return joystick.isActive || following;
        },
        answers: () => seen,
        test: () =>
            state.question === "path"
                ? pathTest(surface, state.walker.place, state.goal, mesh.path(state.walker.place, state.goal))
                : stepTest(surface, state.walker.place, scaled(state.walker.forward, state.step), walker.ahead(state.step)),
        code: () => walkCode(state.question === "path", surface.start),
        dispose() {
            joystick.dispose();
            mesh.dispose();
        },
    };
}

/** Forward, left and up. */
function drawFrame(drawing: Drawing, at: readonly number[], forward: readonly number[], up: readonly number[], size: number): void {
    const tip = (direction: readonly number[]): number[] => at.map((x, i) => x + size * (direction[i] ?? 0));
    drawing.arrow(at, tip(forward), { color: "a", width: 3 });
    drawing.arrow(at, tip(leftOf(forward, up)), { color: "b", width: 3 });
    drawing.arrow(at, tip(up), { color: "good", width: 3 });
    drawing.point(at, { color: "mark", width: 3 });
}
