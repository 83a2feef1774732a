"""Arrays in and out: numpy arrays where numpy is installed, sequences and lists where it isn't."""

import ctypes

from ._values import Value, as_value, ctype_of

try:
    import numpy
except ImportError:
    numpy = None

_SCALARS = {
    ctypes.c_float: "f4",
    ctypes.c_double: "f8",
    ctypes.c_bool: "?",
    ctypes.c_uint8: "u1",
    ctypes.c_uint32: "u4",
    ctypes.c_int32: "i4",
    ctypes.c_uint64: "u8",
}


def _flat(kind):
    """(number type, count) if a struct is so many numbers of one type; else None."""
    if kind in _SCALARS:
        return _SCALARS[kind], 1
    parts = [_flat(field) for _, field in kind._fields_ if not hasattr(field, "_length_")]
    if len(parts) == len(kind._fields_) and None not in parts and len({part[0] for part in parts}) == 1:
        return parts[0][0], sum(part[1] for part in parts)
    return None


def _rows(kind):
    """(dtype, shape of an element): a vector, rotation or id is a row of numbers, a pair of ids two rows."""
    if kind in _SCALARS:
        return _SCALARS[kind], ()
    fields = [field for _, field in kind._fields_]
    if all(field is fields[0] for field in fields) and not hasattr(fields[0], "_length_"):
        number, shape = _rows(fields[0])
        return number, (len(fields), *shape)
    return dtype(kind), ()


def dtype(kind):
    """The numpy dtype of a struct; vectors, rotations and ids are rows of numbers."""
    if kind in _SCALARS:
        return numpy.dtype(_SCALARS[kind])
    names, formats, offsets = [], [], []
    for name, field in kind._fields_:
        names.append(name)
        offsets.append(getattr(kind, name).offset)
        if hasattr(field, "_length_"):
            formats.append((dtype(field._type_), field._length_))
        elif issubclass(field, Value) and _flat(field):
            number, count = _flat(field)
            formats.append((number, count))
        else:
            formats.append(dtype(field))
    return numpy.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": ctypes.sizeof(kind)})


class Input:
    """An argument as an array of C. `rows` is the number of its elements in groups of `group`."""

    def __init__(self, data, c_type, group=1):
        kind = ctype_of(c_type)
        self.stride = 0
        if isinstance(data, (bytes, bytearray, memoryview)) and kind is ctypes.c_uint8:
            data = bytes(data)
            self.owned, self.rows = data, len(data)
            self.pointer = ctypes.cast(ctypes.c_char_p(data), ctypes.c_void_p)
        elif numpy is not None:
            self._from_numpy(data, kind, group)
        else:
            self._from_sequence(data, kind, group)

    def _from_numpy(self, data, kind, group):
        structured = isinstance(data, numpy.ndarray) and data.dtype.names is not None
        flat = None if structured else _flat(kind)
        if flat is None:
            rows = data if structured else [as_value(kind, one) for one in data]
            if structured:
                data = numpy.ascontiguousarray(data.astype(dtype(kind), copy=False))
            else:
                data = numpy.frombuffer(b"".join(bytes(one) for one in rows), dtype=dtype(kind))
            width = 1
        else:
            if not isinstance(data, numpy.ndarray):
                data = [_numbers(one) for one in data]
            data = numpy.asarray(data, dtype=flat[0])
            width = flat[1] * group
            if data.ndim != (2 if width > 1 and not (width == 1 or data.ndim == 1) else 1) or (
                    data.ndim == 2 and data.shape[1] != width):
                if data.size == 0:
                    data = data.reshape(0, width)
                elif not (data.ndim == 1 and group > 1):
                    raise ValueError(f"an array of {width} numbers a row is needed, not of shape {data.shape}")
            if data.ndim == 1 and width > 1:
                data = data.reshape(-1, width)
            # An array with gaps between its rows is used as it is; the C API takes a stride.
            if data.ndim == 2 and (data.strides[1] != data.itemsize or data.strides[0] < 0 or group > 1):
                data = numpy.ascontiguousarray(data)
            elif data.ndim == 1:
                data = numpy.ascontiguousarray(data)
            if data.ndim == 2 and len(data) > 1 and data.strides[0] >= width * data.itemsize:
                self.stride = data.strides[0]
            elif data.ndim == 2:
                data = numpy.ascontiguousarray(data)
        self.owned, self.rows = data, len(data)
        self.pointer = ctypes.c_void_p(data.ctypes.data)

    def _from_sequence(self, data, kind, group):
        elements = []
        for one in data:
            if group > 1:
                elements.extend(one if hasattr(one, "__iter__") else [one])
            else:
                elements.append(as_value(kind, one))
        self.owned = (kind * len(elements))(*elements)
        self.rows = len(elements) // group
        self.pointer = ctypes.cast(self.owned, ctypes.c_void_p)


def _numbers(value):
    """A struct or nested sequence as a flat list of numbers."""
    if isinstance(value, (int, float)):
        return value
    result = []
    for one in value:
        inner = _numbers(one) if hasattr(one, "__iter__") else one
        result.extend(inner if isinstance(inner, list) else [inner])
    return result


class Output:
    """An array that the library writes: of numpy, or a list."""

    def __init__(self, c_type, count, group=1):
        self.kind, self.group = ctype_of(c_type), group
        if numpy is not None:
            number, shape = _rows(self.kind)
            if self.kind in _SCALARS and group > 1:
                shape = (group,)
            self.data = numpy.zeros((count, *shape), dtype=number)
            self.pointer = ctypes.c_void_p(self.data.ctypes.data)
        else:
            self.data = (self.kind * (count * group))()
            self.pointer = ctypes.cast(self.data, ctypes.c_void_p)

    def result(self, count):
        if numpy is not None:
            return self.data[:count].copy() if count < len(self.data) else self.data
        if self.group == 1:
            return [self.data[i] for i in range(count)]
        return [tuple(self.data[i * self.group:(i + 1) * self.group]) for i in range(count)]


def copied(pointer, count, c_type):
    """The elements behind a pointer of C, which stays the library's."""
    output = Output(c_type, count)
    if count:
        ctypes.memmove(output.pointer, pointer, count * ctypes.sizeof(output.kind))
    return output.result(count)
