# The two sides of a plugin.
#
# tetmend::plugin       for a shared library that adds operators: <tetmend/plugin.h> and no library. The code is in the program that loads
#                       it, or in libtetmend.so; a copy of its own would only be a second one of the same.
# tetmend_plugin_host   for a program of this build that loads plugins: all of kernel, trace, search and ops is linked and
#                       exported, whether the program itself uses it or not. Programs elsewhere have libtetmend.so.
include(cmake/headers.cmake)

add_library(tetmend_plugin INTERFACE)
add_library(tetmend::plugin ALIAS tetmend_plugin)
add_dependencies(tetmend_plugin tetmend_made_headers)
target_include_directories(tetmend_plugin INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(tetmend_plugin INTERFACE cxx_std_20)
target_compile_options(tetmend_plugin INTERFACE -ffp-contract=off)  # the same bits for every instruction set
target_link_libraries(tetmend_plugin INTERFACE Eigen3::Eigen)
set_target_properties(tetmend_plugin PROPERTIES EXPORT_NAME plugin)

add_library(tetmend_plugin_host INTERFACE)
target_link_libraries(tetmend_plugin_host INTERFACE tetmend_ops)
set(whole_libraries "")
foreach(layer IN ITEMS ops search trace kernel)
  if(APPLE)
    string(APPEND whole_libraries " -Wl,-force_load,$<TARGET_FILE:tetmend_${layer}>")
  else()
    string(APPEND whole_libraries " $<TARGET_FILE:tetmend_${layer}>")
  endif()
endforeach()
if(APPLE)
  target_link_options(tetmend_plugin_host INTERFACE -Wl,-export_dynamic "SHELL:${whole_libraries}")
elseif(NOT WIN32)  # a DLL cannot take its code from the program: there are no plugins
  target_link_options(tetmend_plugin_host INTERFACE
    -rdynamic "SHELL:-Wl,--whole-archive${whole_libraries} -Wl,--no-whole-archive")
endif()
