// Checks scenes in a worker, one at a time; the next one ends the one before.

import wasm from "abut/check.wasm?url";
import type { Report } from "../../../../viewer/src/report";
import type { Progress, Reply, Request, SceneFile, Settings } from "./messages";

export class Checker {
    private worker: Worker | undefined;
    private end: ((why: Error) => void) | undefined;

    /** Rejects with a sentence. */
    check(files: readonly SceneFile[], scene: string, settings: Settings, onProgress: (progress: Progress) => void): Promise<Report> {
        this.stop();
        const worker = (this.worker ??= new Worker(new URL("./worker.ts", import.meta.url), { type: "module" }));
        return new Promise((resolve, reject) => {
            this.end = reject;
            worker.onmessage = ({ data }: MessageEvent<Reply>) => {
                if ("progress" in data) return onProgress(data.progress);
                this.end = undefined;
                if ("report" in data) resolve(data.report);
                else reject(new Error(data.problem));
            };
            worker.onerror = () => {
                this.stop();
                reject(new Error("The browser could not start the part of the page that checks scenes."));
            };
            const request: Request = { files, scene, settings, wasm: new URL(wasm, document.baseURI).href };
            worker.postMessage(request);
        });
    }

    /** Ends what runs. */
    stop(): void {
        if (!this.end) return;
        this.worker?.terminate();
        this.worker = undefined;
        this.end(new Error("The check was stopped."));
        this.end = undefined;
    }
    dispose(): void {
        this.stop();
        this.worker?.terminate();
    }
}
