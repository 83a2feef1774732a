"""Collision detection in 2D and 3D: shapes, queries, worlds, distance fields, walk meshes.

Everything is made from abut_api.json, the description of the C API: names are those of C++, with the dimension at the
end of types. Arrays are numpy arrays where numpy is installed.
"""

import ctypes as _ctypes

from . import _names
from ._arrays import dtype as _dtype_of_type
from ._calls import Function as _Function
from ._calls import Handle as _Handle
from ._calls import copied as _copied
from ._calls import handles as _handles
from ._library import Error, api as _api, library as _library, python_name as _python_name
from ._values import values as _values

__version__ = _library.abut_version().decode()


def _make_handles():
    for handle in _api["handles"]:
        name = handle["name"]
        release = getattr(_library, name + "_release")
        release.restype, release.argtypes = None, [_ctypes.c_void_p]
        _handles[name] = type(_python_name(name), (_Handle,),
                              {"_c_name": name, "_release": release, "__doc__": handle["doc"], "__module__": "abut"})
        if name in _names.HANDLES:
            globals()[_python_name(name)] = _handles[name]


def _documented(call, name, doc):
    call.__name__, call.__doc__ = name, doc
    return call


def _method(function, name):
    return _documented(lambda self, *arguments, **named: function(self, *arguments, **named), name, function.doc)


def _static(function, name):
    return staticmethod(_documented(lambda *arguments, **named: function(*arguments, **named), name, function.doc))


def _constructor(function):
    def make(self, *arguments, **named):
        made = function(*arguments, **named)
        self._pointer, made._pointer = made._pointer, None

    return _documented(make, "__init__", function.doc)


def _make_functions():
    for description in _api["functions"]:
        place = _names.place_of(description)
        if place is None:
            continue
        owner, name, kind = place
        function = _Function(description)
        if kind == "function":
            globals()[name] = _static(function, name).__func__
            continue
        cls = _handles.get(owner) or _values[owner]
        if kind == "constructor":
            cls.__init__ = _constructor(function)
        else:
            setattr(cls, name, _method(function, name) if kind == "method" else _static(function, name))


for _name, _value in _values.items():
    globals()[_python_name(_name)] = _value
_make_handles()
_make_functions()


def _shape_of_values(struct, make):
    """Box3(center, half) makes the values of a box and of them the shape."""
    kind = _values[struct]

    def shape(*members, **named):
        return make(members[0] if len(members) == 1 and isinstance(members[0], kind) else kind(*members, **named))

    members = ", ".join(name for name, _ in kind._fields_)
    return _documented(shape, make.__name__, f"{make.__doc__} Members: {members}.")


for _struct in _names.SHAPE_STRUCTS:
    _name = _python_name(_struct)
    globals()[_name] = _shape_of_values(_struct, globals()[_name])
Circle, Sphere = Ball2, Ball3


def _at_points(cls):
    """`closest` takes a point as well, as in C++."""
    shapes = cls.closest
    points = cls.closest_to_point

    def closest(self, other, *arguments, **named):
        is_shape = isinstance(other, _Handle)
        return (shapes if is_shape else points)(self, other, *arguments, **named)

    cls.closest = _documented(closest, "closest", shapes.__doc__)


for _cls in (Shape2, Shape3, World2, World3):
    _at_points(_cls)


def _of_pairs(name):
    def call(a, b, *arguments, **named):
        return getattr(a, name)(b, *arguments, **named)

    return _documented(call, name, getattr(Shape3, name).__doc__)


for _name in _names.OF_PAIRS:
    globals()[_name] = _of_pairs(_name)


class Events:
    """The changes of an update: arrays of pairs of ids that began to touch, touch still, and ended; `fractions` are those
    of the motion since the last update at which the pairs of `began` began."""

    def __init__(self, events):
        for name in ("began", "stayed", "ended"):
            count = getattr(events, name + "_count")
            setattr(self, name, _copied(getattr(events, name), count, "abut_id_pair"))
        self.fractions = _copied(events.fractions, events.began_count, "float")


def _with_events(cls):
    update = cls.update

    def call(self, pool=None):
        return Events(update(self, pool))

    cls.update = _documented(call, "update", update.__doc__)


for _cls in (World2, World3):
    _with_events(_cls)


def _rings(outline, holes):
    points, ends = [], []
    for ring in (outline, *holes):
        points.extend(ring)
        ends.append(len(points))
    return points, ends


def _of_outline(function):
    def call(outline, holes=(), **options):
        points, ends = _rings(outline, holes)
        return function(points, ends, **options)

    return _documented(call, function.__name__, function.__doc__)


decompose_outline = _of_outline(decompose_outline)
Field2.bake_outline = staticmethod(_of_outline(Field2.bake_outline))


def _item(self, index):
    # Iteration ends at an IndexError.
    if not 0 <= index < len(self):
        raise IndexError(index)
    return self.get(index)


for _cls in (Shapes2, Shapes3):
    _cls.__len__, _cls.__getitem__ = _cls.size, _item


def dtype(kind):
    """The numpy dtype of a struct, such as dtype(abut.ItemOptions3), for arrays that functions take or return."""
    return _dtype_of_type(kind)
