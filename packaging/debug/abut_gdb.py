# Printers of abut's types for gdb. In gdb, or in ~/.gdbinit:
#   source /usr/share/abut/abut_gdb.py
import re

import gdb
import gdb.printing


def number(value):
    return format(float(value), "g")


def coordinates(vec):
    """The coordinates of a glm vector: its members without the aliases r, g, b and s, t, p."""
    count = int(vec.type.template_argument(0))
    return "(" + ", ".join(number(vec[name]) for name in "xyzw"[:count]) + ")"


def quaternion(q):
    return "w %s (%s, %s, %s)" % tuple(number(q[name]) for name in "wxyz")


def rotation(value):
    if value.type.strip_typedefs().name == "abut::Turn":
        return "turn (%s, %s)" % (number(value["cos"]), number(value["sin"]))
    return "turn " + quaternion(value)


def text_of(value):
    """A member in one line: vectors, rotations and numbers; others as gdb prints them."""
    name = value.type.strip_typedefs().name or ""
    if name.startswith("glm::vec<"):
        return coordinates(value)
    if name.startswith("glm::qua<") or name == "abut::Turn":
        return rotation(value)
    if value.type.strip_typedefs().code == gdb.TYPE_CODE_FLT:
        return number(value)
    return value.format_string()


class Plain:
    """A value in one line."""

    def __init__(self, value, text):
        self.value, self.text = value, text

    def to_string(self):
        return self.text(self.value)


def fields(*names):
    """The members of these names: `center (1, 2, 3) radius 1`."""
    return lambda value: " ".join("%s %s" % (name, text_of(value[name])) for name in names)


def id_text(value):
    if int(value["index"]) == 0:
        return "null"
    return "%d, generation %d" % (int(value["index"]), int(value["generation"]))


def pair_text(value):
    return "{%s} {%s}" % (id_text(value["a"]), id_text(value["b"]))


class Result:
    """The value, or the Problem."""

    def __init__(self, value):
        state = value["state_"]
        self.index = int(state["_M_index"])
        union = state["_M_u"]
        for _ in range(self.index):
            union = union["_M_rest"]
        self.content = stored(union["_M_first"])

    def to_string(self):
        if self.index == 1:
            return "Problem %s: %s" % (self.content["code"], self.content["message"].format_string())
        return "Result"

    def children(self):
        if self.index == 0:
            yield "value", self.content


def stored(uninitialized):
    """The object in a std::_Uninitialized of libstdc++."""
    storage = uninitialized["_M_storage"]
    inner = uninitialized.type.strip_typedefs().template_argument(0)
    if storage.type.strip_typedefs() == inner.strip_typedefs():
        return storage
    return storage["_M_storage"].address.cast(inner.pointer()).dereference()


class Points:
    """A shape of points: those of a std::vector in it, or in what its std::shared_ptr owns."""

    def __init__(self, name, vector_of):
        self.name, self.vector_of = name, vector_of

    def __call__(self, value):
        return PointsPrinter(self.name, self.vector_of(value))


class PointsPrinter:
    def __init__(self, name, vector):
        self.name, self.vector = name, vector
        self.first = None if vector is None else vector["_M_impl"]["_M_start"]
        self.count = 0 if vector is None else int(vector["_M_impl"]["_M_finish"] - self.first)

    def to_string(self):
        if self.vector is None:
            return self.name + " (its points are shown with the debug symbols of abut)"
        return "%s of %d points" % (self.name, self.count)

    def children(self):
        for i in range(self.count):
            yield "[%d]" % i, self.first[i]

    def display_hint(self):
        return "array"


def owned(pointer):
    """What a std::shared_ptr owns; None if it is null, or its type is known to the library alone."""
    if int(pointer["_M_ptr"]) == 0:
        return None
    data = pointer["_M_ptr"].dereference()
    return data if data.type.strip_typedefs().fields() else None


def member(value, *names):
    for name in names:
        if value is None:
            return None
        value = value[name]
    return value


ONE_LINE = [
    (r"glm::vec<[234], .+>", coordinates),
    (r"glm::qua<.+>", quaternion),
    (r"abut::Turn", rotation),
    (r"abut::PoseD?<[23]>", lambda v: "at %s %s" % (coordinates(v["position"]), rotation(v["rotation"]))),
    (r"abut::Aabb<[23]>", lambda v: "%s to %s" % (coordinates(v["min"]), coordinates(v["max"]))),
    (r"abut::RayD?<[23]>", fields("origin", "direction", "length")),
    (r"abut::Ball<[23]>", fields("center", "radius")),
    (r"abut::Capsule<[23]>", fields("a", "b", "radius")),
    (r"abut::Box<[23]>", fields("center", "half", "rotation")),
    (r"abut::Segment<[23]>", fields("a", "b")),
    (r"abut::Triangle<[23]>", fields("a", "b", "c")),
    (r"abut::HalfSpace<[23]>", fields("normal", "offset")),
    (r"abut::(Cylinder|Cone)", fields("a", "b", "radius")),
    (r"abut::Hit<[23]>", fields("fraction", "distance", "point", "normal", "started_inside")),
    (r"abut::Closest<[23]>", fields("distance", "normal", "on_a", "on_b")),
    (r"abut::Id", id_text),
    (r"abut::IdPair", pair_text),
]
WITH_CHILDREN = [
    (r"abut::Result<.+>", Result),
    (r"abut::Polygon", Points("Polygon", lambda v: v["points_"])),
    (r"abut::Polyhedron", Points("Polyhedron", lambda v: member(owned(v["data_"]), "hull", "points"))),
    (r"abut::Mesh", Points("Mesh", lambda v: member(owned(v["data_"]), "points"))),
    (r"abut::Chain", Points("Chain", lambda v: member(owned(v["data_"]), "points"))),
]


def find_printer(value):
    kind = value.type.strip_typedefs().unqualified()
    name = kind.name
    # Without -fstandalone-debug clang leaves out the members of types that only the library makes.
    if name is None or not name.startswith(("abut::", "glm::")) or not kind.fields():
        return None
    for pattern, text in ONE_LINE:
        if re.fullmatch(pattern, name):
            return Plain(value, text)
    for pattern, printer in WITH_CHILDREN:
        if re.fullmatch(pattern, name):
            return printer(value)
    return None


find_printer.name, find_printer.enabled = "abut", True
gdb.printing.register_pretty_printer(None, find_printer, replace=True)
