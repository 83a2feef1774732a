// abut for JavaScript: `const abut = await load()`. This entry has the plane and space; abut/2d and abut/3d have one of them.
import { make_api } from './api.js';
import { plane } from './calls_plane.js';
import { space } from './calls_space.js';
import { instantiate } from './module.js';

export { AbutError } from './arguments.js';
export { Handle } from './handle.js';

/** Loads the library. `source` is a URL, a Response, bytes or a WebAssembly.Module; by default it is abut.wasm of this package. */
export async function load(source) {
    return make_api(await instantiate(source ?? new URL('../abut.wasm', import.meta.url)), [plane, space]);
}
