"""Functions of C as functions of Python, made by their descriptions.

An argument of Python is left out where it follows from the others: lengths, strides, capacities and outputs. Members of
the options can be given by name.
"""

import ctypes
import re

from ._arrays import Input, Output, copied
from ._library import api, check, library
from ._values import as_value, callback_of, callbacks, ctype_of, values

handles = {}  # by the name of C: the class of Python
_HANDLE_NAMES = {handle["name"] for handle in api["handles"]}
_STRIDES = ("stride", "id_stride", "pose_stride", "place_stride", "step_stride")


def _is_handle(argument, pointers):
    return argument["type"] in _HANDLE_NAMES and argument["pointers"] == pointers


class Function:
    """A function of C. `parameters` are the arguments that Python passes: (name, description, whether it has a default)."""

    def __init__(self, description):
        self.name, self.doc = description["name"], description["doc"]
        self.arguments = description["arguments"]
        self.c_function = getattr(library, self.name)
        self.c_function.restype = ctypes.c_int
        self.c_function.argtypes = [self._c_type(a) for a in self.arguments]
        self.lengths = {}  # name of a length: (array, factor)
        for a in self.arguments:
            match = re.fullmatch(r"(?:(\d) \* )?(\w+)", a["array"] or "")
            if match and a["direction"] == "in":
                self.lengths.setdefault(match[2], (a["name"], int(match[1] or 1)))
        self.has_list = any(a["name"] == "capacity" for a in self.arguments)
        self.list_length = next((a["name"] for a in self.arguments if self.has_list and self._is_length(a)), None)
        self.options = next((a for a in self.arguments if a["name"] == "options" and a["optional"]), None)
        automatic = set(self.lengths) | set(_STRIDES) | {"context", self.list_length}
        # Here the length of the list is part of the question.
        self.takes_k = self.name.endswith("_k_nearest")
        if not self.takes_k:
            automatic.add("capacity")
        parameters = [a for a in self.arguments if a["name"] not in automatic and not self._is_output(a)]
        # Python's arguments with a default come last.
        self.parameters = sorted(parameters, key=lambda a: a["optional"] or self._has_default(a))

    @staticmethod
    def _c_type(a):
        if a["pointers"] or a["array"]:
            return ctypes.c_void_p
        return ctype_of(a["type"])

    @staticmethod
    def _is_length(a):
        return a["direction"] == "out" and a["name"] in ("count", "id_count") and not a["array"]

    @staticmethod
    def _is_output(a):
        return a["direction"] == "out" or (a["type"] == "abut_buffer" and a["name"] == "out")

    def outputs(self):
        return [a for a in self.arguments if self._is_output(a) and a["name"] != self.list_length]

    def __call__(self, *arguments, **named):
        given = self._bind(arguments, named)
        # Most lists are short; a longer one is read again with its full length.
        capacity = int(given["capacity"]) if self.takes_k else 64
        while True:
            owned, outputs, length = self._call(given, capacity)
            if length is None or self.takes_k or length <= capacity:
                break
            capacity = length
        result = self._results(outputs, length)
        # The library keeps this callback until the handle is released, and copies of it do too.
        if self.name.endswith("_set_pair_filter"):
            arguments[0]._callbacks = (*arguments[0]._callbacks, owned)
        elif self.name.endswith("_copy"):
            result._callbacks = arguments[0]._callbacks
        return result

    def _bind(self, arguments, named):
        given, options = {}, {}
        names = [a["name"] for a in self.parameters]
        if "k" in named and self.takes_k:
            named["capacity"] = named.pop("k")
        if len(arguments) > len(names):
            raise TypeError(f"{self.name} takes {len(names)} arguments, not {len(arguments)}")
        given.update(zip(names, arguments))
        for name, value in named.items():
            if name in given:
                raise TypeError(f"{self.name} got {name} twice")
            if name in names:
                given[name] = value
            elif self.options:
                options[name] = value
            else:
                raise TypeError(f"{self.name} has no argument {name}")
        if options:
            if given.get("options") is not None:
                raise TypeError(f"{self.name} takes options as one or by their names")
            given["options"] = options
        for a in self.parameters:
            if a["name"] not in given and not a["optional"] and not self._has_default(a):
                raise TypeError(f"{self.name} needs {a['name']}")
        return given

    @staticmethod
    def _has_default(a):
        return a["name"] in ("max_vertices", "closed", "one_sided", "holes", "concavity", "workers", "softness")

    def _default(self, a):
        if a["name"] == "softness":
            return 0.05
        return () if a["array"] else 0

    def _call(self, given, capacity):
        owned, c_arguments, lengths, outputs = [], {}, {}, []
        stride_of = None
        for a in self.arguments:
            name = a["name"]
            if name in _STRIDES:
                c_arguments[name] = stride_of or 0
            elif a["array"] and a["direction"] == "in":
                c_arguments[name], stride_of = self._input(a, given, lengths, owned)
            elif a in self.parameters:
                c_arguments[name] = self._single(a, given, owned)
        lengths["capacity"] = capacity
        for name in self.lengths:
            c_arguments[name] = lengths.get(name, 0)
        if self.has_list:
            c_arguments["capacity"] = capacity
        for a in self.arguments:
            if not self._is_output(a):
                continue
            if a["name"] == self.list_length:
                length = ctypes.c_uint32()
                c_arguments[a["name"]] = ctypes.byref(length)
            else:
                output, c_arguments[a["name"]] = self._output(a, lengths)
                outputs.append((a, output))
        check(self.c_function(*[c_arguments.get(a["name"]) for a in self.arguments]))
        return owned, outputs, length.value if self.list_length else None

    def _input(self, a, given, lengths, owned):
        data = given.get(a["name"], None if a["optional"] else self._default(a))
        if data is None:
            return None, 0
        if a["pointers"] == 2:
            data = list(data)
            array = (ctypes.c_void_p * len(data))(*[one._handle(a["type"]) for one in data])
            owned.append((array, data))
            rows, pointer, stride = len(data), ctypes.cast(array, ctypes.c_void_p), 0
        else:
            match = re.fullmatch(r"(?:(\d) \* )?(\w+)", a["array"])
            array = Input(data, a["type"], int(match[1] or 1) if match else 1)
            owned.append(array)
            rows, pointer, stride = array.rows, array.pointer, array.stride
        length = a["array"].split(" * ")[-1] if self.lengths else None
        if length in self.lengths and lengths.setdefault(length, rows) != rows:
            raise ValueError(f"{self.name}: {a['name']} has {rows} elements, where {lengths[length]} are needed")
        if "*" in a["array"] and length not in self.lengths:
            needed = 1
            for part in a["array"].split(" * "):
                needed *= int(given[part])
            if rows != needed:
                raise ValueError(f"{self.name}: {a['name']} has {rows} elements, where {needed} are needed")
        return pointer, stride

    def _single(self, a, given, owned):
        value = given.get(a["name"], None if a["optional"] else self._default(a) if self._has_default(a) else None)
        if a["type"] in callbacks:
            value = callbacks[a["type"]]() if value is None else callbacks[a["type"]](callback_of(value))
        elif _is_handle(a, 1):
            if value is None and a["optional"]:
                return None
            if not isinstance(value, handles[a["type"]]):
                raise TypeError(f"{self.name}: {a['name']} is no {handles[a['type']].__name__}")
            owned.append(value)
            return value._handle(a["type"])
        elif a["pointers"]:
            if value is None:
                return None
            value = as_value(values[a["type"]], value)
            owned.append(value)
            return ctypes.byref(value)
        elif a["type"] in values:
            value = as_value(values[a["type"]], value)
        owned.append(value)
        return value

    def _output(self, a, lengths):
        if a["type"] == "abut_buffer" and a["pointers"] == 1:
            buffer = ctypes.c_void_p()
            check(library.abut_buffer_create(ctypes.byref(buffer)))
            return buffer, buffer
        if a["array"]:
            match = re.fullmatch(r"(?:(\d) \* )?(\w+)", a["array"])
            output = Output(a["type"], lengths[match[2]], int(match[1] or 1))
            return output, output.pointer
        kind = ctypes.c_void_p if a["pointers"] == 2 else ctype_of(a["type"])
        value = kind.__new__(kind) if a["type"] in values else kind()
        if a["type"] in values:
            ctypes.Structure.__init__(value)
        return value, ctypes.byref(value)

    def _results(self, outputs, length):
        results = []
        for a, output in outputs:
            if isinstance(output, Output):
                results.append(output.result(length if a["array"].endswith("capacity") else len(output.data)))
            elif a["type"] == "abut_buffer":
                data = library.abut_buffer_data(output)
                results.append(ctypes.string_at(data, library.abut_buffer_size(output)) if data else b"")
                library.abut_buffer_release(output)
            elif a["pointers"] == 2:
                results.append(handles[a["type"]]._owning(output.value) if output.value else None)
            elif a["type"] in values:
                results.append(output)
            else:
                results.append(output.value)
        return results[0] if len(results) == 1 else tuple(results) if results else None


class Handle:
    """The base of what the library owns. It is freed with the object, or before by `release`."""

    _pointer = None
    _callbacks = ()

    @classmethod
    def _owning(cls, pointer):
        result = cls.__new__(cls)
        result._pointer = pointer
        return result

    def _handle(self, c_name):
        if c_name != self._c_name:
            raise TypeError(f"a {handles[c_name].__name__} is needed, not a {type(self).__name__}")
        if not self._pointer:
            raise ValueError(f"this {type(self).__name__} was released")
        return self._pointer

    def release(self):
        """Frees it now."""
        if self._pointer:
            self._release(ctypes.c_void_p(self._pointer))
            self._pointer = None

    def __del__(self):
        self.release()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.release()


library.abut_buffer_data.restype = ctypes.c_void_p
library.abut_buffer_size.restype = ctypes.c_size_t
for _name in ("abut_buffer_data", "abut_buffer_size", "abut_buffer_release"):
    getattr(library, _name).argtypes = [ctypes.c_void_p]
    if _name.endswith("release"):
        getattr(library, _name).restype = None

__all__ = ["Function", "Handle", "copied", "handles"]
