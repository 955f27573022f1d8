// SPDX-License-Identifier: MIT
#include "trace/history.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend {

namespace {

bool has_all(const TetVertices& tet, const HistorySubject& part) {
  return std::all_of(part.begin(), part.end(), [&](VertexHandle v) {
    return std::find(tet.begin(), tet.end(), v) != tet.end();
  });
}

/// Goes through a trace and finds the edits of the subject that lasted. Those that were undone are
/// left out with their undos: the last edit that stands is undone first, so that none that lasted
/// lies between them.
class Follower {
 public:
  Follower(const TraceFile& file, const HistorySubject& subject) : file_(file), subject_(subject) {}

  void run() {
    const SlotMesh& mesh = file_.initial_mesh();
    tets_.resize(mesh.tet_slots());
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      if (!mesh.is_deleted(t)) tets_[i] = mesh.vertices(t);
      at_beginning_ += is_around(tets_[i]) ? 1 : 0;
    }
    EventCursor cursor(file_);
    for (std::uint64_t k = 0; k < file_.event_count(); ++k) {
      const TraceEvent& event = cursor.next();
      if (!changes_mesh(event.kind) || event.kind == EventKind::undo || file_.is_undone(k))
        continue;
      const Edit edit{k, replace(event), moves(event)};
      if (edit.change != 0 || edit.moves) lasting_.push_back(edit);
    }
  }

  struct Edit {
    std::uint64_t event;
    int change;  // of the number of tets with the subject
    bool moves;  // a vertex of the subject
  };
  int at_beginning() const { return at_beginning_; }
  const std::vector<Edit>& lasting() const { return lasting_; }

 private:
  bool is_around(const TetVertices& tet) const {
    return tet[0].is_valid() && has_all(tet, subject_);
  }

  /// Gives the change of the number of tets with the subject.
  int replace(const TraceEvent& event) {
    if (event.kind != EventKind::replace_cavity) return 0;
    int change = 0;
    const auto set = [&](TetHandle t, const TetVertices& vertices) {
      if (t.index() >= tets_.size()) tets_.resize(t.index() + 1);
      TetVertices& tet = tets_[t.index()];
      change += (is_around(vertices) ? 1 : 0) - (is_around(tet) ? 1 : 0);
      tet = vertices;
    };
    for (const TetHandle t : event.removed) set(t, {});
    for (std::size_t i = 0; i < event.created.size(); ++i) {
      set(event.created[i], event.created_vertices[i]);
    }
    return change;
  }

  bool moves(const TraceEvent& event) const {
    return event.kind == EventKind::move_vertex &&
           std::find(subject_.begin(), subject_.end(), event.vertices.front()) != subject_.end();
  }

  const TraceFile& file_;
  const HistorySubject& subject_;
  std::vector<TetVertices> tets_;  // by slot
  int at_beginning_ = 0;
  std::vector<Edit> lasting_;
};

/// The last time that the subject was there for good.
void find_life(const Follower& follower, History& history) {
  int tets = follower.at_beginning();
  bool was_there = tets > 0;
  history.from_beginning = was_there;
  for (const Follower::Edit& edit : follower.lasting()) {
    const int before = tets;
    tets += edit.change;
    if (before == 0 && tets > 0) {
      history.made = edit.event;
      history.from_beginning = false;
      history.removed.reset();
      history.moves = 0;
      was_there = true;
    } else if (before > 0 && tets == 0) {
      history.removed = edit.event;
    }
    history.moves += tets > 0 && edit.moves ? 1 : 0;
  }
  if (!was_there) throw Error("nothing of the kind was in the mesh for good");
}

/// All vertices, edges, faces of the subject, and itself.
std::vector<PartHistory> parts_of(const HistorySubject& subject) {
  std::vector<PartHistory> parts;
  for (unsigned chosen = 1; chosen < 1u << subject.size(); ++chosen) {
    PartHistory& part = parts.emplace_back();
    for (std::size_t i = 0; i < subject.size(); ++i) {
      if ((chosen >> i & 1) != 0) part.part.push_back(subject[i]);
    }
  }
  std::stable_sort(parts.begin(), parts.end(), [](const PartHistory& a, const PartHistory& b) {
    return a.part.size() > b.part.size();
  });
  return parts;
}

/// Faces that one tet has are on the surface, and what they are made of.
void find_surface(const SlotMesh& mesh, std::vector<PartHistory>& parts) {
  const HistorySubject vertices = parts.front().part;
  std::map<HistorySubject, int> faces;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& tet = mesh.vertices(t);
    const bool is_near = std::any_of(vertices.begin(), vertices.end(), [&](VertexHandle v) {
      return std::find(tet.begin(), tet.end(), v) != tet.end();
    });
    for (std::size_t f = 0; is_near && f < 4; ++f) {
      HistorySubject face;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k != f) face.push_back(tet[k]);
      }
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  for (const auto& [face, tets] : faces) {
    if (tets != 1) continue;
    for (PartHistory& part : parts) {
      part.on_surface = part.on_surface ||
                        (part.part.size() < 4 && std::includes(face.begin(), face.end(),
                                                               part.part.begin(), part.part.end()));
    }
  }
}

/// At the subject or a part of it.
bool aims_at(const Call& call, const HistorySubject& subject) {
  return std::all_of(call.target().begin(), call.target().end(), [&](VertexHandle v) {
    return std::find(subject.begin(), subject.end(), v) != subject.end();
  });
}

HistorySubject sorted_target(const Call& call) {
  HistorySubject target(call.target().begin(), call.target().end());
  std::sort(target.begin(), target.end());
  return target;
}

void add_call(const TraceFile& file, const HistoryCall& each, PartHistory& part) {
  if (each.in_trial) {
    ++part.in_trials;
    return;
  }
  const Call& call = file.calls()[each.call];
  ++part.calls;
  part.accepted += call.accepted_for_good() ? 1 : 0;
  part.undone += call.undone ? 1 : 0;
  if (part.nearest == kNoCall) {
    part.nearest = each.call;
    return;
  }
  const Call& best = file.calls()[part.nearest];
  const bool is_refused = !call.accepted();
  if (is_refused && (best.accepted() || call.missing() <= best.missing())) part.nearest = each.call;
}

void find_calls(const TraceFile& file, History& history) {
  const std::uint64_t end = history.removed ? *history.removed + 1 : file.event_count();
  std::map<HistorySubject, PartHistory*> by_part;
  for (PartHistory& part : history.parts) by_part[part.part] = &part;
  for (std::uint32_t c = 0; c < file.calls().size(); ++c) {
    const Call& call = file.calls()[c];
    if (call.events.begin < history.made || call.events.begin >= end) continue;
    if (!aims_at(call, history.subject)) continue;
    const auto part = by_part.find(sorted_target(call));
    if (part == by_part.end()) continue;
    history.calls.push_back({c, file.is_undone(call.events.begin)});
    add_call(file, history.calls.back(), *part->second);
  }
  if (history.subject.size() < 4) return;
  for (std::uint32_t v = 0; v < file.visits().size(); ++v) {
    const Visit& visit = file.visits()[v];
    const bool is_then = visit.events.begin >= history.made && visit.events.begin < end;
    if (is_then && has_all(visit.tet, history.subject)) history.visits.push_back(v);
  }
}

void measure_tet(const SlotMesh& mesh, History& history) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || !has_all(mesh.vertices(t), history.subject)) continue;
    const TetVertices& tet = mesh.vertices(t);
    history.quality = mesh.quality(t);
    history.angles = dihedral_angles(mesh.point(tet[0]), mesh.point(tet[1]), mesh.point(tet[2]),
                                     mesh.point(tet[3]));
  }
}

}  // namespace

History history_of(const TraceFile& file, Replay& replay, const HistorySubject& subject) {
  Follower follower(file, subject);
  follower.run();
  History history;
  history.subject = subject;
  find_life(follower, history);
  if (!history.from_beginning) history.made_by = file.call_at(history.made);
  if (history.removed) history.removed_by = file.call_at(*history.removed);
  const SlotMesh& mesh = replay.mesh_at(history.removed ? *history.removed : file.event_count());
  history.parts = parts_of(subject);
  find_surface(mesh, history.parts);
  if (subject.size() == 4) measure_tet(mesh, history);
  find_calls(file, history);
  return history;
}

}  // namespace tetmend
