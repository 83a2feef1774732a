// Disassembly orders and plans as tests in C++.

import type { AnyShape } from "../../questions";
import type { Pose } from "../../shapes/puzzles";
import { cppPose, cppShape, cppTest, cppVec, type PlainShape } from "../../shapes/source_text";
import type { Move } from "./moves";

function listed(shapes: readonly AnyShape[]): string[] {
    return ["const std::vector pieces{", ...shapes.map((shape) => `    ${cppShape(shape as PlainShape)},`), "};"];
}
const numbers = (values: readonly number[]): string => `(std::vector<std::uint32_t>{${values.join(", ")}})`;

export function orderTest(
    shapes: readonly AnyShape[],
    direction: readonly number[],
    { order, cycle }: { readonly order: readonly number[]; readonly cycle: readonly number[] },
): string {
    return cppTest("DisassemblyOrder", [
        ...listed(shapes),
        `const abut::RemovalOrder order = removal_order(pieces, abut::Vec${direction.length}${cppVec(direction)});`,
        `EXPECT_EQ(order.order, ${numbers(order)});`,
        `EXPECT_EQ(order.cycle, ${numbers(cycle)});`,
    ]);
}

/** Pieces that overlap at these poses, so that there is no plan. */
export function overlapTest(shapes: readonly AnyShape[], poses: readonly Pose[], overlapping: readonly number[]): string {
    const dimension = poses[0]?.position.length ?? 2;
    return cppTest("Overlap", [
        ...listed(shapes),
        `const std::vector<abut::Pose${dimension}> poses{${poses.map(cppPose).join(", ")}};`,
        "const auto overlaps_another = [&](std::size_t i) {",
        "    for (std::size_t j = 0; j < pieces.size(); ++j)",
        "        if (i != j && closest(abut::at(pieces[i], poses[i]), abut::at(pieces[j], poses[j])).distance < 0) return true;",
        "    return false;",
        "};",
        ...overlapping.map((i) => `EXPECT_TRUE(overlaps_another(${i}));`),
    ]);
}

export function planTest(
    shapes: readonly AnyShape[],
    from: readonly Pose[],
    to: readonly Pose[],
    away: readonly number[],
    moves: readonly Move[],
): string {
    const pose = `abut::Pose${away.length}`;
    return cppTest("Rearrangement", [
        ...listed(shapes),
        `const std::vector<${pose}> from{${from.map(cppPose).join(", ")}};`,
        `const std::vector<${pose}> to{${to.map(cppPose).join(", ")}};`,
        `const auto plan = rearrange(pieces, from, to, {.away = ${cppVec(away)}});`,
        `ASSERT_EQ(plan.moves.size(), ${moves.length}u);`,
        ...moves.flatMap((move, i) => [
            `EXPECT_EQ(plan.moves[${i}].shape, ${move.shape}u);`,
            `EXPECT_EQ(plan.moves[${i}].to, (${pose}${cppPose(move.to)}));`,
        ]),
    ]);
}
