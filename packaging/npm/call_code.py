"""The JavaScript of one call of a function of C: its arguments in memory, the call, and what it gives, for make_calls.py."""

from struct_code import *

SHAPE_SCRATCH = 48


class Frame:
    """The memory of one call whose size is known: offsets from `at`."""

    def __init__(self):
        self.size = 0

    def take(self, size, align=8):
        self.size = -(-self.size // align) * align
        offset = self.size
        self.size += size
        return offset


def parameter(a, f):
    """As it stands in the list of parameters."""
    name = js_name(a)
    return f"{name} = {DEFAULTS[a['name']]}" if a["name"] in DEFAULTS else name


def js_name(a):
    return "k" if a["name"] == "capacity" else a["name"]


def emit_call(code, f, this=None, as_columns=False):
    """The body of a function whose parameters have their names; `this` is the expression of the first argument's object."""
    frame, before, arguments = Frame(), [], {}
    for number, a in enumerate(f.arguments):
        name, kind = js_name(a), a["type"]
        value = this if number == 0 and this else name
        if a["name"] in STRIDES or a["name"] == "context":
            arguments[a["name"]] = "0"
        elif is_output(a) or a["name"] in f.lengths or (a["name"] == "capacity" and not f.takes_k):
            continue
        elif a["array"] and a["direction"] == "in":
            before.append(("array", a, value))
            arguments[a["name"]] = f"{name}_at"
        elif kind in api.handles:
            if is_shape(kind):
                expression = f"shape{kind[-1]}({value}, {at(frame.take(SHAPE_SCRATCH))})"
            elif this and number == 0:
                expression = "pointer_of(this)"
            else:
                expression = f"library.pointer({value}, {class_name(kind)!r})"
            if a["optional"]:
                expression = f"{value} == null ? 0 : {expression}"
            if is_shape(kind) and sum(is_shape(b["type"]) for b in f.arguments if b["direction"] == "in") > 0:
                before.append(("line", f"const {name}_at = {expression};"))
                expression = f"{name}_at"
            arguments[a["name"]] = expression
        elif kind in api.callbacks:
            call = f"library.callback({value}, {api.callbacks[kind]})"
            arguments[a["name"]] = f"{value} == null ? 0 : {call}" if a["optional"] else call
        elif a["pointers"]:
            place = at(frame.take(api.size(kind)))
            before.append(("line", f"const {name}_at = {value} == null ? 0 : {use('options', kind)}({place}, {value});"))
            arguments[a["name"]] = f"{name}_at"
        elif kind in api.structs:
            place = at(frame.take(api.size(kind)))
            before.append(("line", f"{use('write', kind)}({place}, {value});"))
            arguments[a["name"]] = place
        elif kind == "uint64_t":
            arguments[a["name"]] = f"BigInt({value})"
        elif kind == "bool":
            arguments[a["name"]] = f"{value} ? 1 : 0"
        else:
            arguments[a["name"]] = f"number({value}, {name!r})"
    lists = [a for a in f.outputs if a["array"] and counter(a) == "capacity"]
    outputs, after = [], []
    for a in f.outputs:
        kind = a["type"]
        if kind == "abut_buffer":
            place = at(frame.take(4))
            before.append(("line", f"check(e.abut_buffer_create({place}));"))
            before.append(("line", f"const buffer = m.release_later(m.u32[({place}) >> 2], e.abut_buffer_release);"))
            arguments[a["name"]] = "buffer"
            outputs.append((a["name"], "library.bytes(buffer)"))
            continue
        if a["array"] and counter(a) != "capacity":
            after.append(f"const {a['name']}_at = m.take({api.size(kind) * group(a)} * {counter(a)});")
            arguments[a["name"]] = f"{a['name']}_at"
            count = counter(a) if group(a) == 1 else f"{group(a)} * {counter(a)}"
            outputs.append((a["name"], f"{columns_of(kind)}({a['name']}_at, {count})"))
        elif a["array"]:
            arguments[a["name"]] = f"{a['name']}_at"
            count = "length" if group(a) == 1 else f"{group(a)} * length"
            if is_list_of_numbers(kind) or as_columns:
                outputs.append((a["name"], f"{columns_of(kind)}({a['name']}_at, {count})"))
            else:
                outputs.append((a["name"], f"m.list({a['name']}_at, {count}, {api.size(kind)}, {use('read', kind)})"))
        else:
            size = 4 if a["pointers"] == 2 else api.size(kind)
            place = at(frame.take(size))
            arguments[a["name"]] = place
            if a["pointers"] == 2:
                outputs.append((a["name"], f"library.owning({class_name(kind)}, m.u32[({place}) >> 2])"))
            elif kind == "abut_events":
                outputs.append((a["name"], f"events({place})"))
            elif kind in NUMBERS:
                outputs.append((a["name"], number_at(kind, int(place[5:] or 0))))
            else:
                outputs.append((a["name"], f"{use('read', kind)}({place})"))
    if f.has_list:
        length_at = at(frame.take(4))
        arguments[next(a["name"] for a in f.arguments if f.is_length(a))] = length_at
    code.add(f"const at = m.enter({-(-max(frame.size, 8) // 8) * 8});")
    code.add("try {")
    known = set()
    for kind, *rest in before:
        if kind == "line":
            code.add(rest[0])
        else:
            emit_array(code, f, rest[0], rest[1], known)
    for name in f.lengths:
        arguments[name] = name
    for line in after:
        code.add(line)
    if f.takes_k:
        code.add("const capacity = number(k, 'k');")
    if f.has_list:
        arguments["capacity"] = "capacity"
        if not f.takes_k:
            code.add(f"for (let capacity = capacities.{f.name} ?? 64; ; capacity = capacities.{f.name} = m.u32[({length_at}) >> 2]) {{")
        for a in lists:
            code.add(f"const {a['name']}_at = m.take({api.size(a['type']) * group(a)} * capacity);")
    code.add(f"check(e.{f.name}({', '.join(arguments[a['name']] for a in f.arguments)}));")
    if f.has_list:
        full = f"m.u32[({length_at}) >> 2]"
        code.add(f"const length = Math.min({full}, capacity);" if f.takes_k else f"const length = {full};")
        if not f.takes_k:
            code.add("if (length > capacity) continue;")
    if len(outputs) == 1:
        code.add(f"return {outputs[0][1]};")
    elif outputs:
        code.add("return { " + ", ".join(f"{name}: {value}" for name, value in outputs) + " };")
    if f.has_list and not f.takes_k:
        code.add("}")
    code.add("} finally {")
    code.add("m.leave(at);")
    code.add("}")


def emit_array(code, f, a, value, known):
    name = js_name(a)
    if a["pointers"] == 2:
        code.add(f"const {name}_at = shapes{a['type'][-1]}({value});")
    else:
        expression = array_of(a["type"], value, name, group(a))
        code.add(f"const {name}_at = " + (f"{value} == null ? 0 : {expression};" if a["optional"] else f"{expression};"))
    count = counter(a)
    if count is None:
        code.add(f"if (m.rows !== {a['array']}) throw wrong_length({name!r}, m.rows, {a['array']});")
    elif count in known:
        wrong = f"m.rows !== {count}"
        code.add(f"if ({name}_at !== 0 && {wrong}) throw wrong_length({name!r}, m.rows, {count});" if a["optional"] else
                 f"if ({wrong}) throw wrong_length({name!r}, m.rows, {count});")
    else:
        known.add(count)
        code.add(f"const {count} = m.rows;")


def has_objects(f):
    return any(a["array"] and counter(a) == "capacity" and not is_list_of_numbers(a["type"]) for a in f.outputs)


def emit_function(code, f, head, this=None, skip=0, as_columns=False):
    code.add(f"{head}({', '.join(parameter(a, f) for a in f.inputs[skip:])}) {{")
    emit_call(code, f, this, as_columns)
    code.add("}")


def emit_with_columns(code, f, prefix, short, this, skip):
    """The function, and where it gives a list of objects, one that gives typed arrays."""
    emit_function(code, f, f"{prefix}{short}", this, skip)
    if has_objects(f):
        emit_function(code, f, f"{prefix}{short}_columns", this, skip, as_columns=True)
        return [short, f"{short}_columns"]
    return [short]
