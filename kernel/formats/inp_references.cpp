// SPDX-License-Identifier: MIT
// What the lines of an Abaqus deck that are kept word for word say of its mesh.
#include "kernel/formats/inp_references.h"

#include <algorithm>
#include <array>
#include <span>

#include "kernel/grouping.h"

namespace tetmend::formats {
namespace {

// Their data lines hold no numbers of nodes.
constexpr std::array<std::string_view, 30> kWithoutNodes = {"AMPLITUDE",
                                                            "BUCKLE",
                                                            "CONDUCTIVITY",
                                                            "CONTROLS",
                                                            "COUPLED TEMPERATURE-DISPLACEMENT",
                                                            "CREEP",
                                                            "CYCLIC HARDENING",
                                                            "DAMPING",
                                                            "DENSITY",
                                                            "DEPVAR",
                                                            "DYNAMIC",
                                                            "ELASTIC",
                                                            "EL FILE",
                                                            "EL PRINT",
                                                            "ELEMENT OUTPUT",
                                                            "EXPANSION",
                                                            "FREQUENCY",
                                                            "FRICTION",
                                                            "HEADING",
                                                            "HEAT TRANSFER",
                                                            "HYPERELASTIC",
                                                            "INSTANCE",
                                                            "MATERIAL",
                                                            "NODE FILE",
                                                            "PHYSICAL CONSTANTS",
                                                            "PLASTIC",
                                                            "SOLID SECTION",
                                                            "SPECIFIC HEAT",
                                                            "STATIC",
                                                            "VISCO"};
// Only the first field of theirs does.
constexpr std::array<std::string_view, 7> kFirstOnly = {
    "BOUNDARY", "CLOAD", "CFLUX", "INITIAL CONDITIONS", "TEMPERATURE", "SPRING", "DASHPOT"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view word) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

class Finder {
 public:
  explicit Finder(const InpMesh& mesh) : mesh_(mesh) {}

  void look_at(const InpBlock& block) {
    for (const InpBlock::Parameter& parameter : block.parameters) {
      const bool names_node = parameter.name.find("NODE") != std::string::npos;
      look_at(parameter.value, names_node);
    }
    if (block.keyword.empty() || block.keyword == "HEADING" || block.keyword == "INCLUDE") return;
    const bool first_only = contains(kFirstOnly, block.keyword);
    const bool is_element = block.keyword == "ELEMENT";
    bool nodes = !contains(kWithoutNodes, block.keyword) && !block.is_in_assembly;
    // In an assembly only what is joined to the instance names nodes of the part.
    nodes = nodes || (block.is_in_assembly && block.keyword != "NODE" && block.keyword != "NSET" &&
                      block.keyword != "INSTANCE" && block.keyword != "ELSET" && !is_element);
    InpFields fields(block);
    while (fields.next_line()) {
      for (std::size_t i = 0; fields.more(); ++i) {
        const bool may_be_node = nodes && (!first_only || i == 0) && !(is_element && i == 0);
        look_at(fields.field(), may_be_node);
      }
    }
  }

  InpReferences take() {
    auto& points = result_.points;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return std::move(result_);
  }

 private:
  void look_at(std::string_view text, bool may_be_node) {
    if (text.empty()) return;
    const std::size_t dot = text.rfind('.');
    const bool has_instance = dot != std::string_view::npos && (text[0] < '0' || text[0] > '9') &&
                              text[0] != '-' && text[0] != '+' && text[0] != '.';
    const std::string_view last = has_instance ? text.substr(dot + 1) : text;
    std::int64_t number = 0;
    if (to_integer(last, number)) {
      const std::uint32_t place = mesh_.nodes.find(number);
      if (may_be_node && place != InpNumbers::kNone) result_.points.push_back(place);
      return;
    }
    const char c = text[0];
    if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.') return;
    result_.names.insert(inp_key(text));
    if (has_instance) result_.names.insert(inp_key(last));
  }

  const InpMesh& mesh_;
  InpReferences result_;
};

template <class Visit>
void for_tets(const InpMesh& mesh, const Visit& visit) {
  for (const InpElements& block : mesh.blocks) {
    if (block.type.vtk_type != kVtkTet && block.type.vtk_type != kVtkTet10) continue;
    for (std::size_t i = 0; i < block.count; ++i) {
      visit(block.vertices.data() + i * block.type.width, block.type.width);
    }
  }
}

/// Marks members of a set that are in no tet which the set holds wholly. 64 sets at a time.
void mark_single_members(const InpMesh& mesh, const std::vector<const InpSet*>& sets,
                         std::vector<char>& marks) {
  constexpr std::size_t kAtOnce = 64;
  std::vector<std::uint64_t> held(mesh.points.size());
  for (std::size_t first = 0; first < sets.size(); first += kAtOnce) {
    const std::size_t last = std::min(sets.size(), first + kAtOnce);
    std::fill(held.begin(), held.end(), 0);
    for (std::size_t k = first; k < last; ++k) {
      for (const std::uint32_t v : sets[k]->members) held[v] |= std::uint64_t{1} << (k - first);
    }
    std::vector<std::uint64_t> covered(held.size());
    for_tets(mesh, [&](const std::uint32_t* v, std::size_t width) {
      std::uint64_t all = ~std::uint64_t{0};
      for (std::size_t k = 0; k < 4; ++k) all &= held[v[k]];
      for (std::size_t k = 0; k < width; ++k) covered[v[k]] |= all;
    });
    for (std::size_t v = 0; v < held.size(); ++v) {
      if ((held[v] & ~covered[v]) != 0) marks[v] = 1;
    }
  }
}

/// Does what mark_single_members() does for the sets of few points, and drops these: each looks at
/// the tets at its points alone. Of the corners of a tet the one in the fewest tets has it.
void mark_members_of_small_sets(const InpMesh& mesh, std::vector<const InpSet*>& sets,
                                std::vector<char>& marks) {
  constexpr std::size_t kFew = 64;  // times as many points has the mesh, at least
  const auto is_large = [&](const InpSet* set) {
    return kFew * set->members.size() > mesh.points.size();
  };
  const auto small = std::stable_partition(sets.begin(), sets.end(), is_large);
  if (small == sets.end()) return;
  std::vector<std::uint32_t> tets_at(mesh.points.size());
  std::vector<std::span<const std::uint32_t>> tets;
  for_tets(mesh, [&](const std::uint32_t* v, std::size_t width) {
    tets.emplace_back(v, width);
    for (std::size_t k = 0; k < 4; ++k) ++tets_at[v[k]];
  });
  std::vector<std::uint32_t> owners;
  for (const auto v : tets) {
    owners.push_back(*std::min_element(v.begin(), v.begin() + 4,
                                       [&](auto a, auto b) { return tets_at[a] < tets_at[b]; }));
  }
  const Grouping of_owner = group_by_key(owners, static_cast<std::uint32_t>(mesh.points.size()));
  std::vector<std::uint32_t> held(mesh.points.size());
  std::vector<std::uint32_t> covered(mesh.points.size());
  std::uint32_t number = 0;
  for (auto set = small; set != sets.end(); ++set) {
    ++number;
    const auto& members = (*set)->members;
    for (const std::uint32_t v : members) held[v] = number;
    for (const std::uint32_t v : members) {
      for (const std::uint32_t t : of_owner.group(v)) {
        const auto is_held = [&](std::uint32_t corner) { return held[corner] == number; };
        if (!std::all_of(tets[t].begin(), tets[t].begin() + 4, is_held)) continue;
        for (const std::uint32_t node : tets[t]) covered[node] = number;
      }
    }
    for (const std::uint32_t v : members) {
      if (covered[v] != number) marks[v] = 1;
    }
  }
  sets.erase(small, sets.end());
}

/// Takes away the marks of points on the surface of the tets, which stays as it is.
void unmark_surface(const InpMesh& mesh, std::vector<char>& marks) {
  struct Face {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint32_t, 3> middles;
  };
  constexpr std::uint32_t kNone = UINT32_MAX;
  // The middle of each edge of a tet of second order.
  constexpr std::array<std::array<std::size_t, 4>, 4> kMiddle = {
      {{0, 4, 6, 7}, {4, 0, 5, 8}, {6, 5, 0, 9}, {7, 8, 9, 0}}};
  std::vector<Face> faces;
  std::vector<char> on_surface(mesh.points.size(), 1);  // or in no tet
  for_tets(mesh, [&](const std::uint32_t* v, std::size_t width) {
    for (std::size_t k = 0; k < width; ++k) on_surface[v[k]] = 0;
    if (std::none_of(v, v + width, [&](std::uint32_t i) { return marks[i] != 0; })) return;
    for (const auto& c : kInpTetFaces) {
      Face face{{v[c[0]], v[c[1]], v[c[2]]}, {kNone, kNone, kNone}};
      std::sort(face.corners.begin(), face.corners.end());
      if (width > 4)
        face.middles = {v[kMiddle[c[0]][c[1]]], v[kMiddle[c[1]][c[2]]], v[kMiddle[c[2]][c[0]]]};
      faces.push_back(face);
    }
  });
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.corners < b.corners; });
  // A face whose other tet has no mark was listed once as well: but then none of its own points has.
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool twice = (i > 0 && faces[i - 1].corners == faces[i].corners) ||
                       (i + 1 < faces.size() && faces[i + 1].corners == faces[i].corners);
    const auto marked = [&](std::uint32_t v) { return v != kNone && marks[v] != 0; };
    const Face& face = faces[i];
    if (twice || !(std::any_of(face.corners.begin(), face.corners.end(), marked) ||
                   std::any_of(face.middles.begin(), face.middles.end(), marked))) {
      continue;
    }
    for (const std::uint32_t v : face.corners) on_surface[v] = 1;
    for (const std::uint32_t v : face.middles) {
      if (v != kNone) on_surface[v] = 1;
    }
  }
  for (std::size_t v = 0; v < marks.size(); ++v) marks[v] = marks[v] != 0 && on_surface[v] == 0;
}

}  // namespace

InpReferences find_references(const std::vector<const InpBlock*>& kept, const InpMesh& mesh) {
  Finder finder(mesh);
  for (const InpBlock* block : kept) finder.look_at(*block);
  return finder.take();
}

std::vector<std::uint32_t> points_to_keep(const InpMesh& mesh, const InpSets& sets,
                                          const std::vector<std::uint32_t>& points) {
  std::vector<char> marks(mesh.points.size());
  std::vector<const InpSet*> of_nodes;
  for (const InpSet& set : sets.all) {
    if (set.of_nodes && set.members.size() < mesh.points.size()) of_nodes.push_back(&set);
  }
  mark_members_of_small_sets(mesh, of_nodes, marks);
  mark_single_members(mesh, of_nodes, marks);
  for (const std::uint32_t v : points) marks[v] = 1;
  if (std::find(marks.begin(), marks.end(), 1) == marks.end()) return {};
  unmark_surface(mesh, marks);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t v = 0; v < marks.size(); ++v) {
    if (marks[v] != 0) kept.push_back(v);
  }
  return kept;
}

}  // namespace tetmend::formats
