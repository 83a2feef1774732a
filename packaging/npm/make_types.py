"""Writes the types of the package from abut_api.json: make_types.py API_JSON OUT.

The rules are those of src/index.js.
"""

import json
import re
import sys

api = json.load(open(sys.argv[1], encoding="utf-8"))
HANDLES = [h["name"] for h in api["handles"] if h["name"] != "abut_buffer"]
STRUCTS = {s["name"]: s for s in api["structs"]}
CALLBACKS = {c["name"] for c in api["callbacks"]}
FUNCTIONS = {f["name"]: f for f in api["functions"]}
VECTORS = {"abut_vec2": "[number, number]", "abut_vec3": "[number, number, number]", "abut_turn": "[number, number]",
           "abut_quat": "[number, number, number, number]"}
VECTOR_NAMES = {"abut_vec2": "Vec2", "abut_vec3": "Vec3", "abut_turn": "Turn", "abut_quat": "Quat"}
STRIDES = {"stride", "id_stride", "pose_stride", "place_stride", "step_stride"}
WITH_DEFAULT = {"max_vertices", "closed", "one_sided", "holes", "concavity", "workers", "softness"}
OF_RAYS = {"raycast", "raycast_any", "raycast_all"}
POLYTOPES = {"polytope", "intersection", "minkowski_sum", "minkowski_difference"}
TYPED = {"float": "Float32Array", "double": "Float64Array", "uint32_t": "Uint32Array", "uint8_t": "Uint8Array",
         "bool": "Uint8Array"}

HEADER = """// Collision detection in 2D and 3D. Made of abut_api.json; names are those of C++, with the dimension at the end of types.

export type Vec2 = ArrayLike<number> & { readonly length: number };
export type Vec3 = Vec2;
/** [cos, sin] */
export type Turn = Vec2;
/** [x, y, z, w] */
export type Quat = Vec2;
/** Numbers of all elements one after the other, or an array of elements. */
export type Numbers = ArrayLike<number> | ReadonlyArray<Vec2>;
/** Arrays by the members of the elements; vectors as numbers one after the other. */
export type Columns<T> = { [K in keyof T]: any };

/** What the library reports about wrong arguments. `code` is such as 'NOT_FINITE', `index` that of the element. */
export class AbutError extends Error {
    code: string;
    index: number;
}

/** What the library owns. `dispose` frees it; else it is freed some time after the last use. */
export class Handle {
    dispose(): void;
}
"""


def class_name(name):
    return "".join(part[0].upper() + part[1:] for part in name[5:].split("_"))


def longest(name, owners):
    fitting = [owner for owner in owners if name.startswith(owner + "_")]
    return max(fitting, key=len) if fitting else None


def plain_type(name):
    if name in VECTOR_NAMES:
        return VECTOR_NAMES[name]
    if name in STRUCTS:
        return class_name(name)
    if name in CALLBACKS:
        return "(...ids: Id[]) => boolean"
    return {"bool": "boolean", "abut_flag": "boolean", "uint64_t": "bigint", "void": "unknown"}.get(name, "number")


def is_shape(name):
    return name in ("abut_shape2", "abut_shape3")


def type_in(a):
    if a["array"]:
        if a["pointers"] == 2:
            return f"ReadonlyArray<AnyShape{a['type'][-1]}>"
        return f"Numbers | ReadonlyArray<{class_name(a['type'])}>" if a["type"] in STRUCTS else "ArrayLike<number>"
    if a["type"] in HANDLES:
        return f"AnyShape{a['type'][-1]}" if is_shape(a["type"]) else class_name(a["type"])
    if a["pointers"] == 1 and a["type"] in STRUCTS:
        return f"Partial<{class_name(a['type'])}>"
    if a["type"] in STRUCTS and a["type"] not in VECTORS:
        return class_name(a["type"])
    return "number | bigint" if a["type"] == "uint64_t" else plain_type(a["type"])


def type_out(a, short):
    if short in POLYTOPES:
        return "Polytope" + (" | null" if short == "intersection" else "")
    if a["type"] == "abut_buffer":
        return "Uint8Array"
    if a["pointers"] == 2:
        return class_name(a["type"])
    if a["type"] == "abut_events":
        return "{ began: IdPair[]; stayed: IdPair[]; ended: IdPair[]; fractions: Float32Array }"
    if a["array"]:
        if a["type"] in VECTORS:
            return "Float32Array"
        if a["type"] not in STRUCTS:
            return TYPED[a["type"]]
        return f"{class_name(a['type'])}[]" if a["array"].endswith("capacity") else f"Columns<{class_name(a['type'])}>"
    name = plain_type(a["type"])
    if a["type"] in VECTORS:
        return VECTORS[a["type"]]
    members = {m["name"] for m in STRUCTS[a["type"]]["members"]} if a["type"] in STRUCTS else set()
    none = members & {"found", "hit"} or {"id", "closest"} <= members or {"points", "count"} <= members
    return name + (" | null" if none else "")


def parameters_of(f):
    lengths = set()
    for a in f["arguments"]:
        match = re.fullmatch(r"(?:\d \* )?(\w+)", a["array"] or "")
        if match and a["direction"] == "in":
            lengths.add(match[1])
    has_list = any(a["name"] == "capacity" for a in f["arguments"])
    takes_k = f["name"].endswith("_k_nearest")

    def is_length(a):
        return has_list and a["direction"] == "out" and a["name"] in ("count", "id_count") and not a["array"]

    def is_output(a):
        return a["direction"] == "out" or (a["type"] == "abut_buffer" and a["name"] == "out")

    def is_automatic(a):
        return (a["name"] in lengths or a["name"] in STRIDES or a["name"] == "context" or is_output(a) or
                (a["name"] == "capacity" and not takes_k))

    inputs = [a for a in f["arguments"] if not is_automatic(a)]
    inputs.sort(key=lambda a: a["optional"] or a["name"] in WITH_DEFAULT)
    return inputs, [a for a in f["arguments"] if is_output(a) and not is_length(a)]


def signature(f, name, short, skip=0, types=None):
    inputs, outputs = parameters_of(f)
    if types == "free" and short in OF_RAYS:
        inputs = [inputs[1], inputs[0], *inputs[2:]]
    parts = []
    for a in inputs[skip:]:
        optional = "?" if a["optional"] or a["name"] in WITH_DEFAULT else ""
        kind = type_in(a)
        if short == "closest" and a["name"] in ("b", "shape"):
            kind += f" | Vec{f['name'][10]}"
        parts.append(f"{'k' if a['name'] == 'capacity' else a['name']}{optional}: {kind}")
    results = [(a["name"], type_out(a, short)) for a in outputs]
    result = "void" if not results else results[0][1] if len(results) == 1 else (
        "{ " + "; ".join(f"{n}: {t}" for n, t in results) + " }")
    return f"{name}({', '.join(parts)}): {result};"


def doc(text, indent=""):
    return f"{indent}/** {text} */"


def main():
    lines = [HEADER]
    for s in api["structs"]:
        if s["name"] in VECTORS or s["name"] == "abut_events":
            continue
        lines += [doc(s["doc"]), f"export interface {class_name(s['name'])} {{"]
        for m in s["members"]:
            if m["name"] in ("found", "count", "ignore_count", "area_cost_count", "context"):
                continue
            kind = plain_type(m["type"])
            if m["pointers"]:
                kind = "ReadonlyArray<Id>" if m["type"] == "abut_id" else "ArrayLike<number>"
            optional = "?" if m["name"] == "rotation" or m["type"] in CALLBACKS or m["pointers"] else ""
            if m["doc"]:
                lines.append(doc(m["doc"], "    "))
            lines.append(f"    {m['name']}{optional}: {kind}{'[]' if m['array'] else ''};")
        lines += ["}", ""]
    plain = {"2": [], "3": []}
    factories, classes, free, structs = [], {h: [] for h in HANDLES}, [], {}
    for f in api["functions"]:
        name = f["name"]
        if re.search(r"^abut_(buffer|last)|_(release|default|version)$", name):
            continue
        owner = longest(name, HANDLES)
        first = f["arguments"][0]
        if owner is None:
            struct = longest(name, STRUCTS)
            if struct:
                structs.setdefault(struct, []).append(signature(f, name[len(struct) + 1:], ""))
            elif name in ("abut_decompose_mesh", "abut_decompose_outline"):
                continue
            else:
                free += [doc(f["doc"], "    "), "    " + signature(f, name[5:], "")]
            continue
        short = name[len(owner) + 1:]
        if first["type"] == owner and first["pointers"] == 1:
            classes[owner] += [doc(f["doc"], "    "), "    " + signature(f, short, short, 1)]
            if is_shape(owner) and short not in ("at", "rounded", "stretched"):
                free += [doc(f["doc"], "    "), "    " + signature(f, short, short, 0, "free")]
        elif short in ("create", "build"):
            text = signature(f, "constructor", short).rsplit("): ", 1)[0] + ");"
            classes[owner] += [doc(f["doc"], "    "), "    " + text]
        elif is_shape(owner):
            other = name.replace(owner, "abut_shape" + ("3" if owner[-1] == "2" else "2"))
            class_of = class_name("abut_" + short) + (owner[-1] if other in FUNCTIONS else "")
            if first["type"] in STRUCTS and first["pointers"] == 0 and len(f["arguments"]) == 2:
                kind = first["type"][5:]
                members = STRUCTS[first["type"]]["members"]
                plain[owner[-1]].append(f"({{ type: '{kind}' }} & {class_name(first['type'])})")
                parts = [f"{m['name']}{'?' if m['name'] == 'rotation' else ''}: {plain_type(m['type'])}" for m in members]
                factories.append(f"    {class_of}({', '.join(parts)}): {{ type: '{kind}' }} & {class_name(first['type'])};")
                if short == "ball":
                    alias = "Circle" if owner[-1] == "2" else "Sphere"
                    factories.append(f"    {alias}({', '.join(parts)}): {{ type: '{kind}' }} & {class_name(first['type'])};")
            else:
                factories += [doc(f["doc"], "    "), "    " + signature(f, class_of, short)]
        else:
            text = signature(f, short, short)
            if short == "bake_outline":
                text = "bake_outline(outline: Numbers, holes?: ReadonlyArray<Numbers>, options?: Partial<FieldOptions>): Field2;"
            classes[owner] += [doc(f["doc"], "    "), "    static " + text]
    lines += [
        "/** A polygon or polyhedron as a plain shape, with its measures. */",
        "export type Polytope = { type: 'polygon' | 'polyhedron'; points: Float32Array; triangles?: Uint32Array; rank: number;"
        " area: number; volume: number; centroid: number[]; normal: number[] };", ""]
    for dimension in "23":
        hull = "polygon" if dimension == "2" else "polyhedron"
        lines += [
            f"/** A shape: plain, or a handle. */\nexport type AnyShape{dimension} =\n    | Shape{dimension}",
            *[f"    | {one}" for one in plain[dimension]],
            f"    | {{ type: '{hull}'; points: Numbers }}",
            f"    | {{ type: 'at'; shape: AnyShape{dimension}; pose: Pose{dimension} }}",
            f"    | {{ type: 'rounded'; shape: AnyShape{dimension}; radius: number }}",
            f"    | {{ type: 'stretched'; shape: AnyShape{dimension}; scale: Vec{dimension} }};", ""]
    for h in api["handles"]:
        if h["name"] in classes:
            lines += [doc(h["doc"]), f"export class {class_name(h['name'])} extends Handle {{", *classes[h["name"]], "}", ""]
    lines += ["export interface Abut {", "    readonly version: string;", "    AbutError: typeof AbutError;"]
    lines += [f"    {class_name(h)}: typeof {class_name(h)};" for h in HANDLES]
    lines += [f"    {class_name(s)}: {{ {' '.join(functions)} }};" for s, functions in structs.items()]
    lines += factories + free
    for dimension in "23":
        lines += [f"    at(shape: AnyShape{dimension}, pose: Pose{dimension}): AnyShape{dimension};",
                  f"    rounded(shape: AnyShape{dimension}, radius: number): AnyShape{dimension};",
                  f"    stretched(shape: AnyShape{dimension}, scale: Vec{dimension}): AnyShape{dimension};",
                  f"    /** A handle of a plain shape, for many questions. */\n    build(shape: AnyShape{dimension}): Shape{dimension};",
                  f"    reflect(ray: Ray{dimension}, hit: Hit{dimension}): Ray{dimension};"]
    lines += [
        "    decompose_mesh(mesh: Shape3, options?: Partial<DecomposeOptions>): Polytope[];",
        "    decompose_outline(outline: Numbers, holes?: ReadonlyArray<Numbers>, concavity?: number): Polytope[];", "}", "",
        "/** Loads the library. By default abut.wasm and abut_api.json are those of the package. */",
        "export function load(source?: string | URL | Response | BufferSource | WebAssembly.Module, api?: object): Promise<Abut>;"]
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


main()
