// SPDX-License-Identifier: MIT
#include "kernel/formats/febio_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {
namespace {

/// Types of volume elements that are known, and of higher order.
bool is_of_higher_order(std::string_view type) {
  return type == "tet15" || type == "tet20" || type == "hex27" || type == "tet5";
}

/// Where "</name" begins, not one within a comment or the like; npos: nowhere.
std::size_t end_tag(std::string_view text, std::size_t at, std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 3> kSkipped = {
      {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
  const std::string tag = fmt::format("</{}", name);
  while ((at = text.find('<', at)) != std::string_view::npos) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with(tag)) return at;
    const auto skipped = std::find_if(kSkipped.begin(), kSkipped.end(),
                                      [&](const auto& each) { return rest.starts_with(each[0]); });
    at = skipped == kSkipped.end() ? at + 1 : text.find((*skipped)[1], at);
  }
  return at;
}

}  // namespace

const ElementKind* febio_kind(std::string_view type) {
  for (const FebioType& each : kFebioTypes) {
    if (each.name == type) return element_kind(each.vtk_type);
  }
  return nullptr;
}

FebioMesh::FebioMesh(const InputFile& file, TetPlace* question)
    : file_(file), question_(question), sorter_(mesh_) {
  if (file_.size() == 0)
    file_.fail_at_line(file_.begin(), "the file is empty: expected a model of FEBio");
  parse();
  read_nodes();
  find_taken_labels();
  for (const pugi::xml_node node : model_.children("Elements")) read_elements(node);
  element_tags_ = index_of(element_numbers_, element_places_, "an element");
}

// ---- XML ------------------------------------------------------------------------------------------

void FebioMesh::parse() {
  const pugi::xml_parse_result result =
      document_.load_buffer(file_.begin(), file_.size(), pugi::parse_default, pugi::encoding_utf8);
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

std::int64_t FebioMesh::integer(std::string_view text, pugi::xml_node node,
                                std::string_view what) const {
  std::int64_t value = 0;
  if (!nastran_integer(trimmed_field(text), value) || value < 1) {
    fail(node, fmt::format("{} is not a number from 1: expected {}", in_quotes(text), what));
  }
  return value;
}
std::int64_t FebioMesh::id_of(pugi::xml_node node, std::string_view what) const {
  return integer(node.attribute("id").value(), node, what);
}

std::vector<std::string_view> FebioMesh::words(std::string_view text) {
  constexpr std::string_view kBetween = ", \t\r\n";
  std::vector<std::string_view> found;
  for (std::size_t at = text.find_first_not_of(kBetween); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
    found.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kBetween, end);
  }
  return found;
}

/// What is written anew is text alone.
void FebioMesh::refuse_content(pugi::xml_node node) const {
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    fail(child,
         fmt::format("<{}> holds another element of XML: expected numbers alone", node.name()));
  }
}

void FebioMesh::replace(pugi::xml_node node, FebioPiece piece, std::size_t set, Label label,
                        std::string name) {
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

// ---- Nodes ----------------------------------------------------------------------------------------

void FebioMesh::read_nodes() {
  std::vector<const char*> places;
  for (const pugi::xml_node block : model_.children("Nodes")) {
    const bool is_first = block == model_.child("Nodes");
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
    replace(block, febio_nodes, is_first ? kNoSet : sets_.size());
    if (!is_first) sets_.push_back(std::move(set));
  }
  if (!model_.child("Nodes")) fail(model_, "the mesh has no nodes: expected <Nodes>");
  tags_ = index_of(mesh_.point_numbers, places, "a node");
}

NumberIndex FebioMesh::index_of(const std::vector<std::int64_t>& numbers,
                                const std::vector<const char*>& places,
                                std::string_view what) const {
  return {numbers, [&](std::uint32_t i) {
            file_.fail_at_line(
                places[i],
                fmt::format("the id '{}' of {} appears for the second time", numbers[i], what));
          }};
}

std::uint32_t FebioMesh::point(std::string_view text, pugi::xml_node node) const {
  const std::uint32_t found = tags_.find(integer(text, node, "the id of a node"));
  if (found == NumberIndex::kNone)
    fail(node, fmt::format("{} is not the id of a node", in_quotes(text)));
  return found;
}

void FebioMesh::pin_words(pugi::xml_node node, std::string_view who) {
  if (node.type() != pugi::node_element) return;
  PointPins::Pins& pins = pins_.line_of(fmt::format("<{}>", who), place_of(node));
  const auto add = [&](std::string_view text) {
    std::int64_t number = 0;
    if (nastran_integer(text, number)) pin(pins, number);
  };
  for (const std::string_view word : words(node.child_value())) add(word);
  for (const pugi::xml_node child : node.children()) {
    const std::string_view name = child.name();
    if (name == "node" || name == "n") add(child.attribute("id").value());
  }
}

// ---- Elements -------------------------------------------------------------------------------------

void FebioMesh::read_elements(pugi::xml_node block) {
  ElementSet set;
  set.name = block.attribute("name").value();
  if (block.attribute("elset")) set.name = block.attribute("elset").value();
  const std::string_view type_of_block = block.attribute("type").value();
  if (!type_of_block.empty()) label_block(set.name);
  block_materials_.clear();
  bool has_tets = false;
  bool has_others = false;
  for (const pugi::xml_node node : block.children()) {
    if (node.type() != pugi::node_element) continue;
    const std::string_view type = type_of_block.empty() ? node.name() : type_of_block;
    if (is_of_higher_order(type)) {
      fail(node, fmt::format("elements of type {} cannot be read: expected none of higher order",
                             in_quotes(type)));
    }
    const ElementKind* kind = febio_kind(type);
    if (kind == nullptr) {
      pin_words(node, "Elements");
      has_others = true;
      continue;
    }
    if (type_of_block.empty()) label_by_material(node);
    add_element(node, *kind);
    set.elements.push_back(static_cast<std::uint32_t>(elements_.size() - 1));
    const bool is_tet = kind->vtk_type == vtk_tet || kind->vtk_type == vtk_tet10;
    // Of solids and quadrilaterals the mesh changes none; a surface that moves has other triangles.
    if (kind->corners == 3) pin_words(node, "Elements");
    (is_tet ? has_tets : has_others) = true;
  }
  if (has_tets && has_others)
    fail(block, "tets and others share a block: expected one type in each");
  if (has_tets && type_of_block.empty()) {
    replace(block, febio_materials, kNoSet, 0, fmt::format("{}", fmt::join(block_materials_, " ")));
  } else if (has_tets) {
    replace(block, febio_elements, kNoSet, label_);
  }
  if (!set.name.empty() && !set.elements.empty()) sets_.push_back(std::move(set));
}

/// Of an element that says its type, and its material, by itself.
void FebioMesh::label_by_material(pugi::xml_node node) {
  const std::int64_t material =
      integer(node.attribute("mat").value(), node, "the id of a material");
  if (material > INT32_MAX) fail(node, fmt::format("'{}' is no id of a material", material));
  label_ = static_cast<Label>(material);
  if (std::find(block_materials_.begin(), block_materials_.end(), label_) == block_materials_.end())
    block_materials_.push_back(label_);
}

/// The place of the block, or what "Label_7" says.
void FebioMesh::label_block(std::string& name) {
  if (to_label(inp_key(name), label_)) {
    name.clear();
    return;
  }
  label_ = next_label_;
  while (taken_labels_.contains(label_)) ++label_;
  next_label_ = label_ + 1;
}
void FebioMesh::find_taken_labels() {
  for (const pugi::xml_node block : model_.children("Elements")) {
    Label label = 0;
    if (to_label(inp_key(block.attribute("name").value()), label)) taken_labels_.insert(label);
    for (const pugi::xml_node node : block.children())
      taken_labels_.insert(node.attribute("mat").as_int());
  }
}

void FebioMesh::add_element(pugi::xml_node node, const ElementKind& kind) {
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
  if (is_last_asked_for(question_, mesh_, kind.vtk_type))
    question_->place = file_.line_place(row.place);
  elements_.push_back(last_place(mesh_, kind));
  element_numbers_.push_back(row.number);
  element_places_.push_back(row.place);
}

}  // namespace tetmend::formats
