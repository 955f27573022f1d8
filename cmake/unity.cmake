# tetmend_unity(TARGET): eight sources are compiled as one, where TETMEND_UNITY is on, for most of the time of a compiler goes
# into headers. So their private names differ (tests/script/unity_names.py).
function(tetmend_unity target)
  if(NOT TETMEND_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  # gcc takes each of the eight for a header and warns of what only a header must not do; and it inlines less in what it
  # takes for a large source.
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage> $<$<CXX_COMPILER_ID:GNU>:--param=large-unit-insns=80000>)
endfunction()

# tetmend_cold(TARGETS...): code that turns figures into words and pages, or reads what was typed. It runs once, so it is
# compiled for less time, not for less time of a run; with sanitizers, twice as fast.
function(tetmend_cold)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> $<$<BOOL:${TETMEND_SANITIZE}>:-O0>)
  endforeach()
endfunction()
