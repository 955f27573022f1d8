// SPDX-License-Identifier: MIT
// Numbers on nodes and elements of a Gmsh file.
//
//   k, k names | k, k reals (the time) | k, k integers (the step, components, n, the partition) as
//   text, then n rows: number, values
#include "kernel/formats/gmsh_views.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/gmsh_elements.h"

namespace tetmend::formats {
namespace {

void put_row(std::vector<double>& values, std::vector<bool>& given, std::size_t& missing,
             std::size_t row, const std::vector<double>& from) {
  std::copy(from.begin(), from.end(),
            values.begin() + static_cast<std::ptrdiff_t>(row * from.size()));
  if (!given[row]) --missing;
  given[row] = true;
}

std::string without_quotes(std::string_view line) {
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  if (line.size() >= 2 && line.front() == '"' && line.back() == '"') {
    line = line.substr(1, line.size() - 2);
  }
  return std::string(line);
}

/// None if one of the numbers is no label.
std::optional<std::vector<Label>> as_labels(const std::vector<double>& values) {
  std::vector<Label> labels;
  labels.reserve(values.size());
  for (const double value : values) {
    if (!(value >= INT32_MIN && value <= INT32_MAX) || value != std::floor(value)) return {};
    labels.push_back(static_cast<Label>(value));
  }
  return labels;
}

}  // namespace

void GmshViews::read_head(bool of_nodes) {
  TextReader& text = source_.text();
  View view;
  view.of_nodes = of_nodes;
  const std::size_t names = text.count("names of a view", 1);
  text.skip_line();
  for (std::size_t i = 0; i < names; ++i) {
    const std::string_view line = text.skip_line();
    if (i == 0) view.name = without_quotes(line);
  }
  const std::size_t reals = text.count("reals of a view", 2);
  for (std::size_t i = 0; i < reals; ++i) value(text);
  const std::int64_t integers = text.integer("the number of integers of a view", 3, 1000);
  text.integer("the time step of a view", INT32_MIN, INT32_MAX);
  view.components = static_cast<std::size_t>(text.integer("the components of a view", 1, 1000));
  const std::size_t row_size = source_.binary()
                                   ? sizeof(std::int32_t) + view.components * sizeof(double)
                                   : 2 * (1 + view.components);
  view.count = text.count("values of a view", row_size);
  for (std::int64_t i = 3; i < integers; ++i) text.label("an integer of a view");
  if (source_.binary()) text.skip_line();
  view.numbers = text.position();
  if (source_.binary()) text.bytes(view.count * row_size, "the values of a view");
  if (names_.insert({of_nodes, view.name}).second) {
    views_.push_back(std::move(view));
  } else {
    add_note(fmt::format("of view {} only the first step is kept", in_quotes(view.name)));
  }
}

void GmshViews::add_note(std::string note) {
  if (known_notes_.insert(note).second) notes_.push_back(std::move(note));
}

/// Views may have nan for "no value", which TextReader refuses.
double GmshViews::value(TextReader& text) const {
  const char* before = text.position();
  const std::string_view word = text.expect_word("a value of a view");
  double value = 0;
  const auto [stop, error] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && stop == word.data() + word.size() && !std::isfinite(value)) {
    return value;
  }
  text.seek(before);
  return text.real("a value of a view");
}

/// add(number, values, place of the row) for each row.
template <class Add>
void GmshViews::read_rows_of(const View& view, const Add& add) {
  TextReader text = source_.text();
  text.seek(view.numbers);
  std::vector<double> values(view.components);
  const char* row = view.numbers;
  for (std::size_t i = 0; i < view.count; ++i) {
    std::int64_t tag = 0;
    const char* place = row;
    if (source_.binary()) {
      tag = load<std::int32_t>(row, source_.swap());
      row += sizeof(std::int32_t);
      for (double& number : values) {
        number = load<double>(row, source_.swap());
        row += sizeof(double);
      }
    } else {
      tag = text.integer("the number of a row of a view", 0, INT64_MAX);
      place = text.last_word();
      for (double& number : values) number = value(text);
    }
    add(tag, values, place);
  }
  if (source_.binary()) return;
  const std::string_view end = text.expect_word("the end of a view");
  if (!end.starts_with("$End")) {
    text.fail(
        fmt::format("{} is not expected here: expected the end of a view, for it has {} values",
                    in_quotes(end), view.count));
  }
}

void GmshViews::move_into(MeshData& mesh, const GmshNodes& nodes,
                          const std::array<GmshTags, 3>& tags) {
  for (const View& view : views_) {
    if (view.of_nodes) {
      add_point_data(view, nodes, mesh);
    } else {
      add_element_data(view, tags, mesh);
    }
  }
  mesh.notes.insert(mesh.notes.end(), notes_.begin(), notes_.end());
}

void GmshViews::add_point_data(const View& view, const GmshNodes& nodes, MeshData& mesh) {
  const std::size_t size = mesh.points.size();
  // Rows may repeat a node, but take memory for all only if there are enough of them.
  if (view.count < size) {
    add_note(fmt::format("view {} is not kept, for it has no values for some nodes",
                         in_quotes(view.name)));
    return;
  }
  std::vector<double> values(size * view.components);
  std::vector<bool> given(size);
  std::size_t missing = size;
  read_rows_of(view, [&](std::int64_t tag, const std::vector<double>& row, const char* place) {
    const std::uint32_t node = nodes.find(tag);
    if (node == GmshTags::kNone) {
      source_.text().fail_at(
          place, fmt::format("'{}' is not the number of a node: expected one of $Nodes", tag));
    }
    put_row(values, given, missing, node, row);
  });
  if (missing > 0) {
    add_note(fmt::format("view {} is not kept, for it has no values for some nodes",
                         in_quotes(view.name)));
    return;
  }
  if (view.name == kGmshPointLabels && view.components == 1) {
    if (auto labels = as_labels(values)) {
      mesh.point_labels = std::move(*labels);
      return drop_zero_point_labels(mesh);
    }
  }
  mesh.point_data.push_back({view.name, view.components, std::move(values)});
}

void GmshViews::add_element_data(const View& view, const std::array<GmshTags, 3>& tags,
                                 MeshData& mesh) {
  const std::array<std::size_t, 3> sizes = {mesh.tets.size(), mesh.triangles.size(),
                                            mesh.edges.size()};
  constexpr std::array<std::string_view, 3> kNames = {"tetrahedra", "triangles", "edges"};
  const std::array<std::vector<DataArray>*, 3> arrays = {&mesh.tet_data, &mesh.triangle_data,
                                                         &mesh.edge_data};
  std::array<Filled, 3> kinds;
  for (std::size_t k = 0; k < 3; ++k) kinds[k].missing = sizes[k];
  std::size_t others = 0;
  read_rows_of(view, [&](std::int64_t tag, const std::vector<double>& row, const char*) {
    std::size_t k = 0;
    std::uint32_t element = GmshTags::kNone;
    while (k < 3 && (element = tags[k].find(tag)) == GmshTags::kNone) ++k;
    if (k == 3) return void(++others);
    Filled& kind = kinds[k];
    if (view.count < sizes[k]) return void(kind.given.resize(1));
    kind.values.resize(sizes[k] * view.components);
    kind.given.resize(sizes[k]);
    put_row(kind.values, kind.given, kind.missing, element, row);
  });
  for (std::size_t k = 0; k < 3; ++k) {
    if (kinds[k].given.empty()) continue;
    if (kinds[k].missing == 0) {
      arrays[k]->push_back({view.name, view.components, std::move(kinds[k].values)});
    } else {
      add_note(fmt::format("view {} is not kept for {}, for it has no values for some",
                           in_quotes(view.name), kNames[k]));
    }
  }
  if (others > 0) {
    add_note(
        fmt::format("of view {} {} values are not kept, which belong to no "
                    "tetrahedron, triangle or edge",
                    in_quotes(view.name), others));
  }
}

}  // namespace tetmend::formats
