# SPDX-License-Identifier: MIT
# Run by cpack with the finished packages: puts right what cpack cannot be told. A library in the folder of its architecture
# may be installed for several at once, and tells of itself by a trigger, not by scripts that call ldconfig.
#   CPACK_PACKAGE_FILES   the packages
find_program(dpkg_deb dpkg-deb REQUIRED)

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(package IN LISTS CPACK_PACKAGE_FILES)
  get_filename_component(file ${package} NAME)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/repacked/${file})
  file(REMOVE_RECURSE ${root})
  file(MAKE_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/repacked)
  run(${dpkg_deb} --raw-extract ${package} ${root})
  file(GLOB library ${root}/usr/lib/*/libtetmend.so ${root}/usr/lib/*/libtetmend.so.*)
  if(library)
    file(READ ${root}/DEBIAN/control control)
    string(REGEX REPLACE "(^|\n)(Architecture: [^\n]+\n)" "\\1\\2Multi-Arch: same\n" control "${control}")
    file(WRITE ${root}/DEBIAN/control "${control}")
  endif()
  if(EXISTS ${root}/DEBIAN/shlibs)
    file(REMOVE ${root}/DEBIAN/postinst ${root}/DEBIAN/postrm)
    file(WRITE ${root}/DEBIAN/triggers "activate-noawait ldconfig\n")
  endif()
  run(${dpkg_deb} --root-owner-group -Zxz -z2 --build ${root} ${package})
endforeach()
