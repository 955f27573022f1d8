// SPDX-License-Identifier: MIT
// The nodes and elements of an Abaqus deck as it lists them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_types.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// From the numbers of a deck to places in its lists. They need not ascend.
class InpNumbers {
 public:
  static constexpr std::uint32_t kNone = GmshTags::kNone;

  void add(std::int64_t number) { numbers_.push_back(number); }
  /// To be called once, when all are there. The place of a number that comes twice, or kNone.
  std::uint32_t finish();
  std::uint32_t find(std::int64_t number) const {
    const std::uint32_t at = tags_.find(number);
    return at == kNone || order_.empty() ? at : order_[at];
  }
  std::int64_t most() const { return most_; }
  const std::vector<std::int64_t>& numbers() const { return numbers_; }
  /// Places of first, first + step, ... to `last`, as far as there are such numbers.
  /// @returns how many numbers were looked at: of the range, or those in it
  std::size_t collect(std::int64_t first, std::int64_t last, std::int64_t step,
                      std::vector<std::uint32_t>& places) const;

 private:
  std::vector<std::int64_t> numbers_;  // in the order of the deck
  std::vector<std::int64_t> sorted_;   // empty: the same
  std::vector<std::uint32_t> order_;
  GmshTags tags_;
  std::int64_t most_ = 0;
};

/// Elements of one *ELEMENT block.
struct InpElements {
  const InpBlock* block = nullptr;
  InpType type;
  std::string name;       ///< of the type, as it stands there
  std::size_t first = 0;  ///< place of the first among all elements of the mesh
  std::size_t count = 0;
  std::vector<std::uint32_t> vertices;  ///< in VTK's order
};

struct InpMesh {
  std::vector<Point> points;
  InpNumbers nodes;
  InpNumbers elements;               ///< of the mesh
  std::vector<InpElements> blocks;   ///< those of the mesh
  std::vector<std::int64_t> others;  ///< numbers of springs and their like, in ascending order
  /// By the number of a node what stands behind its coordinates, from the comma on: ", 0., 0., 1." is a
  /// normal.
  std::map<std::int64_t, std::string_view> more_of_node;

  /// The block of an element.
  const InpElements& block_of(std::uint32_t element) const;
  const std::uint32_t* vertices_of(std::uint32_t element) const {
    const InpElements& block = block_of(element);
    return block.vertices.data() + (element - block.first) * block.type.width;
  }
  std::int64_t most_element() const {
    return std::max(elements.most(), others.empty() ? 0 : others.back());
  }
};

/// Is this block's content part of the mesh? Reference points of an assembly are not.
bool is_mesh_block(const InpBlock& block, std::string_view keyword);

InpMesh read_inp_mesh(const InpLines& lines, TetPlace* question);

}  // namespace tetmend::formats
