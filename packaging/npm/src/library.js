// The loaded module with what its calls need: memory, owners, errors and callbacks.
import { AbutError, describe } from './arguments.js';
import { Memory } from './memory.js';
import { function_pointer } from './module.js';

export class Library {
    // Classes of handles, and dimensions of plain shapes by their type.
    classes = {};
    kinds = new Map();
    #codes;
    #registry = new FinalizationRegistry(({ pointer, release }) => release(pointer));
    #pointers = new WeakMap();

    constructor(exports, codes) {
        this.exports = exports;
        this.memory = new Memory(exports);
        this.#codes = codes;
    }

    /** Throws what a call of C reports, and looks whether the memory has grown. */
    check(code) {
        if (code !== 0) throw this.#error(code);
        if (this.memory.u8.length === 0) this.memory.refresh();
    }
    #error(code) {
        this.memory.refresh();
        return new AbutError(this.#codes[code], this.text(this.exports.abut_last_error()), this.exports.abut_last_error_index() >>> 0);
    }

    text(pointer) {
        const { u8 } = this.memory;
        return new TextDecoder().decode(u8.slice(pointer, u8.indexOf(0, pointer)));
    }

    // --- owners ---

    /** A new object of a class for a handle of C; null for no handle. */
    owning(cls, pointer) {
        return pointer === 0 ? null : this.own(Object.create(cls.prototype), pointer);
    }
    /** Makes an object the owner of a handle of C. */
    own(object, pointer) {
        object.pointer = pointer;
        this.#registry.register(object, { pointer, release: object.release_pointer }, object);
        return object;
    }
    dispose(handle) {
        if (handle.pointer === 0) return;
        this.#registry.unregister(handle);
        handle.release_pointer(handle.pointer);
        handle.pointer = 0;
    }

    pointer_of(handle) {
        if (handle.pointer === 0) throw new TypeError(`abut: this ${handle.constructor.name} was disposed of`);
        return handle.pointer;
    }
    /** The pointer of an object that must be of the class. */
    pointer(handle, name) {
        if (handle instanceof this.classes[name]) return this.pointer_of(handle);
        throw new TypeError(`abut: a ${name} is needed, not ${handle?.constructor?.name ?? handle}`);
    }

    wrong_shape(dimension, value) {
        const name = value?.type ?? value?.constructor?.name ?? describe(value);
        const is_of_other = this.dimension_of(value) !== 0;
        return new TypeError(`abut: a shape${is_of_other ? (dimension === 2 ? ' of the plane' : ' of space') : ''} is needed, not ${name}`);
    }
    /** 2 or 3, or 0 for what is no shape. */
    dimension_of(shape) {
        const kind = this.kinds.get(shape?.type);
        if (kind !== undefined) return kind;
        if (shape instanceof Object && shape.shape !== undefined && shape.type !== undefined) return this.dimension_of(shape.shape);
        const { Shape2, Shape3 } = this.classes;
        return Shape3 !== undefined && shape instanceof Shape3 ? 3 : Shape2 !== undefined && shape instanceof Shape2 ? 2 : 0;
    }

    // --- bytes ---

    /** What a buffer of the library holds. */
    bytes(buffer) {
        const begin = this.exports.abut_buffer_data(buffer);
        return this.memory.u8.slice(begin, begin + this.exports.abut_buffer_size(buffer));
    }

    // --- callbacks ---

    /** A function of JavaScript for C: one table entry for each function, as long as the module lives. */
    callback(callback, count) {
        let pointer = this.#pointers.get(callback);
        if (pointer === undefined) {
            const id = (at) => ({ index: this.memory.u32[at >> 2], generation: this.memory.u32[(at >> 2) + 1] });
            const call = (_context, ...ids) => {
                if (this.memory.u8.length === 0) this.memory.refresh();
                return callback(...ids.map(id)) ? 1 : 0;
            };
            pointer = function_pointer(this.exports, call, count);
            this.#pointers.set(callback, pointer);
        }
        return pointer;
    }
}
