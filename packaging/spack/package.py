# SPDX-License-Identifier: MIT
"""A package for Spack: put it into packages/tetmend/ of a repository of your own and add the address of a clone as `git`.

What was run: script/recipes, on 2026-11-25, which reads it and gives its options to CMake. Not run: spack. With +mpi there are no files of
HDF5: tetmend looks for them under the name of Debian's package, hdf5-openmpi.
"""

from spack.package import *


class Tetmend(CMakePackage):
    """Improves tetrahedral meshes and keeps their surface: command line, C++ library, Python package."""

    homepage = "https://tetmend.invalid"
    license("MIT")

    version("main", branch="main")

    variant("shared", default=True, description="Build a shared library")
    variant("python", default=False, description="Build the Python package")
    variant("mpi", default=False, description="Build tetmend-mpi, for meshes in pieces on many processes")
    variant("surface", default=False, description="Build the command surface")

    depends_on("cxx", type="build")
    depends_on("cmake@3.21:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("python@3:", type="build")
    depends_on("eigen@3.4:", type="build")
    depends_on("fast-float", type="build")
    depends_on("cli11@2:", type="build")
    depends_on("nlohmann-json@3:", type="build")
    depends_on("fmt@9:")
    depends_on("tbb")
    depends_on("zstd")
    depends_on("pugixml")
    depends_on("zlib-api")
    depends_on("lua@5.4")
    depends_on("mpi", when="+mpi")
    depends_on("openmesh", when="+surface")
    extends("python", when="+python")
    depends_on("python@3.11:", when="+python", type=("build", "link", "run"))
    depends_on("py-pybind11", when="+python", type="build")
    depends_on("py-numpy", when="+python", type=("build", "run"))

    conflicts("%gcc@:11", msg="tetmend is written in C++20")

    def cmake_args(self):
        args = [
            self.define("TETMEND_BUILD_TESTS", False),
            self.define("TETMEND_BUILD_VIEWER", False),
            self.define("TETMEND_LUA", "lua5.4;lua"),
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("TETMEND_BUILD_PYTHON", "python"),
            self.define_from_variant("TETMEND_MPI", "mpi"),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_OpenMesh", not self.spec.satisfies("+surface")),
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("PYTHON_EXECUTABLE", python.path))
            args.append(self.define("TETMEND_PYTHON_DIR", python_platlib))
        return args
