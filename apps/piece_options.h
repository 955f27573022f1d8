// SPDX-License-Identifier: MIT
// Options of commands that work on a mesh in pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace CLI {
class App;
}

namespace tetmend::apps {

/// As the user wrote them.
struct PieceOptions {
  std::size_t pieces = 0;         ///< 0: not given
  std::uint64_t memory = 0;       ///< bytes; 0: not given
  std::filesystem::path scratch;  ///< empty: beside the output

  std::filesystem::path checkpoint;  ///< folder; empty: none

  bool is_divided() const { return pieces > 1 || memory > 0 || !checkpoint.empty(); }
};

/// --pieces of commands that only write.
void add_parts_option(CLI::App& command, std::size_t& parts);
void add_piece_options(CLI::App& command, PieceOptions& options);

/// From now on memory is kept that is given back: each piece needs as much as the one before.
void reuse_memory() noexcept;

}  // namespace tetmend::apps
