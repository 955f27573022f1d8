// SPDX-License-Identifier: MIT
// What stands out in the picture of a document, and where its camera goes.
#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "explain/removal.h"
#include "kernel/error.h"
#include "kernel/shell.h"
#include "viewer/debugger/call_highlight.h"
#include "viewer/debugger/tets_drawing.h"
#include "viewer/document.h"
#include "viewer/mesh/direction.h"

namespace tetmend::viewer {

namespace {

constexpr std::size_t kMostNamed = 80;  // more numbers cannot be read

void add_name(std::vector<NamedVertex>& names, VertexHandle v, std::string role = {}) {
  const auto same = [&](const NamedVertex& name) { return name.vertex == v; };
  if (names.size() >= kMostNamed || std::any_of(names.begin(), names.end(), same)) return;
  names.push_back({v, std::move(role)});
}

/// Around tets, without their surroundings; nothing if there are none.
std::optional<Ball> ball_of(const TetMesh& mesh, const std::vector<TetHandle>& tets) {
  if (tets.empty()) return std::nullopt;
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high = -low;
  for (const TetHandle t : tets) {
    for (const glm::dvec3& p : corners(mesh, t)) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  return Ball{(low + high) / 2.0, std::max(glm::distance(low, high) / 2, 1e-12)};
}

/// Around both, if the other is not so much larger that the one would be lost in it.
Ball join(const Ball& one, const Ball& other) {
  constexpr double kMost = 2.5;
  const double apart = glm::distance(one.centre, other.centre);
  const double radius =
      std::max((apart + one.radius + other.radius) / 2, std::max(one.radius, other.radius));
  if (radius > kMost * one.radius) return one;
  if (apart + one.radius <= other.radius) return other;
  if (apart + other.radius <= one.radius) return one;
  const glm::dvec3 along = (other.centre - one.centre) / apart;
  return {one.centre + (radius - one.radius) * along, radius};
}

/// Of the tets that are shown of the call at hand.
std::string state_of_tets(const Debugger& debugger) {
  if (debugger.call() == kNoCall) return "tets beside it";
  const Call& call = debugger.file().calls()[debugger.call()];
  const Timeline& timeline = debugger.timeline();
  const bool is_changed =
      timeline.changes_before(debugger.position()) > timeline.changes_before(call.events.begin);
  if (!is_changed) return "tets before the call";
  if (debugger.position() < call.events.end) return "tets after a step";
  return call.accepted() ? "tets after the call" : "tets as before: undone";
}

/// The colours of what is selected, as highlight() has it.
std::vector<LegendEntry> legend_of(const TetMesh& mesh, const Selection& selection,
                                   bool is_target) {
  if (const auto* edge = std::get_if<TetEdge>(&selection)) {
    const auto ends = mesh.vertices(*edge);
    const auto from = std::min<std::uint32_t>(ends[0].index(), ends[1].index());
    const auto to = std::max<std::uint32_t>(ends[0].index(), ends[1].index());
    return {{kSupportingEdgeColour, fmt::format("supporting edge {} {}", from, to)},
            {kSkirtColour, "skirt polygon"}};
  }
  if (const auto* v = std::get_if<VertexHandle>(&selection)) {
    return {{kSupportingEdgeColour, fmt::format("vertex {}", v->index())},
            {kSkirtColour, "edges at it"}};
  }
  if (const auto* f = std::get_if<HalfFace>(&selection)) {
    const auto c = mesh.vertices(*f);
    return {{kSupportingEdgeColour,
             fmt::format("face {} {} {}", c[0].index(), c[1].index(), c[2].index())}};
  }
  if (std::holds_alternative<TetHandle>(selection)) {
    return {{kSelectionColour, is_target ? "tet of the call" : "selected tet"}};
  }
  return {};
}

}  // namespace

bool Pointed::contains(std::span<const VertexHandle> all) const {
  return !all.empty() && std::all_of(all.begin(), all.end(), [&](VertexHandle v) {
    return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
  });
}

// --- the camera ----------------------------------------------------------------------------------

void Document::go_home() {
  view.camera.look_from("home");
  view.camera.fit(box_, canvas);
}

void Document::fit_first() {
  if (call_in_view()) {
    fit();
  } else {
    go_home();
  }
}

/// Around the call at hand and the shell of its caller, unless something else is selected.
std::optional<Ball> Document::call_in_view() {
  if (debugger_ == nullptr) return std::nullopt;
  if (selection_ != target_ && !std::holds_alternative<std::monostate>(selection_)) {
    return std::nullopt;
  }
  const CallStudy* study = debugger_->study();
  if (study == nullptr) return ball_of(mesh_, near_);  // of the tet visited
  auto ball = ball_around(*study);
  if (!ball) ball = ball_of(mesh_, near_);
  if (!ball || !caller_edge_) return ball;
  const auto caller = ball_of(mesh_, shell_of_caller());
  return caller ? join(*ball, *caller) : *ball;
}

void Document::fit() {
  constexpr double kSurroundings = 1.3;
  const auto call = call_in_view();
  // A mesh that is little more than the call, as in lessons, fills the picture.
  const bool is_whole = call && kSurroundings * call->radius > ball_.radius;
  if (call && !is_whole) {
    view.camera.fit({call->centre, kSurroundings * call->radius}, canvas);
  } else if (is_whole || std::holds_alternative<std::monostate>(selection_)) {
    view.camera.fit(box_, canvas);
  } else {
    view.camera.fit(ball_around(mesh_, selection_), canvas);
  }
}

void Document::fly_to(const Selection& selection) {
  select(selection);
  is_alone_ = true;
  if (view.scene.isolate) return fit();
  // Close enough to see it, far enough to see where it is.
  const Ball around = ball_around(mesh_, selection_);
  view.camera.fit({around.centre, std::max(3 * around.radius, 1e-3 * ball_.radius)}, canvas);
}

void Document::fly_to_worst(std::size_t i) {
  if (i >= worst().size()) {
    throw Error(
        fmt::format("the list of the worst has {} tets, there is no {}", worst().size(), i + 1));
  }
  const TetHandle tet = worst()[i];
  if (!view.scene.isolate) camera_before_alone_ = view.camera;
  view.scene.isolate = true;
  turn_to(view.camera, corners(mesh_, tet));
  select(tet);
  is_alone_ = true;
  fit();
}

void Document::fly_to_place(std::size_t i) {
  const BadPlace place = bad_places()[i];
  select(place.worst);
  view.camera.fit(place.ball, canvas);
}

void Document::toggle_isolation() {
  const bool is_own = selection_ != target_ && !std::holds_alternative<std::monostate>(selection_);
  const bool is_picked = debugger_ != nullptr && is_own && !is_alone_;  // seen in its place so far
  if (is_own && (is_picked || !view.scene.isolate)) return isolate_selection();
  const bool was_alone = is_alone_ && view.scene.isolate;
  view.scene.isolate = !view.scene.isolate;
  if (was_alone) show_rest();
  const auto call = call_in_view();
  if (view.scene.isolate && call && !is_seen(*call)) fit();
}

void Document::isolate_selection() {
  is_alone_ = true;
  isolated_.settings.reset();
  view.scene.isolate = true;
  camera_before_alone_ = view.camera;
  if (!is_seen(ball_around(mesh_, selection_))) fit();
}

/// As it was before something was alone.
void Document::show_rest() {
  if (camera_before_alone_) view.camera = *camera_before_alone_;
  camera_before_alone_.reset();
}

void Document::end_alone() {
  if (debugger_ == nullptr && view.scene.isolate) {
    view.scene.isolate = false;
    show_rest();
  }
  camera_before_alone_.reset();
}

/// Most of it lies in the canvas, and it is neither a dot nor much larger than the canvas.
bool Document::is_seen(const Ball& ball) const {
  constexpr double kLeast = 0.06;  // of the height
  constexpr double kMost = 0.8;
  const auto centre = view.camera.project(ball.centre, canvas);
  const auto top = view.camera.project(ball.centre + ball.radius * view.camera.up(), canvas);
  if (!centre || !top) return false;
  const double radius = glm::distance(*centre, *top);
  const auto is_within = [&](double place, double size) {
    constexpr double kPart = 0.6;  // of the radius
    const double margin = std::min(kPart * radius, 0.4 * size);
    return place > margin && place < size - margin;
  };
  const bool is_inside = is_within(centre->x, canvas.width) && is_within(centre->y, canvas.height);
  const double share = radius / std::max(canvas.height, 1);
  return is_inside && share > kLeast && share < kMost;
}

void Document::follow_call() {
  const std::uint32_t call = debugger_->call();
  const std::uint32_t root = call == kNoCall ? kNoCall : debugger_->stack().front();
  const bool is_new = call != shown_call_;
  const bool is_elsewhere = root != shown_root_;
  shown_call_ = call;
  shown_root_ = root;
  if (!follow_trace) return;
  const auto ball = call_in_view();
  if (call == kNoCall) {
    if (view.scene.isolate && ball && !is_seen(*ball)) fit();
    return;
  }
  if (is_elsewhere || (is_new && view.scene.isolate && ball && !is_seen(*ball))) fit();
}

bool Document::undo_view() {
  const auto before = history_.undo(view);
  if (before) view = *before;
  return before.has_value();
}

bool Document::redo_view() {
  const auto after = history_.redo(view);
  if (after) view = *after;
  return after.has_value();
}

// --- what stands out -----------------------------------------------------------------------------

/// The tets to show. Empty: all.
std::vector<TetHandle> Document::isolated() const {
  if (!view.scene.isolate) return {};
  const bool is_own = selection_ != target_ && !std::holds_alternative<std::monostate>(selection_);
  if (!is_own) return near_;
  if (debugger_ != nullptr && !is_alone_) return near_;  // a click only points it out
  std::vector<TetHandle> selected = tets_of(mesh_, selection_);
  const bool is_among = std::any_of(selected.begin(), selected.end(), [&](TetHandle t) {
    return std::binary_search(near_.begin(), near_.end(), t);
  });
  return is_among ? near_ : selected;
}

void Document::mark(const Highlight& highlight, const Colour& colour, std::string text) {
  if (highlight.lines.empty() && highlight.faces.empty()) return;
  marks_.lines.insert(marks_.lines.end(), highlight.lines.begin(), highlight.lines.end());
  marks_.faces.insert(marks_.faces.end(), highlight.faces.begin(), highlight.faces.end());
  call_legend_.push_back({colour, std::move(text)});
}

void Document::mark_call() {
  marks_ = {};
  near_.clear();
  call_legend_.clear();
  call_names_.clear();
  caller_edge_.reset();
  isolated_.settings.reset();
  const CallStudy* study = debugger_->study();
  if (study == nullptr) {
    if (debugger_->visit()) return mark_visit();
    return name_all();
  }
  near_ = tets_of(mesh_, *study);
  mark_caller(*study);
  name_call(*study);
  if (near_.empty() && caller_edge_) {  // the target is gone, and nothing was done
    near_ = shell_of_caller();
  }
  if (!study->picture) return;
  const PolygonView polygon = debugger_->polygon();
  mark(highlight_cell(*study, polygon, ball_.centre), kCellColour, "pocket of the cell");
  if (polygon.covering == nullptr) return;
  const bool is_found = polygon.stage == PolygonStage::found;
  const char* tense = is_found ? "found" : study->undone ? "tried" : "made";
  const bool is_edge_made = polygon.covering->triangles.empty();
  mark(highlight_covering(*study, polygon, ball_.centre),
       is_edge_made ? kSkirtColour : kChordColour,
       is_edge_made ? fmt::format("ring of the edge {}", tense)
                    : fmt::format("chord of the covering, {}", tense));
  if (!is_edge_made && !polygon.covering->core.empty()) {
    call_legend_.push_back({kCoreColour, "side of the core: there the edge stays"});
  }
}

/// The tet that the pass has turned to, with its neighbours.
void Document::mark_visit() {
  const auto* visited = std::get_if<TetHandle>(&target_);
  if (visited == nullptr) return;
  const TetVertices tet = mesh_.vertices(*visited);
  for (unsigned f = 0; f < 4; ++f) {
    std::array<VertexHandle, 3> face;
    for (unsigned k = 0; k < 3; ++k) face[k] = tet[(f + 1 + k) % 4];
    const auto around = debugger_->tets_around(face);
    near_.insert(near_.end(), around.begin(), around.end());
  }
  std::sort(near_.begin(), near_.end());
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
  for (const VertexHandle v : tet) add_name(call_names_, v, {});
  call_legend_.push_back({kSelectionColour, fmt::format("tet t that the pass turns to, visit {}",
                                                        *debugger_->visit())});
}

/// A lesson speaks of vertices by their numbers also before it comes to a call.
void Document::name_all() {
  constexpr std::size_t kMost = 40;
  if (!debugger_->lesson() || mesh_.vertex_count() > kMost) return;
  for (std::uint32_t i = 0; i < mesh_.vertex_slots(); ++i) {
    if (!mesh_.is_deleted(VertexHandle(i))) add_name(call_names_, VertexHandle(i), {});
  }
}

/// The shell that a recursive call is to make smaller, and the face that it is to remove.
void Document::mark_caller(const CallStudy& study) {
  const TraceFile& file = debugger_->file();
  const std::uint32_t caller = caller_of(file, study.call);
  if (caller == kNoCall) return;
  const Selection edge = target_of(caller);
  if (!std::holds_alternative<TetEdge>(edge)) return;
  caller_edge_ = std::get<TetEdge>(edge);
  const auto ends = file.calls()[caller].target();
  mark(highlight_caller(mesh_, *caller_edge_, ball_.centre), kGhostColour,
       fmt::format("shell of the caller, {} {}", ends[0].index(), ends[1].index()));
  const auto removal = removal_of(file, study.call);
  if (!removal || !removal->face) return;
  const auto& f = *removal->face;
  for (const TetHandle t : ring(mesh_, *caller_edge_).tets) {
    if (mesh_.local_index(t, f[2]) >= 4) continue;
    return mark(
        highlight_face(mesh_, f, ball_.centre), kFaceToRemoveColour,
        fmt::format("face f to remove, {} {} {}", f[0].index(), f[1].index(), f[2].index()));
  }
}

std::vector<TetHandle> Document::shell_of_caller() const {
  if (!caller_edge_) return {};
  return tets_of(mesh_, Selection(*caller_edge_));
}

void Document::name_call(const CallStudy& study) {
  const auto add = [&](VertexHandle v, std::string role = {}) {
    const bool is_there =
        v.index() < mesh_.vertex_slots() && !mesh_.is_deleted(v) && mesh_.tet_of(v).is_valid();
    if (is_there) add_name(call_names_, v, std::move(role));
  };
  if (study.picture && study.picture->ring.size() >= 3) {
    add(study.picture->a, "a");
    add(study.picture->b, "b");
    for (std::size_t i = 0; i < study.picture->ring.size(); ++i) {
      add(study.picture->ring[i], fmt::format("p{}", i + 1));
    }
  }
  const auto target = debugger_->file().calls()[study.call].target();
  if (target.size() == 1) add(target[0], "v");
  for (const auto* tets : {&study.before, &study.after}) {
    for (const LocalTet& tet : *tets) {
      for (const VertexHandle v : tet.vertices) add(v);
    }
  }
  if (!caller_edge_) return;
  for (const TetHandle t : ring(mesh_, *caller_edge_).tets) {
    for (const VertexHandle v : mesh_.vertices(t)) add(v);
  }
}

const Highlight& Document::highlighted() {
  if (highlight_) return *highlight_;
  highlight_ = highlight(mesh_, selection_, ball_.centre);
  highlight_->lines.insert(highlight_->lines.end(), marks_.lines.begin(), marks_.lines.end());
  highlight_->faces.insert(highlight_->faces.end(), marks_.faces.begin(), marks_.faces.end());
  return *highlight_;
}

unsigned Document::highlight_revision() {
  return highlight_revision_;
}

const std::vector<LegendEntry>& Document::legend() {
  legend_ = call_legend_;
  const auto is_told = [&](const LegendEntry& entry) {
    return std::any_of(legend_.begin(), legend_.end(),
                       [&](const LegendEntry& told) { return told.colour == entry.colour; });
  };
  for (LegendEntry& entry :
       legend_of(mesh_, selection_, debugger_ != nullptr && selection_ == target_)) {
    if (!is_told(entry)) legend_.push_back(std::move(entry));  // t of a visit is selected, too
  }
  if (scene().bad_shown > 0) legend_.push_back({kBadColour, "bad tets"});
  const bool is_of_call = debugger_ != nullptr && is_isolated_ && !near_.empty();
  if (is_of_call && view.scene.colour == "region") {
    legend_.push_back({region_colour(mesh_.label(near_.front())), state_of_tets(*debugger_)});
  }
  return legend_;
}

// --- names, and pointing -------------------------------------------------------------------------

void Document::update_names() {
  if (is_named_) return;
  is_named_ = true;
  names_.clear();
  named_edges_.clear();
  const bool is_of_call =
      debugger_ != nullptr &&
      (selection_ == target_ || std::holds_alternative<std::monostate>(selection_));
  for (const NamedVertex& name : is_of_call ? call_names_ : names_of(mesh_, selection_)) {
    add_name(names_, name.vertex, name.role);
  }
  const auto is_named = [&](VertexHandle v) {
    return std::any_of(names_.begin(), names_.end(),
                       [&](const NamedVertex& name) { return name.vertex == v; });
  };
  const std::vector<TetHandle> tets =
      is_of_call || names_.empty() ? near_ : tets_of(mesh_, selection_);
  for (const TetHandle t : tets) {
    const TetVertices& v = mesh_.vertices(t);
    for (const auto& e : kEdgeVertices) {
      if (is_named(v[e[0]]) && is_named(v[e[1]])) named_edges_.push_back({v[e[0]], v[e[1]]});
    }
  }
}

const std::vector<NamedVertex>& Document::names() {
  update_names();
  return names_;
}

Pointed Document::pointed_call(std::uint32_t call) const {
  const auto target = debugger_->file().calls()[call].target();
  return {{target.begin(), target.end()}, call};
}

Pointed Document::pointed_selection(const Selection& selection) const {
  if (const auto* t = std::get_if<TetHandle>(&selection)) {
    const TetVertices& v = mesh_.vertices(*t);
    return {{v.begin(), v.end()}};
  }
  if (const auto* e = std::get_if<TetEdge>(&selection)) {
    const auto ends = mesh_.vertices(*e);
    return {{ends[0], ends[1]}};
  }
  if (const auto* f = std::get_if<HalfFace>(&selection)) {
    const auto corners = mesh_.vertices(*f);
    return {{corners.begin(), corners.end()}};
  }
  if (const auto* v = std::get_if<VertexHandle>(&selection)) return {{*v}};
  return {};
}

Selection Document::selection_of(std::span<const VertexHandle> vertices) const {
  const auto is_there = [&](VertexHandle v) {
    return v.index() < mesh_.vertex_slots() && !mesh_.is_deleted(v) && mesh_.tet_of(v).is_valid();
  };
  if (vertices.empty() || !std::all_of(vertices.begin(), vertices.end(), is_there)) return {};
  if (vertices.size() == 1) return vertices[0];
  for (std::size_t i = 1; i < vertices.size(); ++i) {  // a vertex twice names nothing
    const auto before = vertices.first(i);
    if (std::find(before.begin(), before.end(), vertices[i]) != before.end()) return {};
  }
  for (const TetHandle t : tets_of(mesh_, Selection(vertices[0]))) {
    const bool has_all = std::all_of(vertices.begin(), vertices.end(),
                                     [&](VertexHandle v) { return mesh_.local_index(t, v) < 4; });
    if (!has_all) continue;
    if (vertices.size() == 2) return *edge_in(mesh_, t, vertices[0], vertices[1]);
    for (unsigned f = 0; f < 4 && vertices.size() == 3; ++f) {
      const VertexHandle apex = mesh_.vertices(t)[f];
      if (std::find(vertices.begin(), vertices.end(), apex) == vertices.end()) {
        return HalfFace(t, f);
      }
    }
    return t;
  }
  return {};
}

Pointed Document::find_named(double x, double y, double reach) {
  update_names();
  const glm::dvec2 mouse = to_canvas(x, y);
  const auto pixel_of = [&](VertexHandle v) {
    return view.camera.project(to_glm(mesh_.point(v)), canvas);
  };
  Pointed found;
  double nearest = reach;
  for (const NamedVertex& name : names_) {
    const auto at = pixel_of(name.vertex);
    if (!at || glm::distance(*at, mouse) >= nearest) continue;
    nearest = glm::distance(*at, mouse);
    found.vertices = {name.vertex};
  }
  if (!found.is_nothing()) return found;
  nearest = reach / 2;
  for (const auto& edge : named_edges_) {
    const auto from = pixel_of(edge[0]);
    const auto to = pixel_of(edge[1]);
    if (!from || !to) continue;
    const double away = distance_to_segment(mouse, *from, *to);
    if (away >= nearest) continue;
    nearest = away;
    found.vertices = {edge[0], edge[1]};
  }
  return found;
}

}  // namespace tetmend::viewer
