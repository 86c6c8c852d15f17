# SPDX-License-Identifier: MIT
# Conan 2: `conan create .` makes the package; programs find it by find_package(sivid), with the targets and components of
# sivid's own package files (docs/packages.md).
import os
import re

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain, CMakeDeps, cmake_layout
from conan.tools.files import copy, load

required_conan_version = ">=2.0.5"


class Sivid(ConanFile):
    name = "sivid"
    license = "MIT"
    description = "Set-inversion validated identification: which parameters of a dynamic model can explain recorded data, with proof"
    topics = ("interval-arithmetic", "identification", "ode", "header-only")
    settings = "os", "arch", "compiler", "build_type"
    options = {"with_io": [True, False], "with_parallel": [True, False], "library": [True, False]}   # library: libsivid
    default_options = {"with_io": True, "with_parallel": False, "library": False, "boost/*:header_only": True}
    exports_sources = "CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md", "cmake/*", "docs/*", "include/*"
    no_copy_source = True

    def set_version(self):
        text = load(self, os.path.join(self.recipe_folder, "include", "sivid", "version.hpp"))
        self.version = ".".join(re.findall(r"^#define SIVID_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text, re.M))

    def export(self):   # `conan export` reads the version from it, too
        copy(self, "include/sivid/version.hpp", self.recipe_folder, self.export_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("boost/[>=1.74 <2]", transitive_headers=True)
        self.requires("eigen/[>=3.3 <4]", transitive_headers=True)
        if self.options.with_io:
            self.requires("nlohmann_json/[>=3.9 <4]", transitive_headers=True)
        if self.options.with_parallel:
            self.requires("onetbb/[>=2021]", transitive_headers=True)

    def package_id(self):
        if not self.info.options.library:
            self.info.settings.clear()   # headers

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.arch != "x86_64" or self.settings.os != "Linux":
            raise ConanInvalidConfiguration("this recipe is tried on x86-64 Linux with glibc only; copy include/ elsewhere (README)")
        oldest = {"gcc": 12, "clang": 14}.get(str(self.settings.compiler))
        if oldest and int(str(self.settings.compiler.version).split(".")[0]) < oldest:
            raise ConanInvalidConfiguration(f"sivid needs {self.settings.compiler} {oldest} or newer")

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for name in "SIVID_BUILD_TESTS", "SIVID_BUILD_EXAMPLES", "SIVID_BUILD_BENCHMARKS", "SIVID_BUILD_PYTHON":
            toolchain.cache_variables[name] = False
        toolchain.cache_variables["SIVID_LIBRARY"] = bool(self.options.library)
        for name in "SIVID_WITH_MATIO", "SIVID_WITH_URDF", "SIVID_WITH_EXPAT", "SIVID_WITH_TOML":
            toolchain.cache_variables[name] = False   # of the machine, not of Conan
        # What an option does not ask for is not looked for, either.
        for option, package in (("with_io", "nlohmann_json"), ("with_parallel", "TBB")):
            wanted = "REQUIRE" if self.options.get_safe(option) else "DISABLE"
            toolchain.cache_variables[f"CMAKE_{wanted}_FIND_PACKAGE_{package}"] = True
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        if self.options.library:
            cmake.build(target="libsivid")

    def package(self):
        CMake(self).install(component="sivid_headers")
        if self.options.library:
            for component in "sivid_library", "sivid_linking":
                CMake(self).install(component=component)
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        # The package files of sivid itself have its components and sivid::compiled, which Conan could not describe.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.set_property("pkg_config_name", "sivid")
        self.cpp_info.builddirs = [os.path.join("share", "cmake", "sivid")]
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = ["lib"] if self.options.library else []
