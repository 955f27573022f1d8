// SPDX-License-Identifier: MIT
// Writes keyword files of LS-DYNA, and around the mesh the rest of the deck.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/included_path.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/lsdyna.h"
#include "kernel/formats/lsdyna_fields.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/output_rows.h"

namespace tetmend::formats {
namespace {

constexpr std::size_t kFieldsOfCard = 8;  // of sets

constexpr std::array<std::int64_t, 3> kNumberLimits = {99'999'999, INT32_MAX, INT64_MAX};

constexpr Label kMostPart = 99999999;  // what a field of eight characters holds

bool is_solid(const ElementList& list) {
  return list.kind.vtk_type == vtk_tet10 || lsdyna_order(list.kind.vtk_type) != nullptr;
}

class LsDynaWriter {
 public:
  LsDynaWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file),
        mesh_(mesh),
        lists_(mesh),
        points_(written_point_numbers(mesh, kNumberLimits)),
        elements_(written_element_numbers(lists_, kNumberLimits)),
        members_(members_of_groups(mesh, lists_)) {
    for (const std::int64_t number : points_) most_ = std::max(most_, number);
    for (const std::vector<std::int64_t>& numbers : elements_) {
      for (const std::int64_t number : numbers) most_ = std::max(most_, number);
    }
    const MeshData* data = mesh.data();
    if (data == nullptr || data->variant != kLsDyna || data->deck.size() < kLsDynaPieces) return;
    deck_ = &data->deck;
    const std::string& widths = (*deck_)[lsdyna_fields];
    const char* end = widths.data() + widths.size();
    const char* next = std::from_chars(widths.data(), end, widths_.integer).ptr;
    if (next != end) std::from_chars(next + 1, end, widths_.real);
    if (widths_.real == kLsDynaLong.real) widths_ = kLsDynaLong;
    for (std::size_t g = 0; g < members_.size(); ++g) {
      const Group& group = data->groups[g];
      group_of_.try_emplace({group.dimension, group.number}, g);
    }
  }

  void write() {
    number_parts();
    if (deck_ == nullptr) {
      write_new();
    } else {
      for (const std::string& piece : *deck_) {
        if (piece.starts_with(lsdyna_point)) keep_point(std::string_view(piece).substr(1));
      }
      for (std::size_t i = kLsDynaPieces; i < deck_->size(); ++i) write_piece((*deck_)[i]);
    }
    out_.commit(mesh_.companions());
  }

 private:
  void keep_point(std::string_view text) {
    const std::size_t line = text.find('\n') + 1;
    std::int64_t number = 0;
    if (nastran_integer(text.substr(0, line - 1), number)) {
      points_of_deck_.emplace(number, text.substr(line));
    }
  }

  void write_piece(const std::string& piece) {
    const std::string_view text = std::string_view(piece).substr(1);
    switch (piece[0]) {
      case lsdyna_text:
        out_.put(text);
        break;
      case lsdyna_nodes:
        write_nodes(text);
        break;
      case lsdyna_elements:
        write_solids(text);
        break;
      case lsdyna_set:
        write_set(text, 3);
        break;
      case lsdyna_node_set:
        write_set(text, 0);
        break;
      case lsdyna_segment_set:
        write_set(text, 2);
        break;
      default:
        break;
    }
  }

  /// Do all numbers of the mesh fit?
  bool fits(std::size_t width) const { return fmt::format_int(most_).size() <= width; }

  void write_nodes(std::string_view comments) {
    out_.put("*NODE\n");
    out_.put(comments);
    put_rows(out_, mesh_.point_count(), [this](std::size_t i, OutputBuffer& buffer) {
      const auto whole = points_of_deck_.find(points_[i]);
      if (whole != points_of_deck_.end()) return buffer.put(whole->second);
      LsDynaLine line{buffer, !fits(widths_.integer)};
      line.put(points_[i], widths_.integer);
      for (int axis = 0; axis < 3; ++axis) {
        line.put(lsdyna_real(mesh_.point(i)[axis], widths_.real), widths_.real);
      }
      line.end();
    });
  }

  /// First those on one line, then those of ten nodes, which have two. Where there is none, the keyword
  /// alone: a deck without it is no mesh.
  void write_solids(std::string_view comments) {
    const auto is_of = [](const ElementList& list, bool has_two) {
      return is_solid(list) && (list.kind.vtk_type == vtk_tet10) == has_two;
    };
    const auto is_there = [&](bool has_two) {
      const auto& all = lists_.all();
      return std::any_of(all.begin(), all.end(), [&](const auto& l) { return is_of(l, has_two); });
    };
    for (const bool has_two : {false, true}) {
      if (!is_there(has_two) && (has_two || is_there(true))) continue;
      out_.put("*ELEMENT_SOLID\n");
      out_.put(std::exchange(comments, {}));
      for (std::size_t k = 0; k < lists_.all().size(); ++k) {
        const ElementList& list = lists_.all()[k];
        if (!is_of(list, has_two)) continue;
        put_rows(out_, list.count,
                 [&](std::size_t i, OutputBuffer& buffer) { put_solid(buffer, k, i); });
      }
    }
  }

  void put_solid(OutputBuffer& buffer, std::size_t k, std::size_t i) const {
    const ElementList& list = lists_.all()[k];
    LsDynaLine line{buffer, !fits(widths_.integer)};
    line.put(elements_[k][i], widths_.integer);
    line.put(part_of_.at(list.label(i)), widths_.integer);
    const std::uint8_t* order = lsdyna_order(list.kind.vtk_type);
    if (order == nullptr) line.end();
    const std::size_t nodes = order == nullptr ? list.kind.width : kLsDynaNodesOfSolid;
    for (std::size_t n = 0; n < nodes; ++n) {
      line.put(points_[list.vertices(i)[order == nullptr ? n : order[n]]], widths_.integer);
    }
    line.end();
  }

  /// Eight a line.
  template <class Number>
  void put_members(std::size_t count, std::size_t width, const Number& number) {
    put_rows(out_, (count + kFieldsOfCard - 1) / kFieldsOfCard,
             [&](std::size_t row, OutputBuffer& buffer) {
               const std::size_t end = std::min(count, (row + 1) * kFieldsOfCard);
               LsDynaLine line{buffer, !fits(width)};
               for (std::size_t i = row * kFieldsOfCard; i < end; ++i) {
                 line.put(number(i), width);
               }
               line.end();
             });
  }

  void put_solids_of(const GroupMembers& members, std::size_t width) {
    put_members(members.elements.size(), width, [&](std::size_t i) {
      return elements_[members.elements[i].list][members.elements[i].index];
    });
  }

  void put_nodes_of(const GroupMembers& members, std::size_t width) {
    put_members(members.points.size(), width,
                [&](std::size_t i) { return points_[members.points[i]]; });
  }

  void put_segments_of(const std::vector<GroupMembers::Member>& members, std::size_t width) {
    put_rows(out_, members.size(), [&](std::size_t i, OutputBuffer& buffer) {
      const ElementList& list = lists_.all()[members[i].list];
      const auto v = list.vertices(members[i].index).first(list.kind.corners);
      LsDynaLine line{buffer, !fits(width)};
      for (std::size_t n = 0; n < 4; ++n) {
        line.put(points_[v[std::min(n, v.size() - 1)]], width);
      }
      line.end();
    });
  }

  /// @param text  the number of the group, a line break, the lines before the members
  void write_set(std::string_view text, int dimension) {
    Label number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    const std::string_view lines = text.substr(text.find('\n') + 1);
    out_.put(lines);
    const std::size_t width = lsdyna_widths(lines.substr(0, lines.find('\n')), widths_).card;
    const auto found = group_of_.find({dimension, number});
    if (found == group_of_.end()) return;
    if (dimension == 0) put_nodes_of(members_[found->second], width);
    if (dimension == 2) put_segments_of(members_[found->second].elements, width);
    if (dimension == 3) put_solids_of(members_[found->second], width);
  }

  // ---- A mesh of another format -------------------------------------------------------------------

  /// Parts count from 1 and have eight digits at most: other labels get the next numbers.
  void number_parts() {
    std::set<Label> labels;
    for (const ElementList& list : lists_.all()) {
      for (std::size_t i = 0; i < list.count && is_solid(list); ++i) labels.insert(list.label(i));
    }
    Label next = 0;
    for (const Label label : labels) {
      if (label > 0 && label <= kMostPart) {
        part_of_[label] = label;
        continue;
      }
      do {
        ++next;
      } while (labels.contains(next));
      part_of_[label] = next;
    }
  }

  static std::string title(std::string name) {
    for (char& c : name) {
      if (static_cast<unsigned char>(c) < ' ') c = '_';
    }
    if (!is_lsdyna_name(name)) name.insert(0, 1, '_');
    return name;
  }

  void write_new() {
    out_.put("*KEYWORD\n");
    std::set<const Group*> named;  // as parts
    if (mesh_.data() != nullptr) {
      for (const auto& [label, group] : LabelNames(*mesh_.data()).named(3)) {
        if (!part_of_.contains(label)) continue;
        named.insert(group);
        out_.put(fmt::format("*PART\n{}\n{:>10}{:>10}{:>10}\n", title(group->name),
                             part_of_.at(label), 0, 0));
      }
    }
    write_nodes({});
    write_solids({});
    write_sets(named);
    write_segments();
    out_.put("*END\n");
  }

  void write_sets(const std::set<const Group*>& named) {
    std::array<std::int64_t, 4> next{};
    for (std::size_t g = 0; g < members_.size(); ++g) {
      const Group& group = mesh_.data()->groups[g];
      if (group.name.empty() || named.contains(&group)) continue;
      const std::int64_t number = ++next[static_cast<std::size_t>(group.dimension)];
      if (group.dimension == 3) {
        out_.put(fmt::format("*SET_SOLID_TITLE\n{}\n{:>10}\n", title(group.name), number));
        put_solids_of(members_[g], widths_.card);
      } else if (group.dimension == 0) {
        out_.put(fmt::format("*SET_NODE_LIST_TITLE\n{}\n{:>10}\n", title(group.name), number));
        put_nodes_of(members_[g], widths_.card);
      }
    }
  }

  /// One for each label of triangles and quadrilaterals; further ones for groups that are no label.
  void write_segments() {
    std::map<Label, std::vector<GroupMembers::Member>> of_label;
    for (std::uint32_t k = 0; k < lists_.all().size(); ++k) {
      const ElementList& list = lists_.all()[k];
      for (std::uint32_t i = 0; i < list.count && list.kind.dimension == 2; ++i) {
        of_label[list.label(i)].push_back({k, i});
      }
    }
    std::map<Label, const Group*> names;
    if (mesh_.data() != nullptr) names = LabelNames(*mesh_.data()).named(2);
    std::set<const Group*> written;
    std::int64_t most = 0;
    for (const auto& [label, members] : of_label) most = std::max<std::int64_t>(most, label);
    for (const auto& [label, members] : of_label) {
      const auto name = names.find(label);
      if (name != names.end()) written.insert(name->second);
      put_segments(label > 0 ? label : ++most,
                   name == names.end() ? std::string() : name->second->name, members);
    }
    for (std::size_t g = 0; g < members_.size(); ++g) {
      const Group& group = mesh_.data()->groups[g];
      if (group.dimension != 2 || group.name.empty() || written.contains(&group)) continue;
      put_segments(++most, group.name, members_[g].elements);
    }
  }

  void put_segments(std::int64_t number, const std::string& name,
                    const std::vector<GroupMembers::Member>& members) {
    out_.put(name.empty() ? "*SET_SEGMENT\n"
                          : fmt::format("*SET_SEGMENT_TITLE\n{}\n", title(name)));
    out_.put(fmt::format("{:>10}\n", number));
    put_segments_of(members, widths_.card);
  }

  OutputFile out_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::vector<std::int64_t> points_;                 // their numbers
  std::vector<std::vector<std::int64_t>> elements_;  // of each list
  std::vector<GroupMembers> members_;
  std::int64_t most_ = 0;                           // number of a point or an element
  const std::vector<std::string>* deck_ = nullptr;  // null: not ours
  LsDynaWidths widths_;
  std::map<std::int64_t, std::string> points_of_deck_;     // word for word
  std::map<Label, Label> part_of_;                         // by label
  std::map<std::pair<int, Label>, std::size_t> group_of_;  // by dimension and number
};

}  // namespace

bool is_lsdyna_name(std::string_view name) {
  constexpr std::size_t kMost = 80;
  return !name.empty() && name.size() <= kMost && name[0] != '*' && name[0] != '$' &&
         name.front() != ' ' && name.back() != ' ' &&
         std::none_of(name.begin(), name.end(),
                      [](char c) { return static_cast<unsigned char>(c) < ' '; });
}

void write_lsdyna(const std::filesystem::path& file, const MeshView& mesh) {
  LsDynaWriter(file, mesh).write();
}

std::vector<std::string> not_in_lsdyna(const std::filesystem::path& file, const MeshData& mesh) {
  const bool has_deck = mesh.variant == kLsDyna && mesh.deck.size() >= kLsDynaPieces;
  const std::size_t room =
      has_deck && mesh.deck[lsdyna_fields].ends_with("20") ? 20 : LsDynaWidths().real;
  std::size_t rounded = 0;
  for (const Point& point : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) rounded += lsdyna_rounds(point[axis], room) ? 1 : 0;
  }
  std::vector<std::string> notes;
  if (rounded > 0) {
    notes.push_back(fmt::format(
        "{} coordinates are rounded to {} characters, which is what LS-DYNA reads", rounded, room));
  }
  const auto too_long = std::count_if(mesh.tets.begin(), mesh.tets.end(),
                                      [](const MeshData::Tet& t) { return t.label > kMostPart; });
  if (too_long > 0) {
    notes.push_back(fmt::format(
        "{} labels have more than eight digits: their parts get other numbers", too_long));
  }
  if (!has_deck) return notes;
  for (std::string& note : included_files_stay(file, mesh.deck[lsdyna_folder], "*INCLUDE")) {
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace tetmend::formats
