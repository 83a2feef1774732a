// Points by a number: the same on every machine, so that a link or a test can name them.

/** Points within about 1 of the origin, from every seed others. */
export function seededPoints(seed: number, dimension: number, count: number): number[][] {
    let state = seed | 0;
    // Mulberry32, a generator of 32 bits by Tommy Ettinger.
    const random = (): number => {
        state = (state + 0x6d2b79f5) | 0;
        let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
        mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
        return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
    };
    return Array.from({ length: count }, () => Array.from({ length: dimension }, () => Math.fround(2 * random() - 1)));
}
