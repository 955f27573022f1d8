// SPDX-License-Identifier: MIT
// The points of Nastran's bulk data, and the systems of coordinates that they are given in.
#include "kernel/formats/nastran_points.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/nastran.h"

namespace tetmend::formats {

std::int64_t NastranCardReader::integer(std::size_t i, std::string_view what, std::int64_t low,
                                        std::int64_t high) const {
  const std::string_view field = card_.field(i);
  std::int64_t value = 0;
  if (!nastran_integer(field, value)) {
    fail(field, fmt::format("{} is not an integer: expected {}", in_quotes(field), what));
  }
  if (value < low || value > high) {
    fail(field, fmt::format("{} is out of range: expected {}, {} to {}", in_quotes(field), what,
                            low, high));
  }
  return value;
}

bool NastranCardReader::is_blank(std::size_t first) const {
  for (std::size_t i = first; i < card_.fields.size(); ++i) {
    if (!card_.fields[i].empty()) return false;
  }
  return true;
}

std::string NastranCardReader::card_text() const {
  std::string text = nastran_lines(card_.text);
  for (const std::string_view line : card_.strays) text += nastran_lines(line);
  return text;
}

std::string nastran_lines(std::string_view text) {
  std::string lines(text);
  if (!lines.ends_with('\n')) lines += '\n';
  return lines;
}

void keep_nastran_comments(const NastranCardText& card, std::string& lines) {
  for (const std::string_view line : card.comments) {
    if (!trimmed_field(line).empty()) lines += nastran_lines(line);
  }
}

void NastranPoints::read() {
  for (const NastranStretch& stretch : sources_.stretches()) {
    if (stretch.includes != 0) continue;
    NastranLines lines = sources_.lines(stretch);
    while (!lines.at_end()) {
      if (!lines.begins_with("GR") && !lines.begins_with("CORD")) {
        lines.line();
        continue;
      }
      lines.read(card_);
      if (card_.name == "GRID") {
        read_point();
      } else if (card_.name == "GRDSET") {
        if (!card_.field(1).empty()) default_system_ = read_system(1);
      } else if (card_.name.starts_with("CORD")) {
        read_definition();
      }
    }
  }
  number();
}

void NastranPoints::number() {
  std::vector<std::int64_t>& numbers = mesh_.point_numbers;
  order_ = ascending_order(numbers);
  std::vector<std::int64_t> ascending(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) ascending[i] = numbers[order_[i]];
  for (std::size_t i = 1; i < order_.size(); ++i) {
    if (ascending[i] != ascending[i - 1]) continue;
    fail_at(places_[order_[i]],
            fmt::format("the number '{}' of a point appears for the second time", ascending[i]));
  }
  tags_ = GmshTags(std::move(ascending));
}

void NastranPoints::read_point() {
  if (mesh_.points.size() == kMostVertices) fail({}, "too many points");
  mesh_.point_numbers.push_back(integer(0, "the number of a point", 1, INT64_MAX));
  const std::int64_t system = card_.field(1).empty() ? 0 : read_system(1);
  if (system != 0) waiting_[static_cast<std::uint32_t>(mesh_.points.size())] = system;
  Point& point = mesh_.points.emplace_back();
  bool is_long = false;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view field = card_.field(2 + static_cast<std::size_t>(axis));
    is_long = is_long || field.size() + (field.find('.') == std::string_view::npos) > kNastranRoom;
    point[axis] = 0;
    if (!field.empty() && !nastran_real(field, point[axis])) {
      fail(field,
           fmt::format("{} is not a finite number: expected a coordinate", in_quotes(field)));
    }
  }
  places_.push_back(card_.text.data());
  if (is_blank(5) && !is_long && system == 0) {
    lost_comments_ += card_.has_end_comments ? 1 : 0;
    return keep_nastran_comments(card_, mesh_.deck[nastran_cards]);
  }
  mesh_.deck[nastran_points] += card_text();
  // Output coordinates, constraints, superelement: only constraints mean the place.
  std::int64_t components = 0;
  const bool is_held =
      !card_.field(6).empty() && !(nastran_integer(card_.field(6), components) && components == 0);
  if (is_held) held_.push_back({mesh_.point_numbers.back(), card_.text.data()});
}

std::int64_t NastranPoints::read_system(std::size_t field) const {
  return integer(field, "the number of a coordinate system", 0, INT64_MAX);
}

void NastranPoints::read_definition() {
  try {
    systems_.add(card_);
  } catch (const NastranSystems::Failure& failure) {
    fail_at(failure.place, failure.reason);
  }
}

/// GRDSET means all points whose own field is blank. It may stand behind them.
void NastranPoints::apply_default_system() {
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    sources_.lines_from(places_[i], sources_.file_of(places_[i]).end()).read(card_);
    if (!card_.field(1).empty()) continue;
    waiting_[i] = default_system_;
    if (is_blank(5)) mesh_.deck[nastran_points] += card_text();
  }
}

void NastranPoints::place() {
  if (default_system_ != 0) apply_default_system();
  if (waiting_.empty()) return;
  for (std::uint32_t i = 0; i < places_.size(); ++i) place(i);
}

void NastranPoints::place(std::uint32_t i) {
  const auto waiting = waiting_.find(i);
  if (waiting == waiting_.end()) return;
  const std::int64_t system = waiting->second;
  try {
    const NastranSystem& found = systems_.find(system, [this](std::int64_t number) -> const Point* {
      const std::uint32_t point = find(number);
      if (point == GmshTags::kNone) return nullptr;
      place(point);
      return &mesh_.points[point];
    });
    mesh_.points[i] = found.to_basic(mesh_.points[i]);
  } catch (const NastranSystems::Failure& failure) {
    fail_at(failure.place == nullptr ? places_[i] : failure.place, failure.reason);
  }
  if (!mesh_.points[i].allFinite()) fail_at(places_[i], "the point lies beyond all numbers");
  waiting_.erase(i);
}

std::size_t NastranPoints::place_from(std::int64_t number) const {
  const auto at = std::partition_point(order_.begin(), order_.end(), [&](std::uint32_t i) {
    return mesh_.point_numbers[i] < number;
  });
  return static_cast<std::size_t>(at - order_.begin());
}

}  // namespace tetmend::formats
