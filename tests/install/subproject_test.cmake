# SPDX-License-Identifier: MIT
# A project that takes tetmend in by FetchContent configures the library alone: fewer than 100 compilations, no viewer, no
# tests, no programs, nothing to be installed. It is only configured: to build it is to build the library once more.
#   cmake -DSOURCE=... -DWORK=... -DCOMPILER=... -DGENERATOR=... -P subproject_test.cmake
cmake_minimum_required(VERSION 3.21)
file(REMOVE_RECURSE ${WORK})
# `shared` and `static` are what BUILD_SHARED_LIBS says; without it the library is shared.
foreach(kind IN ITEMS shared static)
  set(option "")
  if(kind STREQUAL "static")
    set(option -DBUILD_SHARED_LIBS=OFF)
  endif()
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/install/subproject_user -B ${WORK}/${kind} -G ${GENERATOR} ${option}
            -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
            -DTETMEND_ARCHIVE=tetmend.tar.gz -DFETCHCONTENT_SOURCE_DIR_TETMEND=${SOURCE}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${output}")
  endif()
  file(STRINGS ${WORK}/${kind}/compile_commands.json sources REGEX "\"file\":")
  list(LENGTH sources count)
  message(STATUS "${kind}: ${count} compilations")
  if(count LESS 2 OR NOT count LESS 120)
    message(FATAL_ERROR "${count} compilations are configured")
  endif()
  if("${sources};${output}" MATCHES "/viewer/|/tests/[a-z]+/[a-z_]+_test|/apps/|glfw|doctest|CLI11")
    message(FATAL_ERROR "the project gets more than the library: ${CMAKE_MATCH_0}")
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/${kind} --target help OUTPUT_VARIABLE targets)
  set(expected "libtetmend\\.so")
  if(kind STREQUAL "static")
    set(expected "libtetmend\\.a")
  endif()
  if(NOT targets MATCHES "${expected}")
    message(FATAL_ERROR "no ${expected} among the targets:\n${targets}")
  endif()
endforeach()
file(REMOVE_RECURSE ${WORK})
