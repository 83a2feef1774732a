// The memory of the WebAssembly module: views of it, and space for the arguments of a call.

const STACK_SIZE = 1 << 16;
// What arrays leave for the calls that a callback makes.
const RESERVE = 1 << 13;
const BYTES = { f32: 4, f64: 8, u32: 4, i32: 4, u64: 8, u8: 1 };

export class Memory {
    f32;
    f64;
    u32;
    i32;
    u64;
    u8;
    /** The length of the array that `array` has written last. */
    rows = 0;
    #exports;
    #next;
    #end;
    // What ends with a call: pointers, how to free them, and how far the stack went when they were made.
    #owned = [];
    #highest = 0;

    constructor(exports) {
        this.#exports = exports;
        this.#next = (exports.malloc(STACK_SIZE) + 7) & -8;
        this.#end = this.#next + STACK_SIZE - 8;
        this.refresh();
    }

    /** Views of all memory. They lose their contents when the memory grows. */
    refresh() {
        const { buffer } = this.#exports.memory;
        this.f32 = new Float32Array(buffer);
        this.f64 = new Float64Array(buffer);
        this.u32 = new Uint32Array(buffer);
        this.i32 = new Int32Array(buffer);
        this.u64 = new BigUint64Array(buffer);
        this.u8 = new Uint8Array(buffer);
    }

    /** Begins a call that needs so many bytes, a multiple of 8; `leave` of the result ends it. Calls may be nested. */
    enter(size) {
        if (this.u8.length === 0) this.refresh();
        const at = this.#next;
        if (at + size > this.#end) throw new RangeError('abut: too many calls within calls');
        this.#next = at + size;
        return at;
    }
    leave(at) {
        this.#next = at;
        if (this.#highest > at) this.#free(at);
    }

    /** So many bytes until the end of the call. */
    take(size) {
        const at = this.#next;
        const next = at + ((size + 7) & -8);
        if (next <= this.#end - RESERVE) {
            this.#next = next;
            return at;
        }
        const pointer = this.#exports.malloc(size);
        if (pointer === 0) throw new RangeError(`abut: no memory for ${size} bytes`);
        if (this.u8.length === 0) this.refresh();
        return this.release_later(pointer, this.#exports.free);
    }

    /** Frees a pointer at the end of the call. */
    release_later(pointer, release) {
        this.#highest = this.#next;
        this.#owned.push({ pointer, release, height: this.#next });
        return pointer;
    }
    #free(at) {
        while (this.#owned.length > 0 && this.#owned.at(-1).height > at) {
            const { pointer, release } = this.#owned.pop();
            release(pointer);
        }
        this.#highest = this.#owned.at(-1)?.height ?? 0;
    }

    /** Writes an array of C: of a typed array or an array of numbers, `width` for each element, or of an array of elements, which
     * `write` writes. */
    array(data, view, width, size, write, name) {
        if (data === undefined || data === null) throw new TypeError(`abut: ${name} is needed`);
        if (ArrayBuffer.isView(data) || typeof data[0] === 'number') return this.#numbers(data, view, width, name);
        const elements = Array.isArray(data) ? data : Array.from(data);
        const at = this.take(elements.length * size);
        if (write === null) elements.forEach((one, i) => this[view].set(one, at / BYTES[view] + i * width));
        else for (let i = 0; i < elements.length; ++i) write(at + i * size, elements[i]);
        this.rows = elements.length;
        return at;
    }
    #numbers(data, view, width, name) {
        if (view === null) throw new TypeError(`abut: ${name} is an array of objects, not of numbers`);
        if (data.length % width !== 0) throw new RangeError(`abut: ${name} has ${data.length} numbers, no multiple of ${width}`);
        const at = this.take(data.length * BYTES[view]);
        this[view].set(data, at / BYTES[view]);
        this.rows = data.length / width;
        return at;
    }

    /** Arrays of C as typed arrays and as arrays of objects. */
    copy_f32(at, count) {
        return this.f32.slice(at >> 2, (at >> 2) + count);
    }
    copy_f64(at, count) {
        return this.f64.slice(at >> 3, (at >> 3) + count);
    }
    copy_u32(at, count) {
        return this.u32.slice(at >> 2, (at >> 2) + count);
    }
    copy_u8(at, count) {
        return this.u8.slice(at, at + count);
    }
    list(at, count, size, read) {
        const result = new Array(count);
        for (let i = 0; i < count; ++i) result[i] = read(at + i * size);
        return result;
    }
}
