// Clicking on shapes of a screen: what is under the pointer, the topmost first.

import type { Context, Exhibit, Running } from "../../exhibit";
import { cppVec, drawShape } from "../../shapes/catalogue";
import { cppShape, javascriptText, type PlainShape } from "../../shapes/source_text";
import type { Handle } from "../../stage/pane";

interface State {
    pointer: number[];
    /** The numbers of the things, from the back to the front. */
    order: number[];
}

const things: readonly { readonly name: string; readonly shape: PlainShape }[] = [
    { name: "window", shape: { type: "box2", center: [-0.8, 0.3], half: [3.4, 2.3] } },
    {
        name: "sheet",
        shape: {
            type: "at",
            shape: { type: "box2", center: [0, 0], half: [2, 1.4] },
            pose: { position: [1.8, -0.8], rotation: [0.9800666, 0.1986693] },
        },
    },
    {
        name: "button with rounded corners",
        shape: { type: "rounded", shape: { type: "box2", center: [-1.6, -0.9], half: [1.1, 0.25] }, radius: 0.3 },
    },
    { name: "badge", shape: { type: "ball2", center: [-0.3, -0.6], radius: 0.45 } },
    { name: "switch", shape: { type: "capsule2", a: [1.4, 1.4], b: [2.4, 1.4], radius: 0.45 } },
    { name: "triangle", shape: { type: "polygon", points: [-3.2, 0.3, -1.2, 0.5, -2.4, 2.1] } },
    { name: "oval", shape: { type: "stretched", shape: { type: "ball2", center: [0.8, 0.4], radius: 1 }, scale: [1, 0.5] } },
];

export const pick: Exhibit<State> = {
    meaning:
        "A world answers which shapes contain the point under the pointer, exactly: a rounded corner isn't a box. The game knows the order in which it has drawn them, so the last of those is on top. Press a shape to bring it to the front.",
    initial: { pointer: [-0.6, -0.8], order: things.map((_, i) => i) },
    panes: () => [{ title: "A screen", dimension: 2, center: [0, 0.2], reach: 4.2 }],
    start,
};

function start({ abut, state, panel, panes, changed }: Context<State>): Running {
    const pane = panes[0] as (typeof panes)[0];
    pane.fit([-4.4, -2.8], [4.4, 2.8]);
    const world = new abut.World2();
    things.forEach(({ shape }, i) => world.add(shape as never, { user: BigInt(i) }));
    // A link may name some twice, or none.
    if (new Set(state.order).size !== things.length || state.order.some((i) => !(i in things))) state.order = things.map((_, i) => i);
    let found: number[] = [];

    /** The things that contain the pointer, the topmost first. */
    function underPointer(): number[] {
        const numbers = world.containing(state.pointer).map((id) => Number(world.options(id).user));
        return numbers.sort((a, b) => state.order.indexOf(b) - state.order.indexOf(a));
    }
    function raise(): void {
        const top = underPointer()[0];
        if (top !== undefined) state.order = [...state.order.filter((i) => i !== top), top];
        changed();
    }
    function lower(): void {
        const top = underPointer()[0];
        if (top !== undefined) state.order = [top, ...state.order.filter((i) => i !== top)];
        changed();
    }
    function point(to: number[]): void {
        state.pointer = to.map(Math.fround);
        changed();
    }
    // A mouse points without a press.
    pane.element.addEventListener("pointermove", ({ pointerType, buttons, clientX, clientY }) => {
        if (pointerType !== "mouse" || buttons !== 0) return;
        const { left, bottom, width, height } = pane.element.getBoundingClientRect();
        const { min, max } = pane.shown();
        const shares = [(clientX - left) / width, (bottom - clientY) / height];
        point(shares.map((share, i) => (min[i] ?? 0) + share * ((max[i] ?? 0) - (min[i] ?? 0))));
    });
    pane.onPress = (at, phase) => {
        point(at);
        if (phase === "down") raise();
    };
    panel.button("Bring to the front", raise);
    panel.button("Send to the back", lower);

    return {
        draw() {
            found = underPointer();
            const handle: Handle = { id: "pointer", label: "The pointer", at: state.pointer, move: point };
            pane.draw([handle], (drawing) => {
                for (const i of state.order) {
                    const thing = things[i];
                    if (!thing) continue;
                    const place = found.indexOf(i);
                    // A thing hides all that is behind it.
                    drawShape(abut, pane, drawing, thing.shape, { color: "grid", fill: 1 });
                    drawShape(abut, pane, drawing, thing.shape, {
                        color: place === 0 ? "mark" : place > 0 ? "a" : "soft",
                        fill: place === 0 ? 0.45 : 0.15,
                        width: place === 0 ? 3 : 1.5,
                    });
                }
                drawing.point(state.pointer, { color: "text", width: 2, onTop: true });
            });
            panel.answer("on top", found.length > 0 ? nameOf(found[0]) : "nothing");
            panel.answer("below it", found.length > 1 ? found.slice(1).map(nameOf).join(", ") : "nothing");
            panel.answer("pointer", state.pointer);
        },
        answers: () => ({ pointer: state.pointer, found: found.map(nameOf) }),
        code: () => ({
            cpp: `#include <abut/abut.hpp>

abut::World2 screen;
${state.order.map((i) => `screen.add(${cppShape((things[i] as (typeof things)[0]).shape)}, {.user = ${i}});  // ${nameOf(i)}`).join("\n")}

const abut::Vec2 pointer${cppVec(state.pointer)};
for (const abut::Id id : screen.containing(pointer)) {
    // In the order of insertion, so the last one is on top: screen.user(id)
}`,
            javascript: `const screen = new abut.World2();
for (const [i, shape] of shapes.entries()) screen.add(shape, { user: BigInt(i) });
const ids = screen.containing(${javascriptText(state.pointer)});  // in the order of insertion, so the last one is on top`,
        }),
        dispose: () => world.dispose(),
    };
}

function nameOf(i: number | undefined): string {
    return things[i ?? -1]?.name ?? "nothing";
}
