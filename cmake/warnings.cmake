# Warnings, floating-point rules, hardening and sanitizers that every target of this project shares.
add_library(tetmend_flags INTERFACE)
target_compile_options(tetmend_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
  # No fused multiply-add: the same bits on every x86-64, whichever instruction set is used.
  -ffp-contract=off -fno-math-errno)
if(TETMEND_SANITIZE)
  target_compile_options(tetmend_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -UNDEBUG)
  target_link_options(tetmend_flags INTERFACE -fsanitize=address,undefined)
  if(TETMEND_BUILD_FUZZ)
    # Checks of pointers take a third of the compiler's time, and the address sanitizer sees most of what they see.
    target_compile_options(tetmend_flags INTERFACE -fsanitize=fuzzer-no-link
      -fno-sanitize=null,alignment,vptr,object-size)
  endif()
elseif(TETMEND_SANITIZE_THREADS)
  target_compile_options(tetmend_flags INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(tetmend_flags INTERFACE -fsanitize=thread)
elseif(NOT WIN32)
  # A slip of memory ends the program instead of going on with what it wrote over.
  target_compile_options(tetmend_flags INTERFACE -fstack-protector-strong
    $<$<CONFIG:Release,RelWithDebInfo>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release,RelWithDebInfo>:-D_FORTIFY_SOURCE=2>)
endif()
if(TETMEND_COVERAGE)
  target_compile_options(tetmend_flags INTERFACE -fprofile-instr-generate -fcoverage-mapping)
  target_link_options(tetmend_flags INTERFACE -fprofile-instr-generate)
endif()
target_compile_definitions(tetmend_flags INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)
if(NOT WIN32 AND NOT APPLE)
  target_link_options(tetmend_flags INTERFACE -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
endif()
