// Plain shapes: objects of numbers, such as {type: 'ball3', center: [0, 0, 0], radius: 1}. A question makes a handle of one for the
// time of the call, so that nothing is left to free.
import { Call } from './calls.js';

const ADAPTORS = { at: 'pose', rounded: 'radius', stretched: 'scale' };
const HULLS = { polygon: 'abut_shape2', polyhedron: 'abut_shape3' };

export class Shapes {
    constructor(library, api) {
        this.library = library;
        this.calls = new Map();
        // The structs that a shape is made of, by the type of the plain shape: ball3, box2, cone.
        this.structs = new Map();
        for (const description of api.functions) {
            const [first] = description.arguments;
            if (!description.name.startsWith('abut_shape')) continue;
            this.calls.set(description.name, new Call(library, description));
            if (first.pointers === 0 && api.structs.some((struct) => struct.name === first.type) && description.arguments.length === 2)
                this.structs.set(first.type.slice(5), { function: description.name, owner: description.arguments[1].type });
        }
    }

    /** abut_shape2 or abut_shape3. */
    owner_of(shape) {
        const c_name = shape?.constructor?.c_name;
        if (c_name === 'abut_shape2' || c_name === 'abut_shape3') return c_name;
        const type = shape?.type;
        if (type in ADAPTORS) return this.owner_of(shape.shape);
        const owner = HULLS[type] ?? this.structs.get(type)?.owner;
        if (!owner) throw new TypeError(`abut: a shape is needed, not ${type ?? shape?.constructor?.name ?? shape}`);
        return owner;
    }

    /** A new handle of any shape. */
    make(shape) {
        const owner = this.owner_of(shape);
        if (!('type' in shape)) return shape;
        const { type, ...members } = shape;
        if (type in ADAPTORS) return this.calls.get(`${owner}_${type}`).invoke(shape.shape, shape[ADAPTORS[type]]);
        if (type in HULLS) return this.calls.get(`${owner}_${type}`).invoke(shape.points);
        return this.calls.get(this.structs.get(type).function).invoke(members);
    }

    temporary(c_name, shape, release) {
        if (this.owner_of(shape) !== c_name) throw new TypeError(`abut: a shape of ${c_name.endsWith('2') ? 'the plane' : 'space'} is needed, not ${shape.type ?? shape.constructor.name}`);
        const handle = this.make(shape);
        release.push(() => handle.dispose());
        return handle.pointer;
    }

    /** A polygon or polyhedron of the library as a plain shape, with its measures; frees the handle. */
    plain(handle) {
        if (handle === null) return null;
        const owner = handle.constructor.c_name;
        const points = this.calls.get(`${owner}_points`).invoke(handle);
        const measures = this.calls.get(`${owner}_measures`).invoke(handle);
        const faces = owner === 'abut_shape3' ? { triangles: this.calls.get('abut_shape3_triangles').invoke(handle) } : {};
        handle.dispose();
        return { type: owner === 'abut_shape2' ? 'polygon' : 'polyhedron', points, ...faces, ...measures };
    }
}
