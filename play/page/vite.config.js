// The page is served from any folder: all its addresses are relative. `library/` is made by `./dev play`: the npm package, with the
// functions of play/wasm beside those of the C API.
import { fileURLToPath } from "node:url";

const library = fileURLToPath(new URL("library", import.meta.url));

export default {
    base: "./",
    // play/viewer is a package of its own: the page has one three.js for both.
    resolve: { dedupe: ["three"], alias: [{ find: /^abut$/, replacement: `${library}/src/index.js` }, { find: /^abut\//, replacement: `${library}/` }] },
    server: { fs: { allow: [fileURLToPath(new URL("../..", import.meta.url))] } },
    build: { target: "es2022", assetsInlineLimit: 0, chunkSizeWarningLimit: 1500, modulePreload: { polyfill: false } },
};
