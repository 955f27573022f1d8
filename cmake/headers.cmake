# What users see that is made of headers of ours, each in one file: <tetmend/plugin.h>, <tetmend/kernel.h>, <tetmend/operators.h>,
# <tetmend/schedule.h>.
set(TETMEND_MADE_HEADERS "")
file(GLOB private_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernel/*.h ${PROJECT_SOURCE_DIR}/trace/*.h
     ${PROJECT_SOURCE_DIR}/ops/*.h ${PROJECT_SOURCE_DIR}/schedule/*.h ${PROJECT_SOURCE_DIR}/face/kernel/*.h)

# tetmend_made_header(NAME PURPOSE ROOMS... HEADERS...)
function(tetmend_made_header name purpose)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "ROOMS;HEADERS")
  set(output ${PROJECT_BINARY_DIR}/include/tetmend/${name})
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} "-DHEADERS=${arg_HEADERS}" "-DROOMS=${arg_ROOMS}"
            -DVERSION=${PROJECT_VERSION} "-DPURPOSE=${purpose}" -DOUTPUT=${output}
            -P ${PROJECT_SOURCE_DIR}/cmake/one_header.cmake
    DEPENDS ${private_headers} ${PROJECT_SOURCE_DIR}/cmake/one_header.cmake VERBATIM)
  set(TETMEND_MADE_HEADERS ${TETMEND_MADE_HEADERS} ${output} PARENT_SCOPE)
endfunction()

tetmend_made_header(plugin.h "All that a plugin needs to add operators to tetmend (docs/operators.md)."
  ROOMS kernel trace ops HEADERS ops/plugin.h kernel/star.h)
tetmend_made_header(kernel.h "Meshes of tets for programs: loops, walks, properties, edits with undo (docs/kernel.md)."
  ROOMS kernel face/kernel HEADERS face/kernel/transaction.h face/kernel/extract.h)
tetmend_made_header(operators.h "Attempts of operators, and operators of a program, on meshes of <tetmend/kernel.h> (docs/kernel.md)."
  ROOMS kernel trace ops face/kernel HEADERS face/kernel/transaction.h face/kernel/extract.h face/kernel/own_operators.h)
tetmend_made_header(schedule.h "Passes and schedules over meshes of <tetmend/kernel.h> (docs/kernel.md)."
  ROOMS kernel trace ops schedule face/kernel HEADERS face/kernel/transaction.h face/kernel/extract.h face/kernel/run.h)
add_custom_target(tetmend_made_headers ALL DEPENDS ${TETMEND_MADE_HEADERS})

# tetmend::kernel: what a program needs besides the library for the three of them.
add_library(tetmend_for_kernel INTERFACE)
add_library(tetmend::kernel ALIAS tetmend_for_kernel)
add_dependencies(tetmend_for_kernel tetmend_made_headers)
target_include_directories(tetmend_for_kernel INTERFACE
  $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_options(tetmend_for_kernel INTERFACE -ffp-contract=off)  # the same bits for every instruction set
target_link_libraries(tetmend_for_kernel INTERFACE tetmend_library Eigen3::Eigen)
set_target_properties(tetmend_for_kernel PROPERTIES EXPORT_NAME kernel)
