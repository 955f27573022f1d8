// SPDX-License-Identifier: MIT
// Reads Nastran's bulk data in two passes: points, then all that names points.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/nastran_references.h"
#include "kernel/formats/nastran_sources.h"
#include "kernel/formats/nastran_systems.h"
#include "kernel/formats/pin_remarks.h"

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
  Reader(const std::filesystem::path& file, TetPlace* question)
      : path_(file), sources_(file), question_(question), sorter_(mesh_) {}

  MeshData read() {
    if (sources_.deck().size() == 0) fail_at_end("the file is empty: expected bulk data");
    mesh_.notes = sources_.notes();
    mesh_.deck.resize(nastran_pieces);
    mesh_.deck[nastran_front] = sources_.front();
    mesh_.deck[nastran_end] = sources_.end();
    if (nastran_name(sources_.end()) == "BEGIN") {
      mesh_.notes.emplace_back(
          "the bulk data of superelements stay as they are: what they say is not read");
    }
    if (mesh_.deck[nastran_end].empty()) {
      mesh_.notes.emplace_back("the bulk data have no ENDDATA: is the file complete?");
    } else if (mesh_.deck[nastran_front].empty()) {
      mesh_.deck[nastran_front] = "BEGIN BULK\n";  // as Gmsh writes it, which others do not read
    }
    read_points();
    if (mesh_.points.empty() && mesh_.deck[nastran_end].empty()) {
      fail_at_end("the file has no points: expected GRID");
    }
    place_points();
    read_rest();
    check_numbers();
    label_blank_properties();
    require_points();
    note_partial();
    mesh_.deck[nastran_greatest] = greatest_numbers();
    mesh_.variant = kNastran;
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail_at_end(std::string_view reason) const {
    const InputFile& deck = sources_.deck();
    deck.fail_at_line(sources_.end().empty() ? deck.end() : sources_.end().data(), reason);
  }
  [[noreturn]] void fail_at(const char* place, std::string_view reason) const {
    sources_.file_of(place).fail_at_line(place, reason);
  }
  [[noreturn]] void fail(std::string_view where, std::string_view reason) const {
    fail_at(where.empty() ? card_.text.data() : where.data(), reason);
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

  // ---- Points -------------------------------------------------------------------------------------

  void read_points() {
    for (const NastranStretch& stretch : sources_.stretches()) {
      if (stretch.includes != 0) continue;
      NastranLines lines = sources_.lines(stretch);
      while (!lines.at_end()) {
        if (!lines.begins_with("GR") && !lines.begins_with("CORD")) {
          lines.line();
          continue;
        }
        lines.read(card_);
        if (card_.name == "GRID") {
          read_point();
        } else if (card_.name == "GRDSET") {
          if (!card_.field(1).empty()) default_system_ = read_system(1);
        } else if (card_.name.starts_with("CORD")) {
          read_definition();
        }
      }
    }
    number_points();
  }

  void number_points() {
    std::vector<std::int64_t>& numbers = mesh_.point_numbers;
    order_ = ascending_order(numbers);
    std::vector<std::int64_t> ascending(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) ascending[i] = numbers[order_[i]];
    for (std::size_t i = 1; i < order_.size(); ++i) {
      if (ascending[i] != ascending[i - 1]) continue;
      fail_at(places_[order_[i]],
              fmt::format("the number '{}' of a point appears for the second time", ascending[i]));
    }
    tags_ = GmshTags(std::move(ascending));
  }

  void read_point() {
    if (mesh_.points.size() == kMostVertices) fail({}, "too many points");
    mesh_.point_numbers.push_back(integer(0, "the number of a point", 1, INT64_MAX));
    const std::int64_t system = card_.field(1).empty() ? 0 : read_system(1);
    if (system != 0) waiting_[static_cast<std::uint32_t>(mesh_.points.size())] = system;
    Point& point = mesh_.points.emplace_back();
    bool is_long = false;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = card_.field(2 + static_cast<std::size_t>(axis));
      is_long =
          is_long || field.size() + (field.find('.') == std::string_view::npos) > kNastranRoom;
      point[axis] = 0;
      if (!field.empty() && !nastran_real(field, point[axis])) {
        fail(field,
             fmt::format("{} is not a finite number: expected a coordinate", in_quotes(field)));
      }
    }
    places_.push_back(card_.text.data());
    if (is_blank(5) && !is_long && system == 0) return keep_comments();
    mesh_.deck[nastran_points] += card_text();
    // Output coordinates, constraints, superelement: only constraints mean the place.
    std::int64_t components = 0;
    const bool is_held = !card_.field(6).empty() &&
                         !(nastran_integer(card_.field(6), components) && components == 0);
    if (is_held) {
      const std::int64_t number = mesh_.point_numbers.back();
      add_pins({{{number, number}}, true});
    }
  }

  std::int64_t read_system(std::size_t field) {
    return integer(field, "the number of a coordinate system", 0, INT64_MAX);
  }

  void read_definition() {
    try {
      systems_.add(card_);
    } catch (const NastranSystems::Failure& failure) {
      fail_at(failure.place, failure.reason);
    }
  }

  /// GRDSET means all points whose own field is blank. It may stand behind them.
  void apply_default_system() {
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      sources_.lines_from(places_[i], sources_.file_of(places_[i]).end()).read(card_);
      if (!card_.field(1).empty()) continue;
      waiting_[i] = default_system_;
      if (is_blank(5)) mesh_.deck[nastran_points] += card_text();
    }
  }

  /// From the systems that they are given in to the basic one.
  void place_points() {
    if (default_system_ != 0) apply_default_system();
    if (waiting_.empty()) return;
    for (std::uint32_t i = 0; i < places_.size(); ++i) place_point(i);
  }

  void place_point(std::uint32_t i) {
    const auto waiting = waiting_.find(i);
    if (waiting == waiting_.end()) return;
    const std::int64_t system = waiting->second;
    try {
      const NastranSystem& found =
          systems_.find(system, [this](std::int64_t number) -> const Point* {
            const std::uint32_t point = find_point(number);
            if (point == GmshTags::kNone) return nullptr;
            place_point(point);
            return &mesh_.points[point];
          });
      mesh_.points[i] = found.to_basic(mesh_.points[i]);
    } catch (const NastranSystems::Failure& failure) {
      fail_at(failure.place == nullptr ? places_[i] : failure.place, failure.reason);
    }
    if (!mesh_.points[i].allFinite()) fail_at(places_[i], "the point lies beyond all numbers");
    waiting_.erase(i);
  }

  std::string card_text() const {
    std::string text = lines_of(card_.text);
    for (const std::string_view line : card_.strays) text += lines_of(line);
    return text;
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

  // ---- Elements and all else ----------------------------------------------------------------------

  void read_rest() {
    for (const NastranStretch& stretch : sources_.stretches()) {
      is_written_ = sources_.is_inlined(stretch.inclusion);
      NastranLines lines = sources_.lines(stretch);
      if (stretch.includes != 0) {
        if (is_written_ && !sources_.is_inlined(stretch.includes)) keep_include(stretch);
        continue;
      }
      while (!lines.at_end()) read_card(lines);
    }
  }

  void keep_include(const NastranStretch& stretch) {
    keep({stretch.begin, static_cast<std::size_t>(stretch.end - stretch.begin)});
    mesh_.deck[nastran_folder] =
        std::filesystem::absolute(path_).parent_path().lexically_normal().string();
  }

  void read_card(NastranLines& lines) {
    const char first = *lines.position();
    if (first == '$') return keep(lines.line());
    const bool is_stray = sources_.is_stray(lines.position());
    lines.read(card_);
    if (is_stray) return;
    const bool was_of_mesh = std::exchange(is_of_mesh_, card_.name == "GRID");
    if (is_of_mesh_) return;
    if (card_.name.starts_with('=') && was_of_mesh) {
      fail({},
           "points and elements that repeat the card before cannot be read: expected GRID and "
           "elements without '='");
    }
    if (card_.name.empty() || first == '+') {
      if (first == '+' || !is_blank(0))
        fail({}, "a continuation without a card: expected the name of a card");
      return;
    }
    is_of_mesh_ = read_element();
    if (!is_of_mesh_) keep_card();
  }

  /// In a file whose INCLUDE stays, lines stay as well.
  void keep(std::string_view text) {
    if (is_written_) mesh_.deck[nastran_cards] += lines_of(text);
  }
  /// Of a card that is written anew.
  void keep_comments() {
    for (const std::string_view line : card_.comments) {
      if (!trimmed_field(line).empty()) keep(line);
    }
  }

  /// The kinds that the name of the card may mean: of first order, then of second.
  void find_kinds() {
    name_of_kinds_ = card_.name;
    kinds_.clear();
    std::string_view name = card_.name;
    if (name.ends_with('_')) name.remove_suffix(1);  // meshio names those of second order "CTETRA_"
    for (const NastranCard& card : kNastranCards) {
      if (card.name == name) kinds_.push_back(element_kind(card.vtk_type));
    }
  }

  /// False if the card is no element of ours.
  bool read_element() {
    if (card_.name != name_of_kinds_) find_kinds();
    if (kinds_.empty()) return false;
    row_.kind = kinds_.front();
    if (kinds_.size() > 1 && has_nodes_from(row_.kind->width)) row_.kind = kinds_.back();
    const std::size_t nodes = row_.kind->width;
    const bool is_volume = row_.kind->dimension == 3;
    row_.place = card_.text.data();
    row_.number = integer(0, "the number of an element", 1, INT64_MAX);
    row_.label = 0;
    if (!card_.field(1).empty()) {
      row_.label = static_cast<Label>(integer(1, "the number of a property", 0, INT32_MAX));
      if (row_.label == 0) mesh_.deck[nastran_zero] = "0";
    }
    if (is_volume && has_nodes_from(nodes)) {
      fail(card_.field(2 + nodes),
           fmt::format("{} has more than {} points: expected none of higher order", card_.name,
                       nodes));
    }
    const bool is_partial = leaves_out_nodes();
    if (is_partial) {
      ++partial_[card_.name];
      row_.kind = nastran_first_order(*row_.kind);
    }
    read_nodes();
    add_element(is_partial);
    if (card_.field(1).empty()) without_property_.push_back(elements_.back());
    if (is_partial || !is_blank(2 + nodes)) {
      mesh_.deck[nastran_elements] += card_text();
    } else {
      keep_comments();
    }
    return true;
  }

  /// A mid-side node that is left out: a blank field, or 0.
  bool is_left_out(std::size_t k) const {
    std::int64_t number = 1;
    return card_.field(2 + k).empty() ||
           (nastran_integer(card_.field(2 + k), number) && number == 0);
  }

  /// Some mid-side nodes, not all: Nastran has straight edges there.
  bool leaves_out_nodes() const {
    for (std::size_t k = row_.kind->corners; k < row_.kind->width; ++k) {
      if (is_left_out(k)) return true;
    }
    return false;
  }

  bool has_nodes_from(std::size_t first) const {
    for (std::size_t k = first; 2 + k < card_.fields.size(); ++k) {
      if (!is_left_out(k)) return true;
    }
    return false;
  }

  /// A tet that leaves out nodes stays as it is: it is no tet of the mesh.
  void add_element(bool is_partial) {
    if (is_partial && row_.kind->vtk_type == vtk_tet) {
      OtherElements& others = sorter_.others(*row_.kind);
      others.vertices.insert(others.vertices.end(), row_.vertices.begin(),
                             row_.vertices.begin() + 4);
      others.labels.push_back(row_.label);
      others.numbers.push_back(row_.number);
    } else {
      sorter_.add(row_, true);
      if (is_last_asked_for(question_, mesh_, row_.kind->vtk_type)) {
        question_->place = sources_.file_of(row_.place).line_place(row_.place);
      }
    }
    elements_.push_back({row_.number, row_.kind->vtk_type, row_.place});
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

  std::string greatest_numbers() const {
    std::int64_t point = 0;
    for (const std::int64_t number : mesh_.point_numbers) point = std::max(point, number);
    return fmt::format("{} {}", point, elements_.empty() ? 0 : elements_.back().number);
  }

  /// Solvers want numbers that no two elements share; we need it of those of one kind.
  void check_numbers() {
    const auto less = [](const Element& a, const Element& b) { return a.number < b.number; };
    if (!std::is_sorted(elements_.begin(), elements_.end(), less)) {
      std::stable_sort(elements_.begin(), elements_.end(), less);
    }
    std::size_t shared = 0;
    for (std::size_t i = 1; i < elements_.size(); ++i) {
      for (std::size_t k = i; k-- > 0 && elements_[k].number == elements_[i].number;) {
        if (nastran_first_order(*element_kind(elements_[k].vtk_type)) !=
            nastran_first_order(*element_kind(elements_[i].vtk_type))) {
          ++shared;
          continue;
        }
        fail_at(elements_[i].place,
                fmt::format("the number '{}' of an element appears for the second time",
                            elements_[i].number));
      }
    }
    if (shared == 0) return;
    mesh_.notes.push_back(fmt::format(
        "{} elements have the number of one of another kind: both are kept, which solvers refuse",
        shared));
  }

  /// A blank field means the property with the number of the element, if there is one.
  void label_blank_properties() {
    if (properties_.empty() || without_property_.empty()) return;
    std::map<std::pair<int, std::int64_t>, Label> labels;
    for (const Element& element : without_property_) {
      if (!properties_.contains(element.number)) continue;
      labels[{element.vtk_type, element.number}] = static_cast<Label>(element.number);
    }
    if (labels.empty()) return;
    const auto give = [&](int type, auto& elements, const std::vector<std::int64_t>& numbers) {
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto found = labels.find({type, numbers[i]});
        if (found != labels.end()) elements[i].label = found->second;
      }
    };
    give(vtk_tet, mesh_.tets, mesh_.tet_numbers);
    give(vtk_triangle, mesh_.triangles, mesh_.triangle_numbers);
    for (OtherElements& others : mesh_.other_elements) {
      for (std::size_t i = 0; i < others.numbers.size(); ++i) {
        const auto found = labels.find({others.vtk_type, others.numbers[i]});
        if (found != labels.end()) others.labels[i] = found->second;
      }
    }
  }

  void note_partial() {
    for (const auto& [name, count] : partial_) {
      mesh_.notes.push_back(fmt::format(
          "{} {} leave out some of their mid-side nodes: they stay as they are, and where they are",
          count, name));
    }
  }

  void keep_card() {
    keep(card_.text);
    for (const std::string_view line : card_.strays) keep(line);
    std::int64_t number = 0;
    if (card_.name.starts_with('P') && nastran_integer(card_.field(0), number) && number > 0 &&
        number <= INT32_MAX) {
      properties_.insert(number);
    }
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
      if (count > 0)
        remarks.push_back(
            {&sources_.file_of(pins.first), pins.first, pins.cards, who(name, pins), count});
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

  /// As it stands in the deck.
  struct Element {
    std::int64_t number;
    int vtk_type;
    const char* place;
  };

  std::filesystem::path path_;
  NastranSources sources_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  NastranCardText card_;
  ElementRow row_;
  std::string name_of_kinds_;  // of the card that they are of
  std::vector<const ElementKind*> kinds_;
  bool is_of_mesh_ = false;          // the card before: a point or an element
  bool is_written_ = true;           // what is read now is written again, line by line
  std::vector<const char*> places_;  // of points
  std::vector<Element> elements_;
  std::vector<Element> without_property_;
  std::set<std::int64_t> properties_;           // their numbers
  std::map<std::string, std::size_t> partial_;  // elements that leave out nodes, by card
  NastranSystems systems_;
  std::int64_t default_system_ = 0;
  std::unordered_map<std::uint32_t, std::int64_t> waiting_;  // points not placed yet: their systems
  std::vector<std::uint32_t> order_;                         // in which their numbers ascend
  GmshTags tags_;
  std::map<std::string, Pins> pins_;  // by the name of the card
  std::set<std::string> element_cards_;
};

}  // namespace

MeshData read_nastran(const std::filesystem::path& file, TetPlace* question) {
  return Reader(file, question).read();
}

std::vector<std::filesystem::path> nastran_files(const std::filesystem::path& deck) {
  try {
    std::vector<std::filesystem::path> files = NastranSources(deck).files();
    files.front() = deck;  // of standard input, too
    return files;
  } catch (const Error&) {
    return {deck};
  }
}

}  // namespace tetmend::formats
