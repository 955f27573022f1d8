# SPDX-License-Identifier: MIT
# Run by cpack when the files of all packages lie in their folders and nothing is packed yet: adds what Debian asks of each
# package, and takes away what only installations by hand need.
#   CPACK_TEMPORARY_DIRECTORY   a folder for each component
#   CPACK_PROJECT_SOURCE        the source of tetmend
set(packaging ${CPACK_PROJECT_SOURCE}/packaging/debian)
find_program(gzip gzip REQUIRED)

# pack(FILE): FILE becomes FILE.gz, without the date of today.
function(pack file)
  execute_process(COMMAND ${gzip} -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The entry of a changelog for each version: here all that is known of it.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(changelog "tetmend (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Made of the source by cpack; CHANGELOG.md of the source says what is new.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}
")

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  if(NOT IS_DIRECTORY ${root}/usr)
    message(FATAL_ERROR "${root}/usr: cpack has another place for the files of ${component}")
  endif()
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  file(REMOVE_RECURSE ${root}/usr/share/doc/tetmend)  # LICENSE is in the file copyright
  set(documents ${root}/usr/share/doc/${package})
  file(COPY ${packaging}/copyright DESTINATION ${documents} FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(COPY ${CPACK_PROJECT_SOURCE}/THIRD-PARTY.md DESTINATION ${documents}
       FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(WRITE ${documents}/changelog.Debian "${changelog}")
  pack(${documents}/changelog.Debian)
  configure_file(${CPACK_PROJECT_SOURCE}/CHANGELOG.md ${documents}/changelog COPYONLY)
  pack(${documents}/changelog)
  if(package STREQUAL tetmend-mpi)  # its options are those of the commands of tetmend, which it depends on
    file(WRITE ${root}/usr/share/man/man1/tetmend-mpi.1 ".so man1/tetmend.1\n")
  endif()
  file(GLOB pages ${root}/usr/share/man/man1/*.1)
  foreach(page IN LISTS pages)
    pack(${page})
  endforeach()
  if(IS_DIRECTORY ${root}/usr/share/zsh/site-functions)  # Debian's place for those of packages
    file(RENAME ${root}/usr/share/zsh/site-functions ${root}/usr/share/zsh/vendor-completions)
  endif()
  # The library is where all are; a path in the file could only lead astray.
  file(GLOB_RECURSE modules ${root}/usr/lib/python3/*.so)
  foreach(module IN LISTS modules)
    file(RPATH_REMOVE FILE ${module})
  endforeach()
  if(EXISTS ${packaging}/${package}.lintian-overrides)
    file(COPY ${packaging}/${package}.lintian-overrides DESTINATION ${root}/usr/share/lintian/overrides)
    file(RENAME ${root}/usr/share/lintian/overrides/${package}.lintian-overrides ${root}/usr/share/lintian/overrides/${package})
  endif()
endforeach()
