// SPDX-License-Identifier: MIT
// The verb: an operator tries to improve the mesh at one target. Operators never walk the mesh; the
// schedule owns every loop.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/error.h"
#include "kernel/transaction.h"
#include "ops/parameters.h"
#include "ops/scratch.h"
#include "trace/trace_sink.h"
#include "trace/verdict.h"

namespace tetmend {

enum class TargetKind : std::uint8_t { tet, edge, face, vertex };

/// What an attempt is aimed at: a handle and its kind.
struct Target {
  TargetKind kind;
  std::uint32_t code;

  static Target of(TetHandle t) { return {TargetKind::tet, t.index()}; }
  static Target of(TetEdge e) { return {TargetKind::edge, e.code()}; }
  static Target of(HalfFace f) { return {TargetKind::face, f.code()}; }
  static Target of(VertexHandle v) { return {TargetKind::vertex, v.index()}; }
  /// Precondition of each: the kind is right.
  TetHandle tet() const { return TetHandle(code); }
  TetEdge edge() const { return TetEdge::from_code(code); }
  HalfFace face() const { return HalfFace::from_code(code); }
  VertexHandle vertex() const { return VertexHandle(code); }
};

/// All that an attempt may use. One for each worker.
struct OperatorContext {
  TetMesh& mesh;
  Workspace& workspace;
  Scratch& scratch;
  TraceSink* trace = nullptr;  ///< null: no trace
  unsigned level = 0;          ///< recursion level of the attempt that is made next
  /// The next attempt opens a sequence: it may make things worse, for what follows may make up for
  /// it. Whoever sets this judges the whole.
  bool opening = false;
};

class Operator;
class Registry;

/// How the registry knows an operator.
struct OperatorInfo {
  std::string_view name;
  TargetKind target;
  std::string_view help;  ///< one line
  std::span<const ParameterSpec> parameters;
  std::unique_ptr<Operator> (*make)(const ParameterValues&);
};

/// Base of all operators. Instances are immutable and may be shared by workers; what they need to
/// write lies in the context.
class Operator {
 public:
  explicit Operator(const OperatorInfo& info) : info_(info) {}
  virtual ~Operator() = default;
  Operator(const Operator&) = delete;
  Operator& operator=(const Operator&) = delete;

  const OperatorInfo& info() const { return info_; }
  /// File of the plugin that it comes from; empty for an operator of tetmend itself.
  const std::string& origin() const { return origin_; }
  /// Values of its parameters, as a script writes them.
  const std::string& settings() const { return settings_; }

  /// Tries the operator: precondition -> evaluate -> apply -> check -> keep or undo. Keeps the
  /// result only if is_improvement() says so, as a rule because the quality vector of all that
  /// changed improves, or if the context says that the attempt is an opening. After a
  /// refusal the mesh is what it was, bit by bit. Anything but `accepted` is `deferred` if the
  /// territory of the workspace was in the way. Precondition: the target is of the operator's
  /// kind, names a live entity and lies in that territory.
  /// @throws Error, with the mesh as it was, if a stage throws or edits what it must not: names the
  /// operator, its origin and the target.
  Verdict attempt(OperatorContext& context, Target target) const;

 protected:
  /// Cheap tests that need no search. Must not modify anything.
  virtual Verdict precondition(const OperatorContext& context, Target target) const = 0;
  /// Finds what to do and leaves it in the scratch. Must not modify the mesh.
  virtual Verdict evaluate(OperatorContext& context, Target target) const = 0;
  /// Makes the edits. Anything but `accepted` undoes them.
  virtual Verdict apply(OperatorContext& context, Target target,
                        Transaction& transaction) const = 0;
  /// Whether the edits are worth keeping; if not overridden, is_better(). Leaves the quality
  /// vectors in the scratch.
  virtual bool is_improvement(const Transaction& transaction, Scratch& scratch) const;

 private:
  friend class Registry;  // sets origin and settings

  Verdict run_stages(OperatorContext& context, Target target) const;
  Verdict try_target(OperatorContext& context, Target target) const;
  Error failure(Target target, std::string_view reason) const;

  const OperatorInfo& info_;
  std::string origin_;
  std::string settings_;
};

constexpr std::string_view to_string(TargetKind kind) {
  constexpr std::array<std::string_view, 4> kNames = {"tet", "edge", "face", "vertex"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// The verdict for an edit that was not made.
constexpr Verdict to_verdict(EditResult result) {
  switch (result) {
    case EditResult::made:
      return Verdict::accepted;
    case EditResult::inverted:
      return Verdict::inverted;
    case EditResult::constrained:
      return Verdict::constrained;
    case EditResult::not_closed:
      return Verdict::not_applicable;
    case EditResult::no_room:
      return Verdict::deferred;
  }
  return Verdict::not_applicable;
}

/// What the worst new tet must exceed when that of the old ones is `worst`. In an opening, only a
/// share of it: what follows cannot make up for more.
inline double required_quality(const OperatorContext& context, double worst) {
  constexpr double kHopefulShare = 0.2;
  return context.opening ? kHopefulShare * std::max(worst, 0.0) : worst;
}

/// True if all that the transaction changed is better now; leaves the qualities in the scratch, in
/// no particular order.
bool is_better(const Transaction& transaction, Scratch& scratch);

/// Tells the trace, which must not be null, how an attempt ended; with the vectors of the last
/// comparison if that decided: the scratch is empty when none was made.
void report_end(OperatorContext& context, Verdict verdict);

}  // namespace tetmend
