// SPDX-License-Identifier: MIT
// Which points of an Abaqus deck must be kept, and who says so.
#include "kernel/formats/inp_pins.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/pin_remarks.h"
#include "kernel/grouping.h"

namespace tetmend::formats {
namespace {

template <class Visit>
void for_tets(const InpMesh& mesh, const Visit& visit) {
  for (const InpElements& block : mesh.blocks) {
    if (block.type.vtk_type != kVtkTet && block.type.vtk_type != kVtkTet10) continue;
    for (std::size_t i = 0; i < block.count; ++i) {
      visit(block.vertices.data() + i * block.type.width, block.type.width,
            static_cast<std::uint32_t>(block.first + i));
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
    for_tets(mesh, [&](const std::uint32_t* v, std::size_t width, std::uint32_t) {
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
  for_tets(mesh, [&](const std::uint32_t* v, std::size_t width, std::uint32_t) {
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

/// Takes away the marks of points on faces that stay as they are: of one tet, between two parts, or
/// named.
class Unmarking {
 public:
  Unmarking(const InpMesh& mesh, std::vector<char>& marks) : mesh_(mesh), marks_(marks) {}

  void run(const InpFaces& named, std::span<const std::uint32_t> part_of) {
    std::vector<char> stays(marks_.size(), 1);  // or in no tet
    for_tets(mesh_, [&](const std::uint32_t* v, std::size_t width, std::uint32_t element) {
      for (std::size_t k = 0; k < width; ++k) stays[v[k]] = 0;
      if (std::any_of(v, v + width, [&](std::uint32_t i) { return marks_[i] != 0; })) {
        add_faces(v, width, part_of[element]);
      }
    });
    for (const InpFace& face : named.faces) add({face.corners, {kNone, kNone, kNone}, kNone});
    std::sort(faces_.begin(), faces_.end(),
              [](const Face& a, const Face& b) { return a.corners < b.corners; });
    for (std::size_t i = 0; i < faces_.size();) {
      std::size_t end = i + 1;
      while (end < faces_.size() && faces_[end].corners == faces_[i].corners) ++end;
      // Of a face whose other tet has no mark, none of its own points has.
      const bool is_free = end == i + 2 && faces_[i].part == faces_[i + 1].part;
      for (; i < end; ++i) {
        if (is_free) continue;
        for (const std::uint32_t v : faces_[i].corners) stays[v] = 1;
        for (const std::uint32_t v : faces_[i].middles) {
          if (v != kNone) stays[v] = 1;
        }
      }
    }
    for (std::size_t v = 0; v < marks_.size(); ++v) marks_[v] = marks_[v] != 0 && stays[v] == 0;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  struct Face {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint32_t, 3> middles;
    std::uint32_t part;
  };

  void add_faces(const std::uint32_t* v, std::size_t width, std::uint32_t part) {
    // The middle of each edge of a tet of second order.
    constexpr std::array<std::array<std::size_t, 4>, 4> kMiddle = {
        {{0, 4, 6, 7}, {4, 0, 5, 8}, {6, 5, 0, 9}, {7, 8, 9, 0}}};
    for (const auto& c : kInpTetFaces) {
      Face face{{v[c[0]], v[c[1]], v[c[2]]}, {kNone, kNone, kNone}, part};
      if (width > 4)
        face.middles = {v[kMiddle[c[0]][c[1]]], v[kMiddle[c[1]][c[2]]], v[kMiddle[c[2]][c[0]]]};
      add(face);
    }
  }

  /// Faces without a mark are of no account.
  void add(Face face) {
    const auto is_marked = [&](std::uint32_t v) { return v != kNone && marks_[v] != 0; };
    if (face.part != kNone && std::none_of(face.corners.begin(), face.corners.end(), is_marked) &&
        std::none_of(face.middles.begin(), face.middles.end(), is_marked)) {
      return;
    }
    std::sort(face.corners.begin(), face.corners.end());
    faces_.push_back(face);
  }

  const InpMesh& mesh_;
  std::vector<char>& marks_;
  std::vector<Face> faces_;
};

/// Says who keeps how many points, in the order of the deck.
class Remarks {
 public:
  Remarks(const InpLines& lines, const std::vector<char>& marks) : marks_(marks) {
    for (const InpBlock& block : lines.blocks) places_.emplace(&block, places_.size());
  }

  void add_keywords(const InpReferences& references) {
    struct Pins {
      const InpBlock* first;
      std::set<const InpBlock*> blocks;
      std::vector<std::uint32_t> points;
    };
    std::map<std::string_view, Pins> pins;
    for (const InpReference& each : references.points) {
      if (marks_[each.point] == 0) continue;
      Pins& of = pins.try_emplace(each.block->keyword, Pins{each.block, {}, {}}).first->second;
      if (places_.at(each.block) < places_.at(of.first)) of.first = each.block;
      of.blocks.insert(each.block);
      of.points.push_back(each.point);
    }
    for (auto& [keyword, of] : pins) {
      std::sort(of.points.begin(), of.points.end());
      of.points.erase(std::unique(of.points.begin(), of.points.end()), of.points.end());
      const bool is_known = inp_knows_nodes_of(*of.first);
      add(*of.first, of.blocks.size(),
          fmt::format("*{}{}", keyword, is_known ? "" : ", whose fields are not known,"),
          of.points.size());
    }
  }

  void add_sets(const InpLines& lines, InpSets& sets, const InpReferences& references) {
    std::vector<char> named(marks_.size(), 0);
    for (const InpReference& each : references.points) named[each.point] = 1;
    std::set<const InpSet*> done;
    for (const InpBlock& block : lines.blocks) {
      const bool has_nodes =
          is_mesh_block(block, "NODE") || (block.keyword == "NSET" && is_set_block(block));
      const InpSet* set = has_nodes ? sets.of_block(block) : nullptr;
      if (set == nullptr || !done.insert(set).second) continue;
      std::size_t count = 0;
      for (const std::uint32_t v : set->members) {
        if (marks_[v] == 0 || named[v] != 0) continue;
        named[v] = 1;  // the first set says it
        ++count;
      }
      if (count > 0) add(block, 1, fmt::format("the set of nodes {}", in_quotes(set->name)), count);
    }
  }

  std::string text() {
    std::sort(remarks_.begin(), remarks_.end(),
              [](const Remark& a, const Remark& b) { return a.first < b.first; });
    std::vector<PinRemark> in_order;
    for (Remark& each : remarks_) in_order.push_back(std::move(each.second));
    return pin_remarks_text(in_order, "lines");
  }

 private:
  using Remark = std::pair<std::size_t, PinRemark>;  // place in the deck
  void add(const InpBlock& block, std::size_t blocks, std::string who, std::size_t count) {
    remarks_.push_back(
        {places_.at(&block), {block.file, block.begin, blocks, std::move(who), count}});
  }

  const std::vector<char>& marks_;
  std::map<const InpBlock*, std::size_t> places_;  // in the deck
  std::vector<Remark> remarks_;
};

}  // namespace

InpPins find_pins(const InpLines& lines, const InpMesh& mesh, InpSets& sets, const InpFaces& faces,
                  const InpReferences& references, std::span<const std::uint32_t> part_of) {
  std::vector<char> marks(mesh.points.size());
  std::vector<const InpSet*> of_nodes;
  for (const InpSet& set : sets.all) {
    if (set.of_nodes && set.members.size() < mesh.points.size()) of_nodes.push_back(&set);
  }
  mark_members_of_small_sets(mesh, of_nodes, marks);
  mark_single_members(mesh, of_nodes, marks);
  for (const InpSet& set : sets.all) {
    if (!set.is_unsorted) continue;
    for (const std::uint32_t v : set.members) marks[v] = 1;
  }
  for (const InpReference& each : references.points) marks[each.point] = 1;
  if (std::find(marks.begin(), marks.end(), 1) == marks.end()) return {};
  Unmarking(mesh, marks).run(faces, part_of);
  InpPins pins;
  for (std::uint32_t v = 0; v < marks.size(); ++v) {
    if (marks[v] != 0) pins.points.push_back(v);
  }
  if (pins.points.empty()) return pins;
  Remarks remarks(lines, marks);
  remarks.add_keywords(references);
  remarks.add_sets(lines, sets, references);
  pins.remarks = remarks.text();
  return pins;
}

}  // namespace tetmend::formats
