// SPDX-License-Identifier: MIT
#include "kernel/second_order.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/harmless_notes.h"
#include "kernel/lists_of_kind.h"

namespace tetmend {

namespace {

/// VTK's types: its own and those of Lagrange, which have the same nodes.
std::size_t corner_count_of(const OtherElements& others) {
  const auto is = [&](int type, int lagrange, std::size_t nodes) {
    return (others.vtk_type == type || others.vtk_type == lagrange) && others.vertex_count == nodes;
  };
  if (is(24, 71, 10)) return 4;
  if (is(22, 69, 6)) return 3;
  if (is(21, 68, 3)) return 2;
  return 0;
}

void append_rows(DataArray& to, const DataArray& from) {
  std::visit(
      [&](auto& values) {
        using Values = std::decay_t<decltype(values)>;
        if (const auto* more = std::get_if<Values>(&from.values)) {
          values.insert(values.end(), more->begin(), more->end());
        }
      },
      to.values);
}

void append_zeros(DataArray& to, std::size_t count) {
  std::visit([&](auto& values) { values.resize(values.size() + count * to.components); },
             to.values);
}

/// Arrays of `more` follow; where one of the two has none of a name, there are zeros.
void append_data(std::vector<DataArray>& to, std::size_t count, const std::vector<DataArray>& more,
                 std::size_t more_count) {
  for (const DataArray& array : more) {
    const auto same = [&](const DataArray& other) {
      return other.name == array.name && other.components == array.components &&
             other.values.index() == array.values.index();
    };
    auto found = std::find_if(to.begin(), to.end(), same);
    if (found == to.end()) {
      DataArray made = array;
      std::visit([](auto& values) { values.clear(); }, made.values);
      append_zeros(made, count);
      found = to.insert(to.end(), std::move(made));
    }
    append_rows(*found, array);
  }
  for (DataArray& array : to) {
    const std::size_t missing = (count + more_count) * array.components - array.size();
    append_zeros(array, missing / array.components);
  }
}

/// Both empty, or filled up with zeros and joined.
template <class Value>
void append_or_fill(std::vector<Value>& to, std::size_t count, const std::vector<Value>& more,
                    std::size_t more_count) {
  if (to.empty() && more.empty()) return;
  to.resize(count);
  to.insert(to.end(), more.begin(), more.end());
  to.resize(count + more_count);
}

class Taking {
 public:
  explicit Taking(MeshData& mesh) : mesh_(mesh) {}

  void run() {
    for (const OtherElements& others : mesh_.other_elements) {
      switch (corner_count_of(others)) {
        case 4:
          take<4>(others, tets_of(mesh_));
          break;
        case 3:
          take<3>(others, triangles_of(mesh_));
          break;
        case 2:
          take<2>(others, edges_of(mesh_));
          break;
        default:
          continue;
      }
    }
    std::erase_if(mesh_.other_elements,
                  [](const OtherElements& others) { return corner_count_of(others) != 0; });
    join_edges();
    check_nodes();
  }

 private:
  template <std::size_t N, class ListsOf>
  void take(const OtherElements& others, const ListsOf& lists) {
    const std::size_t before = lists.elements.size();
    const std::size_t count = others.labels.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t* nodes = &others.vertices[i * others.vertex_count];
      auto& element = lists.elements.emplace_back();
      std::copy_n(nodes, N, element.vertices.begin());
      element.label = others.labels[i];
      for (std::size_t e = 0; e + N < others.vertex_count; ++e) {
        const std::uint32_t a = nodes[kMidNodeEdges[e][0]];
        const std::uint32_t b = nodes[kMidNodeEdges[e][1]];
        mesh_.mid_nodes.push_back({std::min(a, b), std::max(a, b), nodes[N + e]});
      }
    }
    append_or_fill(lists.parts, before, others.parts, count);
    append_or_fill(lists.numbers, before, others.numbers, count);
    append_data(lists.data, before, others.data, count);
  }

  void join_edges() {
    auto& all = mesh_.mid_nodes;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (all[i][0] != all[i - 1][0] || all[i][1] != all[i - 1][1]) continue;
      throw Error(
          fmt::format("the edge of the points {} and {}, counted from 0, has two nodes, {} "
                      "and {}: expected one",
                      all[i][0], all[i][1], all[i - 1][2], all[i][2]));
    }
  }

  void check_nodes() const {
    std::vector<std::uint8_t> use(mesh_.points.size(), 0);
    constexpr std::uint8_t kCorner = 1;
    constexpr std::uint8_t kMiddle = 2;
    for (const MeshData::Tet& tet : mesh_.tets) {
      for (const std::uint32_t v : tet.vertices) use[v] = kCorner;
    }
    for (const auto& [a, b, node] : mesh_.mid_nodes) {
      if (use[node] != 0) {
        throw Error(fmt::format(
            "point {}, counted from 0, is the node of an edge and {}: expected nodes of their own",
            node, use[node] == kCorner ? "a vertex of a tet" : "that of another edge"));
      }
      use[node] = kMiddle;
    }
  }

  MeshData& mesh_;
};

/// Which elements of a kind groups name one by one.
std::vector<bool> marked(const MeshData& mesh, int dimension, std::size_t count) {
  std::vector<bool> marks(count, false);
  for (const Group& group : mesh.groups) {
    if (group.dimension != dimension) continue;
    for (const std::uint32_t member : group.members) {
      if (member < count) marks[member] = true;
    }
  }
  return marks;
}

/// Moves the elements of second order of one kind to the other elements.
template <class ListsOf>
void give(MeshData& mesh, const MidNodes& mid_nodes, int vtk_type, const std::vector<bool>& marks,
          const ListsOf& lists) {
  using Element = typename std::remove_reference_t<decltype(lists.elements)>::value_type;
  constexpr std::size_t kCorners = std::tuple_size_v<decltype(Element::vertices)>;
  OtherElements others;
  others.vtk_type = vtk_type;
  others.vertex_count = kCorners * (kCorners + 1) / 2;
  std::vector<std::uint32_t> first, second;
  for (std::uint32_t i = 0; i < lists.elements.size(); ++i) {
    const Element& element = lists.elements[i];
    const auto nodes = marks[i] ? std::vector<std::uint32_t>() : mid_nodes.of(element.vertices);
    (nodes.empty() ? first : second).push_back(i);
    if (nodes.empty()) continue;
    others.vertices.insert(others.vertices.end(), element.vertices.begin(), element.vertices.end());
    others.vertices.insert(others.vertices.end(), nodes.begin(), nodes.end());
    others.labels.push_back(element.label);
  }
  if (second.empty()) return;
  const auto select = [](auto& values, const std::vector<std::uint32_t>& rows) {
    std::decay_t<decltype(values)> chosen;
    if (values.empty()) return chosen;
    for (const std::uint32_t row : rows) chosen.push_back(values[row]);
    return chosen;
  };
  others.parts = select(lists.parts, second);
  others.numbers = select(lists.numbers, second);
  lists.parts = select(lists.parts, first);
  lists.numbers = select(lists.numbers, first);
  for (DataArray& array : lists.data) {
    others.data.push_back(formats::selected_rows(array, second));
    array = formats::selected_rows(array, first);
  }
  if (first.empty()) lists.data.clear();
  // Members of groups are of first order: their numbers change with the elements before them.
  std::vector<std::uint32_t> place(lists.elements.size(), 0);
  for (std::uint32_t i = 0; i < first.size(); ++i) place[first[i]] = i;
  for (Group& group : mesh.groups) {
    if (group.dimension != static_cast<int>(kCorners) - 1) continue;
    for (std::uint32_t& member : group.members) member = place[member];
  }
  lists.elements = select(lists.elements, first);
  mesh.other_elements.push_back(std::move(others));
}

}  // namespace

MidNodes::MidNodes(std::span<const std::array<std::uint32_t, 3>> mid_nodes) {
  edges_.reserve(mid_nodes.size());
  for (const auto& [a, b, node] : mid_nodes) edges_.push_back({edge_key(a, b), node});
  std::sort(edges_.begin(), edges_.end(),
            [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
}

std::uint32_t MidNodes::of(std::uint32_t a, std::uint32_t b) const {
  const std::uint64_t ends = edge_key(a, b);
  const auto found =
      std::lower_bound(edges_.begin(), edges_.end(), ends,
                       [](const Edge& edge, std::uint64_t key) { return edge.ends < key; });
  return found != edges_.end() && found->ends == ends ? found->node : kNoMidNode;
}

void take_second_order(MeshData& mesh) {
  const auto& all = mesh.other_elements;
  const auto has = [&](auto condition) { return std::any_of(all.begin(), all.end(), condition); };
  std::size_t curved = 0;
  for (const OtherElements& others : all) {
    if (corner_count_of(others) == 4) curved += others.labels.size();
  }
  if (curved > 0 && !mesh.tets.empty()) {
    mesh.notes.push_back(fmt::format("of {} tets {} are of second order: {}",
                                     mesh.tets.size() + curved, curved,
                                     formats::kStayWhereTheyAre));
  } else if (has([](const auto& others) { return corner_count_of(others) != 0; })) {
    Taking(mesh).run();
  }
}

MeshData with_second_order(const MeshData& mesh, bool has_marks, bool has_edges) {
  MeshData made = mesh;
  if (!has_marks) made.groups.clear();
  const MidNodes mid_nodes(mesh.mid_nodes);
  const std::vector<bool> none(mesh.tets.size(), false);
  give(made, mid_nodes, 24, none, tets_of(made));
  give(made, mid_nodes, 22, marked(made, 2, mesh.triangles.size()), triangles_of(made));
  if (has_edges) give(made, mid_nodes, 21, marked(made, 1, mesh.edges.size()), edges_of(made));
  made.mid_nodes.clear();
  return made;
}

MeshData without_mid_nodes(const MeshData& mesh) {
  MeshData made = mesh;
  made.mid_nodes.clear();
  std::vector<std::uint32_t> number_of(mesh.points.size(), 0);
  for (const auto& [a, b, node] : mesh.mid_nodes) number_of[node] = kNoMidNode;
  for (const OtherElements& others : mesh.other_elements) {
    for (const std::uint32_t v : others.vertices) number_of[v] = 0;
  }
  std::uint32_t count = 0;
  for (std::uint32_t& number : number_of) {
    if (number != kNoMidNode) number = count++;
  }
  renumber_points(made, number_of, count);
  return made;
}

void renumber_points(MeshData& mesh, std::span<const std::uint32_t> number_of, std::size_t count) {
  const auto keep = [&](auto& values) {
    if (values.empty()) return;
    std::decay_t<decltype(values)> kept(count);
    for (std::size_t i = 0; i < number_of.size(); ++i) {
      if (number_of[i] != kNoMidNode) kept[number_of[i]] = values[i];
    }
    values = std::move(kept);
  };
  keep(mesh.points);
  keep(mesh.point_labels);
  keep(mesh.point_entities);
  keep(mesh.point_numbers);
  std::vector<std::uint32_t> rows(count);
  for (std::uint32_t i = 0; i < number_of.size(); ++i) {
    if (number_of[i] != kNoMidNode) rows[number_of[i]] = i;
  }
  for (DataArray& array : mesh.point_data) array = formats::selected_rows(array, rows);
  const auto renumber = [&](auto& elements) {
    for (auto& element : elements) {
      for (std::uint32_t& v : element.vertices) v = number_of[v];
    }
  };
  renumber(mesh.tets);
  renumber(mesh.triangles);
  renumber(mesh.edges);
  const auto renumber_list = [&](std::vector<std::uint32_t>& list) {
    for (std::uint32_t& v : list) v = number_of[v];
    std::erase(list, kNoMidNode);
  };
  renumber_list(mesh.required_vertices);
  for (OtherElements& others : mesh.other_elements) renumber_list(others.vertices);
  for (Group& group : mesh.groups) {
    if (group.dimension == 0) renumber_list(group.members);
  }
  for (auto& mid : mesh.mid_nodes) {
    for (std::uint32_t& v : mid) v = number_of[v];
  }
  for (PeriodicLink& link : mesh.periodic) {
    for (auto& pair : link.points) pair = {number_of[pair[0]], number_of[pair[1]]};
    std::erase_if(link.points,
                  [](const auto& pair) { return pair[0] == kNoMidNode || pair[1] == kNoMidNode; });
  }
}

}  // namespace tetmend
