// Rows of the table: contenders answer the same question, are compared, and are timed in turn.

const ROUNDS = 7;
// How long one turn takes at least.
const MILLISECONDS = 40;

/** Milliseconds of the processor, so that other programs don't count. */
function now() {
    const { user, system } = process.cpuUsage();
    return (user + system) / 1e3;
}

export const rows = [];

/** The linear congruential generator of all rows. */
export function random_of(seed) {
    let state = seed >>> 0;
    return (low = 0, high = 1) => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return low + ((high - low) * state) / 2 ** 32;
    };
}

function median(numbers) {
    return numbers.sort((a, b) => a - b)[numbers.length >> 1];
}

function turn(run, times) {
    const begin = now();
    for (let i = 0; i < times; ++i) run();
    return now() - begin;
}

/** Whether two answers are the same: numbers to a relative and absolute tolerance, and arrays of them but for a share of outliers. */
export function same(a, b, { tolerance = 1e-3, outliers = 0 } = {}) {
    const close = (x, y) => x === y || Math.abs(x - y) <= tolerance * Math.max(1, Math.abs(x), Math.abs(y));
    if (typeof a === 'number') return close(a, b);
    if (a.length !== b.length) return false;
    let wrong = 0;
    for (let i = 0; i < a.length; ++i) if (!close(Number(a[i]), Number(b[i]))) ++wrong;
    return wrong <= outliers * a.length;
}

/**
 * Adds a row. `contenders` are [name, answers, run]: `answers()` gives what the run computes, for the comparison with the first one, and
 * `run()` answers `count` questions. A contender whose answers differ is listed, and not timed. `once`: a run changes the state, so
 * that its turns are single ones.
 */
export function row(name, count, contenders, { tolerance, outliers, once = false } = {}) {
    const [, expected] = contenders[0];
    const wanted = expected();
    const equal = contenders.filter(([who, answers], i) => {
        if (i === 0 || same(answers(), wanted, { tolerance, outliers })) return true;
        rows.push({ name, who, ns: NaN });
        return false;
    });
    const times = equal.map(([, , run]) => {
        if (once) return 1;
        const begin = now();
        let warm = 0;
        for (; now() - begin < MILLISECONDS; ++warm) run();
        return warm;
    });
    const found = equal.map(() => []);
    for (let round = 0; round < ROUNDS; ++round)
        equal.forEach(([, , run], i) => found[i].push((turn(run, times[i]) / times[i] / count) * 1e6));
    const ns = found.map(median);
    equal.forEach(([who], i) => rows.push({ name, who, ns: ns[i], ratio: ns[i] / ns[0] }));
    console.error(`${name}: ${equal.map(([who], i) => `${who} ${ns[i].toFixed(0)} ns`).join(', ')}`);
}

/** The table as Markdown: the time of the first contender, and how many times as long the others take. */
export function table() {
    const names = [...new Set(rows.map((one) => one.name))];
    const lines = ['| | abut | others |', '|---|---|---|'];
    for (const name of names) {
        const [first, ...others] = rows.filter((one) => one.name === name && !Number.isNaN(one.ns));
        const refused = rows.filter((one) => one.name === name && Number.isNaN(one.ns));
        const cells = others.map((one) => `${one.who} ${time(one.ns)} (${one.ratio.toFixed(one.ratio < 10 ? 1 : 0)}x)`);
        cells.push(...refused.map((one) => `${one.who}: other answers`));
        lines.push(`| ${name} | ${time(first.ns)} | ${cells.join(', ')} |`);
    }
    return lines.join('\n');
}

function time(ns) {
    if (ns < 1e3) return `${ns.toFixed(0)} ns`;
    return ns < 1e6 ? `${(ns / 1e3).toFixed(ns < 1e4 ? 2 : 1)} us` : `${(ns / 1e6).toFixed(2)} ms`;
}
