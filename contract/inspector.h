// SPDX-License-Identifier: MIT
// Plugins under suspicion: each of their attempts is held to the contract while a run makes it.
#pragma once

#include <stdexcept>
#include <string>

#include "ops/attempt_inspector.h"

namespace tetmend::contract {

/// An operator of a plugin broke the contract. The mesh is what that left. No Error, for the
/// host of scripts makes another one of those.
class Breach : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Lets attempts of tetmend's own operators pass. Of one of a plugin:
///   in any case: no edit was asked for that reaches out of the territory
///   refused, or ended by an exception: the mesh is what it was, bit for bit
///   accepted: sound, with the same surface, volumes, labels and constraints; nothing changed that
///   the judge did not see, or outside the territory; better, if a strict or fair judge says so
/// Cost: a copy and a comparison of the mesh for each such attempt; for an accepted one n log n,
/// about a millisecond for 1000 tets. Memory: four times the mesh.
class Inspector final : public AttemptInspector {
 public:
  /// @throws Breach with operator, plugin, target and what was broken
  Verdict attempt(const Operator& op, OperatorContext& context, Target target) override;

 private:
  std::string complaint_about_accepted(const Operator& op, OperatorContext& context) const;

  TetMesh before_;
};

}  // namespace tetmend::contract
