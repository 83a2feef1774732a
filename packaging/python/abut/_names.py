"""Where each function of C is found in Python: a method, a constructor, or a function of the module.

The rules are those of abut_api.json alone, so that the stub file and the package agree.
"""

from ._library import api, python_name

HANDLES = [handle["name"] for handle in api["handles"] if handle["name"] not in ("abut_buffer",)]
STRUCTS = [struct["name"] for struct in api["structs"]]
# Functions of two shapes, which the module has as well, as in C++.
OF_PAIRS = ("overlaps", "closest", "contact", "each_contact", "certify", "intersection", "minkowski_sum",
            "minkowski_difference")
# How a handle is made by its class.
CONSTRUCTORS = ("create", "build")


def _owner(name, owners):
    """The owner whose name begins the name of the function."""
    fitting = [owner for owner in owners if name.startswith(owner + "_")]
    return max(fitting, key=len) if fitting else None


def _constructor_names():
    both = {f["name"].replace("abut_shape2_", "abut_shape3_") for f in api["functions"] if "abut_shape2_" in f["name"]}
    both &= {f["name"] for f in api["functions"]}
    return both


_IN_BOTH = _constructor_names()
# The values that shapes are made of: Box3(...) is a shape.
SHAPE_STRUCTS = [f["arguments"][0]["type"] for f in api["functions"]
                 if f["name"].startswith("abut_shape") and f["arguments"][0]["type"] in STRUCTS and
                 f["arguments"][0]["pointers"] == 0]


def place_of(function):
    """(owner, name, kind): kind is method, constructor, static or function; None for what Python does by itself."""
    name = function["name"]
    if name.startswith("abut_buffer") or name.startswith("abut_last") or name.endswith(("_release", "_default", "_version")):
        return None
    first = function["arguments"][0]
    owner = _owner(name, HANDLES)
    if owner is None:
        owner = _owner(name, STRUCTS)
        if owner is None:
            return None, name[5:], "function"
        return owner, name[len(owner) + 1:], "method" if first["type"] == owner else "static"
    short = name[len(owner) + 1:]
    if first["type"] == owner and first["pointers"] == 1:
        return owner, short, "method"
    if short in CONSTRUCTORS:
        return owner, short, "constructor"
    if owner.startswith("abut_shape") and short != "load":
        # Sphere(...), Mesh(...): shapes are named as in C++.
        dimension = owner[-1] if name.replace("abut_shape2_", "abut_shape3_") in _IN_BOTH else ""
        return None, python_name("abut_" + short) + dimension, "function"
    return owner, short, "static"
