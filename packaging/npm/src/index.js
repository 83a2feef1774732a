// abut for JavaScript: `const abut = await load()`. Names are those of C++, with the dimension at the end of types.
import { AbutError, Call } from './calls.js';
import { class_name, Handle, Library } from './library.js';
import { instantiate } from './module.js';
import { Shapes } from './shapes.js';

export { AbutError };

const CONSTRUCTORS = new Set(['create', 'build']);
// In C++ the ray comes first.
const OF_RAYS = new Set(['raycast', 'raycast_any', 'raycast_all']);
// Their result is a plain polygon or polyhedron.
const POLYTOPES = new Set(['polytope', 'intersection', 'minkowski_sum', 'minkowski_difference']);
// What plain shapes do by themselves.
const PLAIN = new Set(['at', 'rounded', 'stretched']);

const longest = (name, owners) => owners.filter((owner) => name.startsWith(`${owner}_`)).sort((a, b) => b.length - a.length)[0];

async function load_api() {
    const url = new URL('../abut_api.json', import.meta.url);
    if (url.protocol === 'file:') return JSON.parse(await (await import('node:fs/promises')).readFile(url, 'utf8'));
    return (await fetch(url)).json();
}

/** Loads the library. `source` is a URL, a Response, bytes or a WebAssembly.Module, and `api` the content of abut_api.json; by
 * default they are the files of this package. */
export async function load(source, api) {
    const [exports, description] = await Promise.all([instantiate(source), api ?? load_api()]);
    return make_api(new Library(exports, description), description);
}

function make_api(library, api) {
    const shapes = (library.shapes = new Shapes(library, api));
    const result = { version: library.text(library.exports.abut_version()), AbutError };
    const handles = [...library.classes.keys()].filter((name) => name !== 'abut_buffer');
    const structs = api.structs.map((struct) => struct.name);
    for (const name of handles) result[class_name(name)] = library.classes.get(name);
    for (const description of api.functions) {
        const { name } = description;
        if (/^abut_(buffer|last)|_(release|default|version)$/.test(name)) continue;
        const call = new Call(library, description);
        const owner = longest(name, handles);
        if (!owner) {
            const struct = longest(name, structs);
            if (struct) (result[class_name(struct)] ??= {})[name.slice(struct.length + 1)] = (...given) => call.invoke(...given);
            else result[name.slice(5)] = (...given) => call.invoke(...given);
            continue;
        }
        const short = name.slice(owner.length + 1);
        const [first] = description.arguments;
        const cls = library.classes.get(owner);
        if (first.type === owner && first.pointers === 1) add_method(cls, short, call, library);
        else if (CONSTRUCTORS.has(short)) result[class_name(owner)] = constructible(cls, owner, call, library);
        else if (owner.startsWith('abut_shape') && !owner.startsWith('abut_shapes')) add_shape(result, shapes, description, short, call, api);
        else cls[short] = (...given) => call.invoke(...given);
    }
    result.Circle = result.Ball2;
    result.Sphere = result.Ball3;
    add_free_functions(result, library, shapes);
    add_baking(result, shapes);
    return result;
}

function add_method(cls, short, call, library) {
    cls.prototype[short] = function (...given) {
        const answer = call.invoke(this, ...given);
        return POLYTOPES.has(short) ? library.shapes.plain(answer) : answer;
    };
}

/** The class with a constructor: `new World3()`. Objects that the library makes are of it as well. */
function constructible(cls, c_name, call, library) {
    const name = class_name(c_name);
    const result = {
        [name]: class extends cls {
            constructor(...given) {
                super();
                const made = call.invoke(...given);
                library.adopt(this, c_name, made.pointer);
                // The pointer has one owner.
                library.forget(made);
            }
        },
    }[name];
    library.classes.set(c_name, result);
    return result;
}

/** Ball3(center, radius) makes a plain shape; Mesh(points, triangles) a handle. */
function add_shape(result, shapes, description, short, call, api) {
    const owner = call.name.slice(0, 11);
    const in_both = api.functions.some((f) => f.name === `abut_shape${5 - Number(owner.at(-1))}_${short}`);
    const name = class_name(`abut_${short}`) + (in_both ? owner.at(-1) : '');
    const struct = api.structs.find((entry) => entry.name === description.arguments[0].type);
    if (struct && shapes.structs.get(struct.name.slice(5))?.function === description.name) {
        const members = struct.members.map((member) => member.name);
        result[name] = (...given) => {
            const shape = { type: struct.name.slice(5) };
            members.forEach((member, i) => {
                if (given[i] !== undefined) shape[member] = given[i];
            });
            return shape;
        };
    } else {
        result[name] = (...given) => call.invoke(...given);
    }
}

/** The questions as functions of plain shapes and handles, of either dimension. */
function add_free_functions(result, library, shapes) {
    const methods = Object.getOwnPropertyNames(library.classes.get('abut_shape3').prototype);
    const query = (name, shape, ...given) => {
        const owner = shapes.owner_of(shape);
        const answer = shapes.calls.get(`${owner}_${name}`).invoke(shape, ...given);
        return POLYTOPES.has(name) ? shapes.plain(answer) : answer;
    };
    for (const name of methods) {
        if (name === 'constructor' || PLAIN.has(name)) continue;
        if (OF_RAYS.has(name)) result[name] = (ray, shape, options) => query(name, shape, ray, options);
        else result[name] = (shape, ...given) => query(name, shape, ...given);
    }
    const is_point = (value) => typeof value?.[0] === 'number';
    result.closest = (a, b) => query(is_point(b) ? 'closest_to_point' : 'closest', a, b);
    result.sweep = (a, motion_a, b, motion_b) => query('sweep', a, motion_a, b, motion_b ?? motion_a.map(() => 0));
    for (const dimension of ['2', '3']) {
        const { prototype } = library.classes.get(`abut_world${dimension}`);
        const { closest, closest_to_point } = prototype;
        prototype.closest = function (what, filter) {
            return (is_point(what) ? closest_to_point : closest).call(this, what, filter);
        };
    }
    result.at = (shape, pose) => ({ type: 'at', shape, pose });
    result.rounded = (shape, radius) => ({ type: 'rounded', shape, radius });
    result.stretched = (shape, scale) => ({ type: 'stretched', shape, scale });
    /** A handle of a plain shape, for many questions. */
    result.build = (shape) => shapes.make(shape);
    result.reflect = (ray, hit) => (hit.point.length === 2 ? result.Ray2 : result.Ray3).reflect(ray, { found: true, ...hit });
}

function add_baking(result, shapes) {
    const listed = (parts) => {
        const list = Array.from({ length: parts.size() }, (_, i) => shapes.plain(parts.get(i)));
        parts.dispose();
        return list;
    };
    const rings = (outline, holes) => {
        const all = [outline, ...holes].map((ring) => (typeof ring[0] === 'number' ? [...ring] : ring.flatMap((point) => [...point])));
        let end = 0;
        return [all.flat(), all.map((ring) => (end += ring.length / 2))];
    };
    const { decompose_mesh, decompose_outline } = result;
    const { bake_outline } = result.Field2;
    result.decompose_mesh = (mesh, options) => listed(decompose_mesh(mesh, options));
    result.decompose_outline = (outline, holes = [], concavity = 0) => listed(decompose_outline(...rings(outline, holes), concavity));
    result.Field2.bake_outline = (outline, holes = [], options = undefined) => bake_outline(...rings(outline, holes), options);
}

export { Handle };
