// SPDX-License-Identifier: MIT
//   elements of each point -> tets with two such points or more: which of their edges and faces have
//   an element in common
#include "kernel/shared_parts.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace tetmend {

namespace {

using CommonFace = std::array<std::uint32_t, 3>;
using CommonEdge = std::array<std::uint32_t, 2>;
using PointElements = std::span<const std::uint32_t>;

constexpr int kVertex = 1;      // of VTK
constexpr int kPolyVertex = 2;  // a cloud of points
constexpr int kPolyLine = 4;    // an edge after the other

template <std::size_t N>
std::array<std::uint32_t, N> ascending(std::array<std::uint32_t, N> vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

template <class Part>
void keep_each_once(std::vector<Part>& parts) {
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
}

template <class Part>
bool contains_part(const std::vector<Part>& parts, const Part& part) {
  return std::binary_search(parts.begin(), parts.end(), part);
}

/// Calls act with the points of each element; with those of each edge of a chain of them.
template <class Act>
void for_each_element(const MeshData& mesh, const Act& act) {
  for (const OtherElements& others : mesh.other_elements) {
    const std::span<const std::uint32_t> all = others.vertices;
    if (others.vertex_count == 0 || others.vtk_type == kVertex) continue;
    if (others.vtk_type == kPolyVertex) continue;
    const bool is_chain = others.vtk_type == kPolyLine;
    for (std::size_t i = 0; i + others.vertex_count <= all.size(); i += others.vertex_count) {
      const auto element = all.subspan(i, others.vertex_count);
      if (!is_chain) act(element);
      for (std::size_t k = 0; is_chain && k + 1 < element.size(); ++k) act(element.subspan(k, 2));
    }
  }
}

std::vector<char> points_of_others(const MeshData& mesh) {
  std::vector<char> is_of_other(mesh.points.size(), 0);
  for (const OtherElements& others : mesh.other_elements) {
    for (const std::uint32_t v : others.vertices) is_of_other[v] = 1;
  }
  return is_of_other;
}

/// Which elements each point belongs to, ascending.
class ElementsOfPoints {
 public:
  explicit ElementsOfPoints(const MeshData& mesh) : begin_(mesh.points.size() + 1, 0) {
    for_each_element(mesh, [&](PointElements points) {
      for (const std::uint32_t v : points) ++begin_[v + 1];
    });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    elements_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), std::prev(begin_.end()));
    std::uint32_t number = 0;
    for_each_element(mesh, [&](PointElements points) {
      for (const std::uint32_t v : points) elements_[next[v]++] = number;
      ++number;
    });
  }

  PointElements of(std::uint32_t point) const {
    return {elements_.data() + begin_[point], elements_.data() + begin_[point + 1]};
  }
  template <std::size_t N>
  bool have_one_in_common(const std::array<std::uint32_t, N>& points) const {
    const PointElements first = of(points[0]);
    return std::any_of(first.begin(), first.end(), [&](std::uint32_t element) {
      return std::all_of(points.begin() + 1, points.end(), [&](std::uint32_t v) {
        const PointElements others = of(v);
        return std::binary_search(others.begin(), others.end(), element);
      });
    });
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> elements_;
};

void collect_shared(const MeshData::Tet& tet, const ElementsOfPoints& elements,
                    SharedParts& shared) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      const CommonEdge edge = ascending(CommonEdge{tet.vertices[i], tet.vertices[k]});
      if (elements.have_one_in_common(edge)) shared.edges.push_back(edge);
    }
    const auto& v = tet.vertices;
    const CommonFace face = ascending(CommonFace{v[(i + 1) % 4], v[(i + 2) % 4], v[(i + 3) % 4]});
    if (elements.have_one_in_common(face)) shared.faces.push_back(face);
  }
}

}  // namespace

SharedParts find_shared_parts(const MeshData& mesh) {
  SharedParts shared;
  if (mesh.other_elements.empty()) return shared;
  const std::vector<char> is_of_other = points_of_others(mesh);
  const ElementsOfPoints elements(mesh);
  for (const MeshData::Tet& tet : mesh.tets) {
    int count = 0;
    for (const std::uint32_t v : tet.vertices) {
      if (is_of_other[v] == 0) continue;
      shared.points.push_back(v);
      ++count;
    }
    if (count > 1) collect_shared(tet, elements, shared);
  }
  keep_each_once(shared.faces);
  keep_each_once(shared.edges);
  keep_each_once(shared.points);
  return shared;
}

SharedParts find_shared_inside(const MeshData& mesh, const SharedParts& shared) {
  SharedParts inside = shared;
  if (shared.is_empty()) return inside;
  std::vector<char> is_shared(mesh.points.size(), 0);
  for (const std::uint32_t v : shared.points) is_shared[v] = 1;
  std::vector<std::pair<CommonFace, Label>>
      faces;  // at a shared point, with the region of their tet
  for (const MeshData::Tet& tet : mesh.tets) {
    const auto& v = tet.vertices;
    for (std::size_t i = 0; i < 4; ++i) {
      const CommonFace face = ascending(CommonFace{v[(i + 1) % 4], v[(i + 2) % 4], v[(i + 3) % 4]});
      if (is_shared[face[0]] + is_shared[face[1]] + is_shared[face[2]] == 0) continue;
      faces.emplace_back(face, tet.label);
    }
  }
  std::sort(faces.begin(), faces.end());
  SharedParts of_walls;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto& [face, label] = faces[i];
    const bool is_pair = i + 1 < faces.size() && faces[i + 1].first == face;
    if (is_pair && faces[++i].second == label) continue;
    of_walls.faces.push_back(face);
    of_walls.points.insert(of_walls.points.end(), face.begin(), face.end());
    for (const CommonEdge& edge :
         {CommonEdge{face[0], face[1]}, CommonEdge{face[0], face[2]}, CommonEdge{face[1], face[2]}})
      of_walls.edges.push_back(edge);
  }
  keep_each_once(of_walls.edges);
  keep_each_once(of_walls.points);
  std::erase_if(inside.faces,
                [&](const CommonFace& face) { return contains_part(of_walls.faces, face); });
  std::erase_if(inside.edges,
                [&](const CommonEdge& edge) { return contains_part(of_walls.edges, edge); });
  std::erase_if(inside.points, [&](std::uint32_t v) { return contains_part(of_walls.points, v); });
  return inside;
}

void hold_shared_inside(MeshData& mesh) {
  const SharedParts inside = find_shared_inside(mesh, find_shared_parts(mesh));
  std::vector<CommonFace> named_faces;
  std::vector<CommonEdge> named_edges;
  for (const MeshData::Triangle& named : mesh.triangles)
    named_faces.push_back(ascending(named.vertices));
  for (const MeshData::Edge& named : mesh.edges) named_edges.push_back(ascending(named.vertices));
  std::vector<std::uint32_t> required = mesh.required_vertices;
  keep_each_once(named_faces);
  keep_each_once(named_edges);
  keep_each_once(required);
  for (const CommonFace& face : inside.faces) {
    if (!contains_part(named_faces, face)) mesh.triangles.push_back({face, 0});
  }
  for (const CommonEdge& edge : inside.edges) {
    if (!contains_part(named_edges, edge)) mesh.edges.push_back({edge, 0});
  }
  for (const std::uint32_t v : inside.points) {
    if (!contains_part(required, v)) mesh.required_vertices.push_back(v);
  }
}

std::size_t count_lost_parts(const MeshData& before, std::span<const std::uint32_t> vertex_map,
                             const MeshData& now) {
  if (before.other_elements.empty()) return 0;
  std::size_t lost = 0;
  const std::vector<char> is_of_other = points_of_others(before);
  for (std::uint32_t v = 0; v < is_of_other.size(); ++v) {
    if (is_of_other[v] == 0) continue;
    const bool is_there =
        vertex_map[v] < now.points.size() && now.points[vertex_map[v]] == before.points[v];
    lost += is_there ? 0 : 1;
  }
  if (lost > 0) return lost;  // what they span cannot be told
  const SharedParts then = find_shared_parts(before);
  const SharedParts found = find_shared_parts(now);
  const auto count = [&](const auto& parts, const auto& among) {
    return std::count_if(parts.begin(), parts.end(), [&](auto part) {
      for (std::uint32_t& v : part) v = vertex_map[v];
      return !contains_part(among, ascending(part));
    });
  };
  lost += static_cast<std::size_t>(count(then.faces, found.faces));
  lost += static_cast<std::size_t>(count(then.edges, found.edges));
  for (const std::uint32_t v : then.points)
    lost += contains_part(found.points, vertex_map[v]) ? 0 : 1;
  return lost;
}

}  // namespace tetmend
