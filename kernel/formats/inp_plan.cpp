// SPDX-License-Identifier: MIT
// What an Abaqus deck needs to know of a mesh before it is written.
#include "kernel/formats/inp_plan.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "kernel/formats/gmsh_entities.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {
namespace {

template <class Element>
InpKind kind_of(int vtk_type, int dimension, std::span<const Element> elements,
                const std::vector<Label>* parts, const std::vector<std::int64_t>* numbers) {
  constexpr std::size_t kStride = sizeof(Element) / sizeof(std::uint32_t);
  InpKind kind;
  kind.vtk_type = vtk_type;
  kind.dimension = dimension;
  kind.width = std::tuple_size_v<decltype(Element::vertices)>;
  kind.count = elements.size();
  kind.stride = kind.label_stride = kStride;
  if (kind.count > 0) {
    kind.vertices = elements[0].vertices.data();
    kind.labels = &elements[0].label;
  }
  kind.parts = parts;
  kind.given_numbers = numbers;
  kind.is_first_order = true;
  return kind;
}

struct SortedCorners {
  std::array<std::uint32_t, 3> sorted;
  bool is_odd = false;
  std::uint32_t kind = 0;
  std::uint32_t triangle = 0;
};

SortedCorners sorted_corners(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  SortedCorners result{{a, b, c}, false, 0, 0};
  auto& v = result.sorted;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (v[i] <= v[j]) return;
    std::swap(v[i], v[j]);
    result.is_odd = !result.is_odd;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return result;
}

}  // namespace

bool is_inp_name(std::string_view name) {
  UniqueNames none(inp_key);
  return inp_name(name, none) == name;
}

std::string inp_name(std::string_view name, UniqueNames& taken) {
  constexpr std::size_t kLongest = 70;
  std::string valid;
  for (const char c : name.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    valid += byte < 0x80 && (std::isalnum(byte) != 0 || c == '-') ? c : '_';
  }
  if (valid.empty() || std::isalpha(static_cast<unsigned char>(valid[0])) == 0)
    valid = "S_" + valid;
  return taken.make(valid);
}

InpPlan::InpPlan(const MeshView& mesh) : mesh_(mesh), data_(mesh.data()) {
  has_deck_ = data_ != nullptr && is_inp_deck(data_->deck);
  if (has_deck_) deck = unpack_deck(data_->deck);
  block_of_part_ = {deck.block_of_part.begin(), deck.block_of_part.end()};
  for (const InpPiece& piece : deck.pieces) {
    if (piece.kind != InpPieceKind::elements) continue;
    type_of_block_[piece.block] = inp_type(piece.type).vtk_type;
    home_of_block_[piece.block] = piece.groups;
    numbering_of_block_[piece.block] = piece.numbering;
    next_block_ = std::max(next_block_, piece.block);
  }
  if (data_ != nullptr) {
    for (const Group& group : data_->groups) {
      const std::size_t number = groups.size();
      groups.push_back({group.dimension, group.number,
                        group.name.empty() ? label_name(group.number) : group.name, &group});
      group_of_name_[{group.dimension, group.number}] = number;
      for (const Label part : group.parts) {
        groups_of_part_[{group.dimension, part}].push_back(number);
      }
      if (group.parts.empty() && group.members.empty()) {
        group_of_label_[{group.dimension, group.number}] = number;
      }
    }
  }
  add_kinds();
  find_owners();
  assign();
  number_points();
  number_elements();
  add_missing_sets();
}

void InpPlan::add_kinds() {
  std::span<const MeshData::Tet> tets;
  if (data_ != nullptr) {
    tets = data_->tets;
  } else {
    std::vector<MeshData::Tet> memory;
    own_tets_.reserve(mesh_.tet_count());
    for (std::size_t block = 0; block < mesh_.tet_blocks(); ++block) {
      const auto some = mesh_.tets(block, memory);
      own_tets_.insert(own_tets_.end(), some.begin(), some.end());
    }
    tets = own_tets_;
  }
  const auto* d = data_;
  kinds.push_back(
      kind_of(kVtkTet, 3, tets, d ? &d->tet_parts : nullptr, d ? &d->tet_numbers : nullptr));
  if (d != nullptr) {
    for (const OtherElements& others : d->other_elements) {
      const InpType type = inp_type(inp_type_name(others.vtk_type));
      if (others.labels.empty() || type.width != others.vertex_count) continue;
      InpKind kind;
      kind.vtk_type = others.vtk_type;
      kind.dimension = type.dimension;
      kind.width = kind.stride = others.vertex_count;
      kind.count = others.labels.size();
      kind.vertices = others.vertices.data();
      kind.labels = others.labels.data();
      kind.label_stride = 1;
      kind.parts = &others.parts;
      kind.given_numbers = &others.numbers;
      kinds.push_back(std::move(kind));
    }
  }
  kinds.push_back(kind_of(kVtkTriangle, 2, mesh_.triangles(), d ? &d->triangle_parts : nullptr,
                          d ? &d->triangle_numbers : nullptr));
  kinds.push_back(kind_of(kVtkEdge, 1, mesh_.edges(), d ? &d->edge_parts : nullptr,
                          d ? &d->edge_numbers : nullptr));
}

void InpPlan::find_owners() {
  std::vector<SortedCorners> wanted;
  std::vector<char> flags(mesh_.point_count());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (!kinds[k].is_triangle()) continue;
    owners_[k].resize(kinds[k].count);
    for (std::size_t i = 0; i < kinds[k].count; ++i) {
      const std::uint32_t* v = kinds[k].of(i);
      SortedCorners corners = sorted_corners(v[0], v[1], v[2]);
      corners.kind = static_cast<std::uint32_t>(k);
      corners.triangle = static_cast<std::uint32_t>(i);
      wanted.push_back(corners);
      for (std::size_t c = 0; c < 3; ++c) flags[v[c]] = 1;
    }
  }
  if (wanted.empty()) return;
  const auto less = [](const SortedCorners& a, const SortedCorners& b) {
    return a.sorted < b.sorted;
  };
  std::stable_sort(wanted.begin(), wanted.end(), less);
  // Triangles with the same corners share a place, by the sense that they list these in.
  std::vector<std::array<std::uint32_t, 3>> places;
  for (const SortedCorners& corners : wanted) {
    if (places.empty() || places.back() != corners.sorted) places.push_back(corners.sorted);
  }
  std::vector<std::array<Owner, 2>> found(places.size());
  const auto place_of = [&](const SortedCorners& corners) {
    const auto at = std::lower_bound(places.begin(), places.end(), corners.sorted);
    const bool is_there = at != places.end() && *at == corners.sorted;
    return is_there ? &found[static_cast<std::size_t>(at - places.begin())] : nullptr;
  };
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (!kinds[k].is_tet()) continue;
    for (std::size_t i = 0; i < kinds[k].count; ++i) {
      const std::uint32_t* v = kinds[k].of(i);
      if (flags[v[0]] + flags[v[1]] + flags[v[2]] + flags[v[3]] < 3) continue;
      for (int f = 0; f < 4; ++f) {
        const auto& c = kInpTetFaces[static_cast<std::size_t>(f)];
        if (flags[v[c[0]]] + flags[v[c[1]]] + flags[v[c[2]]] < 3) continue;
        // Turned round: seen from outside.
        const SortedCorners face = sorted_corners(v[c[0]], v[c[2]], v[c[1]]);
        std::array<Owner, 2>* place = place_of(face);
        if (place == nullptr) continue;
        for (const bool is_odd : {false, true}) {
          Owner& owner = (*place)[is_odd ? 1 : 0];
          if (owner.face == 0 || is_odd == face.is_odd) owner = {k, i, f + 1};
        }
      }
    }
  }
  for (const SortedCorners& corners : wanted) {
    owners_[corners.kind][corners.triangle] = (*place_of(corners))[corners.is_odd ? 1 : 0];
  }
}

void InpPlan::assign() {
  for (std::size_t k = 0; k < kinds.size(); ++k) assign_kind(k);
  if (!has_deck_) {
    deck.pieces.emplace_back().text = "*HEADING\nwritten by tetmend\n";
    InpPiece& nodes = deck.pieces.emplace_back();
    nodes.kind = InpPieceKind::nodes;
    nodes.text = "*NODE\n";
  }
  place_new(std::move(new_elements_));
}

void InpPlan::assign_kind(std::size_t k) {
  InpKind& kind = kinds[k];
  const GmshMembership membership(kind.is_first_order ? data_ : nullptr, kind.dimension,
                                  kind.count);
  const bool has_parts = kind.parts != nullptr && !kind.parts->empty();
  using Key = std::tuple<Label, Label, std::uint32_t, bool>;
  std::map<Key, std::size_t> known;
  Key last{};
  std::size_t last_class = SIZE_MAX;
  kind.class_of.resize(kind.count);
  for (std::size_t i = 0; i < kind.count; ++i) {
    const Label part = has_parts ? (*kind.parts)[i] : 0;
    bool is_face = false;
    if (kind.is_triangle()) {
      const auto block = block_of_part_.find(part);
      is_face =
          has_deck_ ? block == block_of_part_.end() || block->second == 0 : owners_[k][i].face != 0;
    }
    const Key key{part, kind.label(i), membership.set_of(i), is_face};
    if (last_class == SIZE_MAX || key != last) {
      last = key;
      const auto [at, is_new] = known.try_emplace(key, 0);
      if (is_new) {
        at->second =
            make_class(k, part, kind.label(i), membership.groups(membership.set_of(i)), is_face);
      }
      last_class = at->second;
    }
    kind.class_of[i] = static_cast<std::uint32_t>(last_class);
  }
  kind.by_class = group_by_key(kind.class_of, static_cast<std::uint32_t>(classes.size() + 1));
}

std::size_t InpPlan::make_class(std::size_t k, Label part, Label label,
                                const std::vector<Label>& members, bool is_face) {
  const InpKind& kind = kinds[k];
  InpClass made{k, 0, {}};
  const auto of_part = groups_of_part_.find({kind.dimension, part});
  if (of_part != groups_of_part_.end()) made.groups = of_part->second;
  for (const Label number : members) {
    const auto found = group_of_name_.find({kind.dimension, number});
    if (found != group_of_name_.end()) made.groups.push_back(found->second);
  }
  const auto of_label = group_of_label_.find({kind.dimension, label});
  if (of_label != group_of_label_.end()) made.groups.push_back(of_label->second);
  const bool has_label = std::any_of(made.groups.begin(), made.groups.end(),
                                     [&](std::size_t g) { return groups[g].number == label; });
  // Without a deck edges are sets of nodes: as elements they would need a section.
  const bool is_element = !is_face && (has_deck_ || kind.vtk_type != kVtkEdge);
  // Sections need sets, so elements of a new deck have one, whatever their label.
  const bool needs_set = made.groups.empty() && (!is_element || !has_deck_);
  if (!has_label && (label != 0 || needs_set)) {
    made.groups.push_back(label_group(kind.dimension, label));
  }
  std::sort(made.groups.begin(), made.groups.end());
  made.groups.erase(std::unique(made.groups.begin(), made.groups.end()), made.groups.end());
  if (is_element) made.block = block_for(kind, part, made.groups);
  classes.push_back(std::move(made));
  return classes.size() - 1;
}

std::size_t InpPlan::label_group(int dimension, Label label) {
  const auto [at, is_new] = group_of_label_.try_emplace({dimension, label}, groups.size());
  if (is_new) {
    // A group with this number may exist that not all with the label are in.
    constexpr int kApart = 10;
    const bool taken = group_of_name_.contains({dimension, label});
    const InpGroupName name{taken ? dimension + kApart : dimension, label};
    groups.push_back({name.dimension, label, label_name(label), nullptr});
    group_of_name_[name] = at->second;
  }
  return at->second;
}

Label InpPlan::block_for(const InpKind& kind, Label part, const std::vector<std::size_t>& in) {
  const auto found = block_of_part_.find(part);
  if (found != block_of_part_.end()) {
    const auto type = type_of_block_.find(found->second);
    if (type != type_of_block_.end() && type->second == kind.vtk_type) return found->second;
  }
  return new_block(kind.vtk_type, in);
}

Label InpPlan::new_block(int vtk_type, const std::vector<std::size_t>& in) {
  std::vector<std::size_t> home(in.begin(), in.begin() + (in.empty() ? 0 : 1));
  const auto [at, is_new] = new_blocks_.try_emplace({vtk_type, home}, 0);
  if (!is_new) return at->second;
  at->second = ++next_block_;
  InpPiece piece;
  piece.kind = InpPieceKind::elements;
  piece.block = at->second;
  piece.type = inp_type_name(vtk_type);
  piece.text = fmt::format("*ELEMENT, TYPE={}", piece.type);
  for (const std::size_t g : home) piece.groups.push_back({groups[g].dimension, groups[g].number});
  home_of_block_[piece.block] = piece.groups;
  type_of_block_[piece.block] = vtk_type;
  new_elements_.push_back(std::move(piece));
  return at->second;
}

/// Behind the last nodes and elements.
void InpPlan::place_new(std::vector<InpPiece> pieces) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < deck.pieces.size(); ++i) {
    const InpPieceKind kind = deck.pieces[i].kind;
    if (kind == InpPieceKind::nodes || kind == InpPieceKind::elements) at = i + 1;
  }
  deck.pieces.insert(deck.pieces.begin() + static_cast<std::ptrdiff_t>(at),
                     std::make_move_iterator(pieces.begin()),
                     std::make_move_iterator(pieces.end()));
}

}  // namespace tetmend::formats
