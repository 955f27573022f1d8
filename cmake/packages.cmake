# Debian packages, by cpack: tetmend, tetmend-viewer, tetmend-mpi, libtetmend0.1, libtetmend-dev, python3-tetmend. script/package makes them
# of a build of its own, whose folders are Debian's. What else a package of Debian has, packaging/debian/ adds.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tetmend)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/debian/complete.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/debian/repack.cmake)
set(CPACK_PROJECT_SOURCE ${PROJECT_SOURCE_DIR})  # for these scripts

set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Who hands packages on gives a name and an address that answers: Debian's tools take them from these variables as well.
set(maintainer "The tetmend authors <tetmend@tetmend.invalid>")
if(DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(TETMEND_PACKAGE_MAINTAINER ${maintainer} CACHE STRING "Maintainer of the Debian packages: NAME <ADDRESS>")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${TETMEND_PACKAGE_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${tetmend_address})
set(CPACK_DEBIAN_PACKAGE_SOURCE tetmend)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

# tetmend_package(COMPONENT NAME SECTION SUMMARY DESCRIPTION [DEPENDS ...]): the summary and the description are what apt shows.
macro(tetmend_package component name section summary description)
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}\n${description}")
  set(depends ${ARGN})
  list(JOIN depends ", " CPACK_DEBIAN_${key}_PACKAGE_DEPENDS)
endmacro()

set(CPACK_COMPONENTS_ALL "")
set(surface_stays "It removes slivers and raises the worst dihedral angles, while surface, labels\nand constraints stay exactly as they are.")
if(BUILD_SHARED_LIBS)
  tetmend_package(library libtetmend0.1 libs "improvement of tetrahedral meshes - library"
    "libtetmend improves tetrahedral meshes.\n${surface_stays}\n\nThis package has the shared library.")
  set(library_itself "libtetmend0.1 (= ${version})")
endif()
tetmend_package(development libtetmend-dev libdevel "improvement of tetrahedral meshes - development files"
  "libtetmend improves tetrahedral meshes.\n${surface_stays}\n\nThis package has the headers for C++ and C, a module for Fortran, and what\nCMake and pkg-config need to find the library. Operators of one's own need\nEigen as well: libeigen3-dev."
  ${library_itself})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS libeigen3-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS tetmend)
if(TARGET tetmend)
  # By hand: HDF5, which is opened when a file of it is met.
  tetmend_package(program tetmend science "improvement of tetrahedral meshes - command line"
    "tetmend improves tetrahedral meshes.\n${surface_stays}\nIt reads and writes the files of Gmsh, VTK, MEDIT, TetGen, SU2, Netgen,\nNastran, Abaqus, CalculiX, LS-DYNA, FEBio, MFEM, Elmer, Salome, and universal files."
    ${hdf5_name_package})
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "tetmend-viewer")
endif()
if(TARGET tetmend-view)
  # By hand: libraries that epoxy and GLFW open as they run, which no program is linked with; drivers; the font.
  tetmend_package(viewer tetmend-viewer science "improvement of tetrahedral meshes - viewer"
    "tetmend-view shows where a tetrahedral mesh is bad, improves it as you watch,\nand steps through recorded runs call by call. It draws pictures without a\ndisplay, too."
    libgl1 libegl1 libopengl0 libgl1-mesa-dri libxcursor1 libxi6 libxinerama1 libxrandr2 libxrender1 libx11-xcb1
    libxxf86vm1 fonts-dejavu-core "tetmend (= ${version})")  # which has the lessons
endif()
if(TARGET tetmend-mpi)
  tetmend_package(mpi tetmend-mpi science "improvement of tetrahedral meshes - by many processes"
    "tetmend-mpi improves tetrahedral meshes in pieces, by many processes of Open\nMPI on one machine or several.\n${surface_stays}"
    openmpi-bin "tetmend (= ${version})")  # whose page describes the options
endif()
if(TARGET tetmend_python AND BUILD_SHARED_LIBS)
  get_target_property(python tetmend_python TETMEND_PYTHON_VERSION)
  string(REGEX MATCH "^3\\.([0-9]+)$" python ${python})
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  tetmend_package(python python3-tetmend python "improvement of tetrahedral meshes - Python 3 package"
    "libtetmend improves tetrahedral meshes.\n${surface_stays}\n\nThis package has the module tetmend for Python, with arrays of numpy in and\nout, and bridges to Gmsh, meshio, VTK and PyVista."
    ${library_itself} "python3 (>= ${python})" "python3 (<< 3.${next})" python3-numpy)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-gmsh, python3-meshio, python3-vtk9")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/packaging/debian/postinst ${PROJECT_SOURCE_DIR}/packaging/debian/prerm)
endif()
include(CPack)
