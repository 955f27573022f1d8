# tetmend_layer(NAME LAYER_BELOW [LIBRARIES...]): one static library per folder; includes are written from the root.
function(tetmend_layer name below)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/${name}/*.cpp ${PROJECT_SOURCE_DIR}/${name}/*.h)
  add_library(tetmend_${name} STATIC ${sources})
  target_include_directories(tetmend_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(tetmend_${name} PUBLIC ${below} ${ARGN} PRIVATE tetmend_flags)
  set_target_properties(tetmend_${name} PROPERTIES LINKER_LANGUAGE CXX POSITION_INDEPENDENT_CODE ON)
endfunction()
