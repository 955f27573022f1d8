// SPDX-License-Identifier: MIT
// Reads Nastran's bulk data in two passes: points, then all that names points.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/harmless_notes.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/nastran_pins.h"
#include "kernel/formats/nastran_points.h"
#include "kernel/formats/nastran_references.h"
#include "kernel/formats/nastran_sources.h"

namespace tetmend::formats {
namespace {

/// Cards that name volume elements, or faces of them.
bool names_elements(std::string_view name) {
  return name == "PLOAD4" || name == "BSURFS" || name == "TEMPE4" || name == "QBDY4";
}

class NastranReader : private NastranCardReader {
 public:
  NastranReader(const std::filesystem::path& file, const NastranSources& sources,
                TetPlace* question)
      : NastranCardReader(sources),
        path_(file),
        question_(question),
        sorter_(mesh_),
        points_(sources, mesh_) {}

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
    points_.read();
    if (mesh_.points.empty() && mesh_.deck[nastran_end].empty()) {
      fail_at_end("the file has no points: expected GRID");
    }
    points_.place();
    read_rest();
    check_numbers();
    label_blank_properties();
    pins_.require(points_, sources_, mesh_);
    note_partial();
    if (!sets_of_elements_.empty()) {
      mesh_.notes.push_back(fmt::format("{} sets name elements, the first is SET {}: {}",
                                        sets_of_elements_.size(), sets_of_elements_[0],
                                        kMustBeMadeAnew));
    }
    const std::size_t lost = points_.lost_comments() + lost_comments_;
    if (lost > 0) {
      mesh_.notes.push_back(
          fmt::format("comments behind the fields of points and elements are not kept: {}", lost));
    }
    mesh_.variant = kNastran;
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail_at_end(std::string_view reason) const {
    const InputFile& deck = sources_.deck();
    deck.fail_at_line(sources_.end().empty() ? deck.end() : sources_.end().data(), reason);
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
    is_of_mesh_ = false;
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
    if (card_.name.empty() || first == '+') {
      if (first == '+' || !is_blank(0))
        fail({}, "a continuation without a card: expected the name of a card");
      return;
    }
    const bool was_of_mesh = std::exchange(is_of_mesh_, card_.name == "GRID");
    if (is_of_mesh_) return;
    if (card_.name.starts_with('=') && was_of_mesh) {
      fail({},
           "points and elements that repeat the card before cannot be read: expected GRID and "
           "elements without '='");
    }
    is_of_mesh_ = read_element();
    if (!is_of_mesh_) keep_card();
  }

  /// In a file whose INCLUDE stays, lines stay as well.
  void keep(std::string_view text) {
    if (is_written_) mesh_.deck[nastran_cards] += nastran_lines(text);
  }
  /// Of a card that is written anew.
  void keep_comments() {
    lost_comments_ += card_.has_end_comments ? 1 : 0;
    if (is_written_) keep_nastran_comments(card_, mesh_.deck[nastran_cards]);
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
      if (row_.label == 0) mesh_.deck[nastran_zero].assign(1, '0');
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
      row_.vertices[k] = points_.find(number);
      if (row_.vertices[k] == GmshTags::kNone) {
        fail(card_.field(field),
             fmt::format("'{}' is not the number of a point: expected one of GRID", number));
      }
    }
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
      mesh_.notes.push_back(fmt::format("{} {} leave out some of their mid-side nodes: {}", count,
                                        name, kStayWhereTheyAre));
    }
  }

  void note_names_elements() {
    if (is_nastran_set_of_elements(card_)) {
      sets_of_elements_.emplace_back(card_.field(0));
    } else if (names_elements(card_.name) && element_cards_.insert(card_.name).second) {
      mesh_.notes.push_back(
          fmt::format("the card {} names elements: {}", card_.name, kMustBeMadeAnew));
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
    note_names_elements();
    NastranReferences references = nastran_references(card_);
    std::erase_if(references.ranges, [this](const auto& range) {
      return range.first > range.second ||
             (range.first == range.second && points_.find(range.first) == GmshTags::kNone);
    });
    if (!references.ranges.empty()) pins_.add(card_, references);
  }

  /// As it stands in the deck.
  struct Element {
    std::int64_t number;
    int vtk_type;
    const char* place;
  };

  std::vector<std::string> sets_of_elements_;
  std::filesystem::path path_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  NastranPoints points_;
  ElementRow row_;
  std::string name_of_kinds_;  // of the card that they are of
  std::vector<const ElementKind*> kinds_;
  bool is_of_mesh_ = true;  // the card before: a point or an element, or there is none
  bool is_written_ = true;  // what is read now is written again, line by line
  std::vector<Element> elements_;
  std::vector<Element> without_property_;
  std::set<std::int64_t> properties_;           // their numbers
  std::map<std::string, std::size_t> partial_;  // elements that leave out nodes, by card
  NastranPins pins_;
  std::size_t lost_comments_ = 0;  // behind the fields of elements
  std::set<std::string> element_cards_;
};

}  // namespace

MeshData read_nastran(const std::filesystem::path& file, TetPlace* question) {
  const NastranSources sources(file);
  return NastranReader(file, sources, question).read();
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
