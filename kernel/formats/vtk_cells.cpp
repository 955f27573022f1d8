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

// Cells without volume, which a mesh of tetrahedra can do without.
constexpr std::array<std::int64_t, 21> kPassedCells = {0,  1,  2,  4,  6,  7,  8,  9,  21, 22, 23,
                                                       28, 30, 34, 35, 36, 68, 69, 70, 75, 76};

class Assembly {
 public:
  Assembly(const VtkCells& cells, const std::vector<Label>& labels, TextReader& text,
           MeshData& mesh, TetPlace* question)
      : cells_(cells), labels_(labels), text_(text), mesh_(mesh), question_(question) {}

  void run() {
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
    if (type == 10) return add_element(mesh_.tets, cell, begin, size);
    if (type == 5) return add_element(mesh_.triangles, cell, begin, size);
    if (type == 3) return add_element(mesh_.edges, cell, begin, size);
    if (std::find(kPassedCells.begin(), kPassedCells.end(), type) != kPassedCells.end()) return;
    text_.fail_at(
        cells_.types.locate(text_, cell),
        fmt::format(
            "a cell of type '{}' ({}) cannot be read: expected tetrahedra (10), triangles (5) "
            "and lines (3)",
            type, cell_name(type)));
  }

  static std::string_view cell_name(std::int64_t type) {
    if (type == 11) return "voxel";
    if (type == 12) return "hexahedron";
    if (type == 13) return "wedge";
    if (type == 14) return "pyramid";
    if (type == 24 || type == 71 || type == 78) return "tetrahedron of higher order";
    return "another volume";
  }

  template <class Element>
  void add_element(std::vector<Element>& elements, std::size_t cell, std::size_t begin,
                   std::size_t size) {
    Element element;
    const std::size_t place = cells_.has_offsets || size == 0 ? begin : begin - 1;
    if (size != element.vertices.size()) {
      text_.fail_at(locate_vertex(place),
                    fmt::format("'{}' is not the number of vertices of a {}: expected {}", size,
                                element_name(element), element.vertices.size()));
    }
    for (std::size_t i = 0; i < size; ++i) {
      const std::int64_t vertex = cells_.connectivity[begin + i];
      if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= mesh_.points.size()) {
        text_.fail_at(locate_vertex(begin + i),
                      fmt::format("'{}' is out of range: expected a vertex number, 0 to {}", vertex,
                                  static_cast<std::int64_t>(mesh_.points.size()) - 1));
      }
      element.vertices[i] = static_cast<std::uint32_t>(vertex);
    }
    if (has_repeated_vertex(element.vertices)) {
      text_.fail_at(locate_vertex(begin), repeated_vertex_message(element, 0));
    }
    element.label = labels_.empty() ? 0 : labels_[cell];
    elements.push_back(element);
    if (is_asked_for(question_, elements, elements.back())) {
      question_->place = text_.place_of(locate_vertex(begin));
    }
  }

  const char* locate_vertex(std::size_t i) { return cells_.connectivity.locate(text_, i); }

  const VtkCells& cells_;
  const std::vector<Label>& labels_;
  TextReader& text_;
  MeshData& mesh_;
  TetPlace* question_;
};

}  // namespace

void VtkCells::append_to(MeshData& mesh, const std::vector<Label>& labels, TextReader& text,
                         TetPlace* question) const {
  Assembly(*this, labels, text, mesh, question).run();
}

}  // namespace tetmend::formats
