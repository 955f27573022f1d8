// SPDX-License-Identifier: MIT
// The one verb of tetmend: a mesh goes in, a better one comes out, and its surface stays bit for
// bit, unless it is asked to move.
//
//   tetmend::Mesh mesh = tetmend::load("part.mesh");
//   tetmend::Result result = tetmend::improve(mesh, {.schedule = "thorough", .threads = 8});
//   tetmend::save("better.mesh", mesh);
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/curved.h>
#include <tetmend/goal.h>
#include <tetmend/io.h>
#include <tetmend/limit.h>
#include <tetmend/mesh.h>
#include <tetmend/rulers.h>
#include <tetmend/sizes.h>
#include <tetmend/statistics.h>
#include <tetmend/verdict.h>

namespace tetmend {

namespace kernel {
class Operators;  // <tetmend/operators.h>
}

/// What improve() is doing.
enum class Stage : std::uint8_t {
  building,   ///< adjacency, order along a space-filling curve
  measuring,  ///< statistics and checks, before and after
  improving   ///< the schedule runs
};

/// How far a run has come.
struct Progress {
  Stage stage = Stage::building;  ///< what is being done
  std::string_view phase;         ///< of Stage::improving: the name of the pass
  unsigned round = 0;             ///< of the schedule; 0 before its main loop
  double share = 0;               ///< of the phase that is done, 0 to 1
  QualityIndicators now;          ///< of the mesh after the pass before; not of Stage::building
};

/// What becomes of boundary layers: prisms in layers along walls, each cut into three tets.
enum class Layers : std::uint8_t {
  keep,    ///< their tets stay as they are, bit for bit
  improve  ///< like all other tets, which destroys them
};

/// An option has the name that it has on the command line (`--time-limit` is `time_limit`), and
/// means the same.
struct Options {
  std::string schedule = "shell";  ///< name, see schedules(), or a file that ends in .lua
  std::string script = {};         ///< text of a schedule, instead of `schedule`; empty: none
  std::vector<std::pair<std::string, std::string>> set = {};  ///< its parameters: {"goal", "20"}
  std::vector<std::filesystem::path> plugin = {};             ///< further operators
  /// Operators and measures of the program, see <tetmend/operators.h>: schedules and `measure` know them by
  /// their names. The run uses one thread then. They must outlive it. Null: none.
  const kernel::Operators* operators = nullptr;
  /// What the mesh is for: "explicit" time integration, an "implicit" solver, finite "volumes",
  /// "angles" alone, or empty: any solver. All but "angles" keep the stable step, no larger angle than
  /// was there where none missed the goal, and bound the number of tets unless `tets` does.
  std::string purpose = {};
  Goal goal = {};  ///< tets that miss it are bad
  /// What tets are judged by: "sine_and_length" sees needles as well, "sine" angles alone. Or a measure
  /// of `operators` or of a plugin.
  std::string measure = "sine_and_length";
  int threads = 1;  ///< 1 to 1024; the result is the same for every number
  /// Seconds; what is reached by then is the result. 0: none. Reading and measuring do not count.
  double time_limit = 0;

  // Regions are written "label:1,4" or "box:x0,y0,z0,x1,y1,z1" (tets with all vertices in the box).
  std::vector<std::string> protect = {};  ///< tets that stay as they are, bit for bit
  std::vector<std::string> only = {};     ///< if there are any: all other tets stay
  Layers layers = Layers::keep;           ///< they are found by their structure
  /// How far the surface may move, faces between two labels included: not at all ("fixed", or
  /// empty); as far as that changes no shape ("flat": in exactly plane parts and along exactly
  /// straight lines); by a share of the lengths of edges there ("1%"); by a length ("0.01", above 5 %
  /// of the diagonal "0.5!"). Only where the fixed surface leaves bad tets: see schedule "surface".
  std::string surface = {};
  /// Degrees by which faces bend along a line that the surface keeps.
  double feature_angle = 40;
  /// How far the mesh may grow: "10%" more tets than there were, or "500000" tets in all. A number
  /// below what is there is marked ("10!"), and none is added then. Empty: 15 % more at most, or what `purpose` says;
  /// with a script or a schedule other than shell and polish as far as it pays.
  std::string tets = {};
  /// No new edge is shorter than half or longer than twice what edges were at its midpoint: the mean
  /// of those at the nearest vertex.
  bool keep_size = false;
  /// How long edges are to be: "0.5"; "0.5x", half of what they are; "array:h", an array of the points;
  /// "h.sol" or "h.solb", a file of MEDIT with one length for each point; "coarse.vtu:h", an array of the
  /// points of another mesh; "h.lua", a script with a function size(x, y, z). Behind "label:1,4=" one of these for a
  /// region; regions without a size keep theirs. See adapt(). Empty: as long as it comes.
  std::vector<std::string> size = {};
  /// The same as a function of x, y and z, instead of `size`: lengths above 0, the same whenever it is
  /// asked; by several threads at once. Neither graded nor by region.
  std::function<double(double, double, double)> size_at = {};
  /// Wanted lengths grow by at most this less 1 times the distance, along edges. 0: as they like.
  double gradation = 1.3;
  double smallest = 0;  ///< no length is wanted below that; 0: any may be
  double largest = 0;   ///< nor above that; 0: any may be
  /// Arrays of real numbers of the tets whose integral stays: new tets get the mean of the old ones
  /// by the volume that they share. Others have the value of the old tet at their centroid.
  std::vector<std::string> conserve = {};
  bool ignore_interior = false;  ///< drop triangles, edges, required vertices inside a region
  /// Of second order: where tets stay turned over though edges within the volume are curved, nodes of
  /// the surface and of walls move to the middle of their edges.
  bool straighten = false;

  std::filesystem::path trace = {};  ///< record all that happens; the run uses one thread then
  /// Of a run in pieces, which piece is recorded: "ROUND" or "ROUND:PIECE". Rounds count from 1,
  /// divisions first, then zones; pieces from 0. Empty: of round 1 the piece around the middle of
  /// `trace_around`, or the one with the worst tet.
  std::string trace_piece = {};
  std::string trace_around = {};  ///< "TET", "TET,RADIUS" or "X,Y,Z,RADIUS"; empty: everywhere
  std::vector<std::string> trace_operator = {};  ///< attempts of these alone; empty: of all
  int trace_depth = -1;           ///< attempts with at most that many around them; negative: any
  std::uint64_t trace_limit = 0;  ///< bytes at which the trace ends; 0: none

  /// Hold each attempt of a plugin to the contract (docs/operators.md). The run uses one thread then,
  /// and may take hours: linear in the mesh for each attempt. The result is the same.
  bool check_operators = false;

  bool limit = false;  ///< prove what the surface allows; seconds for a large mesh
  /// Give Result::rulers_before and rulers_after; about 0.2 s for a million tets.
  bool rulers = true;
  bool maps = true;  ///< give Result::vertex_map and tet_map; 4 bytes for each entity
  /// Called often, by any thread, never by two at once; must be quick. False stops the run.
  std::function<bool(const Progress&)> progress = {};
  /// Called with what the schedule has to say, in between.
  std::function<void(std::string_view)> note = {};
  /// The run stops soon after this became true; a signal handler may set it. Null: none.
  const std::atomic<bool>* cancel = nullptr;
};

/// What one pass of the schedule did.
struct Pass {
  std::string name;                                   ///< the word of the schedule
  unsigned round = 0;                                 ///< of the schedule; 0 before its main loop
  double seconds = 0;                                 ///< by the clock
  std::array<std::size_t, kVerdictCount> verdicts{};  ///< number of attempts by Verdict
  std::size_t items = 0;                              ///< tets or vertices that were tried
  std::size_t deferred = 0;      ///< of them, those that two threads' parts of the mesh shared
  double seconds_in_scans = 0;   ///< over the whole mesh
  double seconds_in_blocks = 0;  ///< in the parts that threads divide among them, summed up
  QualityIndicators after;       ///< of the mesh when it ended

  /// Attempts with that verdict.
  std::size_t count(Verdict verdict) const { return verdicts[static_cast<std::size_t>(verdict)]; }
  /// Attempts with any verdict.
  std::size_t attempts() const {
    return std::accumulate(verdicts.begin(), verdicts.end(), std::size_t{0});
  }
  /// Attempts that changed the mesh.
  std::size_t accepted() const { return count(Verdict::accepted); }
};

/// Why a run ended.
enum class Ending : std::uint8_t {
  finished,    ///< the schedule came to its end
  time_limit,  ///< Options::time_limit
  cancelled    ///< Options::cancel, or Options::progress returned false
};

/// In maps from old to new: the vertex or tet is not there any more.
inline constexpr std::uint32_t kGone = 0xFFFFFFFF;

/// How the lengths of edges have changed: of the mean length at a vertex, after by before, over
/// vertices that stayed, 20,000 or so of them.
struct SizeDrift {
  double one_percent = 1;          ///< 1 % of the ratios are less
  double median = 1;               ///< half of them are
  double ninety_nine_percent = 1;  ///< 99 % of them are
};

/// How a named array came over to the improved mesh.
struct CarriedArray {
  std::string name;  ///< as in the file
  std::string on;    ///< "points" or "tets"
  std::string rule;  ///< in words
  /// |after - before| of its integral over the mesh by that of its absolute value, the largest of all
  /// components. Where values are missing (NaN) it is 0.
  double integral_error = 0;
};

/// What became of a surface that might move. The surface is the boundary and the faces between
/// labels. Lengths as in the file.
struct SurfaceChange {
  /// A region, by the label of its tets.
  struct Region {
    std::int32_t label = 0;    ///< of its tets
    double area_before = 0;    ///< of its faces of the surface
    double area_after = 0;     ///< likewise
    double volume_before = 0;  ///< of its tets
    double volume_after = 0;   ///< likewise
  };

  double tolerance = 0;  ///< the largest that was allowed anywhere; 0: only by rounding
  /// No point of the new surface is farther from the old one than that, and none of the old one
  /// farther from the new one: proven. At most the tolerance.
  double proven = 0;
  double sampled = 0;                ///< the largest of these distances that samples have found
  std::size_t triangles_before = 0;  ///< of the surface
  std::size_t triangles_after = 0;   ///< likewise
  std::size_t touched = 0;           ///< of these: new, or with a corner that moved
  std::vector<Region> regions;       ///< ascending labels
};

/// What improve() did.
struct Result {
  Goal goal;                                      ///< what the run worked towards
  bool holds_solver = false;                      ///< theta_max and the step of the input are held
  MeshStatistics before;                          ///< of the input
  MeshStatistics after;                           ///< of the improved mesh
  std::optional<MeshRulers> rulers_before;        ///< the measures of other programs
  std::optional<MeshRulers> rulers_after;         ///< likewise
  std::optional<SizeDrift> size_drift;            ///< with rulers
  std::optional<SizeStatistics> sizes_before;     ///< with Options::size or size_at
  std::optional<SizeStatistics> sizes_after;      ///< likewise
  std::optional<CurvedStatistics> curved_before;  ///< of a mesh of second order
  std::optional<CurvedStatistics> curved_after;   ///< likewise
  Ending ending = Ending::finished;               ///< why it ended
  std::vector<Pass> passes;                       ///< in the order in which they were made
  /// Of the schedule; what was kept or is stretched on purpose; what holds the bad tets left.
  std::vector<std::string> notes;
  std::vector<CarriedArray> carried;  ///< arrays of the points and tets of the mesh
  /// Why there is no trace, as "FILE: reason"; empty: it is whole, or nobody asked for one.
  std::string trace_trouble;
  BuildReport build;                   ///< what was peculiar about the mesh
  std::size_t protected_tets = 0;      ///< by `protect` and `only`
  std::size_t protected_bad_tets = 0;  ///< of them
  std::size_t layer_tets = 0;          ///< of boundary layers that were kept
  std::size_t layer_bad_tets = 0;      ///< of them
  std::size_t touched_tets = 0;       ///< of the new mesh: tets that are new or have a moved vertex
  std::optional<SurfaceLimit> limit;  ///< of the new mesh
  /// Edges within the volume that were curved, so that fewer tets of second order are turned over.
  std::size_t curved_edges = 0;
  std::size_t straightened_edges = 0;  ///< of the surface and of walls, see Options::straighten

  /// By the old number of a vertex: its new one, or kGone. A vertex that moved is still the same.
  /// Vertices that stay keep their order and come first; new ones follow.
  std::vector<std::uint32_t> vertex_map;
  /// By the old number of a tet: its new one, or kGone. A tet with the same four vertices is the
  /// same, though they may have moved. A tet that was replaced is gone, also when a later change
  /// brought its four vertices together again.
  std::vector<std::uint32_t> tet_map;

  std::optional<SurfaceChange> surface_change;  ///< with Options::surface

  // Checked before improve() returns; see volume_change().
  /// Of all faces that had to stay: the same as before. Where the surface might move, of what it is.
  std::uint64_t surface_fingerprint = 0;
  std::uint64_t surface_fingerprint_before = 0;  ///< likewise, of the input
  std::size_t not_positive_before = 0;  ///< tets without positive volume, in exact arithmetic
  std::size_t not_positive_after = 0;   ///< no more than before

  // Seconds of each part of the work.
  double building = 0;   ///< adjacency, order along a space-filling curve
  double measuring = 0;  ///< statistics and checks, before and after
  double improving = 0;  ///< the schedule
  double carrying = 0;   ///< bringing labels, groups and arrays over to the new mesh

  /// All figures that are worse than before, in words: worse(), then missed_aims(). The same list in
  /// the report as text, page and JSON, in Python and in C.
  TETMEND_API std::vector<std::string> worse_than_before() const;
  /// The promised figures among them: theta_min is not smaller, theta_max not above what
  /// it was, or, without holds_solver, the larger of that and the goal's, there are not more bad tets, lambda is not higher. With rulers also:
  /// the worst mean ratio and radius ratio are not smaller, nor with holds_solver the step, the worst edge ratio not above the larger
  /// of what it was and 10. Of a mesh of second order also: the worst Jacobian ratio, at the nodes and
  /// by its bound, is not smaller. Empty, unless the run mended inverted tets: that goes before
  /// theta_min, theta_max and the edge ratio, where they cannot be had together. Empty where lengths
  /// were wanted: another mesh is, then.
  TETMEND_API std::vector<std::string> worse() const;
  /// The others. Aims, no promises: the means of mean ratio and radius ratio are not smaller, and no
  /// more faces are above 70 degrees non-orthogonality. Empty without rulers.
  TETMEND_API std::vector<std::string> missed_aims() const;

  /// |after - before| / |before|, the rounding error of the volume if no tet was inverted before.
  TETMEND_API double volume_change() const;
};

/// Improves a mesh in place. The surface, the faces between two labels and what else is a
/// constraint stay bit for bit. The same input gives the same result, for every number of threads.
/// Two threads may each improve a mesh at the same time.
///
/// When the schedule fails half-way (a mistake in a script, an exception of a plugin or of
/// Options::progress), the mesh is sound and improved so far. When the mesh or an option is wrong,
/// or Options::check_operators finds a breach, the mesh is as before. When memory runs out, the mesh
/// is one or the other.
/// @throws OptionError for an option without sense; Error for a file that cannot be read, a script
/// or a plugin with a mistake, and a mesh as measure() says. The message has the place: the line of
/// the script, the line or byte of the mesh file, the number of the tet (from 0) in the arrays.
/// std::bad_alloc when memory runs out.
TETMEND_API Result improve(Mesh& mesh, const Options& options = {});

/// Makes edges as long as Options::size or size_at asks: splits those longer than 1.41 of the wanted
/// length, contracts those shorter than 0.71, then improves what came of it without undoing that. Else as
/// improve(), with its promises about surface, constraints, data and threads; the figures of Result::worse() are not
/// held. A surface that may not move keeps its edges. The schedule is "adapt", unless options name another one.
/// @throws OptionError as improve(), and when no size is given
/// @throws Error as improve(), and for a file or array that has no lengths
TETMEND_API Result adapt(Mesh& mesh, const Options& options);

/// Finds what is wrong with the options as far as can be told without a mesh. Loads the plugins.
/// @throws OptionError as improve()
/// @throws Error as improve()
TETMEND_API void check(const Options& options);

/// What Improver::improve() did.
struct ImproverStep {
  Ending ending = Ending::finished;  ///< why it ended; `finished` also where attempts ran out
  std::size_t bad_tets = 0;      ///< those that had got bad, or worse, since they were last tried
  std::size_t attempts = 0;      ///< in all
  std::size_t accepted = 0;      ///< of them
  bool is_complete = true;       ///< false: attempts or time ran out; the next call goes on there
  std::size_t touched_tets = 0;  ///< tets that are new or have a vertex that was moved by this
  QualityIndicators before;      ///< of the mesh as the program moved it
  QualityIndicators after;       ///< of the mesh as it is now
  /// With Options::maps, as in Result: from the mesh before this call to the one after it.
  std::vector<std::uint32_t> vertex_map;
  std::vector<std::uint32_t> tet_map;  ///< likewise
  std::vector<std::string> notes;      ///< of a schedule
};

/// A mesh in a solver's loop. It stays built between the steps, and improve() works only where tets
/// have got bad since they were last tried. The first call tries all bad tets.
///
/// Vertices and tets are numbered as in mesh(): they keep their numbers while improve() finds
/// nothing to change, and its result says where they went else.
///
///   tetmend::Improver session(std::move(mesh), {.threads = 4});
///   if (!session.move(points)) ...;  // a tet would turn over: nothing has moved
///   session.improve(20000);          // about that many attempts at most
class TETMEND_API Improver {
 public:
  static constexpr std::size_t kAnyNumber =
      std::numeric_limits<std::size_t>::max();  ///< of attempts

  /// Options are those of improve(): goal, measure, purpose, threads, protect, only, layers,
  /// keep_size, conserve, tets (of those at the start), plugin, progress, cancel, and time_limit of
  /// each step. Of lengths of edges they take `size_at`, which is asked anew in each step. Without
  /// a `script` or another schedule than the default each step is a few rounds of reconnection,
  /// smoothing, removal and insertion of points; with `size_at` the schedule "adapt".
  /// @throws OptionError for an option without sense or one that no session has: surface, size,
  /// trace, limit, straighten; Error as improve(), and for a mesh of second order
  explicit Improver(Mesh mesh, Options options = {});
  ~Improver();
  /// What is left may only be destroyed or assigned to.
  Improver(Improver&& other) noexcept;
  /// Likewise.
  Improver& operator=(Improver&& other) noexcept;

  /// All points go where the program says, those of the surface too. False if a tet with a positive
  /// volume would lose it: then nothing has moved. Make the step in parts.
  /// @param points one for each of mesh(), in its order
  /// @throws Error for another number of points, or one that is not finite
  /// Cost: linear.
  bool move(std::span<const std::array<double, 3>> points);

  /// Vertices that must stay where they are in the calls of improve() to come: asked once for each
  /// of mesh() at the beginning of each. An empty function: none but those of the surface and of
  /// constraints. What the function throws comes out of improve(), and nothing has changed then.
  void hold(std::function<bool(std::uint32_t vertex)> must_stay);

  /// Improves what has got bad. Surface and constraints stay bit for bit. The same calls give the
  /// same mesh, for every number of threads, unless a time limit or `cancel` ends them.
  /// @param attempts after about that many it ends: the tet that is just tried may take a few more
  /// @throws as improve(); the mesh is sound and improved so far then
  /// Cost: linear for what it looks at, besides the attempts.
  ImproverStep improve(std::size_t attempts = kAnyNumber);

  /// As it is now, with labels, groups and data, carried over in each step as improve() does. Valid
  /// until the next move() or improve(). Cost: linear, once after each of them.
  const Mesh& mesh() const;
  std::size_t point_count() const;  ///< of mesh(), without making it
  std::size_t tet_count() const;    ///< likewise

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace tetmend
