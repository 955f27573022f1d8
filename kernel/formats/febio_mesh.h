// SPDX-License-Identifier: MIT
// The nodes and elements of a model of FEBio.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/febio.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/number_index.h"
#include "kernel/formats/point_pins.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

const ElementKind* febio_kind(std::string_view type);

/// What a reader of sets, and of what names nodes, begins with. It works on the file's own bytes.
class FebioMesh {
 public:
  /// @throws Error for what is no model, and one without nodes
  FebioMesh(const InputFile& file, TetPlace* question);

 protected:
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

  const char* place_of(pugi::xml_node node) const { return file_.begin() + node.offset_debug(); }
  [[noreturn]] void fail(pugi::xml_node node, std::string_view reason) const {
    file_.fail_at_line(place_of(node), reason);
  }
  std::int64_t integer(std::string_view text, pugi::xml_node node, std::string_view what) const;
  std::int64_t id_of(pugi::xml_node node, std::string_view what) const;
  /// What stands between commas or blanks.
  static std::vector<std::string_view> words(std::string_view text);
  /// The node that a text names.
  std::uint32_t point(std::string_view text, pugi::xml_node node) const;
  /// Points that the ids of an element of XML, or of its children, mean, stay where they are.
  void pin_words(pugi::xml_node node, std::string_view who);
  void pin(PointPins::Pins& pins, std::int64_t node) const {
    pins.ranges.push_back(tags_.range(node, node));
  }
  void replace(pugi::xml_node node, FebioPiece piece, std::size_t set, Label label = 0,
               std::string name = {});

  const InputFile& file_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  pugi::xml_document document_;
  pugi::xml_node model_;
  NumberIndex tags_, element_tags_;     // of nodes, of elements
  std::vector<ElementPlace> elements_;  // of blocks
  std::vector<ElementSet> sets_;
  PointPins pins_;  // by the name of the element of XML
  std::vector<Replaced> replaced_;

 private:
  void parse();
  void read_nodes();
  void read_elements(pugi::xml_node block);
  void label_block(std::string& name);
  void label_by_material(pugi::xml_node node);
  void find_taken_labels();
  void add_element(pugi::xml_node node, const ElementKind& kind);
  void refuse_content(pugi::xml_node node) const;
  NumberIndex index_of(const std::vector<std::int64_t>& numbers,
                       const std::vector<const char*>& places, std::string_view what) const;

  Label label_ = 0;                     // of the present block, or element
  std::vector<Label> block_materials_;  // of the present block
  Label next_label_ = 1;
  std::set<Label> taken_labels_;
  std::vector<std::int64_t> element_numbers_;
  std::vector<const char*> element_places_;
};

}  // namespace tetmend::formats
