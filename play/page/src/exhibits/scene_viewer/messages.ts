// What the page and the worker that checks say to one another.

import type { Report } from "../../../../viewer/src/report";

export interface SceneFile {
    readonly name: string;
    readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Options of `abut check` by their names, without dashes. */
export type Settings = Readonly<Record<string, readonly string[]>>;

export interface Request {
    /** The scene, and the files that it refers to. */
    readonly files: readonly SceneFile[];
    readonly scene: string;
    readonly settings: Settings;
    /** The address of the module. */
    readonly wasm: string;
}

export interface Progress {
    readonly what: string;
    readonly done: number;
    readonly all: number;
}

export type Reply = { readonly progress: Progress } | { readonly report: Report } | { readonly problem: string };
