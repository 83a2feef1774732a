// The loaded module with what its functions need: memory, types, handles and callbacks.
import { AbutError } from './calls.js';
import { Arena, ARRAYS, Types } from './memory.js';
import { function_pointer } from './module.js';

/** abut_walk_mesh becomes WalkMesh. */
export const class_name = (c_name) => c_name.slice(5).split('_').map((part) => part[0].toUpperCase() + part.slice(1)).join('');

/** What the library owns. `dispose` frees it; else it is freed some time after the last use. */
export class Handle {
    /** @internal */ pointer = 0;

    dispose() {
        this.constructor.release(this);
    }
    [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
        this.dispose();
    }
}

export class Library {
    constructor(exports, api) {
        this.exports = exports;
        this.types = new Types(api);
        this.arena = new Arena(exports);
        this.classes = new Map();
        this.shapes = null;
        this.#callbacks = new Set(api.callbacks.map((callback) => callback.name));
        this.#codes = api.enums.find((entry) => entry.name === 'abut_code').values.map((value) => value.name.slice(5));
        this.#registry = new FinalizationRegistry(({ release, pointer }) => release(pointer));
        for (const handle of api.handles) this.classes.set(handle.name, this.#handle_class(handle.name));
    }
    #callbacks;
    #codes;
    #registry;
    #pointers = new WeakMap();

    #handle_class(c_name) {
        const library = this;
        const release = this.exports[`${c_name}_release`];
        const name = class_name(c_name);
        return {
            [name]: class extends Handle {
                static c_name = c_name;
                static release(handle) {
                    if (handle.pointer === 0) return;
                    library.#registry.unregister(handle);
                    release(handle.pointer);
                    handle.pointer = 0;
                }
            },
        }[name];
    }

    is_handle(c_name) {
        return this.classes.has(c_name);
    }
    is_callback(c_name) {
        return this.#callbacks.has(c_name);
    }

    /** A new object for a handle of C. */
    owning(c_name, pointer) {
        return this.adopt(Object.create(this.classes.get(c_name).prototype), c_name, pointer);
    }
    /** Makes an object the owner of a handle of C. */
    adopt(object, c_name, pointer) {
        object.pointer = pointer;
        this.#registry.register(object, { release: this.exports[`${c_name}_release`], pointer }, object);
        return object;
    }

    /** Ends the ownership of an object without freeing what it owns. */
    forget(object) {
        this.#registry.unregister(object);
        object.pointer = 0;
    }

    /** The pointer of a handle, or of a temporary one of a plain shape, which `release` frees after the call. */
    handle_of(c_name, value, release) {
        const wanted = this.classes.get(c_name);
        if (value instanceof wanted) {
            if (value.pointer === 0) throw new TypeError(`abut: this ${wanted.name} was disposed of`);
            return value.pointer;
        }
        if (c_name === 'abut_shape2' || c_name === 'abut_shape3') return this.shapes.temporary(c_name, value, release);
        throw new TypeError(`abut: a ${wanted.name} is needed, not ${value?.constructor?.name ?? value}`);
    }

    check(code) {
        if (code === 0) return;
        throw new AbutError(this.#codes[code], this.text(this.exports.abut_last_error()), this.exports.abut_last_error_index() >>> 0);
    }

    text(pointer) {
        const bytes = new Uint8Array(this.arena.buffer);
        return new TextDecoder().decode(bytes.slice(pointer, bytes.indexOf(0, pointer)));
    }

    buffer() {
        return this.arena.within(() => {
            const at = this.arena.allocate(4);
            this.check(this.exports.abut_buffer_create(at));
            return this.arena.view.getUint32(at, true);
        });
    }

    /** A function of JavaScript for C: one table entry for each function, as long as the module lives. */
    callback(c_name, callback) {
        let pointer = this.#pointers.get(callback);
        if (pointer === undefined) {
            const id = this.types.get('abut_id');
            const wrapped = (_context, ...ids) => (callback(...ids.map((at) => id.get(this.arena.view, at))) ? 1 : 0);
            pointer = function_pointer(this.exports, wrapped, c_name === 'abut_accepts_pair' ? 3 : 2);
            this.#pointers.set(callback, pointer);
        }
        return pointer;
    }

    /** An array of C by columns: numbers and vectors as one typed array, a struct as an object of those of its members. */
    columns(type, at, count) {
        if (!type.fields || type.fields.every((field) => field.type === type.fields[0].type && !field.length && !field.type.fields)) {
            const number = type.fields ? type.fields[0].type.name : type.name;
            const Typed = ARRAYS[number];
            return new Typed(this.arena.buffer, at, (count * type.size) / Typed.BYTES_PER_ELEMENT).slice();
        }
        return this.#strided(type, at, type.size, count);
    }

    #strided(type, at, stride, count) {
        const numbers = type.fields?.length && type.fields.every((field) => !field.type.fields && !field.length && field.type === type.fields[0].type);
        if (!type.fields || numbers) {
            // All elements of a column are as far apart as those of the array, and aligned as its numbers are.
            const width = type.fields?.length ?? 1;
            const Typed = ARRAYS[(type.fields?.[0].type ?? type).name];
            const source = new Typed(this.arena.buffer);
            const result = new Typed(count * width);
            const step = stride / Typed.BYTES_PER_ELEMENT;
            for (let i = 0, from = at / Typed.BYTES_PER_ELEMENT; i < count; ++i, from += step) for (let k = 0; k < width; ++k) result[i * width + k] = source[from + k];
            return result;
        }
        const result = {};
        for (const field of type.fields) {
            if (!field.length) result[field.name] = this.#strided(field.type, at + field.offset, stride, count);
            else result[field.name] = Array.from({ length: field.length }, (_, k) => this.#strided(field.type, at + field.offset + k * field.type.size, stride, count));
        }
        return result;
    }

    /** The lists of an update, which are the library's until the next one. */
    events(at) {
        const view = this.arena.view;
        const events = this.types.get('abut_events').get(view, at);
        const pair = this.types.get('abut_id_pair');
        const list = (name) => Array.from({ length: events[`${name}_count`] }, (_, i) => pair.get(view, events[name] + i * pair.size));
        const fractions = new Float32Array(this.arena.buffer, events.fractions, events.began_count).slice();
        return { began: list('began'), stayed: list('stayed'), ended: list('ended'), fractions };
    }
}
