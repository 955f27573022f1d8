// SPDX-License-Identifier: MIT
// The sandbox: one attempt of an operator at a place of a mesh, recorded, to be looked at and then
// kept or undone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kernel/tet_mesh.h"
#include "ops/registry.h"
#include "viewer/debugger/debugger.h"

namespace tetmend::viewer {

/// What is to be tried, and where.
struct TrialRequest {
  std::string operator_name;
  std::vector<VertexHandle> target;  ///< 1 of a vertex, 2 of an edge, 3 of a face, 4 of a tet
  ParameterSettings settings;        ///< the others have their defaults
};

/// How many vertices name a target of that kind.
std::size_t vertices_of(TargetKind kind);

/// Made on a copy of the mesh: the mesh itself is never touched, so nothing has to be undone in it. The
/// copy is then what is shown, so no second one is needed, and none is measured or packed.
class Trial {
 public:
  /// @param file name of the mesh, for the trace
  /// @throws Error as attempt_at(), and when the operator is not tried at all. Cost: that of the
  /// attempt and of copies: about 0.1 s of a processor for a million tets.
  Trial(const TetMesh& mesh, const Registry& registry, TrialRequest request,
        const std::string& file);
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  const TrialRequest& request() const { return request_; }
  /// The attempt in the debugger, at its end. To be asked for once.
  std::unique_ptr<Debugger> take_debugger() { return std::move(debugger_); }
  bool is_accepted() const { return is_accepted_; }
  /// Of the attempt itself, which is the first call of its trace.
  const Call& call() const { return call_; }
  /// "refused, no improvement: 0.0123 of quality are missing".
  const std::string& outcome() const { return outcome_; }
  double seconds() const { return seconds_; }  ///< that the attempt took
  /// The slots in which the mesh may be another, at whatever place of the attempt; ascending.
  const std::vector<TetHandle>& changed() const { return changed_; }
  /// The mesh as the attempt has left it, with the slots of the mesh before. To be asked for once.
  TetMesh take_mesh() { return std::move(mesh_); }
  /// Makes the same attempt on another mesh: the one that was tried, or a copy of it.
  void make_on(TetMesh& mesh, const Registry& registry) const;

 private:
  TrialRequest request_;
  TetMesh mesh_;
  std::unique_ptr<Debugger> debugger_;
  Call call_;
  bool is_accepted_ = false;
  std::string outcome_;
  double seconds_ = 0;
  std::vector<TetHandle> changed_;
};

}  // namespace tetmend::viewer
