// SPDX-License-Identifier: MIT
// One edit: what it does by numbers (replacement.h) -> does it keep near -> the vertices as they are
// afterwards, in memory of their own -> exchanged with those that were. Undo exchanges them back.
#include "envelope/envelope.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "envelope/planes.h"
#include "envelope/replacement.h"
#include "kernel/error.h"

namespace tetmend {

struct Envelope::Reference {
  double tolerance = 0;  // of flatness
  std::vector<SurfaceFeatures::Patch> patches;
  std::vector<SurfaceFeatures::Line> lines;
};

class Envelope::Journal final : public SurfaceJournal {
 public:
  void clear() noexcept override {
    saved.clear();
    steps.clear();
  }

  struct Saved {
    VertexHandle vertex;
    std::unique_ptr<SurfaceVertex> data;
    Point point;
  };
  std::vector<Saved> saved;
  std::vector<std::size_t> steps;  // where each begins in `saved`
  Replacement edit;                // working memory
};

std::unique_ptr<Envelope> Envelope::of(const TetMesh& mesh, const EnvelopeOptions& options) {
  if (!(options.angle > 0 && options.angle < 180)) {
    throw Error(fmt::format("feature angle {}: it lies between 0 and 180 degrees", options.angle));
  }
  if (!options.is_flat()) throw Error("only tolerance 0");
  const SurfaceFeatures features =
      find_features(mesh, {options.angle, options.is_flat(), options.kept});
  auto reference = std::make_shared<Reference>();
  reference->tolerance = flatness(mesh);
  reference->patches = features.patches;
  reference->lines = features.lines;
  return std::unique_ptr<Envelope>(
      new Envelope(std::move(reference), PresentSurface(mesh, features)));
}

std::unique_ptr<SurfaceGuard> Envelope::clone() const {
  return std::make_unique<Envelope>(*this);
}

std::unique_ptr<SurfaceJournal> Envelope::make_journal() const {
  return std::make_unique<Journal>();
}

SurfacePlace Envelope::place(VertexHandle v) const {
  return present_.place(v);
}

std::uint32_t Envelope::patch(const std::array<VertexHandle, 3>& face) const {
  return present_.patch(face);
}

std::uint32_t Envelope::line(VertexHandle a, VertexHandle b) const {
  return present_.line(a, b);
}

void Envelope::resize(std::size_t vertex_slots) {
  present_.resize(vertex_slots);
}

void Envelope::renumber(std::span<const VertexHandle> new_vertex, std::size_t vertex_slots) {
  present_.renumber(new_vertex, vertex_slots);
}

Point Envelope::nearest(VertexHandle v, const Point& to) const {
  const SurfaceVertex* vertex = present_.find(v);
  if (vertex == nullptr || vertex->place == SurfacePlace::inside) return to;
  if (vertex->place == SurfacePlace::corner) return present_.point(v);
  if (vertex->place == SurfacePlace::ridge) {
    const auto& line = reference_->lines[vertex->spokes[0].line];
    return line.origin + (to - line.origin).dot(line.direction) * line.direction;
  }
  const auto& patch = reference_->patches[vertex->corners[0].patch];
  Point result = to - patch.normal.dot(to - patch.origin) * patch.normal;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {  // without rounding, where that is possible
    if (std::abs(patch.normal[axis]) == 1) result[axis] = patch.origin[axis];
  }
  return result;
}

Point Envelope::direction(VertexHandle v, const Point&) const {
  const SurfaceVertex* vertex = present_.find(v);
  if (vertex == nullptr) return Point::Zero();
  return vertex->place == SurfacePlace::ridge && !vertex->spokes.empty()
             ? reference_->lines[vertex->spokes[0].line].direction
             : reference_->patches[vertex->corners[0].patch].normal;
}

// --- tolerance 0 ---------------------------------------------------------------------------------

bool Envelope::is_flat_edit(const Journal& journal) const {
  for (const Replacement::Face& face : journal.edit.after()) {
    const auto& patch = reference_->patches[face.patch];
    if (patch.normal.isZero() || certified_sense(face.points, patch.normal) <= 0) return false;
    for (const Point& p : face.points) {
      if (!(std::abs(patch.normal.dot(p - patch.origin)) <= 2 * reference_->tolerance))
        return false;
    }
  }
  return keeps_lines_straight(journal);
}

bool Envelope::keeps_lines_straight(const Journal& journal) const {
  const Replacement& edit = journal.edit;
  const auto place_on = [&](const SurfaceFeatures::Line& line, const Point& p) {
    return (p - line.origin).dot(line.direction);
  };
  const auto lies_on = [&](const SurfaceFeatures::Line& line, const Point& p) {
    const Point along = line.origin + place_on(line, p) * line.direction;
    return (p - along).norm() <= 2 * reference_->tolerance;
  };
  const auto sense = [](double difference) { return (difference > 0) - (difference < 0); };
  // Which way each edge leads must not change, and a new vertex lies between its neighbours.
  for (const Replacement::Edge& edge : edit.moved()) {
    const auto& line = reference_->lines[edge.line];
    const auto [a, b] = edge.vertices;
    const Point& p = edit.vertex(a).point;
    const Point& q = edit.vertex(b).point;
    const int now = sense(place_on(line, q) - place_on(line, p));
    const int was = sense(place_on(line, present_.point(b)) - place_on(line, present_.point(a)));
    if (now == 0 || now != was || !lies_on(line, p) || !lies_on(line, q)) return false;
  }
  for (std::size_t i = 0; i < edit.gained().size(); ++i) {
    const Replacement::Edge& edge = edit.gained()[i];
    const auto& line = reference_->lines[edge.line];
    const Point& p = edit.vertex(edge.vertices[0]).point;
    const Point& q = edit.vertex(edge.vertices[1]).point;
    const double step = place_on(line, q) - place_on(line, p);
    if (step == 0 || !lies_on(line, p) || !lies_on(line, q)) return false;
    if (edit.vertex(edge.vertices[0]).before > 0) continue;  // else the second of two
    const Point& o = edit.vertex(edit.gained()[i - 1].vertices[0]).point;
    if (sense(place_on(line, p) - place_on(line, o)) != sense(step)) return false;
  }
  return true;
}

// --- replace and undo ----------------------------------------------------------------------------

bool Envelope::replace(std::span<const SurfaceFace> before, std::span<const SurfaceFace> after,
                       SurfaceJournal& journal) {
  auto& own = static_cast<Journal&>(journal);
  if (!own.edit.read(present_, before, after) || !is_flat_edit(own)) return false;
  commit(own);
  return true;
}

namespace {

bool is_before(const Replacement& edit, VertexHandle v, const SurfaceVertex::Corner& corner) {
  return std::any_of(edit.before().begin(), edit.before().end(), [&](const auto& face) {
    for (unsigned k = 0; k < 3; ++k) {
      if (face.vertices[k] == v) {
        return face.vertices[(k + 1) % 3] == corner.next &&
               face.vertices[(k + 2) % 3] == corner.previous;
      }
    }
    return false;
  });
}

/// The vertex after the edit; null if it leaves the surface.
std::unique_ptr<SurfaceVertex> make_vertex(const Replacement& edit,
                                           const Replacement::Vertex& vertex,
                                           const SurfaceVertex* old) {
  const VertexHandle v = vertex.vertex;
  if (vertex.after == 0 && old != nullptr && old->corners.size() == vertex.before) return nullptr;
  auto result = std::make_unique<SurfaceVertex>();
  result->place = vertex.place;
  if (old != nullptr) {
    for (const auto& corner : old->corners) {
      if (!is_before(edit, v, corner)) result->corners.push_back(corner);
    }
    for (const auto& spoke : old->spokes) {
      const auto is_lost = [&](const Replacement::Edge& edge) {
        return key_of(edge.vertices[0], edge.vertices[1]) == key_of(v, spoke.end);
      };
      if (std::none_of(edit.lost().begin(), edit.lost().end(), is_lost)) {
        result->spokes.push_back(spoke);
      }
    }
    result->served = old->served;
  }
  for (const auto& face : edit.after()) {
    for (unsigned k = 0; k < 3; ++k) {
      if (face.vertices[k] != v) continue;
      result->corners.push_back(
          {face.vertices[(k + 1) % 3], face.vertices[(k + 2) % 3], face.patch});
    }
  }
  for (const auto& edge : edit.gained()) {
    for (unsigned k = 0; k < 2; ++k) {
      if (edge.vertices[k] == v) result->spokes.push_back({edge.vertices[1 - k], edge.line});
    }
  }
  return result;
}

}  // namespace

void Envelope::commit(Journal& journal) {
  const auto vertices = journal.edit.vertices();
  const std::size_t most = vertices.back().vertex.index();
  if (most >= present_.slots()) present_.resize(most + 1);
  const std::size_t first = journal.saved.size();
  journal.steps.reserve(journal.steps.size() + 1);
  try {
    for (const Replacement::Vertex& vertex : vertices) {
      journal.saved.push_back({vertex.vertex,
                               make_vertex(journal.edit, vertex, present_.find(vertex.vertex)),
                               vertex.point});
    }
  } catch (...) {
    journal.saved.resize(first);
    throw;
  }
  journal.steps.push_back(first);  // from here on nothing can fail
  for (std::size_t i = first; i < journal.saved.size(); ++i) {
    Journal::Saved& saved = journal.saved[i];
    present_.exchange(saved.vertex, saved.data, saved.point);
  }
}

void Envelope::undo(SurfaceJournal& journal) noexcept {
  auto& own = static_cast<Journal&>(journal);
  const std::size_t first = own.steps.back();
  own.steps.pop_back();
  for (std::size_t i = own.saved.size(); i-- > first;) {
    Journal::Saved& saved = own.saved[i];
    present_.exchange(saved.vertex, saved.data, saved.point);
  }
  own.saved.erase(own.saved.begin() + static_cast<std::ptrdiff_t>(first), own.saved.end());
}

}  // namespace tetmend
