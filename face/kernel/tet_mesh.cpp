// SPDX-License-Identifier: MIT
// A program's mesh: made of a Mesh and given back as one, properties, order of the slots.
#include "face/kernel/tet_mesh.h"

#include <algorithm>

#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "face/carry.h"
#include "face/constraints.h"
#include "face/kernel/origin.h"
#include "face/maps.h"
#include "face/mesh_access.h"
#include "face/mid_nodes.h"
#include "kernel/curved.h"
#include "kernel/mesh_view.h"
#include "kernel/workspace.h"

namespace tetmend::kernel {

PointView::PointView(std::span<const Point> points)
    : first(points.empty() ? nullptr : points[0].data()), count(points.size()) {}
PointView::PointView(const std::vector<Point>& points)
    : PointView(std::span<const Point>(points)) {}
PointView::PointView(std::span<const std::array<double, 3>> points)
    : first(points.empty() ? nullptr : points[0].data()), count(points.size()) {}
PointView::PointView(const std::vector<std::array<double, 3>>& points)
    : PointView(std::span<const std::array<double, 3>>(points)) {}

namespace {

constexpr std::string_view kLockName = "tetmend:locked";

/// "0.1" of "0.1.0".
std::string_view minor_of(std::string_view version) {
  return version.substr(0, version.find('.', version.find('.') + 1));
}

/// The live ones of so many slots.
template <class HandleType>
std::vector<std::uint32_t> live(const tetmend::TetMesh& mesh, std::size_t slots) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < slots; ++i) {
    if (!mesh.is_deleted(HandleType(i))) kept.push_back(i);
  }
  return kept;
}

/// Where the slots went of which these are kept, in this order.
std::vector<std::uint32_t> inverse(std::span<const std::uint32_t> kept, std::size_t slots) {
  std::vector<std::uint32_t> numbers(slots, kGoneSlot);
  for (std::uint32_t i = 0; i < kept.size(); ++i) numbers[kept[i]] = i;
  return numbers;
}

std::size_t count_loose(const tetmend::TetMesh& mesh) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (!mesh.is_deleted(v) && !mesh.tet_of(v).is_valid()) ++count;
  }
  return count;
}

Mesh mesh_of(const PointView& points, std::span<const std::array<std::uint32_t, 4>> tets,
             std::span<const Label> labels) {
  MeshArrays arrays;
  arrays.points.reserve(points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    const double* p = points.first + static_cast<std::ptrdiff_t>(i) * points.stride;
    arrays.points.push_back({p[0], p[1], p[2]});
  }
  arrays.tets.assign(tets.begin(), tets.end());
  arrays.tet_labels.assign(labels.begin(), labels.end());
  return Mesh(std::move(arrays));
}

/// Puts the properties that are for files among the arrays of a mesh, in its order.
void write_data(const PropertyKeeper& keeper, const tetmend::TetMesh& mesh, MeshData& data) {
  const auto write = [](const PropertyTable& table, const auto& slots_of,
                        std::vector<DataArray>& arrays) {
    for (const auto& property : table.all()) {
      if (!property->is_in_files) continue;
      const auto same = std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& array) {
        return array.name == property->name();
      });
      DataArray made = property->to_data(slots_of());
      if (same == arrays.end()) {
        arrays.push_back(std::move(made));
      } else {
        *same = std::move(made);
      }
    }
  };
  write(
      keeper.tets, [&] { return live<TetHandle>(mesh, mesh.tet_slots()); }, data.tet_data);
  const auto points = [&] {
    const MeshView view(mesh);
    const auto slots = view.vertex_slots();
    if (slots.empty()) return live<VertexHandle>(mesh, mesh.vertex_slots());
    return std::vector<std::uint32_t>(slots.begin(), slots.end());
  };
  write(keeper.vertices, points, data.point_data);
}

}  // namespace

void check_layout(const Layout& of_program) {
  if (of_program.version == nullptr) return;  // part of this build
  const std::string_view program = of_program.version;
  if (minor_of(program) == minor_of(version()) && of_program.sizes == sum_of_sizes()) return;
  throw Error(fmt::format(
      "<tetmend/kernel.h>: the program was compiled with the headers of tetmend {}, and runs with "
      "libtetmend {}{}: compile it again",
      program, version(),
      minor_of(program) == minor_of(version()) ? ", whose classes have other sizes" : ""));
}

TetMesh::~TetMesh() = default;
TetMesh::TetMesh(TetMesh&& other) noexcept
    : own_(std::move(other.mesh_)),
      loose_(other.loose_),
      open_(other.open_),
      stamp_(other.stamp_),
      workspace_(std::move(other.workspace_)),
      keeper_(std::move(other.keeper_)),
      locks_(other.locks_),
      origin_(std::move(other.origin_)),
      tools_(std::move(other.tools_)) {}

TetMesh& TetMesh::operator=(TetMesh&& other) noexcept {
  mesh_ = std::move(other.mesh_);
  loose_ = other.loose_;
  open_ = other.open_;
  stamp_ = other.stamp_;
  workspace_ = std::move(other.workspace_);
  keeper_ = std::move(other.keeper_);
  locks_ = other.locks_;
  origin_ = std::move(other.origin_);
  tools_ = std::move(other.tools_);
  return *this;
}

TetMesh::TetMesh(tetmend::TetMesh& of_others)
    : mesh_(of_others),
      loose_(count_loose(of_others)),
      keeper_(std::make_unique<PropertyKeeper>()),
      origin_(std::make_unique<Origin>()) {}

TetMesh::TetMesh(const TetMesh& other)
    : own_((other.check_closed("a copy is made"), other.mesh_)),
      loose_(other.loose_),
      workspace_(std::make_unique<Workspace>(mesh_)),
      keeper_(std::make_unique<PropertyKeeper>(*other.keeper_)),
      origin_(std::make_unique<Origin>(*other.origin_)) {
  listen();
}

TetMesh& TetMesh::operator=(const TetMesh& other) {
  check_closed("it is replaced");
  TetMesh copy(other);
  *this = std::move(copy);
  return *this;
}

TetMesh::TetMesh(Mesh mesh, Layout layout) {
  check_layout(layout);
  const std::filesystem::path file = mesh.file();
  MeshData data = MeshAccess::take(mesh);
  origin_ = std::make_unique<Origin>();
  origin_->point_count = data.points.size();
  origin_->notes = data.notes;
  origin_->holds_more = face::holds_more(data);
  if (origin_->holds_more) origin_->data = data;
  face::name_constraints(data, true);
  mesh_ = face::build_located(
      file, data,
      {.sorted = false, .tet_numbers = origin_->holds_more ? &origin_->tet_numbers : nullptr});
  for (Point& p : origin_->data.points) p = mesh_.scale().to_work(p);
  if (!origin_->data.mid_nodes.empty()) {
    auto curved = std::make_shared<CurvedEdges>(origin_->data, mesh_, true);
    if (!curved->is_empty()) mesh_.set_curved_edges(std::move(curved));
  }
  loose_ = count_loose(mesh_);
  workspace_ = std::make_unique<Workspace>(mesh_);
  keeper_ = std::make_unique<PropertyKeeper>();
}

TetMesh::TetMesh(const PointView& points, std::span<const std::array<std::uint32_t, 4>> tets,
                 std::span<const Label> labels, Layout layout)
    : TetMesh(mesh_of(points, tets, labels), layout) {}

Mesh TetMesh::to_mesh() const {
  if (open_ != 0) refuse_open("to_mesh()");  // an observer may look
  MeshData data = mesh_.to_data();
  if (origin_->holds_more) {
    const Scale& scale = mesh_.scale();
    scale.to_work(data.points);
    const std::size_t old_tets = origin_->data.tets.size();
    std::vector<std::uint32_t> numbers = origin_->tet_numbers;
    numbers.resize(std::max(old_tets, mesh_.tet_slots()));
    std::vector<std::uint32_t> tet_map = face::map_tets(mesh_, numbers);
    tet_map.resize(old_tets);
    auto vertex_map = face::map_vertices(mesh_, origin_->point_count);
    face::renew_mid_nodes(origin_->data, vertex_map, data);
    face::carry(origin_->data, vertex_map, tet_map, {}, data);
    scale.to_file(data.points);
  }
  write_data(*keeper_, mesh_, data);
  data.notes = origin_->notes;
  return MeshAccess::make(std::move(data));
}

void TetMesh::write_points(double* first, std::ptrdiff_t stride) const {
  const auto write = [&](std::size_t i, const auto& p) {
    double* place = first + static_cast<std::ptrdiff_t>(i) * stride;
    for (unsigned k = 0; k < 3; ++k) place[k] = p[k];
  };
  if (!origin_->data.mid_nodes.empty()) {
    const Mesh mesh = to_mesh();
    for (std::size_t i = 0; i < mesh.point_count(); ++i) write(i, mesh.points()[i]);
    return;
  }
  check_closed("write_points()");
  const MeshView view(mesh_);
  for (std::size_t i = 0; i < view.point_count(); ++i) write(i, view.point(i));
}

void TetMesh::refuse_open(std::string_view what) {
  throw Error(
      fmt::format("{} while a transaction is open: it ends with its scope, kept or not", what));
}

void TetMesh::refuse_at_work(std::string_view what) {
  throw Error(fmt::format(
      "{} while a pass works on the mesh: observers and operators look, and change nothing", what));
}

void TetMesh::refuse_unknown(std::string_view what, std::string_view kind, std::uint32_t number,
                             std::size_t slots) {
  throw Error(
      number == VertexHandle::kInvalid
          ? fmt::format("{}: a handle of no {}, as the corners of a deleted tet are", what, kind)
          : fmt::format("{}: no {} {}: the mesh has slots 0 to {}", what, kind, number, slots - 1));
}

void TetMesh::refuse_type(std::string_view name) {
  throw Error(fmt::format("property '{}' exists already, with another type", name));
}

bool TetMesh::has_lock(VertexHandle v) const {
  return locks_ != nullptr && v.index() < locks_->values.size() && locks_->values[v.index()];
}

void TetMesh::set_lock(VertexHandle v, bool is_locked) {
  is_known(v, is_locked ? "lock" : "unlock");
  check_closed("a vertex is locked or unlocked");
  if (is_deleted(v)) throw Error(fmt::format("lock: vertex {} is deleted", v.index()));
  if (locks_ == nullptr && !is_locked) return;
  auto& locks =
      find_or_add<bool>(keeper_->vertices, kLockName, false, false, nullptr, vertex_slots());
  locks.values[v.index()] = is_locked;
}

/// In the arrays of the Mesh, by slot.
std::vector<std::uint32_t> TetMesh::numbers_of_tets() const {
  std::vector<std::uint32_t> numbers(tet_slots(), PropertyArray::kNoNumber);
  for (const TetHandle t : tets()) {
    if (!mesh_.is_created(t)) numbers[t.index()] = origin_->tet_numbers[t.index()];
  }
  return numbers;
}

std::vector<std::uint32_t> TetMesh::numbers_of_vertices() const {
  std::vector<std::uint32_t> numbers(vertex_slots(), PropertyArray::kNoNumber);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    const VertexHandle v(i);
    if (mesh_.is_deleted(v) || mesh_.origin(v) == tetmend::TetMesh::kNotFromFile) continue;
    numbers[i] = mesh_.origin(v);
  }
  return numbers;
}

void TetMesh::carry(PropertyTable& table, std::string_view name) {
  PropertyArray& property = *table.find(name);
  if (property.is_in_files) return;
  const bool is_of_tets = &table == &keeper_->tets;
  const MeshData& data = origin_->data;
  if (!is_of_tets && !data.mid_nodes.empty()) {
    throw Error(
        fmt::format("point_data '{}': a mesh with mid-side nodes has more points than "
                    "vertices",
                    name));
  }
  const auto& arrays = is_of_tets ? data.tet_data : data.point_data;
  const auto found = std::find_if(arrays.begin(), arrays.end(),
                                  [&](const DataArray& array) { return array.name == name; });
  if (found != arrays.end()) {
    property.read(*found, is_of_tets ? numbers_of_tets() : numbers_of_vertices());
  }
  property.is_in_files = true;
}

/// Free slots are others than before.
void TetMesh::renew_workspace() {
  ++stamp_;
  workspace_ = std::make_unique<Workspace>(mesh_);
  listen();
}

/// Edits are told to the keeper where it has something to do.
void TetMesh::listen() {
  locks_ = dynamic_cast<const ArrayOf<bool>*>(keeper_->vertices.find(kLockName));
  keeper_->set_locks(locks_);
  workspace_->set_listener(keeper_->is_needed() ? keeper_.get() : nullptr);
}

void TetMesh::set_standard(const Standard& standard) {
  check_closed("set_standard()");
  mesh_.set_standard(standard);
  ++stamp_;
}

bool TetMesh::remove_tet_property(std::string_view name) {
  check_closed("a property is removed");
  const bool is_there = keeper_->tets.remove(name);
  listen();
  return is_there;
}

bool TetMesh::remove_vertex_property(std::string_view name) {
  check_closed("a property is removed");
  const bool is_there = keeper_->vertices.remove(name);
  listen();
  return is_there;
}

Renumbering TetMesh::collect_garbage() {
  check_closed("collect_garbage()");
  const std::size_t all_vertices = vertex_slots();
  const std::size_t all_tets = tet_slots();
  return follow(mesh_.collect_garbage(), all_vertices, all_tets);
}

Renumbering TetMesh::sort_spatially() {
  check_closed("sort_spatially()");
  Renumbering went = collect_garbage();  // so that the order does not depend on what is deleted
  const Renumbering next = follow(mesh_.sort_spatially(), vertex_slots(), tet_slots());
  for (std::uint32_t& v : went.vertices) v = v == kGoneSlot ? v : next.vertices[v];
  for (std::uint32_t& t : went.tets) t = t == kGoneSlot ? t : next.tets[t];
  return went;
}

/// All that lies beside the mesh follows, which had so many slots.
Renumbering TetMesh::follow(const tetmend::TetMesh::KeptSlots& kept, std::size_t vertex_slots,
                            std::size_t tet_slots) {
  for (const auto& array : keeper_->vertices.all()) array->gather(kept.vertices);
  for (const auto& array : keeper_->tets.all()) array->gather(kept.tets);
  if (std::vector<std::uint32_t>& numbers = origin_->tet_numbers; !numbers.empty()) {
    // Those of tets that were made are not looked at.
    std::vector<std::uint32_t> next;
    for (const std::uint32_t t : kept.tets) next.push_back(t < numbers.size() ? numbers[t] : 0);
    numbers = std::move(next);
  }
  renew_workspace();
  return {inverse(kept.vertices, vertex_slots), inverse(kept.tets, tet_slots)};
}

std::vector<Finding> TetMesh::check() const {
  return check_integrity(mesh_);
}

}  // namespace tetmend::kernel
