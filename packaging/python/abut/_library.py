"""The shared library of the C API, and its description in abut_api.json."""

import ctypes
import json
import keyword
import os
import pathlib
import sys

_HERE = pathlib.Path(__file__).resolve().parent
_NAMES = {"win32": "abut_c.dll", "darwin": "libabut_c.dylib"}


class Error(ValueError):
    """What the library reports about wrong arguments: `code` is such as "NOT_FINITE", `index` that of the element."""

    def __init__(self, code, message, index):
        super().__init__(message)
        self.code = code
        self.index = index


def _without_keywords(entry):
    if keyword.iskeyword(entry.get("name", "")):
        entry["name"] += "_"
    return entry


def _load_description():
    # Beside the package where it is installed; in the sources it lies with the headers.
    for folder in (_HERE, _HERE.parents[2] / "abut" / "c" if len(_HERE.parents) > 2 else _HERE):
        file = folder / "abut_api.json"
        if file.exists():
            return json.loads(file.read_text(encoding="utf-8"), object_hook=_without_keywords)
    raise ImportError(f"abut: abut_api.json is missing in {_HERE}")


def _load_library():
    path = os.environ.get("ABUT_LIBRARY") or _HERE / _NAMES.get(sys.platform, "libabut_c.so")
    try:
        return ctypes.CDLL(str(path))
    except OSError as error:
        raise ImportError(f"abut: can't load {path}; ABUT_LIBRARY names the shared library: {error}") from error


api = _load_description()
library = _load_library()
library.abut_last_error.restype = ctypes.c_char_p
library.abut_last_error_index.restype = ctypes.c_uint32
library.abut_version.restype = ctypes.c_char_p

_codes = {value["value"]: value["name"][5:] for value in api["enums"][0]["values"]}


def check(code):
    """Raises an Error unless the code is ABUT_OK."""
    if code != 0:
        raise Error(_codes[code], library.abut_last_error().decode(), library.abut_last_error_index())


def python_name(c_name):
    """abut_walk_mesh becomes WalkMesh."""
    return "".join(part.capitalize() for part in c_name[5:].split("_"))
