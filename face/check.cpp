// SPDX-License-Identifier: MIT
// Does a mesh keep what a solver, or its input, asks of it?
//
//   of one mesh: thresholds of angles and rulers, inverted tets, as asked for or as a preset says
//   of two: the same surface, walls, labels, volumes, groups, and nothing worse; computed from the
//   two meshes alone, tets listed in positive order and groups by their names
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/check.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

#include "envelope/element.h"
#include "face/arena.h"
#include "face/mesh_access.h"
#include "face/moving_surface.h"
#include "face/near_surface.h"
#include "kernel/curved.h"
#include "kernel/exact_orientation.h"
#include "kernel/formats/inp.h"
#include "kernel/formats/su2.h"
#include "kernel/geometry.h"
#include "kernel/grouped.h"
#include "kernel/nearest_word.h"
#include "kernel/shared_parts.h"
#include "kernel/statistics.h"
#include "kernel/tet_faces.h"

namespace tetmend {

namespace {

Fact at_least(std::string name, std::string_view what, double value, double wanted) {
  return {std::move(name), value >= wanted,
          fmt::format("{} {:.6g}, wanted at least {:.6g}", what, value, wanted), value, wanted};
}
Fact at_most(std::string name, std::string_view what, double value, double wanted) {
  return {std::move(name), value <= wanted,
          fmt::format("{} {:.6g}, wanted at most {:.6g}", what, value, wanted), value, wanted};
}

/// In exact arithmetic. `allowed`: so many there were before.
Fact no_inverted(const MeshData& mesh, std::size_t allowed = 0) {
  const Scale scale = Scale::of(mesh.points);
  std::size_t count = 0;
  std::optional<std::size_t> first;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& v = mesh.tets[t].vertices;
    const auto point = [&](std::size_t k) { return scale.to_work(mesh.points[v[k]]); };
    if (exact_orientation(point(0), point(1), point(2), point(3)) > 0) continue;
    if (count++ == 0) first = t;
  }
  std::string text = "no inverted or flat tet, in exact arithmetic";
  if (first) {
    text = fmt::format("{} inverted or flat {}, the first is tet {} (from 1)", grouped(count),
                       count == 1 ? "tet" : "tets", *first + 1);
    if (allowed > 0) text += fmt::format("; there were {}", grouped(allowed));
  }
  return {"inverted", count <= allowed, text, count, allowed};
}

using Bits = std::array<std::uint64_t, 3>;

/// A triangle by the bits of its corners, whatever the numbers of its vertices, and what is on its
/// two sides.
struct Wall {
  std::array<Bits, 3> corners{};
  std::array<Label, 2> labels{};
  bool is_boundary = true;
  auto all() const { return std::tie(corners, labels, is_boundary); }
  friend bool operator<(const Wall& a, const Wall& b) { return a.all() < b.all(); }
};

Bits bits_of(const Point& p) {
  return {std::bit_cast<std::uint64_t>(p.x()), std::bit_cast<std::uint64_t>(p.y()),
          std::bit_cast<std::uint64_t>(p.z())};
}

std::array<Bits, 3> corners_of(const MeshData& mesh, const std::array<std::uint32_t, 3>& vertices) {
  std::array<Bits, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) corners[k] = bits_of(mesh.points[vertices[k]]);
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Faces with one tet, or with two of different labels.
std::vector<Wall> walls_of(const MeshData& mesh) {
  std::vector<Wall> walls;
  for_face_pairs(sorted_tet_faces(mesh), [&](const TetFace& face, const TetFace* second) {
    const Label label = mesh.tets[face.tet].label;
    const Label other = second == nullptr ? label : mesh.tets[second->tet].label;
    if (second != nullptr && other == label) return;
    walls.push_back({corners_of(mesh, face.vertices),
                     {std::min(label, other), std::max(label, other)},
                     second == nullptr});
  });
  std::sort(walls.begin(), walls.end());
  return walls;
}

std::vector<std::pair<std::array<Bits, 3>, Label>> named_triangles(const MeshData& mesh) {
  std::vector<std::pair<std::array<Bits, 3>, Label>> triangles;
  for (const MeshData::Triangle& triangle : mesh.triangles) {
    triangles.emplace_back(corners_of(mesh, triangle.vertices), triangle.label);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

template <class T>
std::size_t count_differences(const std::vector<T>& a, const std::vector<T>& b) {
  std::vector<T> differing;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                std::back_inserter(differing));
  return differing.size();
}

template <class T>
Fact same(std::string name, std::string_view what, const std::vector<T>& before,
          const std::vector<T>& after) {
  const std::size_t differing = count_differences(before, after);
  const std::string text =
      differing == 0
          ? fmt::format("{}: the same {}, bit for bit", what, grouped(before.size()))
          : fmt::format("{}: {} and {}, {} of them in one mesh only", what, grouped(before.size()),
                        grouped(after.size()), grouped(differing));
  return {std::move(name), differing == 0, text, differing, std::uint64_t{0}};
}

Point point_of(const Bits& bits) {
  return {std::bit_cast<double>(bits[0]), std::bit_cast<double>(bits[1]),
          std::bit_cast<double>(bits[2])};
}

/// What stands for what when a surface may have moved, numbered for both meshes alike.
class Sheets {
 public:
  void add(const Wall& wall, std::vector<face::SurfacePiece>& pieces) {
    add({wall.corners[0], wall.corners[1], wall.corners[2]},
        fmt::format("{} {} {}", wall.labels[0], wall.labels[1], wall.is_boundary), pieces);
  }
  void add(const std::pair<std::array<Bits, 3>, Label>& triangle,
           std::vector<face::SurfacePiece>& pieces) {
    const auto& [corners, label] = triangle;
    add({corners[0], corners[1], corners[2]}, fmt::format("{}", label), pieces);
  }
  /// @param corners of a triangle or an edge
  void add(const std::vector<Bits>& corners, const std::string& name,
           std::vector<face::SurfacePiece>& pieces) {
    const auto sheet = static_cast<std::uint32_t>(sheets_.size());
    face::SurfacePiece piece;
    piece.corners = static_cast<unsigned>(corners.size());
    piece.sheet = sheets_.try_emplace(name, sheet).first->second;
    for (std::size_t k = 0; k < 3; ++k) {
      piece.points[k] = point_of(corners[std::min(k, corners.size() - 1)]);
    }
    pieces.push_back(piece);
  }

 private:
  std::map<std::string, std::uint32_t> sheets_;
};

/// As same(), or with a tolerance: each within it of what stands for it in the other mesh.
template <class T>
Fact same_or_near(std::string name, std::string_view what, const std::vector<T>& before,
                  const std::vector<T>& after, const face::NearTolerance& tolerance) {
  if (tolerance.surface.is_fixed()) return same(std::move(name), what, before, after);
  Sheets sheets;
  std::vector<face::SurfacePiece> then, now;
  for (const T& each : before) sheets.add(each, then);
  for (const T& each : after) sheets.add(each, now);
  const face::Nearness found = face::prove_near(then, now, tolerance);
  std::string text =
      fmt::format("{}: {}, was {}", what, grouped(after.size()), grouped(before.size()));
  if (found.unproven > 0) {
    text += fmt::format("; of {} no proof is found that they are within the tolerance",
                        grouped(found.unproven));
  } else if (found.others > 0) {
    text += fmt::format("; {} are new, and nothing is farther than {:.3g} from the others",
                        grouped(found.others), found.distance);
  }
  return {std::move(name), found.unproven == 0, text, found.unproven, std::uint64_t{0}};
}

/// In lengths that can be worked with.
double volume_of(const MeshData& mesh, const MeshData::Tet& tet, const Scale& scale) {
  const auto point = [&](std::size_t k) { return scale.to_work(mesh.points[tet.vertices[k]]); };
  return volume6(point(0), point(1), point(2), point(3)) / 6;
}

std::map<Label, double> volumes_of(const MeshData& mesh, const Scale& scale) {
  std::map<Label, double> volumes;
  for (const MeshData::Tet& tet : mesh.tets) volumes[tet.label] += volume_of(mesh, tet, scale);
  return volumes;
}

/// By how much the volume behind a wall may change that moves within the tolerance, by label: no
/// more than its area times that, and a little, as it may bend.
std::map<Label, double> volumes_allowed(const std::vector<Wall>& walls, const Scale& scale,
                                        const face::NearTolerance& tolerance) {
  constexpr double kBends = 1.5;
  const EnvelopeOptions options = tolerance.surface.envelope_options();
  std::map<Label, double> allowed;
  for (const Wall& wall : walls) {
    std::array<Point, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = scale.to_work(point_of(wall.corners[k]));
    const double away =
        options.length > 0 ? scale.to_work(options.length) : options.share * mean_edge(p);
    allowed[wall.labels[0]] += kBends * away * triangle_area(p);
    if (wall.labels[1] != wall.labels[0])
      allowed[wall.labels[1]] += kBends * away * triangle_area(p);
  }
  return allowed;
}

/// Volumes of inverted tets count as they are, so the sum over a region depends on its walls alone.
/// @param allowed further changes, by label
std::vector<Fact> same_volumes(const MeshData& before, const MeshData& after, const Scale& scale,
                               const std::map<Label, double>& allowed) {
  constexpr double kRounding = 1e-9;
  const std::map<Label, double> then = volumes_of(before, scale);
  const std::map<Label, double> now = volumes_of(after, scale);
  const auto in_file = [&](double volume) { return std::ldexp(volume, 3 * scale.exponent()); };
  const auto text = [&](double volume) { return volume_text(volume, scale.exponent(), 9); };
  std::vector<Fact> facts;
  for (const auto& [label, volume] : then) {
    const auto found = now.find(label);
    const double other = found == now.end() ? 0 : found->second;
    const auto more = allowed.find(label);
    const double most = kRounding * std::abs(volume) + (more == allowed.end() ? 0 : more->second);
    facts.push_back(
        {"volume", found != now.end() && std::abs(other - volume) <= std::max(most, 1e-300),
         fmt::format("volume of label {}: {}, was {}", label, text(other), text(volume)),
         in_file(other), in_file(volume)});
  }
  for (const auto& [label, volume] : now) {
    if (then.contains(label)) continue;
    facts.push_back({"volume", false, fmt::format("label {} is new", label), in_file(volume), {}});
  }
  return facts;
}

/// Of edges that had to stay. Of those that only their bend holds within the volume, the ones that
/// `known` tells: others are curved since.
std::vector<Bits> fixed_mid_nodes(const MeshData& mesh, const std::vector<Bits>* known = nullptr) {
  const FixedMidNodes fixed = find_fixed_mid_nodes(mesh, true);
  std::vector<Bits> nodes;
  auto inside = fixed.inside.begin();  // in the order of the nodes
  for (std::size_t i = 0; i < fixed.is_fixed.size(); ++i) {
    if (!fixed.is_fixed[i]) continue;
    const auto& [a, b, node] = mesh.mid_nodes[i];
    const bool is_inside = inside != fixed.inside.end() && inside->vertices == std::array{a, b};
    if (is_inside) ++inside;
    const Bits bits = bits_of(mesh.points[node]);
    if (known != nullptr && is_inside && !std::binary_search(known->begin(), known->end(), bits)) {
      continue;
    }
    nodes.push_back(bits);
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void add_second_order(const CurvedStatistics& was, const CurvedStatistics& is,
                      std::vector<Fact>& facts) {
  facts.push_back(at_most("turned_over", "curved tets turned over",
                          static_cast<double>(is.turned_over),
                          static_cast<double>(was.turned_over)));
  facts.push_back(at_least("jacobian_ratio", "worst Jacobian ratio at the nodes", is.worst.at_nodes,
                           was.worst.at_nodes));
  facts.push_back(at_least("jacobian_bound", "worst bound of a Jacobian ratio", is.worst.bound,
                           was.worst.bound));
}

/// Numbers of the elements of a group, for one kind of element.
template <class Element>
std::vector<std::size_t> members_of(const Group& group, const std::vector<Element>& elements,
                                    const std::vector<Label>& parts) {
  std::vector<std::size_t> members(group.members.begin(), group.members.end());
  if (!members.empty()) return members;
  const bool by_part = !group.parts.empty();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const bool is_in = by_part ? !parts.empty() && std::find(group.parts.begin(), group.parts.end(),
                                                             parts[i]) != group.parts.end()
                               : elements[i].label == group.number;
    if (is_in) members.push_back(i);
  }
  return members;
}

/// A group without a name is what its elements make it.
bool has_elements(const MeshData& mesh, const Group& group) {
  switch (group.dimension) {
    case 1:
      if (!members_of(group, mesh.edges, mesh.edge_parts).empty()) return true;
      break;
    case 2:
      if (!members_of(group, mesh.triangles, mesh.triangle_parts).empty()) return true;
      break;
    case 3:
      if (!members_of(group, mesh.tets, mesh.tet_parts).empty()) return true;
      break;
    default:
      return true;
  }
  return std::any_of(
      mesh.other_elements.begin(), mesh.other_elements.end(), [&](const OtherElements& others) {
        const auto& of_elements = others.parts.empty() ? others.labels : others.parts;
        return std::any_of(of_elements.begin(), of_elements.end(), [&](Label number) {
          return group.parts.empty() ? number == group.number
                                     : std::find(group.parts.begin(), group.parts.end(), number) !=
                                           group.parts.end();
        });
      });
}

std::vector<std::string> group_names(const MeshData& mesh) {
  std::vector<std::string> names;
  for (const Group& group : mesh.groups) {
    if (group.name.empty() && !has_elements(mesh, group)) continue;
    names.push_back(fmt::format("{} {} '{}'", group.dimension, group.number, group.name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// What a named group has: its triangles or edges by their corners, or the volume of its tets.
struct GroupContent {
  std::vector<std::vector<Bits>> elements;
  double volume = 0;
};
std::map<std::string, GroupContent> contents_of_groups(const MeshData& mesh, const Scale& scale) {
  std::map<std::string, GroupContent> contents;
  for (const Group& group : mesh.groups) {
    if (group.name.empty() || group.dimension == 0) continue;
    GroupContent& content = contents[fmt::format("{} '{}'", group.dimension, group.name)];
    const auto add = [&](const auto& element) {
      std::vector<Bits>& corners = content.elements.emplace_back();
      for (const std::uint32_t v : element.vertices) corners.push_back(bits_of(mesh.points[v]));
      std::sort(corners.begin(), corners.end());
    };
    if (group.dimension == 1) {
      for (const std::size_t i : members_of(group, mesh.edges, mesh.edge_parts)) add(mesh.edges[i]);
    } else if (group.dimension == 2) {
      for (const std::size_t i : members_of(group, mesh.triangles, mesh.triangle_parts)) {
        add(mesh.triangles[i]);
      }
    } else {
      for (const std::size_t i : members_of(group, mesh.tets, mesh.tet_parts)) {
        content.volume += volume_of(mesh, mesh.tets[i], scale);
      }
    }
    std::sort(content.elements.begin(), content.elements.end());
  }
  return contents;
}

/// Of the groups of this dimension. Several parts of a deck may have one of the same name each.
std::map<std::string, std::vector<Label>> numbers_by_name(const MeshData& mesh, int dimension) {
  std::map<std::string, std::vector<Label>> numbers;
  for (const Group& group : mesh.groups) {
    const bool is_named = group.dimension == dimension && !group.name.empty();
    if (is_named) numbers[group.name].push_back(group.number);
  }
  return numbers;
}

/// For each number of a group in `after` the one in `before`, where their names say so. A number
/// that would mean two things then gets a new one.
std::map<Label, Label> renumbering(const MeshData& before, const MeshData& after, int dimension) {
  const auto then = numbers_by_name(before, dimension);
  std::map<Label, Label> to;
  std::set<Label> taken;
  for (const auto& [name, numbers] : numbers_by_name(after, dimension)) {
    const auto found = then.find(name);
    if (found == then.end() || found->second.size() != numbers.size()) continue;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      to[numbers[k]] = found->second[k];
      taken.insert(found->second[k]);
    }
  }
  Label free = std::numeric_limits<Label>::min();
  for (const Label number : taken) {
    if (!to.contains(number)) to[number] = free++;
  }
  std::erase_if(to, [](const auto& pair) { return pair.first == pair.second; });
  return to;
}

/// Of a format that has names alone: numbers are given by the place in the file.
bool numbers_by_place(const MeshData& mesh) {
  return mesh.variant == formats::kInp || mesh.variant == formats::kSu2;
}

/// Where numbers are given by place, the names count.
/// @return `after`, or `own` with the numbers that `before` has
const MeshData& numbered_as(const MeshData& before, const MeshData& after, MeshData& own) {
  const MeshData* result = &after;
  if (!numbers_by_place(before) && !numbers_by_place(after)) return after;
  for (int dimension = 0; dimension <= 3; ++dimension) {
    const std::map<Label, Label> to = renumbering(before, after, dimension);
    if (to.empty()) continue;
    if (result != &own) own = after;
    result = &own;
    const auto renumber = [&](Label& number) {
      if (const auto found = to.find(number); found != to.end()) number = found->second;
    };
    for (Group& group : own.groups) {
      if (group.dimension == dimension) renumber(group.number);
    }
    const auto renumber_all = [&](auto& elements) {
      for (auto& element : elements) renumber(element.label);
    };
    if (dimension == 1) renumber_all(own.edges);
    if (dimension == 2) renumber_all(own.triangles);
    if (dimension == 3) renumber_all(own.tets);
  }
  return *result;
}

/// A mesh may list the vertices of its tets in either sense: as it is put right before any work.
/// @return the mesh, or `own` where that differs
const MeshData& put_right(const Mesh& mesh, MeshData& own) {
  const MeshData& data = MeshAccess::data(mesh);
  MeshData bare;
  bare.points = data.points;
  bare.tets = data.tets;
  BuildReport report;
  const TetMesh built =
      face::build_located(mesh.file(), bare, {.sorted = false, .report = &report});
  if (!report.mirrored && report.reordered_tets == 0) return data;
  own = data;
  for (std::uint32_t t = 0; t < own.tets.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      own.tets[t].vertices[k] = built.origin(built.vertices(TetHandle(t))[k]);
    }
  }
  return own;
}

/// As the second mesh is put right, unless it lists more tets in the wrong sense than the first: a solver
/// reads what is listed. A mesh that is mirrored as a whole has another sense, no wrong one.
Fact not_more_inverted(const MeshData& before, const MeshData& listed_before, const MeshData& after,
                       const MeshData& listed_after) {
  const auto count = [](const MeshData& mesh) {
    return std::get<std::uint64_t>(no_inverted(mesh).value);
  };
  const auto count_listed = [&](const MeshData& mesh) {
    const std::uint64_t inverted = count(mesh);
    return inverted == mesh.tets.size() ? 0 : inverted;
  };
  const std::uint64_t allowed = std::max(count(before), count_listed(listed_before));
  const bool is_listed_worse = count_listed(listed_after) > allowed;
  return is_listed_worse ? no_inverted(listed_after, allowed) : no_inverted(after, count(before));
}

/// Triangles or edges of a group, of which one may have been moved within the tolerance.
bool are_near(const std::vector<std::vector<Bits>>& before,
              const std::vector<std::vector<Bits>>& after, const face::NearTolerance& tolerance) {
  if (tolerance.surface.is_fixed()) return false;
  Sheets sheets;
  std::vector<face::SurfacePiece> then, now;
  for (const auto& each : before) sheets.add(each, "", then);
  for (const auto& each : after) sheets.add(each, "", now);
  return face::prove_near(then, now, tolerance).unproven == 0;
}

/// One fact for all groups, which names the first that differs.
/// @param volume  by how much one may change
Fact same_groups(const MeshData& before, const MeshData& after, const Scale& scale,
                 const face::NearTolerance& tolerance, double volume) {
  constexpr double kRounding = 1e-9;
  const auto then = contents_of_groups(before, scale);
  const auto now = contents_of_groups(after, scale);
  std::string first;
  std::size_t differing = 0;
  std::size_t gone = 0;  // which another fact tells
  for (const auto& [name, content] : then) {
    const auto found = now.find(name);
    if (found == now.end()) {
      ++gone;
      continue;
    }
    const double change = std::abs(found->second.volume - content.volume);
    const bool is_same = found->second.elements == content.elements ||
                         are_near(content.elements, found->second.elements, tolerance);
    if (is_same && change <= kRounding * std::abs(content.volume) + volume) continue;
    if (differing++ == 0) first = name;
  }
  const std::string text =
      differing == 0
          ? fmt::format("triangles, edges and volumes of {} named groups{}: the same{}",
                        grouped(then.size() - gone),
                        gone == 0 ? "" : fmt::format(" that both have, of {}", then.size()),
                        tolerance.surface.is_fixed() ? "" : ", within the tolerance")
          : fmt::format("{} groups have other triangles, edges or volumes, the first is {}",
                        grouped(differing), first);
  return {"group_contents", differing == 0, text, differing, std::uint64_t{0}};
}

/// Other elements are where they were, and what tets had in common with them is there still.
Fact same_shared_parts(const MeshData& before, const MeshData& after) {
  const auto corners = [](const MeshData& mesh, std::span<const std::uint32_t> vertices) {
    std::vector<Bits> bits;
    for (const std::uint32_t v : vertices) bits.push_back(bits_of(mesh.points[v]));
    std::sort(bits.begin(), bits.end());
    return bits;
  };
  const auto parts_of = [&](const MeshData& mesh) {
    const SharedParts shared = find_shared_parts(mesh);
    std::vector<std::vector<Bits>> parts;
    for (const auto& face : shared.faces) parts.push_back(corners(mesh, face));
    for (const auto& edge : shared.edges) parts.push_back(corners(mesh, edge));
    for (const std::uint32_t v : shared.points) parts.push_back(corners(mesh, {&v, 1}));
    std::sort(parts.begin(), parts.end());
    return parts;
  };
  const auto elements_of = [&](const MeshData& mesh) {
    std::vector<std::pair<int, std::vector<Bits>>> elements;
    for (const OtherElements& others : mesh.other_elements) {
      if (others.vertex_count == 0) continue;
      const std::span<const std::uint32_t> all = others.vertices;
      for (std::size_t i = 0; i < all.size(); i += others.vertex_count) {
        elements.emplace_back(others.vtk_type, corners(mesh, all.subspan(i, others.vertex_count)));
      }
    }
    std::sort(elements.begin(), elements.end());
    return elements;
  };
  const auto count_missing = [](const auto& then, const auto& now) {
    auto missing = then;
    missing.erase(
        std::set_difference(then.begin(), then.end(), now.begin(), now.end(), missing.begin()),
        missing.end());
    return missing.size();
  };
  const auto then = parts_of(before);
  const auto elements = elements_of(before);
  const std::size_t lost =
      count_missing(then, parts_of(after)) + count_missing(elements, elements_of(after));
  const std::string text =
      lost == 0 ? fmt::format(
                      "{} other elements, and {} faces, edges and points that tets have in common "
                      "with them: the same, bit for bit",
                      grouped(elements.size()), grouped(then.size()))
                : fmt::format(
                      "{} of {} other elements, and of {} faces, edges and points that tets have "
                      "in common with them, are gone",
                      grouped(lost), grouped(elements.size()), grouped(then.size()));
  return {"other_elements", lost == 0, text, lost, std::uint64_t{0}};
}

/// @throws Error, with the file if there is one, as Scale::of()
Scale scale_of(const Mesh& mesh) {
  try {
    return Scale::of(MeshAccess::data(mesh).points);
  } catch (const Error& error) {
    if (mesh.file().empty()) throw;
    throw Error(fmt::format("{}: {}", mesh.file().string(), error.what()));
  }
}

/// Faces of one tet only that no triangle has: solvers want a boundary condition on each.
Fact no_bare_boundary(const MeshData& mesh) {
  std::vector<std::array<Bits, 3>> named;
  for (const MeshData::Triangle& triangle : mesh.triangles) {
    named.push_back(corners_of(mesh, triangle.vertices));
  }
  std::sort(named.begin(), named.end());
  std::size_t count = 0;
  for (const Wall& wall : walls_of(mesh)) {
    count += wall.is_boundary && !std::binary_search(named.begin(), named.end(), wall.corners);
  }
  const std::string text =
      count == 0 ? "every triangle of the boundary is in the file, with a label or marker"
                 : fmt::format(
                       "{} triangles of the boundary are not in the file: they have no "
                       "label or marker",
                       grouped(count));
  return {"bare_boundary", count == 0, text, count, std::uint64_t{0}};
}

/// What a mesh is for, whatever the program.
enum class Use : std::uint8_t { any, explicit_steps, implicit_steps };

struct Preset {
  CheckPreset shown;
  std::vector<std::pair<std::string_view, double>> rulers;
  bool wants_markers = false;  ///< on all of the boundary
  Use use = Use::any;
};

std::span<const Preset> presets() {
  static const std::vector<Preset> kPresets = {
      {{"calculix", "ccx ends with status 201 at an element whose Jacobian is not positive"}, {}},
      {{"fenicsx", "the Jacobian of an affine cell must not vanish, nor change its sign"}, {}},
      {{"openfoam", "limits of checkMesh: non-orthogonality 70, skewness 4, aspect ratio 1000"},
       {{"non_orthogonality", 70}, {"skewness", 4}, {"aspect_ratio", 1000}}},
      {{"su2", "the dual volumes of a mesh must be positive, all of the boundary in markers"},
       {},
       true},
      {{"explicit", "steps in time: the step is at least a fifth of what 99 % of the points allow"},
       {},
       false,
       Use::explicit_steps},
      {{"implicit", "equations: 1 % of the tets at most have a condition number above 10"},
       {},
       false,
       Use::implicit_steps}};
  return kPresets;
}

/// Null where no name was given.
const Preset* find_preset(std::string_view name) {
  if (name.empty()) return nullptr;
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) {
    if (preset.shown.name == name) return &preset;
    names.push_back(preset.shown.name);
  }
  throw OptionError("for", fmt::format("for: '{}' is no preset: expected one of {}{}", name,
                                       fmt::join(names, ", "),
                                       guess_of(name, fmt::format("{}", fmt::join(names, ", ")))));
}

std::size_t find_ruler(std::string_view name) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kRulerCount; ++i) {
    if (kRulers[i].name == name) return i;
    names.push_back(kRulers[i].name);
  }
  throw OptionError(
      "measure",
      fmt::format("measure: '{}' is no ruler: expected one of {}{}", name, fmt::join(names, ", "),
                  guess_of(name, fmt::format("{}", fmt::join(names, ", ")))));
}

void check_range(const char* option, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw OptionError(option,
                    fmt::format("{}: {:g} is not in {:g} to {:g}", option, value, low, high));
}

Fact threshold(std::string_view name, double wanted, const MeshRulers& rulers) {
  const std::size_t i = find_ruler(name);
  const RulerInfo& of = kRulers[i];
  const std::string what = fmt::format("worst {}", of.title);
  const double worst = rulers.figures[i].worst;
  return of.large_is_good ? at_least(std::string(of.name), what, worst, wanted)
                          : at_most(std::string(of.name), what, worst, wanted);
}

/// What the mesh alone says about a use.
std::vector<Fact> fitness(Use use, const MeshRulers& rulers) {
  constexpr double kShareOfStep = 0.2;
  constexpr double kMostCondition = 10;
  const RulerFigures& step = rulers[Ruler::step];
  if (use == Use::explicit_steps) {
    return {at_least("step_share", "step, as a share of what 99 % of the points allow,",
                     step.one_percent > 0 ? step.worst / step.one_percent : 0, kShareOfStep)};
  }
  if (use == Use::implicit_steps) {
    return {at_most("condition_share", "condition number that 1 % of the tets reach",
                    rulers[Ruler::condition].one_percent, kMostCondition)};
  }
  return {};
}

/// No dearer to solve on than before.
std::vector<Fact> no_dearer(Use use, const Measurement& then, const Measurement& now) {
  constexpr double kRounding = 1e-9;
  constexpr double kOfEstimate = 0.02;  // it tells no smaller difference
  const auto step = [](const Measurement& of) { return (*of.rulers)[Ruler::step].worst; };
  const auto cost = [&](const Measurement& of) {
    return static_cast<double>(of.statistics.tets) / step(of);  // infinite without a step
  };
  if (use == Use::explicit_steps) {
    return {at_least("step", "step", step(now), (1 - kRounding) * step(then)),
            at_most("explicit_cost", "tets by step", cost(now), (1 + kRounding) * cost(then))};
  }
  if (use == Use::implicit_steps) {
    return {at_most("work", "work, tets x estimated CG steps,", now.rulers->work,
                    (1 + kOfEstimate) * then.rulers->work)};
  }
  return {};
}

std::vector<Fact> same_walls(std::vector<Wall> then, std::vector<Wall> now,
                             const face::NearTolerance& tolerance) {
  const auto split = [](std::vector<Wall>& walls) {
    const auto middle = std::stable_partition(walls.begin(), walls.end(),
                                              [](const Wall& wall) { return wall.is_boundary; });
    std::vector<Wall> inner(middle, walls.end());
    walls.erase(middle, walls.end());
    return inner;
  };
  const std::vector<Wall> inner_then = split(then);
  const std::vector<Wall> inner_now = split(now);
  return {same_or_near("surface", "triangles of the surface", then, now, tolerance),
          same_or_near("walls", "faces between two labels", inner_then, inner_now, tolerance)};
}

/// @throws OptionError for a surface that is none, or a length that is hardly meant
face::NearTolerance tolerance_around(const MeshData& mesh, const Options& run) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  face::NearTolerance tolerance{face::SurfaceTolerance(run), Point::Constant(kFar),
                                Point::Constant(-kFar)};
  for (const MeshData::Tet& tet : mesh.tets) {
    for (const std::uint32_t v : tet.vertices) {
      tolerance.low = tolerance.low.cwiseMin(mesh.points[v]);
      tolerance.high = tolerance.high.cwiseMax(mesh.points[v]);
    }
  }
  const Point diagonal = tolerance.high - tolerance.low;
  if (!mesh.tets.empty()) tolerance.surface.check_length(diagonal.norm());
  return tolerance;
}

/// Walls, named triangles, groups and volumes: what a surface makes, that stays or moves within a
/// tolerance.
std::vector<Fact> same_surface(const MeshData& before, const MeshData& after, const Scale& scale,
                               const face::NearTolerance& tolerance) {
  std::vector<Wall> walls = walls_of(before);
  std::map<Label, double> allowed;
  if (!tolerance.surface.is_fixed()) allowed = volumes_allowed(walls, scale, tolerance);
  double most = 0;
  for (const auto& [label, volume] : allowed) most += volume;
  std::vector<Fact> facts = same_walls(std::move(walls), walls_of(after), tolerance);
  facts.push_back(same_or_near("triangles", "named triangles with labels", named_triangles(before),
                               named_triangles(after), tolerance));
  facts.push_back(same("groups", "groups", group_names(before), group_names(after)));
  facts.push_back(same_groups(before, after, scale, tolerance, most));
  for (Fact& fact : same_volumes(before, after, scale, allowed)) facts.push_back(std::move(fact));
  return facts;
}

}  // namespace

std::vector<Fact> check(const Mesh& mesh, const CheckOptions& options) {
  check_range("min_dihedral", options.min_dihedral, 0, 71);
  check_range("max_dihedral", options.max_dihedral, 70, 180);
  const Preset* const preset = find_preset(options.preset);
  for (const auto& [name, wanted] : options.measure) find_ruler(name);
  const bool asks_for_inverted = options.no_inverted || preset != nullptr;
  const MeshData& data = MeshAccess::data(mesh);
  std::vector<Fact> facts;
  if (asks_for_inverted) {
    scale_of(mesh);  // or an error with the file
    facts.push_back(no_inverted(data));
  }
  if (preset != nullptr && preset->wants_markers) facts.push_back(no_bare_boundary(data));
  const Measurement measured = measure(mesh, {.threads = options.threads});
  if (measured.curved && asks_for_inverted) {
    facts.push_back(at_most("turned_over", "curved tets turned over",
                            static_cast<double>(measured.curved->turned_over), 0));
  }
  const MeshStatistics& statistics = measured.statistics;
  if (options.min_dihedral > 0) {
    facts.push_back(at_least("theta_min", "smallest dihedral angle", statistics.theta_min,
                             options.min_dihedral));
  }
  if (options.max_dihedral < 180) {
    facts.push_back(
        at_most("theta_max", "largest dihedral angle", statistics.theta_max, options.max_dihedral));
  }
  if (preset != nullptr) {
    for (const auto& [name, wanted] : preset->rulers) {
      facts.push_back(threshold(name, wanted, *measured.rulers));
    }
    for (Fact& fact : fitness(preset->use, *measured.rulers)) facts.push_back(std::move(fact));
  }
  for (const auto& [name, wanted] : options.measure) {
    facts.push_back(threshold(name, wanted, *measured.rulers));
  }
  return facts;
}

std::vector<Fact> compare(const Mesh& first, const Mesh& second, int threads,
                          std::string_view name_of_preset, const Goal& goal,
                          std::string_view surface) {
  const Preset* const preset = find_preset(name_of_preset);
  Options run;
  run.surface = surface;
  const Scale scale = scale_of(first);
  scale_of(second);  // or an error
  MeshData own_before, own_after, numbered_after;
  const auto put_both_right = [&] {
    return std::pair(&put_right(first, own_before), &put_right(second, own_after));
  };
  const auto [right_before, right_after] = face::on_threads(threads, put_both_right);
  const MeshData& before = *right_before;
  const MeshData& after = numbered_as(before, *right_after, numbered_after);
  std::vector<Fact> facts = face::on_threads(
      threads, [&] { return same_surface(before, after, scale, tolerance_around(before, run)); });
  if (!before.other_elements.empty()) facts.push_back(same_shared_parts(before, after));
  const auto inverted_before = std::get<std::uint64_t>(no_inverted(before).value);
  facts.push_back(
      not_more_inverted(before, MeshAccess::data(first), after, MeshAccess::data(second)));
  const bool is_mended = std::get<std::uint64_t>(facts.back().value) < inverted_before;
  if (!before.mid_nodes.empty() || !after.mid_nodes.empty()) {
    const std::vector<Bits> nodes = fixed_mid_nodes(before);
    facts.push_back(same("mid_nodes", "mid-side nodes of edges that stay", nodes,
                         fixed_mid_nodes(after, &nodes)));
  }
  const Measurement then = measure(first, {.goal = goal, .threads = threads});
  const Measurement now = measure(second, {.goal = goal, .threads = threads});
  if (then.curved && now.curved) add_second_order(*then.curved, *now.curved, facts);
  const MeshStatistics& was = then.statistics;
  const MeshStatistics& is = now.statistics;
  for (Fact angle : {at_least("theta_min", "smallest dihedral angle", is.theta_min, was.theta_min),
                     at_most("theta_max", "largest dihedral angle", is.theta_max,
                             std::max(was.theta_max, goal.max_angle))}) {
    if (is_mended && !angle.holds) {
      angle.holds = true;
      angle.text += "; not asked for where inverted tets were mended, which goes first";
    }
    facts.push_back(std::move(angle));
  }
  facts.push_back(
      at_most("n_bad", "bad tets", static_cast<double>(is.n_bad), static_cast<double>(was.n_bad)));
  if (preset != nullptr) {
    for (Fact& fact : no_dearer(preset->use, then, now)) facts.push_back(std::move(fact));
  }
  return facts;
}

std::vector<CheckPreset> check_presets() {
  std::vector<CheckPreset> shown;
  for (const Preset& preset : presets()) shown.push_back(preset.shown);
  return shown;
}

}  // namespace tetmend
