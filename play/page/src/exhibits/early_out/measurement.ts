// Times orders of tests, one run at a time, so that the page goes on meanwhile.

import { within } from "../../within";

/** Runs tests in this order on all inputs so many times; returns how many inputs pass. */
export type Run = (order: readonly number[], repeats: number) => number;

interface Series {
    readonly order: readonly number[];
    repeats: number;
    passed: number;
    /** Nanoseconds an input. */
    readonly times: number[];
}

/** A run should take this long, in milliseconds: clocks of browsers are coarse. */
const runTime = 3;
const rounds = 12;

export class Measurement {
    private readonly series: readonly Series[];
    private next = 0;

    /** Orders may leave out tests. The empty one, whose time is that of the loop, is measured as well. */
    constructor(
        private readonly run: Run,
        private readonly inputs: number,
        orders: readonly (readonly number[])[],
    ) {
        this.series = [[], ...orders].map((order) => ({ order, repeats: 1, passed: 0, times: [] }));
    }

    get isDone(): boolean {
        return this.next >= rounds * this.series.length;
    }
    /** From 0 to 1. */
    get progress(): number {
        return Math.min(this.next / (rounds * this.series.length), 1);
    }
    /** One more run of one order. */
    advance(): void {
        const one = this.series[this.next++ % this.series.length];
        if (!one) return;
        const start = performance.now();
        one.passed = this.run(one.order, one.repeats);
        const time = performance.now() - start;
        // The first runs find how often to repeat.
        if (time < runTime / 2 && one.repeats < 1e4) {
            one.repeats = Math.ceil(one.repeats * within(runTime / Math.max(time, 0.1), 1, 20));
            --this.next;
        } else one.times.push((1e6 * time) / (one.repeats * this.inputs));
    }
    has(order: readonly number[]): boolean {
        return (this.find(order)?.times.length ?? 0) > 0;
    }
    /** The nanoseconds that an order takes for an input, without the loop. */
    time(order: readonly number[]): number {
        return Math.max(usual(this.find(order)) - usual(this.find([])), 0);
    }
    /** The share of the inputs that pass. */
    pass(order: readonly number[]): number {
        return (this.find(order)?.passed ?? 0) / this.inputs;
    }

    private find(order: readonly number[]): Series | undefined {
        return this.series.find((one) => one.order.length === order.length && one.order.every((test, i) => test === order[i]));
    }
}

/** The mean of the faster half: the others were interrupted. */
function usual(series: Series | undefined): number {
    const times = [...(series?.times ?? [])].sort((a, b) => a - b);
    const half = times.slice(0, Math.ceil(times.length / 2));
    return half.reduce((sum, time) => sum + time, 0) / Math.max(half.length, 1);
}
