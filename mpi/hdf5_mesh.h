// SPDX-License-Identifier: MIT
// Meshes in HDF5 files that all ranks read and write together, and the XDMF file by which ParaView
// reads them.
//
//   /geometry  N x 3 double           /connect   M x 4 int64, vertices from 0
//   /group     M int32, labels        /triangles K x 3 int64, /triangle_labels K int32
//   /edges, /edge_labels              /required_vertices int64      /vertex_labels N int32
//
// The first two are what other programs have, too; of the rest a file has what its mesh has. Named
// arrays: hdf5_arrays.h.
#pragma once

#include <filesystem>
#include <vector>

#include <mpi.h>

#include "pieces/rank_share.h"

namespace tetmend::mpi {

/// All ranks: each reads an equal share of every array.
/// @throws Error for a file that is none, lacks /geometry or /connect, or has these of another form
pieces::RankShare read_hdf5(const std::filesystem::path& file, MPI_Comm ranks);

/// All ranks: writes the file, which has the same bytes for any number of ranks, and FILE.xdmf beside
/// it. They take their names when they are complete. @throws Error with the reason
void write_hdf5(const std::filesystem::path& file, const pieces::RankShare& arrays, MPI_Comm ranks);

/// What write_hdf5() makes, also for a while.
std::vector<std::filesystem::path> files_of_hdf5(const std::filesystem::path& file);

}  // namespace tetmend::mpi
