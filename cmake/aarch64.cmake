# CMake toolchain file: from a PC for 64-bit ARM, with the cross compiler of Debian. script/bytes puts the libraries into
# the folder TETMEND_SYSROOT.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TETMEND_SYSROOT)
set(CMAKE_FIND_ROOT_PATH ${TETMEND_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)  # headers alone are the same for all machines
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_CXX_FLAGS_INIT "-isystem ${TETMEND_SYSROOT}/usr/include/aarch64-linux-gnu -isystem ${TETMEND_SYSROOT}/usr/include")
set(libraries ${TETMEND_SYSROOT}/usr/lib/aarch64-linux-gnu)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-L${libraries} -Wl,-rpath-link,${libraries}")
set(ENV{PKG_CONFIG_LIBDIR} ${libraries}/pkgconfig:${TETMEND_SYSROOT}/usr/share/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${TETMEND_SYSROOT})
