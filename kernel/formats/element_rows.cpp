// SPDX-License-Identifier: MIT
// Elements of any kind, row by row: where a reader puts them, and how a writer sees them.
#include "kernel/formats/element_rows.h"

#include <algorithm>

namespace tetmend::formats {
namespace {

template <class Element>
void append_element(std::vector<Element>& elements, std::vector<std::int64_t>& numbers,
                    const ElementRow& row, bool with_numbers) {
  Element& made = elements.emplace_back();
  std::copy_n(row.vertices.begin(), made.vertices.size(), made.vertices.begin());
  made.label = row.label;
  if (with_numbers) numbers.push_back(row.number);
}

}  // namespace

OtherElements& ElementSorter::others(const ElementKind& kind) {
  std::size_t& place =
      place_of_kind_[static_cast<std::size_t>(element_kind(kind.vtk_type) - kElementKinds.data())];
  if (place == kNone) {
    place = mesh_.other_elements.size();
    mesh_.other_elements.push_back({kind.vtk_type, kind.width, {}, {}, {}, {}, {}});
  }
  return mesh_.other_elements[place];
}

void ElementSorter::add(const ElementRow& row, bool with_numbers) {
  switch (row.kind->vtk_type) {
    case vtk_tet:
      return append_element(mesh_.tets, mesh_.tet_numbers, row, with_numbers);
    case vtk_triangle:
      return append_element(mesh_.triangles, mesh_.triangle_numbers, row, with_numbers);
    case vtk_edge:
      return append_element(mesh_.edges, mesh_.edge_numbers, row, with_numbers);
    default: {
      OtherElements& others = this->others(*row.kind);
      others.vertices.insert(others.vertices.end(), row.vertices.begin(),
                             row.vertices.begin() + static_cast<std::ptrdiff_t>(row.kind->width));
      others.labels.push_back(row.label);
      if (with_numbers) others.numbers.push_back(row.number);
    }
  }
}

ElementLists::ElementLists(const MeshView& mesh) {
  const MeshData* data = mesh.data();
  static const MeshData kNothing;
  const MeshData& more = data == nullptr ? kNothing : *data;
  taken_numbers_ = more.taken_element_numbers;
  ElementList list;
  list.tets = more.tets;
  if (data == nullptr) {
    own_tets_.reserve(mesh.tet_count());
    std::vector<MeshData::Tet> memory;
    for (std::size_t block = 0; block < mesh.tet_blocks(); ++block) {
      const auto tets = mesh.tets(block, memory);
      own_tets_.insert(own_tets_.end(), tets.begin(), tets.end());
    }
    list.tets = own_tets_;
  }
  const auto add = [&](ElementList made, int type, std::size_t count, const auto& parts,
                       const auto& numbers, const auto& arrays) {
    made.kind = *element_kind(type);
    made.count = count;
    made.parts = parts.empty() ? nullptr : &parts;
    made.numbers = numbers.empty() ? nullptr : &numbers;
    made.data = &arrays;
    if (count > 0) lists_.push_back(made);
  };
  add(list, vtk_tet, list.tets.size(), more.tet_parts, more.tet_numbers, more.tet_data);
  list = {};
  list.triangles = mesh.triangles();
  add(list, vtk_triangle, list.triangles.size(), more.triangle_parts, more.triangle_numbers,
      more.triangle_data);
  list = {};
  list.edges = mesh.edges();
  add(list, vtk_edge, list.edges.size(), more.edge_parts, more.edge_numbers, more.edge_data);
  list = {};
  for (const OtherElements& others : more.other_elements) {
    const ElementKind* kind = element_kind(others.vtk_type);
    if (kind == nullptr || kind->width != others.vertex_count) continue;
    list.others = &others;
    add(list, others.vtk_type, others.labels.size(), others.parts, others.numbers, others.data);
  }
  std::stable_sort(lists_.begin(), lists_.end(), [](const ElementList& a, const ElementList& b) {
    return a.kind.dimension > b.kind.dimension;
  });
}

std::vector<const ElementList*> ElementLists::of_dimension(int dimension) const {
  std::vector<const ElementList*> found;
  for (const ElementList& list : lists_) {
    if (list.kind.dimension == dimension) found.push_back(&list);
  }
  return found;
}

}  // namespace tetmend::formats
