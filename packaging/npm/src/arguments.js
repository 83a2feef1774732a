// What the calls say of wrong arguments.

/** What the library reports about wrong arguments. `code` is such as 'NOT_FINITE', `index` that of the element. */
export class AbutError extends Error {
    constructor(code, message, index) {
        super(message);
        this.name = 'AbutError';
        this.code = code;
        this.index = index;
    }
}

export function describe(value) {
    return value === null ? 'null' : Array.isArray(value) || ArrayBuffer.isView(value) ? `an array of ${value.length}` : typeof value;
}

export const vector_needed = (count, value) => new TypeError(`abut: an array of ${count} numbers is needed, not ${describe(value)}`);
export const object_needed = (members, value) => new TypeError(`abut: an object with ${members} is needed, not ${describe(value)}`);
export const wrong_length = (name, length, needed) => new RangeError(`abut: ${name} has ${length} elements, where ${needed} are needed`);

export function number(value, name) {
    if (typeof value === 'number') return value;
    if (typeof value === 'boolean') return value ? 1 : 0;
    throw new TypeError(`abut: ${name} is no number, but ${describe(value)}`);
}

/** An options object has no members but these. */
export function check_members(value, members, name) {
    if (value === null || typeof value !== 'object') throw object_needed([...members].join(', '), value);
    for (const member in value) if (!members.has(member)) throw new TypeError(`abut: ${name} has no member ${member}`);
}
