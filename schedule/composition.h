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
  angle,    ///< largest dihedral angle first: those of them that go most easily
  longest,  ///< longest first: the edges to split
  shortest
};

/// One operator, or several that are tried one after the other.
struct Composition {
  enum class Kind {
    one,       ///< the operator
    first_of,  ///< the parts in turn, until an attempt is accepted
    all_of,    ///< the parts in turn, until the tet is gone
    /// The first part, an operator, opens: it may make things worse. The others follow, each on the
    /// bad tets among all that has changed, the worst first. What came of it stays only if it is
    /// better as a whole; with a theta_max, if the largest angles are.
    sequence
  };
  Kind kind = Kind::one;
  std::string operator_name = {};  ///< of Kind::one
  ParameterSettings settings = {};
  EdgeOrder order = EdgeOrder::sine;
  unsigned most_edges = 6;        ///< of a tet that are tried, the first in that order
  double desperate = kDesperate;  ///< of a sequence: below this worst quality, a gain of 0.002
                                  ///< pays for one more bad tet
  /// Of a sequence, degrees. Below 180 it is tried on tets with a larger dihedral angle only, what
  /// follows works on such tets as well, and it stays if the sine of the largest angle of all that
  /// has changed gains 0.002 on the tet's, and as much for each more bad tet, and the worst tet
  /// gets no worse.
  double theta_max = 180;
  std::vector<Composition> parts = {};  ///< of the other kinds

  /// As a script writes it, settings left out: first_of(edge_removal, flip_2_3).
  std::string name() const;
  /// Equal for compositions that do the same.
  std::string describe() const;
};

/// A composition made ready. An operator, also one that opens a sequence, is tried on the tet
/// itself, or on its edges, faces or movable vertices, each that changed since the last time.
class TetAttempts {
 public:
  /// @throws Error for an unknown operator or parameter, a value out of range, a sequence that does
  /// not open with an operator, or a composition of more than 64 attempts at a tet.
  TetAttempts(const Registry& registry, const Composition& composition);

  /// Makes the attempts that the entry still has to do. False if some were deferred; these are
  /// noted in the entry.
  bool work_off(Worker& worker, QueuedTet& entry, Date since) const;
  /// What the operator is aimed at, or the one that opens the sequence.
  /// Precondition: the composition is one of these.
  TargetKind target_kind() const { return root_.leaf.op->info().target; }
  /// One attempt, which is counted. `tet` has the vertices of the tet that the target belongs to.
  /// Precondition: as for target_kind().
  Verdict attempt_once(Worker& worker, Target target, const TetVertices& tet) const;

 private:
  struct Leaf {
    std::unique_ptr<Operator> op;
    EdgeOrder order;
    unsigned most_edges;
    std::size_t number;  // of all leaves: has a memory of its own
    unsigned first_bit;  // in QueuedTet::todo
  };
  struct Node {
    Composition::Kind kind;
    Leaf leaf;                ///< of an operator; of a sequence, its opening
    std::vector<Node> parts;  ///< of a sequence, what follows
    double desperate;
    double theta_max;
    std::string settings;  ///< of a sequence: its parts, as a script writes them
  };
  struct Progress;

  Node build(const Registry& registry, const Composition& composition);
  static std::string script_of(const Leaf& leaf);
  static std::string script_of(const Node& node);
  static std::string script_of_parts(const Node& node);
  Leaf build_leaf(const Registry& registry, const Composition& composition);
  void run(const Node& node, Progress& progress) const;
  void run_leaf(const Node& node, Progress& progress) const;
  bool try_once(const Node& node, Progress& progress, Target target, unsigned bit,
                std::array<VertexHandle, 2> key) const;
  Verdict attempt(const Node& node, Worker& worker, Target target, const TetVertices& tet) const;
  Verdict attempt_sequence(const Node& node, Worker& worker, Target target,
                           const TetVertices& tet) const;
  Verdict try_sequence(const Node& node, Worker& worker, Target target,
                       const TetVertices& tet) const;
  bool follow_up(const Node& part, Worker& worker, const Transaction& sequence, Quality limit,
                 double blunt) const;
  static void forget(const Node& node, Worker& worker);

  std::size_t leaves_ = 0;
  unsigned bits_ = 0;
  Node root_;
};

}  // namespace tetmend
