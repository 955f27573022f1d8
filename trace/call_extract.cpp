// SPDX-License-Identifier: MIT
#include "trace/call_extract.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace tetmend {

namespace {

constexpr int kLayers = 2;

/// What the calls of a tree aimed at or changed, by vertex slot.
std::vector<std::uint8_t> touched_vertices(const TraceFile& file, std::uint32_t root) {
  std::vector<std::uint8_t> touched;
  const auto touch = [&](VertexHandle v) {
    if (v.index() >= touched.size()) touched.resize(v.index() + 1u, 0);
    touched[v.index()] = 1;
  };
  const Call& call = file.calls()[root];
  for (std::uint32_t c = root; c < call.subtree_end; ++c) {
    for (const VertexHandle v : file.calls()[c].target()) touch(v);
  }
  EventCursor cursor(file);
  cursor.move_to(call.events.begin);
  while (cursor.position() < call.events.end) {
    const TraceEvent& event = cursor.next();
    if (event.kind != EventKind::replace_cavity) continue;
    for (const TetVertices& tet : event.created_vertices) {
      for (const VertexHandle v : tet) touch(v);
    }
  }
  return touched;
}

bool touches(const SlotMesh& mesh, TetHandle t, const std::vector<std::uint8_t>& marked) {
  const TetVertices& vertices = mesh.vertices(t);
  return std::any_of(vertices.begin(), vertices.end(), [&](VertexHandle v) {
    return v.index() < marked.size() && marked[v.index()] != 0;
  });
}

std::array<Point, 4> corners(const SlotMesh& mesh, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  return {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])};
}

/// Null for a call outside of visits.
const Visit* visit_of(const TraceFile& file, std::uint32_t call) {
  const std::span<const Visit> visits = file.visits();
  const auto after =
      std::upper_bound(visits.begin(), visits.end(), call,
                       [](std::uint32_t c, const Visit& visit) { return c < visit.first_call; });
  if (after == visits.begin() || call >= (after - 1)->last_call) return nullptr;
  return &*(after - 1);
}

/// What Bounds looks at; the less, the worse.
std::array<double, 5> figures(const std::array<Point, 4>& p) {
  const auto angles = dihedral_angles(p[0], p[1], p[2], p[3]);
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  for (const auto& [i, j] : kEdgeVertices) {
    const double length2 = (p[i] - p[j]).squaredNorm();
    shortest = std::min(shortest, length2);
    longest = std::max(longest, length2);
  }
  const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
  return {*least, -*most, volume_length(p[0], p[1], p[2], p[3]),
          radius_ratio(p[0], p[1], p[2], p[3]), -longest / shortest};
}

/// Adds those tets of the mesh, apart from the others, by which it bounds every new tet.
void add_bounds(const SlotMesh& mesh, MeshData& data) {
  std::array<TetHandle, 5> worst;
  std::array<double, 5> least{};
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const auto now = figures(corners(mesh, t));
    for (std::size_t k = 0; k < worst.size(); ++k) {
      if (worst[k].is_valid() && now[k] >= least[k]) continue;
      worst[k] = t;
      least[k] = now[k];
    }
  }
  for (const TetHandle t : worst) {
    if (!t.is_valid()) continue;
    MeshData::Tet& tet = data.tets.emplace_back();
    const auto points = corners(mesh, t);
    for (std::size_t i = 0; i < points.size(); ++i) {
      tet.vertices[i] = static_cast<std::uint32_t>(data.points.size());
      data.points.push_back(mesh.scale().to_file(points[i]));
    }
    tet.label = mesh.label(t);
  }
}

/// Gives frozen tets a label of their own, by which a run can be told to keep them.
std::optional<Label> mark_frozen(std::span<const std::uint32_t> frozen,
                                 std::span<const TetHandle> tets, MeshData& data) {
  Label label = 0;
  for (const MeshData::Tet& tet : data.tets) label = std::max(label, tet.label);
  ++label;
  bool found = false;
  for (std::size_t k = 0; k < tets.size(); ++k) {
    if (!std::binary_search(frozen.begin(), frozen.end(), tets[k].index())) continue;
    data.tets[k].label = label;
    found = true;
  }
  return found ? std::optional(label) : std::nullopt;
}

}  // namespace

CallExtract extract_call(const TraceFile& file, Replay& replay, std::uint32_t call) {
  while (file.calls()[call].parent != kNoCall) call = file.calls()[call].parent;
  replay.seek(file.calls()[call].events.begin);
  const SlotMesh& mesh = replay.mesh();
  std::vector<std::uint8_t> marked = touched_vertices(file, call);
  marked.resize(std::max(marked.size(), mesh.vertex_slots()), 0);
  std::vector<TetHandle> tets;
  for (int layer = 0; layer <= kLayers; ++layer) {
    tets.clear();
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      if (!mesh.is_deleted(t) && touches(mesh, t, marked)) tets.push_back(t);
    }
    for (const TetHandle t : tets) {
      for (const VertexHandle v : mesh.vertices(t)) marked[v.index()] = 1;
    }
  }
  CallExtract result;
  result.call = call;
  result.standard = mesh.standard();
  result.goal = file.initial_mesh().standard().goal();
  std::vector<std::uint32_t> slots;
  result.mesh = mesh.extract(tets, &slots);
  add_bounds(file.initial_mesh(), result.mesh);
  result.frozen = mark_frozen(mesh.frozen_tets(), tets, result.mesh);
  // Nothing if one of them was gone before the call began.
  const auto numbers_of = [&slots](std::span<const VertexHandle> vertices) {
    std::vector<std::uint32_t> numbers;
    for (const VertexHandle v : vertices) {
      const auto found = std::lower_bound(slots.begin(), slots.end(), v.index());
      if (found == slots.end() || *found != v.index()) return std::vector<std::uint32_t>();
      numbers.push_back(static_cast<std::uint32_t>(found - slots.begin()));
    }
    return numbers;
  };
  result.target = numbers_of(file.calls()[call].target());
  if (result.target.empty()) {
    throw Error(fmt::format("{}: what call {} aims at was gone before it began",
                            file.path().string(), call));
  }
  if (const Visit* visit = visit_of(file, call)) result.tet = numbers_of(visit->tet);
  return result;
}

}  // namespace tetmend
