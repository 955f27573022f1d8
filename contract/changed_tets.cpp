// SPDX-License-Identifier: MIT
#include "contract/changed_tets.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace tetmend::contract {

namespace {

std::optional<NamedTet> tet_in(const TetMesh& mesh, std::uint32_t slot) {
  const TetHandle t(slot);
  if (slot >= mesh.tet_slots() || mesh.is_deleted(t)) return {};
  TetVertices v = mesh.vertices(t);
  std::sort(v.begin(), v.end());
  return NamedTet(v, mesh.quality(t));
}

}  // namespace

ChangedTets changed_tets(const TetMesh& before, const TetMesh& now) {
  std::vector<NamedTet> there;
  std::vector<NamedTet> here;
  for (std::uint32_t i = 0; i < std::max(before.tet_slots(), now.tet_slots()); ++i) {
    const auto was = tet_in(before, i);
    const auto is = tet_in(now, i);
    if (was == is) continue;
    if (was) there.push_back(*was);
    if (is) here.push_back(*is);
  }
  std::sort(there.begin(), there.end());
  std::sort(here.begin(), here.end());
  ChangedTets changed;  // without those that only changed their slot
  std::set_difference(there.begin(), there.end(), here.begin(), here.end(),
                      std::back_inserter(changed.before));
  std::set_difference(here.begin(), here.end(), there.begin(), there.end(),
                      std::back_inserter(changed.now));
  return changed;
}

}  // namespace tetmend::contract
