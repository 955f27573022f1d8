// SPDX-License-Identifier: MIT
// Operators that a program writes itself, each as one function.
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/api.h>

#include "face/kernel/operators.h"
#include "face/kernel/transaction.h"

namespace tetmend::kernel {

/// What an operator of a program wants to do. It only proposes: the attempt makes the edit, asks a
/// judge, and undoes it where that does not accept.
class TETMEND_API Proposal {
 public:
  /// Other tets in place of these, as Transaction::replace() takes them. Returns `accepted`: to go on.
  Verdict replace(std::span<const TetHandle> old, std::span<const TetVertices> created);
  Verdict replace(std::span<const TetHandle> old, std::initializer_list<TetVertices> created) {
    return replace(old, std::span<const TetVertices>(created.begin(), created.size()));
  }
  /// Another place for a vertex.
  Verdict move(VertexHandle v, const Point& point);

  /// Does it. Nothing was proposed: `not_closed`.
  EditResult make(Transaction& edit) const;

 private:
  friend class OwnOperator;  // does it within a pass
  std::vector<TetHandle> old_;
  std::vector<TetVertices> created_;
  bool moves_ = false;
  VertexHandle vertex_;
  Point place_ = {0, 0, 0};
};

/// Decides whether what an operator of a program did stays.
class TETMEND_API Judge {
 public:
  /// Corners of all tets that changed, before and now.
  using Tets = std::span<const std::array<Point, 4>>;

  /// The ascending qualities of what changed are lexicographically larger: what operators of tetmend
  /// are judged by.
  static Judge strict() { return Judge(nullptr); }
  /// By a criterion of the program: true keeps the change.
  static Judge by(std::function<bool(Tets before, Tets now)> is_better) {
    return Judge(std::move(is_better));
  }

  /// Null: strict.
  const std::function<bool(Tets, Tets)>& criterion() const { return is_better_; }

 private:
  explicit Judge(std::function<bool(Tets, Tets)> is_better) : is_better_(std::move(is_better)) {}
  std::function<bool(Tets, Tets)> is_better_;
};

/// Operators of a program, by name. A function looks at the mesh, fills in the proposal and says
/// `accepted`, or answers with the reason why there is none. What kind of target it is for follows from
/// its second parameter:
///
///   operators.add("my_flip", "three tets of an edge become two",
///                 [](const TetMesh& look, TetEdge e, Proposal& out) -> Verdict { ... });
class TETMEND_API Operators {
 public:
  /// @throws Error if there is one of that name, or tetmend has
  template <class Function>
  requires std::invocable<Function, const TetMesh&, TetHandle, Proposal&>
  void add(std::string_view name, std::string_view help, Function propose,
           Judge judge = Judge::strict()) {
    add(name, help, TargetKind::tet, std::move(judge),
        [propose](const TetMesh& mesh, Target t, Proposal& out) {
          return propose(mesh, t.tet(), out);
        });
  }
  template <class Function>
  requires std::invocable<Function, const TetMesh&, TetEdge, Proposal&>
  void add(std::string_view name, std::string_view help, Function propose,
           Judge judge = Judge::strict()) {
    add(name, help, TargetKind::edge, std::move(judge),
        [propose](const TetMesh& mesh, Target t, Proposal& out) {
          return propose(mesh, t.edge(), out);
        });
  }
  template <class Function>
  requires std::invocable<Function, const TetMesh&, HalfFace, Proposal&>
  void add(std::string_view name, std::string_view help, Function propose,
           Judge judge = Judge::strict()) {
    add(name, help, TargetKind::face, std::move(judge),
        [propose](const TetMesh& mesh, Target t, Proposal& out) {
          return propose(mesh, t.face(), out);
        });
  }
  template <class Function>
  requires std::invocable<Function, const TetMesh&, VertexHandle, Proposal&>
  void add(std::string_view name, std::string_view help, Function propose,
           Judge judge = Judge::strict()) {
    add(name, help, TargetKind::vertex, std::move(judge),
        [propose](const TetMesh& mesh, Target t, Proposal& out) {
          return propose(mesh, t.vertex(), out);
        });
  }

  /// A measure for Options::measure, for `judge_by` of schedules and for Standard::of(): larger is
  /// better, and a tet below `good` is bad. @throws Error as Standard::of(), and if there is one of that name
  Standard add_measure(OwnMeasure measure);
  std::span<const Standard> measures() const { return measures_; }

  /// An operator of the program.
  struct Own {
    TargetKind target{};
    std::string help;
    Judge judge = Judge::strict();
    std::function<Verdict(const TetMesh&, Target, Proposal&)> propose;
  };
  /// Null: there is none of that name.
  const Own* find(std::string_view name) const;
  /// By name.
  const std::map<std::string, Own, std::less<>>& all() const { return operators_; }

 private:
  void add(std::string_view name, std::string_view help, TargetKind target, Judge judge,
           std::function<Verdict(const TetMesh&, Target, Proposal&)> propose);

  std::map<std::string, Own, std::less<>> operators_;
  std::vector<Standard> measures_;
};

/// See attempt() and try_only().
TETMEND_API Call attempt_at(TetMesh& mesh, const Operators& operators,
                            std::string_view operator_name, Target target, bool keeps);

/// As attempt() without `operators`, for one of the program; one of tetmend where that has none of the
/// name. An exception of the function or the judge leaves the mesh as it was and comes out.
template <class Handle>
Call attempt(TetMesh& mesh, const Operators& operators, std::string_view operator_name,
             Handle target) {
  return attempt_at(mesh, operators, operator_name, Target::of(target), true);
}

template <class Handle>
Call try_only(TetMesh& mesh, const Operators& operators, std::string_view operator_name,
              Handle target) {
  return attempt_at(mesh, operators, operator_name, Target::of(target), false);
}

}  // namespace tetmend::kernel
