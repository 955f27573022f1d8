# Warnings, floating-point rules and sanitizers that every target of this project shares.
add_library(tetmend_flags INTERFACE)
target_compile_options(tetmend_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
  # No fused multiply-add: the same bits on every x86-64, whichever instruction set is used.
  -ffp-contract=off -fno-math-errno)
if(TETMEND_SANITIZE)
  target_compile_options(tetmend_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -UNDEBUG)
  target_link_options(tetmend_flags INTERFACE -fsanitize=address,undefined)
endif()
