# SPDX-License-Identifier: MIT
# An overlay port: vcpkg install tetmend --overlay-ports=packaging/vcpkg builds this very source. A port of the registry has
# vcpkg_from_github here, with the address and the hash of a release.
# What was run: script/recipes, on 2026-11-25, which reads it and gives its options to CMake. Not run: vcpkg.
set(VCPKG_BUILD_TYPE release)  # a static libtetmend.a names its libraries as they are called in release builds
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES tools TETMEND_BUILD_PROGRAMS)
vcpkg_find_acquire_program(PKGCONFIG)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features} -DTETMEND_LUA=lua -DTETMEND_BUILD_TESTS=OFF -DTETMEND_BUILD_VIEWER=OFF -DTETMEND_MPI=OFF
          "-DPKG_CONFIG_EXECUTABLE=${PKGCONFIG}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/tetmend)
vcpkg_fixup_pkgconfig()
if("tools" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES tetmend AUTO_CLEAN)
endif()
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/THIRD-PARTY.md")
