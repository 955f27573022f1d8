// SPDX-License-Identifier: MIT
#include "contract/changed_tets.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace tetmend::contract {

namespace {

/// A tet, and 0. Or whether it is from before (1) or from now (2), if one of its vertices moved:
/// its quality may be the same by chance.
using Entry = std::pair<NamedTet, int>;

std::optional<Entry> entry_in(const TetMesh& mesh, std::uint32_t slot, const TetMesh& other,
                              int when) {
  const TetHandle t(slot);
  if (slot >= mesh.tet_slots() || mesh.is_deleted(t)) return {};
  TetVertices v = mesh.vertices(t);
  std::sort(v.begin(), v.end());
  const bool moved = std::any_of(v.begin(), v.end(), [&](VertexHandle w) {
    return w.index() >= other.vertex_slots() || mesh.point(w) != other.point(w);
  });
  return Entry(NamedTet(v, mesh.quality(t)), moved ? when : 0);
}

/// Those that are not in the other list; both are ascending.
std::vector<NamedTet> difference(const std::vector<Entry>& entries,
                                 const std::vector<Entry>& other) {
  std::vector<Entry> rest;
  std::set_difference(entries.begin(), entries.end(), other.begin(), other.end(),
                      std::back_inserter(rest));
  std::vector<NamedTet> tets;
  for (const auto& [tet, when] : rest) tets.push_back(tet);
  return tets;
}

}  // namespace

ChangedTets changed_tets(const TetMesh& before, const TetMesh& now) {
  std::vector<Entry> there;
  std::vector<Entry> here;
  for (std::uint32_t i = 0; i < std::max(before.tet_slots(), now.tet_slots()); ++i) {
    const auto was = entry_in(before, i, now, 1);
    const auto is = entry_in(now, i, before, 2);
    if (was == is) continue;
    if (was) there.push_back(*was);
    if (is) here.push_back(*is);
  }
  std::sort(there.begin(), there.end());
  std::sort(here.begin(), here.end());
  // Without those that only changed their slot.
  return {difference(there, here), difference(here, there)};
}

}  // namespace tetmend::contract
