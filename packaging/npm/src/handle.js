// What the library hands out: objects that own memory of the module, and the events of an update.

/** What the library owns. `dispose` frees it; else it is freed some time after the last use. */
export class Handle {
    /** @internal */ pointer = 0;

    [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
        this.dispose();
    }
}

const pair_at = (numbers, i) => ({
    a: { index: numbers[i], generation: numbers[i + 1] },
    b: { index: numbers[i + 2], generation: numbers[i + 3] },
});
const pairs_of = (numbers) => Array.from({ length: numbers.length / 4 }, (_, i) => pair_at(numbers, 4 * i));

/** The pairs of an update. `columns` has four numbers for each pair: index and generation of `a` and of `b`. The lists of objects are
 * made when they are first read. */
export class Events {
    #began;
    #stayed;
    #ended;

    constructor(began, stayed, ended, fractions) {
        this.columns = { began, stayed, ended };
        this.fractions = fractions;
    }

    get began() {
        return (this.#began ??= pairs_of(this.columns.began));
    }
    get stayed() {
        return (this.#stayed ??= pairs_of(this.columns.stayed));
    }
    get ended() {
        return (this.#ended ??= pairs_of(this.columns.ended));
    }
}
