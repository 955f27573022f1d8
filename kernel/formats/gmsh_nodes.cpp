// SPDX-License-Identifier: MIT
// The section $Nodes of a Gmsh file.
//
//   2.2: n, then n rows: number x y z
//   4.1: blocks n least greatest, then blocks: dimension tag parametric k, k numbers, k places
#include "kernel/formats/gmsh_nodes.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"

namespace tetmend::formats {
namespace {

constexpr std::string_view kNodeNumber = "the number of a node";
constexpr std::string_view kCoordinate = "a coordinate of a node";

}  // namespace

std::size_t GmshNodes::begin(std::size_t count) {
  if (count > kMostVertices) source_.text().fail(fmt::format("{} nodes are too many", count));
  points.reserve(count);
  numbers_.reserve(count);
  return count;
}

/// Behind the coordinates: the dimension and the number of the entity, and what places the node on it.
void GmshNodes::read_parametric_2() {
  TextReader& text = source_.text();
  parametric_ = true;
  const std::size_t row_size = 3 * sizeof(std::int32_t) + 3 * sizeof(double);
  const std::size_t count = begin(
      text.count("nodes", source_.binary() ? row_size : std::string_view("1 0 0 0 0 1\n").size()));
  source_.begin_numbers();
  blocks_.push_back({0, text.position(), 0, 0});
  for (std::size_t i = 0; i < count; ++i) {
    numbers_.push_back(source_.integer(kNodeNumber, 0, INT32_MAX));
    Point& point = points.emplace_back();
    for (int axis = 0; axis < 3; ++axis) point[axis] = source_.real(kCoordinate);
    const std::int64_t dimension = source_.integer("the dimension of an entity", 0, 3);
    source_.tag("the number of an entity");
    for (std::int64_t k = 0; k < dimension % 3; ++k) source_.real("a parameter of a node");
  }
  sort();
}

void GmshNodes::read_2(bool is_parametric) {
  if (is_parametric) return read_parametric_2();

  constexpr std::size_t kRowSize = sizeof(std::int32_t) + 3 * sizeof(double);
  // The count is text also in a binary file.
  TextReader& text = source_.text();
  const std::size_t count = begin(
      text.count("nodes", source_.binary() ? kRowSize : std::string_view("1 0 0 0\n").size()));
  points.resize(count);
  numbers_.resize(count);
  if (source_.binary()) {
    text.skip_line();
    const char* row = text.bytes(count * kRowSize, "the nodes");
    blocks_.push_back({0, row, kRowSize, 0});
    for (std::size_t i = 0; i < count; ++i, row += kRowSize) {
      numbers_[i] = source_.checked<std::int32_t>(row, kNodeNumber, 0, INT32_MAX);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        points[i][static_cast<Eigen::Index>(axis)] =
            source_.finite(row + sizeof(std::int32_t) + axis * sizeof(double), kCoordinate);
      }
    }
  } else {
    blocks_.push_back({0, text.position(), 0, 4});
    source_.rows(count, [this](TextReader& part, std::size_t i) {
      numbers_[i] = part.integer(kNodeNumber, 0, INT64_MAX);
      for (int axis = 0; axis < 3; ++axis) points[i][axis] = part.real(kCoordinate);
    });
  }
  sort();
}

void GmshNodes::read_4() {
  source_.begin_numbers();
  const std::size_t blocks = source_.count("blocks of nodes", 8, 20);
  const std::size_t count = begin(source_.count("nodes", std::string_view("1\n0 0 0\n").size(),
                                                source_.wide_size() + 3 * sizeof(double)));
  entities.reserve(count);
  source_.wide("the least number of a node", 0, INT64_MAX);
  source_.wide("the greatest number of a node", 0, INT64_MAX);
  for (std::size_t block = 0; block < blocks; ++block) {
    const int dimension = static_cast<int>(source_.integer("the dimension of an entity", 0, 3));
    const Label tag = source_.tag("the number of an entity");
    const bool parametric = source_.integer("whether nodes have parameters", 0, 1) == 1;
    const auto left = static_cast<std::int64_t>(count - points.size());
    const auto size = static_cast<std::size_t>(source_.wide("the nodes of a block", 0, left));
    parametric_ |= parametric;
    read_block(size, dimension, tag, parametric ? static_cast<std::size_t>(dimension) : 0);
  }
  if (points.size() != count) {
    source_.text().fail_at(
        source_.text().position(),
        fmt::format("the blocks hold {} nodes: expected {}", points.size(), count));
  }
  sort();
}

void GmshNodes::read_block(std::size_t count, int dimension, Label tag, std::size_t parameters) {
  const std::size_t first = points.size();
  points.resize(first + count);
  numbers_.resize(first + count);
  entities.resize(first + count, {dimension, tag});
  read_tags(first, count);
  read_places(first, count, parameters);
}

void GmshNodes::read_tags(std::size_t first, std::size_t count) {
  TextReader& text = source_.text();
  blocks_.push_back({first, text.position(), source_.wide_size(), 1});
  if (!source_.binary()) {
    return source_.rows(count, [&](TextReader& part, std::size_t i) {
      numbers_[first + i] = part.integer(kNodeNumber, 0, INT64_MAX);
    });
  }
  const char* at = text.bytes(count * source_.wide_size(), "the numbers of nodes");
  for (std::size_t i = 0; i < count; ++i, at += source_.wide_size()) {
    numbers_[first + i] = source_.wide_at(at, kNodeNumber);
  }
}

void GmshNodes::read_places(std::size_t first, std::size_t count, std::size_t parameters) {
  if (!source_.binary()) {
    return source_.rows(count, [&](TextReader& part, std::size_t i) {
      for (int axis = 0; axis < 3; ++axis) points[first + i][axis] = part.real(kCoordinate);
      for (std::size_t k = 0; k < parameters; ++k) part.real("a parameter of a node");
    });
  }
  const std::size_t row_size = (3 + parameters) * sizeof(double);
  const char* row = source_.text().bytes(count * row_size, "the places of nodes");
  for (std::size_t i = first; i < first + count; ++i, row += row_size) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points[i][static_cast<Eigen::Index>(axis)] =
          source_.finite(row + axis * sizeof(double), kCoordinate);
    }
  }
}

void GmshNodes::sort() {
  std::vector<std::uint32_t> order;
  if (!std::is_sorted(numbers_.begin(), numbers_.end())) {
    order = ascending_order(numbers_);
    reorder(numbers_, order);
    reorder(points, order);
    reorder(entities, order);
  }
  const auto twice = std::adjacent_find(numbers_.begin(), numbers_.end());
  if (twice != numbers_.end()) {
    const auto second = static_cast<std::size_t>(twice - numbers_.begin()) + 1;
    source_.text().fail_at(
        place_of_tag(order.empty() ? second : order[second]),
        fmt::format("the number '{}' of a node appears for the second time", *twice));
  }
  tags_ = GmshTags(std::move(numbers_));
}

/// `node` in the order of the file.
const char* GmshNodes::place_of_tag(std::size_t node) {
  const auto after = std::find_if(blocks_.begin(), blocks_.end(),
                                  [&](const Block& block) { return block.first > node; });
  const Block& block = *(after - 1);
  if (source_.binary()) return block.at + (node - block.first) * block.stride;
  TextReader text = source_.text();
  text.seek(block.at);
  for (std::size_t i = 0; i < (node - block.first) * block.words; ++i) text.word();
  text.word();
  return text.last_word();
}

}  // namespace tetmend::formats
