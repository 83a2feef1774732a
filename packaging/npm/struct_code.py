"""The JavaScript that reads and writes structs and arrays in the memory of the module, for make_calls.py."""

import sys

from c_api import *

api = Api(sys.argv[1])
all_names = {f["name"] for f in api.json["functions"]}


class Code:
    """Lines with their indentation, and which functions for structs they use."""

    def __init__(self):
        self.lines = []
        self.depth = 1

    def add(self, text):
        if text.startswith("}"):
            self.depth -= 1
        self.lines.append("    " * self.depth + text if text else "")
        if text.endswith(("{", "[")):
            self.depth += 1


# What is used, in the order of use: (kind, struct name).
used = {}


def use(kind, name):
    used.setdefault((kind, name))
    return f"{kind}_{name[5:]}"


# --- structs --------------------------------------------------------------------------------------------------------------


def at(offset):
    return f"at + {offset}" if offset else "at"


def number_at(type_name, offset, base="at"):
    """The expression of a number in memory: by bytes, or by words where a local `i` counts those."""
    size, view = NUMBERS[type_name]
    if base == "i" and size == 4:
        place = f"m.{view}[i + {offset // 4}]" if offset else f"m.{view}[i]"
    else:
        byte = f"at + {offset}" if offset else "at"
        place = f"m.{view}[{byte}]" if size == 1 else f"m.{view}[({byte}) >> {size.bit_length() - 1}]"
    if type_name in ("bool", "abut_flag"):
        return f"{place} !== 0"
    return place


def is_statement(type_name):
    """Whether a struct is read by a function of its own."""
    return type_name in api.structs and api.structs[type_name].is_answer_or_null()


def value_at(type_name, offset):
    """The expression of a value at `at + offset`, with `i` as the index of its first word."""
    if type_name in NUMBERS:
        return number_at(type_name, offset, "i")
    struct = api.structs[type_name]
    if is_statement(type_name):
        return f"{use('read', type_name)}({at(offset)})"
    if type_name in VECTORS:
        return "[" + ", ".join(number_at(m.type, offset + m.offset, "i") for m in struct.members) + "]"
    return "{ " + ", ".join(f"{m.name}: {value_at(m.type, offset + m.offset)}" for m in struct.members) + " }"


def emit_read(code, name):
    struct = api.structs[name]
    code.add(f"function read_{name[5:]}(at) {{")
    code.add("const i = at >> 2;")
    names = struct.names()
    by_name = {m.name: m for m in struct.members}
    fields = []
    for m in struct.members:
        if m.name == "found":
            code.add(f"if (m.u32[i + {m.offset // 4}] === 0) return null;")
        elif m.name == "count" and "points" in names:
            code.add(f"const count = {number_at(m.type, m.offset, 'i')};")
            code.add("if (count === 0) return null;")
        elif m.length:
            size = api.size(m.type)
            code.add(f"const {m.name} = new Array(count);")
            code.add(f"for (let k = 0; k < count; ++k) {m.name}[k] = {use('read', m.type)}(at + {m.offset} + {size} * k);")
            fields.append(m.name)
        elif m.name == "hit" and is_statement(m.type):
            code.add(f"const hit = {value_at(m.type, m.offset)};")
            code.add("if (hit === null) return null;")
            fields.append("hit")
        else:
            fields.append(f"{m.name}: {value_at(m.type, m.offset)}")
    if {"id", "closest"} <= names:
        code.add(f"if ({number_at('uint32_t', by_name['id'].offset, 'i')} === 0) return null;")
    if name in VECTORS:
        code.add(f"return {value_at(name, 0)};")
    else:
        code.add("return { " + ", ".join(fields) + " };")
    code.add("}")


answers = api.answers()


def all_within(name):
    """A struct and those of its members."""
    yield name
    for m in api.structs[name].members:
        if m.type in api.structs and not m.is_pointer:
            yield from all_within(m.type)


plain_structs = {struct.name for d in (2, 3) for _, struct in api.plain_kinds(d)}
# Of answers that are passed in, what is left out is 0.
lenient = {inner for name in answers for inner in all_within(name)} - set(VECTORS)
lenient |= {"abut_pose2", "abut_pose3"}


def write_number(type_name, offset, value):
    size, view = NUMBERS[type_name]
    if type_name == "uint64_t":
        return f"m.u64[({at(offset)}) >> 3] = BigInt({value});"
    if type_name in ("bool", "abut_flag"):
        value = f"{value} ? 1 : 0"
    if size == 1:
        return f"m.u8[{at(offset)}] = {value};"
    return f"m.{view}[({at(offset)}) >> {size.bit_length() - 1}] = {value};"


def emit_write(code, name):
    """A struct that is passed by value, from a vector or an object."""
    struct = api.structs[name]
    code.add(f"function write_{name[5:]}(at, value) {{")
    if name in VECTORS:
        count = VECTORS[name]
        code.add(f"if (value == null || value.length !== {count} || typeof value[0] !== 'number') throw vector_needed({count}, value);")
        code.add("const i = at >> 2;")
        for k in range(count):
            code.add(f"m.f32[i + {k}] = value[{k}];" if k else "m.f32[i] = value[0];")
        code.add("}")
        return
    code.add(f"if (value === null || typeof value !== 'object') throw object_needed({object_names(struct)}, value);")
    for m in struct.members:
        value = f"value.{m.name}"
        if m.length:
            code.add(f"m.u8.fill(0, {at(m.offset)}, at + {m.offset + m.length * api.size(m.type)});")
            code.add(f"{value}?.forEach((one, k) => {use('write', m.type)}({at(m.offset)} + {api.size(m.type)} * k, one));")
            if "count" in struct.names():
                code.add(write_number("uint32_t", next(c.offset for c in struct.members if c.name == "count"), f"{value}?.length ?? 0"))
        elif m.name == "count":
            pass
        elif m.type in NUMBERS:
            flexible = name in lenient or NUMBERS[m.type][1] not in ("f32", "f64")
            code.add(write_number(m.type, m.offset, f"{value} ?? 0" if flexible and m.type != "abut_flag" else value))
        elif m.name == "rotation":
            code.add(f"if ({value} === undefined) {{")
            code.add(f"check_members(value, {members_of(name)}, {name[5:]!r});")
            for k, number in enumerate(IDENTITIES[m.type]):
                code.add(write_number("float", m.offset + 4 * k, str(number)))
            code.add(f"}} else {use('write', m.type)}({at(m.offset)}, {value});")
        elif name in lenient:
            code.add(f"if ({value} === undefined) m.u8.fill(0, {at(m.offset)}, at + {m.offset + api.size(m.type)});")
            code.add(f"else {use('write', m.type)}({at(m.offset)}, {value});")
        else:
            code.add(f"{use('write', m.type)}({at(m.offset)}, {value});")
    code.add("}")


def object_names(struct):
    return repr(", ".join(m.name for m in struct.members))


def members_of(name):
    used.setdefault(("MEMBERS", name))
    return f"MEMBERS_{name[5:]}"


def emit_members(code, name):
    names = sorted(api.structs[name].names() - set(LENGTHS.values()) | ({"type"} if name in plain_structs else set()))
    code.add(f"const MEMBERS_{name[5:]} = new Set([{', '.join(repr(n) for n in names)}]);")


def emit_options(code, name):
    """Options: the library's defaults, and what an object says otherwise."""
    struct = api.structs[name]
    by_name = {m.name: m for m in struct.members}
    code.add(f"function options_{name[5:]}(at, value) {{")
    code.add(f"check(e.{name}_default(at));" if f"{name}_default" in all_names else f"m.u8.fill(0, at, at + {struct.size});")
    code.add(f"check_members(value, {members_of(name)}, {name[5:]!r});")
    for m in struct.members:
        if m.name in LENGTHS.values() or m.name == "context":
            continue
        value = f"value.{m.name}"
        if m.name in LENGTHS:
            code.add(f"if ({value} != null) {{")
            code.add(f"const list = {array_of(m.type, value, m.name, 1)};")
            code.add(write_number("uint32_t", m.offset, "list"))
            code.add(write_number("uint32_t", by_name[LENGTHS[m.name]].offset, "m.rows"))
            code.add("}")
        elif m.type in api.callbacks:
            code.add(f"if ({value} != null) " + write_number("uint32_t", m.offset, f"library.callback({value}, {api.callbacks[m.type]})"))
        elif m.type in NUMBERS:
            code.add(f"if ({value} !== undefined) " + write_number(m.type, m.offset, value))
        else:
            code.add(f"if ({value} !== undefined) {use('write', m.type)}({at(m.offset)}, {value});")
    code.add("return at;")
    code.add("}")


# --- arrays ---------------------------------------------------------------------------------------------------------------


def array_of(type_name, value, name, elements):
    """The address of an array of C made of typed arrays or of arrays of elements; m.rows is its length."""
    if type_name in NUMBERS:
        size, view = NUMBERS[type_name]
        return f"m.array({value}, {view!r}, {elements}, {size * elements}, null, {name!r})"
    struct = api.structs[type_name]
    if f"{type_name}_default" in all_names:
        write = use("options", type_name)
    else:
        write = use("write", type_name)
    view = f"{struct.view!r}" if struct.view else "null"
    width = struct.size // NUMBERS_OF_VIEW[struct.view] if struct.view else 0
    return f"m.array({value}, {view}, {width}, {struct.size}, {write}, {name!r})"


NUMBERS_OF_VIEW = {"f32": 4, "f64": 8, "u32": 4, "i32": 4, "u64": 8, "u8": 1}


def columns_of(type_name):
    """The function that makes typed arrays of an array: columns(at, count)."""
    if type_name in NUMBERS:
        return f"m.copy_{NUMBERS[type_name][1]}"
    struct = api.structs[type_name]
    if struct.is_plain():
        used.setdefault(("columns", type_name))
    return use("columns", type_name)


def is_list_of_numbers(type_name):
    """Lists of numbers and of vectors are typed arrays, lists of others have objects."""
    if type_name in NUMBERS:
        return True
    struct = api.structs[type_name]
    return struct.view == "f32" and struct.is_plain()


def leaves_of(type_name, offset, path):
    """The columns of a struct: (path, number type, width, offset)."""
    struct = api.structs[type_name]
    if struct.is_plain():
        yield path, struct.members[0].type, len(struct.members), offset
        return
    for m in struct.members:
        for k in range(m.length or 1):
            inner = path + [m.name] + ([k] if m.length else [])
            place = offset + m.offset + k * (api.size(m.type) if m.length else 0)
            if m.type in NUMBERS:
                yield inner, m.type, 1, place
            else:
                yield from leaves_of(m.type, place, inner)


def emit_columns(code, name):
    struct = api.structs[name]
    code.add(f"function columns_{name[5:]}(at, n) {{")
    if struct.is_plain():
        size, view = NUMBERS[struct.members[0].type]
        code.add(f"return m.copy_{view}(at, {struct.size // size} * n);")
        code.add("}")
        return
    tree, variables = {}, []
    for path, type_name, width, offset in leaves_of(name, 0, []):
        size, view = NUMBERS[type_name]
        variable = "_".join(map(str, path))
        length = "n" if width == 1 else f"{width} * n"
        code.add(f"const {variable} = new {TYPED_ARRAYS[view]}({length});")
        variables.append((variable, view, size, width, offset))
        node = tree
        for key in path[:-1]:
            node = node.setdefault(key, {})
        node[path[-1]] = variable
    views = sorted({v[1] for v in variables})
    code.add(f"const {{ {', '.join(views)} }} = m;")
    code.add(f"for (let k = 0; k < n; ++k, at += {struct.size}) {{")
    code.add("const i = at >> 2;")
    for variable, view, size, width, offset in variables:
        for c in range(width):
            place = (f"i + {offset // 4 + c}" if offset // 4 + c else "i") if size == 4 else f"({at(offset + c * size)}) >> 3"
            index = "k" if width == 1 else f"{width} * k + {c}" if c else f"{width} * k"
            code.add(f"{variable}[{index}] = {view}[{place}];")
    code.add("}")
    code.add(f"return {literal(tree)};")
    code.add("}")


def literal(tree):
    if isinstance(tree, str):
        return tree
    if all(isinstance(key, int) for key in tree):
        return "[" + ", ".join(literal(value) for value in tree.values()) + "]"
    return "{ " + ", ".join(key if key == value else f"{key}: {literal(value)}" for key, value in tree.items()) + " }"
