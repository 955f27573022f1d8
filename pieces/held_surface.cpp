// SPDX-License-Identifier: MIT
//   before: pieces -> shares -> all vertices by id -> features -> reference
//   a piece: ids -> patches and lines -> guard
//   after: pieces -> shares -> one surface -> proof
#include "pieces/held_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "face/surface_points.h"
#include "kernel/compensated_sum.h"
#include "kernel/error.h"
#include "kernel/geometry.h"
#include "kernel/scale.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

constexpr std::uint32_t kAbsent = 0xFFFFFFFFu;

/// Where the id is among ascending ones.
std::uint32_t find(const std::vector<VertexId>& ids, VertexId id) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  return at != ids.end() && *at == id ? static_cast<std::uint32_t>(at - ids.begin()) : kAbsent;
}

void sort_once(std::vector<VertexId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

std::vector<SurfaceShare::Volume> volumes_of(const Piece& own) {
  std::map<Label, CompensatedSum> sums;
  for (const PieceTet& tet : own.tets) {
    const auto& v = tet.vertices;
    sums[tet.label].add(
        volume6(own.points[v[0]], own.points[v[1]], own.points[v[2]], own.points[v[3]]) / 6);
  }
  std::vector<SurfaceShare::Volume> volumes;
  for (const auto& [label, sum] : sums) volumes.push_back({label, sum.value()});
  return volumes;
}

/// Takes the vertices of faces of a piece, and gives the faces their numbers there.
void take_face_vertices(const Piece& piece, SurfaceShare& share) {
  for (const auto& face : share.faces) {
    for (const std::uint32_t v : face.vertices) share.ids.push_back(piece.ids[v]);
  }
  sort_once(share.ids);
  for (const VertexId id : share.ids) {
    const std::uint32_t v = find(piece.ids, id);
    share.points.push_back(piece.points[v]);
    if (!piece.labels.empty()) share.labels.push_back(piece.labels[v]);
  }
  for (auto& face : share.faces) {
    for (std::uint32_t& v : face.vertices) v = find(share.ids, piece.ids[v]);
  }
}

/// All vertices of the shares.
void merge_vertices(const std::vector<SurfaceShare>& shares, std::vector<VertexId>& ids,
                    std::vector<Point>& points) {
  for (const SurfaceShare& share : shares)
    ids.insert(ids.end(), share.ids.begin(), share.ids.end());
  sort_once(ids);
  points.resize(ids.size());
  for (const SurfaceShare& share : shares) {
    for (std::size_t i = 0; i < share.ids.size(); ++i) {
      points[find(ids, share.ids[i])] = share.points[i];
    }
  }
}

std::array<VertexHandle, 3> handles(const MeshData::Triangle& face, const SurfaceShare& share,
                                    const std::vector<VertexId>& ids) {
  std::array<VertexHandle, 3> v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = VertexHandle(find(ids, share.ids[face.vertices[k]]));
  return v;
}

/// Areas and volumes by label.
std::vector<SurfaceChange::Region> measure_regions(
    const std::vector<SurfaceShare>& shares, const std::vector<Point>& points,
    const SurfaceFeatures& features, std::span<const SurfaceFeatures::Patch> patches) {
  std::map<Label, std::array<CompensatedSum, 2>> sums;
  for (const SurfaceShare& share : shares) {
    for (const SurfaceShare::Volume& of : share.volumes) sums[of.label][1].add(of.volume);
  }
  for (const auto& face : features.faces) {
    const auto& v = face.vertices;
    const double area =
        triangle_area({points[v[0].index()], points[v[1].index()], points[v[2].index()]});
    const SurfaceFeatures::Patch& patch = patches[face.patch];
    sums[patch.sides[0]][0].add(area);
    if (patch.interior) sums[patch.sides[1]][0].add(area);
  }
  std::vector<SurfaceChange::Region> regions;
  for (const auto& [label, sum] : sums) {
    regions.push_back({.label = label,
                       .area_before = sum[0].value(),
                       .area_after = sum[0].value(),
                       .volume_before = sum[1].value(),
                       .volume_after = sum[1].value()});
  }
  return regions;
}

}  // namespace

void append(const SurfaceShare& share, std::string& bytes) {
  put(share.ids, bytes);
  put(share.points, bytes);
  put(share.labels, bytes);
  put(share.faces, bytes);
  put(share.kinds, bytes);
  put(share.edges, bytes);
  put(share.walls, bytes);
  put(share.kept, bytes);
  put(share.held, bytes);
  put(share.volumes, bytes);
}

SurfaceShare take_share(std::string_view& bytes) {
  SurfaceShare share;
  take(bytes, share.ids);
  take(bytes, share.points);
  take(bytes, share.labels);
  take(bytes, share.faces);
  take(bytes, share.kinds);
  take(bytes, share.edges);
  take(bytes, share.walls);
  take(bytes, share.kept);
  take(bytes, share.held);
  take(bytes, share.volumes);
  const std::size_t count = share.ids.size();
  const bool fits =
      share.points.size() == count && (share.labels.empty() || share.labels.size() == count) &&
      (share.kinds.empty() || share.kinds.size() == share.faces.size()) &&
      std::is_sorted(share.ids.begin(), share.ids.end()) &&
      std::all_of(share.faces.begin(), share.faces.end(), [&](const MeshData::Triangle& face) {
        return std::all_of(face.vertices.begin(), face.vertices.end(),
                           [&](std::uint32_t v) { return v < count; });
      });
  if (!fits) throw Error("a share of a surface contradicts itself");
  return share;
}

SurfaceShare share_of_input(const Piece& gathered, const Parting& parting, std::uint32_t number) {
  if (gathered.tets.empty()) return {};
  const std::vector<std::uint32_t> parts = parting.parts_of(gathered);
  MeshData data = to_data(gathered);
  const TetMesh mesh = TetMesh::build(data, {.report = nullptr});
  const SurfaceInput all = read_surface(mesh);
  SurfaceShare share;
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    MeshData::Triangle face;
    for (std::size_t k = 0; k < 3; ++k) face.vertices[k] = mesh.origin(all.faces[i].vertices[k]);
    if (!is_own(face.vertices, parts, number)) continue;
    share.faces.push_back(face);
    share.kinds.push_back(all.kinds[i]);
  }
  take_face_vertices(gathered, share);
  const auto take_edge = [&](const std::array<VertexHandle, 2>& ends, Label label,
                             std::vector<SurfaceShare::Edge>& to) {
    const std::array<std::uint32_t, 2> v = {mesh.origin(ends[0]), mesh.origin(ends[1])};
    if (!is_own(v, parts, number)) return;
    to.push_back({{gathered.ids[v[0]], gathered.ids[v[1]]}, label});
  };
  for (const auto& edge : all.named) take_edge(edge.vertices, edge.label, share.edges);
  for (const auto& wall : all.walls) take_edge(wall, 0, share.walls);
  for (const VertexHandle v : all.kept) {
    if (parts[mesh.origin(v)] == number) share.kept.push_back(gathered.ids[mesh.origin(v)]);
  }
  for (const VertexHandle v : all.held) {
    if (parts[mesh.origin(v)] == number) share.held.push_back(gathered.ids[mesh.origin(v)]);
  }
  std::vector<char> stays(gathered.ids.size(), 0);
  for (const PieceTet& tet : gathered.tets) {
    if (!tet.is_protected()) continue;
    for (const std::uint32_t v : tet.vertices) stays[v] = 1;
  }
  for (std::size_t v = 0; v < stays.size(); ++v) {
    const bool is_kept = stays[v] != 0 || (gathered.marks[v] & kCorner) != 0;
    if (is_kept && parts[v] == number) share.kept.push_back(gathered.ids[v]);
    const bool is_held = (gathered.marks[v] & kHeld) != 0;
    if (is_held && parts[v] == number) share.held.push_back(gathered.ids[v]);
  }
  Piece own;
  own.points = gathered.points;
  for (const PieceTet& tet : gathered.tets) {
    if (is_own(tet.vertices, parts, number)) own.tets.push_back(tet);
  }
  share.volumes = volumes_of(own);
  return share;
}

SurfaceShare share_of(const Piece& own) {
  SurfaceShare share;
  share.faces = own.surface;
  take_face_vertices(own, share);
  for (const MeshData::Edge& edge : own.lines) {
    share.edges.push_back({{own.ids[edge.vertices[0]], own.ids[edge.vertices[1]]}, edge.label});
  }
  for (std::size_t v = 0; v < own.ids.size(); ++v) {
    if ((own.marks[v] & kCorner) != 0) share.kept.push_back(own.ids[v]);
  }
  share.volumes = volumes_of(own);
  return share;
}

HeldSurface::HeldSurface(const std::vector<SurfaceShare>& shares, const EnvelopeOptions& options,
                         const Point& low, const Point& high) {
  if (!Scale::of(std::array{low, high}).is_one()) {
    throw Error("surface: a mesh of extreme size has to have a fixed one in a run in pieces");
  }
  const double flatness = tetmend::flatness(low, high);
  check(options, flatness);
  merge_vertices(shares, ids_, points_);
  SurfaceInput input;
  for (const SurfaceShare& share : shares) {
    for (const auto& face : share.faces) input.faces.push_back({handles(face, share, ids_), 0});
    input.kinds.insert(input.kinds.end(), share.kinds.begin(), share.kinds.end());
  }
  const auto keep = [&](VertexId id) {
    const std::uint32_t v = find(ids_, id);
    if (v != kAbsent) input.kept.emplace_back(v);
  };
  for (const SurfaceShare& share : shares) {
    for (const VertexId id : share.held) {
      const std::uint32_t v = find(ids_, id);
      if (v != kAbsent) input.held.emplace_back(v);
    }
  }
  for (const SurfaceShare& share : shares) {
    for (const VertexId id : share.kept) keep(id);
    for (const auto& [ends, label] : share.edges) {
      const std::array<std::uint32_t, 2> v = {find(ids_, ends[0]), find(ids_, ends[1])};
      if (v[0] != kAbsent && v[1] != kAbsent) {
        input.named.push_back({{VertexHandle(v[0]), VertexHandle(v[1])}, label});
      } else {
        for (const VertexId id : ends) keep(id);
      }
    }
    for (const auto& wall : share.walls) {
      const std::uint32_t a = find(ids_, wall.vertices[0]);
      const std::uint32_t b = find(ids_, wall.vertices[1]);
      if (a == kAbsent || b == kAbsent) continue;
      input.walls.push_back({VertexHandle(std::min(a, b)), VertexHandle(std::max(a, b))});
    }
  }
  take_labels(shares);
  features_ =
      find_features(std::move(input), points_, flatness, {options.angle, options.is_flat(), {}});
  reference_ = std::make_shared<Reference>(points_, flatness, features_, options);
  if (!labels_.empty()) {
    std::vector<std::uint32_t> patch_of;
    for (const auto& face : features_.faces) {
      Element& element = face_elements_.emplace_back();
      for (unsigned k = 0; k < 3; ++k) element.points[k] = points_[face.vertices[k].index()];
      patch_of.push_back(face.patch);
    }
    faces_ = ElementTree(face_elements_, patch_of, features_.patches.size());
  }
  before_.regions = measure_regions(shares, points_, features_, reference_->patches);
  before_.triangles_before = before_.triangles_after = features_.faces.size();
  const auto& tolerances = reference_->tolerances;
  if (!tolerances.empty()) {
    before_.tolerance = *std::max_element(tolerances.begin(), tolerances.end());
  }
}

void HeldSurface::take_labels(const std::vector<SurfaceShare>& shares) {
  std::vector<Label> labels(ids_.size(), 0);
  bool any = false;
  for (const SurfaceShare& share : shares) {
    for (std::size_t i = 0; i < share.labels.size(); ++i) {
      labels[find(ids_, share.ids[i])] = share.labels[i];
      any = any || share.labels[i] != 0;
    }
  }
  if (any) labels_ = std::move(labels);
}

void HeldSurface::label_points(Piece& piece, VertexId first_new) const {
  if (labels_.empty()) return;
  for (const auto& face : piece.surface) {
    for (const std::uint32_t v : face.vertices) {
      if (piece.ids[v] < first_new) continue;
      const auto patch = static_cast<std::uint32_t>(face.label);
      const ElementTree::Nearest nearest = faces_.nearest(face_elements_, patch, piece.points[v]);
      const auto& corners = features_.faces[nearest.element].vertices;
      std::array<Label, 3> labels{};
      for (unsigned k = 0; k < 3; ++k) labels[k] = labels_[corners[k].index()];
      if (piece.labels.empty()) piece.labels.resize(piece.ids.size(), 0);
      piece.labels[v] =
          face::common_label(face_elements_[nearest.element].points, labels, nearest.point);
    }
  }
}

void HeldSurface::label(Piece& gathered, const Parting& parting, std::uint32_t number) const {
  const std::vector<std::uint32_t> parts = parting.parts_of(gathered);
  std::vector<std::uint32_t> numbers(ids_.size(), kAbsent);  // in the piece, by vertex
  for (std::uint32_t v = 0; v < gathered.ids.size(); ++v) {
    const std::uint32_t at = find(ids_, gathered.ids[v]);
    const unsigned required = gathered.marks[v] & ~unsigned{kCorner};
    const bool is_corner = at != kAbsent && features_.places[at] == SurfacePlace::corner;
    gathered.marks[v] = static_cast<std::uint8_t>(required | (is_corner ? kCorner : 0U));
    if (at != kAbsent) numbers[at] = v;
  }
  const auto take = [&](const auto& handles, std::uint32_t kind, auto& to) {
    auto& element = to.emplace_back();
    bool is_there = true;
    bool is_near = false;
    for (std::size_t k = 0; k < handles.size(); ++k) {
      const std::uint32_t v = element.vertices[k] = numbers[handles[k].index()];
      is_there = is_there && v != kAbsent;
      is_near = is_near || (v != kAbsent && parts[v] == number);
    }
    element.label = static_cast<Label>(kind);
    if (!is_there || !is_near) to.pop_back();
  };
  for (const auto& face : features_.faces) take(face.vertices, face.patch, gathered.surface);
  for (const auto& edge : features_.edges) take(edge.vertices, edge.line, gathered.lines);
}

std::unique_ptr<Envelope> HeldSurface::guard(const TetMesh& mesh, const Piece& piece) const {
  if (!mesh.scale().is_one()) return nullptr;
  std::vector<VertexHandle> slots(piece.ids.size());
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (!mesh.is_deleted(v)) slots[mesh.origin(v)] = v;
  }
  SurfaceFeatures present;
  present.places.assign(mesh.vertex_slots(), SurfacePlace::inside);
  for (const auto& face : piece.surface) {
    const auto& v = face.vertices;
    present.faces.push_back(
        {{slots[v[0]], slots[v[1]], slots[v[2]]}, static_cast<std::uint32_t>(face.label)});
    for (const std::uint32_t w : v) present.places[slots[w].index()] = SurfacePlace::smooth;
  }
  for (const auto& edge : piece.lines) {
    const auto& v = edge.vertices;
    present.edges.push_back({{slots[v[0]], slots[v[1]]}, static_cast<std::uint32_t>(edge.label)});
    for (const std::uint32_t w : v) present.places[slots[w].index()] = SurfacePlace::ridge;
  }
  for (std::size_t v = 0; v < slots.size(); ++v) {
    if (!slots[v].is_valid()) continue;
    SurfacePlace& place = present.places[slots[v].index()];
    const bool stays = (piece.marks[v] & kCorner) != 0 || mesh.is_frozen(slots[v]);
    if (stays && place != SurfacePlace::inside) place = SurfacePlace::corner;
  }
  return Envelope::of_part(reference_, points_by_slot(mesh), present);
}

std::size_t HeldSurface::count_misfits(const TetMesh& mesh, const Piece& piece,
                                       const Parting& parting, std::uint32_t number) const {
  using Triple = std::array<std::uint32_t, 3>;
  const std::vector<std::uint32_t> parts = parting.parts_of(piece);
  const auto rotated = [](Triple v) {
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return v;
  };
  std::vector<std::pair<Triple, Label>> listed;
  for (const auto& face : piece.surface) {
    if (is_own(face.vertices, parts, number))
      listed.emplace_back(rotated(face.vertices), face.label);
  }
  std::sort(listed.begin(), listed.end());
  const SurfaceInput is = read_surface(mesh);
  std::size_t misfits = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < is.faces.size(); ++i) {
    Triple v{};
    for (std::size_t k = 0; k < 3; ++k) v[k] = mesh.origin(is.faces[i].vertices[k]);
    if (!is_own(v, parts, number)) continue;
    const auto at = std::lower_bound(listed.begin(), listed.end(), std::pair(rotated(v), Label{0}));
    if (at == listed.end() || at->first != rotated(v)) {
      ++misfits;
      continue;
    }
    ++found;
    const SurfaceFeatures::Patch& patch = reference_->patches[static_cast<std::size_t>(at->second)];
    const SurfaceInput::Kind& kind = is.kinds[i];
    const bool fits = patch.sides == kind.sides && patch.label == kind.label &&
                      patch.named == kind.named && patch.interior == kind.interior;
    misfits += fits ? 0 : 1;
  }
  return misfits + listed.size() - found;
}

SurfaceChange HeldSurface::unchanged() const {
  return before_;
}

SurfaceChange HeldSurface::measure(const std::vector<SurfaceShare>& shares) const {
  std::vector<VertexId> ids;
  std::vector<Point> points;
  merge_vertices(shares, ids, points);
  SurfaceFeatures present;
  present.places.assign(ids.size(), SurfacePlace::smooth);
  for (const SurfaceShare& share : shares) {
    for (const auto& face : share.faces) {
      present.faces.push_back({handles(face, share, ids), static_cast<std::uint32_t>(face.label)});
    }
    for (const auto& [ends, line] : share.edges) {
      const VertexHandle a(find(ids, ends[0]));
      const VertexHandle b(find(ids, ends[1]));
      present.edges.push_back({{a, b}, static_cast<std::uint32_t>(line)});
    }
  }
  bool is_kept = true;
  for (std::size_t v = 0; v < ids_.size(); ++v) {
    if (features_.places[v] != SurfacePlace::corner) continue;
    const std::uint32_t now = find(ids, ids_[v]);
    is_kept = is_kept && now != kAbsent && points[now] == points_[v];
  }
  const auto envelope = Envelope::of_part(reference_, points, present);
  const SurfaceBound bound = envelope->prove();
  if (!is_kept || bound.unproven > 0) {
    throw Error(
        "the surface is not near that of the input: this is a bug of tetmend, please report it");
  }
  SurfaceChange change = before_;
  const auto regions = measure_regions(shares, points, present, reference_->patches);
  for (SurfaceChange::Region& region : change.regions) {
    for (const SurfaceChange::Region& now : regions) {
      if (now.label != region.label) continue;
      region.area_after = now.area_after;
      region.volume_after = now.volume_after;
    }
  }
  change.triangles_after = present.faces.size();
  change.touched = bound.touched;
  if (reference_->is_flat()) return change;
  change.proven = bound.distance;
  constexpr unsigned kSide = 4;  // 15 points of each triangle that has changed
  change.sampled = envelope->sampled_distance(kSide);
  return change;
}

}  // namespace tetmend::pieces
