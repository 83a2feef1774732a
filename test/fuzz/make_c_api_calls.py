"""Writes C++ that calls each function of the C API with arguments of any bytes: make_c_api_calls.py abut_api.json OUT.hpp"""

import json
import pathlib
import re
import sys

api = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
handles = [one["name"] for one in api["handles"]]
callbacks = {"abut_accepts", "abut_accepts_pair"}
structs = {one["name"]: one["members"] for one in api["structs"]}
# A field of small cells has millions of samples.
overrides = {"abut_field_options": "value.cell = 1 + 0.25f * static_cast<float>(caller.bytes.byte() % 8);"}


def filled(member):
    name = f"value.{member['name']}"
    if member["pointers"]:
        return f"{name} = nullptr;"
    if member["array"]:
        return f"for (auto& each : {name}) fill(caller, each);"
    return f"fill(caller, {name});"


def write_fill(name, members):
    yield f"inline void fill(Caller& caller, {name}& value) {{"
    yield from (f"    {filled(member)}" for member in members)
    if name in overrides:
        yield f"    {overrides[name]}"
    yield "}"


def write_call(number, function):
    """One case: the lengths of arrays, then the other arguments, the call, and what it made."""
    arguments = function["arguments"]
    lengths = {word for one in arguments if one["array"] for word in re.findall(r"[a-z_]\w*", one["array"])}
    is_release = function["name"].endswith("_release")
    declared, after = [], []
    for one in arguments:
        name, kind, array = one["name"], one["type"], one["array"]
        value = name
        if name == "size":
            value = "bytes.size()"
        elif name in lengths:
            declared.append(f"const std::uint32_t {name} = caller.count();")
        elif kind in callbacks:
            value = "&accepts" if kind == "abut_accepts" else "&accepts_pair"
        elif kind == "void":
            value = "nullptr"
        elif name.endswith("stride"):
            value = "0"
        elif kind in handles and one["direction"] == "out" and one["pointers"] == 2:
            declared.append(f"{kind}* {name} = nullptr;")
            value = f"&{name}"
            after.append(f"caller.keep({name});")
        elif kind in handles and array:
            declared.append(f"const auto {name} = caller.handles<{kind}>({array});")
            value = f"{name}.get()"
        elif kind in handles:
            declared.append(f"{kind}* const {name} = caller.{'taken' if is_release else 'any'}<{kind}>();")
        elif array == "size":
            declared.append(f"const std::vector<std::uint8_t> {name} = caller.file();")
            value = f"{name}.data()"
        elif array:
            make = "filled" if one["direction"] == "in" else "empty"
            declared.append(f"const auto {name} = caller.{make}<{kind}>({array});")
            value = f"{name}.get()"
        elif one["pointers"] == 1:
            make = "filled" if one["direction"] != "out" else "empty"
            declared.append(f"const auto {name} = caller.{make}<{kind}>({'caller.bytes.byte() % 2u' if one['optional'] else '1'});")
            value = f"{name}.get()"
        else:
            declared.append(f"{kind} {name}{{}};\n            fill(caller, {name});")
        one["value"] = value
    # Lengths come first, as the arrays need them.
    declared.sort(key=lambda line: not line.startswith("const std::uint32_t"))
    call = f"{function['name']}({', '.join(one['value'] for one in arguments)})"
    yield f"        case {number}: {{"
    yield from (f"            {line}" for line in declared)
    yield f"            caller.check({call});" if function["returns"] == "abut_code" else f"            static_cast<void>({call});"
    yield from (f"            {line}" for line in after)
    yield "            break;"
    yield "        }"


lines = ["// By make_c_api_calls.py."]
lines += [f"inline void release(Caller&, {name}* handle) {{\n    {name}_release(handle);\n}}" for name in handles]
for name, members in structs.items():
    lines += write_fill(name, members)
lines += ["inline void call(Caller& caller, std::uint32_t number) {", f"    switch (number % {len(api['functions'])}u) {{"]
for number, function in enumerate(api["functions"]):
    lines += write_call(number, function)
lines += ["        default:", "            break;", "    }", "}", ""]
pathlib.Path(sys.argv[2]).write_text("\n".join(lines), encoding="utf-8")
