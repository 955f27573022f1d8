// SPDX-License-Identifier: MIT
// The kernel: a mesh to walk over and to edit, operators one by one, operators written in Python.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <tetmend/schedule.h>

#include "bindings/python/core/arrays.h"
#include "bindings/python/core/mesh.h"
#include "explain/call_page.h"

namespace tetmend::python {

using namespace py::literals;

namespace {

using kernel::Call;
using kernel::Proposal;
using kernel::Ring;
using kernel::TetEdge;
using kernel::TetHandle;
using kernel::TetVertices;
using kernel::Transaction;
using kernel::VertexHandle;

using Numbers = std::vector<std::uint32_t>;

/// Numbers of handles.
template <class Handles>
Numbers numbers_of(const Handles& handles) {
  Numbers numbers;
  numbers.reserve(handles.size());
  for (const auto handle : handles) numbers.push_back(handle.index());
  return numbers;
}

Point to_point(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}
std::array<double, 3> coordinates_of(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// Rows of numbers, an array of its own.
template <std::size_t N>
py::array array_of(const std::vector<std::array<std::int32_t, N>>& rows) {
  py::array_t<std::int32_t> made({rows.size(), N});
  std::copy_n(rows.empty() ? nullptr : rows[0].data(), N * rows.size(), made.mutable_data());
  return made;
}

/// What a tetmend.TetMesh is in C++.
class KernelMesh {
 public:
  explicit KernelMesh(const Mesh& from) : mesh(from) {}
  ~KernelMesh() { end(0); }
  /// Without operators, whose functions know the mesh that they are of, and without views.
  KernelMesh(const KernelMesh& other) : mesh(other.mesh) {}
  KernelMesh& operator=(const KernelMesh&) = delete;

  /// Before anything that may move the memory of the mesh.
  void check_no_view() const {
    if (*views_ == 0) return;
    throw py::buffer_error(
        "the mesh cannot change while an array of its own memory, points or tets, is in use: "
        "delete it, or work on a copy of it");
  }
  VertexHandle vertex(std::uint32_t v) const {
    if (v < mesh.vertex_slots()) return VertexHandle(v);
    throw Error("there is no vertex " + std::to_string(v) + ": the mesh has numbers up to " +
                std::to_string(mesh.vertex_slots() - 1));
  }
  TetHandle tet(std::uint32_t t) const {
    if (t < mesh.tet_slots() && !mesh.is_deleted(TetHandle(t))) return TetHandle(t);
    throw Error("there is no tet " + std::to_string(t));
  }
  std::optional<TetEdge> edge(std::uint32_t a, std::uint32_t b) const {
    return mesh.find_edge(vertex(a), vertex(b));
  }
  /// As one of its two tets has it.
  std::optional<HalfFace> face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const auto found = mesh.find_face(vertex(a), vertex(b), vertex(c));
    return found ? found : mesh.find_face(vertex(a), vertex(c), vertex(b));
  }

  /// Rows that lie in the mesh itself, `stride` bytes apart. While the array or a part of it is there,
  /// nothing changes.
  py::array view_of_memory(const py::dtype& type, std::vector<py::ssize_t> shape,
                           py::ssize_t stride, const void* first, const py::object& self) const {
    struct Use {
      std::shared_ptr<std::size_t> views;
      py::object mesh;
    };
    ++*views_;
    const py::capsule use(new Use{views_, self}, [](void* memory) {
      const std::unique_ptr<Use> last(static_cast<Use*>(memory));
      --*last->views;
    });
    py::array made(type, std::move(shape), {stride, type.itemsize()}, first, use);
    made.attr("flags").attr("writeable") = false;
    return made;
  }

  /// Opens an edit within those that are open. Returns how many are.
  std::size_t begin() {
    check_no_view();
    scopes_.push_back(std::make_unique<Transaction>(mesh));
    return scopes_.size();
  }
  /// Ends all edits but so many, the inner ones first.
  void end(std::size_t left) {
    while (scopes_.size() > left) scopes_.pop_back();
  }
  Transaction& scope(std::size_t depth) {
    if (depth > scopes_.size()) throw Error("the edit has ended: open another one");
    return *scopes_[depth - 1];
  }

  bool has_open_edit() const { return !scopes_.empty(); }
  bool may_change() const { return !has_open_edit() && *views_ == 0; }

  kernel::TetMesh mesh;
  kernel::Operators operators;
  std::size_t changes = 0;  ///< raised by whatever may have changed the mesh for good

 private:
  std::vector<std::unique_ptr<Transaction>> scopes_;
  std::shared_ptr<std::size_t> views_ = std::make_shared<std::size_t>(0);
};

/// From a to b, as it was asked for: (a, b, tets, vertices, closed).
py::tuple ring_of(const KernelMesh& self, std::uint32_t a, std::uint32_t b) {
  const auto edge = self.edge(a, b);
  if (!edge) throw Error("there is no edge " + std::to_string(a) + ", " + std::to_string(b));
  const Ring ring = self.mesh.ring(*edge);
  Numbers tets = numbers_of(ring.tets);
  Numbers vertices = numbers_of(ring.vertices);
  if (ring.a.index() != a) {  // the other way round
    std::reverse(tets.begin(), tets.end());
    std::reverse(vertices.begin(), vertices.end());
    if (ring.closed) std::rotate(tets.begin(), tets.begin() + 1, tets.end());
  }
  return py::make_tuple(a, b, py::tuple(py::cast(tets)), py::tuple(py::cast(vertices)),
                        ring.closed);
}

py::array edges_of(const KernelMesh& self) {
  std::vector<std::array<std::int32_t, 2>> rows;
  for (const TetEdge e : self.mesh.edges()) {
    const auto [a, b] = self.mesh.vertices(e);
    rows.push_back({static_cast<std::int32_t>(a.index()), static_cast<std::int32_t>(b.index())});
  }
  return array_of(rows);
}

template <class Faces>
py::array faces_of(const KernelMesh& self, const Faces& faces) {
  std::vector<std::array<std::int32_t, 3>> rows;
  for (const HalfFace f : faces) {
    const auto v = self.mesh.vertices(f);
    rows.push_back({static_cast<std::int32_t>(v[0].index()),
                    static_cast<std::int32_t>(v[1].index()),
                    static_cast<std::int32_t>(v[2].index())});
  }
  return array_of(rows);
}

/// The tet behind the face opposite each corner, -1 for none.
py::array neighbours_of(const KernelMesh& self) {
  std::vector<std::array<std::int32_t, 4>> rows(self.mesh.tet_slots(), {-1, -1, -1, -1});
  for (const TetHandle t : self.mesh.tets()) {
    for (const HalfFace f : self.mesh.faces(t)) {
      if (self.mesh.is_boundary(f)) continue;
      rows[t.index()][f.face()] = static_cast<std::int32_t>(self.mesh.twin(f).tet().index());
    }
  }
  return array_of(rows);
}

/// A value for each slot of a tet, `none` where there is no tet.
template <class T, class Value>
py::array by_tet(const KernelMesh& self, T none, const Value& value) {
  py::array_t<T> made(static_cast<py::ssize_t>(self.mesh.tet_slots()));
  T* const values = made.mutable_data();
  std::fill_n(values, self.mesh.tet_slots(), none);
  for (const TetHandle t : self.mesh.tets()) values[t.index()] = static_cast<T>(value(t));
  return made;
}

py::array view_of_points(const py::object& given) {
  const auto& self = given.cast<const KernelMesh&>();
  const auto points = self.mesh.point_view();
  const auto count = static_cast<py::ssize_t>(self.mesh.vertex_slots());
  if (points.empty() && count > 0) {  // in other lengths than those of the memory
    py::array_t<double> made({count, py::ssize_t{3}});
    for (py::ssize_t v = 0; v < count; ++v) {
      const auto p = coordinates_of(self.mesh.point(VertexHandle(static_cast<std::uint32_t>(v))));
      std::copy(p.begin(), p.end(), made.mutable_data(v, 0));
    }
    return made;
  }
  return self.view_of_memory(py::dtype::of<double>(), {count, 3}, sizeof(Point),
                             points.empty() ? nullptr : points[0].data(), given);
}

py::array view_of_tets(const py::object& given) {
  const auto& self = given.cast<const KernelMesh&>();
  const auto count = static_cast<py::ssize_t>(self.mesh.tet_slots());
  const auto at = [&](std::uint32_t t) {
    return reinterpret_cast<const char*>(&self.mesh.vertices(TetHandle(t)));
  };
  return self.view_of_memory(py::dtype::of<std::int32_t>(), {count, 4},
                             count > 1 ? at(1) - at(0) : 32, count > 0 ? at(0) : nullptr, given);
}

// --- attempts

py::tuple to_tuple(const Call& call) {
  py::list children;
  for (const Call& child : call.children) children.append(to_tuple(child));
  return py::make_tuple(call.operator_name, py::tuple(py::cast(numbers_of(call.target))),
                        std::string(to_string(call.verdict)), call.level, call.worst_before,
                        call.worst_after, call.edits, py::tuple(children));
}

kernel::TargetKind kind_of(const Numbers& target) {
  constexpr std::array kKinds = {kernel::TargetKind::vertex, kernel::TargetKind::edge,
                                 kernel::TargetKind::face, kernel::TargetKind::tet};
  if (!target.empty() && target.size() <= kKinds.size()) return kKinds[target.size() - 1];
  throw Error("a target is 1 vertex, 2 of an edge, 3 of a face or 4 of a tet, not " +
              std::to_string(target.size()));
}

/// Nothing where it is not there.
std::optional<Target> target_of(const KernelMesh& self, const Numbers& v) {
  const auto to_target = [](const auto& found) {
    return found ? std::optional(Target::of(*found)) : std::nullopt;
  };
  switch (kind_of(v)) {
    case kernel::TargetKind::vertex:
      return Target::of(self.vertex(v[0]));
    case kernel::TargetKind::edge:
      return to_target(self.edge(v[0], v[1]));
    case kernel::TargetKind::face:
      return to_target(self.face(v[0], v[1], v[2]));
    default:
      return to_target(self.mesh.find_tet(self.vertex(v[0]), self.vertex(v[1]), self.vertex(v[2]),
                                          self.vertex(v[3])));
  }
}

py::tuple attempt(KernelMesh& self, const std::string& name, const Numbers& target,
                  const kernel::ParameterSettings& settings, bool keeps) {
  self.check_no_view();
  const std::optional<Target> at = target_of(self, target);
  if (!at) {
    Call call;
    call.operator_name = name;
    for (const std::uint32_t v : target) call.target.push_back(self.vertex(v));
    return to_tuple(call);
  }
  if (self.operators.find(name) == nullptr) {
    const Call call = kernel::attempt_at(self.mesh, name, *at, settings, keeps);
    self.changes += keeps && call.accepted() ? 1 : 0;
    return to_tuple(call);
  }
  if (keeps) ++self.changes;
  if (!settings.empty()) throw Error("operator '" + name + "' has no parameters");
  return to_tuple(kernel::attempt_at(self.mesh, self.operators, name, *at, keeps));
}

/// Ring and tree of what the attempt would do now, as pictures of SVG; none of an operator of the
/// program, while an edit is open or an array of the mesh's memory in use.
std::vector<std::string> drawings(KernelMesh& self, const std::string& name, const Numbers& target,
                                  const kernel::ParameterSettings& settings) {
  const std::optional<Target> at = target_of(self, target);
  if (!at || !self.may_change() || self.operators.find(name) != nullptr) return {};
  return explain::drawings_of_call(kernel::trace_of_attempt(self.mesh, name, *at, settings), 0);
}

std::vector<TetHandle> tets_of(const KernelMesh& self, const Numbers& numbers) {
  std::vector<TetHandle> tets;
  for (const std::uint32_t t : numbers) tets.push_back(self.tet(t));
  return tets;
}
std::vector<TetVertices> corners_of(const KernelMesh& self,
                                    const std::vector<std::array<std::uint32_t, 4>>& rows) {
  std::vector<TetVertices> tets;
  for (const auto& row : rows) {
    tets.push_back(
        {self.vertex(row[0]), self.vertex(row[1]), self.vertex(row[2]), self.vertex(row[3])});
  }
  return tets;
}

/// What a function of Python proposes, while it is called.
class PythonProposal {
 public:
  PythonProposal(const KernelMesh& mesh, Proposal& out) : mesh_(&mesh), out_(&out) {}
  void end() { out_ = nullptr; }
  bool is_made() const { return is_made_; }

  bool replace(const Numbers& old, const std::vector<std::array<std::uint32_t, 4>>& created) {
    check();
    out_->replace(tets_of(*mesh_, old), corners_of(*mesh_, created));
    return is_made_ = true;
  }
  bool move(std::uint32_t v, const std::array<double, 3>& point) {
    check();
    out_->move(mesh_->vertex(v), to_point(point));
    return is_made_ = true;
  }

 private:
  void check() const {
    if (out_ == nullptr) throw Error("a proposal is made while the operator is called");
  }
  const KernelMesh* mesh_;
  Proposal* out_;
  bool is_made_ = false;
};

py::array array_of(std::span<const std::array<Point, 4>> tets) {
  py::array_t<double> made({tets.size(), std::size_t{4}, std::size_t{3}});
  double* next = made.mutable_data();
  for (const auto& tet : tets) {
    for (const Point& p : tet) {
      for (const double c : coordinates_of(p)) *next++ = c;
    }
  }
  return made;
}

/// `propose` is called with a proposal and the vertices of the target; it answers False, or anything
/// else where it has proposed something.
void add_operator(KernelMesh& self, const std::string& name, const std::string& kind,
                  const std::string& help, const py::function& propose, const py::object& judge) {
  const KernelMesh* const mesh = &self;
  const auto call = [mesh, propose](const kernel::TetMesh& look, auto target, Proposal& out) {
    Numbers vertices;
    if constexpr (std::is_same_v<decltype(target), VertexHandle>) {
      vertices = {target.index()};
    } else {
      for (const VertexHandle v : look.vertices(target)) vertices.push_back(v.index());
    }
    const auto proposal = std::make_shared<PythonProposal>(*mesh, out);
    const py::object answer = propose(proposal, *py::tuple(py::cast(vertices)));
    proposal->end();
    mesh->check_no_view();
    const bool is_refused = py::isinstance<py::bool_>(answer) && !answer.cast<bool>();
    return proposal->is_made() && !is_refused ? kernel::Verdict::accepted
                                              : kernel::Verdict::not_applicable;
  };
  kernel::Judge by = kernel::Judge::strict();
  if (!judge.is_none()) {
    by = kernel::Judge::by([judge](kernel::Judge::Tets before, kernel::Judge::Tets now) {
      return py::bool_(judge(array_of(before), array_of(now))).cast<bool>();
    });
  }
  const auto add = [&](auto handle) {
    using Handle = decltype(handle);
    self.operators.add(
        name, help,
        [call](const kernel::TetMesh& look, Handle target, Proposal& out) {
          return call(look, target, out);
        },
        by);
  };
  if (kind == "vertex") return add(VertexHandle());
  if (kind == "edge") return add(TetEdge(TetHandle(0), 0));
  if (kind == "face") return add(HalfFace(TetHandle(0), 0));
  if (kind == "tet") return add(TetHandle());
  throw Error("an operator is for a 'vertex', an 'edge', a 'face' or a 'tet', not for '" + kind +
              "'");
}

// --- passes

/// What each pass of a script did: (name, attempts, accepted, n_bad afterwards).
py::list schedule(KernelMesh& self, const std::string& name_or_script,
                  const std::vector<std::pair<std::string, std::string>>& settings, int threads) {
  self.check_no_view();
  ++self.changes;
  const bool has_own = !self.operators.all().empty();
  kernel::Run run(self.mesh,
                  {.threads = threads, .operators = has_own ? &self.operators : nullptr});
  py::list passes;
  for (const kernel::PassDone& done : run.schedule(name_or_script, settings)) {
    passes.append(py::make_tuple(done.name, done.attempts, done.accepted, done.after.n_bad));
  }
  return passes;
}

// --- edits

/// One that is open, by how many are around it and itself.
struct PythonEdit {
  py::object owner;
  KernelMesh& mesh;
  std::size_t depth;
  EditResult result = EditResult::made;

  Transaction& scope() {
    mesh.check_no_view();
    return mesh.scope(depth);
  }
  /// Where the target is there. True: it was made.
  template <class Target, class Change>
  bool make(const std::optional<Target>& target, const Change& change) {
    Transaction& open = scope();
    result = target ? change(open, *target) : EditResult::not_closed;
    return result == EditResult::made;
  }
};

py::object split(PythonEdit& self, const Numbers& of, const std::array<double, 3>& point) {
  VertexHandle made;
  self.make(target_of(self.mesh, of), [&](Transaction& scope, Target target) {
    if (target.kind == kernel::TargetKind::vertex) {
      throw Error("split: 2 vertices of an edge, 3 of a face or 4 of a tet");
    }
    made = target.kind == kernel::TargetKind::edge   ? scope.split(target.edge(), to_point(point))
           : target.kind == kernel::TargetKind::face ? scope.split(target.face(), to_point(point))
                                                     : scope.split(target.tet(), to_point(point));
    return scope.result();
  });
  return made.is_valid() ? py::object(py::int_(made.index())) : py::object(py::none());
}

const char* result_text(EditResult result) {
  switch (result) {
    case EditResult::made:
      return "made";
    case EditResult::inverted:
      return "inverted";
    case EditResult::constrained:
      return "constrained";
    default:
      return "not_closed";
  }
}

void add_edit(py::module_& module) {
  using Self = PythonEdit;
  py::class_<Self>(module, "Edit")
      .def("end", [](Self& self) { self.mesh.end(self.depth - 1); })
      .def("keep",
           [](Self& self) {
             self.mesh.scope(self.depth).keep();
             ++self.mesh.changes;
           })
      .def("undo", [](Self& self) { self.mesh.scope(self.depth).undo(); })
      .def("move",
           [](Self& self, std::uint32_t v, const std::array<double, 3>& point) {
             return self.make(std::optional(self.mesh.vertex(v)), [&](auto& scope, auto at) {
               return scope.move(at, to_point(point));
             });
           })
      .def("flip_3_2",
           [](Self& self, std::uint32_t a, std::uint32_t b) {
             return self.make(self.mesh.edge(a, b),
                              [](auto& scope, auto at) { return scope.flip_3_2(at); });
           })
      .def("flip_2_3",
           [](Self& self, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
             return self.make(self.mesh.face(a, b, c),
                              [](auto& scope, auto at) { return scope.flip_2_3(at); });
           })
      .def("flip_4_4",
           [](Self& self, std::uint32_t a, std::uint32_t b, unsigned diagonal) {
             return self.make(self.mesh.edge(a, b),
                              [&](auto& scope, auto at) { return scope.flip_4_4(at, diagonal); });
           })
      .def("contract",
           [](Self& self, std::uint32_t gone, std::uint32_t stays) {
             return self.make(std::optional(self.mesh.vertex(gone)), [&](auto& scope, auto at) {
               return scope.contract(at, self.mesh.vertex(stays));
             });
           })
      .def("split", &split)
      .def("replace",
           [](Self& self, const Numbers& old,
              const std::vector<std::array<std::uint32_t, 4>>& created) {
             return self.make(std::optional(tets_of(self.mesh, old)), [&](auto& scope, auto& at) {
               return scope.replace(at, corners_of(self.mesh, created));
             });
           })
      .def("result", [](const Self& self) { return result_text(self.result); })
      .def("before", [](Self& self) { return array_of(self.mesh.scope(self.depth).before()); })
      .def("after", [](Self& self) { return array_of(self.mesh.scope(self.depth).after()); })
      .def("created", [](Self& self) { return numbers_of(self.mesh.scope(self.depth).created()); })
      .def("changed", [](Self& self) { return numbers_of(self.mesh.scope(self.depth).changed()); });
}

void add_walks(py::class_<KernelMesh>& made) {
  using Self = KernelMesh;
  made.def("star", [](const Self& self,
                      std::uint32_t v) { return numbers_of(self.mesh.star(self.vertex(v))); })
      .def("one_ring",
           [](const Self& self, std::uint32_t v) {
             return numbers_of(self.mesh.one_ring(self.vertex(v)));
           })
      .def("ring", &ring_of)
      .def("vertices",
           [](const Self& self, std::uint32_t t) {
             return py::tuple(py::cast(numbers_of(self.mesh.vertices(self.tet(t)))));
           })
      .def("point",
           [](const Self& self, std::uint32_t v) {
             const auto p = coordinates_of(self.mesh.point(self.vertex(v)));
             return py::array_t<double>(3, p.data());
           })
      .def("find_tet",
           [](const Self& self, std::uint32_t a, std::uint32_t b, std::uint32_t c,
              std::uint32_t d) -> py::object {
             const auto found =
                 self.mesh.find_tet(self.vertex(a), self.vertex(b), self.vertex(c), self.vertex(d));
             return found ? py::object(py::int_(found->index())) : py::object(py::none());
           })
      .def("has_edge",
           [](const Self& self, std::uint32_t a, std::uint32_t b) {
             return self.mesh.find_edge(self.vertex(a), self.vertex(b)).has_value();
           })
      .def("is_boundary",
           [](const Self& self, std::uint32_t v) { return self.mesh.is_boundary(self.vertex(v)); })
      .def("is_fixed",
           [](const Self& self, std::uint32_t v) { return self.mesh.is_fixed(self.vertex(v)); })
      .def("lock",
           [](Self& self, std::uint32_t v) {
             self.mesh.lock(self.vertex(v));
             ++self.changes;
           })
      .def("unlock",
           [](Self& self, std::uint32_t v) {
             self.mesh.unlock(self.vertex(v));
             ++self.changes;
           })
      .def("edges", &edges_of)
      .def("faces", [](const Self& self) { return faces_of(self, self.mesh.faces()); })
      .def("boundary", [](const Self& self) { return faces_of(self, self.mesh.boundary()); })
      .def("neighbours", &neighbours_of)
      .def("labels",
           [](const Self& self) {
             return by_tet<std::int32_t>(self, 0, [&](TetHandle t) { return self.mesh.label(t); });
           })
      .def("quality",
           [](const Self& self) {
             constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
             return by_tet<float>(self, kNone, [&](TetHandle t) { return self.mesh.quality(t); });
           })
      .def("is_live",
           [](const Self& self) {
             return by_tet<bool>(self, false, [](TetHandle) { return true; });
           })
      .def_property_readonly("points", &view_of_points)
      .def_property_readonly("tets", &view_of_tets);
}

}  // namespace

void add_kernel(py::module_& module) {
  add_edit(module);
  py::class_<PythonProposal, std::shared_ptr<PythonProposal>>(module, "Proposal")
      .def("replace", &PythonProposal::replace)
      .def("move", &PythonProposal::move);
  py::class_<KernelMesh> made(module, "TetMesh");
  made.def(py::init<const Mesh&>(), "mesh"_a)
      .def("copy", [](const KernelMesh& self) { return std::make_unique<KernelMesh>(self); })
      .def_property_readonly("tet_count",
                             [](const KernelMesh& self) { return self.mesh.tet_count(); })
      .def_property_readonly("vertex_count",
                             [](const KernelMesh& self) { return self.mesh.vertex_count(); })
      .def("to_mesh", [](const KernelMesh& self) { return self.mesh.to_mesh(); })
      .def("collect_garbage",
           [](KernelMesh& self) {
             self.check_no_view();
             ++self.changes;
             kernel::Renumbering went = self.mesh.collect_garbage();
             return py::make_tuple(to_array(std::move(went.vertices)),
                                   to_array(std::move(went.tets)));
           })
      .def("check", [](const KernelMesh& self) { return self.mesh.check().size(); })
      .def("begin",
           [](const py::object& self) {
             auto& mesh = self.cast<KernelMesh&>();
             return PythonEdit{self, mesh, mesh.begin()};
           })
      .def("attempt", &attempt)
      .def("drawings", &drawings)
      .def("has_open_edit", &KernelMesh::has_open_edit)
      .def_readonly("changes", &KernelMesh::changes)
      .def("schedule", &schedule)
      .def("add_operator", &add_operator);
  add_walks(made);
}

}  // namespace tetmend::python
