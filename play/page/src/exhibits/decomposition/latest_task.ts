// Runs tasks in a worker, one at a time: a new task replaces one that waits, and ends one that takes long.

import type { Result, Task } from "./task";

/** A task that takes longer is ended when a newer one waits, in milliseconds. */
const patience = 700;

interface Job {
    readonly task: Task;
    done(result: Result | null): void;
}

export class LatestTask {
    private worker: Worker | undefined;
    private running: Job | undefined;
    private waiting: Job | undefined;
    private timer = 0;

    /** The result of a task; null if a later one took its place. */
    run(task: Task): Promise<Result | null> {
        return new Promise((resolve) => {
            this.waiting?.done(null);
            this.waiting = { task, done: resolve };
            this.next();
            if (this.waiting) this.timer ||= window.setTimeout(() => this.end(), patience);
        });
    }
    dispose(): void {
        clearTimeout(this.timer);
        this.worker?.terminate();
    }

    private next(): void {
        if (this.running || !this.waiting) return;
        this.running = this.waiting;
        this.waiting = undefined;
        this.worker ??= this.start();
        this.worker.postMessage(this.running.task);
    }
    private finish(result: Result | null): void {
        clearTimeout(this.timer);
        this.timer = 0;
        const job = this.running;
        this.running = undefined;
        this.next();
        job?.done(result);
    }
    private end(): void {
        this.worker?.terminate();
        this.worker = undefined;
        this.finish(null);
    }
    private start(): Worker {
        const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
        worker.addEventListener("message", ({ data }: MessageEvent<Result>) => this.finish(data));
        worker.addEventListener("error", (event) =>
            this.finish({ kind: "error", message: event.message || "The page could not start its worker." }),
        );
        return worker;
    }
}
