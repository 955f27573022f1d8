// SPDX-License-Identifier: MIT
// A DMPlex as arrays that do not tell how it lay on the ranks, and a DMPlex of such arrays.
//
//   DMPlex -> vertices numbered by their coordinates, elements sorted by these numbers -> improve()
//          -> tets shared out evenly -> DMPlex -> labels: who has a vertex asks for what is there
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <petscdmplex.h>
#include <petscsf.h>
#include <tetmend/distributed.h>
#include <tetmend/petsc.h>

namespace tetmend::petsc {

/// What a rank has of a mesh, and what all of them know.
struct PlexArrays {
  RankArrays mesh;
  bool is_interpolated = false;          ///< it has faces and edges
  Labels labels;                         ///< those that it has; the names of others are empty
  std::int32_t no_region = 0;            ///< of cells that are in no stratum
  std::vector<std::string> left_behind;  ///< labels, and what of them cannot be carried
};

/// All ranks. @throws Error, the same one on all
PlexArrays read_plex(DM dm, const Labels& labels, Ranks& ranks);

/// All ranks. Takes the arrays apart. @throws Error
DM make_plex(MPI_Comm comm, PlexArrays& arrays, Ranks& ranks);

}  // namespace tetmend::petsc
