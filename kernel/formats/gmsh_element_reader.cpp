// SPDX-License-Identifier: MIT
// The section $Elements of a Gmsh file.
//
//   2.2 text:    n, then n rows: number type k, k tags (group, entity, partitions), nodes
//   2.2 binary:  n, then runs: type m k, m rows: number, k tags, nodes
//   4.1:         blocks n least greatest, then blocks: dimension tag type m, m rows: number, nodes
#include "kernel/formats/gmsh_element_reader.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"

namespace tetmend::formats {
namespace {

constexpr std::string_view kElementNumber = "the number of an element";
constexpr std::string_view kNode = "the number of a node";

/// Elements of one type are counted in 32 bits.
constexpr std::size_t kMostElements = UINT32_MAX - 1;

}  // namespace

/// An element of a text file of version 2.2, whose type is not known beforehand.
struct GmshElementReader::Row {
  std::int64_t tag;
  int type;
  Label group;
  Label entity;
  bool partitioned;
  std::array<std::uint32_t, 4> vertices;  // of an element with so many
  const char* nodes;                      // behind which the others stand
  const char* place;
};

int GmshElementReader::known_type(const char* at, std::int64_t type) const {
  if (type < 1 || type >= kGmshTypes) {
    source_.text().fail_at(at, fmt::format("elements of type {} cannot be read: expected types of "
                                           "first or second order, 1 to {}",
                                           type, kGmshTypes - 1));
  }
  return static_cast<int>(type);
}

int GmshElementReader::read_type() {
  const std::int64_t type = source_.integer("the type of elements", INT32_MIN, INT32_MAX);
  return known_type(source_.text().last_word(), type);
}

/// Room for `count` more elements of a type.
GmshRows& GmshElementReader::grow(int type, std::size_t count) {
  GmshRows& rows = draft_.rows[static_cast<std::size_t>(type)];
  const std::size_t size = rows.size() + count;
  if (size > kMostElements) source_.text().fail(fmt::format("{} elements are too many", size));
  rows.tags.resize(size);
  rows.labels.resize(size);
  rows.parts.resize(size);
  rows.vertices.resize(size * gmsh_type(type).width);
  if (with_places_) rows.places.resize(size);
  return rows;
}

void GmshElementReader::fail_without_node(const char* at, std::int64_t tag) const {
  source_.text().fail_at(
      at, fmt::format("'{}' is not the number of a node: expected one of $Nodes", tag));
}

std::uint32_t GmshElementReader::vertex(TextReader& text) const {
  const std::int64_t tag = text.integer(kNode, 0, INT64_MAX);
  const std::uint32_t found = nodes_.find(tag);
  if (found == GmshTags::kNone) {
    text.fail(fmt::format("'{}' is not the number of a node: expected one of $Nodes", tag));
  }
  return found;
}

template <class Integer>
std::uint32_t GmshElementReader::vertex_at(const char* at) const {
  const auto tag = load<Integer>(at, source_.swap());
  const std::uint32_t found = nodes_.find(tag);
  if (found == GmshTags::kNone) fail_without_node(at, tag);
  return found;
}

void GmshElementReader::read_4() {
  source_.begin_numbers();
  const std::size_t blocks = source_.count("blocks of elements", 8, 20);
  const std::size_t count =
      source_.count("elements", std::string_view("1 1\n").size(), 2 * source_.wide_size());
  source_.wide("the least number of an element", 0, INT64_MAX);
  source_.wide("the greatest number of an element", 0, INT64_MAX);
  std::size_t read = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const int dimension = static_cast<int>(source_.integer("the dimension of an entity", 0, 3));
    const char* at = source_.text().last_word();
    Label part = source_.tag("the number of an entity");
    const auto parent = draft_.parents.find({dimension, part});
    const bool is_between = parent != draft_.parents.end() && parent->second.first > dimension;
    if (parent != draft_.parents.end() && !is_between) part = parent->second.second;
    const int type = read_type();
    if (gmsh_type(type).dimension != dimension) {
      source_.text().fail_at(at, fmt::format("'{}' is not the dimension of type {}: expected {}",
                                             dimension, type, gmsh_type(type).dimension));
    }
    const auto size = static_cast<std::size_t>(
        source_.wide("the elements of a block", 0, static_cast<std::int64_t>(count - read)));
    const auto groups = draft_.groups_of.find({dimension, part});
    const bool has_group = groups != draft_.groups_of.end() && !groups->second.empty();
    GmshRows& rows = draft_.rows[static_cast<std::size_t>(type)];
    const std::size_t before = rows.size();
    read_block(type, size, has_group ? groups->second.front() : 0, part);
    if (is_between) rows.shorten(before, gmsh_type(type).width);
    read += size;
  }
  if (read != count) {
    source_.text().fail_at(source_.text().position(),
                           fmt::format("the blocks hold {} elements: expected {}", read, count));
  }
}

void GmshElementReader::read_block(int type, std::size_t count, Label label, Label part) {
  const std::size_t width = gmsh_type(type).width;
  TextReader& text = source_.text();
  if (count > text.bytes_left() /
                  (source_.binary() ? source_.wide_size() * (width + 1) : 2 * (width + 1))) {
    text.fail(
        fmt::format("{} elements of type {} cannot fit into the {} bytes that are left: the "
                    "count is wrong or the file is truncated",
                    count, type, text.bytes_left()));
  }
  const std::size_t first = draft_.rows[static_cast<std::size_t>(type)].size();
  GmshRows& rows = grow(type, count);
  std::fill(rows.labels.begin() + static_cast<std::ptrdiff_t>(first), rows.labels.end(), label);
  std::fill(rows.parts.begin() + static_cast<std::ptrdiff_t>(first), rows.parts.end(), part);
  if (!source_.binary()) {
    return source_.rows(count, [&](TextReader& line, std::size_t i) {
      rows.tags[first + i] = line.integer(kElementNumber, 0, INT64_MAX);
      const char* place = line.last_word();
      std::uint32_t* v = rows.vertices.data() + (first + i) * width;
      for (std::size_t k = 0; k < width; ++k) v[k] = vertex(line);
      if (!rows.places.empty()) rows.places[first + i] = place;
    });
  }
  const std::size_t row_size = (1 + width) * source_.wide_size();
  const char* row = text.bytes(count * row_size, "the elements of a block");
  for (std::size_t i = first; i < first + count; ++i, row += row_size) {
    rows.tags[i] = source_.wide_at(row, kElementNumber);
    std::uint32_t* v = rows.vertices.data() + i * width;
    for (std::size_t k = 0; k < width; ++k) {
      const char* at = row + (k + 1) * source_.wide_size();
      v[k] = source_.wide_size() == 8 ? vertex_at<std::int64_t>(at) : vertex_at<std::uint32_t>(at);
    }
    if (!rows.places.empty()) rows.places[i] = row;
  }
}

void GmshElementReader::read_2() {
  TextReader& text = source_.text();
  // The count is text also in a binary file.
  const std::size_t count =
      text.count("elements", source_.binary() ? 8 : std::string_view("1 15 0 1\n").size());
  if (source_.binary()) {
    text.skip_line();
    read_binary_2(count);
  } else {
    read_text_2(count);
  }
}

void GmshElementReader::read_text_2(std::size_t count) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 18;
  std::vector<Row> rows(std::min(count, kAtOnce));
  for (std::size_t done = 0; done < count; done += rows.size()) {
    rows.resize(std::min(rows.size(), count - done));
    source_.rows(rows.size(), [&](TextReader& text, std::size_t i) { rows[i] = read_row(text); });
    for (const Row& row : rows) add(row);
  }
}

GmshElementReader::Row GmshElementReader::read_row(TextReader& text) const {
  Row row{};
  row.tag = text.integer(kElementNumber, 0, INT64_MAX);
  row.place = text.last_word();
  const std::int64_t type = text.integer("the type of an element", INT32_MIN, INT32_MAX);
  if (type < 1 || type >= kGmshTypes) {
    text.fail(
        fmt::format("elements of type {} cannot be read: expected types of first or second "
                    "order, 1 to {}",
                    type, kGmshTypes - 1));
  }
  row.type = static_cast<int>(type);
  const std::int64_t tags = text.integer("the number of tags", 0, INT32_MAX);
  for (std::int64_t k = 0; k < tags; ++k) {
    const Label tag = text.label("a tag of an element");
    if (k == 0) row.group = tag;
    if (k == 1) row.entity = tag;
    if (k > 1) row.partitioned |= tag != 0;
  }
  row.nodes = text.position();
  const std::size_t width = gmsh_type(row.type).width;
  for (std::size_t k = 0; k < width; ++k) {
    const std::uint32_t v = vertex(text);
    if (k < row.vertices.size()) row.vertices[k] = v;
  }
  return row;
}

void GmshElementReader::add(const Row& row) {
  const std::size_t width = gmsh_type(row.type).width;
  GmshRows& rows = draft_.rows[static_cast<std::size_t>(row.type)];
  rows.tags.push_back(row.tag);
  rows.labels.push_back(row.group);
  rows.parts.push_back(row.entity);
  if (width <= row.vertices.size()) {
    rows.vertices.insert(rows.vertices.end(), row.vertices.begin(), row.vertices.begin() + width);
  } else {
    TextReader text = source_.text().trial(row.nodes);
    for (std::size_t k = 0; k < width; ++k) rows.vertices.push_back(vertex(text));
  }
  if (with_places_) rows.places.push_back(row.place);
  partitioned_ |= row.partitioned;
}

void GmshElementReader::read_binary_2(std::size_t count) {
  for (std::size_t read = 0; read < count;) {
    const int type = read_type();
    const auto size = static_cast<std::size_t>(source_.integer(
        "the number of elements of a run", 1,
        std::min<std::int64_t>(INT32_MAX, static_cast<std::int64_t>(count - read))));
    const auto tags = static_cast<std::size_t>(source_.integer("the number of tags", 0, INT32_MAX));
    read_run(type, size, tags);
    read += size;
  }
}

void GmshElementReader::read_run(int type, std::size_t count, std::size_t tags) {
  constexpr std::size_t kSize = sizeof(std::int32_t);
  const std::size_t width = gmsh_type(type).width;
  const std::size_t row_size = (1 + tags + width) * kSize;
  TextReader& text = source_.text();
  const char* row = text.bytes(count * row_size, "the elements of a run");
  const std::size_t first = draft_.rows[static_cast<std::size_t>(type)].size();
  GmshRows& rows = grow(type, count);
  const auto tag = [&](std::size_t k) {
    return load<Label>(row + (1 + k) * kSize, source_.swap());
  };
  for (std::size_t i = first; i < first + count; ++i, row += row_size) {
    rows.tags[i] = source_.checked<std::int32_t>(row, kElementNumber, 0, INT32_MAX);
    if (tags > 0) rows.labels[i] = tag(0);
    if (tags > 1) rows.parts[i] = tag(1);
    for (std::size_t k = 2; k < tags; ++k) partitioned_ |= tag(k) != 0;
    std::uint32_t* v = rows.vertices.data() + i * width;
    for (std::size_t k = 0; k < width; ++k) {
      v[k] = vertex_at<std::int32_t>(row + (1 + tags + k) * kSize);
    }
    if (!rows.places.empty()) rows.places[i] = row;
  }
}

}  // namespace tetmend::formats
