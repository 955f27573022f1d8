// SPDX-License-Identifier: MIT
// The section $Nodes of a Gmsh file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernel/formats/gmsh_source.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Points in the order of the numbers of the nodes.
class GmshNodes {
 public:
  explicit GmshNodes(GmshSource& source) : source_(source) {}

  /// The section of version 2.2 and of version 4.1. @throws Error
  /// @param is_parametric  of the section $ParametricNodes
  void read_2(bool is_parametric);
  void read_4();

  bool parametric() const { return parametric_; }
  /// Which node has this number; GmshTags::kNone if none has.
  std::uint32_t find(std::int64_t tag) const { return tags_.find(tag); }

  /// The numbers of the points, ascending.
  const std::vector<std::int64_t>& numbers() const { return tags_.all(); }

  std::vector<Point> points;
  std::vector<std::array<Label, 2>> entities;  ///< empty in version 2.2

 private:
  void read_parametric_2();
  /// Where the numbers of some nodes stand: `stride` bytes apart, or `words` words.
  struct Block {
    std::size_t first;
    const char* at;
    std::size_t stride;
    std::size_t words;
  };

  std::size_t begin(std::size_t count);
  void read_block(std::size_t count, int dimension, Label tag, std::size_t parameters);
  void read_tags(std::size_t first, std::size_t count);
  void read_places(std::size_t first, std::size_t count, std::size_t parameters);
  void sort();
  const char* place_of_tag(std::size_t node);

  GmshSource& source_;
  std::vector<std::int64_t> numbers_;
  std::vector<Block> blocks_;
  GmshTags tags_;
  bool parametric_ = false;
};

}  // namespace tetmend::formats
