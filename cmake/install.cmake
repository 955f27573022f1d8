# find_package(tetmend): the target tetmend::tetmend; with COMPONENTS plugin also tetmend::plugin.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tetmend)

install(TARGETS tetmend_library EXPORT tetmendTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/tetmend DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT tetmendTargets NAMESPACE tetmend:: DESTINATION ${package_dir})
install(TARGETS tetmend_plugin EXPORT tetmendPluginTargets)
install(FILES ${TETMEND_PLUGIN_HEADER} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tetmend)
install(EXPORT tetmendPluginTargets NAMESPACE tetmend:: DESTINATION ${package_dir})
configure_file(${PROJECT_SOURCE_DIR}/cmake/tetmendConfig.cmake.in ${PROJECT_BINARY_DIR}/tetmendConfig.cmake @ONLY)
# Until 1.0 each minor version may change what it likes.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tetmendConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tetmendConfig.cmake ${PROJECT_BINARY_DIR}/tetmendConfigVersion.cmake
  DESTINATION ${package_dir})
