// The bundled scenes, each with the options that suit it.

import level from "abut/scenes/level.gltf?url";
import plateau from "abut/scenes/plateau.tmj?url";
import plateauTiles from "abut/scenes/plateau_tiles.tsj?url";
import cave from "abut/scenes/cave.svg?url";
import type { SceneFile, Settings } from "./messages";

interface Sample {
    readonly title: string;
    /** Names and addresses: the scene, and then what it refers to. */
    readonly files: readonly (readonly [string, string])[];
    readonly settings: Settings;
}

export const samples: Readonly<Record<string, Sample>> = {
    level: { title: "Storehouse (glTF)", files: [["level.gltf", level]], settings: {} },
    plateau: {
        title: "Plateau (Tiled)",
        files: [
            ["plateau.tmj", plateau],
            ["plateau_tiles.tsj", plateauTiles],
        ],
        settings: { character: ["6,24"], up: ["-y"] },
    },
    cave: { title: "Cave (SVG)", files: [["cave.svg", cave]], settings: {} },
};

export async function load(sample: Sample): Promise<SceneFile[]> {
    return Promise.all(
        sample.files.map(async ([name, address]) => {
            const response = await fetch(new URL(address, document.baseURI));
            if (!response.ok) throw new Error(`The server does not have ${name}.`);
            return { name, bytes: new Uint8Array(await response.arrayBuffer()) };
        }),
    );
}
