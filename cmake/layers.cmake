# tetmend_layer(FOLDER LAYER_BELOW [LIBRARIES...]): one static library per folder; includes are written from the root, those
# of what users see as <tetmend/...>. The library of bindings/c is tetmend_bindings_c.
function(tetmend_layer folder below)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.h)
  string(REPLACE "/" "_" name ${folder})
  list(FILTER sources EXCLUDE REGEX "/kernel/surface\\.(h|cpp)$")  # see tetmend_surface
  list(FILTER sources EXCLUDE REGEX "/kernel/formats/hdf5_(calls|reader|writer)\\.cpp$")  # see tetmend_hdf5
  add_library(tetmend_${name} STATIC ${sources})
  target_include_directories(tetmend_${name} PUBLIC ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
  target_compile_features(tetmend_${name} PUBLIC cxx_std_20)
  target_link_libraries(tetmend_${name} PUBLIC ${below} ${ARGN} PRIVATE tetmend_flags)
  # The same objects make the shared library, which shows what is marked TETMEND_API.
  set_target_properties(tetmend_${name} PROPERTIES
    LINKER_LANGUAGE CXX POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
  tetmend_unity(tetmend_${name})
endfunction()
