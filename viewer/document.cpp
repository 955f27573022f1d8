// SPDX-License-Identifier: MIT
#include "viewer/document.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/tet_mesh_io.h"
#include "kernel/grouped.h"
#include "viewer/debugger/call_highlight.h"
#include "viewer/debugger/recorded_allowance.h"
#include "viewer/debugger/tets_drawing.h"
#include "viewer/live/carried_data.h"
#include "viewer/mesh/tet_values.h"

namespace tetmend::viewer {

namespace {

bool is_alike(const Ball& a, const Ball& b) {
  constexpr double kShare = 0.02;
  return glm::distance(a.centre, b.centre) <= kShare * a.radius &&
         std::abs(a.radius - b.radius) <= kShare * a.radius;
}

Message message_of(const LiveProgress& run, const std::string& schedule) {
  switch (run.state) {
    case LiveState::failed:
      return {run.error, true};
    case LiveState::paused: {
      const bool is_in_call = run.last && (run.last->is_inside || run.last->is_under_way);
      if (!is_in_call && run.attempts == 0) return {"paused before the first call", false};
      const std::string place =
          is_in_call ? fmt::format("in call {}", run.last->number)
                     : fmt::format("after {} call{}", run.attempts, run.attempts == 1 ? "" : "s");
      return {fmt::format("{} in {}, {}{}", run.breakpoint.empty() ? "paused" : "breakpoint",
                          run.phase, place, run.breakpoint.empty() ? "" : ": " + run.breakpoint),
              false};
    }
    default:
      return {fmt::format("{}: {}, {:.1f} s", schedule, to_string(run.state), run.seconds), false};
  }
}

/// "edge that call 2 aimed at, accepted".
std::string aim_in_words(const LiveCall& call) {
  constexpr std::array<const char*, 4> kKinds = {"vertex", "edge", "face", "tet"};
  const std::size_t size = std::clamp<std::size_t>(call.target.size(), 1, kKinds.size());
  return fmt::format("{} that call {} aimed at, {}", kKinds[size - 1], call.number,
                     call.is_under_way ? "under way" : to_string(call.verdict));
}

}  // namespace

struct Document::Shown {
  MeasuredMesh mesh;
  std::string file, not_saved;
  std::shared_ptr<const MeshData> data;
  std::vector<std::string> notes;
  std::unique_ptr<Debugger> debugger;
  std::unique_ptr<ReferenceSurface> trace_reference;
  Standard standard = Standard(Goal{});
  ViewSettings view;
  std::vector<VertexHandle> selected;
  bool teaching = false;
  bool is_changed = false;
  bool debugs_live = false;
};

void Document::begin_act() {
  if (message.is_error) message = {};
  offer.reset();
}

void Document::resize(const Canvas& size) {
  window = size;
  canvas = size;
  canvas_corner = {0, 0};
}

void Document::remember(const std::filesystem::path& file) {
  constexpr std::size_t kMost = 10;
  const std::string name = std::filesystem::absolute(file).lexically_normal().string();
  std::erase(recent, name);
  recent.insert(recent.begin(), name);
  if (recent.size() > kMost) recent.resize(kMost);
}

void Document::open(const std::filesystem::path& file) {
  show(read_file(file, standard_));
}

void Document::begin_to_open(const std::filesystem::path& file) {
  if (!opens_in_background) return open(file);
  if (opening_ != nullptr) throw Error("open: " + opening_->file().string() + " is being read");
  opening_ = std::make_unique<Opening>(file, standard_);
  constexpr double kNotWorthABar = 0.2;  // seconds
  follow_opening(kNotWorthABar);
}

void Document::follow_opening(double seconds) {
  if (opening_ == nullptr || !opening_->wait(seconds)) return;
  const auto opening = std::move(opening_);
  show(opening->take());
}

void Document::show(OpenedFile opened) {
  live.forget();
  followed_ = LiveState::idle;
  if (opened.debugger != nullptr) {
    const std::string damage = opened.debugger->file().damage();
    file_ = opened.file.string();
    show_debugger(std::move(opened.debugger), std::move(opened.mesh));
    message = {
        damage.empty()
            ? fmt::format("{}: {} events, {} calls", opened.file.filename().string(),
                          grouped(debugger_->end()), grouped(debugger_->file().calls().size()))
            : damage,
        !damage.empty()};
  } else {
    set_mesh(std::move(opened.mesh), opened.file.string());
    not_saved_ = std::move(opened.beside);
    data_ = std::move(opened.data);
    notes_ = std::move(opened.notes);
    if (!opened.remark.empty()) message.text += "; " + opened.remark;
  }
  is_changed_ = false;
  remember(opened.file);
}

/// In place of what is shown, under its name.
void Document::show_debugger(std::unique_ptr<Debugger> debugger, MeasuredMesh mesh, Shows what,
                             const std::vector<TetHandle>* others) {
  // At first: else nothing of a call inside is seen.
  const bool isolate = debugger_ == nullptr || view.scene.isolate;
  replace_mesh(std::move(mesh), std::string(file_), others);
  debugger_ = std::move(debugger);
  view.scene.isolate = isolate;
  teaching = debugger_->lesson().has_value();
  standard_ = debugger_->file().initial_mesh().standard();
  const bool is_compared = view.scene.colour == kDistance || view.scene.reference > 0;
  if (what == Shows::trace || is_compared) {
    trace_reference_ = std::make_unique<ReferenceSurface>(
        mesh_, recorded_allowance(debugger_->file().header()), "the beginning of the trace");
  }
  shown_mesh_ = debugger_->mesh_number();
  shown_root_ = shown_call_ = kNoCall;
  show_trace();
}

void Document::save(const std::filesystem::path& file) {
  // What is written is what one goes on with.
  if (trial_ != nullptr && aside_->debugger == nullptr && !live.is_active()) {
    if (trial_->is_accepted()) {
      keep_trial();
    } else {
      undo_trial();
    }
  }
  const std::shared_ptr<const MeshData> whole = data_shown();
  std::string lost;
  if (whole != nullptr) {
    write_mesh(file, *whole);
    for (const std::string& sentence : not_written(file, *whole)) lost += "; " + sentence;
  } else {
    write_mesh(file, MeshView(mesh_));
    if (!not_saved_.empty()) lost = ", without " + not_saved_;
  }
  if (trial_ == nullptr) is_changed_ = false;
  message = {fmt::format("wrote {}{}", file.string(), lost), !lost.empty()};
}

/// What is shown, with all that its file holds besides. Null: there is nothing besides, or what is
/// shown is an earlier place of a trace.
std::shared_ptr<const MeshData> Document::data_shown() const {
  const bool is_run = live.is_active() && live.input()->data != nullptr;
  if (!is_run) return debugger_ == nullptr ? data_ : nullptr;
  if (live.state() != LiveState::paused) {
    throw Error(
        "save: the run is at work; pause it first, so that what the file holds besides its "
        "mesh comes along");
  }
  const bool is_now = debugger_ == nullptr || (debugs_live_ && trial_ == nullptr &&
                                               debugger_->position() == debugger_->end());
  return is_now ? live.whole_data() : nullptr;
}

void Document::set_mesh(TetMesh mesh, const std::string& name) {
  set_mesh(MeasuredMesh(std::move(mesh)), name);
}

void Document::set_mesh(MeasuredMesh mesh, const std::string& name) {
  replace_mesh(std::move(mesh), name, nullptr);
}

/// What is known of tets of all other slots stays.
void Document::replace_mesh(MeasuredMesh mesh, const std::string& name,
                            const std::vector<TetHandle>* others) {
  const std::vector<TetHandle> changed = others != nullptr ? *others : std::vector<TetHandle>();
  if (debugger_ != nullptr) view.scene.isolate = false;  // it is for the calls of a trace
  debugger_.reset();
  debugs_live_ = false;
  trial_.reset();
  aside_.reset();
  trace_reference_.reset();
  if (given_reference_ != nullptr) given_reference_->forget();  // the colours end elsewhere now
  target_ = {};
  caller_edge_.reset();
  call_legend_.clear();
  call_names_.clear();
  pointed_ = {};
  hovered = {};
  teaching = false;
  not_saved_.clear();
  data_.reset();
  notes_.clear();
  marks_ = {};
  near_.clear();
  const bool keep_view = has_mesh() && is_alike(ball_, mesh.ball);
  mesh_ = std::move(mesh.mesh);
  file_ = name;
  box_ = mesh.box;
  ball_ = mesh.ball;
  statistics_ = mesh.statistics;
  regions_ = std::move(mesh.regions);
  if (others != nullptr && view.scene.colour != kDistance) {
    follow_changes(changed);
  } else {
    forget_derived();
  }
  select({});
  camera_before_alone_.reset();
  if (!keep_view) go_home();
  message = {
      fmt::format("{}: {} tets, {} of them bad", std::filesystem::path(name).filename().string(),
                  grouped(statistics_.tets), grouped(statistics_.n_bad)),
      false};
}

/// After a change of the mesh.
void Document::forget_derived() {
  trace_statistics_.forget();
  lists_.forget();
  bad_places_.reset();
  layers_.clear();
  departure_.reset();
  draw_anew();
}

void Document::draw_anew() {
  for (Drawing* drawing : {&whole_, &isolated_, &outline_}) {
    drawing->settings.reset();
    drawing->changed.clear();
  }
}

/// After a change of these tets.
void Document::follow_changes(std::span<const TetHandle> changed) {
  departure_.reset();
  bad_places_.reset();
  for (const TetHandle t : changed) trace_statistics_.touch(t);
  lists_.update(mesh_, changed);
  const std::vector<TetHandle> deeper = other_layers();
  for (const auto& tets : {changed, std::span<const TetHandle>(deeper)}) {
    whole_.changed.insert(whole_.changed.end(), tets.begin(), tets.end());
  }
  outline_.changed.insert(outline_.changed.end(), changed.begin(), changed.end());
  // Long unseen; or faces that stay may now be nearest to other places of the reference.
  const bool is_far = view.scene.both_ways && view.scene.colour == kDistance;
  for (Drawing* drawing : {&whole_, &outline_}) {
    const bool is_anew = is_far && drawing == &whole_;
    if (!is_anew && drawing->changed.size() <= mesh_.tet_slots()) continue;
    drawing->settings.reset();
    drawing->changed.clear();
  }
  isolated_.settings.reset();
}

/// Brings the layers up to date and tells which are others.
std::vector<TetHandle> Document::other_layers() {
  std::vector<TetHandle> tets;
  if (layers_.empty()) return tets;
  const auto before = std::exchange(layers_, distances_from_boundary(mesh_));
  for (std::uint32_t i = 0; i < layers_.size(); ++i) {
    if (i >= before.size() || before[i] != layers_[i]) tets.emplace_back(i);
  }
  return tets;
}

const MeshStatistics& Document::statistics() const {
  if (debugger_ == nullptr) return statistics_;
  return trace_statistics_.statistics(mesh_, mesh_.standard().goal());
}

void Document::show_trace() {
  const std::uint32_t call = debugger_->call();
  if (debugger_->mesh_number() != shown_mesh_) {
    const MeshStep step = debugger_->follow(mesh_);
    shown_mesh_ = debugger_->mesh_number();
    if (step.anew) {
      forget_derived();
    } else {
      follow_changes(step.tets);
    }
  }
  pointed_ = {};
  hovered = {};
  target_ = call == kNoCall ? tet_visited() : target_of(call);
  mark_call();
  select(target_);
  follow_call();
}

/// The tet that a pass has turned to, if it is there.
Selection Document::tet_visited() {
  const auto visit = debugger_->visit();
  if (!visit) return {};
  const auto found = debugger_->tets_around(debugger_->file().visits()[*visit].tet);
  return found.empty() ? Selection() : Selection(found.front());
}

/// What a call aims at, in the mesh as it is.
Selection Document::target_of(std::uint32_t call) {
  const Call& c = debugger_->file().calls()[call];
  return target_in(mesh_, c, debugger_->tets_around(c.target()));
}

// --- the sandbox ---------------------------------------------------------------------------------

Document::Document() = default;
Document::~Document() = default;

std::unique_ptr<Document::Shown> Document::put_aside() {
  auto shown = std::make_unique<Shown>();
  shown->selected = pointed_selection(selection_).vertices;
  shown->mesh.mesh = std::move(mesh_);
  shown->mesh.box = box_;
  shown->mesh.ball = ball_;
  shown->mesh.statistics = statistics_;
  shown->mesh.regions = regions_;
  shown->file = file_;
  shown->not_saved = not_saved_;
  shown->data = data_;
  shown->notes = notes_;
  shown->debugger = std::move(debugger_);
  shown->trace_reference = std::move(trace_reference_);
  shown->standard = standard_;
  shown->view = view;
  shown->teaching = teaching;
  shown->is_changed = is_changed_;
  shown->debugs_live = debugs_live_;
  return shown;
}

void Document::show_again(Shown& shown, const std::vector<TetHandle>& others) {
  replace_mesh(std::move(shown.mesh), shown.file, &others);
  not_saved_ = std::move(shown.not_saved);
  data_ = std::move(shown.data);
  notes_ = std::move(shown.notes);
  standard_ = shown.standard;
  is_changed_ = shown.is_changed;
  teaching = shown.teaching;
  trace_reference_ = std::move(shown.trace_reference);
  debugger_ = std::move(shown.debugger);
  if (debugger_ != nullptr) {
    debugs_live_ = shown.debugs_live;
    shown_mesh_ = debugger_->mesh_number();
    show_trace();
  }
  view = shown.view;
  select(selection_of(shown.selected));
}

void Document::try_operator(const TrialRequest& request) {
  if (live.is_active() && live.state() != LiveState::paused) {
    throw Error("try_operator: a run is at work; pause or stop it first");
  }
  const TetMesh& mesh = aside_ != nullptr ? aside_->mesh.mesh : mesh_;
  auto trial = std::make_unique<Trial>(mesh, live.registry(), request, file_);
  std::vector<TetHandle> others = trial->changed();
  if (trial_ != nullptr) {
    others.insert(others.end(), trial_->changed().begin(), trial_->changed().end());
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
  }
  std::unique_ptr<Shown> aside = aside_ != nullptr ? std::move(aside_) : put_aside();
  const Camera camera = view.camera;
  auto debugger = trial->take_debugger();
  debugger->lend(aside->mesh.mesh);
  MeasuredMesh tried;
  tried.mesh = trial->take_mesh();
  tried.box = aside->mesh.box;
  tried.ball = aside->mesh.ball;
  tried.statistics = aside->mesh.statistics;
  tried.regions = aside->mesh.regions;
  try {
    show_debugger(std::move(debugger), std::move(tried), Shows::trial, &others);
  } catch (...) {
    show_again(*aside, others);
    throw;
  }
  view.camera = camera;
  aside_ = std::move(aside);
  trial_ = std::move(trial);
  if (call_in_view() && !is_seen(*call_in_view())) fit();
  message = {fmt::format("{}: {}; keep it, or undo it", request.operator_name, trial_->outcome()),
             false};
}

void Document::undo_trial() {
  if (trial_ == nullptr) throw Error("undo: no operator was tried");
  const std::string name = trial_->request().operator_name;
  const auto aside = std::move(aside_);
  const std::vector<TetHandle> others = trial_->changed();
  show_again(*aside, others);
  message = {fmt::format("{}: undone, the mesh is as it was", name), false};
}

void Document::keep_trial() {
  if (trial_ == nullptr) throw Error("keep: no operator was tried");
  if (!trial_->is_accepted())
    throw Error("keep: the operator was refused, there is nothing to keep");
  if (live.is_active())
    throw Error("keep: a run is paused, and has a mesh of its own; stop it first");
  const std::string name = trial_->request().operator_name;
  TetMesh result = aside_->mesh.mesh;
  trial_->make_on(result, live.registry());
  std::shared_ptr<const MeshData> data;
  if (aside_->data != nullptr) {
    data = std::make_shared<const MeshData>(carried_data(*aside_->data, result));
    MeshData copy = *data;
    result = TetMesh::build(copy, {.sorted = false});
  }
  result.set_standard(aside_->standard);
  result.collect_garbage();
  const auto aside = std::move(aside_);
  const Camera camera = view.camera;
  set_mesh(MeasuredMesh(std::move(result)), aside->file);
  live.forget();
  followed_ = LiveState::idle;
  not_saved_ = std::move(aside->not_saved);
  data_ = std::move(data);
  standard_ = aside->standard;
  view = aside->view;
  view.camera = camera;
  is_changed_ = true;
  message = {fmt::format("{}: kept; {} tets, {} of them bad, not saved yet", name,
                         grouped(statistics_.tets), grouped(statistics_.n_bad)),
             false};
}

std::string Document::title() const {
  if (!has_mesh()) return "tetmend-view";
  return fmt::format("{}{} - tetmend-view", has_unsaved() ? "* " : "",
                     std::filesystem::path(file_).filename().string());
}

void Document::compare_with(const std::filesystem::path& file) {
  before_ = compute_statistics(read_tet_mesh(file), mesh_.standard().goal());
}

void Document::set_reference(const std::filesystem::path& file, const Allowance& allowance) {
  given_reference_ =
      std::make_unique<ReferenceSurface>(read_tet_mesh(file), allowance, file.string());
  departure_.reset();
  draw_anew();
}

void Document::forget_reference() {
  given_reference_.reset();
  departure_.reset();
  draw_anew();
}

const SurfaceDeparture& Document::departure() {
  const bool both_ways = view.scene.both_ways;
  if (!departure_ || departure_->back.has_value() != both_ways) {
    departure_ = reference()->measure(mesh_, both_ways);
  }
  return *departure_;
}

Range Document::distance_range() const {
  const ReferenceSurface* shown = reference();
  if (shown == nullptr) return {};
  if (shown->allowance().length > 0) return {0, shown->allowance().length};
  const double largest = shown->largest_seen().distance;
  return {0, largest > 0 ? largest : 1};
}

void Document::set_goal(const Goal& goal) {
  if (debugger_ != nullptr) throw Error("goal: a trace has that of its run");
  if (!is_sound(goal)) {
    throw Error(
        fmt::format("goal: {} to {} degrees: the smallest angle is above 0 and at most 70 "
                    "degrees, the largest 71 to below 180",
                    goal.min_angle, goal.max_angle));
  }
  standard_ = Standard(goal);
  mesh_.set_standard(standard_);
  statistics_ = compute_statistics(mesh_, mesh_.standard().goal());
  forget_derived();
}

void Document::run_live(LiveRun::From from) {
  LiveRun::Input shown{mesh_, statistics(), data_};
  if (mesh_.standard() != standard_) {  // a schedule has set another goal
    shown.mesh.set_standard(standard_);
    shown.statistics = compute_statistics(shown.mesh, standard_.goal());
  }
  const MeshStatistics now = shown.statistics;
  live.start(std::move(shown), from, file_);
  followed_ = LiveState::idle;
  followed_call_ = 0;
  before_ = from == LiveRun::From::file ? live.input()->statistics : now;
  camera_before_run_ = camera_of_run_ = view.camera;
  is_at_calls_ = false;
}

void Document::debug_live() {
  const std::string calls = live.last_calls();
  if (calls.empty()) throw Error("live_debug: the run has made no call yet");
  auto debugger = std::make_unique<Debugger>("the run", calls);
  debugger->seek(debugger->end());
  MeasuredMesh mesh(debugger->mesh());
  std::string beside = not_saved_;
  const Standard standard = standard_;
  show_debugger(std::move(debugger), std::move(mesh));
  standard_ = standard;
  not_saved_ = std::move(beside);
  is_changed_ = live.is_active();
  debugs_live_ = true;
  message = {fmt::format("the last {} calls of the run", grouped(debugger_->file().calls().size())),
             false};
}

/// False: the pause is shown as the mesh alone.
bool Document::show_pause(const LiveProgress& run) {
  constexpr std::size_t kMost = 300000;  // tets: about a second
  if (!debugs_pauses || run.state != LiveState::paused || run.attempts == 0 ||
      mesh_.tet_count() > kMost) {
    return false;
  }
  try {
    debug_live();
  } catch (const Error&) {
    return false;  // it has no memory for that, or goes on already
  }
  is_at_calls_ = true;
  return true;
}

void Document::follow_live() {
  const LiveState now = live.state();  // before the last snapshot is taken, lest it be missed
  auto snapshot = live.take_snapshot();
  const LiveProgress run = live.progress();
  if (snapshot != nullptr && !show_pause(run)) {
    std::string beside = std::move(not_saved_);
    set_mesh(std::move(*snapshot), file_);
    is_changed_ = true;
    not_saved_ = std::move(beside);
    mark_live_call(run);
  }
  if (now == followed_ && (snapshot == nullptr || now != LiveState::paused)) return;
  const bool is_over = now == LiveState::finished || now == LiveState::stopped;
  if ((is_over || now == LiveState::failed) && debugger_ == nullptr) data_ = live.whole_data();
  // Back from the last hole, unless the user has gone elsewhere.
  if (is_over && camera_before_run_ && (is_at_calls_ || view.camera == camera_of_run_)) {
    view.camera = *camera_before_run_;
  }
  if (now == LiveState::paused) camera_of_run_ = view.camera;
  followed_ = now;
  message = message_of(run, live.schedule_name());
}

/// Shows where the last call was, and brings the camera there, while the run can be watched.
void Document::mark_live_call(const LiveProgress& run) {
  const bool is_watched = run.state == LiveState::paused || live.speed() > 0;
  const bool is_over = run.state != LiveState::paused && run.state != LiveState::running;
  const auto& call = run.state == LiveState::paused ? run.last : run.last_accepted;
  if (!is_watched || is_over || !call) return;
  marks_ = highlight_points(call->target, ball_.centre);
  call_legend_ = {{kSupportingEdgeColour, aim_in_words(*call)}};
  select({});
  const bool is_known = followed_call_ == call->number && !call->is_inside;
  if (!follow_changes_live || is_known) return;
  followed_call_ = call->number;
  constexpr double kSurroundings = 4;
  double radius = 0.02 * ball_.radius;  // of a vertex
  for (const Point& p : call->target) radius = std::max(radius, (p - call->place).norm());
  view.camera.fit({to_glm(call->place), kSurroundings * radius}, canvas);
  camera_of_run_ = view.camera;
}

bool Document::awaits_live() const {
  const LiveState now = live.state();
  return now == LiveState::running || now == LiveState::stopping || now != followed_;
}

void Document::select(const Selection& selection) {
  selection_ = selection;
  is_alone_ = false;
  picked_through_.reset();
  highlight_.reset();
  legend_.clear();
  is_named_ = false;
  isolated_.settings.reset();
  ++highlight_revision_;
}

void Document::pick(double x, double y) {
  constexpr double kSamePlace = 4;  // pixels
  const glm::dvec2 at = to_canvas(x, y);
  const Ray ray = view.camera.ray(at.x, at.y, canvas);
  const auto front = cast(scene(), ray);
  const auto bad = cast_through(scene(), ray);
  const bool is_behind = bad && (!front || bad->tet != front->tet);
  const bool is_again = picked_through_ && picked_through_->camera == view.camera &&
                        glm::distance(picked_through_->pixel, at) < kSamePlace;
  const bool is_through = is_behind && !(is_again && front);
  const auto& hit = is_through ? bad : front;
  select(hit ? refine(mesh_, *hit, pick_kind, view.camera, canvas) : Selection());
  if (is_through) picked_through_ = {at, view.camera};
  tells_pick = hit.has_value();
}

const Histogram& Document::histogram() {
  return lists_.histogram(mesh_, view.scene.measure);
}

const std::vector<TetHandle>& Document::worst() {
  return lists_.worst(mesh_, view.scene.measure);
}

const std::vector<BadPlace>& Document::bad_places() {
  const double below = view.scene.bad_below;
  if (!bad_places_ || places_below_ != below) {
    bad_places_ = viewer::bad_places(mesh_, below, kPlacesListed);
    places_below_ = below;
  }
  return *bad_places_;
}

std::optional<std::size_t> Document::place_among_worst() {
  const auto* tet = std::get_if<TetHandle>(&selection_);
  if (tet == nullptr) return std::nullopt;
  const auto found = std::find(worst().begin(), worst().end(), *tet);
  if (found == worst().end()) return std::nullopt;
  return static_cast<std::size_t>(found - worst().begin());
}

const Scene& Document::scene() {
  update_scene();
  return (is_isolated_ ? isolated_ : whole_).keeper.scene();
}

const Scene* Document::outline() {
  update_scene();
  const SceneSettings& scene = view.scene;
  const bool is_part = is_isolated_ || scene.filtered || !scene.hidden_regions.empty();
  if (!is_part || !scene.outline || scene.ghosts > 0) return nullptr;
  if (outline_.settings && outline_.changed.empty()) return &outline_.keeper.scene();
  SceneSettings all;
  all.bad = false;
  const SceneInput input{mesh_, all, {}, {}, {}, {}, ball_};
  if (outline_.settings) {
    outline_.keeper.update(input, outline_.changed);
  } else {
    outline_.keeper.build(input);
  }
  outline_.settings = all;
  outline_.changed.clear();
  return &outline_.keeper.scene();
}

unsigned Document::scene_revision() {
  update_scene();
  return scene_revision_;
}

/// Fills in what colours tets or faces.
void Document::colour_by(const SceneSettings& settings, bool anew, SceneInput& input) {
  input.reference = reference();
  if (settings.colour == kDistance) {
    if (input.reference != nullptr && anew) departure();
    input.colour_range = distance_range();
  } else if (settings.colour != "region") {
    input.colour_values = lists_.values(mesh_, settings.colour);
    input.colour_range = find_tet_value(settings.colour).range;
  }
}

void Document::update_scene() {
  const std::vector<TetHandle> only = isolated();
  const bool isolated = !only.empty();
  Drawing& drawing = isolated ? isolated_ : whole_;
  SceneSettings settings = view.scene;
  settings.isolate = false;  // does not matter for what is drawn of the whole mesh
  const bool is_other = isolated != is_isolated_;
  is_isolated_ = isolated;
  if (drawing.settings == settings && drawing.changed.empty()) {
    scene_revision_ += is_other ? 1 : 0;
    return;
  }
  if (settings.peel == 0) layers_.clear();
  if (settings.peel > 0 && layers_.empty()) layers_ = distances_from_boundary(mesh_);
  SceneInput input{mesh_, settings, {values(), layers_}, {}, {}, {}, ball_};
  if (isolated) input.only = only;
  const bool is_anew = drawing.settings != settings || isolated;
  colour_by(settings, is_anew, input);
  if (is_anew) {
    drawing.keeper.build(input);
  } else {
    drawing.keeper.update(input, drawing.changed);
  }
  if (settings.colour == kDistance && distance_range().high != input.colour_range.high) {
    // Something farther away has come: the colours of all mean other distances now.
    draw_anew();
    input.colour_range = distance_range();
    drawing.keeper.build(input);
  }
  drawing.settings = std::move(settings);
  drawing.changed.clear();
  ++scene_revision_;
}

}  // namespace tetmend::viewer
