// The questions in both languages.

import { cppVec } from "../../shapes/source_text";

interface Code {
    readonly cpp: string;
    readonly javascript: string;
}

const note = "// Of the playground's library; the package has no rearrangements.";
const typeOf = (direction: readonly number[]): string => (direction.length === 2 ? "Polygon" : "Box3");
const numbers = (direction: readonly number[]): string => direction.map((x) => Number(x.toFixed(4))).join(", ");

export function orderCode(direction: readonly number[]): Code {
    return {
        cpp: [
            "#include <abut/abut.hpp>\n",
            `std::vector<abut::${typeOf(direction)}> pieces;`,
            `auto order = abut::removal_order(pieces, abut::Vec${direction.length}${cppVec(direction)});`,
            "for (std::uint32_t next : order.order) take_away(next);",
            "// order.cycle: pieces that block one another",
        ].join("\n"),
        javascript: `${note}\nabut.play_removal_order${direction.length}(pieces, [${numbers(direction)}]);`,
    };
}

export function planCode(away: readonly number[]): Code {
    return {
        cpp: [
            "#include <abut/abut.hpp>\n",
            `std::vector<abut::${typeOf(away)}> pieces;`,
            `std::vector<abut::Pose${away.length}> from, to;`,
            `auto plan = abut::rearrange(pieces, from, to, {.away = ${cppVec(away)}});`,
            `for (const abut::Move<${away.length}>& move : plan.moves) animate(move.shape, move.from, move.to);`,
            "// plan.stuck: pieces that block one another",
        ].join("\n"),
        javascript: `${note}\nabut.play_rearrange${away.length}(pieces, from, to, [${numbers(away)}]);`,
    };
}
