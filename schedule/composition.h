// SPDX-License-Identifier: MIT
// What is tried at one tet: operators, nested.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ops/registry.h"
#include "schedule/queue.h"
#include "schedule/worker.h"

namespace tetmend {

/// In which order the edges of a tet are tried.
enum class EdgeOrder {
  sine,     ///< lowest sine of the dihedral angle first: the edges to get rid of
  longest,  ///< longest first: the edges to split
  shortest
};

/// One operator, or several that are tried one after the other.
struct Composition {
  enum class Kind {
    one,       ///< the operator
    first_of,  ///< the parts in turn, until an attempt is accepted
    all_of     ///< the parts in turn, until the tet is gone
  };
  Kind kind = Kind::one;
  std::string operator_name = {};  ///< of Kind::one
  ParameterSettings settings = {};
  EdgeOrder order = EdgeOrder::sine;
  std::vector<Composition> parts = {};  ///< of the other kinds

  /// As a script writes it, settings left out: first_of(edge_removal, flip_2_3).
  std::string name() const;
  /// Equal for compositions that do the same.
  std::string describe() const;
};

/// A composition made ready. An operator is tried on the tet itself, or on its edges, faces or
/// movable vertices, each that changed since the last time.
class TetAttempts {
 public:
  /// @throws Error for an unknown operator or parameter, a value out of range, or a composition of
  /// more than 64 attempts at a tet.
  TetAttempts(const Registry& registry, const Composition& composition);

  /// Makes the attempts that the entry still has to do. False if some were deferred; these are
  /// noted in the entry.
  bool work_off(Worker& worker, QueuedTet& entry, Date since) const;

 private:
  struct Leaf {
    std::unique_ptr<Operator> op;
    EdgeOrder order;
    std::size_t number;  // of all leaves: has a memory of its own
    unsigned first_bit;  // in QueuedTet::todo
  };
  struct Node {
    Composition::Kind kind;
    Leaf leaf;
    std::vector<Node> parts;
  };
  struct Progress;

  Node build(const Registry& registry, const Composition& composition);
  void run(const Node& node, Progress& progress) const;
  void run_leaf(const Leaf& leaf, Progress& progress) const;
  bool try_once(const Leaf& leaf, Progress& progress, Target target, unsigned bit,
                std::array<VertexHandle, 2> key) const;

  std::size_t leaves_ = 0;
  unsigned bits_ = 0;
  Node root_;
};

}  // namespace tetmend
