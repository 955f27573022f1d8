// SPDX-License-Identifier: MIT
// Named arrays in files of HDF5. Points, tets, triangles and edges have a group each, with a table
// for each array, in its order:
//
//   /point_data/NAME  N x components, or N    /cell_data/NAME  of tets
//   /triangle_data/NAME                       /edge_data/NAME
//
// A table has its array's name; where that cannot be, it has another, and an attribute `name`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetmend/data.h>

#include "mpi/hdf5_file.h"
#include "pieces/ranks.h"
#include "pieces/rows.h"

namespace tetmend::mpi {

/// How many there are of each kind, on all ranks.
using Hdf5Counts = pieces::ByKind<std::uint64_t>;

/// Of a kind, from the root.
const char* hdf5_group_of(pieces::RowKind kind);
/// The names that the tables of these arrays have in their group.
std::vector<std::string> hdf5_table_names(const std::vector<DataArray>& arrays);

/// All ranks: each has an equal share of every array.
/// @param notes  gets a sentence for each table that is none, or has another form
pieces::KindArrays read_hdf5_arrays(const Hdf5File& file, const Hdf5Counts& counts,
                                    std::vector<std::string>& notes);

/// All ranks: arrays of what there is none of are left out. @throws Error when they cannot be
/// written
void write_hdf5_arrays(const Hdf5File& file, const pieces::KindArrays& arrays,
                       const Hdf5Counts& counts, pieces::Ranks& ranks);

/// The names in the root or a group of it, in the order in which they were made, if the file has
/// kept that.
std::vector<std::string> hdf5_names_in(const Hdf5File& file, const std::string& group);

}  // namespace tetmend::mpi
