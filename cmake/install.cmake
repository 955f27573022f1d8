# What is installed: the library, its headers, how others find it, and the licences.
#   find_package(tetmend)   the target tetmend::tetmend; with COMPONENTS plugin or kernel also tetmend::plugin, tetmend::kernel;
#                           petsc.cmake has tetmend::petsc
#   pkg-config tetmend      the same for other build tools; with --static what a static libtetmend needs; tetmend-kernel finds Eigen
# The components are those of the packages that cmake/packages.cmake makes: program, viewer, library, development, python.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tetmend)

install(TARGETS tetmend_library EXPORT tetmendTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/tetmend DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/bindings/fortran/tetmend.f90 DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tetmend)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD-PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(EXPORT tetmendTargets NAMESPACE tetmend:: DESTINATION ${package_dir})
install(TARGETS tetmend_plugin EXPORT tetmendPluginTargets)
install(FILES ${TETMEND_MADE_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tetmend)
install(EXPORT tetmendPluginTargets NAMESPACE tetmend:: DESTINATION ${package_dir})
install(TARGETS tetmend_for_kernel EXPORT tetmendKernelTargets)
install(EXPORT tetmendKernelTargets NAMESPACE tetmend:: DESTINATION ${package_dir})
set(tetmend_config_libraries "")
if(NOT BUILD_SHARED_LIBS)
  set(tetmend_config_libraries "# A static library does not bring along what it is made with.
set_property(TARGET tetmend::tetmend APPEND PROPERTY INTERFACE_LINK_LIBRARIES \"${tetmend_static_libraries}\")
")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/tetmendConfig.cmake.in ${PROJECT_BINARY_DIR}/tetmendConfig.cmake @ONLY)
# Until 1.0 each minor version may change what it likes.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tetmendConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tetmendConfig.cmake ${PROJECT_BINARY_DIR}/tetmendConfigVersion.cmake
  DESTINATION ${package_dir})

file(STRINGS ${PROJECT_SOURCE_DIR}/packaging/address tetmend_address)  # cmake/packages.cmake has it as well

# The folders are seen from that of the file itself, so that all may be moved together.
file(RELATIVE_PATH tetmend_way_up ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" tetmend_way_up "${tetmend_way_up}")
# What Debian's packages have is not moved, and pkg-config leaves out -I/usr/include only where it is written so: as a
# folder of the system (-isystem), it would come before that of the C++ library.
set(tetmend_prefix "\${pcfiledir}/${tetmend_way_up}")
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
  set(tetmend_prefix /usr)
endif()
list(TRANSFORM tetmend_static_libraries PREPEND "-l" OUTPUT_VARIABLE tetmend_private_libraries)
list(JOIN tetmend_private_libraries " " tetmend_private_libraries)
configure_file(${PROJECT_SOURCE_DIR}/cmake/tetmend.pc.in ${PROJECT_BINARY_DIR}/tetmend.pc @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/cmake/tetmend-kernel.pc.in ${PROJECT_BINARY_DIR}/tetmend-kernel.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/tetmend.pc ${PROJECT_BINARY_DIR}/tetmend-kernel.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
