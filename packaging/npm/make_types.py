"""Writes the types of the package, or of an entry of one dimension: make_types.py API_JSON OUT [2|3].

What make_calls.py makes and src/api.js puts together has these types.
"""

import sys

from c_api import *

api = Api(sys.argv[1])
DIMENSIONS = [int(sys.argv[3])] if len(sys.argv) > 3 else [2, 3]
TUPLES = {"abut_vec2": "[number, number]", "abut_vec3": "[number, number, number]", "abut_turn": "[number, number]",
          "abut_quat": "[number, number, number, number]"}
VECTOR_NAMES = {"abut_vec2": "Vec2", "abut_vec3": "Vec3", "abut_turn": "Turn", "abut_quat": "Quat"}

HEADER = """/// <reference lib="esnext.disposable" />
// Collision detection in {where}. Made of abut_api.json; names are those of C++, with the dimension at the end of types.

export type Vec2 = ArrayLike<number>;
export type Vec3 = Vec2;
/** [cos, sin] */
export type Turn = Vec2;
/** [x, y, z, w] */
export type Quat = Vec2;
/** Numbers of all elements one after the other, or an array of elements. */
export type Numbers = ArrayLike<number> | ReadonlyArray<Vec2>;

/** What the library reports about wrong arguments. `code` is such as 'NOT_FINITE', `index` that of the element. */
export class AbutError extends Error {{
    code: string;
    index: number;
}}

/** What the library owns. `dispose`, or `using`, frees it; else it is freed some time after the last use. */
export class Handle {{
    dispose(): void;
    [Symbol.dispose](): void;
}}

/** The pairs of an update. `columns` has four numbers for each pair: index and generation of `a` and of `b`. The lists of objects are
 * made when they are first read. */
export interface Events {{
    readonly began: IdPair[];
    readonly stayed: IdPair[];
    readonly ended: IdPair[];
    /** Of each pair that began: its time of impact as a fraction of the motion. */
    readonly fractions: Float32Array;
    readonly columns: {{ began: Uint32Array; stayed: Uint32Array; ended: Uint32Array }};
}}
"""


def is_present(name):
    """Whether a struct or a handle is of the entry."""
    return api.dimension_of(name) in (0, *DIMENSIONS)


def plain_type(name):
    if name in VECTOR_NAMES:
        return VECTOR_NAMES[name]
    if name in api.structs:
        return class_name(name)
    if name in api.callbacks:
        return "(...ids: Id[]) => boolean"
    return {"bool": "boolean", "abut_flag": "boolean", "uint64_t": "bigint", "void": "unknown"}.get(name, "number")


def member_type(name):
    """Of a member of a struct: where it is read, a vector is a tuple."""
    return TUPLES.get(name) or plain_type(name)


def type_in(a):
    if a["array"]:
        if a["pointers"] == 2:
            return f"ReadonlyArray<AnyShape{a['type'][-1]}>"
        if a["type"] not in api.structs:
            return "ArrayLike<number>" if group(a) == 1 else "Numbers"
        if a["type"] in VECTORS:
            return "Numbers"
        element = f"Partial<{class_name(a['type'])}>" if "options" in a["type"] else class_name(a["type"])
        return f"ReadonlyArray<{element}>" + ("" if api.structs[a["type"]].view is None else " | ArrayLike<number>")
    if a["type"] in api.handles:
        return f"AnyShape{a['type'][-1]}" if is_shape(a["type"]) else class_name(a["type"])
    if a["pointers"] == 1 and a["type"] in api.structs:
        return f"Partial<{class_name(a['type'])}>"
    return "number | bigint" if a["type"] == "uint64_t" else plain_type(a["type"])


def columns_type(name):
    """The typed arrays of an array of C."""
    if name in NUMBERS:
        return TYPED_ARRAYS[NUMBERS[name][1]]
    struct = api.structs[name]
    if struct.is_plain():
        return TYPED_ARRAYS[NUMBERS[struct.members[0].type][1]]
    parts = [f"{m.name}: {columns_type(m.type)}{'[]' if m.length else ''}" for m in struct.members]
    return "{ " + "; ".join(parts) + " }"


def type_out(a, short, as_columns):
    if short in POLYTOPES:
        return f"Polytope{a['type'][-1]}" + (" | null" if short == "intersection" else "")
    if a["type"] == "abut_buffer":
        return "Uint8Array"
    if a["pointers"] == 2:
        return class_name(a["type"])
    if a["type"] == "abut_events":
        return "Events"
    if a["array"]:
        is_list = counter(a) == "capacity" and not as_columns
        if is_list and a["type"] in api.structs and not (api.structs[a["type"]].view == "f32" and api.structs[a["type"]].is_plain()):
            return f"{class_name(a['type'])}[]"
        return columns_type(a["type"])
    if a["type"] in TUPLES:
        return TUPLES[a["type"]]
    is_answer_or_null = a["type"] in api.structs and api.structs[a["type"]].is_answer_or_null()
    return plain_type(a["type"]) + (" | null" if is_answer_or_null else "")


def has_objects(f):
    return any(a["array"] and counter(a) == "capacity" and type_out(a, "", False).endswith("[]") for a in f.outputs)


def signature(f, name, short, skip=0, is_free=False, as_columns=False):
    inputs = list(f.inputs)
    if is_free and short in OF_RAYS:
        inputs[:2] = inputs[1::-1]
    parts = []
    for i, a in enumerate(inputs[skip:], skip):
        last_needed = max([k for k, b in enumerate(inputs) if not is_optional(b)], default=-1)
        optional = "?" if is_optional(a) and i > last_needed else ""
        kind = type_in(a)
        if short == "closest" and a["name"] in ("b", "shape") and "shape" in a["type"]:
            kind += f" | Vec{a['type'][-1]}"
        if is_free and short == "sweep" and a["name"] == "motion_b":
            optional = "?"
        parts.append(f"{'k' if a['name'] == 'capacity' else a['name']}{optional}: {kind}")
    results = [(a["name"], type_out(a, short, as_columns)) for a in f.outputs]
    result = "void" if not results else results[0][1] if len(results) == 1 else (
        "{ " + "; ".join(f"{n}: {t}" for n, t in results) + " }")
    return f"{name}({', '.join(parts)}): {result};"


def is_optional(a):
    return a["optional"] or a["name"] in DEFAULTS


def with_columns(f, name, short, skip=0, is_free=False):
    """A function with its comment, and where it gives objects, the one that gives typed arrays."""
    lines = [doc(f.doc, "    "), "    " + signature(f, name, short, skip, is_free)]
    if has_objects(f):
        lines += [doc(f"As {name}, in typed arrays.", "    "), "    " + signature(f, f"{name}_columns", short, skip, is_free, True)]
    return lines


def doc(text, indent=""):
    return f"{indent}/** {text} */"


def interface(struct):
    lines = [doc(struct.doc), f"export interface {class_name(struct.name)} {{"]
    for m in struct.members:
        if m.name in ("found", "count", "ignore_count", "area_cost_count", "context"):
            continue
        kind = member_type(m.type) if struct.name in ANSWERS else plain_type(m.type)
        if m.type == "uint64_t":
            kind = "number | bigint" if struct.name not in ANSWERS else "bigint"
        if m.is_pointer and m.type not in api.callbacks:
            kind = "ReadonlyArray<Id>" if m.type == "abut_id" else "ArrayLike<number>"
        optional = "?" if m.name == "rotation" and struct.name not in ANSWERS or m.is_pointer else ""
        if m.doc:
            lines.append(doc(m.doc, "    "))
        lines.append(f"    {m.name}{optional}: {kind}{'[]' if m.length else ''};")
    return lines + ["}", ""]


ANSWERS = api.answers() - {"abut_pose2", "abut_pose3", "abut_ray2", "abut_ray3", "abut_motion2", "abut_motion3",
                           "abut_item_options2", "abut_item_options3", "abut_walk_point", "abut_aabb2", "abut_aabb3"}


class Parts:
    """The declarations, sorted by where they stand."""

    def __init__(self):
        self.classes = {name: [] for name in api.handles if is_present(name)}
        self.plain = {d: [] for d in DIMENSIONS}
        self.factories, self.free, self.structs = [], [], {}
        for f in api.functions.values():
            if api.dimension(f) in (0, *DIMENSIONS):
                self._add(f)

    def _add(self, f):
        owner = longest(f.name, api.handles)
        if owner is None:
            struct = longest(f.name, api.structs)
            if struct:
                self.structs.setdefault(struct, []).append(signature(f, f.name[len(struct) + 1:], ""))
            elif f.name not in ("abut_decompose_mesh", "abut_decompose_outline"):
                self.free += with_columns(f, f.name[5:], "")
            return
        short = f.name[len(owner) + 1:]
        first = f.arguments[0]
        if first["type"] == owner and first["pointers"] == 1:
            if short not in ADAPTORS or not is_shape(owner):
                self.classes[owner] += with_columns(f, short, short, 1)
            if is_shape(owner) and short not in ADAPTORS:
                self.free += with_columns(f, short, short, 0, True)
        elif is_constructor(f, owner):
            self.classes[owner] += [doc(f.doc, "    "), "    " + signature(f, "constructor", short).rsplit("): ", 1)[0] + ");"]
        elif is_shape(owner):
            self._add_shape(f, int(owner[-1]))
        else:
            text = signature(f, short, short)
            if short == "bake_outline":
                text = "bake_outline(outline: Numbers, holes?: ReadonlyArray<Numbers>, options?: Partial<FieldOptions>): Field2;"
            self.classes[owner] += [doc(f.doc, "    "), "    static " + text]

    def _add_shape(self, f, dimension):
        name, first = api.shape_name(f, dimension), f.arguments[0]
        if not (first["type"] in api.structs and first["pointers"] == 0 and len(f.arguments) == 2):
            self.factories += [doc(f.doc, "    "), "    " + signature(f, name, "")]
            return
        members = api.structs[first["type"]].members
        result = f"{{ type: '{first['type'][5:]}' }} & {class_name(first['type'])}"
        self.plain[dimension].append(f"({result})")
        parts = ", ".join(f"{m.name}{'?' if m.name == 'rotation' else ''}: {plain_type(m.type)}" for m in members)
        for one in [name] + ({2: ["Circle"], 3: ["Sphere"]}[dimension] if name.startswith("Ball") else []):
            self.factories.append(f"    {one}({parts}): {result};")


def any_shape(dimension, plain):
    hull = next(name for name, of in HULLS.items() if of == dimension)
    return [f"/** A shape: plain, or a handle. */\nexport type AnyShape{dimension} =\n    | Shape{dimension}",
            *[f"    | {one}" for one in plain],
            f"    | {{ type: '{hull}'; points: Numbers }}",
            f"    | {{ type: 'at'; shape: AnyShape{dimension}; pose: Pose{dimension} }}",
            f"    | {{ type: 'rounded'; shape: AnyShape{dimension}; radius: number }}",
            f"    | {{ type: 'stretched'; shape: AnyShape{dimension}; scale: Vec{dimension} }};", ""]


def any_polytope(dimension):
    hull = next(name for name, of in HULLS.items() if of == dimension)
    triangles = "; triangles: Uint32Array" if dimension == 3 else ""
    return [f"/** A {hull} as a plain shape, with its measures. */",
            f"export type Polytope{dimension} = {{ type: '{hull}'; points: Float32Array{triangles} }} & Measures{dimension};", ""]


def of_dimension(dimension):
    """What src/api.js adds."""
    lines = [f"    at(shape: AnyShape{dimension}, pose: Pose{dimension}): AnyShape{dimension};",
             f"    rounded(shape: AnyShape{dimension}, radius: number): AnyShape{dimension};",
             f"    stretched(shape: AnyShape{dimension}, scale: Vec{dimension}): AnyShape{dimension};",
             f"    /** A handle of a plain shape, for many questions. */\n    build(shape: AnyShape{dimension}): Shape{dimension};",
             f"    reflect(ray: Ray{dimension}, hit: Hit{dimension}): Ray{dimension};"]
    if dimension == 3:
        return lines + ["    decompose_mesh(mesh: Shape3, options?: Partial<DecomposeOptions>): Polytope3[];"]
    return lines + ["    decompose_outline(outline: Numbers, holes?: ReadonlyArray<Numbers>, concavity?: number): Polytope2[];"]


def main():
    parts = Parts()
    where = {2: "2D", 3: "3D"}.get(DIMENSIONS[0] if len(DIMENSIONS) == 1 else 0, "2D and 3D")
    lines = [HEADER.format(where=where)]
    for s in api.structs.values():
        if s.name not in VECTORS and s.name != "abut_events" and is_present(s.name):
            lines += interface(s)
    for dimension in DIMENSIONS:
        lines += any_polytope(dimension)
    lines += [f"export type Polytope = {' | '.join(f'Polytope{d}' for d in DIMENSIONS)};", ""]
    for dimension in DIMENSIONS:
        lines += any_shape(dimension, parts.plain[dimension])
    for name, methods in parts.classes.items():
        own = [f"    {adaptor}({member}: {type_in(api.functions[f'{name}_{adaptor}'].arguments[1])}): {class_name(name)};"
               for adaptor, member in ADAPTORS.items() if is_shape(name)]
        lines += [doc(api.handles[name]), f"export class {class_name(name)} extends Handle {{", *methods, *own, "}", ""]
    lines += ["export interface Abut {", "    readonly version: string;", "    AbutError: typeof AbutError;"]
    lines += [f"    {class_name(name)}: typeof {class_name(name)};" for name in parts.classes]
    lines += [f"    {class_name(s)}: {{ {' '.join(functions)} }};" for s, functions in parts.structs.items()]
    lines += parts.factories + parts.free
    for dimension in DIMENSIONS:
        lines += of_dimension(dimension)
    lines += ["}", "", "/** Loads the library. By default the module is that of the package. */",
              "export function load(source?: string | URL | Response | BufferSource | WebAssembly.Module): Promise<Abut>;"]
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


main()
