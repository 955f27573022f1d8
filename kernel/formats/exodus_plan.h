// SPDX-License-Identifier: MIT
// How a mesh becomes blocks and sets of Exodus II.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/exodus.h"
#include "kernel/formats/unique_names.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// What stands behind "WHAT\0" in the deck of a mesh, which may be null.
std::vector<std::string> exodus_pieces(const MeshData* mesh, std::string_view what);

/// The variables of points, or of elements: arrays by their components, with names of their own.
/// Arrays of several lists that have one name are one.
class ExodusVariables {
 public:
  void add(const std::vector<DataArray>& arrays);
  /// Of the first component of arrays[a], which was added.
  std::size_t first(const std::vector<DataArray>& arrays, std::size_t a) const {
    return first_.at(key(arrays, a));
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  using Key = std::tuple<std::string, std::size_t, std::ptrdiff_t>;
  static Key key(const std::vector<DataArray>& arrays, std::size_t a);

  std::map<Key, std::size_t> first_;
  std::vector<std::string> names_;
  UniqueNames taken_{kExodusNames};
};

/// Which elements stand where in the file. The mesh and its lists must outlive it.
class ExodusPlan {
 public:
  ExodusPlan(const MeshView& mesh, const ElementLists& lists);

  /// Elements of one kind and label.
  struct Block {
    const ElementList* list = nullptr;
    std::uint32_t list_number = 0;
    Label label = 0;
    std::vector<std::uint32_t> elements;
    ElementSet set;  ///< its number and name
  };
  using Members = std::vector<GroupMembers::Member>;
  using Sets = std::vector<std::pair<ElementSet, Members>>;

  std::vector<Block> blocks;
  std::size_t count = 0;                          ///< of elements in blocks
  std::vector<std::vector<std::uint32_t>> place;  ///< of each list: in the file, from 1; 0: nowhere
  std::vector<ElementSet> node_sets;
  Sets side_sets, element_sets;

  /// Labels that are read again as others, 0 only where it becomes several: how many, and the first as "1 of kind 'edge'
  /// becomes 3".
  std::pair<std::size_t, std::string> new_labels() const;

  /// Of a member of a side set: the number of its volume in the file, and of its side, from 1.
  std::pair<std::int32_t, std::int32_t> side(const GroupMembers::Member& face) const;

 private:
  const Group& group(std::size_t g) const { return mesh_.data()->groups[g]; }
  void collect_blocks();
  void number_blocks();
  Block* block_of_group(const Members& elements);
  void collect_sets();
  void add_unnamed_faces(const std::vector<std::vector<bool>>& is_named);

  const MeshView& mesh_;
  const ElementLists& lists_;
  std::vector<GroupMembers> members_;
  std::vector<std::vector<bool>> is_side_;  // of each list: is a face of a volume
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> volume_of_;  // of faces
};

}  // namespace tetmend::formats
