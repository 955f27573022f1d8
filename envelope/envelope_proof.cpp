// SPDX-License-Identifier: MIT
// Tolerances other than 0: one edit keeps the proof, or is refused.
//
//   new faces and edges: near the reference? -> elements that were certified by what vanishes: near
//   what comes and what else certified them? -> bends
#include <algorithm>
#include <cmath>

#include "envelope/envelope_journal.h"

namespace tetmend {

namespace {

const double kLeastCosine = std::sqrt(0.75);  // 30 degrees

// An edit may make this many times the bends that it found, and so many tolerances more: a vertex
// that moves by one tolerance in a plane bends about twelve edges by that over their length.
constexpr double kMoreBends = 1.25;
constexpr double kBendsForTolerance = 4;

/// The normals do not speak against it; one that means nothing never does.
bool may_certify(const Point& a, const Point& b, unsigned corners) {
  if (a.isZero() || b.isZero()) return true;
  const double cosine = a.dot(b);
  return (corners == 2 ? std::abs(cosine) : cosine) >= kLeastCosine;
}

std::array<Point, 3> segment(const Point& a, const Point& b) {
  return {a, b, b};
}

}  // namespace

bool Envelope::is_near_edit(Journal& journal) const {
  const SurfaceExchange& edit = journal.edit;
  for (const SurfaceExchange::Face& face : edit.after()) {
    if (!lies_near(journal, face.points, 3, face.patch)) return false;
  }
  for (const auto& edges : {edit.moved(), edit.gained()}) {
    for (const SurfaceExchange::Edge& edge : edges) {
      const auto points =
          segment(edit.vertex(edge.vertices[0]).point, edit.vertex(edge.vertices[1]).point);
      if (!lies_near(journal, points, 2, reference_->sheet_of_line(edge.line))) return false;
    }
  }
  return certify_elements(journal) && !bends_too_much(journal);
}

/// Of a face or feature edge to come: it lies within the tolerance of its sheet of the reference.
bool Envelope::lies_near(Journal& journal, const std::array<Point, 3>& points, unsigned corners,
                         std::uint32_t sheet, bool nearest) const {
  const Point normal = normal_of(points, corners, 0);
  if (normal.isZero()) return false;
  journal.elements.clear();
  journal.targets.clear();
  reference_->tree.find(reference_->elements, sheet, box_of(points), journal.elements);
  for (const std::uint32_t i : journal.elements) {
    const Element& element = reference_->elements[i];
    if (!may_certify(element.normal, normal, corners)) continue;
    journal.targets.push_back(
        {element.points, element.corners, journal.widened(element.tolerance), element.normal});
  }
  return journal.cover.covers(points, corners, journal.targets, nearest);
}

/// Fills the proofs.
bool Envelope::certify_elements(Journal& journal) const {
  const SurfaceExchange& edit = journal.edit;
  for (const auto& face : edit.before()) journal.gone.push_back(key_of(face.vertices));
  for (const auto& edges : {edit.lost(), edit.moved()}) {
    for (const auto& edge : edges) {
      journal.gone.push_back(key_of(edge.vertices[0], edge.vertices[1]));
    }
  }
  std::sort(journal.gone.begin(), journal.gone.end());
  std::vector<std::uint32_t> elements;
  for (const PresentKey& key : journal.gone) {
    for (const auto& entry : present_.find(key[0])->served) {
      if (entry.key == key) elements.push_back(entry.element);
    }
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  for (const std::uint32_t element : elements) {
    if (!certify(journal, element)) return false;
  }
  for (const auto* changes : {&journal.dropped, &journal.added}) {
    for (const auto& entry : *changes) {
      const auto vertices = edit.vertices();
      const bool known = std::any_of(vertices.begin(), vertices.end(), [&](const auto& vertex) {
        return vertex.vertex == entry.key[0];
      });
      if (!known) journal.others.push_back(entry.key[0]);
    }
  }
  std::sort(journal.others.begin(), journal.others.end());
  journal.others.erase(std::unique(journal.others.begin(), journal.others.end()),
                       journal.others.end());
  return true;
}

/// Of one element: what is left of its certifiers and what comes, one of them or together.
bool Envelope::certify(Journal& journal, std::uint32_t number) const {
  const Element& element = reference_->elements[number];
  const SurfaceExchange& edit = journal.edit;
  journal.targets.clear();
  journal.keys.clear();
  const auto offer = [&](const PresentKey& key, const std::array<Point, 3>& points) {
    const Point normal = normal_of(points, element.corners, 0);
    if (!may_certify(element.normal, normal, element.corners)) return;
    journal.keys.push_back(key);
    journal.targets.push_back({points, element.corners, element.tolerance, normal});
  };
  const Box near = box_around(element);
  if (element.corners == 3) {
    for (const auto& face : edit.after()) {
      if (face.patch == element.sheet && box_of(face.points).intersects(near)) {
        offer(key_of(face.vertices), face.points);
      }
    }
  } else {
    for (const auto& edges : {edit.moved(), edit.gained()}) {
      for (const auto& edge : edges) {
        if (reference_->sheet_of_line(edge.line) != element.sheet) continue;
        offer(key_of(edge.vertices[0], edge.vertices[1]),
              segment(edit.vertex(edge.vertices[0]).point, edit.vertex(edge.vertices[1]).point));
      }
    }
  }
  const std::vector<PresentKey>& old = covers_[number];
  for (const PresentKey& key : old) {
    if (journal.is_gone(key)) continue;
    for (unsigned k = 0; k < element.corners; ++k) {
      if (journal.territory.holds(key[k])) continue;
      journal.met_border = true;  // somebody else may change it at this moment
      return false;
    }
    PresentKey v = key;
    if (element.corners == 2) {
      v[2] = v[1];
    } else if (present_.patch_of_oriented(v) == kNone) {
      std::swap(v[1], v[2]);
    }
    offer(key, {present_.point(v[0]), present_.point(v[1]), present_.point(v[2])});
  }
  if (!journal.cover.covers(element.points, element.corners, journal.targets)) return false;
  Journal::Certified proof{number, {}};
  for (std::size_t i = 0; i < journal.targets.size(); ++i) {
    if (journal.targets[i].used) proof.certifiers.push_back(journal.keys[i]);
  }
  for (const PresentKey& key : old) {
    const auto& now = proof.certifiers;
    if (journal.is_gone(key) || std::find(now.begin(), now.end(), key) != now.end()) continue;
    journal.dropped.push_back({key, number});
  }
  for (const PresentKey& key : proof.certifiers) {
    const bool had = std::find(old.begin(), old.end(), key) != old.end() && !journal.is_gone(key);
    if (!had) journal.added.push_back({key, number});
  }
  journal.proofs.push_back(std::move(proof));
  return true;
}

/// The sum of bends at the edges of what changes, each times the length of the edge.
bool Envelope::bends_too_much(const Journal& journal) const {
  const SurfaceExchange& edit = journal.edit;
  const double before = bending(edit, edit.before());
  const double after = bending(edit, edit.after());
  const double tolerance = reference_->tolerance(edit.after().front().patch);
  return after > kMoreBends * before + kBendsForTolerance * tolerance;
}

double Envelope::bending(const SurfaceExchange& edit,
                         std::span<const SurfaceExchange::Face> faces) const {
  double sum = 0;
  const auto add = [&](const SurfaceExchange::Face& face, const std::array<Point, 3>& other,
                       double length) {
    const Point n = normal_of(face.points, 3, 0);
    const Point m = normal_of(other, 3, 0);
    sum += length * std::atan2(n.cross(m).norm(), n.dot(m));
  };
  for (const SurfaceExchange::Face& face : faces) {
    for (unsigned k = 0; k < 3; ++k) {
      const VertexHandle a = face.vertices[k];
      const VertexHandle b = face.vertices[(k + 1) % 3];
      const double length = (face.points[(k + 1) % 3] - face.points[k]).norm();
      const auto beside = std::find_if(faces.begin(), faces.end(), [&](const auto& other) {
        const auto& v = other.vertices;
        return other.patch == face.patch &&
               ((v[0] == b && v[1] == a) || (v[1] == b && v[2] == a) || (v[2] == b && v[0] == a));
      });
      if (beside != faces.end()) {
        if (a < b && !edit.is_feature(present_, a, b)) add(face, beside->points, length);
        continue;
      }
      const SurfaceVertex* vertex = present_.find(b);
      if (vertex == nullptr || edit.is_feature(present_, a, b)) continue;
      for (const auto& corner : vertex->corners) {  // the face outside is what it was
        if (corner.next != a || corner.patch != face.patch) continue;
        add(face, {face.points[(k + 1) % 3], face.points[k], present_.point(corner.previous)},
            length);
      }
    }
  }
  return sum;
}

/// Those of the keys that may certify an element. True: they do, together.
bool Envelope::offer_present(Journal& journal, std::uint32_t number,
                             const std::vector<PresentKey>& keys) const {
  const Element& element = reference_->elements[number];
  journal.targets.clear();
  journal.keys.clear();
  for (const PresentKey& key : keys) {
    PresentKey v = key;
    if (element.corners == 2) {
      v[2] = v[1];
    } else if (present_.patch_of_oriented(v) == kNone) {
      std::swap(v[1], v[2]);
    }
    const std::array<Point, 3> points = {present_.point(v[0]), present_.point(v[1]),
                                         present_.point(v[2])};
    const Point normal = normal_of(points, element.corners, 0);
    if (!may_certify(element.normal, normal, element.corners)) continue;
    journal.keys.push_back(key);
    journal.targets.push_back(
        {points, element.corners, journal.widened(element.tolerance), normal});
  }
  return journal.cover.covers(element.points, element.corners, journal.targets, true);
}

SurfaceBound Envelope::proven_bound() const {
  Journal journal;
  return bound(journal);
}

SurfaceBound Envelope::bound(Journal& journal) const {
  SurfaceBound bound;
  const auto note = [&](bool is_proven, double tolerance) {
    // Not proven: other pieces, too many of them.
    const double distance = is_proven ? journal.cover.bound() : tolerance;
    bound.unproven += is_proven ? 0 : 1;
    bound.distance = std::max(bound.distance, distance);
    if (distance > 0) bound.share = std::max(bound.share, distance / tolerance);
  };
  for (std::uint32_t i = 0; i < present_.slots(); ++i) {
    const VertexHandle v(i);
    if (present_.find(v) == nullptr) continue;
    for (const auto& corner : present_.find(v)->corners) {
      if (corner.next < v || corner.previous < v) continue;
      ++bound.faces;
      const std::array<Point, 3> points = {present_.point(v), present_.point(corner.next),
                                           present_.point(corner.previous)};
      if (reference_->triangles.contains(points)) continue;
      ++bound.touched;
      if (reference_->is_flat()) {
        bound.distance = 3 * reference_->flatness;
        bound.unproven += lies_flat(points, corner.patch) ? 0 : 1;
        continue;
      }
      note(lies_near(journal, points, 3, corner.patch, true), reference_->tolerance(corner.patch));
    }
    if (reference_->is_flat()) continue;
    for (const auto& spoke : present_.find(v)->spokes) {
      if (spoke.end < v) continue;
      const std::uint32_t sheet = reference_->sheet_of_line(spoke.line);
      const auto points = segment(present_.point(v), present_.point(spoke.end));
      note(lies_near(journal, points, 2, sheet, true), reference_->tolerance(sheet));
    }
  }
  for (std::uint32_t e = 0; e < covers_.size(); ++e) {
    note(offer_present(journal, e, covers_[e]), reference_->elements[e].tolerance);
  }
  return bound;
}

}  // namespace tetmend
