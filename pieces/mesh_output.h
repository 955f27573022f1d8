// SPDX-License-Identifier: MIT
// Pieces on their way into a file, with what the file that was read holds besides its mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "face/carry.h"
#include "kernel/mesh_data.h"
#include "pieces/divided_mesh.h"
#include "pieces/rank_share.h"
#include "pieces/shelf.h"

namespace tetmend::pieces {

/// What is written besides the pieces.
struct WriteDetails {
  std::uint64_t vertices = 0;               ///< of the file that was read
  const ArrayFiles* array_files = nullptr;  ///< of formats that only they know; null: none
  /// For files of parts, into how many the mesh is divided before; 0: each stored piece is one.
  std::size_t parts = 0;
  std::string variant = {};  ///< see MeshView::variant()
  /// The file that was read, if it holds more than labels and constraints. Read again, by all ranks
  /// or by the first one, to bring over what it holds. Empty: there is nothing.
  std::filesystem::path source = {};
  std::string label_array = {};            ///< of `source`
  std::vector<std::string> conserve = {};  ///< see Options
  bool surface_moves = false;
  Shelf* shelf = nullptr;  ///< for what is brought over by all ranks; null: in memory
  std::size_t pieces = 1;  ///< of the run
};

/// All ranks: the mesh of such a file, with its arrays, on the first one.
/// @throws Error as ArrayFiles::read()
MeshData gather_mesh(const std::filesystem::path& file, const ArrayFiles& files,
                     const std::string& label_array, Ranks& ranks);

/// All ranks: the first writes the stored pieces, others help.
/// @returns on the first rank, what was brought over
/// @throws Error as write_mesh() and read_mesh()
face::Carried write_pieces(const std::filesystem::path& file, DividedMesh& mesh,
                           const WriteDetails& details);

}  // namespace tetmend::pieces
