// SPDX-License-Identifier: MIT
// What a file of Exodus II has besides points, elements and sets: variables and texts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/vector_parts.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

inline constexpr AxisEndings kExodusAxes = {"_x", "_y", "_z"};

/// Elements of one type.
struct ExodusBlock {
  std::string path;
  std::size_t index = 0;              ///< in the file, from 1
  const ElementKind* kind = nullptr;  ///< null: they are not kept
  std::size_t count = 0;
  std::size_t first_place = 0;  ///< of its first element in the list of places
  std::int64_t number = 0;
  std::string name;
};

/// Makes arrays of the first step of variables of points, volumes and edges. What it looks at is put
/// into `known`.
void read_exodus_variables(const Hdf5Reader& file, std::span<const ExodusBlock> blocks,
                           MeshData& mesh, std::set<std::string>& known);

/// Puts title, records and the time into the deck. Of all tables that are not known a note is made.
void note_exodus_rest(const Hdf5Reader& file, MeshData& mesh, std::set<std::string>& known);

}  // namespace tetmend::formats
