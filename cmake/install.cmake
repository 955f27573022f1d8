# find_package(tetmend): the targets tetmend::kernel, trace, ops, contract, schedule, plugin and plugin_host.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tetmend)

install(EXPORT tetmendTargets NAMESPACE tetmend:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/tetmendConfig.cmake.in
  ${PROJECT_BINARY_DIR}/tetmendConfig.cmake INSTALL_DESTINATION ${package_dir})
# Until 1.0 each minor version may change what it likes.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tetmendConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tetmendConfig.cmake ${PROJECT_BINARY_DIR}/tetmendConfigVersion.cmake
  DESTINATION ${package_dir})
