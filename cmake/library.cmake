# tetmend::tetmend, what users link: all layers as one library, a shared one unless BUILD_SHARED_LIBS is off. What it is made
# with is its own affair: users see include/tetmend and need nothing else.
set(tetmend_layers platform kernel trace search envelope ops contract schedule face bindings_c)
if(TARGET tetmend_pieces)
  list(APPEND tetmend_layers pieces)
endif()

if(WIN32)
  set(BUILD_SHARED_LIBS OFF)  # a DLL shows nothing that is not marked for it
elseif(NOT DEFINED BUILD_SHARED_LIBS)
  set(BUILD_SHARED_LIBS ON)
endif()
add_library(tetmend_library)
add_library(tetmend::tetmend ALIAS tetmend_library)
set(tetmend_libraries_inside "")
foreach(layer IN LISTS tetmend_layers)
  target_sources(tetmend_library PRIVATE $<TARGET_OBJECTS:tetmend_${layer}>)
  get_target_property(libraries tetmend_${layer} LINK_LIBRARIES)
  list(APPEND tetmend_libraries_inside ${libraries})
endforeach()
target_include_directories(tetmend_library INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(tetmend_library INTERFACE cxx_std_20)
# The layers are linked for the sake of the libraries that they need: their code is here already.
target_link_libraries(tetmend_library PRIVATE $<BUILD_INTERFACE:tetmend_bindings_c> $<BUILD_INTERFACE:$<TARGET_NAME_IF_EXISTS:tetmend_pieces>> $<BUILD_INTERFACE:tetmend_flags>)
set_target_properties(tetmend_library PROPERTIES OUTPUT_NAME tetmend EXPORT_NAME tetmend LINKER_LANGUAGE CXX)
if(BUILD_SHARED_LIBS)
  if(NOT APPLE)
    target_link_options(tetmend_library PRIVATE
      -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map -Wl,-Bsymbolic-functions -Wl,--as-needed)
  endif()
  if(NOT APPLE AND NOT TETMEND_SANITIZE AND NOT TETMEND_SANITIZE_THREADS)
    target_link_options(tetmend_library PRIVATE -Wl,--no-undefined)  # sanitizers are in the program
  endif()
  set_target_properties(tetmend_library PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exports.map)
endif()

# What a program must link besides, where the library is installed as a static one: names for the linker. Of a library that
# comes by pkg-config the module knows them; the others are headers, but for those named here.
set(tetmend_static_libraries stdc++ m)
list(REMOVE_DUPLICATES tetmend_libraries_inside)
foreach(library IN LISTS tetmend_libraries_inside)
  if(library MATCHES "PkgConfig::([A-Za-z0-9_]+)")  # also within a generator expression: a choice of Lua
    list(APPEND tetmend_static_libraries ${${CMAKE_MATCH_1}_LIBRARIES})
  elseif(library MATCHES "^(fmt)::fmt$|^TBB::(tbb)$")
    list(APPEND tetmend_static_libraries ${CMAKE_MATCH_1}${CMAKE_MATCH_2})
  elseif(library STREQUAL "${CMAKE_DL_LIBS}")
    list(APPEND tetmend_static_libraries ${library})
  endif()
endforeach()
list(REMOVE_DUPLICATES tetmend_static_libraries)
