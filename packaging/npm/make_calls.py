"""Writes the calls of the C API as JavaScript: make_calls.py API_JSON FOLDER makes calls_common.js, calls_plane.js and calls_space.js.

Each function of the C API becomes straight code with the offsets of its arguments in numbers: a description that is read at each call
costs ten times as much. src/api.js puts the parts together.
"""

import sys

from call_code import *

folder = sys.argv[2]
# Of the part that is being made: 0 is what both have.
dimension = 0


def own_functions():
    return [f for f in api.functions.values() if api.dimension(f) == dimension]


def emit_class(code, c_name):
    """A handle's class with its methods."""
    name = class_name(c_name)
    functions = [f for f in own_functions() if longest(f.name, api.handles) == c_name]
    code.add(f"class {name} extends Handle {{")
    makers = [f for f in functions if is_constructor(f, c_name)]
    for f in makers:
        emit_constructor(code, f)
    code.add("dispose() {")
    code.add(f"library.dispose(this, e.{c_name}_release);")
    code.add("}")
    for f in functions:
        short = f.name[len(c_name) + 1:]
        first = f.arguments[0]
        if f in makers:
            continue
        if first["type"] == c_name and first["pointers"] == 1:
            emit_with_columns(code, f, "", short, "this", 1)
        else:
            emit_function(code, f, f"static {short}")
    code.add("}")
    code.add(f"{name}.prototype.release_pointer = e.{c_name}_release;")


def emit_constructor(code, f):
    code.add(f"constructor({', '.join(parameter(a, f) for a in f.inputs)}) {{")
    code.add("super();")
    output = f.outputs[0]
    body = Code()
    body.depth = code.depth
    emit_call(body, f)
    made = f"return library.owning({class_name(output['type'])}, "
    for line in body.lines:
        text = line.strip()
        # The new object itself becomes the owner.
        code.lines.append(line.replace(made, "library.own(this, ").replace(made, "") if text.startswith(made) else line)
    code.add("}")


def emit_shape_class(code):
    """Shape2 or Shape3: its methods are the questions of a plain shape as well."""
    c_name = f"abut_shape{dimension}"
    names, makers = [], []
    for f in own_functions():
        if longest(f.name, api.handles) != c_name:
            continue
        short = f.name[len(c_name) + 1:]
        first = f.arguments[0]
        if first["type"] == c_name and first["pointers"] == 1 and short not in ADAPTORS:
            if short in POLYTOPES:
                emit_function(code, f, f"function made_{short}")
                arguments = ", ".join(parameter(a, f) for a in f.inputs)
                code.add(f"function shape_{short}({arguments}) {{")
                code.add(f"return plain(made_{short}({', '.join(js_name(a) for a in f.inputs)}));")
                code.add("}")
                names.append(short)
            else:
                names += emit_with_columns(code, f, "function shape_", short, None, 0)
        elif not (len(f.arguments) == 2 and first["pointers"] == 0 and first["type"] in api.structs) and short not in ADAPTORS:
            makers.append((api.shape_name(f, dimension), short))
            emit_function(code, f, f"function make_{short}")
    code.add(f"class Shape{dimension} extends Handle {{")
    code.add("dispose() {")
    code.add(f"library.dispose(this, e.{c_name}_release);")
    code.add("}")
    for name in names:
        code.add(f"{name}(a, b, c, d) {{")
        code.add(f"return shape_{name}(this, a, b, c, d);")
        code.add("}")
    for adaptor, member in ADAPTORS.items():
        code.add(f"{adaptor}({member}) {{")
        code.add(f"return build({{ type: {adaptor!r}, shape: this, {member} }});")
        code.add("}")
    code.add("static plain(handle) {")
    code.add("return plain(handle);")
    code.add("}")
    code.add("}")
    code.add(f"Shape{dimension}.prototype.release_pointer = e.{c_name}_release;")
    return names, makers


def emit_plain_shapes(code):
    """The handle of any shape: `make` writes the pointer of a new one of a plain shape."""
    d = dimension
    c_name = f"abut_shape{d}"
    kinds = list(api.plain_kinds(d))
    hull = next(name for name, of in HULLS.items() if of == d)
    code.add("// The pointer of a new handle of a plain shape; `at` has space for its numbers.")
    code.add("function make(value, at) {")
    code.add(f"const out = at + {SHAPE_SCRATCH - 8};")
    code.add("switch (value?.type) {")
    for f, struct in kinds:
        code.add(f"case {struct.name[5:]!r}:")
        code.add(f"    {use('write', struct.name)}(at, value);")
        code.add(f"    check(e.{f.name}(at, out));")
        code.add("    break;")
    for adaptor, member in ADAPTORS.items():
        a = api.functions[f"{c_name}_{adaptor}"].arguments[1]
        code.add(f"case {adaptor!r}: {{")
        code.add(f"const inner = shape{d}(value.shape, at);")
        if a["type"] in api.structs:
            code.add(f"{use('write', a['type'])}(at, value.{member});")
            code.add(f"check(e.{c_name}_{adaptor}(inner, at, out));")
        else:
            code.add(f"check(e.{c_name}_{adaptor}(inner, number(value.{member}, {member!r}), out));")
        code.add("break;")
        code.add("}")
    code.add(f"case {hull!r}: {{")
    code.add(f"const points = {array_of(f'abut_vec{d}', 'value.points', 'points', 1)};")
    code.add(f"check(e.{c_name}_{hull}(points, 0, m.rows, 0, out));")
    code.add("break;")
    code.add("}")
    code.add("default:")
    code.add(f"    throw library.wrong_shape({d}, value);")
    code.add("}")
    code.add("return m.u32[out >> 2];")
    code.add("}")
    code.add("// The pointer of a shape: that of a handle, or of a temporary one of a plain shape, which ends with the call.")
    code.add(f"function shape{d}(value, at) {{")
    code.add(f"if (value instanceof Shape{d}) return pointer_of(value);")
    code.add(f"return m.release_later(make(value, at), e.{c_name}_release);")
    code.add("}")
    code.add(f"function shapes{d}(values) {{")
    code.add(f"const pointers = Array.from(values, (value) => shape{d}(value, m.take({SHAPE_SCRATCH})));")
    code.add("return m.array(pointers, 'u32', 1, 4, null, 'shapes');")
    code.add("}")
    code.add("function build(value) {")
    code.add(f"if (value instanceof Shape{d}) return value;")
    code.add(f"const at = m.enter({SHAPE_SCRATCH});")
    code.add("try {")
    code.add(f"return library.owning(Shape{d}, make(value, at));")
    code.add("} finally {")
    code.add("m.leave(at);")
    code.add("}")
    code.add("}")
    code.add("// A polygon or polyhedron as a plain shape, with its measures; frees the handle.")
    code.add("function plain(handle) {")
    code.add("if (handle === null) return null;")
    faces = "triangles: shape_triangles(handle), " if d == 3 else ""
    code.add(f"const shape = {{ type: {hull!r}, points: shape_points(handle), {faces}...shape_measures(handle) }};")
    code.add("handle.dispose();")
    code.add("return shape;")
    code.add("}")
    return kinds, hull


def emit_plain_factories(code, kinds):
    for f, struct in kinds:
        name = api.shape_name(f, dimension)
        required = [m.name for m in struct.members if m.type not in IDENTITIES]
        optional = [m.name for m in struct.members if m.type in IDENTITIES]
        head = f"type: {struct.name[5:]!r}, {', '.join(required)}"
        code.add(f"function {name}({', '.join(required + optional)}) {{")
        for option in optional:
            code.add(f"if ({option} !== undefined) return {{ {head}, {option} }};")
        code.add(f"return {{ {head} }};")
        code.add("}")


def emit_events(code):
    code.add("// The lists of an update, which are the library's until the next one.")
    code.add("function events(at) {")
    events = {m.name: m.offset for m in api.structs["abut_events"].members}
    for name in ("began", "stayed", "ended"):
        code.add(f"const {name} = m.copy_u32(m.u32[(at + {events[name]}) >> 2], 4 * m.u32[(at + {events[name + '_count']}) >> 2]);")
    code.add(f"const fractions = m.copy_f32(m.u32[(at + {events['fractions']}) >> 2], m.u32[(at + {events['began_count']}) >> 2]);")
    code.add("return new Events(began, stayed, ended, fractions);")
    code.add("}")


def emit_statics(code, struct_names):
    """Functions of structs: Ray3.between(a, b)."""
    made = {}
    for f in own_functions():
        if longest(f.name, api.handles):
            continue
        struct = longest(f.name, api.structs)
        if struct:
            short = f.name[len(struct) + 1:]
            made.setdefault(class_name(struct), []).append(short)
            emit_function(code, f, f"function {struct[5:]}_{short}")
            struct_names[class_name(struct)] = struct[5:]
    return made


IMPORTS = {"handle": ["Events", "Handle"],
           "arguments": ["check_members", "number", "object_needed", "vector_needed", "wrong_length"]}
NAMES = {0: ("common", "of both dimensions"), 2: ("plane", "in the plane"), 3: ("space", "in space")}


def members(pairs):
    """An object of JavaScript, of names and values."""
    return "{ " + ", ".join(name if name == value else f"{name}: {value}" for name, value in pairs) + " }"


def make_part():
    """The text of a module that exports one function, which makes the part of a loaded library."""
    used.clear()
    code = Code()
    queries, makers, kinds, hull = [], [], [], None
    handles = [h for h in api.handles if api.dimension_of(h) == dimension]
    if dimension:
        emit_events(code)
        queries, makers = emit_shape_class(code)
        kinds, hull = emit_plain_shapes(code)
        emit_plain_factories(code, kinds)
    for c_name in handles:
        if not is_shape(c_name):
            emit_class(code, c_name)
    struct_names = {}
    statics = emit_statics(code, struct_names)
    free = []
    for f in own_functions():
        if not longest(f.name, api.handles) and not longest(f.name, api.structs):
            free += emit_with_columns(code, f, "function ", f.name[5:], None, 0)

    helpers = Code()
    done = set()
    # Emitting one may use others.
    while len(done) < len(used):
        for kind, name in [key for key in used if key not in done]:
            done.add((kind, name))
            {"read": emit_read, "write": emit_write, "options": emit_options, "columns": emit_columns,
             "MEMBERS": emit_members}[kind](helpers, name)

    name, what = NAMES[dimension]
    body = "\n".join(helpers.lines + code.lines)
    text = [f"// The calls of the C API {what}. Made by make_calls.py of abut_api.json."]
    for module, functions in IMPORTS.items():
        wanted = [one for one in functions if f"{one}(" in body or f"extends {one} " in body]
        if wanted:
            text.append(f"import {{ {', '.join(wanted)} }} from './{module}.js';")
    if dimension == 0:
        codes = next(e for e in api.json["enums"] if e["name"] == "abut_code")["values"]
        text += ["", f"export const CODES = [{', '.join(repr(v['name'][5:]) for v in codes)}];"]
    text += ["", f"export function {name}(library) {{", "    const { exports: e, memory: m } = library;",
             "    const check = (code) => library.check(code);"]
    if "pointer_of(" in body:
        text.append("    const pointer_of = (handle) => library.pointer_of(handle);")
    if "capacities." in body:
        text += ["    // How long lists were.", "    const capacities = {};"]
    text.append(body)
    text += ["    return {"]
    text += [f"        classes: {{ {', '.join(map(class_name, handles))} }},"]
    of_structs = [f"{cls}: {members((short, f'{struct_names[cls]}_{short}') for short in shorts)}" for cls, shorts in statics.items()]
    text += [f"        statics: {{ {', '.join(of_structs)} }},", f"        free: {{ {', '.join(free)} }},"]
    if dimension:
        names = [api.shape_name(f, dimension) for f, _ in kinds]
        shapes = members([(n, n) for n in names] + [(n, f"make_{short}") for n, short in makers])
        text += [f"        dimension: {dimension},",
                 f"        kinds: [{', '.join(repr(s.name[5:]) for _, s in kinds)}, {hull!r}],",
                 f"        shapes: {shapes},",
                 f"        queries: {members((n, f'shape_{n}') for n in queries)},",
                 "        build,"]
    text += ["    };", "}", ""]
    return "\n".join(text)


def main():
    global dimension
    for dimension, (name, _) in NAMES.items():
        with open(f"{folder}/calls_{name}.js", "w", encoding="utf-8") as file:
            file.write(make_part())


main()
