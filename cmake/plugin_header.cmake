# SPDX-License-Identifier: MIT
# Writes <tetmend/plugin.h>, all that a plugin needs in one file: our headers named by HEADERS and what they include,
# each once, in the order of their includes. What a plugin may not see is refused: a search engine, an operator.
#   cmake -DSOURCE=... -DHEADERS=ops/plugin.h;... -DOUTPUT=... -P plugin_header.cmake
cmake_minimum_required(VERSION 3.21)
set(rooms "^(kernel|trace|ops)/")
set(seen "")
set(text "")

# add(HEADER): appends it to `text`, behind all that it includes.
macro(add header)
  if(NOT "${header}" IN_LIST seen)
    list(APPEND seen ${header})
    if(NOT "${header}" MATCHES "${rooms}")
      message(FATAL_ERROR "a plugin would see ${header}: by ${stack}")
    endif()
    file(READ ${SOURCE}/${header} content_${header})
    string(REGEX MATCHALL "#include \"[^\"\n]+\"" includes_${header} "${content_${header}}")
    foreach(include IN LISTS includes_${header})
      string(REGEX REPLACE "#include \"(.+)\"" "\\1" include "${include}")
      set(stack ${header})
      add(${include})
    endforeach()
    set(content "${content_${header}}")
    string(REGEX REPLACE "#include \"[^\"\n]+\"\n" "" content "${content}")
    string(REPLACE "#pragma once\n" "" content "${content}")
    string(REPLACE "// SPDX-License-Identifier: MIT\n" "" content "${content}")
    string(REGEX REPLACE "\n\n\n+" "\n\n" content "${content}")
    string(APPEND text "\n// ---- ${header}\n${content}")
  endif()
endmacro()

foreach(header IN LISTS HEADERS)
  set(stack plugin.h)
  add(${header})
endforeach()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "// SPDX-License-Identifier: MIT
// All that a plugin needs to add operators to tetmend (docs/operators.md). Made from the headers that are named in it.
#pragma once
@text@")
