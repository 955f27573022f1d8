// SPDX-License-Identifier: MIT
// What an Abaqus deck needs to know of a mesh before it is written: which element goes into which
// block and which set, all numbers, and the tets behind the faces of surfaces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "kernel/formats/inp_deck.h"
#include "kernel/formats/inp_types.h"
#include "kernel/formats/new_numbers.h"
#include "kernel/formats/unique_names.h"
#include "kernel/grouping.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// Elements of one cell type, as arrays of the mesh.
struct InpKind {
  int vtk_type = 0;
  int dimension = 0;
  std::size_t width = 0;
  std::size_t count = 0;
  const std::uint32_t* vertices = nullptr;
  std::size_t stride = 0;
  const Label* labels = nullptr;
  std::size_t label_stride = 0;
  const std::vector<Label>* parts = nullptr;  ///< may be null or empty
  const std::vector<std::int64_t>* given_numbers = nullptr;
  bool is_first_order = false;  ///< tets, triangles, edges: groups may list them as members
  std::vector<std::int64_t> numbers;
  std::vector<std::uint32_t> class_of;
  Grouping by_class;

  const std::uint32_t* of(std::size_t i) const { return vertices + i * stride; }
  Label label(std::size_t i) const { return labels[i * label_stride]; }
  bool is_triangle() const { return vtk_type == kVtkTriangle || vtk_type == kVtkTriangle6; }
  bool is_tet() const { return vtk_type == kVtkTet || vtk_type == kVtkTet10; }
};

/// A set of a deck, or a surface.
struct InpOutGroup {
  int dimension = 0;  ///< 10 more: for a label that is the number of another group
  Label number = 0;
  std::string name;
  const Group* group = nullptr;  ///< null: made of a label
};

/// Elements that go the same ways.
struct InpClass {
  std::size_t kind = 0;
  Label block = 0;  ///< 0: no element, only a face
  std::vector<std::size_t> groups;
};

class InpPlan {
 public:
  explicit InpPlan(const MeshView& mesh);
  InpPlan(const InpPlan&) = delete;
  InpPlan& operator=(const InpPlan&) = delete;

  InpDeck deck;  ///< of the mesh, or made for it
  std::vector<InpKind> kinds;
  std::vector<InpClass> classes;
  std::vector<InpOutGroup> groups;
  std::vector<std::int64_t> point_numbers;

  struct Owner {
    std::size_t kind = 0;
    std::size_t element = 0;
    int face = 0;  ///< 1 to 4; 0: no tet has it
  };
  /// The tet behind each triangle of a kind.
  const std::vector<Owner>& owners(std::size_t kind) const { return owners_.at(kind); }

  bool is_home(Label block, std::size_t group) const;
  /// Numbers of the elements of some groups that are not in a block of theirs, in ascending order.
  std::vector<std::int64_t> elements_of(const std::vector<InpGroupName>& names) const;
  std::vector<std::int64_t> nodes_of(const InpGroupName& name) const;
  /// The points of one of the numberings of the deck; none where there is but one.
  std::span<const std::uint32_t> points_of(std::size_t numbering) const {
    if (numbering_of_point_.empty()) return {};
    return points_of_numbering_.group(static_cast<std::uint32_t>(numbering));
  }
  /// {tet, face} of the faces of a group.
  std::vector<std::pair<std::int64_t, int>> faces_of(const InpGroupName& name) const;
  struct Row {
    std::uint32_t kind = 0;
    std::uint32_t element = 0;
  };
  /// Elements of a block, in the order of the mesh.
  std::vector<Row> rows_of(Label block) const;

 private:
  class SetMaker;

  void add_kinds();
  void find_owners();
  void assign();
  void assign_kind(std::size_t kind);
  std::size_t make_class(std::size_t kind, Label part, Label label,
                         const std::vector<Label>& members, bool is_face);
  std::size_t label_group(int dimension, Label label);
  Label block_for(const InpKind& kind, Label part, const std::vector<std::size_t>& in);
  Label new_block(int vtk_type, const std::vector<std::size_t>& in);
  void number_points();
  void number_elements();
  bool has_good_numbers() const;
  std::size_t numbering_of(std::int64_t number, std::int64_t InpNumbering::*offset) const;
  std::size_t numbering_of_block(Label block) const {
    const auto found = numbering_of_block_.find(block);
    return found == numbering_of_block_.end() ? 0 : found->second;
  }
  void find_numberings_of_points();
  NewNumbers new_numbers(std::int64_t most, std::span<const std::int64_t> known,
                         std::span<const NumberRange> of_file) const;
  std::vector<NumberRange> taken_in(std::size_t numbering,
                                    std::vector<NumberRange> MeshData::*all) const;
  void add_missing_sets();
  void place_new(std::vector<InpPiece> pieces);
  std::size_t find_group(const InpGroupName& name) const;
  void index_classes();
  /// Sorted; none twice. The points may come in any order, and several times.
  std::vector<std::int64_t> numbers_of_points(std::vector<std::uint32_t> points) const;

  const MeshView& mesh_;
  const MeshData* data_;
  bool has_deck_ = false;
  std::vector<MeshData::Tet> own_tets_;
  std::map<std::size_t, std::vector<Owner>> owners_;
  std::map<Label, Label> block_of_part_;
  std::map<Label, const InpPiece*> piece_of_block_;
  std::map<Label, int> type_of_block_;
  std::map<Label, std::size_t> numbering_of_block_;
  std::vector<std::uint32_t> numbering_of_point_;  // empty: there is but one
  Grouping points_of_numbering_;
  std::map<Label, std::vector<InpGroupName>> home_of_block_;
  std::map<std::pair<int, std::vector<std::size_t>>, Label> new_blocks_;
  std::map<std::pair<int, Label>, std::vector<std::size_t>> groups_of_part_;
  std::map<std::pair<int, Label>, std::size_t> group_of_label_;
  std::map<InpGroupName, std::size_t> group_of_name_;
  std::vector<std::vector<std::size_t>> classes_of_group_;  // in ascending order
  std::map<Label, std::vector<std::size_t>> classes_of_block_;
  std::map<Label, std::vector<std::uint32_t>> points_of_label_;
  std::vector<InpPiece> new_elements_;
  Label next_block_ = 0;
};

/// A name that Abaqus and CalculiX take, unlike all of `taken` in capitals, to which it is added.
std::string inp_name(std::string_view name, UniqueNames& taken);

}  // namespace tetmend::formats
