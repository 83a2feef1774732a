// Functions of the C API as functions of JavaScript, made by their descriptions. An argument is left out where it follows from the
// others: lengths, strides, capacities and outputs.
import { ARRAYS, describe } from './memory.js';

const STRIDES = new Set(['stride', 'id_stride', 'pose_stride', 'place_stride', 'step_stride']);
const WITH_DEFAULT = { max_vertices: 0, closed: false, one_sided: false, holes: [], concavity: 0, workers: 0, softness: 0.05 };
// Lists in structs, and their lengths.
const LENGTHS = { ignore_ids: ['ignore_count', 'abut_id'], area_costs: ['area_cost_count', 'float'] };

/** What the library reports about wrong arguments. `code` is such as 'NOT_FINITE', `index` that of the element. */
export class AbutError extends Error {
    constructor(code, message, index) {
        super(message);
        this.name = 'AbutError';
        this.code = code;
        this.index = index;
    }
}

export class Call {
    constructor(library, description) {
        this.library = library;
        this.name = description.name;
        this.all = description.arguments;
        this.lengths = new Map();
        for (const a of this.all) {
            const match = /^(?:(\d) \* )?(\w+)$/.exec(a.array ?? '');
            if (match && a.direction === 'in' && !this.lengths.has(match[2])) this.lengths.set(match[2], a.name);
        }
        const has_list = this.all.some((a) => a.name === 'capacity');
        const is_length = (a) => has_list && a.direction === 'out' && ['count', 'id_count'].includes(a.name) && !a.array;
        this.list_length = this.all.find(is_length)?.name;
        this.takes_k = this.name.endsWith('_k_nearest');
        const is_output = (a) => a.direction === 'out' || (a.type === 'abut_buffer' && a.name === 'out');
        this.outputs = this.all.filter((a) => is_output(a) && !is_length(a));
        const automatic = (a) => this.lengths.has(a.name) || STRIDES.has(a.name) || a.name === 'context' || is_output(a) || (a.name === 'capacity' && !this.takes_k);
        const has_default = (a) => a.optional || a.name in WITH_DEFAULT;
        const parameters = this.all.filter((a) => !automatic(a));
        this.parameters = [...parameters.filter((a) => !has_default(a)), ...parameters.filter(has_default)];
    }

    /** The answer: one value, or an object by the names of the outputs. */
    invoke(...given) {
        if (given.length > this.parameters.length) throw new TypeError(`abut: ${this.name} takes ${this.parameters.length} arguments, not ${given.length}`);
        const values = new Map(this.parameters.map((a, i) => [a.name, given[i] ?? (a.name in WITH_DEFAULT ? WITH_DEFAULT[a.name] : undefined)]));
        for (const a of this.parameters)
            if (values.get(a.name) === undefined && !a.optional) throw new TypeError(`abut: ${this.name} needs ${a.name}`);
        // Most lists are short; a longer one is read again with its full length.
        let capacity = this.takes_k ? values.get('capacity') : 64;
        for (;;) {
            const result = this.library.arena.within(() => this.#once(values, capacity));
            if (result.length === undefined || this.takes_k || result.length <= capacity) return result.answer;
            capacity = result.length;
        }
    }

    #once(values, capacity) {
        const { arena, exports } = this.library;
        const c = new Map();
        const lengths = new Map([['capacity', capacity]]);
        const release = [];
        let stride = 0;
        try {
            for (const a of this.all) {
                if (STRIDES.has(a.name)) c.set(a.name, stride);
                else if (a.array && a.direction === 'in') {
                    const array = this.#array(a, values.get(a.name), lengths, values, release);
                    c.set(a.name, array.pointer);
                    stride = array.stride;
                } else if (values.has(a.name) && a.name !== 'capacity') c.set(a.name, this.#single(a, values.get(a.name), release));
            }
            for (const name of this.lengths.keys()) c.set(name, lengths.get(name) ?? 0);
            c.set('capacity', capacity);
            const outputs = this.outputs.map((a) => this.#output(a, lengths, c, release));
            const length_at = this.list_length ? arena.allocate(4) : 0;
            if (this.list_length) c.set(this.list_length, length_at);
            this.library.check(exports[this.name](...this.all.map((a) => c.get(a.name) ?? 0)));
            const length = this.list_length ? arena.view.getUint32(length_at, true) : undefined;
            // A list that did not fit is read again.
            if (length > capacity && !this.takes_k) return { length };
            const answers = outputs.map((output) => output(length));
            if (answers.length <= 1) return { length, answer: answers[0] };
            return { length, answer: Object.fromEntries(this.outputs.map((a, i) => [a.name, answers[i]])) };
        } finally {
            for (const free of release) free();
        }
    }

    #single(a, value, release) {
        const { arena, types, exports } = this.library;
        const type = types.get(a.type);
        if (this.library.is_handle(a.type)) {
            if (value === undefined || value === null) {
                if (a.optional) return 0;
                throw new TypeError(`abut: ${this.name} needs ${a.name}`);
            }
            return this.library.handle_of(a.type, value, release);
        }
        if (this.library.is_callback(a.type)) return value === undefined || value === null ? 0 : this.library.callback(a.type, value);
        if (a.pointers) {
            if (value === undefined || value === null) return 0;
            const at = arena.allocate(type.size);
            exports[`${a.type}_default`]?.(at);
            const extra = new Map();
            for (const [list, [count, element]] of Object.entries(LENGTHS)) {
                if (!Array.isArray(value[list]) && !ArrayBuffer.isView(value[list])) continue;
                const array = this.#elements(types.get(element), value[list]);
                extra.set(list, array.pointer).set(count, array.rows);
            }
            if (typeof value.accepts === 'function') extra.set('accepts', this.library.callback('abut_accepts', value.accepts));
            type.set(arena.view, at, value, extra);
            return at;
        }
        if (type.fields) {
            const at = arena.allocate(type.size);
            type.set(arena.view, at, value);
            return at;
        }
        if (a.type === 'uint64_t') return BigInt(value);
        if (typeof value !== 'number' && typeof value !== 'boolean') throw new TypeError(`abut: ${this.name}: ${a.name} is no number, but ${describe(value)}`);
        return Number(value);
    }

    #array(a, data, lengths, values, release) {
        if (data === undefined || data === null) {
            if (a.optional) return { pointer: 0, stride: 0 };
            throw new TypeError(`abut: ${this.name} needs ${a.name}`);
        }
        const { arena, types } = this.library;
        const match = /^(?:(\d) \* )?(\w+)$/.exec(a.array);
        let array;
        if (a.pointers === 2) {
            const pointers = [...data].map((one) => this.library.handle_of(a.type, one, release));
            const at = arena.allocate(4 * pointers.length);
            pointers.forEach((pointer, i) => arena.view.setUint32(at + 4 * i, pointer, true));
            array = { pointer: at, rows: pointers.length, stride: 0 };
        } else {
            array = this.#elements(types.get(a.type), data, Number(match?.[1] ?? 1), a.name);
        }
        if (match && this.lengths.has(match[2])) {
            if ((lengths.get(match[2]) ?? array.rows) !== array.rows)
                throw new RangeError(`abut: ${this.name}: ${a.name} has ${array.rows} elements, where ${lengths.get(match[2])} are needed`);
            lengths.set(match[2], array.rows);
        } else if (!match) {
            const needed = a.array.split(' * ').reduce((product, name) => product * values.get(name), 1);
            if (array.rows !== needed) throw new RangeError(`abut: ${this.name}: ${a.name} has ${array.rows} elements, where ${needed} are needed`);
        }
        return array;
    }

    /** A typed array of the numbers of all elements, or an array of elements, as an array of C. */
    #elements(type, data, group = 1, name = 'the array') {
        const { arena } = this.library;
        if (ArrayBuffer.isView(data) || (type.flat && typeof data[0] === 'number')) {
            if (!type.flat) throw new TypeError(`abut: ${this.name}: ${name} is an array of objects, not of numbers`);
            const width = type.flat.count * group;
            if (data.length % width !== 0) throw new RangeError(`abut: ${this.name}: ${name} has ${data.length} numbers, no multiple of ${width}`);
            const Typed = ARRAYS[type.flat.type];
            const at = arena.allocate(data.length * Typed.BYTES_PER_ELEMENT);
            new Typed(arena.buffer, at, data.length).set(data);
            return { pointer: at, rows: data.length / width, stride: 0 };
        }
        const elements = group > 1 ? [...data].flatMap((one) => [...one]) : [...data];
        const at = arena.allocate(elements.length * type.size);
        elements.forEach((one, i) => {
            const place = at + i * type.size;
            if (type.fields) this.library.exports[`${type.name}_default`]?.(place);
            type.set(arena.view, place, one);
        });
        return { pointer: at, rows: elements.length / group, stride: 0 };
    }

    /** Makes room for an output; returns a function that reads it. */
    #output(a, lengths, c, release) {
        const { arena, types, exports } = this.library;
        if (a.type === 'abut_buffer' && a.pointers === 1) {
            const buffer = this.library.buffer();
            release.push(() => exports.abut_buffer_release(buffer));
            c.set(a.name, buffer);
            return () => new Uint8Array(arena.buffer, exports.abut_buffer_data(buffer), exports.abut_buffer_size(buffer)).slice();
        }
        if (a.array) {
            const match = /^(?:(\d) \* )?(\w+)$/.exec(a.array);
            const type = types.get(a.type);
            const group = Number(match[1] ?? 1);
            const count = lengths.get(match[2]) ?? 0;
            const at = arena.allocate(count * type.size * group);
            c.set(a.name, at);
            if (match[2] === 'capacity') return (length) => this.#list(type, at, length * group);
            return () => this.library.columns(type, at, count * group);
        }
        const type = a.pointers === 2 ? types.pointer : types.get(a.type);
        const at = arena.allocate(type.size);
        c.set(a.name, at);
        if (a.pointers === 2)
            return () => {
                const pointer = arena.view.getUint32(at, true);
                return pointer === 0 ? null : this.library.owning(a.type, pointer);
            };
        if (a.type === 'abut_events') return () => this.library.events(at);
        return () => type.get(arena.view, at);
    }

    // Numbers and vectors as one typed array, other elements as objects.
    #list(type, at, count) {
        if (!type.fields || (type.flat?.type === 'float' && type.fields.every((field) => !field.type.fields))) return this.library.columns(type, at, count);
        return Array.from({ length: count }, (_, i) => type.get(this.library.arena.view, at + i * type.size));
    }
}
