// SPDX-License-Identifier: MIT
#include "viewer/debugger/trace_mesh.h"

#include <algorithm>
#include <array>
#include <optional>

#include "kernel/mesh_patch.h"

namespace tetmend::viewer {

namespace {

constexpr std::size_t kFew = 8;  // a share of the tets; beyond, a build costs less than a patch

template <class Handle>
std::vector<Handle> all_or(bool all, std::size_t slots, std::span<const Handle> listed) {
  std::vector<Handle> handles;
  if (all) {
    for (std::uint32_t i = 0; i < slots; ++i) handles.emplace_back(i);
  } else {
    handles.assign(listed.begin(), listed.end());
    std::sort(handles.begin(), handles.end());
    handles.erase(std::unique(handles.begin(), handles.end()), handles.end());
  }
  return handles;
}

bool is_there(const TetMesh& mesh, TetHandle t) {
  return t.index() < mesh.tet_slots() && !mesh.is_deleted(t);
}
bool is_there(const TetMesh& mesh, VertexHandle v) {
  return v.index() < mesh.vertex_slots() && !mesh.is_deleted(v);
}

bool is_other(const TetMesh& mesh, const SlotMesh& now, TetHandle t) {
  const bool is_now = !now.is_deleted(t);
  if (is_there(mesh, t) != is_now) return true;
  return is_now && (mesh.vertices(t) != now.vertices(t) || mesh.label(t) != now.label(t));
}
bool is_other(const TetMesh& mesh, const SlotMesh& now, VertexHandle v) {
  const bool is_now = !now.is_deleted(v);
  return is_there(mesh, v) != is_now || (is_now && mesh.point(v) != now.point(v));
}

/// What must be written; nothing if that is much.
std::optional<SlotContents> difference(const TetMesh& mesh, Replay& replay,
                                       const ChangeLog::Changes& changes) {
  const SlotMesh& now = replay.mesh();
  SlotContents contents;
  std::vector<TetHandle> tets;
  for (const VertexHandle v :
       all_or(changes.everything, std::max(now.vertex_slots(), mesh.vertex_slots()),
              changes.vertices)) {
    if (!is_other(mesh, now, v)) continue;
    const bool is_now = !now.is_deleted(v);
    contents.vertices.push_back({v, is_now, is_now ? now.point(v) : Point::Zero()});
    const auto around = replay.tets_around(std::array{v});
    tets.insert(tets.end(), around.begin(), around.end());
    if (tets.size() > now.tet_count()) return std::nullopt;
  }
  for (const TetHandle t :
       all_or(changes.everything, std::max(now.tet_slots(), mesh.tet_slots()), changes.tets)) {
    if (is_other(mesh, now, t)) tets.push_back(t);
  }
  for (const TetHandle t : all_or<TetHandle>(false, 0, tets)) {
    const bool is_now = !now.is_deleted(t);
    contents.tets.push_back(
        {t, is_now ? now.vertices(t) : TetVertices(), is_now ? now.label(t) : 0});
  }
  if (contents.tets.size() > now.tet_count() / kFew) return std::nullopt;
  return contents;
}

}  // namespace

TetMesh TraceMesh::begin(const Replay& replay) {
  seen_ = replay.changes().mark();
  return to_tet_mesh(replay.mesh());
}

MeshStep TraceMesh::follow(Replay& replay, TetMesh& mesh) {
  const ChangeLog::Changes changes = replay.changes().since(seen_);
  const SlotMesh& now = replay.mesh();
  std::optional<SlotContents> contents;
  if (mesh.scale() == now.scale()) contents = difference(mesh, replay, changes);
  seen_ = replay.changes().mark();
  if (!contents || !patch(mesh, *contents)) {
    mesh = to_tet_mesh(now);
    return {true, {}};
  }
  if (mesh.standard() != now.standard()) {
    mesh.set_standard(now.standard());
    return {true, {}};
  }
  MeshStep step;
  for (const SlotContents::Tet& tet : contents->tets) step.tets.push_back(tet.tet);
  return step;
}

TetMesh to_tet_mesh(const SlotMesh& mesh) {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> tets;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    if (!mesh.is_deleted(VertexHandle(i))) vertices.push_back(i);
  }
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i))) tets.push_back(i);
  }
  TetMesh result(mesh.to_data());
  result.scatter(vertices, tets);
  number_by_slots(result);
  result.set_standard(mesh.standard());
  return result;
}

}  // namespace tetmend::viewer
