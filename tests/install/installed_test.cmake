# SPDX-License-Identifier: MIT
# Installs tetmend into a folder of its own, and builds against it, with find_package alone, what a stranger would: the
# plugin of plugins/ and a program that uses the library. Then runs both.
#   cmake -DBUILD=... -DSOURCE=... -DWORK=... -DCOMPILER=... -DGENERATOR=... -DLAUNCHER=... -DFLAGS=... -P installed_test.cmake
cmake_minimum_required(VERSION 3.21)

# run(COMMAND...): sets `output`; stops with all that was said when the status is not 0.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " line)
    message(FATAL_ERROR "${line}\nended with ${status}:\n${out}")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()

function(expect text)
  string(FIND "${output}" "${text}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "'${text}' is missing in:\n${output}")
  endif()
endfunction()

function(build source folder)
  run(${CMAKE_COMMAND} -S ${source} -B ${folder} -G "${GENERATOR}" -DCMAKE_CXX_COMPILER=${COMPILER}
      -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_PREFIX_PATH=${WORK}/prefix "-DCMAKE_CXX_FLAGS=${FLAGS}"
      -DCMAKE_BUILD_TYPE=Release)
  run(${CMAKE_COMMAND} --build ${folder})
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
# Nothing of the installed package may point back to where it was built.
file(GLOB_RECURSE package ${WORK}/prefix/*.cmake)
foreach(file IN LISTS package)
  file(READ ${file} content)
  string(FIND "${content}" "${SOURCE}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} names ${SOURCE}")
  endif()
endforeach()

set(program ${WORK}/prefix/bin/tetmend)
set(plugin ${WORK}/plugins/odt_smoothing.so)
build(${SOURCE}/plugins ${WORK}/plugins)
run(${program} operators --plugin ${plugin} odt_smoothing)
expect("plugin: ${plugin}")
run(${CMAKE_COMMAND} -E env TETMEND_PLUGIN_PATH=${WORK}/plugins ${program} operators)
expect("odt_smoothing")
run(${program} check-plugin ${plugin})
expect("odt_smoothing keeps its contract")

build(${SOURCE}/tests/install/library_user ${WORK}/library_user)
run(${WORK}/library_user/library_user ${SOURCE}/assets/meshes/sheet.mesh ${WORK}/better.meshb ${plugin})
expect("odt_smoothing: ")
run(${program} quality ${WORK}/better.meshb)
