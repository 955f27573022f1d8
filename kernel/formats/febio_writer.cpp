// SPDX-License-Identifier: MIT
// Writes input files of FEBio, and around the mesh the rest of the model.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/febio.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/unique_names.h"
#include "kernel/formats/vtu_array.h"

namespace tetmend::formats {
namespace {

constexpr std::array<std::int64_t, 2> kIdLimits = {INT32_MAX, INT64_MAX};

std::string_view febio_type(int vtk_type) {
  for (const FebioType& type : kFebioTypes) {
    if (type.vtk_type == vtk_type) return type.name;
  }
  return {};
}

class FebioWriter {
 public:
  FebioWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file),
        mesh_(mesh),
        lists_(mesh),
        points_(written_point_numbers(mesh, kIdLimits)),
        elements_(written_element_numbers(lists_, kIdLimits)),
        members_(members_of_groups(mesh, lists_)) {}

  void write() {
    sort_mesh();
    const MeshData* data = mesh_.data();
    if (data != nullptr && data->variant == kFebio && !data->deck.empty()) {
      sort_points(data->deck);
      for (std::size_t i = 1; i < data->deck.size(); ++i) write_piece(data->deck[i]);
      check_labels();
    } else {
      write_new();
    }
    out_.commit(mesh_.companions());
  }

 private:
  static Label number_of(std::string_view piece) {
    Label number = 0;
    std::from_chars(piece.data() + 1, piece.data() + piece.size(), number);
    return number;
  }

  /// Null if there is no such group.
  const GroupMembers* members_of(int dimension, Label number) const {
    const auto found = group_of_.find({dimension, number});
    return found == group_of_.end() ? nullptr : &members_[found->second];
  }

  /// In which block each point is written: by the number of its group; 0 is the first block.
  void sort_points(const std::vector<std::string>& deck) {
    std::vector<Label> blocks(mesh_.point_count(), 0);
    for (const std::string& piece : deck) {
      if (!piece.starts_with(febio_nodes) || number_of(piece) == 0) continue;
      const GroupMembers* members = members_of(0, number_of(piece));
      if (members == nullptr) continue;
      for (const std::uint32_t point : members->points) {
        if (blocks[point] == 0) blocks[point] = number_of(piece);
      }
    }
    points_of_block_.clear();
    for (std::uint32_t i = 0; i < blocks.size(); ++i) points_of_block_[blocks[i]].push_back(i);
  }

  /// Volumes and faces by label, and points, all in one block.
  void sort_mesh() {
    for (std::uint32_t k = 0; k < lists_.all().size(); ++k) {
      const ElementList& list = lists_.all()[k];
      if (list.kind.dimension < 2) continue;
      auto& of_label = list.kind.dimension == 3 ? of_label_ : faces_of_label_;
      for (std::uint32_t i = 0; i < list.count; ++i) of_label[list.label(i)].push_back({k, i});
    }
    for (std::uint32_t i = 0; i < mesh_.point_count(); ++i) points_of_block_[0].push_back(i);
    for (std::size_t g = 0; g < members_.size(); ++g) {
      const Group& group = mesh_.data()->groups[g];
      group_of_.try_emplace({group.dimension, group.number}, g);
    }
  }

  void write_piece(std::string_view piece) {
    const Label number = number_of(piece);
    switch (piece[0]) {
      case febio_text:
        out_.put(piece.substr(1));
        break;
      case febio_nodes:
        write_nodes(number);
        break;
      case febio_elements:  // the first of two blocks of one label has the elements of both
        if (labels_written_.insert(number).second) write_elements(number);
        break;
      case febio_materials:
        write_materials(piece.substr(std::min(piece.find(' '), piece.size())));
        break;
      case febio_list:
      case febio_tags:
      case febio_node_list:
      case febio_node_tags:
        write_members(piece);
        break;
      case febio_surface:
      case febio_label_surface:
        write_facets(piece[0] == febio_surface, number);
        break;
      default:
        break;
    }
  }

  /// Who changes labels may ask for one that the deck has no block for.
  void check_labels() const {
    for (const auto& [label, members] : of_label_) {
      const auto is_tet = [this](const GroupMembers::Member& member) {
        const int type = lists_.all()[member.list].kind.vtk_type;
        return type == vtk_tet || type == vtk_tet10;
      };
      const auto tets = std::count_if(members.begin(), members.end(), is_tet);
      if (tets == 0 || labels_written_.contains(label)) continue;
      throw Error(fmt::format("{} the label {}, and the deck has no block for it",
                              tets == 1 ? "a tet has" : fmt::format("{} tets have", tets), label));
    }
  }

  void write_nodes(Label block) {
    out_.put('\n');
    const std::vector<std::uint32_t>& points = points_of_block_[block];
    put_rows(out_, points.size(), [&](std::size_t row, OutputBuffer& buffer) {
      const std::uint32_t i = points[row];
      buffer.put(std::string_view("\t\t\t<node id=\""));
      buffer.put_integer(points_[i]);
      buffer.put(std::string_view("\">"));
      for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) buffer.put(',');
        buffer.put_real(mesh_.point(i)[axis]);
      }
      buffer.put(std::string_view("</node>\n"));
    });
    out_.put("\t\t");
  }

  /// Those of a block. @param vtk_type  0: tets of either order
  void write_elements(Label label, int vtk_type = 0) {
    out_.put('\n');
    std::vector<GroupMembers::Member> wanted;
    for (const GroupMembers::Member member : of_label_[label]) {
      const int type = lists_.all()[member.list].kind.vtk_type;
      const bool is_tet = type == vtk_tet || type == vtk_tet10;
      if (vtk_type == 0 ? is_tet : type == vtk_type) wanted.push_back(member);
    }
    put_rows(out_, wanted.size(), [&](std::size_t row, OutputBuffer& buffer) {
      const auto& [k, i] = wanted[row];
      buffer.put(std::string_view("\t\t\t<elem id=\""));
      buffer.put_integer(elements_[k][i]);
      buffer.put(std::string_view("\">"));
      put_vertices(buffer, lists_.all()[k].vertices(i));
      buffer.put(std::string_view("</elem>\n"));
    });
    out_.put("\t\t");
  }

  /// Tets that say their type and material, which is their label, by themselves.
  void write_materials(std::string_view text) {
    std::set<Label> labels;
    const char* const end = text.data() + text.size();
    for (const char* at = text.data(); at != end;) {
      Label label = 0;
      const auto [next, error] = std::from_chars(at + 1, end, label);
      if (error == std::errc() && labels_written_.insert(label).second) labels.insert(label);
      at = next;
    }
    out_.put('\n');
    for (std::size_t k = 0; k < lists_.all().size(); ++k) {
      const ElementList& list = lists_.all()[k];
      if (list.kind.vtk_type != vtk_tet && list.kind.vtk_type != vtk_tet10) continue;
      put_rows(out_, list.count, [&](std::size_t i, OutputBuffer& buffer) {
        if (!labels.contains(list.label(i))) return;
        const std::string_view type = febio_type(list.kind.vtk_type);
        buffer.put(
            fmt::format("\t\t\t<{} id=\"{}\" mat=\"{}\">", type, elements_[k][i], list.label(i)));
        put_vertices(buffer, list.vertices(i));
        buffer.put(fmt::format("</{}>\n", type));
      });
    }
    out_.put("\t\t");
  }

  void put_vertices(OutputBuffer& buffer, std::span<const std::uint32_t> vertices) const {
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      if (k > 0) buffer.put(',');
      buffer.put_integer(points_[vertices[k]]);
    }
  }

  /// A set, as one list or with an element of XML for each.
  void write_members(std::string_view piece) {
    const bool is_list = piece[0] == febio_list || piece[0] == febio_node_list;
    const std::string_view name = is_list ? std::string_view() : piece.substr(piece.find(' ') + 1);
    const bool of_nodes = piece[0] == febio_node_list || piece[0] == febio_node_tags;
    const GroupMembers* members = members_of(of_nodes ? 0 : 3, number_of(piece));
    out_.put('\n');
    if (members != nullptr && of_nodes) put_nodes_of(*members, name);
    if (members != nullptr && !of_nodes) put_elements_of(*members, name);
    out_.put("\t\t");
  }
  void put_elements_of(const GroupMembers& members, std::string_view name) {
    put_ids(members.elements.size(), name, [&](std::size_t i) {
      return elements_[members.elements[i].list][members.elements[i].index];
    });
  }
  void put_nodes_of(const GroupMembers& members, std::string_view name) {
    put_ids(members.points.size(), name, [&](std::size_t i) { return points_[members.points[i]]; });
  }

  void write_facets(bool is_group, Label number) {
    const GroupMembers* members = is_group ? members_of(2, number) : nullptr;
    out_.put('\n');
    if (members != nullptr) put_facets(members->elements);
    if (!is_group) put_facets(faces_of_label_[number]);
    out_.put("\t\t");
  }

  template <class IdOf>
  void put_ids(std::size_t count, std::string_view name, const IdOf& id_of) {
    constexpr std::size_t kOfLine = 8;
    put_rows(out_, count, [&](std::size_t i, OutputBuffer& buffer) {
      if (!name.empty()) return buffer.put(fmt::format("\t\t\t<{} id=\"{}\"/>\n", name, id_of(i)));
      const bool is_last = i + 1 == count;
      buffer.put(std::string_view(i % kOfLine == 0 ? "\t\t\t" : " "));
      buffer.put_integer(id_of(i));
      if (!is_last) buffer.put(',');
      if (is_last || i % kOfLine == kOfLine - 1) buffer.put('\n');
    });
  }

  // ---- A mesh of another format -------------------------------------------------------------------

  void write_new() {
    out_.put(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n\t<Mesh>\n");
    out_.put("\t\t<Nodes name=\"Nodes\">");
    write_nodes(0);
    out_.put("</Nodes>\n");
    std::set<const Group*> written;
    write_blocks(written);
    write_surfaces(written);
    write_sets(written);
    out_.put("\t</Mesh>\n</febio_spec>\n");
  }

  /// Sets of different kinds may have the same name.
  std::string name(const std::string& wanted, std::size_t dimension) {
    return xml_escaped(names_[dimension].make(wanted));
  }

  bool has_several_kinds(Label label) const {
    const auto& members = of_label_.at(label);
    return std::any_of(members.begin(), members.end(),
                       [&](const auto& member) { return member.list != members[0].list; });
  }

  /// A block for each kind and label of volumes.
  void write_blocks(std::set<const Group*>& written) {
    std::map<Label, const Group*> named;
    if (mesh_.data() != nullptr) named = LabelNames(*mesh_.data()).named(3);
    for (const ElementList* list : lists_.of_dimension(3)) {
      if (febio_type(list->kind.vtk_type).empty()) continue;
      std::set<Label> labels;  // a reader numbers what has a name by its place
      for (std::size_t i = 0; i < list->count; ++i) labels.insert(list->label(i));
      for (const Label label : labels) {
        auto found = named.find(label);
        if (has_several_kinds(label)) found = named.end();  // each block has a name of its own
        if (found != named.end()) written.insert(found->second);
        out_.put(
            fmt::format("\t\t<Elements type=\"{}\" name=\"{}\">", febio_type(list->kind.vtk_type),
                        name(found == named.end() ? label_name(label) : found->second->name, 3)));
        write_elements(label, list->kind.vtk_type);
        out_.put("</Elements>\n");
      }
    }
  }

  /// One for each label of triangles and quadrilaterals, and for each group that is none.
  void write_surfaces(std::set<const Group*>& written) {
    std::map<Label, const Group*> named;
    if (mesh_.data() != nullptr) named = LabelNames(*mesh_.data()).named(2);
    for (const auto& [label, members] : faces_of_label_) {
      const auto found = named.find(label);
      if (found != named.end()) written.insert(found->second);
      put_surface(found == named.end() ? label_name(label) : found->second->name, members);
    }
    for (std::size_t g = 0; g < members_.size(); ++g) {
      const Group& group = mesh_.data()->groups[g];
      if (group.dimension != 2 || group.name.empty() || written.contains(&group)) continue;
      put_surface(group.name, members_[g].elements);
    }
  }

  void put_surface(const std::string& of, const std::vector<GroupMembers::Member>& members) {
    out_.put(fmt::format("\t\t<Surface name=\"{}\">\n", name(of, 2)));
    put_facets(members);
    out_.put("\t\t</Surface>\n");
  }
  void put_facets(const std::vector<GroupMembers::Member>& members) {
    put_rows(out_, members.size(), [&](std::size_t i, OutputBuffer& buffer) {
      const ElementList& list = lists_.all()[members[i].list];
      const std::string_view type = febio_type(list.kind.vtk_type);
      buffer.put(fmt::format("\t\t\t<{} id=\"{}\">", type, i + 1));
      put_vertices(buffer, list.vertices(members[i].index));
      buffer.put(fmt::format("</{}>\n", type));
    });
  }

  void write_sets(const std::set<const Group*>& written) {
    for (std::size_t g = 0; g < members_.size(); ++g) {
      const Group& group = mesh_.data()->groups[g];
      if (group.name.empty() || written.contains(&group)) continue;
      if (group.dimension == 3) {
        out_.put(fmt::format("\t\t<ElementSet name=\"{}\">\n", name(group.name, 3)));
        put_elements_of(members_[g], {});
        out_.put("\t\t</ElementSet>\n");
      } else if (group.dimension == 0) {
        out_.put(fmt::format("\t\t<NodeSet name=\"{}\">\n", name(group.name, 0)));
        put_nodes_of(members_[g], {});
        out_.put("\t\t</NodeSet>\n");
      }
    }
  }

  OutputFile out_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::vector<std::int64_t> points_;                 // their ids
  std::vector<std::vector<std::int64_t>> elements_;  // of each list
  std::vector<GroupMembers> members_;
  std::map<std::pair<int, Label>, std::size_t> group_of_;        // by dimension and number
  std::map<Label, std::vector<GroupMembers::Member>> of_label_;  // volumes
  std::map<Label, std::vector<GroupMembers::Member>>
      faces_of_label_;              // triangles and quadrilaterals
  std::set<Label> labels_written_;  // of blocks of the deck
  std::map<Label, std::vector<std::uint32_t>> points_of_block_;
  std::array<UniqueNames, 4> names_;  // by dimension
};

}  // namespace

void write_febio(const std::filesystem::path& file, const MeshView& mesh) {
  FebioWriter(file, mesh).write();
}

}  // namespace tetmend::formats
