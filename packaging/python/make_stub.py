"""Writes abut/__init__.pyi, the types of the package, from abut_api.json.

    make_stub.py            writes the file; --check exits with 1 if it is not up to date

It imports the package, so ABUT_LIBRARY must name the shared library.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from abut import _names  # noqa: E402
from abut._calls import Function, _is_handle, handles  # noqa: E402
from abut._library import api, python_name  # noqa: E402
from abut._values import callbacks, values  # noqa: E402

HEADER = '''"""Collision detection in 2D and 3D. Made by make_stub.py; the names are those of C++."""

import ctypes
from typing import Any, Callable, Optional, Sequence, Union

__version__: str

# An array of numpy, or a sequence; what functions return is an array if numpy is installed, else a list.
Array = Any
# A vector, pose or other struct is made of its members as well: ((1, 2, 3), (0, 0, 0, 1)).
Members = Sequence[Any]

class Error(ValueError):
    code: str
    index: int

class Handle:
    def release(self) -> None: ...
    def __enter__(self) -> Any: ...
    def __exit__(self, *_: Any) -> None: ...

class Events:
    began: Array
    stayed: Array
    ended: Array
    fractions: Array

def dtype(kind: type) -> Any: ...
'''
NUMBERS = {"float": "float", "double": "float", "bool": "bool", "void": "Any"}


def type_in(argument):
    if argument["array"]:
        return "Array"
    if argument["type"] in callbacks:
        return "Optional[Callable[..., bool]]" if argument["optional"] else "Callable[..., bool]"
    if argument["type"] in handles:
        name = python_name(argument["type"])
        return f"Optional[{name}]" if argument["optional"] else name
    if argument["type"] in values:
        kind = f"Union[{python_name(argument['type'])}, Members]"
        return "Union[Any, dict[str, Any], None]" if argument["optional"] else kind
    return NUMBERS.get(argument["type"], "int")


def type_out(argument):
    if argument["type"] == "abut_buffer":
        return "bytes"
    if argument["array"]:
        return "Array"
    if argument["pointers"] == 2:
        return python_name(argument["type"])
    return python_name(argument["type"]) if argument["type"] in values else NUMBERS.get(argument["type"], "int")


def signature(function, name, is_method):
    parameters = []
    for i, a in enumerate(function.parameters):
        if i == 0 and is_method:
            parameters.append("self")
            continue
        default = " = ..." if a["optional"] or Function._has_default(a) else ""
        parameter = "k" if a["name"] == "capacity" else a["name"]
        parameters.append(f"{parameter}: {type_in(a)}{default}")
    if function.options:
        parameters.append("**members_of_options: Any")
    results = [type_out(a) for a in function.outputs()]
    if name == "update":
        results = ["Events"]
    if name == "intersection":
        results = [f"Optional[{results[0]}]"]
    result = f"tuple[{', '.join(results)}]" if len(results) > 1 else (results or ["None"])[0]
    return f"def {name}({', '.join(parameters)}) -> {result}: ..."


def of_members(name, description):
    """A shape that is made of its members."""
    struct = next(s for s in api["structs"] if s["name"] == description["arguments"][0]["type"])
    members = [f"{m['name']}: {type_in({**m, 'optional': False})}{' = ...' if m['name'] == 'rotation' else ''}"
               for m in struct["members"]]
    return f"def {name}({', '.join(members)}) -> {type_out(description['arguments'][-1])}: ..."


def class_lines(c_name, doc, body):
    return [f"class {python_name(c_name)}({'Handle' if c_name in handles else 'ctypes.Structure'}):", f'    """{doc}"""',
            *("    " + line for line in body), ""]


def stub():
    owned, free = {}, []
    for description in api["functions"]:
        place = _names.place_of(description)
        if place is None:
            continue
        owner, name, kind = place
        function = Function(description)
        if owner is None:
            if name in ("decompose_outline",):
                free.append("def decompose_outline(outline: Array, holes: Sequence[Array] = ..., concavity: float = ...)"
                            " -> Shapes2: ...")
            elif description["arguments"][0]["type"] in _names.SHAPE_STRUCTS and len(description["arguments"]) == 2:
                free.append(of_members(name, description))
            else:
                free.append(signature(function, name, False))
            continue
        lines = owned.setdefault(owner, [])
        if kind == "constructor":
            lines.append(signature(function, "__init__", False).replace("(", "(self, ", 1).replace(", )", ")").rsplit(" ->")[0] +
                         " -> None: ...")
        elif name == "bake_outline":
            lines += ["@staticmethod", "def bake_outline(outline: Array, holes: Sequence[Array] = ..., **members_of_options:"
                      " Any) -> Field2: ..."]
        elif kind == "static":
            lines += ["@staticmethod", signature(function, name, False)]
        elif name == "closest" and "abut_field" not in owner:
            lines.append(signature(function, name, True).replace(": Shape2", ": Union[Shape2, Members]").replace(
                ": Shape3", ": Union[Shape3, Members]"))
        else:
            lines.append(signature(function, name, True))
    lines = []
    for struct in api["structs"]:
        if struct["name"] in _names.SHAPE_STRUCTS:
            continue
        body = [f"{m['name']}: {'Any' if m['array'] or m['pointers'] or m['type'] in callbacks else type_out({**m, 'array': None})}"
                for m in struct["members"]]
        body.append("def __init__(self, *members: Any, **named: Any) -> None: ...")
        lines += class_lines(struct["name"], struct["doc"], body + owned.get(struct["name"], []))
    for handle in api["handles"]:
        if handle["name"] not in _names.HANDLES:
            continue
        body = owned.get(handle["name"], ["..."])
        if handle["name"].startswith("abut_shapes"):
            shape = python_name(handle["name"].replace("shapes", "shape"))
            body += ["def __len__(self) -> int: ...", f"def __getitem__(self, index: int) -> {shape}: ..."]
        lines += class_lines(handle["name"], handle["doc"], body)
    lines += free + ["Circle = Ball2", "Sphere = Ball3"]
    for name in _names.OF_PAIRS:
        result = {"overlaps": "bool", "each_contact": "Array"}.get(name, "Any")
        lines.append(f"def {name}(a: Any, b: Any, *arguments: Any, **named: Any) -> {result}: ...")
    return HEADER + "\n" + "\n".join(lines) + "\n"


def main():
    file = HERE / "abut" / "__init__.pyi"
    if sys.argv[1:] == ["--check"]:
        if not file.exists() or file.read_text() != stub():
            sys.exit("make_stub.py: abut/__init__.pyi is not up to date: run make_stub.py")
    else:
        file.write_text(stub())


if __name__ == "__main__":
    main()
