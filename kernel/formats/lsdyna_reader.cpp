// SPDX-License-Identifier: MIT
// Reads keyword files of LS-DYNA: with nodes and solids at hand, all that names them.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/harmless_notes.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/lsdyna.h"
#include "kernel/formats/lsdyna_mesh.h"
#include "kernel/formats/lsdyna_nodes.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {
namespace {

class LsDynaReader : LsDynaMesh {
 public:
  LsDynaReader(const std::filesystem::path& deck, TetPlace* question)
      : LsDynaMesh(deck, question), path_(deck), solid_count_(elements_.size()) {}

  MeshData read() {
    if (std::none_of(blocks_.begin(), blocks_.end(), [](const LsDynaBlock& block) {
          return block.keyword == "END" && block.inclusion == 0;
        })) {
      mesh_.notes.emplace_back("the deck has no *END: is the file complete?");
    }
    for (const std::string& reason : unread_) {
      mesh_.notes.push_back(fmt::format(
          "what *INCLUDE names is not read, so what it says of nodes is not known: {}", reason));
    }
    mesh_.deck.resize(kLsDynaPieces);
    mesh_.deck[lsdyna_fields] = fmt::format("{} {}", widths_.integer, widths_.real);
    for (const LsDynaBlock& block : blocks_) read_block(block);
    name_parts();
    finish_sets();
    mesh_.deck[lsdyna_remarks] = pins_.require_points(files_.all(), nodes_, "keywords", mesh_);
    for (std::string& line : points_of_deck_)
      mesh_.deck.push_back(char{lsdyna_point} + std::move(line));
    mesh_.variant = kLsDyna;
    return std::move(mesh_);
  }

 private:
  // ---- All else -----------------------------------------------------------------------------------

  void keep(std::string_view text) {
    if (text.empty() || !is_written_) return;
    if (mesh_.deck.size() <= kLsDynaPieces || mesh_.deck.back()[0] != lsdyna_text) {
      mesh_.deck.emplace_back(1, lsdyna_text);
    }
    mesh_.deck.back() += lines_of(text);
  }

  void read_block(const LsDynaBlock& block) {
    use(block);
    is_written_ = is_inlined(block.inclusion);
    const std::string_view whole(block.begin, static_cast<std::size_t>(block.end - block.begin));
    const std::string& keyword = block.keyword;
    if (is_nodes(block)) return place(block, lsdyna_nodes, nodes_at_);
    if (is_solids(block)) return place(block, lsdyna_elements, solids_at_);
    if (is_list(keyword, "SET_SOLID")) return read_solid_set(block);
    if (is_list(keyword, "SET_NODE")) return read_node_set(block);
    if (keyword == "INCLUDE") return keep_includes(block);
    const bool has_faces = starts_with_any(keyword, {"ELEMENT_SHELL", "SET_SEGMENT"});
    if (has_faces && read_faces(block)) return;
    const bool is_of_included = block.inclusion != 0 && keyword == "KEYWORD";
    keep(is_of_included ? whole.substr(static_cast<std::size_t>(block.content - block.begin))
                        : whole);
    if (keyword.starts_with("INCLUDE") && !keyword.starts_with("INCLUDE_PATH")) {
      mesh_.notes.push_back(
          fmt::format("*{} is not followed: what its file says of nodes is not known", keyword));
    }
    if (keyword.find("SOLID") != std::string::npos &&
        !starts_with_any(keyword, {"SECTION_", "CONTROL_"})) {
      note_names_solids(keyword);
    }
    if (keyword == "PART") read_parts(block);
    if (!names_no_nodes(keyword) && !keyword.empty()) pin(block);
  }

  /// Without the names of files whose lines are lines of the deck now.
  void keep_includes(const LsDynaBlock& block) {
    const auto stays = [this](const LsDynaInclude& name) {
      return name.inclusion == 0 || !is_inlined(name.inclusion);
    };
    const auto text = [](const char* begin, const char* end) {
      return std::string_view(begin, static_cast<std::size_t>(end - begin));
    };
    if (is_written_ && std::any_of(block.names.begin(), block.names.end(), stays)) {
      keep(text(block.begin, block.content));
      mesh_.deck[lsdyna_folder] =
          std::filesystem::absolute(path_).parent_path().lexically_normal().string();
    }
    const char* at = block.content;
    for (const LsDynaInclude& name : block.names) {
      keep(text(at, stays(name) ? name.end : name.begin));
      at = name.end;
    }
    keep(text(at, block.end));
  }

  void note_names_solids(const std::string& keyword) {
    std::string note = fmt::format("*{} names solids: {}", keyword, kMustBeMadeAnew);
    if (std::find(mesh_.notes.begin(), mesh_.notes.end(), note) == mesh_.notes.end()) {
      mesh_.notes.push_back(std::move(note));
    }
  }

  /// Nodes and solids stand where the first of them stood, with the comments between them in front.
  /// What is behind them opens the next keyword, as a rule: it stays where it is.
  void place(const LsDynaBlock& block, LsDynaPiece piece, std::size_t& at) {
    const Comments comments = comments_of(block.content, block.end);
    if (at == kNowhere) {
      at = mesh_.deck.size();
      mesh_.deck.emplace_back(1, static_cast<char>(piece));
    }
    mesh_.deck[at] += comments.inner;
    keep(comments.trailing);
  }

  struct SetHead {
    ElementSet set;
    std::vector<std::string_view> members;  ///< lines
  };
  /// Title, if there is one, then the card with the number.
  SetHead read_head(const LsDynaBlock& block) {
    SetHead head;
    head.members = lines(block);
    std::size_t lines_of_head = 1;
    if (block.keyword.find("_TITLE") != std::string::npos && !head.members.empty()) {
      head.set.name = trimmed_field(head.members[0]);
      lines_of_head = 2;
    }
    if (head.members.size() < lines_of_head) {
      fail({block.begin, 1}, fmt::format("*{} has no number: expected one", block.keyword));
    }
    const std::string_view card = head.members[lines_of_head - 1];
    split(card, now().card, now().card);
    head.set.number = integer(0, card, "the number of a set", 0);
    head.members.erase(head.members.begin(),
                       head.members.begin() + static_cast<std::ptrdiff_t>(lines_of_head));
    return head;
  }

  /// take(first, last) of each member or range, whatever its step is.
  template <class Take>
  void each_member(const LsDynaBlock& block, const std::vector<std::string_view>& lines,
                   const Take& take) {
    const bool are_ranges = block.keyword.find("GENERATE") != std::string::npos;
    const bool have_steps = block.keyword.find("INCREMENT") != std::string::npos;
    const std::size_t fields_of_one = have_steps ? 3 : are_ranges ? 2 : 1;
    for (const std::string_view line : lines) {
      split(line, now().card, now().card);
      for (std::size_t i = 0; i < fields_.size(); i += fields_of_one) {
        std::int64_t first = 0;
        std::int64_t last = 0;
        if (!nastran_integer(field(i), first) || first <= 0) continue;
        if (!are_ranges || !nastran_integer(field(i + 1), last)) last = first;
        take(first, last);
      }
    }
  }

  void read_solid_set(const LsDynaBlock& block) {
    SetHead head = read_head(block);
    std::size_t lost = 0;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    each_member(block, head.members, [&](std::int64_t first, std::int64_t last) {
      ranges.push_back(solids_.range(first, last));
      lost += ranges.back().first >= ranges.back().second ? 1 : 0;
    });
    for (const auto& [begin, end] : merged_ranges(std::move(ranges))) {
      for (std::size_t i = begin; i < end; ++i) head.set.elements.push_back(solids_.ascending()[i]);
    }
    note_lost_members(lost, head.set, "solids");
    place_set(block, std::move(head), lsdyna_set);
  }

  /// Where it fills a volume it is written anew; other members stay.
  void read_node_set(const LsDynaBlock& block) {
    SetHead head = read_head(block);
    std::size_t lost = 0;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    each_member(block, head.members, [&](std::int64_t first, std::int64_t last) {
      ranges.push_back(nodes_.range(first, last));
      lost += ranges.back().first >= ranges.back().second ? 1 : 0;
    });
    for (const auto& [begin, end] : merged_ranges(std::move(ranges))) {
      for (std::size_t i = begin; i < end; ++i) head.set.points.push_back(nodes_.ascending()[i]);
    }
    note_lost_members(lost, head.set, "nodes");
    if (!loose_points_) loose_points_.emplace(mesh_);
    const std::vector<std::uint32_t> loose = loose_points_->of(head.set.points);
    if (!loose.empty()) {
      PointPins::Pins& pins = pins_.line_of("*" + block.keyword, block.begin);
      for (const std::uint32_t v : loose)
        pins.ranges.push_back(nodes_.range(mesh_.point_numbers[v], mesh_.point_numbers[v]));
    }
    place_set(block, std::move(head), lsdyna_node_set);
  }

  void note_lost_members(std::size_t lost, const ElementSet& set, std::string_view what) {
    if (lost == 0) return;
    mesh_.notes.push_back(fmt::format("{} members of the set {} are not kept: they are no {}", lost,
                                      set.number, what));
  }

  /// Leaves room for its members in the deck, behind the comments between them.
  void place_set(const LsDynaBlock& block, SetHead head, LsDynaPiece piece) {
    const char* members = head.members.empty() ? block.end : head.members[0].data();
    std::string lines(block.begin, members);
    if (!lines.ends_with('\n')) lines += '\n';
    // As in the keyword, but for small letters and the '*'.
    if (const std::size_t at = block.keyword.find(kGenerate); at != std::string::npos) {
      lines.erase(lines.find_first_not_of(" \t", 1) + at, kGenerate.size());
    }
    const Comments comments = comments_of(members, block.end);
    set_pieces_.push_back({piece, mesh_.deck.size(), sets_.size()});
    mesh_.deck.push_back(lines + comments.inner);
    sets_.push_back(std::move(head.set));
    keep(comments.trailing);
  }

  /// Triangles and quadrilaterals. Of shells with further cards none is read.
  /// @return true for segments that are written anew: all else stays in the deck
  bool read_faces(const LsDynaBlock& block) {
    const bool is_set = block.keyword.starts_with("SET_");
    const bool is_known = is_set ? block.keyword.find("GENERAL") == std::string::npos
                                 : block.keyword == "ELEMENT_SHELL";
    if (!is_known) return false;
    SetHead head;
    if (is_set) head = read_head(block);
    if (!is_set) head.members = lines(block);
    const std::size_t width = is_set ? now().card : now().integer;
    std::size_t lost = 0;
    bool is_plain =
        is_written_ && (block.keyword == "SET_SEGMENT" || block.keyword == "SET_SEGMENT_TITLE");
    for (const std::string_view line : head.members) {
      split(line, width, width);
      ElementRow row;
      std::int64_t label = head.set.number;
      if (!is_set) nastran_integer(field(1), label);
      row.label = static_cast<Label>(std::clamp<std::int64_t>(label, 0, INT32_MAX));
      if (!read_face(is_set ? 0 : 2, row)) {
        ++lost;
        continue;
      }
      const std::size_t before = elements_.size();
      head.set.elements.push_back(faces_.add(row, sorter_, mesh_, elements_));
      if (elements_.size() > before && is_last_asked_for(question_, mesh_, row.kind->vtk_type))
        question_->place = files_.file_of(line.data()).line_place(line.data());
      is_plain = is_plain && is_plain_segment(row, head.set.elements.back());
    }
    if (lost > 0) {
      mesh_.notes.push_back(
          fmt::format("{} lines of *{} name nodes that are not there: they stay in the deck, and "
                      "are in no mesh",
                      lost, block.keyword));
    }
    if (!is_set || head.set.elements.empty()) return false;
    is_plain = is_plain && lost == 0 && are_different(head.set.elements);
    if (is_plain) {
      place_set(block, std::move(head), lsdyna_segment_set);
    } else {
      sets_.push_back(std::move(head.set));
    }
    return is_plain;
  }

  /// Does the line that was split say no more than the face that stands for it?
  bool is_plain_segment(const ElementRow& row, std::uint32_t place) const {
    constexpr std::size_t kNodes = 4;
    for (std::size_t k = kNodes; k < fields_.size(); ++k) {  // attributes
      double value = 0;
      if (!fields_[k].empty() && (!nastran_real(fields_[k], value) || value != 0)) return false;
    }
    return is_turned_like(vertices_at(mesh_, elements_[place]),
                          std::span(row.vertices).first(row.kind->corners));
  }

  /// False if it has not three or four nodes of the mesh.
  bool read_face(std::size_t first, ElementRow& row) const {
    std::array<std::int64_t, 4> n{};
    for (std::size_t k = 0; k < n.size(); ++k) nastran_integer(field(first + k), n[k]);
    row.kind = element_kind(n[3] == 0 || n[3] == n[2] ? vtk_triangle : vtk_quad);
    for (std::size_t k = 0; k < row.kind->width; ++k) {
      row.vertices[k] = nodes_.find(n[k]);
      if (row.vertices[k] == NumberIndex::kNone) return false;
    }
    return true;
  }

  void read_parts(const LsDynaBlock& block) {
    const std::vector<std::string_view> all = lines(block);
    for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
      split(all[i + 1], now().card, now().card);
      std::int64_t number = 0;
      if (!nastran_integer(field(0), number)) continue;
      names_.emplace(number, trimmed_field(all[i]));
    }
  }

  /// Parts of solids with a title come first among the sets, so that they keep their numbers.
  void name_parts() {
    std::map<std::int64_t, ElementSet> parts;
    for (std::uint32_t i = 0; i < solid_count_; ++i) {
      const std::int64_t number = label_at(mesh_, elements_[i]);
      const auto name = names_.find(number);
      if (name == names_.end() || name->second.empty()) continue;
      ElementSet& set = parts[number];
      set.number = number;
      set.name = name->second;
      set.elements.push_back(i);
    }
    for (SetPiece& piece : set_pieces_) piece.set += parts.size();
    std::vector<ElementSet> all;
    for (auto& [number, set] : parts) all.push_back(std::move(set));
    std::move(sets_.begin(), sets_.end(), std::back_inserter(all));
    sets_ = std::move(all);
  }

  void finish_sets() {
    number_sets(sets_);
    for (const auto& [letter, piece, set] : set_pieces_) {
      mesh_.deck[piece] =
          fmt::format("{}{}\n{}", static_cast<char>(letter), sets_[set].number, mesh_.deck[piece]);
    }
    if (!sets_.empty()) add_groups(mesh_, elements_, {}, sets_);
  }

  // ---- Pins ---------------------------------------------------------------------------------------

  void pin(const LsDynaBlock& block) {
    if (block.keyword.starts_with("SET_")) return pin_set(block);
    PointPins::Pins& pins = pins_.line_of("*" + block.keyword, block.begin);
    const std::size_t width = block.keyword.starts_with("ELEMENT_") ? now().integer : now().card;
    LsDynaNodeFields nodes(block.keyword);
    for (const std::string_view line : lines(block)) {
      split(line, width, width);
      pin_fields(pins, nodes.of_line(fields_));
    }
  }
  void pin_fields(PointPins::Pins& pins, std::uint32_t which) {
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const bool is_node = which == kAllFields || (i < 32 && (which >> i & 1) != 0);
      std::int64_t number = 0;
      if (is_node && nastran_integer(fields_[i], number)) {
        pins.ranges.push_back(nodes_.range(number, number));
      }
    }
  }

  /// One that stays in the deck: of segments, of ranges with steps, by options.
  void pin_set(const LsDynaBlock& block) {
    const std::string_view keyword = block.keyword;
    if (keyword.starts_with("SET_NODE_ADD")) return;  // of sets
    PointPins::Pins& pins = pins_.line_of("*" + block.keyword, block.begin);
    const SetHead head = read_head(block);
    const bool is_general = keyword.find("GENERAL") != std::string_view::npos;
    const bool is_of_segments = keyword.starts_with("SET_SEGMENT");
    if (!is_general && !is_of_segments && !keyword.starts_with("SET_NODE_COLUMN")) {
      return each_member(block, head.members, [&](std::int64_t first, std::int64_t last) {
        pins.ranges.push_back(nodes_.range(first, last));
      });
    }
    for (const std::string_view line : head.members) {
      split(line, now().card, now().card);
      if (is_general) {  // the option, and what it is about
        const std::string option = inp_key(field(0));
        const bool has_nodes = option == "NODE" || option == "SEG";
        pin_fields(pins, !has_nodes ? 0 : is_of_segments ? 0b11110 : 0b11111110);
      } else {
        pin_fields(pins, is_of_segments ? 0b1111 : 0b1);
      }
    }
  }

  static constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

  struct SetPiece {
    LsDynaPiece letter;
    std::size_t piece;  ///< of the deck
    std::size_t set;
  };

  std::filesystem::path path_;
  bool is_written_ = true;   // what is read now stands in the deck that is written
  std::size_t solid_count_;  // behind them faces come
  FacesOnce faces_;
  std::size_t nodes_at_ = kNowhere;  // piece of the deck
  std::size_t solids_at_ = kNowhere;
  std::vector<ElementSet> sets_;
  std::vector<SetPiece> set_pieces_;
  std::optional<LoosePoints> loose_points_;
  std::map<std::int64_t, std::string> names_;  // of parts
};

}  // namespace

MeshData read_lsdyna(const std::filesystem::path& file, TetPlace* question) {
  return LsDynaReader(file, question).read();
}

}  // namespace tetmend::formats
