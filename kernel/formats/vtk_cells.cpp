// SPDX-License-Identifier: MIT
// The cells of a legacy VTK file, and how they become elements of a mesh.
#include "kernel/formats/vtk_cells.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"

namespace tetmend::formats {
namespace {

/// Cells whose integers are no plain list of vertices, and tets of an order that nothing here keeps.
bool is_refused(std::int64_t type, std::size_t size) {
  if (type == 71) return size != 10;
  constexpr std::array<std::int64_t, 4> kTypes = {41, 42, 78, 79};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

constexpr std::int64_t kHighestType = 81;

class Assembly {
 public:
  Assembly(const VtkCells& cells, TextReader& text, MeshData& mesh, TetPlace* question)
      : cells_(cells), text_(text), mesh_(mesh), question_(question) {}

  CellNumbers run() {
    if (cells_.types.size() != cells_.count) {
      text_.fail_at(cells_.types.locate(text_, 0),
                    fmt::format("there are {} cell types for {} cells: expected as many",
                                cells_.types.size(), cells_.count));
    }
    mesh_.tets.reserve(static_cast<std::size_t>(count_type(10)));
    std::size_t position = 0;
    for (std::size_t cell = 0; cell < cells_.count; ++cell) {
      const auto [begin, end] =
          cells_.has_offsets ? range_by_offsets(cell) : range_by_size(position);
      add_cell(cell, begin, end - begin);
      position = end;
    }
    if (position != cells_.connectivity.size()) {
      text_.fail_at(cells_.connectivity.locate(text_, position),
                    fmt::format("the {} cells take {} integers: expected {}, as CELLS says",
                                cells_.count, position, cells_.connectivity.size()));
    }
    if (empty_cells_ > 0) {
      mesh_.notes.push_back(fmt::format("{} empty cells are not kept", empty_cells_));
    }
    return std::move(numbers_);
  }

 private:
  struct Range {
    std::size_t begin;
    std::size_t end;
  };

  std::ptrdiff_t count_type(std::int64_t type) const {
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < cells_.types.size(); ++i) count += cells_.types[i] == type;
    return count;
  }

  Range range_by_offsets(std::size_t cell) {
    const std::int64_t begin = cells_.offsets[cell];
    const std::int64_t end = cells_.offsets[cell + 1];
    if (begin < 0 || (cell == 0 && begin != 0) || end < begin ||
        static_cast<std::uint64_t>(end) > cells_.connectivity.size()) {
      text_.fail_at(
          cells_.offsets.locate(text_, cell + 1),
          fmt::format("the offsets {} and {} of a cell are wrong: expected to grow from 0 to {}",
                      begin, end, cells_.connectivity.size()));
    }
    return {static_cast<std::size_t>(begin), static_cast<std::size_t>(end)};
  }

  Range range_by_size(std::size_t position) {
    const std::size_t left = cells_.connectivity.size() - position;
    const std::int64_t size = left == 0 ? -1 : cells_.connectivity[position];
    if (size < 0 || static_cast<std::uint64_t>(size) > left - 1) {
      const std::string given =
          left == 0 ? "the cells end too early" : fmt::format("'{}' is wrong", size);
      text_.fail_at(cells_.connectivity.locate(text_, position),
                    fmt::format("{}: expected the number of vertices of a cell, at most {}", given,
                                left == 0 ? 0 : left - 1));
    }
    return {position + 1, position + 1 + static_cast<std::size_t>(size)};
  }

  void add_cell(std::size_t cell, std::size_t begin, std::size_t size) {
    const std::int64_t type = cells_.types[cell];
    const auto number = static_cast<std::uint32_t>(cell);
    if (type == 10) {
      add_element(mesh_.tets, begin, size);
      numbers_.tets.push_back(number);
    } else if (type == 5) {
      add_element(mesh_.triangles, begin, size);
      numbers_.triangles.push_back(number);
    } else if (type == 3) {
      add_element(mesh_.edges, begin, size);
      numbers_.edges.push_back(number);
    } else if (size == 0 && type == 0) {
      ++empty_cells_;
    } else if (type > 0 && type <= kHighestType && !is_refused(type, size)) {
      add_other(type, cell, begin, size);
    } else {
      refuse(type, cell);
    }
  }

  [[noreturn]] void refuse(std::int64_t type, std::size_t cell) const {
    text_.fail_at(cells_.types.locate(text_, cell),
                  fmt::format("a cell of type '{}' ({}) cannot be read: expected tetrahedra (10), "
                              "triangles (5), lines (3) or other cells of first or second order",
                              type, refused_name(type)));
  }

  static std::string_view refused_name(std::int64_t type) {
    if (type == 71 || type == 78) return "tetrahedron of higher order";
    if (type == 41 || type == 42) return "polyhedron";
    return type == 79 ? "volume of higher order" : "no type of VTK";
  }

  /// Cells of one type and size make one list.
  void add_other(std::int64_t type, std::size_t cell, std::size_t begin, std::size_t size) {
    const auto is_like = [&](const OtherElements& other) {
      return other.vtk_type == type && other.vertex_count == size;
    };
    auto& lists = mesh_.other_elements;
    auto found = std::find_if(lists.begin(), lists.end(), is_like);
    if (found == lists.end()) {
      lists.push_back({static_cast<int>(type), size, {}, {}, {}, {}, {}});
      numbers_.others.emplace_back();
      found = lists.end() - 1;
    }
    for (std::size_t i = 0; i < size; ++i) found->vertices.push_back(vertex_at(begin + i));
    found->labels.push_back(0);
    numbers_.others[static_cast<std::size_t>(found - lists.begin())].push_back(
        static_cast<std::uint32_t>(cell));
  }

  std::uint32_t vertex_at(std::size_t place) {
    const std::int64_t vertex = cells_.connectivity[place];
    if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= mesh_.points.size()) {
      text_.fail_at(locate_vertex(place),
                    fmt::format("'{}' is out of range: expected a vertex number, 0 to {}", vertex,
                                static_cast<std::int64_t>(mesh_.points.size()) - 1));
    }
    return static_cast<std::uint32_t>(vertex);
  }

  template <class Element>
  void add_element(std::vector<Element>& elements, std::size_t begin, std::size_t size) {
    Element element;
    const std::size_t place = cells_.has_offsets || size == 0 ? begin : begin - 1;
    if (size != element.vertices.size()) {
      text_.fail_at(locate_vertex(place),
                    fmt::format("'{}' is not the number of vertices of a {}: expected {}", size,
                                element_name(element), element.vertices.size()));
    }
    for (std::size_t i = 0; i < size; ++i) element.vertices[i] = vertex_at(begin + i);
    elements.push_back(element);
    if (is_asked_for(question_, elements, elements.back())) {
      question_->place = text_.place_of(locate_vertex(begin));
    }
  }

  const char* locate_vertex(std::size_t i) { return cells_.connectivity.locate(text_, i); }

  const VtkCells& cells_;
  TextReader& text_;
  MeshData& mesh_;
  TetPlace* question_;
  CellNumbers numbers_;
  std::size_t empty_cells_ = 0;
};

}  // namespace

CellNumbers VtkCells::append_to(MeshData& mesh, TextReader& text, TetPlace* question) const {
  return Assembly(*this, text, mesh, question).run();
}

}  // namespace tetmend::formats
