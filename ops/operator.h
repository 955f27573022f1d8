// SPDX-License-Identifier: MIT
// The verb: an operator tries to improve the mesh at one target. Operators never walk the mesh; the
// schedule owns every loop.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include <tetmend/api.h>

#include "kernel/error.h"
#include "kernel/judge.h"
#include "kernel/star.h"
#include "kernel/transaction.h"
#include "ops/parameters.h"
#include "ops/target.h"
#include "trace/trace_sink.h"
#include "trace/verdict.h"

namespace tetmend {

class Operator;
class Registry;

/// What one operator remembers from stage to stage, and its buffers; see OperatorOf.
class TETMEND_API OperatorState {
 public:
  virtual ~OperatorState() = default;
};

/// The states of all operators of one worker, so that an attempt takes no memory from the heap.
class TETMEND_API OperatorStates {
 public:
  /// That of an operator, made when it is first asked for. Operators of one class share it.
  OperatorState& of(const Operator& op);

  Comparison comparison;  ///< what the last judge looked at

 private:
  struct Entry {
    const std::type_info* type;
    std::unique_ptr<OperatorState> state;
  };
  std::vector<Entry> entries_;
};

/// All that an attempt may use. One for each worker.
struct TETMEND_API OperatorContext {
  TetMesh& mesh;
  Workspace& workspace;
  OperatorStates& states;
  TraceSink* trace = nullptr;    ///< null: no trace
  unsigned level = 0;            ///< recursion level of the attempt that is made next
  const Judge* judge = nullptr;  ///< null: each operator's own; in its stages never null
};

/// How the registry knows an operator.
struct TETMEND_API OperatorInfo {
  std::string_view name;
  TargetKind target;
  std::string_view help;  ///< one line
  std::span<const ParameterSpec> parameters;
  std::unique_ptr<Operator> (*make)(const ParameterValues&);
  /// Of an operator on vertices: it works on those of a surface that may change, too. Passes leave
  /// out the fixed vertices otherwise.
  bool at_surface = false;
};

/// One more tet would be refused, whatever it brings: for operators that make the mesh grow. What opens
/// a sequence may: what follows can remove tets.
TETMEND_API bool has_no_room(const OperatorContext& context);

/// Whether an operator on vertices is to be tried on one.
inline bool is_worth_a_try(bool at_surface, const TetMesh& mesh, VertexHandle v) {
  if (!mesh.is_fixed(v)) return true;
  return at_surface && mesh.surface_guard() != nullptr && !mesh.is_frozen(v);
}

/// Base of all operators. Instances are immutable and may be shared by workers; what they need to
/// write lies in their state. Derive from OperatorOf.
class TETMEND_API Operator {
 public:
  virtual ~Operator() = default;
  Operator(const Operator&) = delete;
  Operator& operator=(const Operator&) = delete;

  const OperatorInfo& info() const { return info_; }
  /// File of the plugin that it comes from; empty for an operator of tetmend itself.
  const std::string& origin() const { return origin_; }
  /// Values of its parameters, as a script writes them.
  const std::string& settings() const { return settings_; }
  /// Decides about its attempts unless the context names another one.
  const Judge& judge() const { return judge_; }

  /// Tries the operator: precondition -> evaluate -> apply -> judge -> keep or undo; while
  /// propose_next() has another proposal, apply and judge again. After a refusal the mesh is what it
  /// was, bit for bit. Anything but `accepted` is `deferred` if the territory of the workspace was
  /// in the way. Precondition: the target is of the operator's kind, names a live entity and lies in
  /// that territory.
  /// @throws Error, with the mesh as it was, if a stage throws or edits what it must not: names the
  /// operator, its origin and the target.
  Verdict attempt(OperatorContext& context, Target target) const;

 protected:
  Operator(const OperatorInfo& info, const Judge& judge) : info_(info), judge_(judge) {}

 private:
  friend class OperatorStates;
  friend class Registry;  // sets origin and settings

  // The stages of OperatorOf, whatever its state.
  virtual std::unique_ptr<OperatorState> make_state() const = 0;
  virtual Verdict precondition_in(const OperatorContext&, Target, OperatorState&) const = 0;
  virtual Verdict evaluate_in(OperatorContext&, Target, OperatorState&) const = 0;
  virtual Verdict apply_in(OperatorContext&, Target, Transaction&, OperatorState&) const = 0;
  virtual bool propose_next_in(OperatorContext&, Target, OperatorState&) const = 0;

  Verdict run_stages(OperatorContext& context, Target target) const;
  Verdict try_proposals(OperatorContext& context, Target target, Transaction& transaction,
                        OperatorState& state) const;
  Verdict try_target(OperatorContext& context, Target target) const;
  Error failure(Target target, std::string_view reason) const;

  const OperatorInfo& info_;
  std::string origin_;
  std::string settings_;
  Judge judge_;
};

/// An operator with a state of its own: what a stage leaves for the next, and buffers. A state
/// belongs to one worker and outlives the attempt; a stage may rely only on what an earlier stage of
/// the same attempt wrote. State: default-constructible.
template <class State>
class TETMEND_API OperatorOf : public Operator {
 protected:
  /// @param judge decides whether what apply() made stays
  explicit OperatorOf(const OperatorInfo& info, const Judge& judge = Judge::strict())
      : Operator(info, judge) {}

  /// Cheap tests that need no search. Must not modify the mesh.
  virtual Verdict precondition(const OperatorContext& context, Target target,
                               State& state) const = 0;
  /// Finds what to do and leaves it in the state; what the judge of the context will refuse anyway,
  /// it need not find. Must not modify the mesh.
  virtual Verdict evaluate(OperatorContext& context, Target target, State& state) const = 0;
  /// Makes the edits. Anything but `accepted` undoes them.
  virtual Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                        State& state) const = 0;
  /// After a refused proposal, whose edits are undone: true if apply() can make another one. Must
  /// not modify the mesh.
  virtual bool propose_next(OperatorContext& /*context*/, Target /*target*/,
                            State& /*state*/) const {
    return false;
  }

 private:
  struct Held final : OperatorState {
    State state;
  };
  static State& unwrap(OperatorState& held) { return static_cast<Held&>(held).state; }

  std::unique_ptr<OperatorState> make_state() const final { return std::make_unique<Held>(); }
  Verdict precondition_in(const OperatorContext& context, Target target,
                          OperatorState& held) const final {
    return precondition(context, target, unwrap(held));
  }
  Verdict evaluate_in(OperatorContext& context, Target target, OperatorState& held) const final {
    return evaluate(context, target, unwrap(held));
  }
  Verdict apply_in(OperatorContext& context, Target target, Transaction& transaction,
                   OperatorState& held) const final {
    return apply(context, target, transaction, unwrap(held));
  }
  bool propose_next_in(OperatorContext& context, Target target, OperatorState& held) const final {
    return propose_next(context, target, unwrap(held));
  }
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

/// The verdict for a vertex whose star an operator needs; `accepted` for a whole one.
constexpr Verdict to_verdict(StarKind kind) {
  switch (kind) {
    case StarKind::whole:
      return Verdict::accepted;
    case StarKind::too_large:
      return Verdict::not_applicable;
    case StarKind::border:
      return Verdict::deferred;
  }
  return Verdict::not_applicable;
}

/// A proposal: tets to replace, and by what.
struct TETMEND_API Replacement {
  std::vector<TetHandle> old_tets;
  std::vector<TetVertices> new_tets;

  Verdict make(Transaction& transaction) const {
    return to_verdict(transaction.replace_cavity(old_tets, new_tets));
  }
};

/// Tells the trace, which must not be null, how an attempt ended; with the vectors of the last
/// comparison if that decided: it is empty when none was made.
TETMEND_API void report_end(OperatorContext& context, Verdict verdict);

}  // namespace tetmend
