// SPDX-License-Identifier: MIT
// Reads CGNS files.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/cgns.h"
#include "kernel/formats/cgns_tree.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_orders.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {
namespace {

/// Elements with consecutive numbers.
struct CgnsSection {
  std::string path, name;
  std::int64_t first = 0, last = 0;
  std::int64_t type = 0;
  std::vector<std::uint32_t> places;  // of each element; kNoPlace: it is not kept
};

/// Edges and faces that are none of ours: of nine nodes, polygons, of third and fourth order.
bool is_of_other_faces(std::int64_t type) {
  constexpr std::array<std::int64_t, 12> kTypes = {9, 22, 24, 25, 26, 27, 28, 40, 41, 42, 43, 44};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

class CgnsReader {
 public:
  CgnsReader(const InputFile& input, TetPlace* question)
      : input_(input), tree_(input), question_(question), sorter_(mesh_) {}

  MeshData read() {
    find_zone();
    read_points();
    read_sections();
    read_conditions();
    add_section_sets();
    for (auto* sets : {&volumes_, &surfaces_, &edges_, &points_}) number(*sets);
    label_elements();
    for (auto* sets : {&surfaces_, &edges_, &points_})
      volumes_.insert(volumes_.end(), sets->begin(), sets->end());
    if (!volumes_.empty()) add_groups(mesh_, places_, homes_, volumes_);
    read_solutions();
    for (std::string& note : tree_.notes_of_the_rest()) mesh_.notes.push_back(std::move(note));
    mesh_.variant = kCgns;
    return std::move(mesh_);
  }

 private:
  // ---- The tree -----------------------------------------------------------------------------------

  void keep(std::string_view what, const std::string& name, const std::string& text) {
    if (!text.empty()) mesh_.deck.push_back(fmt::format("{} {}{}{}", what, name, '\0', text));
  }

  void find_zone() {
    tree_.children("/", "CGNSLibraryVersion_t");
    std::vector<std::string> zones;
    for (const std::string& base : tree_.children("/", "CGNSBase_t")) {
      for (std::string& zone : tree_.children(base, "Zone_t")) zones.push_back(std::move(zone));
    }
    if (zones.empty()) {
      tree_.fail("/",
                 "no node of the file has the label 'Zone_t': meshio writes none, and no program "
                 "of CGNS reads that");
    }
    if (zones.size() > 1) {
      tree_.fail("/", fmt::format("the file has {} zones: expected one", zones.size()));
    }
    zone_ = zones[0];
    base_ = zone_.substr(0, zone_.find('/'));
    keep("name", "base", base_);
    keep("name", "zone", CgnsTree::last_name(zone_));
    const std::vector<std::int64_t> dimensions = tree_.integers(base_);
    if (dimensions.size() != 2 || dimensions[1] != 3)
      tree_.fail(base_, "the mesh does not lie in space");
    if (tree_.text_below(zone_, "ZoneType_t") != "Unstructured")
      tree_.fail(zone_, "the zone is structured: expected tets");
    keep("zone family", CgnsTree::last_name(zone_), tree_.text_below(zone_, "FamilyName_t"));
    for (const std::string& family : tree_.children(base_, "Family_t")) {
      keep("family", CgnsTree::last_name(family), tree_.text_below(family, "FamilyBC_t") + " ");
    }
  }

  // ---- Points and elements ------------------------------------------------------------------------

  void read_points() {
    const auto grids = tree_.children(zone_, "GridCoordinates_t");
    if (grids.empty()) tree_.fail(zone_, "the zone has no coordinates");
    if (grids.size() > 1) mesh_.notes.emplace_back("only the first of several grids is kept");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string path = fmt::format("{}/Coordinate{}", grids[0], kCgnsAxes[axis]);
      const std::vector<double> all = tree_.reals(path);
      if (axis == 0) mesh_.points.resize(all.size());
      if (all.size() != mesh_.points.size() || all.size() > kMostVertices) {
        tree_.fail(path, fmt::format("the table has {} values: expected {}", all.size(),
                                     mesh_.points.size()));
      }
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!std::isfinite(all[i]))
          tree_.fail(path, fmt::format("a coordinate of point {} is not finite", i + 1));
        mesh_.points[i][static_cast<Eigen::Index>(axis)] = all[i];
      }
    }
  }

  void read_sections() {
    for (const std::string& path : tree_.children(zone_, "Elements_t")) {
      CgnsSection section;
      section.path = path;
      section.name = CgnsTree::last_name(path);
      const auto range = tree_.integers(path + "/ElementRange");
      const auto type = tree_.integers(path);
      if (range.size() != 2 || range[0] < 1 || range[1] < range[0] || type.empty())
        tree_.fail(path, "the section has no range of elements");
      section.first = range[0], section.last = range[1];
      section.type = type[0];
      sections_.push_back(std::move(section));
    }
    std::sort(sections_.begin(), sections_.end(),
              [](const CgnsSection& a, const CgnsSection& b) { return a.first < b.first; });
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      if (s > 0 && sections_[s].first <= sections_[s - 1].last)
        tree_.fail(sections_[s].path, "the range of elements overlaps that of another section");
      read_section(sections_[s], static_cast<std::uint32_t>(s));
    }
  }

  const ElementKind* kind_of(const CgnsSection& section, std::int64_t type) const {
    const auto found = std::find_if(kCgnsTypes.begin(), kCgnsTypes.end(),
                                    [&](const CgnsType& each) { return each.number == type; });
    if (found == kCgnsTypes.end()) {
      tree_.fail(section.path, fmt::format("elements of CGNS' type {} cannot be kept", type));
    }
    return element_kind(found->vtk_type);
  }

  void read_section(CgnsSection& section, std::uint32_t home) {
    const std::string path = section.path + "/ElementConnectivity";
    const std::vector<std::int64_t> all = tree_.integers(path);
    for (const char* known : {"/ElementStartOffset", "/ParentElements", "/ParentElementsPosition"})
      tree_.see(section.path + known);  // which follow from the elements
    const std::int64_t count = section.last - section.first + 1;
    if (count > static_cast<std::int64_t>(all.size())) {
      tree_.fail(path, fmt::format("{} elements do not fit into {} numbers", count, all.size()));
    }
    if (is_of_other_faces(section.type)) {
      section.places.assign(static_cast<std::size_t>(count), kNoPlace);
      mesh_.notes.push_back(fmt::format("the section {} is not kept: {} elements of CGNS' type {}",
                                        in_quotes(section.name), count, section.type));
      return;
    }
    std::size_t at = 0;
    const bool is_mixed = section.type == kCgnsMixed;
    for (std::int64_t i = 0; i < count; ++i) {
      if (is_mixed && at == all.size()) tree_.fail(path, "the table ends too early");
      ElementRow row;
      row.kind = kind_of(section, is_mixed ? all[at++] : section.type);
      if (row.kind->width > all.size() - at) tree_.fail(path, "the table ends too early");
      const auto order = upright_first_order(row.kind->vtk_type);
      for (std::size_t k = 0; k < row.kind->width; ++k) {
        const std::int64_t node = all[at + (order.empty() ? k : order[k])];
        if (node < 1 || node > static_cast<std::int64_t>(mesh_.points.size())) {
          tree_.fail(path,
                     fmt::format("'{}' in element {} is not the number of a node: expected 1 to {}",
                                 node, section.first + i, mesh_.points.size()));
        }
        row.vertices[k] = static_cast<std::uint32_t>(node - 1);
      }
      at += row.kind->width;
      add(row, section, home);
      if (is_last_asked_for(question_, mesh_, row.kind->vtk_type)) {
        question_->place =
            fmt::format("{}: '/{}': element {}", input_.name(), section.path, section.first + i);
      }
    }
    if (at != all.size()) tree_.fail(path, "the table is longer than its elements");
  }

  void add(const ElementRow& row, CgnsSection& section, std::uint32_t home) {
    auto place = static_cast<std::uint32_t>(places_.size());
    if (row.kind->dimension == 2 && row.kind->corners == row.kind->width) {
      place = faces_.add(row, sorter_, mesh_, places_);
    } else {
      sorter_.add(row, false);
      places_.push_back(last_place(mesh_, *row.kind));
    }
    if (places_.size() > homes_.size()) homes_.push_back(home);
    section.places.push_back(place);
  }

  // ---- Boundary conditions ------------------------------------------------------------------------

  void read_conditions() {
    for (const std::string& list : tree_.children(zone_, "ZoneBC_t")) {
      for (const std::string& path : tree_.children(list, "BC_t")) read_condition(path);
    }
  }

  void read_condition(const std::string& path) {
    ElementSet set;
    set.name = CgnsTree::last_name(path);
    if (const std::string type = tree_.characters(path); type != "Null") keep("bc", set.name, type);
    for (const std::string& ordinal : tree_.children(path, "Ordinal_t")) {
      for (const std::int64_t number : tree_.integers(ordinal)) set.number = number;
    }
    keep("bc family", set.name, tree_.text_below(path, "FamilyName_t"));
    std::string location = tree_.text_below(path, "GridLocation_t");
    std::vector<std::int64_t> members;
    for (const char* what : {"PointList", "PointRange", "ElementList", "ElementRange"}) {
      const std::string below = fmt::format("{}/{}", path, what);
      if (!tree_.has(below)) continue;
      members = tree_.integers(below);
      if (std::string_view(what).starts_with("Element")) location = "FaceCenter";
      if (!std::string_view(what).ends_with("Range")) break;
      if (members.size() != 2 || members[0] < 1 || members[1] < members[0] ||
          members[1] - members[0] > static_cast<std::int64_t>(places_.size() + mesh_.points.size()))
        tree_.fail(path, "its range makes no sense");
      const std::int64_t last = members[1];
      members.pop_back();
      while (members.back() < last) members.push_back(members.back() + 1);
      break;
    }
    const bool is_of_points = location.empty() || location == "Vertex";
    std::size_t lost = 0;
    for (const std::int64_t member : members) {
      const std::optional<std::uint32_t> place = is_of_points ? point(member) : element(member);
      if (!place) {
        tree_.fail(path, fmt::format("'{}' is not the number of {}", member,
                                     is_of_points ? "a point" : "an element"));
      }
      lost += *place == kNoPlace ? 1 : 0;
      if (*place != kNoPlace) (is_of_points ? set.points : set.elements).push_back(*place);
    }
    note_lost_members(set, lost);
    if (lost == members.size()) return;
    (is_of_points ? points_ : faces_or_edges(set)).push_back(std::move(set));
  }

  void note_lost_members(const ElementSet& set, std::size_t lost) {
    if (set.points.empty() && set.elements.empty()) {
      mesh_.notes.push_back(
          fmt::format("the boundary condition {} has no members: not kept", in_quotes(set.name)));
    } else if (lost > 0) {
      mesh_.notes.push_back(fmt::format(
          "{} of {} members of the boundary condition {} are not kept: they are in no mesh", lost,
          lost + set.points.size() + set.elements.size(), in_quotes(set.name)));
    }
  }

  std::optional<std::uint32_t> point(std::int64_t number) const {
    if (number < 1 || number > static_cast<std::int64_t>(mesh_.points.size())) return std::nullopt;
    return static_cast<std::uint32_t>(number - 1);
  }
  std::optional<std::uint32_t> element(std::int64_t number) const {
    const auto next = std::upper_bound(
        sections_.begin(), sections_.end(), number,
        [](std::int64_t n, const CgnsSection& section) { return n < section.first; });
    if (next == sections_.begin() || number > std::prev(next)->last) return std::nullopt;
    return std::prev(next)->places[static_cast<std::size_t>(number - std::prev(next)->first)];
  }

  /// A section of volumes is a set. So is one of lower dimension where no condition has an element of it.
  void add_section_sets() {
    std::set<std::uint32_t> with_conditions;
    for (const auto* sets : {&surfaces_, &edges_}) {
      for (const ElementSet& set : *sets) {
        for (const std::uint32_t place : set.elements) with_conditions.insert(homes_[place]);
      }
    }
    for (std::uint32_t s = 0; s < sections_.size(); ++s) {
      const auto& places = sections_[s].places;
      const bool is_bare = sections_[s].name.starts_with(kCgnsUnlabelled);
      if (with_conditions.contains(s) || places.empty() || places[0] == kNoPlace || is_bare)
        continue;
      ElementSet set;
      set.name = sections_[s].name;
      set.elements = places;
      const bool is_volume = places_[set.elements[0]].of().dimension == 3;
      (is_volume ? volumes_ : faces_or_edges(set)).push_back(std::move(set));
    }
  }

  /// Which have numbers of their own.
  std::vector<ElementSet>& faces_or_edges(const ElementSet& set) {
    return places_[set.elements[0]].of().dimension == 1 ? edges_ : surfaces_;
  }

  static void number(std::vector<ElementSet>& sets) {
    for (ElementSet& set : sets) {
      Label label = 0;
      if (!to_label(inp_key(set.name), label)) continue;
      set.number = label;
      set.name.clear();
    }
    number_sets(sets);
  }

  void label_elements() {
    for (auto* sets : {&surfaces_, &edges_, &volumes_}) {
      for (auto set = sets->rbegin(); set != sets->rend(); ++set) {
        for (const std::uint32_t place : set->elements)
          label_at(mesh_, places_[place]) = static_cast<Label>(set->number);
      }
    }
  }

  // ---- Solutions ----------------------------------------------------------------------------------

  void read_solutions() {
    std::set<std::string> known;  // names of arrays, with where they are
    std::size_t lost = 0;
    for (const std::string& solution : tree_.children(zone_, "FlowSolution_t")) {
      const std::string location = tree_.text_below(solution, "GridLocation_t");
      const bool is_of_points = location.empty() || location == "Vertex";
      for (const std::string& path : tree_.children(solution, "DataArray_t")) {
        const bool is_kept = (is_of_points || location == "CellCenter") &&
                             known.insert(location + "/" + CgnsTree::last_name(path)).second &&
                             add_array(path, is_of_points);
        lost += is_kept ? 0 : 1;
      }
    }
    join_components(mesh_.point_data, kCgnsAxes);
    join_components(mesh_.tet_data, kCgnsAxes);
    for (OtherElements& others : mesh_.other_elements) join_components(others.data, kCgnsAxes);
    if (lost > 0) {
      mesh_.notes.push_back(
          fmt::format("{} arrays of solutions are not kept: they are no values of all points or "
                      "volumes, or of a later step",
                      lost));
    }
  }

  /// False if it has not one value for each.
  bool add_array(const std::string& path, bool is_of_points) {
    DataArray array{CgnsTree::last_name(path), 1, tree_.values(path)};
    if (is_of_points) {
      if (array.size() != mesh_.points.size()) return false;
      mesh_.point_data.push_back(std::move(array));
      return true;
    }
    std::map<int, std::vector<std::size_t>> rows;  // of volumes, by kind
    std::size_t count = 0;
    for (const ElementPlace& place : places_) {
      if (place.of().dimension == 3) rows[place.of().vtk_type].push_back(count++);
    }
    if (array.size() != count) return false;
    for (const auto& [type, of_kind] : rows) {
      DataArray part{array.name, 1, {}};
      std::visit(
          [&, &of_kind = of_kind](const auto& values) {
            std::decay_t<decltype(values)> some;
            for (const std::size_t row : of_kind) some.push_back(values[row]);
            part.values = std::move(some);
          },
          array.values);
      auto& to = type == vtk_tet ? mesh_.tet_data : sorter_.others(*element_kind(type)).data;
      to.push_back(std::move(part));
    }
    return true;
  }

  const InputFile& input_;
  CgnsTree tree_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  FacesOnce faces_;
  std::string base_, zone_;
  std::vector<CgnsSection> sections_;  // in the order of their elements
  std::vector<ElementPlace> places_;
  std::vector<std::uint32_t> homes_;  // sections of these
  std::vector<ElementSet> volumes_, surfaces_, edges_, points_;
};

}  // namespace

MeshData read_cgns(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  if (std::string_view(input.begin(), input.size()).starts_with("@(#)ADF")) {
    throw Error(
        fmt::format("{}: the file is of ADF, as older CGNS files are: expected HDF5, which "
                    "CGNS's program adf2hdf makes of it",
                    input.name()));
  }
  return CgnsReader(input, question).read();
}

}  // namespace tetmend::formats
