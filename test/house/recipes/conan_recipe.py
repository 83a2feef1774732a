"""Runs the recipe for Conan with stand-ins for Conan's classes: its options and libraries must exist.

conan_recipe.py CONANFILE BUILD
"""
import importlib.util
import pathlib
import sys
import types
from collections import defaultdict


class Record:
    """Accepts each call, and stores what is assigned."""

    def __init__(self, *_):
        self.cache_variables = {}
        self.properties = {}
        self.components = defaultdict(Record)

    def set_property(self, *arguments):
        self.properties[arguments[:-1]] = arguments[-1]

    def __getattr__(self, name):
        return lambda *arguments, **named: None


toolchains = []


class Toolchain(Record):
    def __init__(self, recipe):
        super().__init__()
        toolchains.append(self)


class Recipe:
    def __init__(self):
        self.cpp_info = Record()
        self.settings = types.SimpleNamespace(os="Linux")
        self.required = []

    def requires(self, reference, **_):
        self.required.append(reference.split("/")[0])


def stand_in(name, **members):
    module = types.ModuleType(name)
    module.__dict__.update(members)
    sys.modules[name] = module


stand_in("conan", ConanFile=Recipe)
stand_in("conan.tools")
stand_in("conan.tools.cmake", CMake=Record, CMakeDeps=Record, CMakeToolchain=Toolchain, cmake_layout=Record)
stand_in("conan.tools.files", copy=Record, rmdir=Record)
stand_in("conan.tools.microsoft", is_msvc=lambda recipe: False)

conanfile, build = map(pathlib.Path, sys.argv[1:])
spec = importlib.util.spec_from_file_location("conanfile", conanfile)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
recipe = module.AbutConan()
recipe.requirements()
recipe.generate()
recipe.package_info()

faults = []
cache = {line.split(":")[0] for line in (build / "CMakeCache.txt").read_text().splitlines() if ":" in line}
faults += ["there is no option " + name for name in toolchains[0].cache_variables if name not in cache]
for name, component in recipe.cpp_info.components.items():
    faults += ["there is no library " + library for library in component.libs if not (build / f"lib{library}.a").exists()]
    for needed in component.requires:
        known = recipe.required if "::" in needed else recipe.cpp_info.components
        if needed.split("::")[0] not in known:
            faults.append(f"{name} needs {needed}, which the recipe doesn't name")
if len(recipe.cpp_info.components) < 4 or not toolchains[0].cache_variables:
    faults.append("the recipe has too few libraries or options")
print("\n".join(faults) or "the recipe's options and libraries exist")
sys.exit(1 if faults else 0)
