// SPDX-License-Identifier: MIT
#include "schedule/composition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// A tet around all of the vertices changed at `since` or later: what changed has them all as
/// vertices, or one of them moved.
template <std::size_t N>
bool changed_around(const TetMesh& mesh, const std::array<VertexHandle, N>& vertices, Date since) {
  bool all = true;
  for (const VertexHandle v : vertices) {
    if (mesh.moved(v) >= since) return true;
    all = all && mesh.changed(v) >= since;
  }
  return all;
}

/// The edges of a tet by rank, lowest first; equal ranks in edge order.
template <class Rank>
std::array<unsigned, 6> sorted_edges(Rank&& rank) {
  std::array<double, 6> ranks{};
  for (unsigned e = 0; e < 6; ++e) ranks[e] = rank(e);
  std::array<unsigned, 6> edges = {0, 1, 2, 3, 4, 5};
  std::sort(edges.begin(), edges.end(), [&](unsigned x, unsigned y) {
    return ranks[x] != ranks[y] ? ranks[x] < ranks[y] : x < y;
  });
  return edges;
}

std::array<Point, 4> face_normals(const TetMesh& mesh, const TetVertices& tv) {
  std::array<Point, 4> normals;
  for (unsigned f = 0; f < 4; ++f) {
    const auto& local = kFaceVertices[f];
    const Point& p = mesh.point(tv[local[0]]);
    normals[f] = (mesh.point(tv[local[1]]) - p).cross(mesh.point(tv[local[2]]) - p);
  }
  return normals;
}

/// By the cosine of the dihedral angle, squared with its sign: no root is needed. At a face without
/// area all angles count as right ones.
std::array<unsigned, 6> edges_by_angle(const TetMesh& mesh, const TetVertices& tv) {
  const std::array<Point, 4> normals = face_normals(mesh, tv);
  std::array<double, 4> normal2{};
  for (unsigned f = 0; f < 4; ++f) normal2[f] = normals[f].squaredNorm();
  return sorted_edges([&](unsigned e) {
    const auto& [f, g] = kEdgeVertices[5 - e];  // the faces at edge e lie opposite these
    const double cosine = -normals[f].dot(normals[g]);
    const double product = normal2[f] * normal2[g];
    return product > 0 ? cosine * std::abs(cosine) / product : 0;
  });
}

/// By the sine of the dihedral angle, up to a common factor, squared.
std::array<unsigned, 6> edges_by_sine(const TetMesh& mesh, const TetVertices& tv) {
  const std::array<Point, 4> normals = face_normals(mesh, tv);
  std::array<double, 4> normal2{};
  for (unsigned f = 0; f < 4; ++f) normal2[f] = normals[f].squaredNorm();
  return sorted_edges([&](unsigned e) {
    const auto& [i, j] = kEdgeVertices[e];
    return (mesh.point(tv[i]) - mesh.point(tv[j])).squaredNorm() * normal2[i] * normal2[j];
  });
}

std::array<unsigned, 6> edges_by_length(const TetMesh& mesh, const TetVertices& tv, double sign) {
  return sorted_edges([&](unsigned e) {
    const auto& [i, j] = kEdgeVertices[e];
    return sign * (mesh.point(tv[i]) - mesh.point(tv[j])).squaredNorm();
  });
}

std::array<unsigned, 6> edges_in_order(const TetMesh& mesh, const TetVertices& tv,
                                       EdgeOrder order) {
  switch (order) {
    case EdgeOrder::longest:
      return edges_by_length(mesh, tv, -1);
    case EdgeOrder::shortest:
      return edges_by_length(mesh, tv, 1);
    case EdgeOrder::angle:
      return edges_by_angle(mesh, tv);
    case EdgeOrder::sine:
      break;
  }
  return edges_by_sine(mesh, tv);
}

/// How many attempts an operator can make at a tet.
constexpr unsigned targets_of_a_tet(TargetKind kind) {
  return kind == TargetKind::edge ? 6 : kind == TargetKind::tet ? 1 : 4;
}

constexpr unsigned kMostAttempts = 64;

/// What follows in a sequence works on tets that are at most this much better than the worst tet
/// that the sequence began with: the others do not decide.
constexpr Quality kReach = 0.4f;

double quality_of_largest_angle(const TetMesh& mesh, const TetVertices& tv) {
  return std::sqrt(mesh.standard().obtuse2()) *
         largest_angle_sine(mesh.point(tv[0]), mesh.point(tv[1]), mesh.point(tv[2]),
                            mesh.point(tv[3]));
}

constexpr std::string_view to_string(Composition::Kind kind) {
  switch (kind) {
    case Composition::Kind::first_of:
      return "first_of";
    case Composition::Kind::all_of:
      return "all_of";
    case Composition::Kind::sequence:
      return kSequenceName;
    case Composition::Kind::one:
      break;
  }
  return "";
}

constexpr std::string_view to_string(EdgeOrder order) {
  constexpr std::array<std::string_view, 4> kNames = {"sine", "angle", "longest", "shortest"};
  return kNames[static_cast<std::size_t>(order)];
}

}  // namespace

std::string Composition::name() const {
  if (kind == Kind::one) return operator_name;
  std::string text = std::string(to_string(kind)) + "(";
  for (const Composition& part : parts) {
    text += (&part == parts.data() ? "" : ", ") + part.name();
  }
  return text + ")";
}

std::string Composition::describe() const {
  if (kind != Kind::one) {
    std::string text = std::string(to_string(kind)) + "(";
    for (const Composition& part : parts) text += part.describe() + "; ";
    if (kind == Kind::sequence) text += fmt::format("desperate {} to {}", desperate, theta_max);
    return text + ")";
  }
  ParameterSettings sorted = settings;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  std::string text =
      fmt::format("{} order {} edges {}", operator_name, static_cast<int>(order), most_edges);
  for (const auto& [parameter, value] : sorted) text += fmt::format(" {} = {}", parameter, value);
  return text;
}

/// Of one tet.
struct TetAttempts::Progress {
  Worker& worker;
  QueuedTet& entry;
  Date since;
  std::uint64_t deferred = 0;
  bool gone = false;
  bool stopped = false;
  bool accepted = false;  // since the innermost first_of began
  bool until_accepted = false;
  bool counts = true;  // false: part of a sequence, which counts as one attempt

  bool done() const { return gone || stopped || (until_accepted && accepted); }
};

TetAttempts::TetAttempts(const Registry& registry, const Composition& composition)
    : root_(build(registry, composition)) {}

TetAttempts::Node TetAttempts::build(const Registry& registry, const Composition& composition) {
  Node node{composition.kind, {}, {}, composition.desperate, composition.theta_max, {}};
  switch (composition.kind) {
    case Composition::Kind::one:
      node.leaf = build_leaf(registry, composition);
      break;
    case Composition::Kind::sequence: {
      const auto& parts = composition.parts;
      if (parts.size() < 2 || parts[0].kind != Composition::Kind::one) {
        throw Error("a sequence is an operator and what follows it");
      }
      node.leaf = build_leaf(registry, parts[0]);
      const unsigned bits = bits_;
      for (std::size_t i = 1; i < parts.size(); ++i) {
        bits_ = 0;  // what follows works on tets of its own
        node.parts.push_back(build(registry, parts[i]));
      }
      bits_ = bits;
      node.settings = script_of_parts(node);
      break;
    }
    default:
      for (const Composition& part : composition.parts) node.parts.push_back(build(registry, part));
  }
  return node;
}

std::string TetAttempts::script_of(const Leaf& leaf) {
  std::string text = fmt::format("{{\"{}\"", leaf.op->info().name);
  if (!leaf.op->settings().empty()) text += ", " + leaf.op->settings();
  if (leaf.op->info().target == TargetKind::edge) {
    text +=
        fmt::format(", order = \"{}\", most_edges = {}", to_string(leaf.order), leaf.most_edges);
  }
  return text + "}";
}

/// As a script writes it, with the values of all parameters.
std::string TetAttempts::script_of(const Node& node) {
  if (node.kind == Composition::Kind::one) return script_of(node.leaf);
  return fmt::format("{}{{{}}}", to_string(node.kind), script_of_parts(node));
}

std::string TetAttempts::script_of_parts(const Node& node) {
  std::vector<std::string> parts;
  if (node.kind == Composition::Kind::sequence) parts.push_back(script_of(node.leaf));
  for (const Node& part : node.parts) parts.push_back(script_of(part));
  if (node.kind == Composition::Kind::sequence) {
    parts.push_back(fmt::format("desperate = {}", node.desperate));
    parts.push_back(fmt::format("theta_max = {}", node.theta_max));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

TetAttempts::Leaf TetAttempts::build_leaf(const Registry& registry,
                                          const Composition& composition) {
  Leaf leaf{registry.make(composition.operator_name, composition.settings), composition.order,
            composition.most_edges, leaves_++, bits_};
  bits_ += targets_of_a_tet(leaf.op->info().target);
  if (bits_ > kMostAttempts) {
    throw Error(fmt::format("a composition makes more than {} attempts at a tet", kMostAttempts));
  }
  return leaf;
}

bool TetAttempts::work_off(Worker& worker, QueuedTet& entry, Date since) const {
  worker.provide_memory(leaves_);
  Progress progress{worker, entry, since};
  TraceSink* trace = worker.context().trace;
  if (trace != nullptr) trace->visit_begins(entry.vertices, entry.quality);
  run(root_, progress);
  if (trace != nullptr) trace->visit_ends();
  if (progress.done()) return true;
  entry.todo = progress.deferred;
  return progress.deferred == 0;
}

void TetAttempts::run(const Node& node, Progress& progress) const {
  if (node.leaf.op != nullptr) return run_leaf(node, progress);
  const bool outer_accepted = std::exchange(progress.accepted, false);
  const bool outer_until =
      std::exchange(progress.until_accepted, node.kind == Composition::Kind::first_of);
  for (const Node& part : node.parts) {
    if (progress.done()) break;
    run(part, progress);
  }
  progress.until_accepted = outer_until;
  progress.accepted = progress.accepted || outer_accepted;
}

void TetAttempts::run_leaf(const Node& node, Progress& progress) const {
  const Leaf& leaf = node.leaf;
  const TetMesh& mesh = progress.worker.mesh();
  const TetHandle tet = progress.entry.tet;
  const TetVertices corners = progress.entry.vertices;
  switch (leaf.op->info().target) {
    case TargetKind::tet:
      try_once(node, progress, Target::of(tet), 0, {});
      return;
    case TargetKind::edge: {
      const auto edges = edges_in_order(mesh, corners, leaf.order);
      for (const unsigned e : std::span(edges).first(leaf.most_edges)) {
        const TetEdge edge(tet, e);
        const auto ends = mesh.vertices(edge);
        if (!changed_around(mesh, ends, progress.since)) continue;
        if (!try_once(node, progress, Target::of(edge), e, ends)) return;
      }
      return;
    }
    case TargetKind::face:
      for (unsigned f = 0; f < 4; ++f) {
        const HalfFace face(tet, f);
        if (mesh.is_boundary(face) || !changed_around(mesh, mesh.vertices(face), progress.since))
          continue;
        const HalfFace twin = mesh.twin(face);
        // All faces between two vertices are tried together.
        const VertexHandle opposite = mesh.vertices(twin.tet())[twin.face()];
        if (!try_once(node, progress, Target::of(face), f, {corners[f], opposite})) return;
      }
      return;
    case TargetKind::vertex:
      for (unsigned i = 0; i < 4; ++i) {
        const VertexHandle v = corners[i];
        if (!is_worth_a_try(leaf.op->info().at_surface, mesh, v) ||
            mesh.changed(v) < progress.since)
          continue;
        if (!try_once(node, progress, Target::of(v), i, {v, v})) return;
      }
      return;
  }
}

/// False when nothing more is to be tried.
bool TetAttempts::try_once(const Node& node, Progress& progress, Target target, unsigned bit,
                           std::array<VertexHandle, 2> key) const {
  const Leaf& leaf = node.leaf;
  const std::uint64_t mark = std::uint64_t{1} << (leaf.first_bit + bit);
  if ((progress.entry.todo & mark) == 0) return true;
  PairSet& tried = progress.worker.tried[leaf.number];
  const bool remembers = target.kind != TargetKind::tet;  // each tet is queued once
  if (remembers && tried.contains(key[0].index(), key[1].index())) return true;
  progress.stopped = progress.worker.is_stopped();
  if (progress.stopped) return false;
  const Verdict verdict = attempt(node, progress.worker, target, progress.entry.vertices);
  if (progress.counts) progress.worker.count(verdict);
  progress.accepted = progress.accepted || verdict == Verdict::accepted;
  progress.gone = !progress.entry.is_there(progress.worker.mesh());
  if (progress.done()) return false;
  if (verdict == Verdict::deferred) progress.deferred |= mark;
  if (remembers && verdict != Verdict::accepted) tried.insert(key[0].index(), key[1].index());
  return true;
}

Verdict TetAttempts::attempt_once(Worker& worker, Target target, const TetVertices& tet) const {
  worker.provide_memory(leaves_);
  return worker.count(attempt(root_, worker, target, tet));
}

Verdict TetAttempts::attempt(const Node& node, Worker& worker, Target target,
                             const TetVertices& tet) const {
  if (node.kind == Composition::Kind::sequence) {
    return attempt_sequence(node, worker, target, tet);
  }
  return worker.attempt_in(worker.context(), *node.leaf.op, target);
}

/// To the trace a sequence is an attempt like that of an operator, with those of its parts in it.
Verdict TetAttempts::attempt_sequence(const Node& node, Worker& worker, Target target,
                                      const TetVertices& tet) const {
  OperatorContext& context = worker.context();
  if (context.trace == nullptr) return try_sequence(node, worker, target, tet);
  const TargetVertices vertices(context.mesh, target);
  context.trace->attempt_begins({kSequenceName, vertices.all(), context.level, node.settings});
  const Verdict verdict = try_sequence(node, worker, target, tet);
  report_end(context, verdict);
  return verdict;
}

/// Undone, unless accepted, when it returns; the last comparison then is its own.
Verdict TetAttempts::try_sequence(const Node& node, Worker& worker, Target target,
                                  const TetVertices& tet) const {
  OperatorContext& context = worker.context();
  Comparison& comparison = context.states.comparison;
  // Of 180 degrees 0: below it, no tet is.
  const double blunt =
      node.theta_max < 180 ? context.mesh.standard().quality_of_angle(node.theta_max) : 0;
  const double largest = blunt > 0 ? quality_of_largest_angle(context.mesh, tet) : 0;
  if (blunt > 0 && largest >= blunt) return Verdict::not_applicable;
  const Judge judge =
      blunt > 0 ? Judge::lowers_angle(largest) : Judge::fair({.desperate = node.desperate});
  const Judge hopeful = Judge::opening();
  Transaction sequence(context.mesh, context.workspace);
  OperatorContext opening = context;
  opening.judge = &hopeful;
  const Verdict verdict = worker.attempt_in(opening, *node.leaf.op, target);
  if (verdict != Verdict::accepted) {
    comparison.forget();  // of what the operator compared
    return verdict;
  }
  if (context.trace != nullptr) context.trace->candidate_found();
  bool all_tried = true;
  for (const Node& part : node.parts) {
    comparison.look_at(sequence);
    const Quality limit = comparison.worst_before() + kReach;
    all_tried = follow_up(part, worker, sequence, limit, blunt) && all_tried;
  }
  if (judge.accepts({sequence, comparison})) {
    sequence.keep();
    return Verdict::accepted;
  }
  return all_tried ? Verdict::no_improvement : Verdict::deferred;
}

/// Tries a part on the tets below `limit` among those that the sequence has changed, and on those
/// whose largest angle is of a quality below `blunt`. False if attempts were deferred.
bool TetAttempts::follow_up(const Node& part, Worker& worker, const Transaction& sequence,
                            Quality limit, double blunt) const {
  const TetMesh& mesh = worker.mesh();
  std::vector<TetHandle> changed;
  sequence.list_changed(changed);
  std::vector<QueuedTet> bad;
  for (const TetHandle t : changed) {
    if (mesh.quality(t) < std::min(limit, kBadThreshold) ||
        (mesh.quality(t) < blunt && quality_of_largest_angle(mesh, mesh.vertices(t)) < blunt)) {
      bad.push_back({mesh.quality(t), t, mesh.vertices(t)});
    }
  }
  std::sort(bad.begin(), bad.end());
  forget(part, worker);
  bool all_tried = true;
  for (QueuedTet& entry : bad) {
    if (!entry.is_there(mesh)) continue;
    Progress progress{worker, entry, 0};
    progress.counts = false;
    run(part, progress);
    all_tried = all_tried && progress.deferred == 0;
  }
  return all_tried;
}

/// What was tried for an earlier tet may be worth another attempt.
void TetAttempts::forget(const Node& node, Worker& worker) {
  if (node.leaf.op != nullptr) worker.tried[node.leaf.number].clear();
  for (const Node& part : node.parts) forget(part, worker);
}

}  // namespace tetmend
