// SPDX-License-Identifier: MIT
#include "contract/trials.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "contract/portrait.h"
#include "contract/zoo.h"
#include "kernel/error.h"
#include "kernel/integrity.h"
#include "kernel/workspace.h"
#include "trace/text_trace.h"

namespace tetmend::contract {

namespace {

bool is_live(const TetMesh& mesh, Target target) {
  switch (target.kind) {
    case TargetKind::tet:
      return !mesh.is_deleted(target.tet());
    case TargetKind::edge:
      return !mesh.is_deleted(target.edge().tet());
    case TargetKind::face:
      return !mesh.is_deleted(target.face().tet());
    case TargetKind::vertex:
      return !mesh.is_deleted(target.vertex());
  }
  return false;
}

/// How an attempt ended.
struct Answer {
  Verdict verdict{};
  std::string error;  // thrown instead of a verdict
  friend bool operator==(const Answer&, const Answer&) = default;
};

struct Worker {
  explicit Worker(const TetMesh& start) : mesh(start), workspace(mesh) {}
  Answer attempt(const Operator& op, Target target, TraceSink* trace = nullptr) {
    OperatorContext context{mesh, workspace, states, trace};
    try {
      return {op.attempt(context, target), ""};
    } catch (const Error& error) {
      return {Verdict::not_applicable, error.what()};
    }
  }

  TetMesh mesh;
  Workspace workspace;
  OperatorStates states;
};

/// A refusal or an error, judged by the mesh before and after.
std::string complaint_about(const Answer& answer, const TetMesh& before, const TetMesh& now) {
  if (now == before) return answer.error;
  if (answer.error.empty()) return "the refusal left a trace";
  return fmt::format("the error left a trace: {}", answer.error);
}

std::string locate(Target target, const Outcome& outcome, const std::string& about) {
  return fmt::format("{} {}, attempt {}: {}", to_string(target.kind), target.code, outcome.attempts,
                     about);
}

}  // namespace

Outcome& Outcome::operator+=(const Outcome& other) {
  attempts += other.attempts;
  accepted += other.accepted;
  deferred += other.deferred;
  if (complaint.empty()) complaint = other.complaint;
  if (note.empty()) note = other.note;
  return *this;
}

std::vector<Target> targets(const TetMesh& mesh, TargetKind kind) {
  std::vector<Target> all;
  if (kind == TargetKind::vertex) {
    for (const VertexHandle v : live_vertices(mesh)) all.push_back(Target::of(v));
    return all;
  }
  for (const TetHandle t : live_tets(mesh)) {
    if (kind == TargetKind::tet) all.push_back(Target::of(t));
    for (unsigned f = 0; kind == TargetKind::face && f < 4; ++f) {
      all.push_back(Target::of(HalfFace(t, f)));
    }
    for (unsigned e = 0; kind == TargetKind::edge && e < 6; ++e) {
      all.push_back(Target::of(TetEdge(t, e)));
    }
  }
  return all;
}

std::vector<Target> sample(const std::vector<Target>& all, std::size_t count, std::size_t turn) {
  const std::size_t stride = (all.size() + count - 1) / std::max<std::size_t>(count, 1);
  if (stride <= 1) return all;
  std::vector<Target> some;
  for (std::size_t i = turn % stride; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

Outcome try_in_sweeps(const Operator& op, const TetMesh& start, unsigned sweeps,
                      std::size_t count) {
  Outcome outcome;
  Worker worker(start);
  Worker twin(start);
  TextTrace trace;
  TetMesh before = start;
  Portrait known = portrait(start);
  const auto complain = [&](Target target, const std::string& about) {
    outcome.complaint = locate(target, outcome, about);
    return outcome;
  };
  for (unsigned sweep = 0; sweep < sweeps; ++sweep) {
    const std::size_t accepted = outcome.accepted;
    for (const Target target : sample(targets(worker.mesh, op.info().target), count, 7 * sweep)) {
      if (!is_live(worker.mesh, target)) continue;
      ++outcome.attempts;
      Answer rehearsed;
      {
        Transaction outer(worker.mesh, worker.workspace);
        rehearsed = worker.attempt(op, target);
      }
      if (!(worker.mesh == before)) return complain(target, "undoing the attempt left a trace");
      const Answer answer = worker.attempt(op, target);
      if (answer != rehearsed) return complain(target, "the second attempt answers differently");
      if (answer.verdict != Verdict::accepted) {
        const auto about = complaint_about(answer, before, worker.mesh);
        if (!about.empty()) return complain(target, about);
        continue;
      }
      ++outcome.accepted;
      {
        Transaction outer(twin.mesh, twin.workspace);
        if (twin.attempt(op, target, &trace) != answer) return complain(target, "the twin refuses");
        outer.keep();
      }
      if (!(worker.mesh == twin.mesh)) return complain(target, "the twin's mesh differs");
      if (const auto about = complaint_about(known, worker.mesh); !about.empty()) {
        return complain(target, about);
      }
      known = portrait_after(known, worker.mesh);
      before = worker.mesh;
    }
    if (outcome.accepted == accepted) break;
  }
  return outcome;
}

Outcome try_on_fresh_copies(const Operator& op, const TetMesh& start, std::size_t count) {
  Outcome outcome;
  const Portrait known = portrait(start);
  Target last_accepted{};
  for (const Target target : sample(targets(start, op.info().target), count, 0)) {
    ++outcome.attempts;
    const auto complain = [&](const std::string& about) {
      outcome.complaint = fmt::format("on a fresh copy, {}", locate(target, outcome, about));
      return outcome;
    };
    Worker worker(start);
    const Answer answer = worker.attempt(op, target);
    if (answer.verdict == Verdict::accepted) {
      ++outcome.accepted;
      last_accepted = target;
      const std::string about = complaint_about(known, worker.mesh);
      if (!about.empty()) return complain(about);
      Worker other(start);
      other.attempt(op, target);
      if (!(worker.mesh == other.mesh)) return complain("two copies differ afterwards");
      continue;
    }
    const std::string about = complaint_about(answer, start, worker.mesh);
    if (!about.empty()) return complain(about);
    if (outcome.accepted == 0) continue;
    // What comes after a refusal is what would have come without it.
    Worker other(start);
    worker.attempt(op, last_accepted);
    other.attempt(op, last_accepted);
    if (!(worker.mesh == other.mesh)) return complain("the refusal shows in the next attempt");
  }
  return outcome;
}

Outcome try_in_turns(std::span<const Candidate> candidates, const TetMesh& start, unsigned rounds,
                     std::size_t count) {
  Outcome outcome;
  Worker worker(start);
  Portrait known = portrait(worker.mesh);
  std::size_t turn = 0;
  for (unsigned round = 0; round < rounds; ++round) {
    for (const Candidate& candidate : candidates) {
      const Operator& op = *candidate.op;
      for (const Target target : sample(targets(worker.mesh, op.info().target), count, ++turn)) {
        if (!is_live(worker.mesh, target)) continue;
        ++outcome.attempts;
        const TetMesh before = worker.mesh;
        const Answer answer = worker.attempt(op, target);
        std::string about;
        if (answer.verdict != Verdict::accepted) {
          about = complaint_about(answer, before, worker.mesh);
        } else {
          ++outcome.accepted;
          about = complaint_about(known, worker.mesh);
          known = portrait_after(known, worker.mesh);
        }
        if (about.empty()) continue;
        outcome.complaint = fmt::format("in turns with others, {}: {}", candidate.name,
                                        locate(target, outcome, about));
        return outcome;
      }
    }
  }
  return outcome;
}

}  // namespace tetmend::contract
