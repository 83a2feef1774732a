// The exhibit's questions in C++ and JavaScript.

import { cppFloat } from "../../shapes/source_text";
import { start, type CrateOptions } from "./crates";
import { stepsPerSecond } from "./engine";
import type { Floor } from "./floors";

interface Code {
    readonly cpp: string;
    readonly javascript: string;
}

export function contactCode(lines: readonly string[], floor: Floor, d: 2 | 3): Code {
    return {
        cpp: `#include <abut/abut.hpp>

// With the filter: the floor is one surface.
${lines.join("\n")}
abut::each_contact(shape, floor, [](const abut::Contact<${d}>& contact) {
    // contact.normal, contact.points
});

// Without: each part is an item of a world that filters nothing.
abut::World${d} world({.filter_edges = false});
for (std::uint32_t i = 0; i < ${floor.parts.length}; ++i) world.add(${floor.cppPart}, {.fixed = true});
world.add(shape);
world.update();
for (const abut::WorldContact<${d}>& touch : world.contacts()) { /* touch.contact.normal */ }`,
        javascript: `for (const { normal, points } of abut.each_contact(shape, floor)) { }

const world = new abut.World${d}({ filter_edges: false });
for (const part of parts) world.add(part, { fixed: true });
world.add(shape);
world.update();
for (const { contact } of world.contacts()) { }`,
    };
}

export function physicsCode(floor: Floor, d: 2 | 3, isPushed: boolean, { crates, speed }: CrateOptions): Code {
    const [rotation, half, rest] = d === 2 ? ["{1, 0}", "{0.5f, 0.5f}", "0"] : ["{1, 0, 0, 0}", "{0.5f, 0.5f, 0.5f}", "0, 0"];
    const crate = (x: string, y: string): string => `physics.add_box({${x}, ${y}${d === 2 ? "" : ", 0.1"}}, ${rotation}, ${half});`;
    const scene = isPushed ? crate(`${start}`, "0.5") : `for (int i = 0; i < ${crates}; ++i) ${crate("0.1", "0.55 + 1.05 * i")}`;
    const push = isPushed ? `\nphysics.set_velocity(0, {${cppFloat(speed)}, ${rest}});  // before each step` : "";
    return {
        cpp: `#include "scenes/small_physics.hpp"  // a solver of 200 lines on World::contacts()
#include <abut/abut.hpp>

abut::scenes::SmallPhysics<${d}> physics;
// Without the filter: physics.world = abut::World${d}({.filter_edges = false}), and each part of the floor by itself.
${floor.cppLines.join("\n")}
physics.add_fixed(${floor.cpp}, {});
${scene}${push}
physics.step(1.0 / ${stepsPerSecond});`,
        javascript: `const world = new abut.World${d}({ filter_edges: true });
// each step:
world.update();
for (const { a, b, contact } of world.contacts()) solve(a, b, contact);`,
    };
}
