# tetmend::petsc, <tetmend/petsc.h>: sources that are compiled with the program that uses them. For how wide PETSc's whole
# numbers are, which MPI it has and which version it is, is up to that program. So it is installed whether PETSc is here or
# not. Where the program is made, pkg-config must know PETSc and CMake must find MPI.
set(tetmend_petsc_sources bindings/petsc/improve.cpp bindings/petsc/make_plex.cpp bindings/petsc/read_plex.cpp
    mpi/mpi_ranks.cpp)
set(tetmend_petsc_headers bindings/petsc/exchange.h bindings/petsc/plex_arrays.h mpi/mpi_ranks.h)
set(tetmend_source_dir ${CMAKE_INSTALL_DATADIR}/tetmend/source)

add_library(tetmend_petsc INTERFACE)
add_library(tetmend::petsc ALIAS tetmend_petsc)
foreach(source IN LISTS tetmend_petsc_sources)
  target_sources(tetmend_petsc INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/${source}>
    $<INSTALL_INTERFACE:$<INSTALL_PREFIX>/${tetmend_source_dir}/${source}>)
endforeach()
target_include_directories(tetmend_petsc INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${tetmend_source_dir}>)
target_link_libraries(tetmend_petsc INTERFACE tetmend_library MPI::MPI_CXX PkgConfig::tetmend_with_petsc)
set_target_properties(tetmend_petsc PROPERTIES EXPORT_NAME petsc)

if(TETMEND_INSTALL)
  foreach(file IN LISTS tetmend_petsc_sources tetmend_petsc_headers)
    get_filename_component(folder ${file} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${tetmend_source_dir}/${folder} COMPONENT development)
  endforeach()
  install(TARGETS tetmend_petsc EXPORT tetmendPetscTargets)
  install(EXPORT tetmendPetscTargets NAMESPACE tetmend:: COMPONENT development
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tetmend)
endif()
