# A recipe of the sources around it: conan create packaging/conan
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rmdir
from conan.tools.microsoft import is_msvc


class AbutConan(ConanFile):
    name = "abut"
    version = "0.1.0"
    description = "Collision detection for games, in 2D and 3D"
    license = "MIT"
    topics = ("collision-detection", "games", "geometry")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "abut/*", "cmake/*", "packaging/debug/*"):
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("glm/0.9.9.8", transitive_headers=True)
        self.requires("highway/1.0.7")

    def generate(self):
        # The names by which the sources look for it.
        deps = CMakeDeps(self)
        deps.set_property("highway", "cmake_file_name", "hwy")
        deps.set_property("highway", "cmake_target_name", "hwy::hwy")
        deps.generate()
        toolchain = CMakeToolchain(self)
        for option in ("IO", "RECAST", "TOOL", "TESTS", "EXAMPLES", "WERROR"):
            toolchain.cache_variables["ABUT_" + option] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # Conan writes these itself.
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "abut")
        needs = {
            "abut": ["glm::glm", "highway::highway"],
            "bake": ["abut"],
            "draw": ["bake"],
            "c": ["bake"],
        }
        for name, requires in needs.items():
            component = self.cpp_info.components[name]
            library = "abut" if name == "abut" else "abut_" + name
            component.set_property("cmake_target_name", "abut::" + name)
            component.set_property("pkg_config_name", library.replace("_", "-"))
            component.libs = [library]
            component.requires = requires
        # The same bits in the headers as in the library: no product and sum in one rounding.
        core = self.cpp_info.components["abut"]
        core.cxxflags = ["/fp:strict"] if is_msvc(self) else ["-ffp-contract=off"]
        if self.settings.os in ("Linux", "FreeBSD"):
            core.system_libs = ["pthread", "m"]
