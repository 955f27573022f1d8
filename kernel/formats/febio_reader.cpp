// SPDX-License-Identifier: MIT
// Reads input files of FEBio: sets and what names nodes, and what stands between as text.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/febio.h"
#include "kernel/formats/febio_mesh.h"
#include "kernel/formats/harmless_notes.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/second_order.h"

namespace tetmend::formats {
namespace {

class FebioReader : FebioMesh {
 public:
  using FebioMesh::FebioMesh;

  MeshData read() {
    for (const pugi::xml_node node : model_.children()) read_set(node);
    pin_rest();
    finish_sets();
    finish_surfaces();
    remarks_ = pins_.require_points(std::array{&file_}, tags_, "kinds of elements", mesh_);
    cut();
    mesh_.variant = kFebio;
    return std::move(mesh_);
  }

 private:
  // ---- Sets ---------------------------------------------------------------------------------------

  void read_set(pugi::xml_node node) {
    const std::string_view name = node.name();
    ElementSet set;
    set.name = node.attribute("name").value();
    if (name == "NodeSet") {
      const std::vector<std::int64_t> members = ids(node);
      for (const std::int64_t number : members) {
        const std::uint32_t found = tags_.find(number);
        if (found != NumberIndex::kNone) set.points.push_back(found);
      }
      read_node_set(node, set, members.size() - set.points.size());
    } else if (name == "Surface") {
      return read_surface(node, std::move(set));
    } else if (name == "ElementSet") {
      read_element_set(node, set);
    } else if (name != "Nodes" && name != "Elements") {
      pin_words(node, name);
      for (const pugi::xml_node child : node.children()) pin_words(child, name);
      return;
    } else {
      return;
    }
    if (!set.points.empty() || !set.elements.empty()) sets_.push_back(std::move(set));
  }

  /// A list, or an element of XML for each.
  std::vector<std::int64_t> ids(pugi::xml_node node) const {
    std::vector<std::int64_t> found;
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      found.push_back(id_of(child, "the id of a member"));
    }
    for (const std::string_view word : words(node.child_value())) {
      found.push_back(integer(word, node, "the id of a member"));
    }
    return found;
  }

  void read_surface(pugi::xml_node node, ElementSet set) {
    Surface surface{.node = node};
    const bool is_label = to_label(inp_key(set.name), surface.label);
    for (const pugi::xml_node facet : node.children()) {
      if (facet.type() != pugi::node_element) continue;
      surface.is_plain = add_facet(facet, set, surface.label) && surface.is_plain;
    }
    surface.count = set.elements.size();
    surface.is_plain = surface.is_plain && are_different(set.elements);
    if (!is_label && !set.name.empty() && !set.elements.empty()) {
      surface.set = sets_.size();
      sets_.push_back(std::move(set));
    } else if (is_label) {
      surface_labels_.push_back(surface.label);
    } else {
      surface.is_plain = false;
    }
    surfaces_.push_back(surface);
  }

  /// False if it says more than the element that is made of it.
  bool add_facet(pugi::xml_node facet, ElementSet& set, Label label) {
    const ElementKind* kind = febio_kind(facet.name());
    if (kind == nullptr || kind->dimension != 2) return false;
    ElementRow row;
    row.kind = element_kind(kind->corners == 3 ? vtk_triangle : vtk_quad);
    const auto numbers = words(facet.child_value());
    if (numbers.size() != kind->width) {
      fail(facet, fmt::format("the facet has {} nodes: expected {}", numbers.size(), kind->width));
    }
    row.label = label;
    for (std::size_t k = 0; k < kind->corners; ++k) row.vertices[k] = point(numbers[k], facet);
    const std::size_t before = elements_.size();
    set.elements.push_back(faces_.add(row, sorter_, mesh_, elements_));
    if (elements_.size() > before && is_last_asked_for(question_, mesh_, row.kind->vtk_type))
      question_->place = file_.line_place(place_of(facet));
    const bool has_id_alone =
        !facet.first_attribute() || (facet.first_attribute() == facet.last_attribute() &&
                                     std::string_view(facet.first_attribute().name()) == "id");
    return has_id_alone && has_mid_nodes_of_mesh(row, kind->width, numbers) &&
           is_turned_like(vertices_at(mesh_, elements_[set.elements.back()]),
                          std::span(row.vertices).first(kind->corners));
  }

  /// The nodes between its corners are those that tets have there.
  bool has_mid_nodes_of_mesh(const ElementRow& row, std::size_t width,
                             const std::vector<std::string_view>& numbers) {
    if (!mid_nodes_) mid_nodes_.emplace(mid_nodes_of_tets());
    const std::size_t corners = row.kind->corners;
    if (mid_nodes_->is_empty() || width == corners)
      return mid_nodes_->is_empty() == (width == corners);
    for (std::size_t k = 0; k < corners; ++k) {
      std::int64_t number = 0;
      const std::uint32_t node = mid_nodes_->of(row.vertices[k], row.vertices[(k + 1) % corners]);
      const bool is_node = node != kNoMidNode && nastran_integer(numbers[corners + k], number);
      if (!is_node || tags_.find(number) != node) return false;
    }
    return true;
  }
  /// None where tets of first order are beside them.
  std::vector<std::array<std::uint32_t, 3>> mid_nodes_of_tets() const {
    std::vector<std::array<std::uint32_t, 3>> nodes;
    for (const OtherElements& others : mesh_.other_elements) {
      if (others.vtk_type != vtk_tet10 || !mesh_.tets.empty()) continue;
      for (std::size_t i = 0; i < others.vertices.size(); i += others.vertex_count) {
        const std::uint32_t* v = others.vertices.data() + i;
        for (std::size_t e = 0; e < kMidNodeEdges.size(); ++e)
          nodes.push_back({v[kMidNodeEdges[e][0]], v[kMidNodeEdges[e][1]], v[4 + e]});
      }
    }
    return nodes;
  }

  /// Those that say no more than the mesh are written anew; the points of others stay.
  void finish_surfaces() {
    std::map<Label, std::size_t> faces_with;
    for (const ElementPlace& place : elements_) {
      if (place.of().dimension == 2) ++faces_with[label_at(mesh_, place)];
    }
    for (const Surface& surface : surfaces_) {
      const bool is_whole = surface.set != kNoSet || faces_with[surface.label] == surface.count;
      if (surface.is_plain && is_whole && !has_data_of_facets_) {
        const bool is_group = surface.set != kNoSet;
        replace(surface.node, is_group ? febio_surface : febio_label_surface, surface.set,
                surface.label);
        continue;
      }
      for (const pugi::xml_node facet : surface.node.children()) pin_words(facet, "Surface");
    }
  }

  /// Where it fills a volume it is written anew; other members stay.
  void read_node_set(pugi::xml_node node, ElementSet& set, std::size_t others) {
    if (!loose_points_) loose_points_.emplace(mesh_);
    const std::vector<std::uint32_t> loose = loose_points_->of(set.points);
    if (!loose.empty()) {
      PointPins::Pins& pins = pins_.line_of("<NodeSet>", place_of(node));
      for (const std::uint32_t v : loose) pin(pins, mesh_.point_numbers[v]);
    }
    if (loose.size() == set.points.size()) return;
    note_lost_members(others, set, "nodes");
    const pugi::xml_node child = first_element(node);
    replace(node, child ? febio_node_tags : febio_node_list, sets_.size(), 0, child.name());
  }
  static pugi::xml_node first_element(pugi::xml_node node) {
    return node.find_child([](pugi::xml_node each) { return each.type() == pugi::node_element; });
  }

  void note_lost_members(std::size_t lost, const ElementSet& set, std::string_view what) {
    if (lost == 0) return;
    mesh_.notes.push_back(fmt::format("{} members of the set {} are not kept: they are no {}", lost,
                                      in_quotes(set.name), what));
  }

  void read_element_set(pugi::xml_node node, ElementSet& set) {
    bool has_tets = false;
    std::size_t others = 0;
    for (const std::int64_t number : ids(node)) {
      const std::uint32_t element = element_tags_.find(number);
      if (element == NumberIndex::kNone) {
        ++others;
        continue;
      }
      const int type = elements_[element].of().vtk_type;
      has_tets = has_tets || type == vtk_tet || type == vtk_tet10;
      set.elements.push_back(element);
    }
    if (!has_tets) return;
    note_lost_members(others, set, "elements");
    const pugi::xml_node child = first_element(node);
    replace(node, child ? febio_tags : febio_list, sets_.size(), 0, child.name());
  }

  void finish_sets() {
    number_sets(sets_, surface_labels_);
    if (sets_.empty()) return;
    for (const ElementSet& set : sets_) {  // a triangle has the label of its first surface
      for (const std::uint32_t element : set.elements) {
        if (elements_[element].of().dimension == 3) continue;  // that of its block
        Label& label = label_at(mesh_, elements_[element]);
        if (label == 0) label = static_cast<Label>(set.number);
      }
    }
    add_groups(mesh_, elements_, {}, sets_);
  }

  // ---- Pins ---------------------------------------------------------------------------------------

  /// Outside of the mesh: nodes, and facets of older versions.
  void pin_rest() {
    pugi::xml_node node = document_.document_element().first_child();
    const pugi::xml_node root = document_.document_element();
    while (node && node != root) {
      const std::string_view name = node.name();
      if (name == "node" && node.attribute("id")) pin_words_of_id(node);
      if (febio_kind(name) != nullptr) pin_words(node, name);
      has_data_of_facets_ = has_data_of_facets_ || name == "SurfaceData";
      const bool names_elements = name == "ElementData" || (name == "elem" && node.attribute("id"));
      if (names_elements && node != model_ && !names_elements_) {
        names_elements_ = true;
        mesh_.notes.push_back(fmt::format("<{}> names elements: {}", name, kMustBeMadeAnew));
      }
      if (node.first_child() && node != model_) {
        node = node.first_child();
        continue;
      }
      while (node != root && !node.next_sibling()) node = node.parent();
      if (node != root) node = node.next_sibling();
    }
  }
  void pin_words_of_id(pugi::xml_node node) {
    std::int64_t number = 0;
    if (!nastran_integer(node.attribute("id").value(), number)) return;
    if (tags_.find(number) == NumberIndex::kNone) return;
    pin(pins_.line_of("<node>", place_of(node)), number);
  }

  // ---- The deck -----------------------------------------------------------------------------------

  void cut() {
    mesh_.deck.push_back(std::move(remarks_));
    std::sort(replaced_.begin(), replaced_.end(),
              [](const Replaced& a, const Replaced& b) { return a.begin < b.begin; });
    const char* at = file_.begin();
    for (const Replaced& each : replaced_) {
      mesh_.deck.push_back(char{febio_text} + std::string(at, each.begin));
      const std::int64_t number = each.set == kNoSet ? each.label : sets_[each.set].number;
      mesh_.deck.push_back(
          fmt::format("{}{} {}", static_cast<char>(each.piece), number, each.name));
      at = each.end;
    }
    mesh_.deck.push_back(char{febio_text} + std::string(at, file_.end()));
  }

  /// As it stands in the model.
  struct Surface {
    pugi::xml_node node;
    std::size_t set = kNoSet;  ///< kNoSet: its facets have a label
    Label label = 0;
    std::size_t count = 0;  ///< of facets
    bool is_plain = true;   ///< it says no more than the elements that are made of it
  };

  FacesOnce faces_;
  std::vector<Surface> surfaces_;
  std::vector<std::int64_t> surface_labels_;
  std::optional<MidNodes> mid_nodes_;  // of tets
  bool has_data_of_facets_ = false;    // by their order
  bool names_elements_ = false;
  std::optional<LoosePoints> loose_points_;
  std::string remarks_;
};

}  // namespace

MeshData read_febio(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return FebioReader(input, question).read();
}

}  // namespace tetmend::formats
