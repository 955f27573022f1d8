// SPDX-License-Identifier: MIT
// VTK's XML files `.pvtu`: a mesh in several `.vtu` files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tetmend::pieces {

/// The files of its pieces, in their order. @throws Error for a file that is none of these
std::vector<std::filesystem::path> read_pvtu(const std::filesystem::path& file);

/// An array that all pieces have.
struct PvtuArray {
  std::string name;
  std::string type;  ///< "Int32"
  std::size_t components = 1;
};

/// @param pieces their files, as they are named from the folder of `file`
/// @throws Error when it cannot be written
void write_pvtu(const std::filesystem::path& file, std::span<const std::string> pieces,
                std::span<const PvtuArray> of_points, std::span<const PvtuArray> of_cells);

}  // namespace tetmend::pieces
