// SPDX-License-Identifier: MIT
// Reads Nastran's bulk data in two passes: points, then all that names points.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/nastran_references.h"
#include "kernel/formats/pin_remarks.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {
namespace {

/// Cards that name volume elements, or faces of them.
bool names_elements(std::string_view name) {
  return name == "PLOAD4" || name == "BSURFS" || name == "TEMPE4" || name == "QBDY4";
}

/// The points that cards of one name keep.
struct Pins {
  const char* first = nullptr;  ///< place of the first of these cards
  std::size_t cards = 0;
  bool is_known = true;
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges;  ///< of numbers
};

/// Sorted, and without overlaps.
template <class Number>
std::vector<std::pair<Number, Number>> merged(std::vector<std::pair<Number, Number>> ranges) {
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

class Reader {
 public:
  Reader(const InputFile& file, TetPlace* question)
      : file_(file),
        text_(file, TextReader::kNoComments),
        question_(question),
        begin_(file.begin()),
        end_(file.end()),
        sorter_(mesh_) {}

  MeshData read() {
    if (text_.at_end()) text_.fail("the file is empty: expected bulk data");
    find_bulk();
    mesh_.deck.resize(nastran_pieces);
    mesh_.deck[nastran_front].assign(file_.begin(), begin_);
    mesh_.deck[nastran_end].assign(end_, file_.end());
    if (mesh_.deck[nastran_end].empty()) {
      if (!mesh_.deck[nastran_front].empty()) {
        file_.fail_at_line(end_, "the file ends where ENDDATA is expected");
      }
      mesh_.notes.emplace_back("the bulk data have no ENDDATA: is the file complete?");
    }
    read_points();
    if (mesh_.points.empty() && mesh_.deck[nastran_end].empty()) {
      file_.fail_at_line(end_, "the file has no points: expected GRID");
    }
    read_rest();
    check_numbers();
    require_points();
    if (mesh_.deck == std::vector<std::string>{"BEGIN BULK\n", "", "ENDDATA\n", "", ""}) {
      mesh_.deck.clear();  // the writer's own
    }
    mesh_.variant = kNastran;
    return std::move(mesh_);
  }

 private:
  /// The bulk goes from behind BEGIN BULK, or the beginning, to ENDDATA, or the end.
  void find_bulk() {
    NastranLines lines(file_.begin(), file_.end());
    bool begun = false;
    while (!lines.at_end()) {
      const char* begin = lines.position();
      const std::string_view line = lines.line();
      if (line[0] != 'B' && line[0] != 'b' && line[0] != 'E' && line[0] != 'e') continue;
      const std::string name = nastran_name(line);
      if (!begun && name.starts_with("BEGIN")) {
        begin_ = lines.position();
        begun = true;
      }
      if (name == "ENDDATA") {
        end_ = begin;
        return;
      }
    }
  }

  [[noreturn]] void fail(std::string_view where, std::string_view reason) const {
    file_.fail_at_line(where.empty() ? card_.text.data() : where.data(), reason);
  }

  /// A field that must be an integer from `low` to `high`.
  std::int64_t integer(std::size_t i, std::string_view what, std::int64_t low, std::int64_t high) {
    const std::string_view field = card_.field(i);
    std::int64_t value = 0;
    if (!nastran_integer(field, value)) {
      fail(field, fmt::format("{} is not an integer: expected {}", in_quotes(field), what));
    }
    if (value < low || value > high) {
      fail(field, fmt::format("{} is out of range: expected {}, {} to {}", in_quotes(field), what,
                              low, high));
    }
    return value;
  }

  bool is_blank(std::size_t first) const {
    for (std::size_t i = first; i < card_.fields.size(); ++i) {
      if (!card_.fields[i].empty()) return false;
    }
    return true;
  }

  void read_points() {
    NastranLines lines(begin_, end_);
    while (!lines.at_end()) {
      const char first = *lines.position();
      if ((first != 'G' && first != 'g') || !is_point(lines)) {
        lines.line();
        continue;
      }
      lines.read(card_);
      read_point();
    }
    std::vector<std::int64_t>& numbers = mesh_.point_numbers;
    order_ = ascending_order(numbers);
    std::vector<std::int64_t> ascending(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) ascending[i] = numbers[order_[i]];
    for (std::size_t i = 1; i < order_.size(); ++i) {
      if (ascending[i] != ascending[i - 1]) continue;
      file_.fail_at_line(
          places_[order_[i]],
          fmt::format("the number '{}' of a point appears for the second time", ascending[i]));
    }
    places_ = {};
    tags_ = GmshTags(std::move(ascending));
  }

  static bool is_point(NastranLines lines) { return nastran_name(lines.line()) == "GRID"; }

  void read_point() {
    if (mesh_.points.size() == kMostVertices) fail({}, "too many points");
    mesh_.point_numbers.push_back(integer(0, "the number of a point", 1, INT64_MAX));
    if (const std::string_view system = card_.field(1); !system.empty()) {
      integer(1, "the coordinate system 0: points in others cannot be read", 0, 0);
    }
    Point& point = mesh_.points.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = card_.field(2 + static_cast<std::size_t>(axis));
      point[axis] = 0;
      if (!field.empty() && !nastran_real(field, point[axis])) {
        fail(field,
             fmt::format("{} is not a finite number: expected a coordinate", in_quotes(field)));
      }
    }
    places_.push_back(card_.text.data());
    if (is_blank(5)) return;
    mesh_.deck[nastran_points] += lines_of(card_.text);
    // Output coordinates, constraints, superelement: only constraints mean the place.
    std::int64_t components = 0;
    const bool is_held = !card_.field(6).empty() &&
                         !(nastran_integer(card_.field(6), components) && components == 0);
    if (is_held) {
      const std::int64_t number = mesh_.point_numbers.back();
      add_pins({{{number, number}}, true});
    }
  }

  static std::string lines_of(std::string_view text) {
    std::string lines(text);
    if (!lines.ends_with('\n')) lines += '\n';
    return lines;
  }

  /// GmshTags::kNone if no point has this number.
  std::uint32_t find_point(std::int64_t number) const {
    const std::uint32_t found = tags_.find(number);
    return found == GmshTags::kNone ? found : order_[found];
  }

  void read_rest() {
    NastranLines lines(begin_, end_);
    while (!lines.at_end()) {
      const char first = *lines.position();
      if (first == '$') {
        mesh_.deck[nastran_cards] += lines_of(lines.line());
        continue;
      }
      if ((first == 'G' || first == 'g') && is_point(lines)) {
        lines.read(card_);
        continue;
      }
      lines.read(card_);
      if (card_.name.empty() || first == '+') {
        if (first == '+' || !is_blank(0))
          fail({}, "a continuation without a card: expected the name of a card");
        continue;
      }
      if (!read_element()) keep_card();
    }
  }

  /// False if the card is no element of ours.
  bool read_element() {
    const auto is_ours = [this](const NastranCard& card) { return card.name == card_.name; };
    if (std::none_of(kNastranCards.begin(), kNastranCards.end(), is_ours)) return false;
    const bool is_volume = card_.name != "CTRIA3" && card_.name != "CTRIA6" &&
                           card_.name != "CQUAD4" && card_.name != "CQUAD8";
    std::size_t nodes = 0;
    row_.kind = nullptr;
    for (const NastranCard& card : kNastranCards) {
      const std::size_t width = element_kind(card.vtk_type)->width;
      if (is_ours(card) && (row_.kind == nullptr || !is_blank(2 + nodes))) {
        row_.kind = element_kind(card.vtk_type);
        nodes = width;
      }
    }
    row_.place = card_.text.data();
    row_.number = integer(0, "the number of an element", 1, INT64_MAX);
    row_.label = card_.field(1).empty()
                     ? static_cast<Label>(integer(0, "the number of a property", 1, INT32_MAX))
                     : static_cast<Label>(integer(1, "the number of a property", 0, INT32_MAX));
    read_nodes();
    if (is_volume && !is_blank(2 + nodes)) {
      fail(card_.field(2 + nodes),
           fmt::format("{} has more than {} points: expected none of higher order", card_.name,
                       nodes));
    }
    sorter_.add(row_, true);
    elements_.emplace_back(row_.number, row_.place);
    answer(question_, mesh_, text_, row_);
    if (!is_blank(2 + nodes)) mesh_.deck[nastran_elements] += lines_of(card_.text);
    return true;
  }

  void read_nodes() {
    const std::uint8_t* order = nastran_order(row_.kind->vtk_type);
    for (std::size_t k = 0; k < row_.kind->width; ++k) {
      const std::size_t field = 2 + (order == nullptr ? k : order[k]);
      const std::int64_t number = integer(field, "the number of a point", 1, INT64_MAX);
      row_.vertices[k] = find_point(number);
      if (row_.vertices[k] == GmshTags::kNone) {
        fail(card_.field(field),
             fmt::format("'{}' is not the number of a point: expected one of GRID", number));
      }
    }
  }

  void check_numbers() {
    const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (!std::is_sorted(elements_.begin(), elements_.end(), less)) {
      std::stable_sort(elements_.begin(), elements_.end(), less);
    }
    const auto same =
        std::adjacent_find(elements_.begin(), elements_.end(),
                           [](const auto& a, const auto& b) { return a.first == b.first; });
    if (same == elements_.end()) return;
    file_.fail_at_line(
        std::next(same)->second,
        fmt::format("the number '{}' of an element appears for the second time", same->first));
  }

  void keep_card() {
    if (card_.name == "GRDSET" && !card_.field(1).empty()) {
      integer(1, "the coordinate system 0: points in others cannot be read", 0, 0);
    }
    if (card_.name == "INCLUDE") {
      mesh_.notes.push_back(
          fmt::format("what {} includes is not read", in_quotes(trimmed_field(card_.text))));
    }
    mesh_.deck[nastran_cards] += lines_of(card_.text);
    if (names_elements(card_.name) && element_cards_.insert(card_.name).second) {
      mesh_.notes.push_back(fmt::format(
          "the card {} names elements: where improving replaces them it must be made anew",
          card_.name));
    }
    NastranReferences references = nastran_references(card_);
    std::erase_if(references.ranges, [this](const auto& range) {
      return range.first > range.second ||
             (range.first == range.second && find_point(range.first) == GmshTags::kNone);
    });
    if (!references.ranges.empty()) add_pins(references);
  }

  void add_pins(const NastranReferences& references) {
    Pins& pins = pins_[card_.name];
    if (pins.first == nullptr) pins.first = card_.text.data();
    ++pins.cards;
    pins.is_known = references.is_known;
    pins.ranges.insert(pins.ranges.end(), references.ranges.begin(), references.ranges.end());
  }

  /// Where in ascending order the numbers from `number` on begin.
  std::size_t place_from(std::int64_t number) const {
    const auto at = std::partition_point(order_.begin(), order_.end(), [&](std::uint32_t i) {
      return mesh_.point_numbers[i] < number;
    });
    return static_cast<std::size_t>(at - order_.begin());
  }

  void require_points() {
    std::vector<std::pair<std::size_t, std::size_t>> all;  // places, the last is behind
    std::vector<PinRemark> remarks;
    for (auto& [name, pins] : pins_) {
      std::size_t count = 0;
      for (const auto& [first, last] : merged(std::move(pins.ranges))) {
        const std::size_t begin = place_from(first);
        const std::size_t end = last == INT64_MAX ? order_.size() : place_from(last + 1);
        if (begin == end) continue;
        all.emplace_back(begin, end);
        count += end - begin;
      }
      if (count > 0) remarks.push_back({&file_, pins.first, pins.cards, who(name, pins), count});
    }
    std::vector<bool> is_required(order_.size(), false);
    for (const auto& [begin, end] : merged(std::move(all))) {
      for (std::size_t i = begin; i < end; ++i) is_required[order_[i]] = true;
    }
    for (std::uint32_t i = 0; i < is_required.size(); ++i) {
      if (is_required[i]) mesh_.required_vertices.push_back(i);
    }
    if (remarks.empty()) return;
    std::sort(remarks.begin(), remarks.end(),
              [](const PinRemark& a, const PinRemark& b) { return a.place < b.place; });
    mesh_.deck.push_back(pin_remarks_text(remarks, "kinds of cards"));  // nastran_remarks
  }

  static std::string who(const std::string& name, const Pins& pins) {
    if (name == "GRID") return name + " with constraints in field 8";
    return pins.is_known ? name : name + ", a card whose fields are not known,";
  }

  const InputFile& file_;
  TextReader text_;  // for errors
  TetPlace* question_;
  const char* begin_;
  const char* end_;
  MeshData mesh_;
  ElementSorter sorter_;
  NastranCardText card_;
  ElementRow row_;
  std::vector<const char*> places_;                             // of points
  std::vector<std::pair<std::int64_t, const char*>> elements_;  // number and place
  std::vector<std::uint32_t> order_;                            // in which their numbers ascend
  GmshTags tags_;
  std::map<std::string, Pins> pins_;  // by the name of the card
  std::set<std::string> element_cards_;
};

}  // namespace

MeshData read_nastran(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return Reader(input, question).read();
}

}  // namespace tetmend::formats
