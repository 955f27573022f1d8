# SPDX-License-Identifier: MIT
# Writes a header that users see, all of a part of the library in one file: our headers named by HEADERS and what they include,
# each once, in the order of their includes. What lies in none of the ROOMS is refused: a search engine, an operator. Each of
# our headers has a guard of its own, for a program may include several such files.
#   cmake -DSOURCE=... -DHEADERS=ops/plugin.h;... -DROOMS=kernel;... -DVERSION=0.1.0 "-DPURPOSE=..." -DOUTPUT=... -P one_header.cmake
cmake_minimum_required(VERSION 3.21)
list(JOIN ROOMS "|" rooms)
set(seen "")
set(text "")

# add(HEADER): appends it to `text`, behind all that it includes.
macro(add header)
  if(NOT "${header}" IN_LIST seen)
    list(APPEND seen ${header})
    if(NOT "${header}" MATCHES "^(${rooms})/[^/]+$")
      message(FATAL_ERROR "a user would see ${header}: by ${stack}")
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
    string(MAKE_C_IDENTIFIER "${header}" guard)
    string(TOUPPER "TETMEND_HAS_${guard}" guard)
    string(APPEND text "\n// ---- ${header}\n#ifndef ${guard}\n#define ${guard}\n${content}#endif\n")
  endif()
endmacro()

foreach(header IN LISTS HEADERS)
  set(stack ${OUTPUT})
  add(${header})
endforeach()
set(version "#define TETMEND_VERSION_TEXT \"${VERSION}\"")
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "// SPDX-License-Identifier: MIT
// @PURPOSE@ Made from the headers that are named in it.
#pragma once
#ifndef TETMEND_VERSION_TEXT
@version@
#endif
@text@")
