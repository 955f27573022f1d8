// SPDX-License-Identifier: MIT
// Improves a DMPlex of PETSc: a mesh of tets that lies on many processes.
//
//   DM better = nullptr;
//   tetmend::Result result = tetmend::petsc::improve(dm, &better, {.threads = 8});
//
// CMake: find_package(tetmend COMPONENTS petsc) and tetmend::petsc, which is compiled with the
// program, for the program's PETSc. See docs/pieces.md.
#pragma once

#include <string>

#include <petscdmplex.h>
#include <tetmend/distributed.h>

namespace tetmend::petsc {

/// The labels of a DMPlex that its better one has, too; empty: none. A point has at most one value
/// in each, of 32 bits.
struct Labels {
  std::string cells = "Cell Sets";       ///< regions: faces between two of them stay
  std::string faces = "Face Sets";       ///< the faces in it stay
  std::string edges = "Edge Sets";       ///< the edges in it stay
  std::string vertices = "Vertex Sets";  ///< the vertices in it neither move nor vanish
};

/// Makes a better DMPlex of one of tets, with or without faces and edges, on the processes of its
/// communicator. All of them call it, with the same arguments, from the thread that may call MPI.
/// What stays (the surface, faces between two regions, what is labelled) has the same coordinates,
/// bit for bit.
///
/// The result depends on the mesh, the options and the number of pieces: on no number of processes
/// or threads, and not on which of them had which cells, as long as no two vertices lie in one
/// place. Cells are shared out evenly; each process has the vertices, edges and faces of its cells,
/// and of those that several have one is the owner, as in a DMPlex that was distributed without
/// overlap. Cells have PETSc's order of vertices.
///
/// Fields, discretisations and sections stay behind, as does a partitioner. Labels that are not
/// carried are named in Result::notes.
/// @param from no cell may be another's ghost (overlap); is not changed
/// @param better is set when all is done; the caller destroys it
/// @throws Error for a DM that is no such mesh, the same on all processes: what is wrong, of which
/// cell or point; OptionError and Error as improve() of arrays in <tetmend/distributed.h>
Result improve(DM from, DM* better, const Options& options = {}, const Pieces& pieces = {},
               const Labels& labels = {});

}  // namespace tetmend::petsc
