# tetmend::tetmend, what users link: all layers as one shared library. What it is made with is its own affair: users see
# include/tetmend and need nothing else.
set(tetmend_layers kernel trace search ops contract schedule face)

add_library(tetmend_library SHARED)
add_library(tetmend::tetmend ALIAS tetmend_library)
foreach(layer IN LISTS tetmend_layers)
  target_sources(tetmend_library PRIVATE $<TARGET_OBJECTS:tetmend_${layer}>)
endforeach()
target_include_directories(tetmend_library INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(tetmend_library INTERFACE cxx_std_20)
# The layers are linked for the sake of the libraries that they need: their code is here already.
target_link_libraries(tetmend_library PRIVATE $<BUILD_INTERFACE:tetmend_face> $<BUILD_INTERFACE:tetmend_flags>)
target_link_options(tetmend_library PRIVATE
  -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map -Wl,-Bsymbolic-functions -Wl,--as-needed)
if(NOT TETMEND_SANITIZE)
  target_link_options(tetmend_library PRIVATE -Wl,--no-undefined)  # sanitizers are in the program
endif()
set_target_properties(tetmend_library PROPERTIES
  OUTPUT_NAME tetmend EXPORT_NAME tetmend LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION} SOVERSION 0
  LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exports.map)
