// SPDX-License-Identifier: MIT
// Which volume elements lie on the two sides of a triangle or quadrilateral.
#include "kernel/formats/face_sides.h"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

#include "kernel/exact_orientation.h"

namespace tetmend::formats {
namespace {

/// Faces with their normals outwards.
constexpr std::array<FaceCorners, 4> kTetFaces = {
    {{0, 2, 1, kNoCorner}, {0, 1, 3, kNoCorner}, {1, 2, 3, kNoCorner}, {0, 3, 2, kNoCorner}}};
constexpr std::array<FaceCorners, 6> kHexahedronFaces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
constexpr std::array<FaceCorners, 5> kPrismFaces = {
    {{0, 2, 1, kNoCorner}, {3, 4, 5, kNoCorner}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<FaceCorners, 5> kPyramidFaces = {{{0, 3, 2, 1},
                                                       {0, 1, 4, kNoCorner},
                                                       {1, 2, 4, kNoCorner},
                                                       {2, 3, 4, kNoCorner},
                                                       {3, 0, 4, kNoCorner}}};

std::span<const FaceCorners> faces_of_kind(const ElementKind& kind) {
  switch (kind.corners) {
    case 4:
      return kTetFaces;
    case 5:
      return kPyramidFaces;
    case 6:
      return kPrismFaces;
    default:
      return kHexahedronFaces;
  }
}

using Key = std::array<std::uint32_t, 4>;

struct Hash {
  std::size_t operator()(const Key& key) const {
    return (key[0] * 0x9E3779B97F4A7C15ull) ^ (key[1] * 0xC2B2AE3D27D4EB4Full) ^
           (key[2] * 0x165667B19E3779F9ull) ^ key[3];
  }
};

Key key_of(const Key& corners) {
  Key key = corners;
  std::sort(key.begin(), key.end());  // kNoElement, for no corner, comes last
  return key;
}

/// True if both name their corners in the same sense. They have the same corners.
bool same_sense(const Key& a, const Key& b) {
  const std::size_t width = a[3] == kNoElement ? 3 : 4;
  for (std::size_t i = 0; i < width; ++i) {
    if (b[i] == a[0]) return b[(i + 1) % width] == a[1];
  }
  return false;
}

Key corners_of(const ElementList& list, std::size_t i) {
  const auto v = list.vertices(i);
  return {v[0], v[1], v[2], list.kind.corners == 4 ? v[3] : kNoElement};
}

class FaceSideFinder {
 public:
  FaceSideFinder(const MeshView& mesh, const ElementLists& lists)
      : mesh_(mesh), surfaces_(lists.of_dimension(2)), volumes_(lists.of_dimension(3)) {}

  std::vector<std::vector<FaceSides>> run() {
    for (std::uint32_t k = 0; k < surfaces_.size(); ++k) {
      for (std::uint32_t i = 0; i < surfaces_[k]->count; ++i) {
        const Key corners = corners_of(*surfaces_[k], i);
        places_.try_emplace(key_of(corners), Place{corners, {}});
      }
    }
    std::uint32_t number = 0;
    for (const ElementList* list : volumes_) {
      for (std::size_t i = 0; i < list->count; ++i) look_around(*list, i, number++);
    }
    return sides_of_surfaces();
  }

 private:
  /// Elements with the same corners share a place.
  struct Place {
    Key corners;  // of the first of them
    FaceSides sides;
  };

  std::vector<std::vector<FaceSides>> sides_of_surfaces() const {
    std::vector<std::vector<FaceSides>> all;
    for (const ElementList* list : surfaces_) {
      std::vector<FaceSides>& of_list = all.emplace_back();
      for (std::size_t i = 0; i < list->count; ++i) {
        const Key corners = corners_of(*list, i);
        const Place& place = places_.at(key_of(corners));
        of_list.push_back(place.sides);
        if (same_sense(place.corners, corners)) continue;
        std::swap(of_list.back().behind, of_list.back().front);
      }
    }
    return all;
  }

  void look_around(const ElementList& list, std::size_t i, std::uint32_t number) {
    const auto v = list.vertices(i);
    for (const FaceCorners& face : faces_of_kind(list.kind)) {
      Key corners{};
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = face[k] == kNoCorner ? kNoElement : v[face[k]];
      }
      const auto found = places_.find(key_of(corners));
      if (found == places_.end()) continue;
      const bool outwards = list.kind.corners != 4 || is_positive(v);
      FaceSides& sides = found->second.sides;
      const bool is_behind = same_sense(corners, found->second.corners) == outwards;
      (is_behind ? sides.behind : sides.front) = number;
    }
  }

  bool is_positive(std::span<const std::uint32_t> v) const {
    return !is_turned_over(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]),
                           mesh_.point(v[3]));
  }

  const MeshView& mesh_;
  std::vector<const ElementList*> surfaces_;
  std::vector<const ElementList*> volumes_;
  std::unordered_map<Key, Place, Hash> places_;
};

}  // namespace

std::vector<std::vector<FaceSides>> find_face_sides(const MeshView& mesh,
                                                    const ElementLists& lists) {
  return FaceSideFinder(mesh, lists).run();
}

}  // namespace tetmend::formats
