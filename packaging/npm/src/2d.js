// abut/2d: the library in the plane alone, with a smaller module.
import { make_api } from './api.js';
import { plane } from './calls_plane.js';
import { instantiate } from './module.js';

export { AbutError } from './arguments.js';
export { Handle } from './handle.js';

/** Loads the library. `source` is a URL, a Response, bytes or a WebAssembly.Module; by default it is abut2d.wasm of this package. */
export async function load(source) {
    return make_api(await instantiate(source ?? new URL('../abut2d.wasm', import.meta.url)), [plane]);
}
