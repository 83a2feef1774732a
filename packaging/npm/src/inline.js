// abut/inline: the library in the plane and in space with the module inside, for bundlers that take no other files.
import { make_api } from './api.js';
import { plane } from './calls_plane.js';
import { space } from './calls_space.js';
import { instantiate } from './module.js';
import { wasm } from './wasm_inline.js';

export { AbutError } from './arguments.js';
export { Handle } from './handle.js';

/** Loads the library. `source` is a URL, a Response, bytes or a WebAssembly.Module; by default it is the module inside. */
export async function load(source) {
    return make_api(await instantiate(source ?? (await unpack())), [plane, space]);
}

async function unpack() {
    const compressed = Uint8Array.from(atob(wasm), (character) => character.charCodeAt(0));
    const stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Response(stream).arrayBuffer();
}
