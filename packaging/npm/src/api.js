// The parts of the library as one object: what load() returns. Names are those of C++, with the dimension at the end of types.
import { AbutError } from './arguments.js';
import { CODES, common } from './calls_common.js';
import { Library } from './library.js';

// In C++ the ray comes first.
const OF_RAYS = new Set(['raycast', 'raycast_any', 'raycast_all', 'raycast_all_columns']);

const is_point = (value) => typeof value?.[0] === 'number';

/** `makers` are the parts of the dimensions: plane, space or both. */
export function make_api(exports, makers) {
    const library = new Library(exports, CODES);
    const result = { version: library.text(exports.abut_version()), AbutError };
    const parts = [common, ...makers].map((make) => {
        const part = make(library);
        Object.assign(library.classes, part.classes);
        return part;
    });
    for (const part of parts) {
        Object.assign(result, part.classes, part.shapes, part.free);
        for (const [name, functions] of Object.entries(part.statics)) Object.assign((result[name] ??= {}), functions);
    }
    const dimensions = parts.filter((part) => part.dimension);
    for (const part of dimensions) {
        for (const kind of part.kinds) library.kinds.set(kind, part.dimension);
        add_closest_of_world(part.classes[`World${part.dimension}`].prototype);
    }
    add_queries(result, library, dimensions);
    if (result.Ball2) add_plane(result);
    if (result.Ball3) add_space(result);
    return result;
}

/** The questions as functions of plain shapes and handles, of either dimension. */
function add_queries(result, library, dimensions) {
    const of_dimension = (name, shape) => {
        const dimension = library.dimension_of(shape);
        const part = dimensions.find((one) => one.dimension === dimension);
        if (part === undefined) throw library.wrong_shape(dimension, shape);
        if (part.queries[name] === undefined) throw new TypeError(`abut: ${name} is no question of the plane`);
        return part.queries[name];
    };
    const [only] = dimensions;
    const query = (name) => {
        if (dimensions.length === 1) return only.queries[name];
        const [plane, space] = dimensions.map((part) => part.queries[name]);
        // The two common cases first; the rest is looked up, and reports what is wrong.
        return (shape, b, c, d) => {
            const dimension = library.kinds.get(shape?.type);
            const call = dimension === 3 ? space : dimension === 2 ? plane : undefined;
            return (call ?? of_dimension(name, shape))(shape, b, c, d);
        };
    };
    const queries = {};
    for (const part of dimensions) for (const name of Object.keys(part.queries)) queries[name] ??= query(name);
    for (const [name, call] of Object.entries(queries))
        result[name] = OF_RAYS.has(name) ? (ray, shape, options) => call(shape, ray, options) : call;
    const { closest, closest_to_point, sweep } = queries;
    result.closest = (a, b) => (is_point(b) ? closest_to_point(a, b) : closest(a, b));
    result.sweep = (a, motion_a, b, motion_b) => sweep(a, motion_a, b, motion_b ?? motion_a.map(() => 0));
    result.at = (shape, pose) => ({ type: 'at', shape, pose });
    result.rounded = (shape, radius) => ({ type: 'rounded', shape, radius });
    result.stretched = (shape, scale) => ({ type: 'stretched', shape, scale });
    /** A handle of a plain shape, for many questions. */
    result.build = (shape) => (dimensions.find((part) => part.dimension === library.dimension_of(shape)) ?? only).build(shape);
    result.reflect = (ray, hit) => result[`Ray${hit.point.length}`].reflect(ray, { found: true, ...hit });
}

function add_closest_of_world(prototype) {
    const { closest, closest_to_point } = prototype;
    prototype.closest = function (what, filter) {
        return (is_point(what) ? closest_to_point : closest).call(this, what, filter);
    };
}

/** The shapes of a list, as plain ones. */
function listed(parts, plain) {
    const list = Array.from({ length: parts.size() }, (_, i) => plain(parts.get(i)));
    parts.dispose();
    return list;
}

function add_plane(result) {
    const { decompose_outline, Field2 } = result;
    const { bake_outline } = Field2;
    const rings = (outline, holes) => {
        const all = [outline, ...holes].map((ring) => (typeof ring[0] === 'number' ? [...ring] : ring.flatMap((point) => [...point])));
        let end = 0;
        return [all.flat(), all.map((ring) => (end += ring.length / 2))];
    };
    result.Circle = result.Ball2;
    result.decompose_outline = (outline, holes = [], concavity = 0) =>
        listed(decompose_outline(...rings(outline, holes), concavity), result.Shape2.plain);
    Field2.bake_outline = (outline, holes = [], options = undefined) => bake_outline(...rings(outline, holes), options);
}

function add_space(result) {
    const { decompose_mesh } = result;
    result.Sphere = result.Ball3;
    result.decompose_mesh = (mesh, options) => listed(decompose_mesh(mesh, options), result.Shape3.plain);
}
