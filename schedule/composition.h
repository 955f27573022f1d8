// SPDX-License-Identifier: MIT
// What is tried at one tet: operators, nested.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ops/registry.h"
#include "schedule/pass_options.h"
#include "schedule/queue.h"
#include "schedule/worker.h"

namespace tetmend {

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
