// abut/3d: the library in space alone, with a smaller module.
import { make_api } from './api.js';
import { space } from './calls_space.js';
import { instantiate } from './module.js';

export { AbutError } from './arguments.js';
export { Handle } from './handle.js';

/** Loads the library. `source` is a URL, a Response, bytes or a WebAssembly.Module; by default it is abut3d.wasm of this package. */
export async function load(source) {
    return make_api(await instantiate(source ?? new URL('../abut3d.wasm', import.meta.url)), [space]);
}
