// SPDX-License-Identifier: MIT
// The tetrahedral mesh of a program: loops, walks, properties. A Transaction changes it.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/api.h>
#include <tetmend/io.h>
#include <tetmend/mesh.h>

#include "face/kernel/layout.h"
#include "face/kernel/properties.h"
#include "face/kernel/walks.h"
#include "kernel/geometry.h"
#include "kernel/integrity.h"
#include "kernel/tet_mesh.h"

#ifndef TETMEND_VERSION_TEXT  // the installed header says it
#define TETMEND_VERSION_TEXT nullptr
#endif

namespace tetmend::kernel {

// One namespace is enough for a program.
using tetmend::EditResult;
using tetmend::Error;
using tetmend::Finding;
using tetmend::HalfFace;
using tetmend::kEdgeVertices;
using tetmend::kFaceVertices;
using tetmend::Label;
using tetmend::load;
using tetmend::Mesh;
using tetmend::MeshArrays;
using tetmend::OwnMeasure;
using tetmend::Point;
using tetmend::Quality;
using tetmend::save;
using tetmend::Standard;
using tetmend::TetEdge;
using tetmend::TetHandle;
using tetmend::TetVertices;
using tetmend::VertexHandle;
using tetmend::volume6;

/// Coordinates as a program has them: three doubles each, `stride` doubles from one point to the
/// next. They are read where they are.
struct TETMEND_API PointView {
  const double* first = nullptr;
  std::size_t count = 0;
  std::ptrdiff_t stride = 3;

  PointView(const double* first_of_all, std::size_t number, std::ptrdiff_t step = 3)
      : first(first_of_all), count(number), stride(step) {}
  PointView(std::span<const Point> points);
  PointView(const std::vector<Point>& points);
  PointView(std::span<const std::array<double, 3>> points);
  PointView(const std::vector<std::array<double, 3>>& points);
};

/// Where everything went: the new number of each old slot, or kGoneSlot.
struct TETMEND_API Renumbering {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> tets;
};
inline constexpr std::uint32_t kGoneSlot = 0xFFFFFFFFu;

struct OperatorTools;

/// A mesh of tets. It is made of a Mesh or of arrays and gives one back; nothing that the Mesh held
/// is lost on the way. Slots begin as the numbers of the Mesh: tet 7 of its arrays is TetHandle(7).
///
/// Walks return values and change nothing: many threads may call const members at the same time.
/// Transactions, and all else that changes the mesh, belong to one thread. Lengths are those of the
/// Mesh. Functions that take handles, but for vertices(), point(), points(), twin(), twins(), label() and
/// quality(), throw Error for one that the mesh never had; walks of a deleted one are empty. Those few
/// cost one load, and have live handles as a precondition.
class TETMEND_API TetMesh {
 public:
  /// @throws Error, with the tet, when the topology is broken; see improve().
  explicit TetMesh(Mesh mesh) : TetMesh(std::move(mesh), kLayout) {}
  /// @param tets four numbers of points each, from 0, either way round
  /// @param labels regions, one for each tet or none; the faces between two stay
  /// @throws Error as Mesh does for its arrays, too
  explicit TetMesh(const PointView& points, std::span<const std::array<std::uint32_t, 4>> tets,
                   std::span<const Label> labels = {})
      : TetMesh(points, tets, labels, kLayout) {}
  /// With all properties. @throws Error while a transaction of `other` is open.
  TetMesh(const TetMesh& other);
  /// Precondition of both, and of the destructor: no transaction is open.
  TetMesh(TetMesh&& other) noexcept;
  TetMesh& operator=(TetMesh&& other) noexcept;
  TetMesh& operator=(const TetMesh& other);
  ~TetMesh();

  /// The mesh as it is now: with labels, groups, data and mid-side nodes, carried over as improve()
  /// does; the notes and what else its file held. Vertices that the Mesh had come first, in their
  /// order. @throws Error while a transaction is open.
  Mesh to_mesh() const;
  /// Writes the coordinates of all points in the order of to_mesh() into a program's own memory.
  /// Precondition: there is room for to_mesh().point_count() points.
  void write_points(double* first, std::ptrdiff_t stride = 3) const;

  // --- loops -------------------------------------------------------------------------------------
  std::size_t tet_count() const { return mesh_.tet_count(); }
  /// Of tets: mid-side nodes and points of no tet are not counted.
  std::size_t vertex_count() const { return mesh_.vertex_count() - loose_; }
  /// Live and deleted: bounds of index(), for arrays of one's own.
  std::size_t tet_slots() const { return mesh_.tet_slots(); }
  std::size_t vertex_slots() const { return mesh_.vertex_slots(); }
  bool is_deleted(TetHandle t) const {
    return t.index() >= mesh_.tet_slots() || mesh_.is_deleted(t);
  }
  bool is_deleted(VertexHandle v) const {
    return v.index() >= mesh_.vertex_slots() || mesh_.is_deleted(v);
  }

  LiveRange<TetHandle, LiveTet> tets() const {
    return {*this, static_cast<std::uint32_t>(mesh_.tet_slots())};
  }
  /// Those that have a tet.
  LiveRange<VertexHandle, LiveVertex> vertices() const {
    return {*this, static_cast<std::uint32_t>(mesh_.vertex_slots())};
  }
  /// Each face once: of its two half-faces one, and that of the tet where there is no other.
  LiveRange<HalfFace, LiveFace> faces() const {
    return {*this, static_cast<std::uint32_t>(4 * mesh_.tet_slots())};
  }
  /// The faces with nothing on the other side.
  LiveRange<HalfFace, BoundaryFace> boundary() const {
    return {*this, static_cast<std::uint32_t>(4 * mesh_.tet_slots())};
  }
  /// Each edge once. Cost: linear.
  Edges edges() const;

  // --- tets, faces, edges ------------------------------------------------------------------------
  /// In positive order: (v1 - v0) . ((v2 - v0) x (v3 - v0)) > 0.
  const TetVertices& vertices(TetHandle t) const { return mesh_.vertices(t); }
  /// Counterclockwise as seen from outside the tet of the half-face, which has a vertex opposite.
  std::array<VertexHandle, 3> vertices(HalfFace f) const { return mesh_.vertices(f); }
  std::array<VertexHandle, 2> vertices(TetEdge e) const { return mesh_.vertices(e); }
  std::array<Point, 4> points(TetHandle t) const {
    const TetVertices& v = mesh_.vertices(t);
    return {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
  }
  /// The edges of a tet, as it names them.
  std::array<TetEdge, 6> edges(TetHandle t) const {
    return {TetEdge(t, 0), TetEdge(t, 1), TetEdge(t, 2),
            TetEdge(t, 3), TetEdge(t, 4), TetEdge(t, 5)};
  }
  std::array<HalfFace, 4> faces(TetHandle t) const {
    return {HalfFace(t, 0), HalfFace(t, 1), HalfFace(t, 2), HalfFace(t, 3)};
  }
  /// The tets behind its faces: four, or fewer at the boundary.
  Neighbours neighbours(TetHandle t) const {
    return is_known(t, "neighbours") && !mesh_.is_deleted(t) ? Neighbours(mesh_.neighbours(t))
                                                             : Neighbours();
  }
  /// The other side of a face, or the outside.
  HalfFace twin(HalfFace f) const { return mesh_.twin(f); }
  /// Of each of its faces. A loop over all tets takes half the time that neighbours() takes.
  std::array<HalfFace, 4> twins(TetHandle t) const { return mesh_.neighbours(t); }
  bool is_boundary(HalfFace f) const { return mesh_.is_boundary(f); }
  bool is_boundary(TetEdge e) const { return !ring(e).closed; }
  /// Must stay: named by the Mesh, or between two labels.
  bool is_constrained(HalfFace f) const { return mesh_.is_constrained(f); }
  Label label(TetHandle t) const { return mesh_.label(t); }
  /// By the standard: 1 where a dihedral angle just reaches the goal of 30 and 150 degrees, less for a worse one, 0
  /// for a flat tet, negative for an inverted one.
  Quality quality(TetHandle t) const { return mesh_.quality(t); }

  // --- vertices ----------------------------------------------------------------------------------
  Point point(VertexHandle v) const { return mesh_.point_in_file(v); }
  bool is_boundary(VertexHandle v) const {
    return is_known(v, "is_boundary") && mesh_.is_boundary(v);
  }
  /// Coordinates by slot, where they lie: valid until anything changes the mesh. Empty where the
  /// mesh is worked with in other lengths than those of its Mesh, as one of far from ordinary size
  /// is.
  std::span<const Point> point_view() const {
    if (!mesh_.scale().is_one() || mesh_.vertex_slots() == 0) return {};
    return {&mesh_.point(VertexHandle(0)), mesh_.vertex_slots()};
  }
  /// On the boundary, on a constraint, required by the Mesh, or locked: neither moves nor vanishes.
  bool is_fixed(VertexHandle v) const {
    return is_known(v, "is_fixed") && (mesh_.is_fixed(v) || has_lock(v));
  }
  bool is_locked(VertexHandle v) const { return is_known(v, "is_locked") && has_lock(v); }
  /// From now on no transaction and no attempt moves or removes the vertex. Files do not hold this.
  /// @throws Error while a transaction is open, or for a deleted vertex.
  void lock(VertexHandle v) { set_lock(v, true); }
  void unlock(VertexHandle v) { set_lock(v, false); }

  // --- walks: values, in an order that follows from the connectivity alone -----------------------
  /// The tets around a vertex. Cost of this and the next two: linear in them.
  Star star(VertexHandle v) const;
  Link link(VertexHandle v) const;
  OneRing one_ring(VertexHandle v) const;
  /// The tets around an edge. Empty for an edge of a deleted tet. Cost: linear in them.
  Ring ring(TetEdge e) const;
  /// The same for all vertices, for programs that ask often. Cost: linear.
  Rows<VertexHandle> one_rings() const;
  Rows<TetHandle> stars() const;

  // --- finds; cost: that of a star ---------------------------------------------------------------
  std::optional<TetEdge> find_edge(VertexHandle a, VertexHandle b) const;
  /// The half-face whose vertices, seen from outside its tet, run as the three do.
  std::optional<HalfFace> find_face(VertexHandle a, VertexHandle b, VertexHandle c) const;
  std::optional<TetHandle> find_tet(VertexHandle a, VertexHandle b, VertexHandle c,
                                    VertexHandle d) const;

  // --- properties --------------------------------------------------------------------------------
  /// The property of the tets with that name, which keeps its initial value and rule, or a new one. It
  /// follows edits and their undo,
  /// garbage collection and sorting. What a program writes itself, undo does not take back. Arrays of the
  /// Mesh with the same name are others, see tet_data().
  /// @param rule what the tets that an edit makes begin with: NewTets, or a function, see TetRule
  /// @throws Error while a transaction is open, or when a property of that name has another type
  template <class T>
  TetProperty<T> tet_property(std::string_view name, T initial = {},
                              NewTets rule = NewTets::initial) {
    return TetProperty<T>(find_or_add<T>(keeper_->tets, name, std::move(initial),
                                         rule == NewTets::inherited, nullptr, tet_slots()));
  }
  template <class T, class Rule>
  requires std::invocable<Rule, std::span<const T>, TetHandle> TetProperty<T> tet_property(
      std::string_view name, T initial, Rule rule) {
    return TetProperty<T>(find_or_add<T>(keeper_->tets, name, std::move(initial), false,
                                         TetRule<T>(std::move(rule)), tet_slots()));
  }
  /// The same for vertices; those that are added begin with the initial value.
  template <class T>
  VertexProperty<T> vertex_property(std::string_view name, T initial = {}) {
    return VertexProperty<T>(find_or_add<T>(keeper_->vertices, name, std::move(initial), false,
                                            nullptr, vertex_slots()));
  }
  /// The same, carried from and to the arrays of a Mesh: it begins with the values of the array of that
  /// name, if there is one, and to_mesh() writes it. T is a number, an std::array of numbers, or Point.
  /// Tets that were made since have the initial value.
  /// @throws Error also for an array with another number of components, or of numbers that T has not
  template <class T>
  TetProperty<T> tet_data(std::string_view name, T initial = {}, NewTets rule = NewTets::initial) {
    static_assert(InFiles<T>::kComponents > 0, "files have no such values");
    const auto property = tet_property<T>(name, std::move(initial), rule);
    carry(keeper_->tets, name);
    return property;
  }
  template <class T, class Rule>
  requires std::invocable<Rule, std::span<const T>, TetHandle> TetProperty<T> tet_data(
      std::string_view name, T initial, Rule rule) {
    static_assert(InFiles<T>::kComponents > 0, "files have no such values");
    const auto property = tet_property<T>(name, std::move(initial), std::move(rule));
    carry(keeper_->tets, name);
    return property;
  }
  /// Likewise. @throws Error also for a mesh with mid-side nodes: it has more points than vertices
  template <class T>
  VertexProperty<T> point_data(std::string_view name, T initial = {}) {
    static_assert(InFiles<T>::kComponents > 0, "files have no such values");
    const auto property = vertex_property<T>(name, std::move(initial));
    carry(keeper_->vertices, name);
    return property;
  }
  /// False if there is none. @throws Error while a transaction is open.
  bool remove_tet_property(std::string_view name);
  bool remove_vertex_property(std::string_view name);

  // --- what tets are judged by --------------------------------------------------------------------
  /// From now on quality(), attempts and passes go by this standard: another goal, or a measure of the
  /// program, see Standard::of(). Cost: linear. @throws Error while a transaction is open
  void set_standard(const Standard& standard);
  const Standard& standard() const { return mesh_.standard(); }

  // --- the mesh as a whole; handles made before are invalid then ---------------------------------
  /// Removes deleted slots; the order of the others stays. @throws Error while a transaction is
  /// open.
  Renumbering collect_garbage();
  /// Neighbours in space become neighbours in memory: walks take half the time or less on a large
  /// mesh in a poor order. Removes deleted slots. @throws Error while a transaction is open.
  Renumbering sort_spatially();
  /// Contradictions in the mesh, none if it is sound. Cost: linear.
  std::vector<Finding> check() const;

 private:
  friend class Transaction;
  friend class Run;
  friend class OwnOperator;
  friend struct OperatorTools;
  friend struct LiveTet;
  friend struct LiveVertex;
  friend struct LiveFace;
  friend struct BoundaryFace;

  /// A look at a mesh of others, which must outlive it: for const members alone.
  explicit TetMesh(tetmend::TetMesh& of_others);

  static constexpr Layout kLayout = {TETMEND_VERSION_TEXT, sum_of_sizes()};
  TetMesh(Mesh mesh, Layout layout);
  TetMesh(const PointView& points, std::span<const std::array<std::uint32_t, 4>> tets,
          std::span<const Label> labels, Layout layout);
  void check_closed(std::string_view what) const {
    if (open_ != 0) refuse_open(what);
    check_idle(what);
  }
  /// Within a pass, an observer or an operator of the program must not change the mesh.
  void check_idle(std::string_view what) const {
    if (is_at_work_) refuse_at_work(what);
  }
  [[noreturn]] static void refuse_at_work(std::string_view what);
  [[noreturn]] static void refuse_open(std::string_view what);
  [[noreturn]] static void refuse_unknown(std::string_view what, std::string_view kind,
                                          std::uint32_t number, std::size_t slots);
  [[noreturn]] static void refuse_type(std::string_view name);
  /// True; throws for a vertex that the mesh never had.
  bool is_known(VertexHandle v, std::string_view what) const {
    if (v.index() >= mesh_.vertex_slots()) {
      refuse_unknown(what, "vertex", v.index(), mesh_.vertex_slots());
    }
    return true;
  }
  bool is_known(TetHandle t, std::string_view what) const {
    if (t.index() >= mesh_.tet_slots()) refuse_unknown(what, "tet", t.index(), mesh_.tet_slots());
    return true;
  }
  bool has_lock(VertexHandle v) const;
  void set_lock(VertexHandle v, bool is_locked);
  /// A property becomes an array of to_mesh(), and begins as that of the Mesh, unless it is one already.
  void carry(PropertyTable& table, std::string_view name);
  std::vector<std::uint32_t> numbers_of_tets() const;
  std::vector<std::uint32_t> numbers_of_vertices() const;
  void listen();
  void renew_workspace();
  Renumbering follow(const tetmend::TetMesh::KeptSlots& kept, std::size_t vertex_slots,
                     std::size_t tet_slots);

  template <class T>
  ArrayOf<T>& find_or_add(PropertyTable& table, std::string_view name, T initial, bool inherits,
                          TetRule<T> rule, std::size_t slots) {
    PropertyArray* known = table.find(name);
    if (known == nullptr) {
      check_closed("a property is added");
      auto array =
          std::make_unique<ArrayOf<T>>(name, std::move(initial), inherits, std::move(rule));
      array->grow(slots);
      known = &table.add(std::move(array));
      listen();
    }
    auto* array = dynamic_cast<ArrayOf<T>*>(known);
    if (array == nullptr) refuse_type(name);
    return *array;
  }

  tetmend::TetMesh own_;  // empty in a look
  tetmend::TetMesh& mesh_ = own_;
  std::size_t loose_ = 0;    // points of no tet
  unsigned open_ = 0;        // transactions
  bool is_at_work_ = false;  // a pass
  std::size_t stamp_ = 0;    // raised by whatever may use free slots, or move handles
  std::unique_ptr<Workspace> workspace_;
  std::unique_ptr<PropertyKeeper> keeper_;
  const ArrayOf<bool>* locks_ = nullptr;  // in the keeper
  /// What the Mesh held besides, and where its tets were: for to_mesh().
  struct Origin;
  std::unique_ptr<Origin> origin_;
  std::unique_ptr<OperatorTools, void (*)(OperatorTools*)> tools_{nullptr, nullptr};
};

inline bool LiveTet::is_wanted(const TetMesh& mesh, std::uint32_t code) {
  return !mesh.mesh_.is_deleted(TetHandle(code));
}
inline bool LiveVertex::is_wanted(const TetMesh& mesh, std::uint32_t code) {
  return mesh.mesh_.tet_of(VertexHandle(code)).is_valid();
}
inline bool LiveFace::is_wanted(const TetMesh& mesh, std::uint32_t code) {
  const HalfFace face = HalfFace::from_code(code);
  if (mesh.mesh_.is_deleted(face.tet())) return false;
  const HalfFace twin = mesh.mesh_.twin(face);
  return twin.is_outside() || face.code() < twin.code();
}
inline bool BoundaryFace::is_wanted(const TetMesh& mesh, std::uint32_t code) {
  const HalfFace face = HalfFace::from_code(code);
  return !mesh.mesh_.is_deleted(face.tet()) && mesh.mesh_.is_boundary(face);
}

inline void Edges::Iterator::skip() {
  for (; next_ != end_; ++next_) {
    const TetEdge hint = next_->edge;
    if (!mesh_->is_deleted(hint.tet())) {
      const auto [a, b] = mesh_->vertices(hint);
      if ((a == next_->a && b == next_->b) || (a == next_->b && b == next_->a)) {
        current_ = hint;
        return;
      }
    }
    if (mesh_->is_deleted(next_->a) || mesh_->is_deleted(next_->b)) continue;
    if (const auto found = mesh_->find_edge(next_->a, next_->b)) {
      current_ = *found;
      return;
    }
  }
}

}  // namespace tetmend::kernel
