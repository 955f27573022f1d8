// SPDX-License-Identifier: MIT
// The nodes and solids of a keyword file of LS-DYNA.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/lsdyna_deck.h"
#include "kernel/formats/number_index.h"
#include "kernel/formats/point_pins.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// What readers of all else begin with.
class LsDynaMesh : protected LsDynaDeck {
 public:
  /// @throws Error for a file without nodes
  LsDynaMesh(const std::filesystem::path& deck, TetPlace* question);

 protected:
  /// With a line break at the end, if they are not empty.
  static std::string lines_of(std::string_view text);
  /// Comment lines between two places of a block, and those behind its last other line.
  struct Comments {
    std::string inner;
    std::string_view trailing;
  };
  static Comments comments_of(const char* begin, const char* end);

  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  NumberIndex nodes_, solids_;
  std::vector<ElementPlace> elements_;       // solids, as they stand in the file
  std::vector<std::string> points_of_deck_;  // of nodes with constraints: number and line
  PointPins pins_;

 private:
  void refuse_other_places() const;
  void read_nodes(const LsDynaBlock& block);
  void keep_constraint(std::string_view line);
  void pin_constrained();
  void read_solids(const LsDynaBlock& block);
  void take_numbers(std::string_view line, std::vector<std::int64_t>& numbers);
  void add_solid(std::string_view line, std::vector<std::int64_t>& numbers);
  std::uint32_t node(std::int64_t number, std::string_view line) const;
  NumberIndex index_of(const std::vector<std::int64_t>& numbers,
                       const std::vector<const char*>& places, std::string_view what) const;

  std::vector<const char*> node_places_, solid_places_;
  std::vector<std::int64_t> solid_numbers_;
  std::vector<std::uint32_t> constrained_;  // nodes
};

}  // namespace tetmend::formats
