// SPDX-License-Identifier: MIT
// The sets of nodes and elements of an Abaqus deck.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "kernel/formats/inp_deck.h"
#include "kernel/formats/inp_fields.h"
#include "kernel/formats/inp_mesh.h"

namespace tetmend::formats {

struct InpSet {
  /// What a member takes, where it becomes part of a mesh: see is_bomb().
  static constexpr std::size_t kBytesOfMember = 16;

  std::string key;
  std::string name;  ///< as it stands there first
  bool of_nodes = false;
  std::size_t scope = 0;               ///< of its members
  std::size_t instance = 0;            ///< of a set of the assembly, from 1; 0: none
  std::vector<std::uint32_t> members;  ///< points, or elements of the mesh; in ascending order
  std::vector<std::int64_t> others;    ///< numbers of elements that are not in the mesh
  std::size_t unique = 0;              ///< how many of the members differ, as far as that is known
  bool is_listed = false;              ///< by *NSET or *ELSET
  bool is_internal = false;
  bool is_unsorted = false;  ///< its nodes have an order: the lines stay, and so do the nodes
  bool is_kept = true;
  Label number = 0;  ///< of its groups
  std::vector<InpGroupName> groups;
};

/// "Label_7" names what has the label 7, and has no other name: "Label_m7" is -7. So does "Label_7_2",
/// where something else has that name. False for others.
bool to_label(std::string_view key, Label& label);
std::string label_name(Label label);

class InpSets {
 public:
  InpSets(const InpLines& lines, const InpMesh& mesh);

  std::deque<InpSet> all;          ///< in the order of the deck, those of *NODE and *ELEMENT first
  std::vector<std::string> notes;  ///< of what lines name that is not there, one sentence each

  /// The sets that a line of this block means, one for each instance that an assembly has one for.
  /// The name may have the prefix of an instance.
  std::vector<InpSet*> find_all(bool of_nodes, std::string_view name, const InpBlock& where) const;
  /// The first of them; null if there is none.
  InpSet* find(bool of_nodes, std::string_view name, const InpBlock& where) const {
    const std::vector<InpSet*> found = find_all(of_nodes, name, where);
    return found.empty() ? nullptr : found[0];
  }
  /// The set that a *NSET, *ELSET, *NODE or *ELEMENT block adds to; null if it names none.
  InpSet* of_block(const InpBlock& block);
  /// Counts members that no number of a line names. @throws Error where they are too many
  void add_work(std::size_t members, const InpBlock& block);

 private:
  /// Of nodes; the scope, or none: in the assembly; name. There each instance has a set of its own.
  using Key = std::tuple<bool, std::size_t, std::string>;
  static constexpr std::size_t kAssembly = SIZE_MAX;

  InpSet& named(bool of_nodes, const InpBlock& block, std::string_view name);
  const InpSet* find_beside(const InpSet& set, bool of_nodes, std::string_view name,
                            const InpBlock& where) const;
  void read(const InpBlock& block);
  void read_range(InpFields& fields, const InpBlock& block, InpSet& set);
  void read_members(InpFields& fields, const InpBlock& block, InpSet& set);
  void add_nodes_of(const InpBlock& block, InpSet& set);
  const InpNumbers& numbers(const InpSet& set) const {
    return set.of_nodes ? mesh_.nodes : mesh_.elements;
  }

  const InpLines& lines_;
  const InpMesh& mesh_;
  std::map<Key, std::vector<InpSet*>> by_key_;
  std::map<std::pair<Key, std::size_t>, InpSet*> by_instance_;
  std::size_t work_ = 0;  // members that no number of a line names
};

/// *NSET or *ELSET that lists members of the mesh: not the reference points of an assembly.
bool is_set_block(const InpBlock& block);

}  // namespace tetmend::formats
