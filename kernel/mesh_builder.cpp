// SPDX-License-Identifier: MIT
// Builds a TetMesh from plain arrays: orientation, adjacency, constraints, qualities.
//
//   check indices
//   bring the coordinates to a scale that can be worked with
//   slots: as the file has vertices and tets, or along a curve, so that all that follows works on
//          neighbours in memory; the arrays of the file are released on the way
//   orient: swap two vertices of every tet if most are negative, and so is their sum
//   match faces: vertex by vertex, those of which it is the smallest; where that fails, or tets are
//                negative, walk over faces: all tets of a component get one sense, that of its
//                volume; then match again
//   surface: named triangles in file order, then boundary faces and label interfaces that no
//            triangle names
//   constraints: face bits, edge bits, fixed vertices; without those inside regions, if so asked
#include "kernel/mesh_builder.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "kernel/chunks.h"
#include "kernel/compensated_sum.h"
#include "kernel/edge_tets.h"
#include "kernel/grouping.h"
#include "kernel/hilbert.h"
#include "kernel/make_room.h"
#include "kernel/tet_batch.h"

namespace tetmend {

namespace {

/// Room that is taken before it is needed costs addresses, not memory. An improved mesh may be a
/// little larger, and arrays that grow would exist twice meanwhile.
template <class T>
void resize_with_room(std::vector<T>& values, std::size_t size) {
  values.reserve(size + size / 4);
  values.resize(size);
}

}  // namespace

void MeshBuilder::check_indices() const {
  const std::size_t n = data_.points.size();
  const auto& tets = data_.tets;
  if (tets.empty()) throw Error("the mesh has no tetrahedra");
  if (tets.size() >= (std::size_t{1} << 29) || n >= (std::size_t{1} << 31)) {
    throw Error(fmt::format("{} tetrahedra and {} points are more than 32-bit indices can name",
                            tets.size(), n));
  }
  const auto is_wrong = [n](const MeshData::Tet& tet) {
    const auto& [a, b, c, d] = tet.vertices;
    return std::max(std::max(a, b), std::max(c, d)) >= n || a == b || a == c || a == d || b == c ||
           b == d || c == d;
  };
  const auto wrong = map_chunks<std::size_t>(tets.size(), [&](std::size_t begin, std::size_t end) {
    while (begin < end && !is_wrong(tets[begin])) ++begin;
    return begin < end ? begin : tets.size();
  });
  if (const std::size_t t = *std::min_element(wrong.begin(), wrong.end()); t < tets.size()) {
    const auto& v = tets[t].vertices;
    const auto* missing = std::find_if(v.begin(), v.end(), [n](std::uint32_t i) { return i >= n; });
    const std::string reason =
        missing == v.end() ? "the same vertex twice" : missing_point(*missing);
    throw BuildError(fmt::format("{}: {}", describe(t, v), reason), t);
  }
  const auto check = [&](std::span<const std::uint32_t> vertices, const char* what,
                         std::size_t number) {
    for (const std::uint32_t v : vertices) {
      if (v < n) continue;
      throw Error(fmt::format("{} {}: {}", what, number + first_number_, missing_point(v)));
    }
  };
  for (std::size_t i = 0; i < data_.triangles.size(); ++i)
    check(data_.triangles[i].vertices, "triangle", i);
  for (std::size_t i = 0; i < data_.edges.size(); ++i) check(data_.edges[i].vertices, "edge", i);
  check(data_.required_vertices, "required vertex", 0);
}

void MeshBuilder::place_vertices(bool sorted) {
  const std::size_t n = data_.points.size();
  resize_with_room(mesh_.vertex_origin_, n);
  std::iota(mesh_.vertex_origin_.begin(), mesh_.vertex_origin_.end(), 0u);
  if (sorted) {
    sort_along_curve(data_.points, mesh_.vertex_origin_);
    slot_of_.resize(n);
    resize_with_room(mesh_.points_, n);
    for_chunks(n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        mesh_.points_[v] = data_.points[mesh_.vertex_origin_[v]];
        slot_of_[mesh_.vertex_origin_[v]] = static_cast<std::uint32_t>(v);
      }
    });
    release(data_.points);
  } else {
    mesh_.points_ = std::move(data_.points);
  }
  resize_with_room(mesh_.vertex_tet_, n);
  resize_with_room(mesh_.vertex_flags_, n);
  resize_with_room(mesh_.vertex_dates_, n);
  mesh_.vertex_count_ = n;
  mesh_.point_labels_ = std::move(data_.point_labels);
}

/// Gives the tets by their smallest vertex.
Grouping MeshBuilder::place_tets(bool sorted) {
  const std::size_t n = data_.tets.size();
  Grouping groups;
  {
    std::vector<std::uint32_t> smallest(n);
    for_chunks(n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto& v = data_.tets[t].vertices;
        smallest[t] = std::min({vertex(v[0]), vertex(v[1]), vertex(v[2]), vertex(v[3])}).index();
      }
    });
    groups = group_by_key(smallest, static_cast<std::uint32_t>(mesh_.points_.size()));
  }
  if (sorted) file_tet_ = std::exchange(groups.order, {});
  constexpr std::size_t kAhead = 16;  // tets of the file that memory is asked for in advance
  resize_with_room(mesh_.cells_, n);
  resize_with_room(mesh_.label_, n);
  for_chunks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (t + kAhead < end) __builtin_prefetch(&data_.tets[file_tet(t + kAhead)]);
      const MeshData::Tet& tet = data_.tets[file_tet(t)];
      for (std::size_t i = 0; i < 4; ++i) mesh_.cells_[t].vertices[i] = vertex(tet.vertices[i]);
      mesh_.label_[t] = tet.label;
    }
  });
  release(data_.tets);
  resize_with_room(mesh_.quality_, n);
  resize_with_room(mesh_.tet_flags_, n);
  mesh_.tet_count_ = n;
  return groups;
}

void MeshBuilder::check_lengths() const {
  const auto is_wrong = [this](std::size_t t) {
    const TetVertices& v = mesh_.cells_[t].vertices;
    return is_lost(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
  };
  const std::size_t n = mesh_.cells_.size();
  const auto wrong = map_chunks<std::size_t>(n, [&](std::size_t begin, std::size_t end) {
    std::size_t first = n;  // as the file counts
    for (std::size_t t = begin; t < end; ++t) {
      if (is_wrong(t)) first = std::min<std::size_t>(first, file_tet(t));
    }
    return first;
  });
  const std::size_t first = *std::min_element(wrong.begin(), wrong.end());
  if (first == n) return;
  std::size_t slot = 0;
  while (file_tet(slot) != first) ++slot;
  throw BuildError(
      fmt::format("{}: shorter than {:.1g}, too short to be worked with in a mesh of this width",
                  describe(slot), mesh_.scale_.to_file(Scale::kShortestTet)),
      first);
}

void MeshBuilder::add_sign(std::size_t t, bool certified, Signs& signs) const {
  if (certified) {
    ++signs.positive;
    return;
  }
  const TetVertices& v = mesh_.cells_[t].vertices;
  const double v6 = tet_volume6(t);
  signs.positive += v6 > 0 ? 1 : 0;
  signs.negative += v6 < 0 ? 1 : 0;
  const bool inverted = v6 < 0 && mesh_.is_certified_positive({v[0], v[1], v[3], v[2]});
  ++(inverted ? signs.inverted : signs.flat);
}

/// Of a range of tets.
MeshBuilder::Signs MeshBuilder::evaluate(std::size_t begin, std::size_t end) {
  constexpr std::size_t kBatch = 128;  // stays in the first cache
  Signs signs;
  TetBatch batch;
  for (std::size_t first = begin; first < end; first += kBatch) {
    const std::size_t last = std::min(end, first + kBatch);
    batch.clear();
    for (std::size_t t = first; t < last; ++t) {
      const TetVertices& v = mesh_.cells_[t].vertices;
      batch.add(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
    }
    batch.evaluate(mesh_.standard());
    for (std::size_t t = first; t < last; ++t) {
      mesh_.quality_[t] = batch.quality(t - first);
      add_sign(t, batch.is_certified_positive(t - first), signs);
    }
  }
  return signs;
}

/// Computes the qualities, and counts signs on the way.
MeshBuilder::Signs MeshBuilder::evaluate() {
  const auto parts =
      map_chunks<Signs>(mesh_.cells_.size(),
                        [&](std::size_t begin, std::size_t end) { return evaluate(begin, end); });
  Signs sum;
  for (const Signs& part : parts) {
    sum.positive += part.positive;
    sum.negative += part.negative;
    sum.inverted += part.inverted;
    sum.flat += part.flat;
  }
  report_.inverted_tets = sum.inverted;
  report_.flat_tets = sum.flat;
  return sum;
}

/// In rounded numbers.
double MeshBuilder::volume6_of_all() const {
  const auto parts =
      map_chunks<CompensatedSum>(mesh_.cells_.size(), [&](std::size_t begin, std::size_t end) {
        CompensatedSum sum;
        for (std::size_t t = begin; t < end; ++t) sum.add(tet_volume6(t));
        return sum;
      });
  CompensatedSum sum;
  for (const CompensatedSum& part : parts) sum.add(part);
  return sum.value();
}

/// True if negative tets are left.
bool MeshBuilder::orient() {
  const Signs signs = evaluate();
  if (signs.negative <= signs.positive || volume6_of_all() > 0) return signs.negative > 0;
  report_.mirrored = true;
  for_chunks(mesh_.cells_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) swap_orientation(t);
  });
  return evaluate().negative > 0;
}

void MeshBuilder::match_faces(const FaceBuckets& buckets, bool has_negative) {
  std::vector<std::uint32_t> trouble = match(buckets);
  if (trouble.empty() && !has_negative) return;
  if (!trouble.empty()) check_buckets(buckets, trouble, false);
  // A negative tet is folded over, or it lists its vertices the other way round. Its neighbours
  // know, and of all tets that hang together the sum of their volumes.
  reorder_tets();
  if (report_.reordered_tets > 0) trouble = match(buckets);
  if (!trouble.empty()) check_buckets(buckets, trouble, true);
  if (report_.reordered_tets > 0) evaluate();
}

/// Makes neighbours of the tets that share a face. Gives the vertices where two tets lie on the
/// same side of a face or more than two have it.
std::vector<std::uint32_t> MeshBuilder::match(const FaceBuckets& buckets) {
  constexpr std::size_t kVerticesOfChunk = 2048;
  const auto parts = map_chunks<std::vector<std::uint32_t>>(
      mesh_.points_.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> trouble;
        FacePairs pairs;
        for (std::size_t i = begin; i < end; ++i) {
          const auto v = static_cast<std::uint32_t>(i);
          bool sound = true;
          pairs.begin(buckets.bound(v));
          buckets.visit(v, [&](const Entry& entry) {
            FacePairs::Side other;
            const FacePairs::Found found = pairs.add(entry, other);
            if (found == FacePairs::Found::first) return;
            sound &= found == FacePairs::Found::second && entry.even != other.even;
            if (found == FacePairs::Found::third) return;
            mesh_.cells_[entry.face.tet().index()].neighbours[entry.face.face()] = other.face;
            mesh_.cells_[other.face.tet().index()].neighbours[other.face.face()] = entry.face;
          });
          if (!sound) trouble.push_back(v);
        }
        return trouble;
      },
      kVerticesOfChunk);
  std::vector<std::uint32_t> trouble;
  for (const auto& part : parts) trouble.insert(trouble.end(), part.begin(), part.end());
  return trouble;
}

/// Of the sides of one face two that are of the same tet, listed twice.
std::pair<HalfFace, HalfFace> MeshBuilder::repeated(const std::vector<Entry>& entries,
                                                    std::size_t begin, std::size_t end) const {
  constexpr std::size_t kMost = 8;  // of more, some others will do
  const auto apex = [&](const Entry& entry) {
    return mesh_.vertices(entry.face.tet())[entry.face.face()];
  };
  for (std::size_t i = begin + 1; i < std::min(end, begin + kMost); ++i) {
    for (std::size_t k = begin; k < i; ++k) {
      if (apex(entries[k]) == apex(entries[i])) return {entries[k].face, entries[i].face};
    }
  }
  return {};
}

/// Throws for the first tet, as the file counts them, that is one too many at a face or lies on the
/// same side of it as another tet.
void MeshBuilder::check_buckets(const FaceBuckets& buckets,
                                const std::vector<std::uint32_t>& vertices, bool senses) const {
  std::size_t first = mesh_.cells_.size();
  std::string message;
  const auto blame = [&](HalfFace f, const std::string& what) {
    const std::size_t t = file_tet(f.tet().index());
    if (t >= first) return;
    first = t;
    message = describe(f.tet().index()) + what;
  };
  std::vector<Entry> entries;
  for (const std::uint32_t v : vertices) {
    entries.clear();
    buckets.visit(v, [&](const Entry& entry) { entries.push_back(entry); });
    std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
      return std::tuple(a.low, a.high, file_code(a.face)) <
             std::tuple(b.low, b.high, file_code(b.face));
    });
    for (std::size_t i = 0; i < entries.size();) {
      std::size_t j = i + 1;
      while (j < entries.size() && entries[j].same_face(entries[i])) ++j;
      if (const auto [first_of, again] = repeated(entries, i, j); again != HalfFace()) {
        blame(again,
              fmt::format(" is tet {} again", file_tet(first_of.tet().index()) + first_number_));
      } else if (j - i > 2) {
        blame(entries[i + 2].face, ": a face of it has more than two tets");
      } else if (senses && j - i == 2 && entries[i].even == entries[i + 1].even) {
        blame(entries[i + 1].face, fmt::format(" and {} lie on the same side of their common face",
                                               describe(entries[i].face.tet().index())));
      }
      i = j;
    }
  }
  if (!message.empty()) throw BuildError(message, first);
}

/// Lists the tets of each component, which are joined by faces, in one sense: that in which their
/// volumes have a positive sum. Forgets the neighbours if any is listed anew.
void MeshBuilder::reorder_tets() {
  const auto n = static_cast<std::uint32_t>(mesh_.cells_.size());
  const auto is_even = [&](HalfFace f) {
    auto v = mesh_.vertices(f);
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return v[1] < v[2];
  };
  std::vector<std::uint32_t> slots(n);  // in the order of the file
  for (std::uint32_t t = 0; t < n; ++t) slots[file_tet(t)] = t;
  std::vector<char> reached(n, 0);
  swapped_.assign(n, 0);
  std::vector<std::uint32_t> component;
  for (const std::uint32_t first : slots) {
    if (reached[first]) continue;
    reached[first] = 1;
    component.assign(1, first);
    CompensatedSum volume;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::uint32_t t = component[i];
      volume.add(swapped_[t] ? -tet_volume6(t) : tet_volume6(t));
      for (unsigned f = 0; f < 4; ++f) {
        const HalfFace here(TetHandle(t), f);
        const HalfFace twin = mesh_.twin(here);
        if (twin.is_outside() || reached[twin.tet().index()]) continue;
        const std::uint32_t u = twin.tet().index();
        reached[u] = 1;
        swapped_[u] = (swapped_[t] != 0) != (is_even(here) == is_even(twin)) ? 1 : 0;
        component.push_back(u);
      }
    }
    if (volume.value() >= 0) continue;
    for (const std::uint32_t t : component) swapped_[t] ^= 1;
  }
  report_.reordered_tets =
      static_cast<std::size_t>(std::count(swapped_.begin(), swapped_.end(), 1));
  if (report_.reordered_tets == 0) return;
  for (std::uint32_t t = 0; t < n; ++t) {
    mesh_.cells_[t].neighbours = {};
    if (swapped_[t]) swap_orientation(t);
  }
}

/// Finds the vertices that do not lie inside a region: of the boundary, of a face between two
/// labels, of no tet, or of an element that is none.
void MeshBuilder::find_border() {
  on_border_.assign(mesh_.points_.size(), 1);
  for (const TetMesh::Cell& cell : mesh_.cells_) {
    for (const VertexHandle v : cell.vertices) on_border_[v.index()] = 0;
  }
  for (std::uint32_t t = 0; t < mesh_.cells_.size(); ++t) {
    for (unsigned i = 0; i < 4; ++i) {
      const HalfFace f(TetHandle(t), i);
      const HalfFace twin = mesh_.twin(f);
      if (!twin.is_outside() && mesh_.label(twin.tet()) == mesh_.label(f.tet())) continue;
      for (const VertexHandle v : mesh_.vertices(f)) on_border_[v.index()] = 1;
    }
  }
  for (const OtherElements& others : data_.other_elements) {
    for (const std::uint32_t v : others.vertices) on_border_[vertex(v).index()] = kOfOthers;
  }
}

/// Of a named triangle. `f` is its face, if it is one.
bool MeshBuilder::is_dropped(HalfFace f, const std::array<VertexHandle, 3>& vertices) const {
  if (!drops_interior_ || are_of_others(vertices)) return false;
  if (f == HalfFace()) {
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](VertexHandle v) { return on_border_[v.index()] == 0; });
  }
  const HalfFace twin = mesh_.twin(f);
  return !twin.is_outside() && mesh_.label(f.tet()) == mesh_.label(twin.tet());
}

/// Registers a triangle as a face of the mesh: boundary number or constraint bits.
void MeshBuilder::add_surface_face(HalfFace f, SurfaceTriangle triangle) {
  const auto number = static_cast<std::uint32_t>(mesh_.surface_.size());
  TetMesh::Cell& cell = mesh_.cells_[f.tet().index()];
  const HalfFace twin = cell.neighbours[f.face()];
  triangle.interior = !twin.is_outside();
  if (triangle.interior) {
    mesh_.tet_flags_[f.tet().index()] |= static_cast<TetMesh::TetFlags>(1u << f.face());
    mesh_.tet_flags_[twin.tet().index()] |= static_cast<TetMesh::TetFlags>(1u << twin.face());
    ++report_.constrained_faces;
  } else {
    cell.neighbours[f.face()] = HalfFace::outside(number);
  }
  mesh_.surface_.push_back(triangle);
}

void MeshBuilder::build_surface(const FaceBuckets& buckets) {
  const std::size_t named = data_.triangles.size();
  std::vector<HalfFace> faces(named);
  for_chunks(named, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& v = data_.triangles[i].vertices;
      faces[i] = buckets.find({vertex(v[0]).index(), vertex(v[1]).index(), vertex(v[2]).index()});
    }
  });
  mesh_.surface_.reserve(named);
  for (std::size_t i = 0; i < named; ++i) {
    const auto& v = data_.triangles[i].vertices;
    SurfaceTriangle triangle{
        {vertex(v[0]), vertex(v[1]), vertex(v[2])}, data_.triangles[i].label, true, false, false};
    const HalfFace f = faces[i];
    if (is_dropped(f, triangle.vertices)) {
      ++report_.dropped_triangles;
      continue;
    }
    const bool repeated =
        f != HalfFace() &&
        (mesh_.is_constrained(f) || (mesh_.twin(f).is_outside() && mesh_.twin(f) != HalfFace()));
    if (f == HalfFace() || repeated) {
      triangle.loose = true;
      mesh_.surface_.push_back(triangle);
      ++report_.loose_triangles;
    } else {
      add_surface_face(f, triangle);
    }
  }
  release(data_.triangles);
  const std::vector<HalfFace> unnamed = unnamed_faces();
  mesh_.surface_.reserve(named + unnamed.size());
  for (const HalfFace f : unnamed) add_surface_face(f, {mesh_.vertices(f), 0, false, false, false});
}

/// Faces of the boundary and between two labels that no triangle names, as the file orders their
/// tets.
std::vector<HalfFace> MeshBuilder::unnamed_faces() const {
  const bool has_labels = std::any_of(mesh_.label_.begin(), mesh_.label_.end(),
                                      [&](Label label) { return label != mesh_.label_[0]; });
  const auto is_wanted = [&](HalfFace f) {
    const HalfFace twin = mesh_.twin(f);
    if (twin.is_outside()) return twin == HalfFace();
    return has_labels && mesh_.label(f.tet()) != mesh_.label(twin.tet()) &&
           !mesh_.is_constrained(f) && file_code(f) < file_code(twin);
  };
  const auto parts = map_chunks<std::vector<HalfFace>>(
      mesh_.cells_.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<HalfFace> found;
        for (std::size_t t = begin; t < end; ++t) {
          for (unsigned i = 0; i < 4; ++i) {
            const HalfFace f(TetHandle(static_cast<std::uint32_t>(t)), i);
            if (is_wanted(f)) found.push_back(f);
          }
        }
        return found;
      });
  std::vector<HalfFace> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  if (!file_tet_.empty()) {
    std::sort(all.begin(), all.end(),
              [&](HalfFace a, HalfFace b) { return file_code(a) < file_code(b); });
  }
  return all;
}

/// The tet of a vertex is the last one in the file.
void MeshBuilder::link_vertices() {
  std::vector<std::atomic<std::uint32_t>> last(mesh_.points_.size());  // number in the file, plus 1
  const std::size_t n = mesh_.cells_.size();
  for_chunks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = end; t-- > begin;) {
      const std::uint32_t number = file_tet(t) + 1;
      for (const VertexHandle v : mesh_.cells_[t].vertices) {
        std::atomic<std::uint32_t>& latest = last[v.index()];
        std::uint32_t seen = latest.load(std::memory_order_relaxed);
        while (seen < number &&
               !latest.compare_exchange_weak(seen, number, std::memory_order_relaxed)) {
        }
      }
    }
  });
  for_chunks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      for (const VertexHandle v : mesh_.cells_[t].vertices) {
        if (last[v.index()].load(std::memory_order_relaxed) == file_tet(t) + 1) {
          mesh_.vertex_tet_[v.index()] = TetHandle(static_cast<std::uint32_t>(t));
        }
      }
    }
  });
  count_unused_points();
}

/// Those of no tet, no edge of second order and no element of another kind.
void MeshBuilder::count_unused_points() {
  const auto is_unused = [](TetHandle t) { return !t.is_valid(); };
  const auto in_no_tet =
      std::count_if(mesh_.vertex_tet_.begin(), mesh_.vertex_tet_.end(), is_unused);
  if (in_no_tet == 0) return;
  std::vector<char> is_used(mesh_.points_.size());
  const auto use = [&](std::uint32_t number) { is_used[vertex(number).index()] = 1; };
  for (const auto& node : data_.mid_nodes) use(node[2]);
  for (const OtherElements& others : data_.other_elements) {
    std::for_each(others.vertices.begin(), others.vertices.end(), use);
  }
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    report_.unused_points += is_used[v] == 0 && is_unused(mesh_.vertex_tet_[v]) ? 1 : 0;
  }
}

/// A face of the tet at the edge lies on the boundary or is constrained.
bool MeshBuilder::lies_on_face(TetEdge e) const {
  for (unsigned i = 0; i < 4; ++i) {
    const HalfFace f(e.tet(), i);
    const bool at_edge = kEdgeVertices[e.edge()][0] != i && kEdgeVertices[e.edge()][1] != i;
    if (at_edge && (mesh_.is_boundary(f) || mesh_.is_constrained(f))) return true;
  }
  return false;
}

void MeshBuilder::mark_edges() {
  if (data_.edges.empty()) return;
  const auto ends_of = [&](const MeshData::Edge& named) {
    return edge_ends(vertex(named.vertices[0]), vertex(named.vertices[1]));
  };
  std::vector<EdgeEnds> edges;
  for (const MeshData::Edge& named : data_.edges) edges.push_back(ends_of(named));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const std::vector<TetAtEdge> tets = find_tets_at(mesh_, edges);
  std::vector<char> found(edges.size(), 0);
  std::vector<char> on_face(edges.size(), 0);
  for (const TetAtEdge& at : tets) {
    found[at.number] = 1;
    if (!drops_interior_) continue;
    if (lies_on_face(at.edge) || are_of_others(edges[at.number])) on_face[at.number] = 1;
  }
  for (const MeshData::Edge& named : data_.edges) {
    const EdgeEnds ends = ends_of(named);
    const auto n = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), ends) -
                                            edges.begin());
    if (drops_interior_ &&
        !(found[n] ? on_face[n] : on_border_[ends[0].index()] && on_border_[ends[1].index()])) {
      ++report_.dropped_edges;
      continue;
    }
    report_.loose_edges += found[n] ? 0 : 1;
    mesh_.named_edges_.push_back(
        {{vertex(named.vertices[0]), vertex(named.vertices[1])}, named.label});
    // Of a loose edge as well: a deleted vertex could not be written.
    for (const VertexHandle v : ends) mesh_.vertex_flags_[v.index()] |= TetMesh::kVertexConstrained;
  }
  for (const TetAtEdge& at : tets) {
    if (drops_interior_ && !on_face[at.number]) continue;
    mesh_.tet_flags_[at.edge.tet().index()] |=
        static_cast<TetMesh::TetFlags>(16u << at.edge.edge());
  }
}

void MeshBuilder::mark_vertices() {
  for (const SurfaceTriangle& triangle : mesh_.surface_) {
    const auto flag = triangle.interior || triangle.loose ? TetMesh::kVertexConstrained
                                                          : TetMesh::kVertexBoundary;
    for (const VertexHandle v : triangle.vertices) mesh_.vertex_flags_[v.index()] |= flag;
  }
  for (const std::uint32_t number : data_.required_vertices) {
    if (drops_interior_ && !on_border_[vertex(number).index()]) {
      ++report_.dropped_vertices;
      continue;
    }
    mesh_.vertex_flags_[vertex(number).index()] |=
        TetMesh::kVertexConstrained | TetMesh::kVertexRequired;
  }
}

std::vector<std::uint32_t> MeshBuilder::take_tet_numbers() {
  if (file_tet_.empty()) {
    file_tet_.resize(mesh_.cells_.size());
    std::iota(file_tet_.begin(), file_tet_.end(), 0u);
  }
  return std::move(file_tet_);
}

MeshData MeshBuilder::give_back() {
  if (mesh_.cells_.empty()) return std::move(data_);  // the indices were wrong
  if (data_.points.empty()) {
    data_.points.resize(mesh_.points_.size());
    for (std::size_t v = 0; v < mesh_.points_.size(); ++v) {
      data_.points[mesh_.vertex_origin_[v]] = mesh_.points_[v];
    }
  }
  mesh_.scale_.to_file(data_.points);
  data_.point_labels = std::move(mesh_.point_labels_);
  data_.tets.resize(mesh_.cells_.size());
  for (std::size_t t = 0; t < mesh_.cells_.size(); ++t) {
    data_.tets[file_tet(t)] = {file_vertices(t), mesh_.label_[t]};
  }
  return std::move(data_);
}

TetMesh TetMesh::build(MeshData& data, const BuildDetails& details) {
  BuildReport own;
  TetMesh mesh;
  MeshBuilder builder(std::move(data), mesh, details.report ? *details.report : own,
                      details.interior, details.first_number);
  try {
    builder.build(details.sorted);
  } catch (const Error&) {
    data = builder.give_back();
    throw;
  }
  data = {};
  if (details.tet_numbers) *details.tet_numbers = builder.take_tet_numbers();
  return mesh;
}

TetMesh::TetMesh(MeshData data, BuildReport* report, InteriorConstraints interior)
    : TetMesh(build(data, {.sorted = false, .interior = interior, .report = report})) {}

TetMesh TetMesh::sorted(MeshData data, BuildReport* report, InteriorConstraints interior) {
  return build(data, {.interior = interior, .report = report});
}

}  // namespace tetmend
