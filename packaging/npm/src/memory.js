// The memory of the WebAssembly module: how structs lie in it, and room for the arguments of a call.

const NUMBERS = {
    float: { size: 4, get: (view, at) => view.getFloat32(at, true), set: (view, at, value) => view.setFloat32(at, value, true) },
    double: { size: 8, get: (view, at) => view.getFloat64(at, true), set: (view, at, value) => view.setFloat64(at, value, true) },
    uint32_t: { size: 4, get: (view, at) => view.getUint32(at, true), set: (view, at, value) => view.setUint32(at, value, true) },
    int32_t: { size: 4, get: (view, at) => view.getInt32(at, true), set: (view, at, value) => view.setInt32(at, value, true) },
    uint64_t: {
        size: 8,
        get: (view, at) => view.getBigUint64(at, true),
        set: (view, at, value) => view.setBigUint64(at, BigInt(value), true),
    },
    uint8_t: { size: 1, get: (view, at) => view.getUint8(at), set: (view, at, value) => view.setUint8(at, value) },
    bool: { size: 1, get: (view, at) => view.getUint8(at) !== 0, set: (view, at, value) => view.setUint8(at, value ? 1 : 0) },
    abut_flag: { size: 4, get: (view, at) => view.getUint32(at, true) !== 0, set: (view, at, value) => view.setUint32(at, value ? 1 : 0, true) },
};
NUMBERS.size_t = NUMBERS.uint32_t;

/** The typed array of a number type. */
export const ARRAYS = {
    float: Float32Array,
    double: Float64Array,
    uint32_t: Uint32Array,
    int32_t: Int32Array,
    uint64_t: BigUint64Array,
    uint8_t: Uint8Array,
    bool: Uint8Array,
    abut_flag: Uint32Array,
};

// Vectors and rotations are arrays of numbers; the other structs are objects.
const VECTORS = new Set(['abut_vec2', 'abut_vec3', 'abut_turn', 'abut_quat']);
// Objects may leave these out.
const DEFAULTS = { abut_turn: [1, 0], abut_quat: [0, 0, 0, 1] };

/** The types of the C API: `size`, `align`, and functions that read and write a value in memory. */
export class Types {
    constructor(api) {
        this.all = new Map();
        for (const [name, number] of Object.entries(NUMBERS)) this.all.set(name, { ...number, name, align: number.size, flat: { type: name, count: 1 } });
        this.pointer = { ...NUMBERS.uint32_t, name: 'pointer', align: 4, flat: null };
        for (const callback of api.callbacks) this.all.set(callback.name, this.pointer);
        for (const struct of api.structs) this.all.set(struct.name, this.#struct(struct));
    }

    get(name) {
        return this.all.get(name);
    }

    #struct({ name, members }) {
        let offset = 0;
        let align = 1;
        const fields = members.map((member) => {
            const type = member.pointers ? this.pointer : this.get(member.type);
            offset = Math.ceil(offset / type.align) * type.align;
            const field = { name: member.name, type, offset, length: member.array ?? 0, points: member.pointers > 0 };
            offset += type.size * (member.array ?? 1);
            align = Math.max(align, type.align);
            return field;
        });
        const result = { name, size: Math.ceil(offset / align) * align, align, fields };
        result.flat = flat_of(result);
        if (VECTORS.has(name)) {
            result.get = (view, at) => fields.map((field) => field.type.get(view, at + field.offset));
            result.set = (view, at, value) => write_vector(result, view, at, value);
        } else {
            result.get = (view, at) => read_struct(result, view, at);
            result.set = (view, at, value, extra) => write_struct(result, view, at, value, extra);
        }
        return result;
    }
}

/** {type, count} if a struct is so many numbers of one type, else null. */
function flat_of(struct) {
    let count = 0;
    let type = null;
    for (const field of struct.fields) {
        const inner = field.length || field.points ? null : field.type.flat;
        if (!inner || (type && inner.type !== type)) return null;
        type = inner.type;
        count += inner.count;
    }
    return { type, count };
}

function write_vector(type, view, at, value) {
    if (!value || value.length !== type.fields.length || typeof value[0] !== 'number')
        throw new TypeError(`abut: an array of ${type.fields.length} numbers is needed, not ${describe(value)}`);
    for (let i = 0; i < value.length; ++i) view.setFloat32(at + 4 * i, value[i], true);
}

function read_struct(type, view, at) {
    const result = {};
    for (const field of type.fields) {
        if (!field.length) result[field.name] = field.type.get(view, at + field.offset);
        else result[field.name] = Array.from({ length: field.length }, (_, i) => field.type.get(view, at + field.offset + i * field.type.size));
    }
    return trimmed(result);
}

// No hit is null, and a contact has the points that there are.
function trimmed(answer) {
    if ('found' in answer) {
        if (!answer.found) return null;
        delete answer.found;
    }
    if ('hit' in answer && answer.hit === null) return null;
    if ('closest' in answer && 'id' in answer && answer.id.index === 0) return null;
    if (Array.isArray(answer.points) && 'count' in answer) {
        if (answer.count === 0) return null;
        answer.points.length = answer.count;
        delete answer.count;
    }
    return answer;
}

function write_struct(type, view, at, value, extra) {
    if (value === null || typeof value !== 'object') throw new TypeError(`abut: an object with ${type.fields.map((f) => f.name).join(', ')} is needed, not ${describe(value)}`);
    for (const name of Object.keys(value))
        if (!type.fields.some((field) => field.name === name) && !extra?.has(name)) throw new TypeError(`abut: ${type.name.slice(5)} has no member ${name}`);
    for (const field of type.fields) {
        let member = value[field.name];
        if (extra?.has(field.name)) member = extra.get(field.name);
        if (member === undefined) member = DEFAULTS[field.type.name];
        if (member === undefined) {
            // Options begin as the library's defaults; of answers that are passed in, what is left out is 0.
            continue;
        }
        if (field.length) member.forEach((one, i) => field.type.set(view, at + field.offset + i * field.type.size, one));
        else field.type.set(view, at + field.offset, member);
    }
}

export function describe(value) {
    return value === null ? 'null' : Array.isArray(value) || ArrayBuffer.isView(value) ? `an array of ${value.length}` : typeof value;
}

/** Room in the module's memory for the arguments of one call after another. */
export class Arena {
    #exports;
    #begin;
    #next;
    #large = [];
    #view = null;
    static size = 1 << 16;

    constructor(exports) {
        this.#exports = exports;
        this.#begin = exports.malloc(Arena.size);
        this.#next = this.#begin;
    }

    /** A view of all memory, made anew when the memory has grown. */
    get view() {
        if (this.#view?.buffer !== this.#exports.memory.buffer) this.#view = new DataView(this.#exports.memory.buffer);
        return this.#view;
    }
    get buffer() {
        return this.#exports.memory.buffer;
    }

    /** So many bytes, cleared, until `release` of the mark before. */
    allocate(size) {
        const at = Math.ceil(this.#next / 8) * 8;
        if (at + size <= this.#begin + Arena.size) {
            this.#next = at + size;
            new Uint8Array(this.buffer, at, size).fill(0);
            return at;
        }
        const pointer = this.#exports.malloc(size);
        if (pointer === 0) throw new RangeError(`abut: no memory for ${size} bytes`);
        this.#large.push(pointer);
        new Uint8Array(this.buffer, pointer, size).fill(0);
        return pointer;
    }

    /** Calls `body`, and frees what it has allocated; calls may be nested. */
    within(body) {
        const next = this.#next;
        const large = this.#large.length;
        try {
            return body();
        } finally {
            this.#next = next;
            while (this.#large.length > large) this.#exports.free(this.#large.pop());
        }
    }
}
