# SPDX-License-Identifier: MIT
# MPI that is there to run programs alone is no MPI, and no error.
#
# -DSOURCE= -DWORK= -DCOMPILER= -DGENERATOR=
file(REMOVE_RECURSE ${WORK})
file(WRITE ${WORK}/source/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.22)\nproject(trial CXX)\nset(CMAKE_IGNORE_PATH \${WITHOUT})\ninclude(${SOURCE}/cmake/mpi_for_programs.cmake)\n"
  "if(NOT tetmend_mpi_lacks)\n  find_package(MPI 3.1 QUIET COMPONENTS CXX)\nendif()\n"
  "message(STATUS \"found: '\${MPI_CXX_FOUND}'\")\n")
# As the wrappers of Open MPI without libopenmpi-dev.
foreach(name mpicxx mpic++ mpiCC)
  file(WRITE ${WORK}/bin/${name} "#!/bin/sh\nfolder=${WORK}/nowhere/include\ncase \"$*\" in\n"
    "  *link*) echo -L$folder -lmpi ;;\n  *compile*) echo -I$folder ;;\n  *incdirs*) echo $folder ;;\n"
    "  -show*) echo g++ -I$folder -L$folder -lmpi ;;\n  *) exit 1 ;;\nesac\n")
  file(CHMOD ${WORK}/bin/${name} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endforeach()
# Where not even these are, pkg-config may name such folders.
file(WRITE ${WORK}/pkg/pkg-config
  "#!/bin/sh\ncase \"$*\" in\n  *--version*) echo 1.8.1 ;;\n  *--cflags*) echo -I${WORK}/nowhere/include ;;\nesac\n")
file(CHMOD ${WORK}/pkg/pkg-config PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
find_program(wrapper NAMES mpicxx)
get_filename_component(with_wrapper "${wrapper}" DIRECTORY)

foreach(of IN ITEMS bin pkg)
  set(ENV{PATH} "${WORK}/${of}:$ENV{PATH}")
  set(options "")
  if(of STREQUAL "pkg")
    set(options "-DWITHOUT=${WORK}/bin\;${with_wrapper}\;/usr/bin\;/bin" -DPKG_CONFIG_EXECUTABLE=${WORK}/pkg/pkg-config)
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/source -B ${WORK}/build-${of} -G ${GENERATOR}
                          -DCMAKE_CXX_COMPILER=${COMPILER} ${options}
                  RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0 OR NOT said MATCHES "found: ''" OR
     NOT said MATCHES "to run programs alone: there is no ${WORK}/nowhere")
    message(FATAL_ERROR "${of}: status ${status}\n${said}")
  endif()
endforeach()
