// SPDX-License-Identifier: MIT
// Random edits, most of them nonsense: what SurfaceExchange takes leaves a closed surface of the same
// topology, with the patches, lines and corners that there were. The judge knows the whole surface and
// looks at all of it.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "envelope/present_surface.h"
#include "envelope/replacement.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using FaceTriple = std::array<VertexHandle, 3>;
using Edge = std::pair<VertexHandle, VertexHandle>;

FaceTriple rotated(FaceTriple f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

Edge in_order(VertexHandle a, VertexHandle b) {
  return std::minmax(a, b);
}

/// Directed sides, less their opposites.
std::map<Edge, int> border(const std::vector<FaceTriple>& faces) {
  std::map<Edge, int> sides;
  for (const FaceTriple& f : faces) {
    for (unsigned k = 0; k < 3; ++k) {
      const VertexHandle a = f[k];
      const VertexHandle b = f[(k + 1) % 3];
      sides[in_order(a, b)] += a < b ? 1 : -1;
    }
  }
  std::erase_if(sides, [](const auto& side) { return side.second == 0; });
  return sides;
}

/// A closed surface with patches and lines.
struct Whole {
  std::map<FaceTriple, std::uint32_t> faces;  // with patch
  std::map<Edge, std::uint32_t> lines;
  std::set<VertexHandle> corners;

  std::map<Edge, std::vector<std::uint32_t>> patches_at_edges() const {
    std::map<Edge, std::vector<std::uint32_t>> at;
    for (const auto& [f, patch] : faces) {
      for (unsigned k = 0; k < 3; ++k) at[{f[k], f[(k + 1) % 3]}].push_back(patch);
    }
    return at;
  }
  int euler() const {
    std::set<VertexHandle> vertices;
    for (const auto& [f, patch] : faces) vertices.insert(f.begin(), f.end());
    const auto edges = patches_at_edges().size() / 2;
    return static_cast<int>(vertices.size() + faces.size()) - static_cast<int>(edges);
  }
};

/// By line: the patches at its sides, of each of its edges.
std::map<std::uint32_t, std::set<std::pair<std::uint32_t, std::uint32_t>>> sides_of_lines(
    const Whole& whole) {
  std::map<std::uint32_t, std::set<std::pair<std::uint32_t, std::uint32_t>>> result;
  const auto at = whole.patches_at_edges();
  for (const auto& [edge, line] : whole.lines) {
    const auto here = at.find(edge);
    const auto there = at.find({edge.second, edge.first});
    if (here == at.end() || there == at.end()) {
      result[line].insert({SurfaceGuard::kNone, SurfaceGuard::kNone});
    } else {
      result[line].insert(std::minmax(here->second[0], there->second[0]));
    }
  }
  return result;
}

/// By line: the vertices at which an odd number of its edges ends, and whether three or more meet.
std::map<std::uint32_t, std::pair<std::set<VertexHandle>, bool>> ends_of_lines(const Whole& whole) {
  std::map<std::uint32_t, std::map<VertexHandle, int>> degrees;
  for (const auto& [edge, line] : whole.lines) {
    ++degrees[line][edge.first];
    ++degrees[line][edge.second];
  }
  std::map<std::uint32_t, std::pair<std::set<VertexHandle>, bool>> result;
  for (const auto& [line, at] : degrees) {
    for (const auto& [v, degree] : at) {
      if (degree == 1) result[line].first.insert(v);
      if (degree > 2) result[line].second = true;
    }
  }
  return result;
}

bool has_one_fan_each(const Whole& whole) {
  std::map<VertexHandle, std::map<VertexHandle, VertexHandle>> links;
  for (const auto& [f, patch] : whole.faces) {
    for (unsigned k = 0; k < 3; ++k) links[f[k]][f[(k + 1) % 3]] = f[(k + 2) % 3];
  }
  return std::all_of(links.begin(), links.end(), [](const auto& entry) {
    const auto& link = entry.second;
    std::size_t steps = 0;
    VertexHandle v = link.begin()->first;
    do {
      const auto next = link.find(v);
      if (next == link.end()) return false;
      v = next->second;
    } while (++steps <= link.size() && v != link.begin()->first);
    return steps == link.size();
  });
}

/// Whether a triangle is there from both sides: no surface of tets has that.
bool has_twins(Whole whole, const std::vector<FaceTriple>& before,
               const std::vector<FaceTriple>& after) {
  for (const FaceTriple& f : before) whole.faces.erase(rotated(f));
  for (const FaceTriple& f : after) whole.faces[rotated(f)] = 0;
  return std::any_of(whole.faces.begin(), whole.faces.end(), [&](const auto& face) {
    const FaceTriple& f = face.first;
    return whole.faces.contains({f[0], f[2], f[1]});
  });
}

/// What is wrong; empty if nothing.
std::string patch_complaint(const Whole& before, const Whole& now) {
  std::set<FaceTriple> triples;
  for (const auto& [f, patch] : now.faces) {
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) return "a face with a vertex twice";
    FaceTriple sorted = f;
    std::sort(sorted.begin(), sorted.end());
    if (!triples.insert(sorted).second) return "two faces with the same vertices";
  }
  const auto at = now.patches_at_edges();
  for (const auto& [edge, patches] : at) {
    const auto opposite = at.find({edge.second, edge.first});
    if (patches.size() != 1 || opposite == at.end()) return "an edge without two faces";
    const bool feature = now.lines.contains(in_order(edge.first, edge.second));
    if (!feature && patches != opposite->second) return "two patches at a smooth edge";
  }
  if (!has_one_fan_each(now)) return "a pinched vertex";
  if (now.euler() != before.euler()) return "another topology";
  if (sides_of_lines(now) != sides_of_lines(before)) return "a line between other patches";
  if (ends_of_lines(now) != ends_of_lines(before)) return "a line with other ends";
  for (const VertexHandle v : before.corners) {
    if (std::none_of(now.faces.begin(), now.faces.end(), [&](const auto& face) {
          return std::find(face.first.begin(), face.first.end(), v) != face.first.end();
        })) {
      return "a corner is gone";
    }
  }
  return {};
}

class Proposals {
 public:
  Proposals(const Whole& whole, std::uint32_t slots, std::uint64_t seed)
      : random_(seed), slots_(slots) {
    for (const auto& [f, patch] : whole.faces) faces_.push_back(f);
  }

  /// Some faces that hang together, and what may have the same border.
  std::pair<std::vector<FaceTriple>, std::vector<FaceTriple>> next() {
    std::vector<FaceTriple> before = {pick(faces_)};
    const std::size_t count = 1 + random_.index(7);
    for (int tries = 0; before.size() < count && tries < 200; ++tries) {
      const FaceTriple f = pick(faces_);
      const FaceTriple g = pick(before);
      const auto shared = std::count_if(f.begin(), f.end(), [&](VertexHandle v) {
        return std::find(g.begin(), g.end(), v) != g.end();
      });
      if (shared == 2 && std::find(before.begin(), before.end(), f) == before.end()) {
        before.push_back(f);
      }
    }
    std::vector<FaceTriple> after = before;
    fresh_ = slots_;
    const std::size_t steps = 1 + random_.index(3);
    for (std::size_t i = 0; i < steps && !after.empty(); ++i) change(after);
    return {before, after};
  }

 private:
  const FaceTriple& pick(const std::vector<FaceTriple>& faces) {
    return faces[random_.index(faces.size())];
  }
  VertexHandle pick_vertex(const std::vector<FaceTriple>& faces) {
    return pick(faces)[random_.index(3)];
  }

  void change(std::vector<FaceTriple>& faces) {
    switch (random_.index(6)) {
      case 0:
      case 1:
        return flip(faces);
      case 2: {  // one vertex for another
        const VertexHandle from = pick_vertex(faces);
        const VertexHandle to = random_.index(8) == 0 ? pick_vertex(faces_) : pick_vertex(faces);
        for (FaceTriple& f : faces) std::replace(f.begin(), f.end(), from, to);
        std::erase_if(faces, [](const FaceTriple& f) {
          return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
        });
        return;
      }
      case 3:
        return split(faces);
      case 4: {  // a face and its back
        const FaceTriple f = {pick_vertex(faces), pick_vertex(faces), pick_vertex(faces_)};
        if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) return;
        faces.push_back(f);
        faces.push_back({f[0], f[2], f[1]});
        return;
      }
      default: {
        const std::size_t i = random_.index(faces.size());
        const auto [a, b, c] = faces[i];
        const VertexHandle v = random_.index(2) == 0 ? VertexHandle(fresh_++) : pick_vertex(faces_);
        faces[i] = {a, b, v};
        faces.push_back({b, c, v});
        faces.push_back({c, a, v});
      }
    }
  }
  void flip(std::vector<FaceTriple>& faces) {
    const FaceTriple f = pick(faces);
    const std::size_t k = random_.index(3);
    const VertexHandle a = f[k];
    const VertexHandle b = f[(k + 1) % 3];
    for (const FaceTriple& g : faces) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (g[i] != b || g[(i + 1) % 3] != a) continue;
        const VertexHandle c = f[(k + 2) % 3];
        const VertexHandle d = g[(i + 2) % 3];
        const FaceTriple second = g;
        std::erase(faces, f);
        std::erase(faces, second);
        faces.push_back({c, a, d});
        faces.push_back({d, b, c});
        return;
      }
    }
  }
  void split(std::vector<FaceTriple>& faces) {
    const FaceTriple f = pick(faces);
    const std::size_t k = random_.index(3);
    const VertexHandle a = f[k];
    const VertexHandle b = f[(k + 1) % 3];
    const VertexHandle v(fresh_++);
    for (std::size_t i = 0, count = faces.size(); i < count; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const VertexHandle p = faces[i][j];
        const VertexHandle q = faces[i][(j + 1) % 3];
        if (in_order(p, q) != in_order(a, b)) continue;
        const VertexHandle opposite = faces[i][(j + 2) % 3];
        faces[i] = {p, v, opposite};
        faces.push_back({v, q, opposite});
        break;
      }
    }
  }

  contract::Random random_;
  std::vector<FaceTriple> faces_;
  std::uint32_t slots_;
  std::uint32_t fresh_ = 0;
};

std::vector<SurfaceFace> with_points(const std::vector<FaceTriple>& faces, const TetMesh& mesh) {
  const auto at = [&](VertexHandle v) -> Point {
    return v.index() < mesh.vertex_slots() ? mesh.point(v) : Point(v.index(), 0, 0);
  };
  std::vector<SurfaceFace> result;
  for (const FaceTriple& f : faces) result.push_back({f, {at(f[0]), at(f[1]), at(f[2])}});
  return result;
}

Whole after_edit(const Whole& whole, const SurfaceExchange& edit) {
  Whole now = whole;
  for (const auto& face : edit.before()) now.faces.erase(rotated(face.vertices));
  for (const auto& face : edit.after()) now.faces[rotated(face.vertices)] = face.patch;
  for (const auto& edge : edit.lost()) {
    now.lines.erase(in_order(edge.vertices[0], edge.vertices[1]));
  }
  for (const auto& edge : edit.gained()) {
    now.lines[in_order(edge.vertices[0], edge.vertices[1])] = edge.line;
  }
  return now;
}

}  // namespace

TEST_CASE("random edits: what is taken leaves patches, lines, corners and topology") {
  for (const auto& [data, angle] :
       {std::pair(kuhn_cube(2, 0, 1), 40.0), std::pair(kuhn_cube(3, 0, 1), 40.0),
        std::pair(one_tet(), 180.0), std::pair(delaunay_ball(7, 1), 180.0),
        std::pair(delaunay_ball(14, 2), 180.0), std::pair(delaunay_ball(30, 3), 60.0)}) {
    const double degrees = angle;  // a macro captures it
    const TetMesh mesh(data);
    const SurfaceFeatures features = find_features(mesh, {degrees, false, {}});
    const PresentSurface present(points_by_slot(mesh), features);
    Whole whole;
    for (const auto& face : features.faces) whole.faces[rotated(face.vertices)] = face.patch;
    for (const auto& edge : features.edges) {
      whole.lines[in_order(edge.vertices[0], edge.vertices[1])] = edge.line;
    }
    for (const auto& [f, patch] : whole.faces) {
      for (const VertexHandle v : f) {
        if (present.place(v) == SurfacePlace::corner) whole.corners.insert(v);
      }
    }
    REQUIRE(patch_complaint(whole, whole) == "");
    Proposals proposals(whole, static_cast<std::uint32_t>(mesh.vertex_slots()), 5);
    SurfaceExchange edit;
    std::size_t taken = 0;
    for (int i = 0; i < 20'000; ++i) {
      const auto [before, after] = proposals.next();
      if (after.empty() || border(before) != border(after)) continue;
      if (has_twins(whole, before, after)) continue;
      if (!edit.read(present, with_points(before, mesh), with_points(after, mesh))) continue;
      ++taken;
      const std::string about = patch_complaint(whole, after_edit(whole, edit));
      REQUIRE_MESSAGE(about.empty(), about, " after proposal ", i, " of ", degrees, " degrees, ",
                      whole.faces.size(), " faces");
    }
    CHECK(taken > 50);
  }
}
