"""The plain structs as classes: Pose3, Ray2, Hit3 and so on."""

import ctypes

from ._library import api, check, library, python_name

_NUMBERS = {
    "float": ctypes.c_float,
    "double": ctypes.c_double,
    "bool": ctypes.c_bool,
    "uint8_t": ctypes.c_uint8,
    "uint32_t": ctypes.c_uint32,
    "int32_t": ctypes.c_int32,
    "uint64_t": ctypes.c_uint64,
    "size_t": ctypes.c_size_t,
}
_NUMBERS.update({number["name"]: _NUMBERS[number["type"]] for number in api["numbers"]})
# All zeros are no rotation.
_DEFAULTS = {"abut_turn": (1, 0), "abut_quat": (0, 0, 0, 1)}
# Lists in structs, and their lengths.
_LENGTHS = {"ignore_ids": "ignore_count", "area_costs": "area_cost_count"}

values = {}
callbacks = {}


class Value(ctypes.Structure):
    """A struct. It is made of its members, by position or by name, or of what is like it: Pose3((1, 2, 3)). Members that
    are structs are made of sequences. It is a sequence of its members, and equal if they are."""

    def __init__(self, *members, **named):
        super().__init__()
        names = [name for name, _ in self._fields_]
        if self._default is not None:
            check(self._default(ctypes.byref(self)))
        else:
            for name in names:
                default = _DEFAULTS.get(getattr(dict(self._fields_)[name], "_c_name", None))
                if default:
                    setattr(self, name, default)
        if len(members) > len(names):
            raise TypeError(f"{type(self).__name__} has {len(names)} members, not {len(members)}")
        for name, value in zip(names, members):
            setattr(self, name, value)
        for name, value in named.items():
            if name not in names:
                raise TypeError(f"{type(self).__name__} has no member {name}")
            setattr(self, name, value)

    def __setattr__(self, name, value):
        kind = dict(self._fields_).get(name)
        if kind is None:
            raise AttributeError(f"{type(self).__name__} has no member {name}")
        if name in _LENGTHS and value is not None:
            value = list(value)
            element = kind._type_
            array = (element * len(value))(*[as_value(element, one) for one in value])
            self._own(name, array)
            setattr(self, _LENGTHS[name], len(value))
            value = ctypes.cast(array, kind)
        elif kind in callbacks.values() and value is not None:
            value = kind(callback_of(value))
            self._own(name, value)
        elif isinstance(kind, type) and issubclass(kind, Value):
            value = as_value(kind, value)
        elif hasattr(value, "item"):
            value = value.item()  # a number of numpy
        super().__setattr__(name, value)

    def _own(self, name, value):
        """Python frees what only a struct of C refers to."""
        self.__dict__.setdefault("_owned", {})[name] = value

    def __getitem__(self, index):
        return getattr(self, self._fields_[index][0])

    def __len__(self):
        return len(self._fields_)

    def __iter__(self):
        return (getattr(self, name) for name, _ in self._fields_)

    def __eq__(self, other):
        return isinstance(other, type(self)) and bytes(self) == bytes(other)

    def __hash__(self):
        return hash(bytes(self))

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(map(repr, self))})"

    def __bool__(self):
        """False for an answer that there is none: no hit, no contact, no item."""
        if hasattr(self, "found"):
            return self.found != 0
        if hasattr(self, "hit"):
            return self.hit.found != 0
        if hasattr(self, "id"):
            return self.id.index != 0
        return self.count != 0 if hasattr(self, "points") else True


def callback_of(function):
    """Of C, called with the context first, which Python doesn't need."""
    return lambda context, *arguments: bool(function(*arguments))


def as_value(kind, value):
    """A number or struct of a ctypes type, made of a Python value."""
    if isinstance(value, kind) or not issubclass(kind, Value):
        return value
    if isinstance(value, dict):
        return kind(**value)
    value = tuple(value)
    # Vectors, rotations and ids have all of their numbers; what holds such may leave out the last ones.
    is_flat = not any(issubclass(field, Value) for _, field in kind._fields_)
    if is_flat and len(value) != len(kind._fields_):
        raise TypeError(f"{kind.__name__} has {len(kind._fields_)} members, not {len(value)}")
    # A pose may be one row of numbers, too.
    if not is_flat and not hasattr(value[0], "__len__") and issubclass(kind._fields_[0][1], Value):
        numbers = iter(value)
        result = _of_numbers(kind, numbers)
        if next(numbers, None) is not None:
            raise TypeError(f"{kind.__name__} has fewer numbers than {len(value)}")
        return result
    return kind(*value)


def _of_numbers(kind, numbers):
    if not issubclass(kind, Value):
        number = next(numbers, None)
        if number is None:
            raise TypeError("a struct has more numbers than were given")
        return number
    return kind(*[_of_numbers(field, numbers) for _, field in kind._fields_])


def ctype_of(name, pointers=0):
    kind = _NUMBERS.get(name) or values.get(name) or callbacks.get(name)
    if pointers and (name == "void" or kind is None):
        return ctypes.c_void_p
    return ctypes.POINTER(kind) if pointers else kind


def _make(struct):
    fields = []
    for member in struct["members"]:
        kind = ctype_of(member["type"], member["pointers"])
        fields.append((member["name"], kind * member["array"] if member["array"] else kind))
    default = getattr(library, struct["name"] + "_default", None)
    return type(python_name(struct["name"]), (Value,),
                {"_fields_": fields, "_c_name": struct["name"], "_default": default, "__doc__": struct["doc"]})


# Structs and callbacks use those before them.
_pending = {callback["name"]: callback for callback in api["callbacks"]}
for _struct in api["structs"]:
    for _member in _struct["members"]:
        _callback = _pending.pop(_member["type"], None)
        if _callback:
            callbacks[_callback["name"]] = ctypes.CFUNCTYPE(
                ctypes.c_bool, *[ctype_of(a["type"], a["pointers"]) for a in _callback["arguments"]])
    values[_struct["name"]] = _make(_struct)
for _callback in _pending.values():
    callbacks[_callback["name"]] = ctypes.CFUNCTYPE(
        ctypes.c_bool, *[ctype_of(a["type"], a["pointers"]) for a in _callback["arguments"]])
