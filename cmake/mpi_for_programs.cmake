# SPDX-License-Identifier: MIT
# Sets tetmend_mpi_lacks to a folder where MPI is here to run programs alone: its compiler wrapper, or pkg-config where there
# is none, names folders that are not there, of which FindMPI makes an error.
find_program(tetmend_mpi_wrapper NAMES ${MPI_CXX_COMPILER} mpicxx mpic++ mpiCC NO_CACHE)
set(tetmend_mpi_flags "")
if(tetmend_mpi_wrapper)
  execute_process(COMMAND ${tetmend_mpi_wrapper} -show OUTPUT_VARIABLE tetmend_mpi_flags ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
elseif(PKG_CONFIG_EXECUTABLE)
  execute_process(COMMAND ${PKG_CONFIG_EXECUTABLE} --cflags-only-I mpi-cxx OUTPUT_VARIABLE tetmend_mpi_flags ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
string(REGEX MATCHALL "-I *[^ ]+" tetmend_mpi_folders "${tetmend_mpi_flags}")
set(tetmend_mpi_lacks "")
foreach(folder IN LISTS tetmend_mpi_folders)
  string(REGEX REPLACE "^-I *" "" folder "${folder}")
  if(NOT IS_DIRECTORY "${folder}")
    set(tetmend_mpi_lacks "${folder}")
  endif()
endforeach()
if(tetmend_mpi_lacks)
  message(STATUS "MPI is here to run programs alone: there is no ${tetmend_mpi_lacks}")
endif()
