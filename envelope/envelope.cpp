// SPDX-License-Identifier: MIT
// One edit: what it does by numbers (replacement.h) -> does it keep near -> the vertices as they are
// afterwards, in memory of their own -> exchanged with those that were. Undo exchanges them back.
#include "envelope/envelope.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "envelope/envelope_journal.h"
#include "envelope/planes.h"
#include "kernel/error.h"

namespace tetmend {

void check(const EnvelopeOptions& options, double flatness) {
  if (!(options.angle > 0 && options.angle <= 180)) {
    throw Error(fmt::format("feature angle {}: it lies above 0, and at most at 180 degrees",
                            options.angle));
  }
  for (const double x : {options.share, options.length}) {
    if (!(x >= 0) || std::isinf(x)) throw Error(fmt::format("surface tolerance {}", x));
  }
  if (options.share > 0 && options.length > 0) {
    throw Error("surface tolerance: a share of edges or a length, not both");
  }
  if (options.length > 0 && options.length < 10 * flatness) {
    throw Error(
        fmt::format("surface tolerance {}: rounding alone may be as large", options.length));
  }
}

std::unique_ptr<Envelope> Envelope::of(const TetMesh& mesh, const EnvelopeOptions& options) {
  check(options, flatness(mesh));
  const SurfaceFeatures features =
      find_features(mesh, {options.angle, options.is_flat(), options.kept, options.held});
  auto reference =
      std::make_shared<Reference>(points_by_slot(mesh), flatness(mesh), features, options);
  PresentSurface present(points_by_slot(mesh), features);
  std::unique_ptr<Envelope> result(new Envelope(std::move(reference), std::move(present)));
  if (!options.is_flat()) result->certify_input(features);
  return result;
}

/// At first each element is certified by itself.
void Envelope::certify_input(const SurfaceFeatures& features) {
  covers_.reserve(features.faces.size() + features.edges.size());
  const auto add = [&](const PresentKey& key) {
    const auto element = static_cast<std::uint32_t>(covers_.size());
    covers_.push_back({key});
    present_.find(key[0])->served.push_back({key, element});
  };
  for (const auto& face : features.faces) add(key_of(face.vertices));
  for (const auto& edge : features.edges) add(key_of(edge.vertices[0], edge.vertices[1]));
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
  const auto number = [&](VertexHandle v) { return new_vertex[v.index()]; };
  for (auto& certifiers : covers_) {
    for (PresentKey& k : certifiers) {
      k = k[2].is_valid() ? key_of({number(k[0]), number(k[1]), number(k[2])})
                          : key_of(number(k[0]), number(k[1]));
    }
  }
}

Point Envelope::nearest(VertexHandle v, const Point& to) const {
  const SurfaceVertex* vertex = present_.find(v);
  if (vertex == nullptr || vertex->place == SurfacePlace::inside) return to;
  if (vertex->place == SurfacePlace::corner) return present_.point(v);
  const bool ridge = vertex->place == SurfacePlace::ridge;
  if (!reference_->is_flat()) {
    const std::uint32_t sheet =
        ridge ? reference_->sheet_of_line(vertex->spokes[0].line) : vertex->corners[0].patch;
    return reference_->tree.nearest(reference_->elements, sheet, to).point;
  }
  if (ridge) {
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
  if (vertex->place == SurfacePlace::ridge) {
    if (reference_->is_flat()) return reference_->lines[vertex->spokes[0].line].direction;
    return (present_.point(vertex->spokes[1].end) - present_.point(vertex->spokes[0].end))
        .normalized();
  }
  if (reference_->is_flat()) return reference_->patches[vertex->corners[0].patch].normal;
  Point sum = Point::Zero();
  for (const auto& corner : vertex->corners) {
    sum += (present_.point(corner.next) - present_.point(v))
               .cross(present_.point(corner.previous) - present_.point(v));
  }
  return sum.normalized();
}

/// Faces of patches and edges of lines that are held: their vertices are corners, so none moves.
bool Envelope::keeps_held(const Journal& journal) const {
  const SurfaceExchange& edit = journal.edit;
  const auto stays = [&](const SurfaceExchange::Face& face) {
    return std::any_of(edit.after().begin(), edit.after().end(), [&](const auto& other) {
      return key_of(other.vertices) == key_of(face.vertices);
    });
  };
  return std::all_of(edit.before().begin(), edit.before().end(),
                     [&](const SurfaceExchange::Face& face) {
                       return !reference_->patches[face.patch].held || stays(face);
                     }) &&
         std::none_of(edit.lost().begin(), edit.lost().end(),
                      [&](const auto& edge) { return reference_->lines[edge.line].held; });
}

// --- tolerance 0 ---------------------------------------------------------------------------------

bool Envelope::is_flat_edit(const Journal& journal) const {
  for (const SurfaceExchange::Face& face : journal.edit.after()) {
    if (!lies_flat(face.points, face.patch)) return false;
  }
  return keeps_lines_straight(journal);
}

bool Envelope::lies_flat(const std::array<Point, 3>& points, std::uint32_t number) const {
  const auto& patch = reference_->patches[number];
  if (patch.normal.isZero() || certified_sense(points, patch.normal) <= 0) return false;
  return std::all_of(points.begin(), points.end(), [&](const Point& p) {
    return std::abs(patch.normal.dot(p - patch.origin)) <= 2 * reference_->flatness;
  });
}

bool Envelope::keeps_lines_straight(const Journal& journal) const {
  const SurfaceExchange& edit = journal.edit;
  const auto place_on = [&](const SurfaceFeatures::Line& line, const Point& p) {
    return (p - line.origin).dot(line.direction);
  };
  const auto lies_on = [&](const SurfaceFeatures::Line& line, const Point& p) {
    const Point along = line.origin + place_on(line, p) * line.direction;
    return (p - along).norm() <= 2 * reference_->flatness;
  };
  const auto sense = [](double difference) { return (difference > 0) - (difference < 0); };
  // Which way each edge leads must not change, and a new vertex lies between its neighbours.
  for (const SurfaceExchange::Edge& edge : edit.moved()) {
    const auto& line = reference_->lines[edge.line];
    const auto [a, b] = edge.vertices;
    const Point& p = edit.vertex(a).point;
    const Point& q = edit.vertex(b).point;
    const int now = sense(place_on(line, q) - place_on(line, p));
    const int was = sense(place_on(line, present_.point(b)) - place_on(line, present_.point(a)));
    if (now == 0 || now != was || !lies_on(line, p) || !lies_on(line, q)) return false;
  }
  for (std::size_t i = 0; i < edit.gained().size(); ++i) {
    const SurfaceExchange::Edge& edge = edit.gained()[i];
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
  own.clear_proof();
  if (!own.edit.read(present_, before, after) || !keeps_held(own)) return false;
  if (!(reference_->is_flat() ? is_flat_edit(own) : is_near_edit(own))) return false;
  commit(own);
  return true;
}

namespace {

bool is_before(const SurfaceExchange& edit, VertexHandle v, const SurfaceVertex::Corner& corner) {
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

/// Faces and feature edges of the vertex after the edit.
void exchange_faces(const SurfaceExchange& edit, VertexHandle v, SurfaceVertex& data) {
  std::erase_if(data.corners, [&](const auto& corner) { return is_before(edit, v, corner); });
  std::erase_if(data.spokes, [&](const auto& spoke) {
    return std::any_of(edit.lost().begin(), edit.lost().end(), [&](const auto& edge) {
      return key_of(edge.vertices[0], edge.vertices[1]) == key_of(v, spoke.end);
    });
  });
  for (const auto& face : edit.after()) {
    for (unsigned k = 0; k < 3; ++k) {
      if (face.vertices[k] != v) continue;
      data.corners.push_back({face.vertices[(k + 1) % 3], face.vertices[(k + 2) % 3], face.patch});
    }
  }
  for (const auto& edge : edit.gained()) {
    for (unsigned k = 0; k < 2; ++k) {
      if (edge.vertices[k] == v) data.spokes.push_back({edge.vertices[1 - k], edge.line});
    }
  }
}

}  // namespace

void Envelope::commit(Journal& journal) {
  const auto vertices = journal.edit.vertices();
  const std::size_t most = vertices.back().vertex.index();
  if (most >= present_.slots()) present_.resize(most + 1);
  const JournalStep step{journal.saved.size(), journal.saved_covers.size()};
  journal.steps.reserve(journal.steps.size() + 1);
  try {
    const auto copy = [&](VertexHandle v) {
      const SurfaceVertex* old = present_.find(v);
      return old == nullptr ? std::make_unique<SurfaceVertex>()
                            : std::make_unique<SurfaceVertex>(*old);
    };
    for (const SurfaceExchange::Vertex& vertex : vertices) {
      journal.saved.push_back({vertex.vertex, copy(vertex.vertex), vertex.point});
      SurfaceVertex& data = *journal.saved.back().data;
      data.place = vertex.place;
      exchange_faces(journal.edit, vertex.vertex, data);
      journal.exchange_served(vertex.vertex, data);
      if (data.corners.empty()) journal.saved.back().data.reset();
    }
    for (const VertexHandle v : journal.others) {
      journal.saved.push_back({v, copy(v), present_.point(v)});
      journal.exchange_served(v, *journal.saved.back().data);
    }
    for (auto& proof : journal.proofs) {
      journal.saved_covers.push_back({proof.element, std::move(proof.certifiers)});
    }
  } catch (...) {
    journal.saved.erase(journal.saved.begin() + static_cast<std::ptrdiff_t>(step.saved),
                        journal.saved.end());
    journal.saved_covers.resize(step.covers);
    throw;
  }
  journal.steps.push_back(step);  // from here on nothing can fail
  exchange(journal, step);
}

/// Puts what the journal has since the step in place, and what was there into the journal.
void Envelope::exchange(Journal& journal, const JournalStep& step) noexcept {
  for (std::size_t i = step.saved; i < journal.saved.size(); ++i) {
    Journal::Saved& saved = journal.saved[i];
    present_.exchange(saved.vertex, saved.data, saved.point);
  }
  for (std::size_t i = step.covers; i < journal.saved_covers.size(); ++i) {
    covers_[journal.saved_covers[i].element].swap(journal.saved_covers[i].certifiers);
  }
}

void Envelope::undo(SurfaceJournal& journal) noexcept {
  auto& own = static_cast<Journal&>(journal);
  const JournalStep step = own.steps.back();
  own.steps.pop_back();
  exchange(own, step);
  own.saved.erase(own.saved.begin() + static_cast<std::ptrdiff_t>(step.saved), own.saved.end());
  own.saved_covers.resize(step.covers);
}

}  // namespace tetmend
