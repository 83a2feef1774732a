// The mean time of calls. The clocks of browsers are coarse, so a single time says little.

export class Stopwatch {
    private readonly times: number[] = [];

    /** Calls `body`, and adds its time. */
    measure<Result>(body: () => Result): Result {
        const start = performance.now();
        const result = body();
        this.times.push(performance.now() - start);
        if (this.times.length > 90) this.times.shift();
        return result;
    }
    /** Of the last 90 calls without the slowest twentieth, which something else has interrupted. In milliseconds. */
    get mean(): number {
        const times = [...this.times].sort((a, b) => a - b);
        const counted = times.slice(0, Math.ceil(0.95 * times.length));
        return counted.reduce((sum, time) => sum + time, 0) / Math.max(counted.length, 1);
    }
    clear(): void {
        this.times.length = 0;
    }
}
