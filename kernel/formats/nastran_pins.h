// SPDX-License-Identifier: MIT
// The points that cards of Nastran's bulk data keep where they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/formats/nastran_card.h"
#include "kernel/formats/nastran_points.h"
#include "kernel/formats/nastran_references.h"
#include "kernel/formats/nastran_sources.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

class NastranPins {
 public:
  /// What a card names.
  void add(const NastranCardText& card, const NastranReferences& references);
  /// Makes these points, and those with permanent constraints, required vertices; puts at the end of
  /// the deck which cards keep how many.
  void require(const NastranPoints& points, const NastranSources& sources, MeshData& mesh);

 private:
  /// Of cards of one name.
  struct Pins {
    const char* first = nullptr;  ///< place of the first of these cards
    std::size_t cards = 0;
    bool is_known = true;
    std::vector<std::pair<std::int64_t, std::int64_t>> ranges;  ///< of numbers
  };

  void add_held(const NastranPoints& points);
  static std::string who(const std::string& name, const Pins& pins);

  std::map<std::string, Pins> pins_;
};

}  // namespace tetmend::formats
