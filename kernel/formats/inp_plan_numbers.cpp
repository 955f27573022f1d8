// SPDX-License-Identifier: MIT
// The numbers that points and elements of an Abaqus deck are written with.
#include <algorithm>
#include <array>

#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_plan.h"

namespace tetmend::formats {

/// Numbers of Abaqus have at most nine digits; those of CalculiX have 32 bits, and we read more.
NewNumbers InpPlan::new_numbers(std::int64_t most, std::span<const std::int64_t> known,
                                std::span<const NumberRange> of_file) const {
  static constexpr std::array<std::int64_t, 3> kLimits = {999'999'999, INT32_MAX,
                                                          kInpGreatestNumber};
  return numbers_beside(known, of_file, kLimits, most, [this] {
    std::vector<NumberRange> taken;
    for (const InpPiece& piece : deck.pieces) {
      add_inp_numbers(piece.kind == InpPieceKind::verbatim ? piece.text : piece.more, taken);
    }
    return taken;
  });
}

/// What the file had of numbers, as a numbering has them.
std::vector<NumberRange> InpPlan::taken_in(std::size_t numbering,
                                           std::vector<NumberRange> MeshData::*all) const {
  if (data_ == nullptr) return {};
  if (deck.numberings.size() == 1) return data_->*all;
  const InpNumbering& own = deck.numberings[numbering];
  const bool are_nodes = all == &MeshData::taken_point_numbers;
  const std::int64_t offset = are_nodes ? own.node_offset : own.element_offset;
  const std::int64_t most = are_nodes ? own.most_node : own.most_element;
  std::vector<NumberRange> taken;
  for (const auto& [first, last] : data_->*all) {
    const NumberRange own_part(std::max<std::int64_t>(first - offset, 1),
                               std::min(last - offset, most));
    if (own_part.first <= own_part.second) taken.push_back(own_part);
  }
  return taken;
}

/// Of a number of the mesh; the offsets ascend.
std::size_t InpPlan::numbering_of(std::int64_t number, std::int64_t InpNumbering::*offset) const {
  const auto after = std::upper_bound(
      deck.numberings.begin(), deck.numberings.end(), number - 1,
      [&](std::int64_t before, const InpNumbering& each) { return before < each.*offset; });
  return static_cast<std::size_t>(after - deck.numberings.begin()) - 1;
}

/// A new point belongs where the elements around it do.
void InpPlan::find_numberings_of_points() {
  if (deck.numberings.size() < 2) return;
  constexpr std::uint32_t kOpen = UINT32_MAX;
  numbering_of_point_.assign(mesh_.point_count(), kOpen);
  for (std::size_t i = 0; i < data_->point_numbers.size(); ++i) {
    if (data_->point_numbers[i] == 0) continue;
    numbering_of_point_[i] = static_cast<std::uint32_t>(
        numbering_of(data_->point_numbers[i], &InpNumbering::node_offset));
  }
  for (const InpKind& kind : kinds) {
    for (std::size_t i = 0; i < kind.count; ++i) {
      const auto numbering =
          static_cast<std::uint32_t>(numbering_of_block(classes[kind.class_of[i]].block));
      for (std::size_t k = 0; k < kind.width; ++k) {
        std::uint32_t& of = numbering_of_point_[kind.of(i)[k]];
        if (of == kOpen && classes[kind.class_of[i]].block != 0) of = numbering;
      }
    }
  }
  std::replace(numbering_of_point_.begin(), numbering_of_point_.end(), kOpen, std::uint32_t{0});
  points_of_numbering_ =
      group_by_key(numbering_of_point_, static_cast<std::uint32_t>(deck.numberings.size()));
}

void InpPlan::number_points() {
  find_numberings_of_points();
  point_numbers.resize(mesh_.point_count());
  const bool given = data_ != nullptr && !data_->point_numbers.empty();
  if (given) point_numbers = data_->point_numbers;
  for (std::size_t n = 0; n < deck.numberings.size(); ++n) {
    const InpNumbering& numbering = deck.numberings[n];
    std::vector<std::int64_t> known;
    const bool is_alone = deck.numberings.size() == 1;
    const std::span<const std::uint32_t> own = points_of(n);
    const std::size_t count = is_alone ? point_numbers.size() : own.size();
    for (std::size_t i = 0; i < count && given; ++i) {
      std::int64_t& number = point_numbers[is_alone ? i : own[i]];
      if (number != 0) number -= numbering.node_offset;
      known.push_back(number);
    }
    const std::vector<NumberRange> taken = taken_in(n, &MeshData::taken_point_numbers);
    NewNumbers numbers = new_numbers(numbering.most_node, known, taken);
    for (std::size_t i = 0; i < count; ++i) {
      std::int64_t& number = point_numbers[is_alone ? i : own[i]];
      if (number == 0) number = numbers.next();
    }
  }
}

/// Elements of all kinds share their numbers.
bool InpPlan::has_good_numbers() const {
  if (has_deck_) return true;
  std::vector<std::int64_t> all;
  for (const InpKind& kind : kinds) {
    if (kind.is_triangle() || kind.vtk_type == kVtkEdge || kind.count == 0) continue;
    if (kind.given_numbers == nullptr || kind.given_numbers->empty()) return false;
    all.insert(all.end(), kind.given_numbers->begin(), kind.given_numbers->end());
  }
  std::sort(all.begin(), all.end());
  all.erase(all.begin(), std::upper_bound(all.begin(), all.end(), 0));
  return std::adjacent_find(all.begin(), all.end()) == all.end();
}

void InpPlan::number_elements() {
  const bool keeps = has_good_numbers();
  std::vector<std::vector<std::int64_t>> known(deck.numberings.size());
  for (InpKind& kind : kinds) {
    kind.numbers.resize(kind.count);
    const bool given = keeps && kind.given_numbers != nullptr && !kind.given_numbers->empty() &&
                       (has_deck_ || kind.dimension == 3);
    if (!given) continue;
    kind.numbers = *kind.given_numbers;
    for (std::int64_t& number : kind.numbers) {
      const std::size_t n = number == 0 ? 0 : numbering_of(number, &InpNumbering::element_offset);
      if (number != 0) number -= deck.numberings[n].element_offset;
      known[n].push_back(number);
    }
  }
  std::vector<std::vector<NumberRange>> taken(known.size());
  std::vector<NewNumbers> numbers;
  for (std::size_t n = 0; n < known.size(); ++n) {
    if (keeps) taken[n] = taken_in(n, &MeshData::taken_element_numbers);
    const std::int64_t most = keeps ? deck.numberings[n].most_element : 0;
    numbers.push_back(new_numbers(most, known[n], taken[n]));
  }
  for (InpKind& kind : kinds) {
    for (std::size_t i = 0; i < kind.count; ++i) {
      const Label block = classes[kind.class_of[i]].block;
      if (block == 0 || kind.numbers[i] != 0) continue;
      kind.numbers[i] = numbers[numbering_of_block(block)].next();
    }
  }
}

}  // namespace tetmend::formats
