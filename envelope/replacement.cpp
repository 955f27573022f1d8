// SPDX-License-Identifier: MIT
// What an edit does to the surface, by numbers alone.
//
//   faces and vertices -> feature edges that vanish, path by path, and what stands in their place
//   -> patches, from the border inwards -> edges: each side where it was, two faces at a smooth edge
//   -> as many holes and handles as before
#include "envelope/replacement.h"

#include <algorithm>
#include <tuple>

namespace tetmend {

namespace {

constexpr std::uint32_t kNone = SurfaceGuard::kNone;

using Triple = std::array<VertexHandle, 3>;

/// The same face in the same sense.
bool same_face(const Triple& a, const Triple& b) {
  return a == b || a == Triple{b[1], b[2], b[0]} || a == Triple{b[2], b[0], b[1]};
}

}  // namespace

bool SurfaceExchange::read(const PresentSurface& surface, std::span<const SurfaceFace> before,
                           std::span<const SurfaceFace> after) {
  if (!read_faces(surface, before, after)) return false;
  list_vertices();
  if (!check_vertices(surface)) return false;
  list_sides(before_, sides_before_);
  list_sides(after_, sides_after_);
  return find_lines(surface) && assign_patches(surface) && check_edges(surface) && keeps_topology();
}

bool SurfaceExchange::read_faces(const PresentSurface& surface, std::span<const SurfaceFace> before,
                                 std::span<const SurfaceFace> after) {
  before_.clear();
  after_.clear();
  for (const SurfaceFace& face : before) {
    const std::uint32_t patch = surface.patch_of_oriented(face.vertices);
    if (patch == kNone) return false;
    for (unsigned k = 0; k < 3; ++k) {
      if (face.points[k] != surface.point(face.vertices[k])) return false;
    }
    before_.push_back({face.vertices, face.points, patch});
  }
  for (const SurfaceFace& face : after) {
    const auto same = std::find_if(before_.begin(), before_.end(), [&](const Face& old) {
      return same_face(old.vertices, face.vertices);
    });
    if (same == before_.end() && surface.patch(face.vertices) != kNone) return false;
    after_.push_back({face.vertices, face.points, same == before_.end() ? kNone : same->patch});
  }
  return true;
}

SurfaceExchange::Vertex* SurfaceExchange::find(VertexHandle v) {
  const auto at = std::lower_bound(vertices_.begin(), vertices_.end(), v,
                                   [](const Vertex& x, VertexHandle y) { return x.vertex < y; });
  return at != vertices_.end() && at->vertex == v ? &*at : nullptr;
}

const SurfaceExchange::Vertex& SurfaceExchange::vertex(VertexHandle v) const {
  return *std::lower_bound(vertices_.begin(), vertices_.end(), v,
                           [](const Vertex& x, VertexHandle y) { return x.vertex < y; });
}

void SurfaceExchange::list_vertices() {
  vertices_.clear();
  for (const auto* faces : {&before_, &after_}) {
    for (const Face& face : *faces) {
      for (const VertexHandle v : face.vertices) vertices_.push_back({v});
    }
  }
  std::sort(vertices_.begin(), vertices_.end(),
            [](const Vertex& a, const Vertex& b) { return a.vertex < b.vertex; });
  vertices_.erase(
      std::unique(vertices_.begin(), vertices_.end(),
                  [](const Vertex& a, const Vertex& b) { return a.vertex == b.vertex; }),
      vertices_.end());
  for (const Face& face : before_) {
    for (unsigned k = 0; k < 3; ++k) {
      Vertex& vertex = *find(face.vertices[k]);
      ++vertex.before;
      vertex.point = face.points[k];
    }
  }
  for (const Face& face : after_) {
    for (unsigned k = 0; k < 3; ++k) {
      Vertex& vertex = *find(face.vertices[k]);
      ++vertex.after;
      vertex.moved = vertex.before > 0 && face.points[k] != vertex.point;
      if (vertex.before == 0) vertex.point = face.points[k];
    }
  }
  for (const Face& face : after_) {  // not before: each face is compared with the old place
    for (unsigned k = 0; k < 3; ++k) {
      Vertex& vertex = *find(face.vertices[k]);
      if (vertex.moved) vertex.point = face.points[k];
    }
  }
}

bool SurfaceExchange::check_vertices(const PresentSurface& surface) {
  for (const Face& face : after_) {
    for (unsigned k = 0; k < 3; ++k) {
      if (face.points[k] != vertex(face.vertices[k]).point) return false;
    }
  }
  for (Vertex& vertex : vertices_) {
    vertex.place = surface.place(vertex.vertex);
    if (vertex.before == 0) {
      if (vertex.place != SurfacePlace::inside) return false;
      vertex.place = SurfacePlace::smooth;
    } else if (vertex.after == 0 || vertex.moved) {
      if (vertex.place == SurfacePlace::corner) return false;
      if (surface.find(vertex.vertex)->corners.size() != vertex.before) return false;
      if (vertex.after == 0) vertex.place = SurfacePlace::inside;
    }
  }
  return true;
}

void SurfaceExchange::list_sides(std::span<const Face> faces, Sides& sides) {
  sides.clear();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const VertexHandle a = faces[i].vertices[k];
      const VertexHandle b = faces[i].vertices[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a < b, i});
    }
  }
  std::sort(sides.begin(), sides.end());
}

std::span<const SurfaceExchange::Side> SurfaceExchange::sides_at(const Sides& sides, VertexHandle a,
                                                                 VertexHandle b) {
  const Side wanted{std::min(a, b), std::max(a, b), false, 0};
  const auto begin = std::lower_bound(sides.begin(), sides.end(), wanted);
  auto end = begin;
  while (end != sides.end() && end->same_edge(wanted)) ++end;
  return {begin, end};
}

// --- lines ---------------------------------------------------------------------------------------

unsigned SurfaceExchange::faces_outside(const PresentSurface& surface, VertexHandle a,
                                        VertexHandle b) const {
  const SurfaceVertex* vertex = surface.find(a);
  if (vertex == nullptr) return 0;
  unsigned count = 0;
  for (const auto& corner : vertex->corners) count += corner.next == b || corner.previous == b;
  return count - static_cast<unsigned>(sides_at(sides_before_, a, b).size());
}

bool SurfaceExchange::is_feature(const PresentSurface& surface, VertexHandle a,
                                 VertexHandle b) const {
  return surface.line(a, b) != kNone ||
         std::any_of(gained_.begin(), gained_.end(), [&](const Edge& edge) {
           return key_of(edge.vertices[0], edge.vertices[1]) == key_of(a, b);
         });
}

bool SurfaceExchange::find_lines(const PresentSurface& surface) {
  lost_.clear();
  gained_.clear();
  moved_.clear();
  stands_for_.clear();
  for (std::size_t i = 0; i < sides_before_.size(); ++i) {
    const Side& side = sides_before_[i];
    if (i > 0 && side.same_edge(sides_before_[i - 1])) continue;
    const std::uint32_t line = surface.line(side.low, side.high);
    const bool stays = !sides_at(sides_after_, side.low, side.high).empty();
    if (!stays && faces_outside(surface, side.low, side.high) > 0) return false;
    if (line == kNone) continue;
    if (!stays) {
      lost_.push_back({{side.low, side.high}, line});
    } else if (vertex(side.low).moved || vertex(side.high).moved) {
      moved_.push_back({{side.low, side.high}, line});
    }
  }
  queue_.assign(lost_.size(), 0);  // 1: its path was replaced
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    if (queue_[i] != 0) continue;
    std::array<VertexHandle, 2> ends = lost_[i].vertices;
    queue_[i] = 1;
    for (VertexHandle& end : ends) {  // on to vertices that stay
      while (vertex(end).after == 0) {
        std::size_t next = 0;
        while (next < lost_.size() && (queue_[next] != 0 || (lost_[next].vertices[0] != end &&
                                                             lost_[next].vertices[1] != end))) {
          ++next;
        }
        if (next == lost_.size() || lost_[next].line != lost_[i].line) return false;
        queue_[next] = 1;
        const auto& v = lost_[next].vertices;
        end = v[0] == end ? v[1] : v[0];
      }
    }
    if (ends[0] == ends[1]) return false;
    const std::size_t first = gained_.size();
    if (!replace_path(ends[0], ends[1], lost_[i].line)) return false;
    stands_for_.resize(gained_.size(), lost_[i].vertices);
    for (std::size_t k = first; k < gained_.size(); ++k) {
      if (faces_outside(surface, gained_[k].vertices[0], gained_[k].vertices[1]) > 0) return false;
    }
  }
  return true;
}

/// One edge, or two with a new vertex between.
bool SurfaceExchange::replace_path(VertexHandle from, VertexHandle to, std::uint32_t line) {
  if (!sides_at(sides_after_, from, to).empty()) {
    gained_.push_back({{from, to}, line});
    return true;
  }
  Vertex* between = nullptr;
  for (Vertex& vertex : vertices_) {
    if (vertex.before > 0 || sides_at(sides_after_, from, vertex.vertex).empty() ||
        sides_at(sides_after_, vertex.vertex, to).empty()) {
      continue;
    }
    if (between != nullptr) return false;  // which of them?
    between = &vertex;
  }
  if (between == nullptr || between->place == SurfacePlace::ridge) return false;
  between->place = SurfacePlace::ridge;
  gained_.push_back({{from, between->vertex}, line});
  gained_.push_back({{between->vertex, to}, line});
  return true;
}

// --- patches -------------------------------------------------------------------------------------

bool SurfaceExchange::assign_from_border() {
  for (Face& face : after_) {
    for (unsigned k = 0; k < 3 && face.patch == kNone; ++k) {
      const VertexHandle a = face.vertices[k];
      const VertexHandle b = face.vertices[(k + 1) % 3];
      bool several = false;
      std::uint32_t patch = kNone;
      for (const Side& side : sides_at(sides_before_, a, b)) {
        if (side.up != (a < b)) continue;
        several = several || (patch != kNone && patch != before_[side.face].patch);
        patch = before_[side.face].patch;
      }
      if (!several) face.patch = patch;
    }
  }
  return true;
}

bool SurfaceExchange::assign_patches(const PresentSurface& surface) {
  assign_from_border();
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i + 1 < sides_after_.size(); ++i) {
      const Side& a = sides_after_[i];
      const Side& b = sides_after_[i + 1];
      if (!a.same_edge(b)) continue;
      std::uint32_t& first = after_[a.face].patch;
      std::uint32_t& second = after_[b.face].patch;
      if ((first == kNone) == (second == kNone) || is_feature(surface, a.low, a.high)) continue;
      (first == kNone ? first : second) = first == kNone ? second : first;
      changed = true;
    }
  }
  return std::none_of(after_.begin(), after_.end(),
                      [](const Face& face) { return face.patch == kNone; });
}

namespace {

/// Patches at an edge, each with its sense.
struct Around {
  std::array<std::pair<std::uint32_t, bool>, 8> sheets{};
  std::size_t count = 0;
  bool overflow = false;

  void add(std::uint32_t patch, bool up) {
    if (count == sheets.size()) {
      overflow = true;
    } else {
      sheets[count++] = {patch, up};
    }
  }
  bool operator==(Around other) {
    if (overflow || other.overflow || count != other.count) return false;
    const auto end = [](Around& x) {
      return x.sheets.begin() + static_cast<std::ptrdiff_t>(x.count);
    };
    std::sort(sheets.begin(), end(*this));
    std::sort(other.sheets.begin(), end(other));
    return std::equal(sheets.begin(), end(*this), other.sheets.begin());
  }
};

}  // namespace

/// A new feature edge has the patches at its sides that the old one had.
bool SurfaceExchange::check_gained(const Edge& edge) const {
  const auto number = static_cast<std::size_t>(&edge - gained_.data());
  const auto& old = stands_for_[number];
  const auto around = [](const Sides& sides, std::span<const Face> faces, VertexHandle a,
                         VertexHandle b, bool flip) {
    Around result;
    for (const Side& side : sides_at(sides, a, b)) {
      result.add(faces[side.face].patch, (side.up == (a < b)) != flip);
    }
    return result;
  };
  // Which way the old edge ran along the path is not kept: either way may do.
  Around now = around(sides_after_, after_, edge.vertices[0], edge.vertices[1], false);
  return now == around(sides_before_, before_, old[0], old[1], false) ||
         now == around(sides_before_, before_, old[0], old[1], true);
}

bool SurfaceExchange::check_edges(const PresentSurface& surface) const {
  for (const Edge& edge : gained_) {
    if (!check_gained(edge)) return false;
  }
  for (std::size_t begin = 0, end = 0; begin < sides_after_.size(); begin = end) {
    while (end < sides_after_.size() && sides_after_[end].same_edge(sides_after_[begin])) ++end;
    const VertexHandle a = sides_after_[begin].low;
    const VertexHandle b = sides_after_[begin].high;
    const auto old = sides_at(sides_before_, a, b);
    const bool kept_feature = surface.line(a, b) != kNone;
    if (!kept_feature && is_feature(surface, a, b)) continue;
    Around now;
    Around was;
    for (std::size_t i = begin; i < end; ++i) {
      now.add(after_[sides_after_[i].face].patch, sides_after_[i].up);
    }
    for (const Side& side : old) was.add(before_[side.face].patch, side.up);
    const unsigned outside = faces_outside(surface, a, b);
    if (kept_feature || outside > 0) {
      if (!(now == was)) return false;
    } else if (now.count != 2 || now.sheets[0].first != now.sheets[1].first ||
               now.sheets[0].second == now.sheets[1].second) {
      return false;
    }
  }
  return true;
}

bool SurfaceExchange::keeps_topology() const {
  const auto edges = [](const Sides& sides) {
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      count += i == 0 || !sides[i].same_edge(sides[i - 1]);
    }
    return count;
  };
  std::ptrdiff_t difference = edges(sides_before_) - edges(sides_after_);
  for (const Vertex& vertex : vertices_) difference += (vertex.after > 0) - (vertex.before > 0);
  return difference + std::ssize(after_) - std::ssize(before_) == 0;
}

}  // namespace tetmend
