// Loads abut.wasm. Of WASI it needs what the C library links, and nothing that reaches outside.

const EBADF = 8;

function wasi_imports(state) {
    const write_zero = (pointer) => {
        state.view().setUint32(pointer, 0, true);
        return 0;
    };
    return {
        clock_time_get: (_id, _precision, pointer) => {
            state.view().setBigUint64(pointer, BigInt(Math.round(performance.now() * 1e6)), true);
            return 0;
        },
        environ_get: () => 0,
        environ_sizes_get: (count, size) => write_zero(count) || write_zero(size),
        proc_exit: (code) => {
            throw new Error(`abut: the library ended with ${code}`);
        },
        fd_write: (fd, vectors, count, written) => {
            let text = '';
            let total = 0;
            for (let i = 0; i < count; ++i) {
                const at = state.view().getUint32(vectors + 8 * i, true);
                const size = state.view().getUint32(vectors + 8 * i + 4, true);
                text += new TextDecoder().decode(new Uint8Array(state.view().buffer, at, size));
                total += size;
            }
            console.error(text.trimEnd());
            state.view().setUint32(written, total, true);
            return 0;
        },
    };
}

/** The exports of the module: of a URL, a response, bytes or a compiled module. */
export async function instantiate(source) {
    let wasm = source;
    if (typeof wasm === 'string' || wasm instanceof URL) {
        const url = wasm instanceof URL ? wasm : new URL(wasm, import.meta.url);
        if (url.protocol === 'file:') wasm = await (await import('node:fs/promises')).readFile(url);
        else wasm = await fetch(url);
    }
    if (typeof Response !== 'undefined' && wasm instanceof Response) wasm = await wasm.arrayBuffer();
    const module = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm);

    const state = { view: () => new DataView(instance.exports.memory.buffer) };
    const known = wasi_imports(state);
    // Whatever else the C library names is never called.
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = known[name] ?? (() => EBADF);
    const instance = await WebAssembly.instantiate(module, imports);
    instance.exports._initialize?.();
    return instance.exports;
}

/** A function of JavaScript as one that the module can call: (i32 x so many) -> i32. */
export function function_pointer(exports, callback, parameters) {
    // A module of one import, which it exports: (type) (import "e" "f") (export "f").
    const i32 = 0x7f;
    // prettier-ignore
    const bytes = [0, 0x61, 0x73, 0x6d, 1, 0, 0, 0,
        1, 5 + parameters, 1, 0x60, parameters, ...Array(parameters).fill(i32), 1, i32,
        2, 7, 1, 1, 0x65, 1, 0x66, 0, 0,
        7, 5, 1, 1, 0x66, 0, 0];
    const module = new WebAssembly.Module(new Uint8Array(bytes));
    const { f } = new WebAssembly.Instance(module, { e: { f: callback } }).exports;
    const table = exports.__indirect_function_table;
    const index = table.length;
    table.grow(1);
    table.set(index, f);
    return index;
}
