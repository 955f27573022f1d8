// SPDX-License-Identifier: MIT
// Reads input files of FEBio: the mesh by its XML, and what stands between as text.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/febio.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/pin_remarks.h"

namespace tetmend::formats {
namespace {

/// Types of volume elements that are known, and of higher order.
bool is_of_higher_order(std::string_view type) {
  return type == "tet15" || type == "tet20" || type == "hex27" || type == "tet5";
}

const ElementKind* kind_of_type(std::string_view type) {
  for (const FebioType& each : kFebioTypes) {
    if (each.name == type) return element_kind(each.vtk_type);
  }
  return nullptr;
}

class FebioReader {
 public:
  FebioReader(const InputFile& file, TetPlace* question)
      : file_(file), question_(question), sorter_(mesh_) {}

  MeshData read() {
    if (file_.size() == 0)
      file_.fail_at_line(file_.begin(), "the file is empty: expected a model of FEBio");
    parse();
    read_nodes();
    find_taken_labels();
    for (const pugi::xml_node node : model_.children("Elements")) read_elements(node);
    number_elements();
    for (const pugi::xml_node node : model_.children()) read_set(node);
    pin_rest();
    require_points();
    finish_sets();
    cut();
    mesh_.variant = kFebio;
    return std::move(mesh_);
  }

 private:
  // ---- XML ----------------------------------------------------------------------------------------

  const char* place_of(pugi::xml_node node) const { return file_.begin() + node.offset_debug(); }
  [[noreturn]] void fail(pugi::xml_node node, std::string_view reason) const {
    file_.fail_at_line(place_of(node), reason);
  }

  void parse() {
    const pugi::xml_parse_result result = document_.load_buffer(
        file_.begin(), file_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
      file_.fail_at_line(file_.begin() + std::min<std::size_t>(
                                             static_cast<std::size_t>(result.offset), file_.size()),
                         fmt::format("this is no XML: {}", result.description()));
    }
    const pugi::xml_node root = document_.child("febio_spec");
    if (!root)
      file_.fail_at_line(file_.begin(), "the file is no model of FEBio: expected <febio_spec>");
    model_ = root.child("Mesh") ? root.child("Mesh") : root.child("Geometry");
    if (!model_) fail(root, "the model has no mesh: expected <Mesh> or <Geometry>");
    if (model_.attribute("from")) fail(model_, "the mesh is in another file: expected it here");
    if (model_.child("Part")) fail(model_.child("Part"), "parts cannot be read: expected one mesh");
  }

  std::int64_t integer(std::string_view text, pugi::xml_node node, std::string_view what) const {
    std::int64_t value = 0;
    if (!nastran_integer(trimmed_field(text), value) || value < 1) {
      fail(node, fmt::format("{} is not a number from 1: expected {}", in_quotes(text), what));
    }
    return value;
  }
  std::int64_t id_of(pugi::xml_node node, std::string_view what) const {
    return integer(node.attribute("id").value(), node, what);
  }

  /// What stands between commas or blanks.
  static std::vector<std::string_view> words(std::string_view text) {
    constexpr std::string_view kBetween = ", \t\r\n";
    std::vector<std::string_view> found;
    for (std::size_t at = text.find_first_not_of(kBetween); at != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
      found.push_back(text.substr(at, end - at));
      at = text.find_first_not_of(kBetween, end);
    }
    return found;
  }

  // ---- Nodes --------------------------------------------------------------------------------------

  void read_nodes() {
    std::vector<const char*> places;
    for (const pugi::xml_node block : model_.children("Nodes")) {
      ElementSet set;
      set.name = block.attribute("name").value();
      for (const pugi::xml_node node : block.children("node")) {
        if (mesh_.points.size() == kMostVertices) fail(node, "the nodes are too many");
        set.points.push_back(static_cast<std::uint32_t>(mesh_.points.size()));
        mesh_.point_numbers.push_back(id_of(node, "the id of a node"));
        places.push_back(place_of(node));
        refuse_content(node);
        const auto numbers = words(node.child_value());
        Point& point = mesh_.points.emplace_back(Point::Zero());
        for (int axis = 0; axis < 3; ++axis) {
          const auto k = static_cast<std::size_t>(axis);
          if (numbers.size() == 3 && nastran_real(numbers[k], point[axis])) continue;
          fail(node, fmt::format("{} is no point: expected three finite coordinates",
                                 in_quotes(node.child_value())));
        }
      }
      const bool is_first = nodes_.empty();
      nodes_.push_back(block);
      replace(block, febio_nodes, is_first ? kNoSet : sets_.size());
      if (!is_first) sets_.push_back(std::move(set));
    }
    if (nodes_.empty()) fail(model_, "the mesh has no nodes: expected <Nodes>");
    tags_ = tags_of(mesh_.point_numbers, order_, places, "a node");
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
          fmt::format("the id '{}' of {} appears for the second time", ascending[i], what));
    }
    return GmshTags(std::move(ascending));
  }
  std::uint32_t find_point(std::int64_t number) const {
    const std::uint32_t found = tags_.find(number);
    return found == GmshTags::kNone ? found : order_[found];
  }

  // ---- Elements -----------------------------------------------------------------------------------

  void read_elements(pugi::xml_node block) {
    ElementSet set;
    set.name = block.attribute("name").value();
    if (block.attribute("elset")) set.name = block.attribute("elset").value();
    label_block(set.name);
    const std::string_view type_of_block = block.attribute("type").value();
    bool has_tets = false;
    bool has_others = false;
    for (const pugi::xml_node node : block.children()) {
      if (node.type() != pugi::node_element) continue;
      const std::string_view type = type_of_block.empty() ? node.name() : type_of_block;
      if (is_of_higher_order(type)) {
        fail(node, fmt::format("elements of type {} cannot be read: expected none of higher order",
                               in_quotes(type)));
      }
      const ElementKind* kind = kind_of_type(type);
      if (kind == nullptr) {
        pin_words(node, "Elements");
        has_others = true;
        continue;
      }
      add_element(node, *kind);
      set.elements.push_back(static_cast<std::uint32_t>(elements_.size() - 1));
      const bool is_tet = kind->vtk_type == vtk_tet || kind->vtk_type == vtk_tet10;
      if (!is_tet) pin_words(node, "Elements");
      (is_tet ? has_tets : has_others) = true;
    }
    if (has_tets && has_others)
      fail(block, "tets and others share a block: expected one type in each");
    if (has_tets) replace(block, febio_elements, kNoSet, label_);
    if (!set.name.empty() && !set.elements.empty()) sets_.push_back(std::move(set));
  }

  /// The place of the block, or what "Label_7" says.
  void label_block(std::string& name) {
    if (to_label(inp_key(name), label_)) {
      name.clear();
      return;
    }
    label_ = next_label_;
    while (taken_labels_.contains(label_)) ++label_;
    next_label_ = label_ + 1;
  }
  void find_taken_labels() {
    for (const pugi::xml_node block : model_.children("Elements")) {
      Label label = 0;
      if (to_label(inp_key(block.attribute("name").value()), label)) taken_labels_.insert(label);
    }
  }

  void add_element(pugi::xml_node node, const ElementKind& kind) {
    ElementRow row;
    row.kind = &kind;
    row.place = place_of(node);
    row.number = id_of(node, "the id of an element");
    row.label = label_;
    refuse_content(node);
    const auto numbers = words(node.child_value());
    if (numbers.size() != kind.width) {
      fail(node, fmt::format("the element has {} nodes: expected {}", numbers.size(), kind.width));
    }
    for (std::size_t k = 0; k < kind.width; ++k) row.vertices[k] = point(numbers[k], node);
    sorter_.add(row, true);
    if (question_ != nullptr && kind.vtk_type == vtk_tet &&
        mesh_.tets.size() == question_->tet + 1) {
      question_->place = file_.line_place(row.place);
    }
    elements_.push_back(last_place(mesh_, kind));
    element_numbers_.push_back(row.number);
    element_places_.push_back(row.place);
  }

  std::uint32_t point(std::string_view text, pugi::xml_node node) const {
    const std::uint32_t found = find_point(integer(text, node, "the id of a node"));
    if (found == GmshTags::kNone)
      fail(node, fmt::format("{} is not the id of a node", in_quotes(text)));
    return found;
  }

  void number_elements() {
    element_tags_ = tags_of(element_numbers_, element_order_, element_places_, "an element");
  }

  // ---- Sets ---------------------------------------------------------------------------------------

  void read_set(pugi::xml_node node) {
    const std::string_view name = node.name();
    ElementSet set;
    set.name = node.attribute("name").value();
    if (name == "NodeSet") {
      for (const std::int64_t number : ids(node)) {
        const std::uint32_t found = find_point(number);
        if (found != GmshTags::kNone) set.points.push_back(found);
      }
      read_node_set(node, set);
    } else if (name == "Surface") {
      Label label = 0;
      if (to_label(inp_key(set.name), label)) set.name.clear();
      for (const pugi::xml_node facet : node.children()) add_facet(facet, set, label);
      if (set.name.empty()) return;
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

  void add_facet(pugi::xml_node facet, ElementSet& set, Label label) {
    const ElementKind* kind = kind_of_type(facet.name());
    pin_words(facet, "Surface");
    if (kind == nullptr || kind->dimension != 2) return;
    ElementRow row;
    row.kind = element_kind(kind->corners == 3 ? vtk_triangle : vtk_quad);
    const auto numbers = words(facet.child_value());
    if (numbers.size() != kind->width) {
      fail(facet, fmt::format("the facet has {} nodes: expected {}", numbers.size(), kind->width));
    }
    row.label = label;
    for (std::size_t k = 0; k < kind->corners; ++k) row.vertices[k] = point(numbers[k], facet);
    set.elements.push_back(faces_.add(row, sorter_, mesh_, elements_));
  }

  /// Where it fills a volume it is written anew; other members stay.
  void read_node_set(pugi::xml_node node, ElementSet& set) {
    if (!loose_points_) loose_points_.emplace(mesh_);
    const std::vector<std::uint32_t> loose = loose_points_->of(set.points);
    if (!loose.empty()) {
      Pins& pins = pins_["NodeSet"];
      if (pins.first == nullptr) pins.first = place_of(node);
      ++pins.count;
      pins.points.insert(pins.points.end(), loose.begin(), loose.end());
    }
    if (loose.size() == set.points.size()) return;
    const pugi::xml_node child = first_element(node);
    replace(node, child ? febio_node_tags : febio_node_list, sets_.size(), 0, child.name());
  }
  static pugi::xml_node first_element(pugi::xml_node node) {
    return node.find_child([](pugi::xml_node each) { return each.type() == pugi::node_element; });
  }

  void read_element_set(pugi::xml_node node, ElementSet& set) {
    bool has_tets = false;
    std::size_t others = 0;
    for (const std::int64_t number : ids(node)) {
      const std::uint32_t found = element_tags_.find(number);
      if (found == GmshTags::kNone) {
        ++others;
        continue;
      }
      const std::uint32_t element = element_order_[found];
      const int type = elements_[element].of().vtk_type;
      has_tets = has_tets || type == vtk_tet || type == vtk_tet10;
      set.elements.push_back(element);
    }
    if (!has_tets) return;
    if (others > 0) {
      mesh_.notes.push_back(
          fmt::format("{} members of the set {} are not kept: they are no elements", others,
                      in_quotes(set.name)));
    }
    const pugi::xml_node child = first_element(node);
    replace(node, child ? febio_tags : febio_list, sets_.size(), 0, child.name());
  }

  void finish_sets() {
    number_sets(sets_);
    if (sets_.empty()) return;
    for (const ElementSet& set : sets_) {  // a triangle has the label of its first surface
      for (const std::uint32_t element : set.elements) {
        Label& label = label_at(mesh_, elements_[element]);
        if (label == 0) label = static_cast<Label>(set.number);
      }
    }
    add_groups(mesh_, elements_, {}, sets_);
  }

  // ---- Pins ---------------------------------------------------------------------------------------

  struct Pins {
    const char* first = nullptr;
    std::size_t count = 0;
    std::vector<std::uint32_t> points;
  };

  /// Points that the ids of an element of XML, or of its children, mean.
  void pin_words(pugi::xml_node node, std::string_view who) {
    if (node.type() != pugi::node_element) return;
    Pins& pins = pins_[std::string(who)];
    if (pins.first == nullptr) pins.first = place_of(node);
    ++pins.count;
    const auto add = [&](std::string_view text) {
      std::int64_t number = 0;
      if (!nastran_integer(text, number)) return;
      const std::uint32_t found = find_point(number);
      if (found != GmshTags::kNone) pins.points.push_back(found);
    };
    for (const std::string_view word : words(node.child_value())) add(word);
    for (const pugi::xml_node child : node.children()) {
      const std::string_view name = child.name();
      if (name == "node" || name == "n") add(child.attribute("id").value());
    }
  }

  /// Outside of the mesh: nodes, and facets of older versions.
  void pin_rest() {
    pugi::xml_node node = document_.document_element().first_child();
    const pugi::xml_node root = document_.document_element();
    while (node && node != root) {
      const std::string_view name = node.name();
      if (name == "node" && node.attribute("id")) pin_words_of_id(node);
      if (kind_of_type(name) != nullptr) pin_words(node, name);
      const bool names_elements = name == "ElementData" || (name == "elem" && node.attribute("id"));
      if (names_elements && node != model_ && !names_elements_) {
        names_elements_ = true;
        mesh_.notes.push_back(fmt::format(
            "<{}> names elements: where improving replaces them it must be made anew", name));
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
    const std::uint32_t found = find_point(number);
    if (found == GmshTags::kNone) return;
    Pins& pins = pins_["node"];
    if (pins.first == nullptr) pins.first = place_of(node);
    ++pins.count;
    pins.points.push_back(found);
  }

  void require_points() {
    std::vector<bool> is_required(mesh_.points.size(), false);
    std::vector<PinRemark> remarks;
    for (auto& [name, pins] : pins_) {
      std::sort(pins.points.begin(), pins.points.end());
      pins.points.erase(std::unique(pins.points.begin(), pins.points.end()), pins.points.end());
      for (const std::uint32_t point : pins.points) is_required[point] = true;
      if (pins.points.empty()) continue;
      remarks.push_back({&file_, pins.first, pins.count, "<" + name + ">", pins.points.size()});
    }
    for (std::uint32_t i = 0; i < is_required.size(); ++i) {
      if (is_required[i]) mesh_.required_vertices.push_back(i);
    }
    std::sort(remarks.begin(), remarks.end(),
              [](const PinRemark& a, const PinRemark& b) { return a.place < b.place; });
    remarks_ = pin_remarks_text(remarks, "kinds of elements");
  }

  // ---- The deck -----------------------------------------------------------------------------------

  static constexpr std::size_t kNoSet = SIZE_MAX;

  /// Content of an element of XML that is written anew.
  struct Replaced {
    const char* begin;
    const char* end;
    FebioPiece piece;
    std::size_t set;  ///< kNoSet: none
    Label label;
    std::string name;
  };

  /// Where "</name" begins, not one within a comment or the like; npos: nowhere.
  static std::size_t end_tag(std::string_view text, std::size_t at, std::string_view name) {
    constexpr std::array<std::array<std::string_view, 2>, 3> kSkipped = {
        {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
    const std::string tag = fmt::format("</{}", name);
    while ((at = text.find('<', at)) != std::string_view::npos) {
      const std::string_view rest = text.substr(at);
      if (rest.starts_with(tag)) return at;
      const auto skipped = std::find_if(kSkipped.begin(), kSkipped.end(), [&](const auto& each) {
        return rest.starts_with(each[0]);
      });
      at = skipped == kSkipped.end() ? at + 1 : text.find((*skipped)[1], at);
    }
    return at;
  }

  /// What is written anew is text alone.
  void refuse_content(pugi::xml_node node) const {
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      fail(child,
           fmt::format("<{}> holds another element of XML: expected numbers alone", node.name()));
    }
  }

  void replace(pugi::xml_node node, FebioPiece piece, std::size_t set, Label label = 0,
               std::string name = {}) {
    const std::string_view text(file_.begin(), file_.size());
    const auto tag = static_cast<std::size_t>(place_of(node) - file_.begin());
    char quote = '\0';
    std::size_t at = tag;
    for (; at < text.size() && (quote != '\0' || text[at] != '>'); ++at) {
      const char c = text[at];
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      }
    }
    if (at >= text.size() || text[at - 1] == '/') return;  // it has no content
    const std::size_t end = end_tag(text, at, node.name());
    if (end == std::string_view::npos) fail(node, "the end of the element of XML is not found");
    replaced_.push_back(
        {text.data() + at + 1, text.data() + end, piece, set, label, std::move(name)});
  }

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

  const InputFile& file_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  pugi::xml_document document_;
  pugi::xml_node model_;
  std::vector<pugi::xml_node> nodes_;  // blocks
  std::vector<std::uint32_t> order_, element_order_;
  GmshTags tags_, element_tags_;
  Label label_ = 0;  // of the present block
  Label next_label_ = 1;
  std::set<Label> taken_labels_;
  std::vector<ElementPlace> elements_;  // of blocks, then facets
  FacesOnce faces_;
  std::vector<std::int64_t> element_numbers_;
  std::vector<const char*> element_places_;
  std::vector<ElementSet> sets_;
  std::map<std::string, Pins> pins_;  // by the name of the element of XML
  bool names_elements_ = false;
  std::optional<LoosePoints> loose_points_;
  std::vector<Replaced> replaced_;
  std::string remarks_;
};

}  // namespace

MeshData read_febio(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return FebioReader(input, question).read();
}

}  // namespace tetmend::formats
