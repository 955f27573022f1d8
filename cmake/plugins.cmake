# The two sides of a plugin.
#
# tetmend::plugin       for a shared library that adds operators: headers only. Its code is in the program that loads it,
#                       or in libtetmend.so; a copy of its own would only be a second one of the same.
# tetmend_plugin_host   for a program of this build that loads plugins: all of kernel, trace, search and ops is linked and
#                       exported, whether the program itself uses it or not. Programs elsewhere have libtetmend.so.
set(TETMEND_PLUGIN_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/tetmend/plugin)
add_library(tetmend_plugin INTERFACE)
add_library(tetmend::plugin ALIAS tetmend_plugin)
target_include_directories(tetmend_plugin INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${TETMEND_PLUGIN_INCLUDE_DIR}>)
target_compile_features(tetmend_plugin INTERFACE cxx_std_20)
target_compile_options(tetmend_plugin INTERFACE -ffp-contract=off)  # the same bits for every instruction set
target_link_libraries(tetmend_plugin INTERFACE Eigen3::Eigen)
set_target_properties(tetmend_plugin PROPERTIES EXPORT_NAME plugin)

add_library(tetmend_plugin_host INTERFACE)
target_link_libraries(tetmend_plugin_host INTERFACE tetmend_ops ${CMAKE_DL_LIBS})
set(whole_libraries "")
foreach(layer IN ITEMS ops search trace kernel)
  string(APPEND whole_libraries " $<TARGET_FILE:tetmend_${layer}>")
endforeach()
target_link_options(tetmend_plugin_host INTERFACE
  -rdynamic "SHELL:-Wl,--whole-archive${whole_libraries} -Wl,--no-whole-archive")
