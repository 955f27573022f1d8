// SPDX-License-Identifier: MIT
// The points that cards of Nastran's bulk data keep where they are.
#include "kernel/formats/nastran_pins.h"

#include <algorithm>

#include "kernel/formats/pin_remarks.h"

namespace tetmend::formats {
namespace {

/// Sorted, and without overlaps.
template <class Number>
std::vector<std::pair<Number, Number>> merged(std::vector<std::pair<Number, Number>> ranges) {
  std::sort(ranges.begin(), ranges.end());
  std::vector<std::pair<Number, Number>> all;
  for (const auto& range : ranges) {
    if (all.empty() || range.first > all.back().second) {
      all.push_back(range);
    } else {
      all.back().second = std::max(all.back().second, range.second);
    }
  }
  return all;
}

}  // namespace

void NastranPins::add(const NastranCardText& card, const NastranReferences& references) {
  Pins& pins = pins_[card.name];
  if (pins.first == nullptr) pins.first = card.text.data();
  ++pins.cards;
  pins.is_known = references.is_known;
  pins.ranges.insert(pins.ranges.end(), references.ranges.begin(), references.ranges.end());
}

void NastranPins::add_held(const NastranPoints& points) {
  if (points.held().empty()) return;
  Pins& pins = pins_["GRID"];
  pins.first = points.held().front().place;
  for (const NastranPoints::Held& each : points.held()) {
    ++pins.cards;
    pins.ranges.emplace_back(each.number, each.number);
  }
}

void NastranPins::require(const NastranPoints& points, const NastranSources& sources,
                          MeshData& mesh) {
  add_held(points);
  const std::vector<std::uint32_t>& order = points.order();
  std::vector<std::pair<std::size_t, std::size_t>> all;  // places, the last is behind
  std::vector<PinRemark> remarks;
  for (auto& [name, pins] : pins_) {
    std::size_t count = 0;
    for (const auto& [first, last] : merged(std::move(pins.ranges))) {
      const std::size_t begin = points.place_from(first);
      const std::size_t end = last == INT64_MAX ? order.size() : points.place_from(last + 1);
      if (begin == end) continue;
      all.emplace_back(begin, end);
      count += end - begin;
    }
    if (count > 0) {
      remarks.push_back(
          {&sources.file_of(pins.first), pins.first, pins.cards, who(name, pins), count});
    }
  }
  std::vector<bool> is_required(order.size(), false);
  for (const auto& [begin, end] : merged(std::move(all))) {
    for (std::size_t i = begin; i < end; ++i) is_required[order[i]] = true;
  }
  for (std::uint32_t i = 0; i < is_required.size(); ++i) {
    if (is_required[i]) mesh.required_vertices.push_back(i);
  }
  if (remarks.empty()) return;
  std::sort(remarks.begin(), remarks.end(),
            [](const PinRemark& a, const PinRemark& b) { return a.place < b.place; });
  mesh.deck.push_back(pin_remarks_text(remarks, "kinds of cards"));  // nastran_remarks
}

std::string NastranPins::who(const std::string& name, const Pins& pins) {
  if (name == "GRID") return name + " with constraints in field 8";
  return pins.is_known ? name : name + ", a card whose fields are not known,";
}

}  // namespace tetmend::formats
