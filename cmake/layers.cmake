# tetmend_layer(NAME LAYER_BELOW [LIBRARIES...]): one static library per folder; includes are written from the root.
function(tetmend_layer name below)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/${name}/*.cpp ${PROJECT_SOURCE_DIR}/${name}/*.h)
  add_library(tetmend_${name} STATIC ${sources})
  add_library(tetmend::${name} ALIAS tetmend_${name})
  target_include_directories(tetmend_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${TETMEND_INCLUDE_DIR}>)
  target_compile_features(tetmend_${name} PUBLIC cxx_std_20)
  target_link_libraries(tetmend_${name} PUBLIC ${below} ${ARGN} PRIVATE $<BUILD_INTERFACE:tetmend_flags>)
  set_target_properties(tetmend_${name} PROPERTIES
    LINKER_LANGUAGE CXX POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name})
  install(TARGETS tetmend_${name} EXPORT tetmendTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${name} DESTINATION ${TETMEND_INCLUDE_DIR} FILES_MATCHING PATTERN "*.h")
endfunction()
