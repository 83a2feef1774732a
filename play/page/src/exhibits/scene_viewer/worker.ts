// Runs `abut check`: the module of play/wasm/check, with new memory for each scene.

import type { Report } from "../../../../viewer/src/report";
import type { Reply, Request } from "./messages";

interface Exports {
    readonly memory: WebAssembly.Memory;
    _initialize(): void;
    malloc(size: number): number;
    abut_check_add_file(name: number, nameSize: number, bytes: number, size: number): void;
    abut_check_run(request: number, size: number): number;
    abut_check_result(): number;
    abut_check_result_size(): number;
}

let compiled: Promise<WebAssembly.Module> | undefined;

async function compile(address: string): Promise<WebAssembly.Module> {
    const response = await fetch(address);
    if (!response.ok) throw new Error(`The server does not have ${address}`);
    return WebAssembly.compile(await response.arrayBuffer());
}

function reply(message: Reply): void {
    self.postMessage(message);
}

class Check {
    private constructor(private readonly exports: Exports) {}

    static async start(module: WebAssembly.Module): Promise<Check> {
        let check: Check | undefined;
        const view = (): DataView => new DataView(check?.exports.memory.buffer ?? new ArrayBuffer(0));
        const known: Readonly<Record<string, (...numbers: number[]) => number>> = {
            progress: (what = 0, size = 0, done = 0, all = 0) => {
                reply({ progress: { what: check?.text(what, size) ?? "", done, all } });
                return 0;
            },
            clock_time_get: (_id, _precision, at = 0) => {
                view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
                return 0;
            },
        };
        // The C library names more than is ever called: there are no files, and nobody reads its messages.
        const badFile = 8;
        const imports: Record<string, Record<string, (...numbers: number[]) => number>> = {};
        for (const { module: from, name } of WebAssembly.Module.imports(module))
            (imports[from] ??= {})[name] = known[name] ?? (() => badFile);
        const instance = await WebAssembly.instantiate(module, imports);
        check = new Check(instance.exports as unknown as Exports);
        check.exports._initialize();
        return check;
    }

    run({ files, scene, settings }: Request): Reply {
        for (const { name, bytes } of files) {
            const text = new TextEncoder().encode(name);
            this.exports.abut_check_add_file(this.put(text), text.length, this.put(bytes), bytes.length);
        }
        const request = new TextEncoder().encode(JSON.stringify({ file: scene, settings }));
        const isChecked = this.exports.abut_check_run(this.put(request), request.length) !== 0;
        const result = this.text(this.exports.abut_check_result(), this.exports.abut_check_result_size());
        return isChecked ? { report: JSON.parse(result) as Report } : { problem: `${result}.` };
    }

    private put(bytes: Uint8Array): number {
        const at = this.exports.malloc(Math.max(bytes.length, 1));
        if (at === 0) throw new RangeError("There is no memory for the files");
        new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
        return at;
    }
    private text(at: number, size: number): string {
        return new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, at, size));
    }
}

self.addEventListener("message", (event: MessageEvent<Request>) => {
    const request = event.data;
    void (async () => {
        try {
            compiled ??= compile(request.wasm);
            const check = await Check.start(await compiled);
            reply(check.run(request));
        } catch (error) {
            // A trap ends the module: there was no memory, or damaged data led it astray.
            const isTrap = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
            if (isTrap) reply({ problem: `${request.scene} can't be checked here: it is damaged, or needs more memory than a page has.` });
            else reply({ problem: `${error instanceof Error ? error.message : error}.` });
        }
    })();
});
