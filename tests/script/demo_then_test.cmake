# SPDX-License-Identifier: MIT
# A build folder that script/demo configured has all tests once script/test configures it again. Only configures.
#
#   cmake -DSOURCE=... -DWORK=... -DCOMPILER=... -DGENERATOR=... -P demo_then_test.cmake
cmake_minimum_required(VERSION 3.21)

function(options_of script result)
  file(STRINGS ${SOURCE}/script/${script} lines REGEX "-DTETMEND_")
  string(REGEX MATCHALL "-DTETMEND_[A-Z_]+=[A-Z]+" options "${lines}")
  if(NOT options)
    message(FATAL_ERROR "script/${script} sets no options of CMake")
  endif()
  set(${result} ${options} PARENT_SCOPE)
endfunction()

function(configure)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release
                          -DCMAKE_CXX_COMPILER=${COMPILER} ${ARGN}
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

options_of(demo demo)
options_of(test test)
file(REMOVE_RECURSE ${WORK})
configure(${demo})
configure(${test})
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK} --target help OUTPUT_VARIABLE targets COMMAND_ERROR_IS_FATAL ANY)
foreach(target IN ITEMS tetmend tetmend-view moving_body unit_tests cli_tests gl_tests example_tests)
  if(NOT targets MATCHES "(^|[\n ])${target}[:\n]")
    message(FATAL_ERROR "script/test after script/demo does not build ${target}")
  endif()
endforeach()
file(REMOVE_RECURSE ${WORK})
