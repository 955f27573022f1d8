// SPDX-License-Identifier: MIT
// The state of the viewer without a window: the mesh, what is shown of it, and what follows from
// both.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/statistics_cache.h"
#include "kernel/tet_mesh.h"
#include "viewer/debugger/debugger.h"
#include "viewer/live/live_run.h"
#include "viewer/live/trial.h"
#include "viewer/mesh/bad_places.h"
#include "viewer/mesh/measured_mesh.h"
#include "viewer/mesh/reference_surface.h"
#include "viewer/mesh/scene.h"
#include "viewer/mesh/selection.h"
#include "viewer/mesh/tet_lists.h"
#include "viewer/mesh/view_history.h"
#include "viewer/mesh/view_settings.h"
#include "viewer/opened_file.h"

namespace tetmend::viewer {

/// What the status line says.
struct Message {
  std::string text;
  bool is_error = false;
  bool is_to_be_seen = false;  ///< not in the status line alone
};

class Document;

/// What was done, perhaps by accident, and how it is taken back.
struct Offer {
  std::string text;
  std::string button;  ///< what its button says
  std::function<void(Document&)> take_back;
};

/// What the window is to ask the user for a file for.
enum class FileQuestion : std::uint8_t { none, open, save, schedule, reference, other_run };

/// What the user points at in one of the views; the others light it up.
struct Pointed {
  std::vector<VertexHandle> vertices;  ///< one, an edge, a face or a tet
  std::uint32_t call = kNoCall;        ///< of a trace; then the vertices are its target
  bool is_nothing() const { return vertices.empty() && call == kNoCall; }
  /// All of them are pointed at, and there is one.
  bool contains(std::span<const VertexHandle> all) const;
  friend bool operator==(const Pointed&, const Pointed&) = default;
};

/// A command of the window that waits: work would be lost.
struct WaitingCommand {
  std::string name;
  std::string argument;    ///< a file; empty: none
  bool is_saving = false;  ///< the user has chosen to save first
};

/// A colour of the picture and what it means.
struct LegendEntry {
  Colour colour;
  std::string text;
};

/// Change `view`, `canvas` and the like freely; all that follows from them is computed when it is
/// asked for, and kept until something it depends on has changed.
class Document {
 public:
  Document();
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  ViewSettings view;
  Canvas window;                ///< the whole picture, panels included
  Canvas canvas;                ///< the part of it that shows the mesh
  glm::ivec2 canvas_corner{0};  ///< upper left, in pixels of the window
  PickKind pick_kind = PickKind::nearest;
  Message message;
  std::optional<Offer> offer;  ///< a window shows it until the next act
  /// The user does something else: an error was seen, and an offer not wanted.
  void begin_act();
  bool show_keys = false;   ///< the page of F1
  bool show_panels = true;  ///< beside the picture
  FileQuestion question = FileQuestion::none;
  bool offer_choices = false;  ///< a menu of what can be done with the selection
  bool ask_place = false;      ///< the user wants to say where to go
  bool tells_pick = false;     ///< something was picked, and its panel is to say what
  bool quit = false;
  std::optional<WaitingCommand> waiting;  ///< for the user to save, or to let go
  std::vector<std::string> recent;        ///< files that were opened, the last first
  /// Of a trace, for a lecture hall: large text, the picture, the text of the lesson, the shell and
  /// the algorithm, and no more. On when a lesson is opened.
  bool teaching = false;

  /// The mesh takes the whole window.
  void resize(const Canvas& size);
  /// Pixel of the window to pixel of the canvas.
  glm::dvec2 to_canvas(double x, double y) const {
    return {x - canvas_corner.x, y - canvas_corner.y};
  }

  /// Reads a mesh, or opens a trace and shows the mesh at its beginning; ends a run of the old
  /// mesh. The view stays if the new mesh is about as large and in the same place as the old one;
  /// otherwise the camera goes home. @throws Error, and nothing changes.
  void open(const std::filesystem::path& file);
  /// The same, of a file that is read.
  void show(OpenedFile opened);
  /// A window reads in the background and shows a bar meanwhile; others read in open() itself.
  bool opens_in_background = false;
  /// open() as this asks. While a file is read no other can be.
  void begin_to_open(const std::filesystem::path& file);
  /// The file that is being read, or null.
  const Opening* opening() const { return opening_.get(); }
  /// Shows it once it is read, after so many seconds at most. @throws Error as open()
  void follow_opening(double seconds);
  /// By which read_file() is to judge.
  const Standard& standard() const { return standard_; }
  /// Takes over a mesh that is called `name`. A trace that is open is closed.
  void set_mesh(TetMesh mesh, const std::string& name);
  void set_mesh(MeasuredMesh mesh, const std::string& name);
  /// Writes what is shown. The file appears only when it is complete. @throws Error as
  /// write_mesh().
  void save(const std::filesystem::path& file);

  /// The trace that is open, or null. After a move in it call show_trace().
  Debugger* debugger() { return debugger_.get(); }
  const Debugger* debugger() const { return debugger_.get(); }
  /// Makes the document show the place at which the debugger is.
  void show_trace();
  /// The camera goes to each outermost call, and to each isolated one that it does not see.
  bool follow_trace = true;

  /// Tries an operator at a place of the mesh that is shown, and shows the attempt as a call of the
  /// debugger. A trial that was looked at is undone first. @throws Error as Trial, and nothing
  /// changes; also while a run is at work that is not paused.
  void try_operator(const TrialRequest& request);
  /// The one that is shown, or null.
  const Trial* trial() const { return trial_.get(); }
  /// The mesh becomes what the attempt has made of it, with its holes closed; what was open is left.
  /// @throws Error when it was refused, when there is none, and while a run is paused.
  void keep_trial();
  /// Shows again what was shown before, bit for bit. @throws Error when there is no trial.
  void undo_trial();

  /// What is shown has not been written to a file: kept trials, what a run has made; or a run is
  /// at work.
  bool has_unsaved() const { return is_changed_ || live.is_active(); }
  /// "part.mesh - tetmend-view", with a mark where something is unsaved.
  std::string title() const;

  /// Reads a mesh for its statistics only: the state before. @throws Error, and nothing changes.
  void compare_with(const std::filesystem::path& file);

  /// The goal from now on: of the mesh that is shown, of files opened later, and of live runs. At
  /// first the default; that of a trace when one is opened. Cost: a few passes over the mesh.
  /// @throws Error for a goal that is none, and while a trace is open.
  void set_goal(const Goal& goal);

  LiveRun live;
  bool follow_changes_live = true;  ///< the camera goes to each change that a run stops at
  /// Begins a run over the mesh. Its statistics become those of the state before.
  /// @throws Error as LiveRun::start().
  void run_live(LiveRun::From from);
  /// Shows the last calls of a run that is paused, or over, in the debugger, at their end. Once the
  /// run goes on, its mesh is shown again. Cost: plays them three times.
  /// @throws Error as LiveRun::last_calls(), and where there was no call.
  void debug_live();
  /// The trace that is open is that of debug_live().
  bool debugs_live() const { return debugger_ != nullptr && debugs_live_; }
  /// A pause shows the calls by itself, unless the mesh is so large that each would take seconds.
  bool debugs_pauses = false;
  /// Shows the latest mesh of the run, and says so when it has paused or ended. To be called now
  /// and then.
  void follow_live();
  /// There may be something new for follow_live() soon.
  bool awaits_live() const;

  /// Compares the surface with that of another mesh, from now on. @throws Error, and nothing changes.
  void set_reference(const std::filesystem::path& file, const Allowance& allowance);
  /// Of a trace, what it began with is compared with again.
  void forget_reference();
  /// What the surface is compared with: that of a file, else the one that the trace began with; or
  /// null.
  ReferenceSurface* reference() const {
    return given_reference_ != nullptr ? given_reference_.get() : trace_reference_.get();
  }
  /// How far the whole surface has gone. Precondition: there is a reference. Cost: a pass over the
  /// tets when the mesh has changed.
  const SurfaceDeparture& departure();
  /// Ends of the colours by distance, as files have lengths.
  Range distance_range() const;

  bool has_mesh() const { return mesh_.tet_count() > 0; }
  const TetMesh& mesh() const { return mesh_; }
  const std::string& file() const { return file_; }
  const Ball& ball() const { return ball_; }  ///< encloses the mesh
  /// Cost, while a trace is open: that of what changed since the last question.
  const MeshStatistics& statistics() const;
  const std::optional<MeshStatistics>& statistics_before() const { return before_; }
  const std::vector<Label>& regions() const { return regions_; }
  /// What reading the file has put right, in sentences: "the mesh was mirrored: ...".
  const std::vector<std::string>& notes() const { return notes_; }

  /// Views for undo. What is shown now is kept, unless it is kept already.
  void keep_view() { history_.keep(view); }
  /// False if there is none.
  bool undo_view();
  bool redo_view();

  /// What is pointed at: by the mouse, else by a script. A move in a trace forgets it.
  const Pointed& pointed() const { return hovered.is_nothing() ? pointed_ : hovered; }
  void point_at(Pointed what) { pointed_ = std::move(what); }
  /// A call of the trace, by its target. Precondition: there is such a call.
  Pointed pointed_call(std::uint32_t call) const;
  /// What is selected, by its vertices.
  Pointed pointed_selection(const Selection& selection) const;
  /// What has these vertices: a vertex, an edge, a face, a tet. Nothing if the mesh has it not.
  Selection selection_of(std::span<const VertexHandle> vertices) const;
  Pointed hovered;   ///< by the mouse, in the last layout
  Pointed hovering;  ///< likewise, in the one that is being made

  /// The vertices whose numbers stand in the picture: those of the call at hand and of the shell of
  /// its caller, or of the selection.
  const std::vector<NamedVertex>& names();
  /// The named vertex, or the edge between two of them, at a pixel of the window; or nothing.
  /// `reach`: in pixels.
  Pointed find_named(double x, double y, double reach);
  /// What the colours of the highlight mean.
  const std::vector<LegendEntry>& legend();
  /// What the call at hand is to make smaller, and the picture shows as a ghost.
  std::vector<TetHandle> shell_of_caller() const;

  const Selection& selection() const { return selection_; }
  /// Precondition: it names something in the mesh.
  void select(const Selection& selection);
  /// What lies under a pixel of the window, or nothing. A bad tet that is seen through the rest
  /// comes first; the next pick there takes what is in front of it.
  void pick(double x, double y);
  /// The whole mesh from the home direction.
  void go_home();
  /// What is to be seen first: the call at hand, or the whole mesh.
  void fit_first();
  /// The selection or the call at hand fills the picture, or the whole mesh without either.
  void fit();

  /// Of the measure of the view, by slot.
  std::span<const float> values() { return lists_.values(mesh_, view.scene.measure); }
  const Histogram& histogram();
  /// The worst by that measure.
  static constexpr std::size_t kWorstListed = TetLists::kWorstListed;
  const std::vector<TetHandle>& worst();
  /// Selects it and moves the camera there. Precondition: it names something in the mesh.
  void fly_to(const Selection& selection);
  /// Selects entry i of worst(), shows it alone, and moves the camera to where it is seen best.
  void fly_to_worst(std::size_t i);
  /// Shows the whole mesh again, from where it was seen before fly_to_worst(). In a trace the camera
  /// follows the calls, and what is alone stays so.
  void end_alone();
  /// Shows the rest, or hides all but the call at hand or what is selected. That is brought into
  /// sight, and the rest is a ghost around what is selected.
  void toggle_isolation();
  void forget_camera_before_alone() { camera_before_alone_.reset(); }
  std::optional<std::size_t> place_among_worst();  ///< of the selected tet
  /// Where bad tets are many, the places with most of them first.
  static constexpr std::size_t kPlacesListed = 30;
  const std::vector<BadPlace>& bad_places();
  /// Shows entry i of bad_places() from near by, and selects its worst tet. Precondition: there is
  /// such an entry.
  void fly_to_place(std::size_t i);

  const Scene& scene();
  /// What scene() gave last shows the tets of a call only.
  bool is_isolated() const { return is_isolated_; }
  /// The whole mesh, to be drawn faintly behind what a filter, a hidden region or isolation leaves of
  /// it. Null: nothing is hidden so, the view wants none, or ghosts show it already.
  const Scene* outline();
  const Highlight& highlighted();
  /// Change when scene() or highlighted() would return something else.
  unsigned scene_revision();
  unsigned highlight_revision();

 private:
  /// What a trial puts aside, to be shown again.
  struct Shown;
  std::unique_ptr<Shown> put_aside();
  void show_again(Shown& shown, const std::vector<TetHandle>& others);
  enum class Shows : bool { trace, trial };
  /// `others`: the only slots in which the mesh differs from the one shown; null: it is another.
  void show_debugger(std::unique_ptr<Debugger> debugger, MeasuredMesh mesh,
                     Shows what = Shows::trace, const std::vector<TetHandle>* others = nullptr);
  void replace_mesh(MeasuredMesh mesh, const std::string& name,
                    const std::vector<TetHandle>* others);
  std::shared_ptr<const MeshData> data_shown() const;
  void remember(const std::filesystem::path& file);
  void forget_derived();
  void follow_changes(std::span<const TetHandle> changed);
  std::vector<TetHandle> other_layers();
  std::optional<Ball> call_in_view();
  void mark_live_call(const LiveProgress& run);
  bool show_pause(const LiveProgress& run);
  Selection target_of(std::uint32_t call);
  Selection tet_visited();
  void mark_call();
  void mark_visit();
  void name_all();
  void mark_caller(const CallStudy& study);
  void mark(const Highlight& highlight, const Colour& colour, std::string text);
  void name_call(const CallStudy& study);
  void follow_call();
  void isolate_selection();
  void show_rest();
  bool is_seen(const Ball& ball) const;
  std::vector<TetHandle> isolated() const;
  void update_names();
  void update_scene();
  void draw_anew();
  void colour_by(const SceneSettings& settings, bool anew, SceneInput& input);

  std::unique_ptr<Opening> opening_;
  TetMesh mesh_;
  Standard standard_ = Standard(Goal{});
  std::string file_;
  std::string not_saved_;                 // what the file holds beside its mesh
  std::shared_ptr<const MeshData> data_;  // of the file, while that is shown; see LiveRun::Input
  std::vector<std::string> notes_;
  Ball ball_;
  std::array<glm::dvec3, 8> box_{};  // corners of the box around the mesh
  MeshStatistics statistics_;
  std::optional<MeshStatistics> before_;
  std::unique_ptr<ReferenceSurface> given_reference_, trace_reference_;
  std::optional<SurfaceDeparture> departure_;  // of the mesh as it is
  std::vector<Label> regions_;
  Selection selection_;
  bool is_alone_ = false;    // the selection was isolated, not only picked
  bool is_changed_ = false;  // the mesh is in no file
  std::optional<Camera> camera_before_alone_;
  /// Where the last pick took a bad tet behind the surface.
  struct Place {
    glm::dvec2 pixel{0};
    Camera camera;
  };
  std::optional<Place> picked_through_;
  LiveState followed_ = LiveState::idle;  // what the user was told
  std::size_t followed_call_ = 0;         // of a run: whose place is marked
  bool debugs_live_ = false;
  std::optional<Camera> camera_before_run_;
  Camera camera_of_run_;  // as the last call or pause of it has put it
  bool is_at_calls_ =
      false;  // pauses of it were debugged, which moves the camera from call to call

  std::unique_ptr<Shown> aside_;  // of the trial
  std::unique_ptr<Trial> trial_;
  std::unique_ptr<Debugger> debugger_;
  std::size_t shown_mesh_ = 0;          // see Debugger::mesh_number()
  std::uint32_t shown_root_ = kNoCall;  // outermost call that the camera went to
  std::uint32_t shown_call_ = kNoCall;  // and the innermost
  Selection target_;                    // of the call at hand
  std::optional<TetEdge> caller_edge_;  // of the recursion around it
  Highlight marks_;                     // of the call at hand
  std::vector<LegendEntry> call_legend_;
  std::vector<NamedVertex> call_names_;
  std::vector<TetHandle> near_;  // tets of that call or at the tet visited, ascending; may be empty

  mutable StatisticsCache trace_statistics_;  // of the mesh, while a trace is open
  TetLists lists_;
  std::optional<std::vector<BadPlace>> bad_places_;  // of the mesh as it is, and this bound:
  double places_below_ = 0;
  std::vector<std::uint32_t> layers_;  // empty until something is peeled
  /// A scene and what it was made of.
  struct Drawing {
    SceneKeeper keeper;
    std::optional<SceneSettings> settings;  // nothing: to be made anew
    std::vector<TetHandle> changed;         // tets, since
  };
  Drawing whole_, isolated_, outline_;
  bool is_isolated_ = false;  // which of them is seen
  std::optional<Highlight> highlight_;
  std::vector<LegendEntry> legend_;
  bool is_named_ = false;  // the next two are up to date
  std::vector<NamedVertex> names_;
  std::vector<std::array<VertexHandle, 2>> named_edges_;
  ViewHistory history_;
  Pointed pointed_;
  unsigned scene_revision_ = 0;
  unsigned highlight_revision_ = 0;
};

}  // namespace tetmend::viewer
