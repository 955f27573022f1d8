// SPDX-License-Identifier: MIT
// Writes CGNS files of version 3.4.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "kernel/formats/cgns.h"
#include "kernel/formats/cgns_tree.h"
#include "kernel/formats/element_orders.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/unique_names.h"

namespace tetmend::formats {
namespace {

constexpr float kVersion = 3.4F;

/// What stands behind "WHAT NAME\0" in the deck.
std::optional<std::string> piece_of(const MeshData* mesh, std::string_view what,
                                    std::string_view name) {
  if (mesh == nullptr || mesh->variant != kCgns) return std::nullopt;
  const std::string begin = fmt::format("{} {}{}", what, name, '\0');
  for (const std::string& piece : mesh->deck) {
    if (piece.starts_with(begin)) return piece.substr(begin.size());
  }
  return std::nullopt;
}

/// Elements of one dimension and label.
struct WrittenSection {
  int dimension = 0;
  Label label = 0;
  std::vector<GroupMembers::Member> elements;
  std::string name;
  std::int64_t first = 0;
};

class CgnsWriter {
 public:
  CgnsWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file),
        file_(make_hdf5(file.string(), "CGNS")),
        mesh_(mesh),
        lists_(mesh),
        members_(members_of_groups(mesh, lists_)) {}

  void write() {
    collect_sections();
    begin_file();
    begin_zone();
    write_points();
    for (const WrittenSection& section : sections_) write_section(section);
    write_conditions();
    write_solutions();
    out_.put(file_->bytes());
    out_.commit(mesh_.companions());
  }

 private:
  const Group& group(std::size_t g) const { return mesh_.data()->groups[g]; }
  const ElementList& list_of(const GroupMembers::Member& member) const {
    return lists_.all()[member.list];
  }

  void collect_sections() {
    std::map<std::pair<int, Label>, std::size_t> known;
    numbers_.resize(lists_.all().size());
    for (std::uint32_t k = 0; k < lists_.all().size(); ++k) {
      const ElementList& list = lists_.all()[k];
      numbers_[k].resize(list.count);
      for (std::uint32_t i = 0; i < list.count; ++i) {
        const std::pair key(list.kind.dimension, list.label(i));
        const auto [at, is_new] = known.try_emplace(key, sections_.size());
        if (is_new) sections_.push_back({key.first, key.second, {}, {}, 0});
        sections_[at->second].elements.push_back({k, i});
      }
    }
    // A reader numbers what has a name by its place: with labels ascending these stay.
    const auto place = [](const WrittenSection& section) {
      return std::tuple(-section.dimension, section.label == 0, section.label);
    };
    std::stable_sort(sections_.begin(), sections_.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
    std::int64_t next = 1;
    for (WrittenSection& section : sections_) {
      section.first = next;
      for (const auto& [k, i] : section.elements) numbers_[k][i] = next++;
    }
    // Other nodes of a zone.
    for (const char* taken :
         {"ZoneType", "GridCoordinates", "ZoneBC", "PointData", "CellData", "FamilyName"})
      section_names_.take(taken);
    for (std::size_t g = 0; g < members_.size(); ++g) name_section(g);
    UniqueNames names(kCgnsNames);
    for (const WrittenSection& section : sections_) names.take(section.name);
    for (WrittenSection& section : sections_) {
      if (!section.name.empty()) continue;
      section.name =
          names.make(section.label != 0 ? label_name(section.label) : std::string(kCgnsUnlabelled));
    }
  }

  /// After a group of all elements of a section, and of no others.
  void name_section(std::size_t g) {
    const auto& elements = members_[g].elements;
    if (group(g).name.empty() || elements.empty()) return;
    const ElementList& list = list_of(elements[0]);
    const Label label = list.label(elements[0].index);
    for (WrittenSection& section : sections_) {
      const bool fits = section.dimension == list.kind.dimension && section.label == label &&
                        section.elements.size() == elements.size() && section.name.empty();
      const auto is_in = [&](const GroupMembers::Member& member) {
        return list_of(member).label(member.index) == label;
      };
      if (!fits || !std::all_of(elements.begin(), elements.end(), is_in)) continue;
      section.name = section_names_.make_fit(group(g).name);
      return;
    }
  }

  // ---- The tree -----------------------------------------------------------------------------------

  std::string node(const std::string& path, std::string_view label, std::string_view type = "MT") {
    file_->group(path);
    file_->set(path, "name", CgnsTree::last_name(path));
    file_->set(path, "label", std::string(label));
    file_->set(path, "type", std::string(type));
    file_->set(path, "flags", 1);
    return path;
  }
  std::string node(const std::string& path, std::string_view label, const DataArray::Values& values,
                   std::size_t columns = 0) {
    constexpr std::array<std::string_view, 4> kTypes = {"I4", "I8", "R4", "R8"};
    node(path, label, kTypes[values.index()]);
    file_->write(path + "/ data", values, columns);
    return path;
  }
  std::string text_node(const std::string& path, std::string_view label, const std::string& text) {
    node(path, label, "C1");
    file_->write_characters(path + "/ data", text);
    return path;
  }
  /// With 32 bits where they do.
  static DataArray::Values integers(std::vector<std::int64_t> values) {
    if (std::all_of(values.begin(), values.end(),
                    [](std::int64_t value) { return value <= INT32_MAX; })) {
      return std::vector<std::int32_t>(values.begin(), values.end());
    }
    return values;
  }

  void begin_file() {
    file_->set("/", "name", "HDF5 MotherNode");
    file_->set("/", "label", "Root Node of HDF5 File");
    file_->set("/", "type", "MT");
    file_->write_characters(" format", "IEEE_LITTLE_32");
    file_->write_characters(" hdf5version", "HDF5 Version 1.10");
    node("CGNSLibraryVersion", "CGNSLibraryVersion_t", std::vector<float>{kVersion});
  }

  void begin_zone() {
    base_ = piece_of(mesh_.data(), "name", "base").value_or("Base");
    node(base_, "CGNSBase_t", std::vector<std::int32_t>{3, 3});
    zone_ = base_ + "/" + piece_of(mesh_.data(), "name", "zone").value_or("Zone1");
    std::int64_t volumes = 0;
    for (const ElementList* list : lists_.of_dimension(3))
      volumes += static_cast<std::int64_t>(list->count);
    node(zone_, "Zone_t", integers({static_cast<std::int64_t>(mesh_.point_count()), volumes, 0}),
         1);
    text_node(zone_ + "/ZoneType", "ZoneType_t", "Unstructured");
    if (const auto family = piece_of(mesh_.data(), "zone family", CgnsTree::last_name(zone_)))
      text_node(zone_ + "/FamilyName", "FamilyName_t", *family);
    if (mesh_.data() == nullptr) return;
    for (const std::string& piece : mesh_.data()->deck) {
      constexpr std::string_view kFamily = "family ";
      const std::size_t end = piece.find('\0');
      if (mesh_.data()->variant != kCgns || !piece.starts_with(kFamily)) continue;
      const std::string path =
          node(base_ + "/" + piece.substr(kFamily.size(), end - kFamily.size()), "Family_t");
      const std::string type = piece.substr(end + 1, piece.size() - end - 2);
      if (!type.empty()) text_node(path + "/FamilyBC", "FamilyBC_t", type);
    }
  }

  void write_points() {
    const std::string path = node(zone_ + "/GridCoordinates", "GridCoordinates_t");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> all(mesh_.point_count());
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = mesh_.point(i)[static_cast<Eigen::Index>(axis)];
      node(fmt::format("{}/Coordinate{}", path, kCgnsAxes[axis]), "DataArray_t", std::move(all));
    }
  }

  static std::int32_t type_of(const ElementKind& kind) {
    return std::find_if(kCgnsTypes.begin(), kCgnsTypes.end(),
                        [&](const CgnsType& type) { return type.vtk_type == kind.vtk_type; })
        ->number;
  }

  void write_section(const WrittenSection& section) {
    const ElementKind& first = list_of(section.elements[0]).kind;
    const bool is_mixed = std::any_of(
        section.elements.begin(), section.elements.end(),
        [&](const auto& member) { return list_of(member).kind.vtk_type != first.vtk_type; });
    std::vector<std::int64_t> nodes;
    for (const GroupMembers::Member& member : section.elements) {
      const ElementList& list = list_of(member);
      if (is_mixed) nodes.push_back(type_of(list.kind));
      const auto order = upright_first_order(list.kind.vtk_type);
      const auto vertices = list.vertices(member.index);
      for (std::size_t k = 0; k < list.kind.width; ++k)
        nodes.push_back(std::int64_t{vertices[order.empty() ? k : order[k]]} + 1);
    }
    const std::int32_t type = is_mixed ? kCgnsMixed : type_of(first);
    const std::string path =
        node(zone_ + "/" + section.name, "Elements_t", std::vector<std::int32_t>{type, 0});
    const auto count = static_cast<std::int64_t>(section.elements.size());
    node(path + "/ElementRange", "IndexRange_t",
         integers({section.first, section.first + count - 1}));
    node(path + "/ElementConnectivity", "DataArray_t", integers(std::move(nodes)));
  }

  // ---- Boundary conditions ------------------------------------------------------------------------

  /// Groups of points and faces, and labels of faces without a group.
  void write_conditions() {
    UniqueNames names(kCgnsNames);
    std::vector<std::vector<bool>> is_named(lists_.all().size());
    for (std::size_t k = 0; k < is_named.size(); ++k) is_named[k].resize(lists_.all()[k].count);
    for (std::size_t g = 0; g < members_.size(); ++g) {
      const bool is_condition = group(g).dimension == 0 || group(g).dimension == 2;
      if (!is_condition || group(g).name.empty()) continue;
      std::vector<std::int64_t> list;
      for (const std::uint32_t point : members_[g].points) list.push_back(std::int64_t{point} + 1);
      for (const auto& [k, i] : members_[g].elements) {
        list.push_back(numbers_[k][i]);
        is_named[k][i] = true;
      }
      write_condition(names.make_fit(group(g).name), group(g), std::move(list));
    }
    for (const WrittenSection& section : sections_) {
      if (section.dimension != 2 || section.label == 0) continue;
      std::vector<std::int64_t> list;
      for (const auto& [k, i] : section.elements) {
        if (!is_named[k][i]) list.push_back(numbers_[k][i]);
      }
      write_condition(names.make(label_name(section.label)), {2, section.label}, std::move(list));
    }
  }

  void write_condition(const std::string& name, const Group& group,
                       std::vector<std::int64_t> list) {
    if (list.empty()) return;
    const std::string conditions = zone_ + "/ZoneBC";
    if (!std::exchange(has_conditions_, true)) node(conditions, "ZoneBC_t");
    const auto family = piece_of(mesh_.data(), "bc family", name);
    const std::string path =
        text_node(conditions + "/" + name, "BC_t",
                  piece_of(mesh_.data(), "bc", name).value_or(family ? "FamilySpecified" : "Null"));
    node(path + "/PointList", "IndexArray_t", integers(std::move(list)), 1);
    text_node(fmt::format("{}/{}", path, kCgnsLocation), "GridLocation_t",
              group.dimension == 0 ? "Vertex" : "FaceCenter");
    if (group.number > 0)
      node(path + "/Ordinal", "Ordinal_t", std::vector<std::int32_t>{group.number});
    if (family) text_node(path + "/FamilyName", "FamilyName_t", *family);
  }

  // ---- Solutions ----------------------------------------------------------------------------------

  void write_solutions() {
    if (mesh_.data() == nullptr) return;
    UniqueNames point_names = cgns_array_names();
    std::set<std::string> points_have, cells_have;
    for (const DataArray& array : mesh_.data()->point_data) {
      if (!points_have.insert(array.name).second) continue;  // see Room::names_are_unique
      const auto names = component_names(array, kCgnsAxes, point_names);
      for (std::size_t c = 0; c < names.size(); ++c)
        write_array("PointData", "Vertex", names[c], component_values(array, c));
    }
    const auto volumes = lists_.of_dimension(3);
    if (volumes.empty() || volumes[0]->data == nullptr) return;
    UniqueNames cell_names = cgns_array_names();
    for (const DataArray& array : *volumes[0]->data) {
      if (!cells_have.insert(array.name).second) continue;
      const auto names = component_names(array, kCgnsAxes, cell_names);
      for (std::size_t c = 0; c < names.size(); ++c) {
        if (const auto values = values_of_volumes(array, c))
          write_array("CellData", "CellCenter", names[c], *values);
      }
    }
  }

  void write_array(const std::string& solution, const std::string& location,
                   const std::string& name, const DataArray::Values& values) {
    const std::string path = zone_ + "/" + solution;
    if (solutions_.insert(solution).second) {
      node(path, "FlowSolution_t");
      text_node(fmt::format("{}/{}", path, kCgnsLocation), "GridLocation_t", location);
    }
    node(path + "/" + name, "DataArray_t", values);
  }

  /// In the order of the file; nothing if not all kinds of volumes have such an array.
  std::optional<DataArray::Values> values_of_volumes(const DataArray& wanted, std::size_t c) const {
    std::map<std::uint32_t, DataArray::Values> of_list;
    for (std::uint32_t k = 0; k < lists_.all().size(); ++k) {
      const ElementList& list = lists_.all()[k];
      if (list.kind.dimension < 3) continue;
      if (list.data == nullptr) return std::nullopt;
      const DataArray* found = find_like(*list.data, wanted);
      if (found == nullptr) return std::nullopt;
      of_list[k] = component_values(*found, c);
    }
    return std::visit(
        [&](const auto& of_type) -> DataArray::Values {
          std::decay_t<decltype(of_type)> all;
          for (const WrittenSection& section : sections_) {
            if (section.dimension < 3) continue;
            for (const auto& [k, i] : section.elements)
              all.push_back(std::get<std::decay_t<decltype(of_type)>>(of_list.at(k))[i]);
          }
          return all;
        },
        wanted.values);
  }

  OutputFile out_;
  std::unique_ptr<Hdf5Writer> file_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::vector<GroupMembers> members_;
  std::vector<WrittenSection> sections_;
  UniqueNames section_names_{kCgnsNames};
  std::vector<std::vector<std::int64_t>> numbers_;  // of each list, in the file
  std::string base_, zone_;
  bool has_conditions_ = false;
  std::set<std::string> solutions_;
};

}  // namespace

void write_cgns(const std::filesystem::path& file, const MeshView& mesh) {
  CgnsWriter(file, mesh).write();
}

}  // namespace tetmend::formats
