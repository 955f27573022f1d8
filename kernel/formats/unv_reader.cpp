// SPDX-License-Identifier: MIT
// Reads universal files: finds the datasets, then reads nodes, elements and groups, in this order.
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
#include "kernel/formats/element_sets.h"
#include "kernel/formats/number_index.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/unv.h"
#include "kernel/formats/unv_elements.h"

namespace tetmend::formats {
namespace {

constexpr std::string_view kMark = "-1";  // begins and ends a dataset
constexpr std::int64_t kEnd = -1;

std::string_view without_blanks(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) - first + 1);
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}
bool has_nodes(std::string_view name) {
  return is_one_of(name, {"2411", "781", "15"});
}
bool has_elements(std::string_view name) {
  return is_one_of(name, {"2412", "780"});
}
/// Groups whose members have four numbers each.
bool has_wide_groups(std::string_view name) {
  return is_one_of(name, {"2435", "2452", "2467", "2477"});
}
bool has_groups(std::string_view name) {
  return has_wide_groups(name) || is_one_of(name, {"2417", "2429", "2430", "2432"});
}
/// Of the file, its units and systems of coordinates: these name no nodes.
bool stays(std::string_view name) {
  return is_one_of(name, {"151", "164", "2420", "2400"});
}

struct UnvDataset {
  std::string_view name;
  const char* begin;    ///< of its first line, the mark
  const char* content;  ///< behind its name
  const char* end;      ///< behind its last line
};

/// Rows of numbers of elements of one kind that are not what the writer says by itself.
struct NumbersOfKind {
  std::vector<std::int32_t> rows;
  bool differ = false;
};

class UnvReader {
 public:
  UnvReader(const InputFile& file, TetPlace* question)
      : text_(file, TextReader::kNoComments), question_(question), sorter_(mesh_) {}

  MeshData read() {
    find_datasets();
    each_dataset(has_nodes, [this](const UnvDataset& dataset) { read_nodes(dataset); });
    nodes_ = index_of(mesh_.point_numbers, node_places_, "a node");
    each_dataset(has_elements, [this](const UnvDataset& dataset) { read_elements(dataset); });
    elements_ = index_of(element_numbers_, element_places_, "an element");
    each_dataset(has_groups, [this](const UnvDataset& dataset) { read_groups(dataset); });
    number_sets(sets_);
    label_by_groups();
    add_arrays();
    if (!sets_.empty()) add_groups(mesh_, places_, homes_, sets_);
    note_lost();
    mesh_.variant = kUnv;
    return std::move(mesh_);
  }

 private:
  void find_datasets() {
    if (text_.at_end()) text_.fail("the file is empty: expected a dataset, which begins with -1");
    while (!text_.at_end()) {
      UnvDataset dataset{};
      text_.word();
      dataset.begin = text_.last_word();
      text_.seek(dataset.begin);
      if (const std::string_view line = without_blanks(text_.skip_line()); line != kMark) {
        text_.fail(fmt::format("{} is not the beginning of a dataset: expected -1",
                               in_quotes(line.substr(0, line.find(' ')))));
      }
      dataset.name = text_.expect_word("the number of a dataset");
      text_.skip_line();
      dataset.content = text_.position();
      const char* name = dataset.name.data();
      while (text_.bytes_left() > 0 && without_blanks(text_.skip_line()) != kMark) {
      }
      dataset.end = text_.position();
      const char* last = dataset.end;
      while (last != dataset.content && (last[-1] == '\n' || last[-1] == '\r' || last[-1] == ' '))
        --last;
      if (last - dataset.content < 2 || last[-1] != '1' || last[-2] != '-') {
        text_.fail_at(name, fmt::format("the dataset {} has no end: expected a line of -1",
                                        in_quotes(dataset.name)));
      }
      keep(dataset);
    }
    expect(has_nodes, "nodes: expected a dataset 2411, 781 or 15");
    expect(has_elements, "elements: expected a dataset 2412 or 780");
  }

  void expect(bool (*is_wanted)(std::string_view), std::string_view what) const {
    if (std::none_of(datasets_.begin(), datasets_.end(),
                     [&](const UnvDataset& each) { return is_wanted(each.name); })) {
      text_.fail(fmt::format("the file has no {}", what));
    }
  }

  void keep(const UnvDataset& dataset) {
    const std::string_view name = dataset.name;
    if (has_nodes(name) || has_elements(name) || has_groups(name)) {
      datasets_.push_back(dataset);
    } else if (stays(name)) {
      std::string lines(dataset.begin, dataset.end);
      if (!lines.ends_with('\n')) lines += '\n';
      mesh_.deck.push_back("    " + lines);
    } else if (lost_.insert(std::string(name)).second) {
      mesh_.notes.push_back(fmt::format("the dataset {} is not kept", in_quotes(name)));
    }
  }

  template <class Read>
  void each_dataset(bool (*is_wanted)(std::string_view), const Read& read) {
    for (const UnvDataset& dataset : datasets_) {
      if (!is_wanted(dataset.name)) continue;
      text_.seek(dataset.content);
      read(dataset);
    }
  }

  std::int32_t small(std::string_view what) { return text_.label(what); }

  // ---- Nodes --------------------------------------------------------------------------------------

  void read_nodes(const UnvDataset&) {
    for (;;) {
      const std::int64_t number = text_.integer("the number of a node", kEnd, INT64_MAX);
      if (number == kEnd) return;
      if (number == 0) text_.fail("'0' is out of range: expected the number of a node, from 1");
      if (mesh_.points.size() == kMostVertices) text_.fail("the nodes are too many");
      mesh_.point_numbers.push_back(number);
      node_places_.push_back(text_.last_word());
      std::array<std::int32_t, 3> numbers{};
      for (std::int32_t& each : numbers) each = small("a system of coordinates or a colour");
      nodes_differ_ = nodes_differ_ || numbers != std::array<std::int32_t, 3>{1, 1, 11};
      node_numbers_.insert(node_numbers_.end(), numbers.begin(), numbers.end());
      Point& point = mesh_.points.emplace_back();
      for (int axis = 0; axis < 3; ++axis) point[axis] = text_.real("a coordinate");
    }
  }

  NumberIndex index_of(const std::vector<std::int64_t>& numbers,
                       const std::vector<const char*>& places, std::string_view what) const {
    return {numbers, [&](std::uint32_t i) {
              text_.fail_at(places[i],
                            fmt::format("the number '{}' of {} appears for the second time",
                                        numbers[i], what));
            }};
  }

  // ---- Elements -----------------------------------------------------------------------------------

  void read_elements(const UnvDataset& dataset) {
    const bool is_old = dataset.name == "780";  // two numbers more
    for (;;) {
      ElementRow row;
      row.number = text_.integer("the number of an element", kEnd, INT64_MAX);
      if (row.number == kEnd) return;
      row.place = text_.last_word();
      const std::int64_t descriptor = text_.integer("the kind of an element", 0, INT32_MAX);
      const char* const word = text_.last_word();
      if (is_old) small("the number of a property");
      const std::int32_t property = small("the number of a property");
      if (is_old) small("the number of a material");
      const std::int32_t material = small("the number of a material");
      const std::int32_t colour = small("a colour");
      const std::int64_t width = text_.integer("the number of nodes of an element", 0, INT32_MAX);
      if (is_unv_beam(descriptor)) read_sections();
      const UnvKind* kind = unv_kind(descriptor);
      if (kind == nullptr) {
        skip_element(descriptor, width);
        continue;
      }
      row.kind = element_kind(kind->vtk_type);
      if (width != static_cast<std::int64_t>(row.kind->width)) {
        text_.fail_at(word, fmt::format("an element of kind {} has {} nodes: expected {}",
                                        descriptor, width, row.kind->width));
      }
      row.label = property;
      add_element(*kind, row, {static_cast<std::int32_t>(descriptor), property, material, colour});
    }
  }

  void read_sections() {
    for (int k = 0; k < 3; ++k) {
      if (small("a number of the sections of a beam") > 1) has_sections_ = true;
    }
  }

  /// Springs, rigid bars, elements of third order.
  void skip_element(std::int64_t descriptor, std::int64_t width) {
    constexpr std::int64_t kCubicPrism = 114;
    constexpr std::int64_t kCubicHexahedron = 117;
    if (descriptor == kCubicPrism || descriptor == kCubicHexahedron) {
      text_.fail(
          fmt::format("volume elements of kind {} cannot be read: expected none of third "
                      "order",
                      descriptor));
    }
    for (std::int64_t k = 0; k < width; ++k) text_.integer("the number of a node", 0, INT64_MAX);
    ++skipped_[descriptor];
  }

  void add_element(const UnvKind& kind, ElementRow& row,
                   const std::array<std::int32_t, 4>& numbers) {
    std::array<std::uint32_t, kMostVerticesOfElement> listed{};
    for (std::size_t k = 0; k < row.kind->width; ++k) {
      const std::int64_t number = text_.integer("the number of a node", 0, INT64_MAX);
      listed[k] = nodes_.find(number);
      if (listed[k] == NumberIndex::kNone) {
        text_.fail(fmt::format("'{}' is not the number of a node", number));
      }
    }
    for (std::size_t k = 0; k < row.kind->width; ++k) row.vertices[k] = listed[kind.order[k]];
    sorter_.add(row, true);
    answer(question_, mesh_, text_, row);
    places_.push_back(last_place(mesh_, *row.kind));
    element_numbers_.push_back(row.number);
    element_places_.push_back(row.place);
    numbers_.push_back(numbers);
    const auto dimension = static_cast<std::size_t>(row.kind->dimension);
    properties_[dimension].insert(numbers[1]);
    homes_.push_back(static_cast<std::uint32_t>(
        homes_of_.try_emplace({numbers[1], numbers[2]}, homes_of_.size()).first->second));
  }

  /// Salome and others give all elements one property and part them by groups.
  void label_by_groups() {
    std::vector<bool> is_labelled(places_.size(), false);
    std::array<bool, 4> has_groups{};  // by dimension
    for (const ElementSet& set : sets_) {
      for (const std::uint32_t element : set.elements) {
        const ElementPlace place = places_[element];
        if (properties_[static_cast<std::size_t>(place.of().dimension)].size() > 1) continue;
        if (is_labelled[element]) continue;
        is_labelled[element] = true;
        has_groups[static_cast<std::size_t>(place.of().dimension)] = true;
        label_at(mesh_, place) = static_cast<Label>(set.number);
      }
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const bool by_group = has_groups[static_cast<std::size_t>(places_[i].of().dimension)];
      if (by_group && !is_labelled[i]) label_at(mesh_, places_[i]) = 0;
    }
  }

  void add_arrays() {
    if (nodes_differ_) {
      mesh_.point_data.push_back({std::string(kUnvNode), 3, std::move(node_numbers_)});
    }
    std::map<int, NumbersOfKind> of_kind;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const ElementKind& kind = places_[i].of();
      NumbersOfKind& found = of_kind[kind.vtk_type];
      found.rows.insert(found.rows.end(), numbers_[i].begin(), numbers_[i].end());
      const std::array<std::int32_t, 4> own = {
          static_cast<std::int32_t>(unv_kind_of(kind.vtk_type)->written),
          label_at(mesh_, places_[i]), 1, 7};
      found.differ = found.differ || numbers_[i] != own;
    }
    for (auto& [type, numbers] : of_kind) {
      if (!numbers.differ) continue;
      DataArray array{std::string(kUnvElement), 4, std::move(numbers.rows)};
      if (type == vtk_tet)
        mesh_.tet_data.push_back(std::move(array));
      else if (type == vtk_triangle)
        mesh_.triangle_data.push_back(std::move(array));
      else if (type == vtk_edge)
        mesh_.edge_data.push_back(std::move(array));
      else
        sorter_.others(*element_kind(type)).data.push_back(std::move(array));
    }
  }

  // ---- Groups -------------------------------------------------------------------------------------

  void read_groups(const UnvDataset& dataset) {
    const bool is_wide = has_wide_groups(dataset.name);
    if (is_wide && sets_.empty() && dataset.name != kUnvGroups)
      mesh_.deck.push_back(fmt::format("{}{}", kUnvGroupsPiece, dataset.name));
    for (;;) {
      ElementSet set;
      set.number = text_.integer("the number of a group", kEnd, INT64_MAX);
      if (set.number == kEnd) return;
      for (int k = 0; k < 6; ++k) small("a number of a group");
      const std::size_t bytes_each = std::string_view("8 1\n").size();
      const std::size_t count =
          text_.count("members of a group", is_wide ? 2 * bytes_each : bytes_each);
      text_.skip_line();
      set.name = without_blanks(text_.skip_line());
      std::size_t lost = 0;
      for (std::size_t i = 0; i < count; ++i) {
        lost += read_member(set) ? 0 : 1;
        for (int k = 0; k < 2 && is_wide; ++k)
          text_.integer("a number of a member", INT64_MIN, INT64_MAX);
      }
      if (lost > 0) {
        mesh_.notes.push_back(
            fmt::format("{} of {} members of the group {} are not kept: they are no nodes or "
                        "elements of the mesh",
                        lost, count, in_quotes(set.name)));
      }
      sets_.push_back(std::move(set));
    }
  }

  /// False if it is nothing of the mesh.
  bool read_member(ElementSet& set) {
    constexpr std::int64_t kNode = 7;
    constexpr std::int64_t kElement = 8;
    const std::int64_t type = text_.integer("the type of a member", 0, INT32_MAX);
    const std::int64_t number = text_.integer("the number of a member", 0, INT64_MAX);
    std::uint32_t found = NumberIndex::kNone;
    if (type == kNode) found = nodes_.find(number);
    if (type == kElement) found = elements_.find(number);
    if (found == NumberIndex::kNone) return false;
    (type == kNode ? set.points : set.elements).push_back(found);
    return true;
  }

  void note_lost() {
    for (const auto& [descriptor, count] : skipped_) {
      mesh_.notes.push_back(fmt::format("{} elements of kind {} are not kept", count, descriptor));
    }
    if (has_sections_) mesh_.notes.emplace_back("sections of beams are not kept");
  }

  TextReader text_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  std::vector<UnvDataset> datasets_;
  std::set<std::string> lost_;  // names of datasets
  std::vector<const char*> node_places_, element_places_;
  std::vector<std::int32_t> node_numbers_;  // three of each
  bool nodes_differ_ = false;
  NumberIndex nodes_, elements_;
  std::vector<ElementPlace> places_;  // of elements, as they stand in the file
  std::vector<std::int64_t> element_numbers_;
  std::vector<std::array<std::int32_t, 4>> numbers_;  // kUnvElement of each
  std::array<std::set<std::int32_t>, 4> properties_;  // by dimension
  std::vector<std::uint32_t> homes_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> homes_of_;
  std::vector<ElementSet> sets_;
  std::map<std::int64_t, std::size_t> skipped_;
  bool has_sections_ = false;
};

}  // namespace

MeshData read_unv(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return UnvReader(input, question).read();
}

}  // namespace tetmend::formats
