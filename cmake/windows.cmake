# CMake toolchain file: from Linux for 64-bit Windows, with the MinGW-w64 compiler of Debian. script/portable puts the
# libraries into the folder TETMEND_SYSROOT.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TETMEND_SYSROOT)
set(CMAKE_FIND_ROOT_PATH ${TETMEND_SYSROOT} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CXX_FLAGS_INIT "-Wa,-mbig-obj")  # templates make more sections than an object usually has
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--stack,8388608")  # a stack as large as on Linux
set(ENV{PKG_CONFIG_LIBDIR} ${TETMEND_SYSROOT}/lib/pkgconfig:/usr/x86_64-w64-mingw32/lib/pkgconfig)
