// SPDX-License-Identifier: MIT
// Reads keyword files of LS-DYNA in two passes: nodes, then all that names nodes.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/lsdyna.h"
#include "kernel/formats/lsdyna_deck.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/pin_remarks.h"

namespace tetmend::formats {
namespace {

constexpr std::size_t kCardWidth = 10;  // of a field of most keywords

class LsDynaReader : LsDynaDeck {
 public:
  LsDynaReader(const InputFile& file, TetPlace* question)
      : LsDynaDeck(file), question_(question), sorter_(mesh_) {}

  MeshData read() {
    for (const LsDynaBlock& block : blocks_) {
      if (is_nodes(block)) read_nodes(block);
    }
    if (std::none_of(blocks_.begin(), blocks_.end(), is_nodes))
      file_.fail_at_line(file_.end(), "the file has no nodes: expected *NODE");
    number_nodes();
    if (std::none_of(blocks_.begin(), blocks_.end(),
                     [](const LsDynaBlock& block) { return block.keyword == "END"; })) {
      mesh_.notes.emplace_back("the deck has no *END: is the file complete?");
    }
    mesh_.deck = {"", fmt::format("{} {}", widths_.integer, widths_.real)};
    for (const LsDynaBlock& block : blocks_) {
      if (is_solids(block)) read_solids(block);
    }
    number_solids();
    for (const LsDynaBlock& block : blocks_) read_block(block);
    name_parts();
    finish_sets();
    require_points();
    for (std::string& line : points_of_deck_)
      mesh_.deck.push_back(char{lsdyna_point} + std::move(line));
    mesh_.variant = kLsDyna;
    return std::move(mesh_);
  }

 private:
  // ---- Nodes --------------------------------------------------------------------------------------

  static bool is_nodes(const LsDynaBlock& block) { return block.keyword == "NODE"; }

  void read_nodes(const LsDynaBlock& block) {
    for (const char* at = block.content; at != block.end;) {
      const std::string_view line = next_line(at, block.end);
      if (is_comment(line)) continue;
      if (mesh_.points.size() == kMostVertices) fail(line, "the nodes are too many");
      split(line, widths_.integer, widths_.integer, 3);
      mesh_.point_numbers.push_back(integer(0, line, "the number of a node", 1));
      places_.push_back(line.data());
      Point& point = mesh_.points.emplace_back(Point::Zero());
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view text = field(1 + static_cast<std::size_t>(axis));
        if (text.empty() || nastran_real(text, point[axis])) continue;
        fail(line,
             fmt::format("{} is not a finite number: expected a coordinate", in_quotes(text)));
      }
      if (field(4).empty() && field(5).empty()) continue;
      double constraint = 0;  // "0" and "0.0" are none
      for (const std::size_t k : {4, 5}) {
        double value = 0;
        if (nastran_real(field(k), value) && value != 0) constraint = value;
      }
      if (constraint == 0) continue;
      points_of_deck_.push_back(fmt::format("{}\n{}", mesh_.point_numbers.back(), lines_of(line)));
      held_.push_back(mesh_.point_numbers.back());
    }
  }

  GmshTags tags_of(const std::vector<std::int64_t>& numbers, std::vector<std::uint32_t>& order,
                   const std::vector<const char*>& places, std::string_view what) const {
    order = ascending_order(numbers);
    std::vector<std::int64_t> ascending(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      ascending[i] = numbers[order[i]];
      if (i == 0 || ascending[i] != ascending[i - 1]) continue;
      file_.fail_at_line(
          places[order[i]],
          fmt::format("the number '{}' of {} appears for the second time", ascending[i], what));
    }
    return GmshTags(std::move(ascending));
  }
  static std::uint32_t find(const GmshTags& tags, const std::vector<std::uint32_t>& order,
                            std::int64_t number) {
    const std::uint32_t found = tags.find(number);
    return found == GmshTags::kNone ? found : order[found];
  }

  void number_nodes() {
    nodes_ = tags_of(mesh_.point_numbers, node_order_, places_, "a node");
    if (held_.empty()) return;
    Pins& pins = pins_["NODE with constraints"];
    pins = {points_of_deck_.empty() ? file_.begin() : places_[find(nodes_, node_order_, held_[0])],
            held_.size(),
            {}};
    for (const std::int64_t number : held_) add_pin(pins, number, number);
  }

  std::uint32_t node(std::int64_t number, std::string_view line) const {
    const std::uint32_t found = find(nodes_, node_order_, number);
    if (found == GmshTags::kNone) {
      fail(line, fmt::format("'{}' is not the number of a node: expected one of *NODE", number));
    }
    return found;
  }

  // ---- Solids -------------------------------------------------------------------------------------

  static bool is_solids(const LsDynaBlock& block) { return block.keyword == "ELEMENT_SOLID"; }

  /// Numbers of one element: of a line, or two where the first has but two or ends in a comma.
  void read_solids(const LsDynaBlock& block) {
    std::vector<std::int64_t> numbers;
    for (const char* at = block.content; at != block.end;) {
      std::string_view line = next_line(at, block.end);
      if (is_comment(line)) continue;
      const std::string_view first = line;
      numbers.clear();
      take_numbers(line, numbers);
      const std::string_view text = trimmed_field(line);
      if (numbers.size() <= 2 || text.ends_with(',')) {
        do {
          if (at == block.end) fail(first, "the nodes of the element are missing");
          line = next_line(at, block.end);
        } while (is_comment(line));
        take_numbers(line, numbers);
      }
      add_solid(first, numbers);
    }
  }

  void take_numbers(std::string_view line, std::vector<std::int64_t>& numbers) {
    split(line, widths_.integer, widths_.integer);
    while (!fields_.empty() && fields_.back().empty()) fields_.pop_back();
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      numbers.push_back(fields_[i].empty() ? 0 : integer(i, line, "the number of a node", 0));
    }
  }

  void add_solid(std::string_view line, std::vector<std::int64_t>& numbers) {
    while (numbers.size() > 2 && numbers.back() == 0) numbers.pop_back();
    if (numbers.size() < 6 || numbers.size() > 12) {
      fail(line, fmt::format("an element has {} nodes: expected 4, 6, 8 or 10",
                             numbers.size() < 2 ? 0 : numbers.size() - 2));
    }
    ElementRow row;
    row.number = numbers[0];
    row.place = line.data();
    if (row.number < 1 || numbers[1] < 1 || numbers[1] > INT32_MAX) {
      fail(line, "expected the numbers of an element and of a part, from 1");
    }
    row.label = static_cast<Label>(numbers[1]);
    const std::vector<std::int64_t> listed(numbers.begin() + 2, numbers.end());
    row.kind = kind_of(listed);
    if (row.kind == nullptr)
      fail(line, "the element is none of 4, 5, 6, 8 or 10 nodes: of higher order?");
    const std::uint8_t* order = order_of(*row.kind);
    for (std::size_t k = 0; k < listed.size(); ++k) {
      const std::size_t to = order == nullptr ? k : order[k];
      if (to < row.kind->width) row.vertices[to] = node(listed[k], line);
    }
    sorter_.add(row, true);
    if (question_ != nullptr && row.kind->vtk_type == vtk_tet &&
        mesh_.tets.size() == question_->tet + 1) {
      question_->place = file_.line_place(row.place);
    }
    elements_.push_back(last_place(mesh_, *row.kind));
    element_numbers_.push_back(row.number);
    element_places_.push_back(row.place);
  }

  static const std::uint8_t* order_of(const ElementKind& kind) {
    switch (kind.vtk_type) {
      case vtk_tet:
        return kLsDynaTet.data();
      case vtk_pyramid:
        return kLsDynaPyramid.data();
      case vtk_prism:
        return kLsDynaPrism.data();
      default:
        return nullptr;
    }
  }

  /// By which of its nodes are the same.
  static const ElementKind* kind_of(const std::vector<std::int64_t>& n) {
    if (n.size() == 10) return element_kind(vtk_tet10);
    if (n.size() == 4) return element_kind(vtk_tet);
    const auto same = [&](std::size_t from) {
      return std::all_of(n.begin() + static_cast<std::ptrdiff_t>(from), n.end(),
                         [&](std::int64_t each) { return each == n[from]; });
    };
    if (n.size() > kLsDynaHexahedron.size()) return nullptr;
    if (same(3)) return element_kind(vtk_tet);
    if (n.size() != 8) return nullptr;
    if (same(4)) return element_kind(vtk_pyramid);
    if (n[4] == n[5] && n[6] == n[7]) return element_kind(vtk_prism);
    return element_kind(vtk_hexahedron);
  }

  void number_solids() {
    solids_ = tags_of(element_numbers_, solid_order_, element_places_, "a solid");
    solid_count_ = elements_.size();
  }

  // ---- All else -----------------------------------------------------------------------------------

  static std::string lines_of(std::string_view text) {
    std::string lines(text);
    if (!lines.empty() && !lines.ends_with('\n')) lines += '\n';
    return lines;
  }
  void keep(std::string_view text) {
    if (text.empty()) return;
    if (mesh_.deck.size() <= kLsDynaPieces || mesh_.deck.back()[0] != lsdyna_text) {
      mesh_.deck.emplace_back(1, lsdyna_text);
    }
    mesh_.deck.back() += lines_of(text);
  }

  void read_block(const LsDynaBlock& block) {
    const std::string_view whole(block.begin, static_cast<std::size_t>(block.end - block.begin));
    const std::string& keyword = block.keyword;
    if (is_nodes(block)) return place(block, lsdyna_nodes, has_nodes_);
    if (is_solids(block)) return place(block, lsdyna_elements, has_solids_);
    const bool is_set = starts_with_any(keyword, {"SET_SOLID"}) &&
                        keyword.find("GENERAL") == std::string::npos &&
                        keyword.find("ADD") == std::string::npos;
    if (is_set) return read_solid_set(block);
    if (is_node_set(keyword)) return read_node_set(block);
    keep(whole);
    if (keyword.starts_with("INCLUDE")) {
      mesh_.notes.push_back(
          fmt::format("*{} is not followed: what its file says of nodes is not known", keyword));
    }
    if (keyword.find("SOLID") != std::string::npos &&
        !starts_with_any(keyword, {"SECTION_", "CONTROL_"})) {
      note_names_solids(keyword);
    }
    if (keyword == "PART") read_parts(block);
    if (starts_with_any(keyword, {"ELEMENT_SHELL", "SET_SEGMENT"})) read_faces(block);
    if (!names_no_nodes(keyword) && !keyword.empty()) pin(block);
  }

  void note_names_solids(const std::string& keyword) {
    std::string note = fmt::format(
        "*{} names solids: where improving replaces them it must be made anew", keyword);
    if (std::find(mesh_.notes.begin(), mesh_.notes.end(), note) == mesh_.notes.end()) {
      mesh_.notes.push_back(std::move(note));
    }
  }

  /// Nodes and solids stand where the first of them stood; comments stay.
  void place(const LsDynaBlock& block, LsDynaPiece piece, bool& is_there) {
    std::string comments;
    for (const char* at = block.content; at != block.end;) {
      const std::string_view line = next_line(at, block.end);
      if (line.starts_with('$')) comments += lines_of(line);
    }
    if (is_there) return keep(comments);
    is_there = true;
    mesh_.deck.push_back(static_cast<char>(piece) + comments);
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
      file_.fail_at_line(block.begin,
                         fmt::format("*{} has no number: expected one", block.keyword));
    }
    const std::string_view card = head.members[lines_of_head - 1];
    split(card, kCardWidth, kCardWidth);
    head.set.number = integer(0, card, "the number of a set", 0);
    head.members.erase(head.members.begin(),
                       head.members.begin() + static_cast<std::ptrdiff_t>(lines_of_head));
    return head;
  }

  /// take(first, last) of each member or range.
  template <class Take>
  void each_member(const LsDynaBlock& block, const std::vector<std::string_view>& lines,
                   const Take& take) {
    const bool are_ranges = block.keyword.find("GENERATE") != std::string::npos;
    for (const std::string_view line : lines) {
      split(line, kCardWidth, kCardWidth);
      for (std::size_t i = 0; i < fields_.size(); i += are_ranges ? 2 : 1) {
        std::int64_t first = 0;
        std::int64_t last = 0;
        if (!nastran_integer(field(i), first) || first <= 0) continue;
        if (!are_ranges || !nastran_integer(field(i + 1), last)) last = first;
        take(first, last);
      }
    }
  }

  /// Where in ascending order the numbers from `number` on begin.
  static std::size_t place_from(const GmshTags& tags, std::int64_t number) {
    const auto& all = tags.all();
    return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), number) - all.begin());
  }

  void read_solid_set(const LsDynaBlock& block) {
    SetHead head = read_head(block);
    std::size_t lost = 0;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    each_member(block, head.members, [&](std::int64_t first, std::int64_t last) {
      const std::size_t begin = place_from(solids_, first);
      const std::size_t end = place_from(solids_, last + 1);
      if (begin >= end) ++lost;
      if (begin < end) ranges.emplace_back(begin, end);
    });
    for (const auto& [begin, end] : merged(std::move(ranges))) {
      for (std::size_t i = begin; i < end; ++i) head.set.elements.push_back(solid_order_[i]);
    }
    note_lost_members(lost, head.set, "solids");
    place_set(block, std::move(head), lsdyna_set);
  }

  /// A plain list of nodes, or ranges of them.
  static bool is_node_set(std::string keyword) {
    for (const std::string_view option : {"_TITLE", "_GENERATE", "_LIST"}) {
      const std::size_t at = keyword.find(option);
      if (at != std::string::npos) keyword.erase(at, option.size());
    }
    return keyword == "SET_NODE";
  }

  /// Where it fills a volume it is written anew; other members stay.
  void read_node_set(const LsDynaBlock& block) {
    SetHead head = read_head(block);
    std::size_t lost = 0;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    each_member(block, head.members, [&](std::int64_t first, std::int64_t last) {
      ranges.emplace_back(place_from(nodes_, first), place_from(nodes_, last + 1));
      lost += ranges.back().first >= ranges.back().second ? 1 : 0;
    });
    for (const auto& [begin, end] : merged(std::move(ranges))) {
      for (std::size_t i = begin; i < end; ++i) head.set.points.push_back(node_order_[i]);
    }
    note_lost_members(lost, head.set, "nodes");
    if (!loose_points_) loose_points_.emplace(mesh_);
    const std::vector<std::uint32_t> loose = loose_points_->of(head.set.points);
    if (!loose.empty()) {
      Pins& pins = pins_[block.keyword];
      if (pins.first == nullptr) pins.first = block.begin;
      ++pins.blocks;
      for (const std::uint32_t v : loose)
        add_pin(pins, mesh_.point_numbers[v], mesh_.point_numbers[v]);
    }
    place_set(block, std::move(head), lsdyna_node_set);
  }

  void note_lost_members(std::size_t lost, const ElementSet& set, std::string_view what) {
    if (lost == 0) return;
    mesh_.notes.push_back(fmt::format("{} members of the set {} are not kept: they are no {}", lost,
                                      set.number, what));
  }

  /// Leaves room for its members in the deck.
  void place_set(const LsDynaBlock& block, SetHead head, LsDynaPiece piece) {
    const char* members = head.members.empty() ? block.end : head.members[0].data();
    std::string lines(block.begin, members);
    if (!lines.ends_with('\n')) lines += '\n';
    if (const std::size_t at = lines.find("_GENERATE"); at < lines.find('\n')) {
      lines.erase(at, std::string_view("_GENERATE").size());
    }
    set_pieces_.push_back({piece, mesh_.deck.size(), sets_.size()});
    mesh_.deck.push_back(std::move(lines));
    sets_.push_back(std::move(head.set));
  }

  /// Triangles and quadrilaterals that stay in the deck. Of shells with further cards none is read.
  void read_faces(const LsDynaBlock& block) {
    const bool is_set = block.keyword.starts_with("SET_");
    const bool is_known = is_set ? block.keyword.find("GENERAL") == std::string::npos
                                 : block.keyword == "ELEMENT_SHELL";
    if (!is_known) return;
    SetHead head;
    if (is_set) head = read_head(block);
    if (!is_set) head.members = lines(block);
    const std::size_t width = is_set ? kCardWidth : widths_.integer;
    std::size_t lost = 0;
    for (const std::string_view line : head.members) {
      split(line, width, width);
      ElementRow row;
      std::int64_t label = head.set.number;
      if (!is_set) nastran_integer(field(1), label);
      row.label = static_cast<Label>(std::clamp<std::int64_t>(label, 0, INT32_MAX));
      if (read_face(is_set ? 0 : 2, row)) {
        head.set.elements.push_back(faces_.add(row, sorter_, mesh_, elements_));
      } else {
        ++lost;
      }
    }
    if (lost > 0) {
      mesh_.notes.push_back(
          fmt::format("{} lines of *{} name nodes that are not there: they stay in the deck, and "
                      "are in no mesh",
                      lost, block.keyword));
    }
    if (is_set && !head.set.elements.empty()) sets_.push_back(std::move(head.set));
  }

  /// False if it has not three or four nodes of the mesh.
  bool read_face(std::size_t first, ElementRow& row) const {
    std::array<std::int64_t, 4> n{};
    for (std::size_t k = 0; k < n.size(); ++k) nastran_integer(field(first + k), n[k]);
    row.kind = element_kind(n[3] == 0 || n[3] == n[2] ? vtk_triangle : vtk_quad);
    for (std::size_t k = 0; k < row.kind->width; ++k) {
      row.vertices[k] = find(nodes_, node_order_, n[k]);
      if (row.vertices[k] == GmshTags::kNone) return false;
    }
    return true;
  }

  void read_parts(const LsDynaBlock& block) {
    const std::vector<std::string_view> all = lines(block);
    for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
      split(all[i + 1], kCardWidth, kCardWidth);
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

  /// Points that lines of one keyword keep.
  struct Pins {
    const char* first = nullptr;
    std::size_t blocks = 0;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;  ///< places in ascending order
  };

  template <class Number>
  static std::vector<std::pair<Number, Number>> merged(
      std::vector<std::pair<Number, Number>> ranges) {
    std::sort(ranges.begin(), ranges.end());
    std::vector<std::pair<Number, Number>> all;
    for (const auto& range : ranges) {
      if (all.empty() || range.first > all.back().second) {
        all.push_back(range);
      } else {
        all.back().second = std::max(all.back().second, range.second);
      }
    }
    return all;
  }

  void add_pin(Pins& pins, std::int64_t first, std::int64_t last) const {
    const std::size_t begin = place_from(nodes_, first);
    const std::size_t end = place_from(nodes_, last == INT64_MAX ? last : last + 1);
    if (begin < end) pins.ranges.emplace_back(begin, end);
  }

  void pin(const LsDynaBlock& block) {
    Pins& pins = pins_[block.keyword];
    if (pins.first == nullptr) pins.first = block.begin;
    ++pins.blocks;
    const bool is_set = block.keyword.starts_with("SET_");
    if (is_set && block.keyword.find("GENERAL") == std::string::npos) {
      each_member(block, read_head(block).members,
                  [&](std::int64_t first, std::int64_t last) { add_pin(pins, first, last); });
      return;
    }
    const std::size_t width = block.keyword.starts_with("ELEMENT_") ? widths_.integer : kCardWidth;
    for (const std::string_view line : lines(block)) {
      split(line, width, width);
      for (const std::string_view each : fields_) {
        std::int64_t number = 0;
        if (nastran_integer(each, number)) add_pin(pins, number, number);
      }
    }
  }

  void require_points() {
    std::vector<bool> is_required(mesh_.points.size(), false);
    std::vector<PinRemark> remarks;
    for (auto& [keyword, pins] : pins_) {
      std::size_t count = 0;
      for (const auto& [begin, end] : merged(std::move(pins.ranges))) {
        count += end - begin;
        for (std::size_t i = begin; i < end; ++i) is_required[node_order_[i]] = true;
      }
      if (count > 0) remarks.push_back({&file_, pins.first, pins.blocks, "*" + keyword, count});
    }
    for (std::uint32_t i = 0; i < is_required.size(); ++i) {
      if (is_required[i]) mesh_.required_vertices.push_back(i);
    }
    std::sort(remarks.begin(), remarks.end(),
              [](const PinRemark& a, const PinRemark& b) { return a.place < b.place; });
    mesh_.deck[0] = pin_remarks_text(remarks, "keywords");
  }

  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  std::vector<const char*> places_;  // of nodes
  std::vector<std::string> points_of_deck_;
  std::vector<std::int64_t> held_;  // numbers of nodes with constraints
  std::vector<std::uint32_t> node_order_, solid_order_;
  GmshTags nodes_, solids_;
  std::vector<ElementPlace> elements_;  // solids, then faces
  FacesOnce faces_;
  std::size_t solid_count_ = 0;
  std::vector<std::int64_t> element_numbers_;
  std::vector<const char*> element_places_;
  bool has_nodes_ = false;
  bool has_solids_ = false;
  std::vector<ElementSet> sets_;
  struct SetPiece {
    LsDynaPiece letter;
    std::size_t piece;  ///< of the deck
    std::size_t set;
  };
  std::vector<SetPiece> set_pieces_;
  std::optional<LoosePoints> loose_points_;
  std::map<std::int64_t, std::string> names_;  // of parts
  std::map<std::string, Pins> pins_;           // by keyword
};

}  // namespace

MeshData read_lsdyna(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return LsDynaReader(input, question).read();
}

}  // namespace tetmend::formats
