// SPDX-License-Identifier: MIT
// Trials of one operator on one mesh. A refusal leaves no trace. An accepted attempt leaves a sound
// and better mesh with the same surface, regions and constraints. The same attempt ends the same
// way wherever it is made.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ops/operator.h"

namespace tetmend::contract {

/// An operator to be tried, and what to call it in messages.
struct Candidate {
  std::string name;
  std::unique_ptr<Operator> op;
};

/// What came of a trial.
struct Outcome {
  std::string complaint;  ///< the first breach of the contract: where and what; empty if none
  std::string note;       ///< what was not shown, though nothing was broken
  std::size_t attempts = 0;
  std::size_t accepted = 0;
  std::size_t deferred = 0;  ///< only in a territory

  /// Adds the counts; keeps the first complaint and the first note.
  Outcome& operator+=(const Outcome& other);
};

/// The complaint about who asks for an edit without asking where its territory ends.
inline constexpr std::string_view kReachedOut =
    "it asked for an edit that reaches out of the territory";

/// All live entities of a kind; an edge or face once for each of its tets.
std::vector<Target> targets(const TetMesh& mesh, TargetKind kind);
/// At most `count` of the targets, evenly spread; another choice for each `turn`.
std::vector<Target> sample(const std::vector<Target>& all, std::size_t count, std::size_t turn);

/// Sweeps over one mesh, at most `count` targets each. A twin with buffers of its own gets only the
/// accepted attempts, traced and inside an outer transaction. It stays equal only if nothing else
/// leaves a mark in mesh, free lists or buffers. Cost: a few copies or comparisons of the mesh for
/// each attempt, as in the other trials.
Outcome try_in_sweeps(const Operator& op, const TetMesh& start, unsigned sweeps, std::size_t count);

/// At most `count` targets, each on a copy of the mesh as it came.
Outcome try_on_fresh_copies(const Operator& op, const TetMesh& start, std::size_t count);

/// At most `count` targets, each on a copy of the mesh under each judge in place of the operator's
/// own: what is accepted keeps that judge's promise.
Outcome try_under_judges(const Operator& op, const TetMesh& start, std::size_t count);

/// All candidates in turns on the same mesh, at most `count` targets each time.
Outcome try_in_turns(std::span<const Candidate> candidates, const TetMesh& start, unsigned rounds,
                     std::size_t count);

/// Targets in a territory, the part of the mesh where x is below `bound`: of at most `count` tets, those
/// at its border first. Nothing outside may change, and no edit be asked for that reaches out. Nor may
/// anything depend on points outside that no tet of the territory touches.
Outcome try_in_territory(const Operator& op, const TetMesh& start, double bound, std::size_t count);
/// A bound that has about so much of the vertices below it, from 0 to 1.
double bound_below(const TetMesh& mesh, double share);

}  // namespace tetmend::contract
