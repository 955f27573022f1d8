// SPDX-License-Identifier: MIT
// Sets of points and elements that a file lists by number: as groups of a mesh, and from them again.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "kernel/formats/element_rows.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Where an element of a file went.
struct ElementPlace {
  std::uint8_t kind = 0;  ///< of kElementKinds
  std::uint32_t index = 0;

  const ElementKind& of() const { return kElementKinds[kind]; }
};

/// The place of an element that is not kept.
inline constexpr std::uint32_t kNoPlace = UINT32_MAX;

/// Of the element of this kind that an ElementSorter added last.
ElementPlace last_place(const MeshData& mesh, const ElementKind& kind);
/// The label of an element. Precondition: the mesh has it.
Label& label_at(MeshData& mesh, ElementPlace place);
/// Likewise its vertices.
std::span<const std::uint32_t> vertices_at(const MeshData& mesh, ElementPlace place);

/// Is one list the other from a later corner on? So faces have the same sides.
bool is_turned_like(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);
bool are_different(std::vector<std::uint32_t> members);

/// Faces that several sets of a file name, each once.
class FacesOnce {
 public:
  /// Adds a triangle or quadrilateral, or finds the one with these corners.
  /// @return its place in `elements`, where a new one goes to the end
  std::uint32_t add(const ElementRow& row, ElementSorter& sorter, const MeshData& mesh,
                    std::vector<ElementPlace>& elements);

 private:
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> known_;
};

/// Sets of points that fill a volume take in new points there; others keep their points.
class LoosePoints {
 public:
  /// Of the tets of either order that a mesh has.
  explicit LoosePoints(const MeshData& mesh);
  /// The members that belong to no tet with all four corners in the set. Cost: linear in the tets
  /// around the members.
  std::vector<std::uint32_t> of(const std::vector<std::uint32_t>& members);

 private:
  std::vector<std::array<std::uint32_t, 4>> corners_;  // of tets
  std::vector<std::size_t> first_;                     // of each point in tets_, then the end
  std::vector<std::uint32_t> tets_;
  std::vector<char> is_member_;
};

struct ElementSet {
  std::int64_t number = 0;  ///< as the file has it
  std::string name;
  std::vector<std::uint32_t> points;
  std::vector<std::uint32_t> elements;  ///< places in a list of ElementPlace
};

/// Gives each set a number of 1 or more that no other has: its own, where it is the first with it.
/// @param avoided  a new number is none of these
void number_sets(std::vector<ElementSet>& sets, std::span<const std::int64_t> avoided = {});

/// Makes a group of each set, in each dimension that it has members of, and parts of the elements:
/// those of one part are in the same sets, and have the same home. So faces between sets stay.
/// @param homes  of each element; empty: one for all
/// @param sets  numbered. Their members are sorted
/// Of an empty set a note is made. Cost: linear in elements and members, but for sorting these.
void add_groups(MeshData& mesh, std::span<const ElementPlace> elements,
                std::span<const std::uint32_t> homes, std::vector<ElementSet>& sets);

/// The other way round: what is in a group. Elements are places in a list of lists.
struct GroupMembers {
  struct Member {
    std::uint32_t list;  ///< of ElementLists::all()
    std::uint32_t index;
  };
  std::vector<std::uint32_t> points;
  std::vector<Member> elements;
};

/// Of each group of the data that `mesh` shows, in their order. Cost: linear in elements and members.
std::vector<GroupMembers> members_of_groups(const MeshView& mesh, const ElementLists& lists);

/// The number of each point or element of a file that keeps them: as they came, others above the
/// greatest that there was. Where two elements of any kind have one number, all are numbered anew.
/// @param limits  see NewNumbers
std::vector<std::int64_t> written_point_numbers(const MeshView& mesh,
                                                std::span<const std::int64_t> limits);
/// Of each list of `lists`.
std::vector<std::vector<std::int64_t>> written_element_numbers(
    const ElementLists& lists, std::span<const std::int64_t> limits);

}  // namespace tetmend::formats
