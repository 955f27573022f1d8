// SPDX-License-Identifier: MIT
#include "trace/slot_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "kernel/mesh_view.h"
#include "kernel/quality_of_points.h"
#include "trace/traced_standard.h"

namespace tetmend {

namespace {

constexpr std::uint32_t kNowhere = 0xFFFFFFFFu;

class Fingerprint {
 public:
  void add(std::uint64_t value) {
    state_ = (state_ ^ value) * 0x9E3779B97F4A7C15u;
    state_ ^= state_ >> 29;
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243F6A8885A308D3u;
};

void encode_slots(ByteWriter& out, std::span<const std::uint32_t> slots) {
  out.put(slots.size());
  std::uint32_t last = 0;
  for (const std::uint32_t slot : slots) out.put_step(slot, last);
}

/// Slots below `end`.
std::vector<std::uint32_t> decode_slots(ByteReader& in, std::size_t end) {
  std::vector<std::uint32_t> slots(in.get_count());
  std::uint32_t last = 0;
  for (std::uint32_t& slot : slots) {
    slot = in.get_step(last);
    if (slot >= end) throw ByteReader::Damage(fmt::format("slot {} of {}", slot, end));
  }
  return slots;
}

/// A step from one label to another, which stay 32 bits wide.
Label decode_label(ByteReader& in, Label from) {
  constexpr std::int64_t kMost = std::numeric_limits<Label>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<Label>::min();
  const std::int64_t step = in.get_signed();
  if (step < kLeast - from || step > kMost - from) {
    throw ByteReader::Damage("a label has more than 32 bits");
  }
  return static_cast<Label>(from + step);
}

/// Of a mesh of ordinary size nothing is written, unless qualities follow.
Scale decode_scale(ByteReader& in, bool may_be_one) {
  const std::int64_t exponent = in.get_signed();
  if (exponent == 0 && may_be_one) return {};
  if (exponent == 0 || exponent < -Scale::kLargest || exponent > Scale::kLargest + 1) {
    throw ByteReader::Damage(fmt::format("a scale of 2^{}", exponent));
  }
  return Scale(static_cast<int>(exponent));
}

template <class Element>
void encode_named(ByteWriter& out, std::span<const Element> elements) {
  out.put(elements.size());
  std::uint32_t last = 0;
  for (const Element& element : elements) {
    for (const std::uint32_t v : element.vertices) out.put_step(v, last);
    out.put_signed(element.label);
  }
}

/// Triangles or edges of live vertices.
template <class Element>
void decode_named(ByteReader& in, const SlotMesh& mesh, std::vector<Element>& elements) {
  elements.resize(in.get_count(1 + Element().vertices.size()));
  std::uint32_t last = 0;
  for (Element& element : elements) {
    for (std::uint32_t& v : element.vertices) {
      v = in.get_step(last);
      if (mesh.is_deleted(VertexHandle(v))) {
        throw ByteReader::Damage(fmt::format("a triangle or edge of vertex {}, which is none", v));
      }
    }
    for (const std::uint32_t v : element.vertices) {
      if (std::count(element.vertices.begin(), element.vertices.end(), v) == 1) continue;
      throw ByteReader::Damage(fmt::format("a triangle or edge with vertex {} twice", v));
    }
    element.label = decode_label(in, 0);
  }
}

}  // namespace

SlotMesh::SlotMesh(const TetMesh& mesh) : standard_(mesh.standard()), scale_(mesh.scale()) {
  points_.reserve(mesh.vertex_slots());
  live_.reserve(mesh.vertex_slots());
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    points_.push_back(mesh.point(v));
    live_.push_back(mesh.is_deleted(v) ? 0 : 1);
  }
  tets_.reserve(mesh.tet_slots());
  labels_.reserve(mesh.tet_slots());
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    tets_.push_back(mesh.vertices(t));
    labels_.push_back(mesh.label(t));
    if (!mesh.is_deleted(t) && mesh.is_frozen(t)) frozen_tets_.push_back(i);
  }
  if (standard_.is_own()) noted_qualities_ = qualities_of_tets(mesh);
  tet_count_ = mesh.tet_count();
  vertex_count_ = mesh.vertex_count();
  const MeshView view(mesh);
  const std::span<const std::uint32_t> slots = view.vertex_slots();
  const auto by_slot = [&](auto elements, auto& out) {
    for (auto element : elements) {
      for (std::uint32_t& v : element.vertices) v = slots.empty() ? v : slots[v];
      out.push_back(element);
    }
  };
  by_slot(view.triangles(), triangles_);
  by_slot(view.edges(), edges_);
  for (const std::uint32_t v : view.required_vertices()) {
    required_vertices_.push_back(slots.empty() ? v : slots[v]);
  }
}

namespace {

std::vector<Quality> list_qualities(const auto& mesh) {
  std::vector<Quality> qualities;
  qualities.reserve(mesh.tet_count());
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i))) qualities.push_back(mesh.quality(TetHandle(i)));
  }
  return qualities;
}

}  // namespace

std::vector<Quality> qualities_of_tets(const TetMesh& mesh) {
  return list_qualities(mesh);
}

std::vector<Quality> qualities_of_tets(const SlotMesh& mesh) {
  return list_qualities(mesh);
}

Standard standard_of_drawings(const SlotMesh& mesh) {
  return mesh.standard().is_own() ? mesh.standard().of_angles() : mesh.standard();
}

Quality SlotMesh::quality(TetHandle t) const {
  const TetVertices& v = tets_[t.index()];
  return static_cast<Quality>(
      standard_.quality(point(v[0]), point(v[1]), point(v[2]), point(v[3])));
}

bool misses_goal(const SlotMesh& mesh, TetHandle t) {
  return misses_goal_of(mesh, t);
}

MeshData SlotMesh::to_data() const {
  std::vector<TetHandle> all;
  all.reserve(tet_count_);
  for (std::uint32_t i = 0; i < tets_.size(); ++i) {
    if (!is_deleted(TetHandle(i))) all.push_back(TetHandle(i));
  }
  return extract(all);
}

MeshData SlotMesh::extract(std::span<const TetHandle> tets,
                           std::vector<std::uint32_t>* vertex_slots) const {
  std::vector<std::uint32_t> number(points_.size(), kNowhere);
  const bool all = tets.size() == tet_count_;
  for (const TetHandle t : tets) {
    for (const VertexHandle v : vertices(t)) number[v.index()] = 0;
  }
  MeshData data;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (number[i] == kNowhere && !(all && live_[i])) continue;
    number[i] = static_cast<std::uint32_t>(data.points.size());
    data.points.push_back(scale_.to_file(points_[i]));
    if (vertex_slots != nullptr) vertex_slots->push_back(i);
  }
  for (const TetHandle t : tets) {
    MeshData::Tet& tet = data.tets.emplace_back();
    for (unsigned i = 0; i < 4; ++i) tet.vertices[i] = number[vertices(t)[i].index()];
    tet.label = label(t);
  }
  const auto take = [&](const auto& elements, auto& out) {
    for (auto element : elements) {
      for (std::uint32_t& v : element.vertices) v = number[v];
      const auto& vertices = element.vertices;
      if (std::count(vertices.begin(), vertices.end(), kNowhere) == 0) out.push_back(element);
    }
  };
  take(triangles_, data.triangles);
  take(edges_, data.edges);
  for (const std::uint32_t v : required_vertices_) {
    if (number[v] != kNowhere) data.required_vertices.push_back(number[v]);
  }
  return data;
}

std::uint64_t SlotMesh::fingerprint() const {
  Fingerprint print;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (!live_[i]) continue;
    print.add(i);
    for (int axis = 0; axis < 3; ++axis) print.add(std::bit_cast<std::uint64_t>(points_[i][axis]));
  }
  for (std::uint32_t i = 0; i < tets_.size(); ++i) {
    if (is_deleted(TetHandle(i))) continue;
    print.add(i);
    for (const VertexHandle v : tets_[i]) print.add(v.index());
    print.add(static_cast<std::uint64_t>(labels_[i]));
  }
  return print.value();
}

std::size_t SlotMesh::bytes() const {
  return tets_.size() * (sizeof(TetVertices) + sizeof(Label)) +
         points_.size() * (sizeof(Point) + 1) + triangles_.size() * sizeof(MeshData::Triangle);
}

void SlotMesh::encode(ByteWriter& out) const {
  put_standard(out, standard_);
  out.put(points_.size());
  out.put_bytes(live_.data(), live_.size());
  out.put_bytes(points_.data(), points_.size() * sizeof(Point));
  out.put(tets_.size());
  TetVertices corner{VertexHandle(0), VertexHandle(0), VertexHandle(0), VertexHandle(0)};
  for (const TetVertices& tet : tets_) {
    for (unsigned i = 0; i < 4; ++i) {
      std::uint32_t from = corner[i].index();
      out.put_step(tet[i].index(), from);
    }
    corner = tet;
  }
  std::int64_t label = 0;
  for (const Label next : labels_) {
    out.put_signed(std::int64_t{next} - label);
    label = next;
  }
  encode_named<MeshData::Triangle>(out, triangles_);
  encode_named<MeshData::Edge>(out, edges_);
  encode_slots(out, required_vertices_);
  encode_slots(out, frozen_tets_);
  if (!scale_.is_one() || standard_.is_own()) out.put_signed(scale_.exponent());
  if (!standard_.is_own()) return;
  out.put(noted_qualities_.size());
  out.put_bytes(noted_qualities_.data(), noted_qualities_.size() * sizeof(Quality));
}

void SlotMesh::decode_vertices(ByteReader& in) {
  const std::size_t vertices = in.get_count(1 + sizeof(Point));
  live_.resize(vertices);
  in.get_bytes(live_.data(), vertices);
  points_.resize(vertices);
  in.get_bytes(points_.data(), vertices * sizeof(Point));
  for (std::size_t i = 0; i < vertices; ++i) {
    if (live_[i] > 1) throw ByteReader::Damage(fmt::format("vertex {} is not told to live", i));
    if (!points_[i].allFinite()) {
      throw ByteReader::Damage(fmt::format("vertex {} has no finite coordinates", i));
    }
    vertex_count_ += live_[i];
  }
}

void SlotMesh::decode_tets(ByteReader& in) {
  tets_.resize(in.get_count(4));
  TetVertices corner{VertexHandle(0), VertexHandle(0), VertexHandle(0), VertexHandle(0)};
  for (std::size_t k = 0; k < tets_.size(); ++k) {
    for (unsigned i = 0; i < 4; ++i) {
      std::uint32_t from = corner[i].index();
      corner[i] = VertexHandle(in.get_step(from));
    }
    if (corner != TetVertices()) {
      check_corners(corner);
      ++tet_count_;
    }
    tets_[k] = corner;
  }
  Label label = 0;
  labels_.resize(tets_.size());
  for (Label& next : labels_) next = label = decode_label(in, label);
}

void SlotMesh::decode_noted_qualities(ByteReader& in) {
  noted_qualities_.resize(in.get_count(sizeof(Quality)));
  in.get_bytes(noted_qualities_.data(), noted_qualities_.size() * sizeof(Quality));
  if (noted_qualities_.size() != tet_count_) {
    throw ByteReader::Damage(
        fmt::format("{} qualities of {} tets", noted_qualities_.size(), tet_count_));
  }
  for (const Quality q : noted_qualities_) {
    if (!std::isfinite(q)) throw ByteReader::Damage("a quality is no finite number");
  }
}

void SlotMesh::check_corners(const TetVertices& tet) const {
  for (unsigned i = 0; i < 4; ++i) {
    if (is_deleted(tet[i])) {
      throw ByteReader::Damage(
          fmt::format("a tet of vertex {}, which is none of the mesh", tet[i].index()));
    }
    for (unsigned k = 0; k < i; ++k) {
      if (tet[k] != tet[i]) continue;
      throw ByteReader::Damage(fmt::format("a tet with vertex {} twice", tet[i].index()));
    }
  }
}

void SlotMesh::check_place(const Point& point) const {
  if (scale_.to_file(point).allFinite()) return;
  throw ByteReader::Damage("a coordinate and the scale do not go together");
}

SlotMesh SlotMesh::decode(ByteReader& in) {
  SlotMesh mesh;
  mesh.standard_ = get_standard(in);
  mesh.decode_vertices(in);
  mesh.decode_tets(in);
  decode_named(in, mesh, mesh.triangles_);
  decode_named(in, mesh, mesh.edges_);
  mesh.required_vertices_ = decode_slots(in, mesh.points_.size());
  mesh.frozen_tets_ = decode_slots(in, mesh.tets_.size());
  if (!std::is_sorted(mesh.frozen_tets_.begin(), mesh.frozen_tets_.end())) {
    throw ByteReader::Damage("frozen tets are not in order");
  }
  if (!in.at_end()) {
    mesh.scale_ = decode_scale(in, mesh.standard_.is_own());
    for (const Point& p : mesh.points_) mesh.check_place(p);
  }
  if (!in.at_end() && mesh.standard_.is_own()) mesh.decode_noted_qualities(in);
  if (!in.at_end()) throw ByteReader::Damage("bytes behind the mesh");
  return mesh;
}

void SlotMesh::set_tet(TetHandle t, const TetVertices& vertices, Label label) {
  const std::size_t i = t.index();
  if (i >= tets_.size()) {
    tets_.resize(i + 1);
    labels_.resize(i + 1);
  }
  tet_count_ += vertices[0].is_valid() ? 1 : 0;
  tet_count_ -= tets_[i][0].is_valid() ? 1 : 0;
  tets_[i] = vertices;
  labels_[i] = label;
}

void SlotMesh::set_vertex(VertexHandle v, bool live, const Point& point) {
  const std::size_t i = v.index();
  if (i >= points_.size()) {
    points_.resize(i + 1, Point::Zero());
    live_.resize(i + 1, 0);
  }
  vertex_count_ += live ? 1 : 0;
  vertex_count_ -= live_[i] ? 1 : 0;
  points_[i] = point;
  live_[i] = live ? 1 : 0;
}

}  // namespace tetmend
