// SPDX-License-Identifier: MIT
#include "face/portrait.h"

#include <algorithm>
#include <utility>

#include "face/bad_tets.h"
#include "face/mesh_access.h"
#include "kernel/chunks.h"

namespace tetmend::face {

namespace {

/// The bad tets, with their numbers in the list that the mesh is written as.
struct FoundTets {
  std::vector<TetHandle> tets;
  std::vector<std::size_t> numbers;
};

FoundTets find_bad(const TetMesh& mesh) {
  struct Part {
    FoundTets bad;
    std::size_t live = 0;
  };
  const auto parts = map_chunks<Part>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Part part;
    for (std::size_t slot = begin; slot < end; ++slot) {
      const TetHandle t(static_cast<std::uint32_t>(slot));
      if (mesh.is_deleted(t)) continue;
      if (misses_goal(mesh, t)) {
        part.bad.tets.push_back(t);
        part.bad.numbers.push_back(part.live);
      }
      ++part.live;
    }
    return part;
  });
  FoundTets all;
  std::size_t live = 0;
  for (const Part& part : parts) {
    all.tets.insert(all.tets.end(), part.bad.tets.begin(), part.bad.tets.end());
    for (const std::size_t number : part.bad.numbers) all.numbers.push_back(live + number);
    live += part.live;
  }
  return all;
}

DrawnTet draw(const TetMesh& mesh, TetHandle t, Hindrance hindrance, std::size_t number) {
  DrawnTet drawn{.corners = {}, .facts = describe(mesh, t, hindrance)};
  drawn.facts.tet = number;
  drawn.facts.number = static_cast<std::int64_t>(number) + 1;
  const TetVertices& v = mesh.vertices(t);
  for (std::size_t i = 0; i < 4; ++i) {
    drawn.corners[i] = mesh.point_in_file(v[i]);
    drawn.is_free[i] = !mesh.is_fixed(v[i]);
  }
  return drawn;
}

/// @param hindrances by slot, or empty
std::vector<DrawnTet> draw_bad(const TetMesh& mesh,
                               const std::vector<std::pair<TetHandle, Hindrance>>& hindrances) {
  const FoundTets bad = find_bad(mesh);
  std::vector<DrawnTet> drawn(bad.tets.size());
  for_chunks(drawn.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto known =
          std::lower_bound(hindrances.begin(), hindrances.end(), bad.tets[i],
                           [](const auto& entry, TetHandle t) { return entry.first < t; });
      const bool is_known = known != hindrances.end() && known->first == bad.tets[i];
      drawn[i] =
          draw(mesh, bad.tets[i], is_known ? known->second : Hindrance::search, bad.numbers[i]);
    }
  });
  std::sort(drawn.begin(), drawn.end(), [](const DrawnTet& a, const DrawnTet& b) {
    return std::pair(a.facts.quality, a.facts.tet) < std::pair(b.facts.quality, b.facts.tet);
  });
  return drawn;
}

}  // namespace

void Portrait::draw_before(const TetMesh& mesh, const std::optional<MeshRulers>& rulers) {
  std::vector<std::uint32_t> number(mesh.vertex_slots(), kGone);
  for (std::size_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(static_cast<std::uint32_t>(slot));
    if (mesh.is_deleted(t)) continue;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace behind = mesh.neighbours(t)[f];
      const bool is_wall =
          !behind.is_outside() && t < behind.tet() && mesh.label(t) != mesh.label(behind.tet());
      if (!behind.is_outside() && !is_wall) continue;
      auto& triangle = is_wall ? walls.emplace_back() : triangles.emplace_back();
      if (is_wall) {
        wall_labels.push_back({mesh.label(t), mesh.label(behind.tet())});
      } else {
        labels.push_back(mesh.label(t));
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexHandle v = mesh.vertices(HalfFace(t, f))[i];
        std::uint32_t& place = number[v.index()];
        if (place == kGone) {
          place = static_cast<std::uint32_t>(points.size());
          points.push_back(mesh.point_in_file(v));
        }
        triangle[i] = place;
      }
    }
  }
  bad_before = draw_bad(mesh, {});
  if (!rulers) return;
  means_ = *rulers;
  rulers_before = count_rulers(mesh, means_);
}

void Portrait::draw_after(const TetMesh& mesh,
                          const std::vector<std::pair<TetHandle, Hindrance>>& hindrances,
                          const std::optional<MeshRulers>& rulers) {
  bad_after = draw_bad(mesh, hindrances);
  are_reasons_known = hindrances.size() == bad_after.size();
  if (rulers) rulers_after = count_rulers(mesh, means_);
}

void number_tets(Portrait& portrait, const Mesh& mesh) {
  const std::vector<std::int64_t>& numbers = MeshAccess::data(mesh).tet_numbers;
  if (numbers.empty()) return;
  for (DrawnTet& tet : portrait.bad_after) tet.facts.number = numbers[tet.facts.tet];
}

}  // namespace tetmend::face
