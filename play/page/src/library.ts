// The library: the npm package, with the functions of play/wasm beside those of the C API.

import { load } from "abut";

export type Abut = Awaited<ReturnType<typeof load>>;

export function loadLibrary(): Promise<Abut> {
    return load();
}

/** Numbers that a function of play/wasm has written. */
export function floats(bytes: Uint8Array): Float32Array {
    return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
}

/** Indices or counts that a function of play/wasm has written. */
export function indices(bytes: Uint8Array): Uint32Array {
    return new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
}

/** Text in the form of JSON that a function of play/wasm has written. */
export function json<T>(bytes: Uint8Array): T {
    return JSON.parse(new TextDecoder().decode(bytes)) as T;
}
