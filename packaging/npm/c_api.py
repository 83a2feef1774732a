"""What make_calls.py and make_types.py know of abut_api.json: how structs lie in memory, and what a function takes and gives in JavaScript.

An argument of C is left out in JavaScript where it follows from the others: lengths, strides, capacities and outputs.
"""

import json
import re
import sys
from dataclasses import dataclass, field

# Vectors and rotations are arrays of numbers; the other structs are objects.
VECTORS = {"abut_vec2": 2, "abut_vec3": 3, "abut_turn": 2, "abut_quat": 4}
# Objects may leave these out.
IDENTITIES = {"abut_turn": [1, 0], "abut_quat": [0, 0, 0, 1]}
STRIDES = {"stride", "id_stride", "pose_stride", "place_stride", "step_stride"}
DEFAULTS = {"max_vertices": "0", "closed": "false", "one_sided": "false", "holes": "[]", "concavity": "0", "workers": "0",
            "softness": "0.05"}
# Lists in structs, and their lengths.
LENGTHS = {"ignore_ids": "ignore_count", "area_costs": "area_cost_count"}
# In C++ the ray comes first.
OF_RAYS = {"raycast", "raycast_any", "raycast_all"}
# Their result is a plain polygon or polyhedron.
POLYTOPES = {"polytope", "intersection", "minkowski_sum", "minkowski_difference"}
# What plain shapes do by themselves, and the member that the view adds.
ADAPTORS = {"at": "pose", "rounded": "radius", "stretched": "scale"}
HULLS = {"polygon": 2, "polyhedron": 3}
# Size and view of the memory of each number type.
NUMBERS = {"float": (4, "f32"), "double": (8, "f64"), "uint32_t": (4, "u32"), "int32_t": (4, "i32"), "size_t": (4, "u32"),
           "uint64_t": (8, "u64"), "uint8_t": (1, "u8"), "bool": (1, "u8"), "abut_flag": (4, "u32")}
TYPED_ARRAYS = {"f32": "Float32Array", "f64": "Float64Array", "u32": "Uint32Array", "i32": "Int32Array",
                "u64": "BigUint64Array", "u8": "Uint8Array"}


@dataclass
class Member:
    name: str
    type: str
    offset: int
    length: int
    is_pointer: bool
    doc: str


@dataclass
class Struct:
    name: str
    size: int
    align: int
    members: list
    doc: str
    # {view} if all is numbers of one type, else None
    view: str = None

    def names(self):
        return {member.name for member in self.members}

    def is_answer_or_null(self):
        """Whether a value of it can stand for no answer."""
        names = self.names()
        return bool(names & {"found", "hit"}) or {"id", "closest"} <= names or {"points", "count"} <= names

    def is_plain(self):
        """Whether its members are numbers of one type, which are one column."""
        return all(m.type in NUMBERS and not m.length and m.type == self.members[0].type for m in self.members)


@dataclass
class Function:
    name: str
    doc: str
    arguments: list
    inputs: list = field(default_factory=list)
    outputs: list = field(default_factory=list)
    # the array that each length follows from
    lengths: dict = field(default_factory=dict)
    has_list: bool = False
    takes_k: bool = False

    def __post_init__(self):
        for a in self.arguments:
            name = counter(a)
            if name and a["direction"] == "in":
                self.lengths.setdefault(name, a["name"])
        self.has_list = any(a["name"] == "capacity" for a in self.arguments)
        self.takes_k = self.name.endswith("_k_nearest")
        self.inputs = [a for a in self.arguments if not self._is_automatic(a)]
        self.inputs.sort(key=lambda a: a["optional"] or a["name"] in DEFAULTS)
        self.outputs = [a for a in self.arguments if is_output(a) and not self.is_length(a)]

    def is_length(self, a):
        return self.has_list and a["direction"] == "out" and a["name"] in ("count", "id_count") and not a["array"]

    def _is_automatic(self, a):
        return (a["name"] in self.lengths or a["name"] in STRIDES or a["name"] == "context" or is_output(a) or
                (a["name"] == "capacity" and not self.takes_k))


def is_output(a):
    return a["direction"] == "out" or (a["type"] == "abut_buffer" and a["name"] == "out")


def counter(a):
    """The name of the length of an array, or None; see group()."""
    match = re.fullmatch(r"(?:\d \* )?(\w+)", a["array"] or "")
    return match[1] if match else None


def group(a):
    """How many elements of C make one of JavaScript, such as the three numbers of a triangle."""
    match = re.fullmatch(r"(\d) \* \w+", a["array"] or "")
    return int(match[1]) if match else 1


def class_name(name):
    return "".join(part[0].upper() + part[1:] for part in name[5:].split("_"))


def longest(name, owners):
    fitting = [owner for owner in owners if name.startswith(owner + "_")]
    return max(fitting, key=len) if fitting else None


def is_constructor(f, owner):
    """Whether it is the constructor of the handle's class."""
    return f.name[len(owner) + 1:] in ("create", "build") and f.outputs[:1] != [] and f.outputs[0]["type"] == owner


def is_shape(name):
    return name in ("abut_shape2", "abut_shape3")


class Api:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.json = json.load(file)
        self.handles = {h["name"]: h["doc"] for h in self.json["handles"] if h["name"] != "abut_buffer"}
        self.callbacks = {c["name"]: len(c["arguments"]) for c in self.json["callbacks"]}
        self.structs = {}
        for s in self.json["structs"]:
            self.structs[s["name"]] = self._layout(s)
        self.functions = {f["name"]: Function(f["name"], f["doc"], f["arguments"]) for f in self.json["functions"]
                          if not re.search(r"^abut_(buffer|last)|_(release|default|version)$", f["name"])}

    def size(self, type_name):
        return NUMBERS[type_name][0] if type_name in NUMBERS else self.structs[type_name].size

    def align(self, type_name):
        return NUMBERS[type_name][0] if type_name in NUMBERS else self.structs[type_name].align

    def view(self, type_name):
        return NUMBERS[type_name][1] if type_name in NUMBERS else self.structs[type_name].view

    def _layout(self, s):
        offset, largest, members = 0, 1, []
        for m in s["members"]:
            is_pointer = bool(m["pointers"]) or m["type"] in self.callbacks
            size, align = (4, 4) if is_pointer else (self.size(m["type"]), self.align(m["type"]))
            offset = -(-offset // align) * align
            members.append(Member(m["name"], m["type"], offset, m["array"] or 0, is_pointer, m["doc"]))
            offset += size * (m["array"] or 1)
            largest = max(largest, align)
        views = {None if m.is_pointer or m.length else self.view(m.type) for m in members}
        view = views.pop() if len(views) == 1 else None
        return Struct(s["name"], -(-offset // largest) * largest, largest, members, s["doc"], view)

    def dimension(self, f):
        """2 or 3, or 0 if a function belongs to both: that of the handle that it is of, else of its handles, else of its values."""
        owner = longest(f.name, self.handles)
        if owner:
            return self.dimension_of(owner)
        types = [a["type"] for a in f.arguments]
        for these in ([t for t in types if t in self.handles], types):
            found = {d for d in map(self.dimension_of, these) if d}
            if found:
                return found.pop()
        return 0

    def dimension_of(self, type_name):
        if type_name in self.handles:
            return self._dimension_of_handle(type_name)
        if type_name in VECTORS:
            return {"abut_vec2": 2, "abut_turn": 2}.get(type_name, 3)
        if type_name not in self.structs:
            return 0
        return max([self.dimension_of(m.type) for m in self.structs[type_name].members], default=0)

    def _dimension_of_handle(self, name):
        """That at the end of its name, else of the values that its functions take and give: a walk mesh is of space."""
        if name[-1] in "23":
            return int(name[-1])
        own = [f for f in self.json["functions"] if longest(f["name"], self.handles) == name]
        types = {a["type"] for f in own for a in f["arguments"]} - set(self.handles)
        return max(map(self.dimension_of, types), default=0)

    def answers(self):
        """The structs that functions give."""
        return {a["type"] for f in self.functions.values() for a in f.outputs if a["type"] in self.structs}

    def exports(self, dimension):
        """The names of the C functions of a dimension, or with 0 of all."""
        for f in self.json["functions"]:
            if self.dimension(Function(f["name"], f["doc"], f["arguments"])) in (0, dimension) or dimension == 0:
                yield f["name"]

    def plain_kinds(self, dimension):
        """The structs that plain shapes are made of: (function, struct)."""
        owner = f"abut_shape{dimension}"
        for f in self.functions.values():
            first = f.arguments[0]
            is_plain = len(f.arguments) == 2 and first["pointers"] == 0 and first["type"] in self.structs
            if is_plain and longest(f.name, self.handles) == owner:
                yield f, self.structs[first["type"]]

    def shape_name(self, f, dimension):
        """The name of a function that makes a shape: Mesh, Compound3."""
        short = f.name[len("abut_shape3_"):]
        in_both = f"abut_shape{5 - dimension}_{short}" in self.functions
        return class_name("abut_" + short) + (str(dimension) if in_both else "")


def main():
    """Prints the functions that a module of one dimension exports, or with 0 those of all: c_api.py API_JSON DIMENSION."""
    print(";".join(["malloc", "free", *Api(sys.argv[1]).exports(int(sys.argv[2]))]))


if __name__ == "__main__":
    main()
