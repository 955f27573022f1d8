// SPDX-License-Identifier: MIT
//   build and measure the whole | slices | divisions and zones | check all pieces | join | measure
#include "pieces/improve.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "envelope/kept_points.h"
#include "face/advice.h"
#include "face/arena.h"
#include "face/carry.h"
#include "face/growth.h"
#include "face/mesh_access.h"
#include "face/plan.h"
#include "face/recorded.h"
#include "face/regions.h"
#include "face/size_statistics.h"
#include "face/surface_marks.h"
#include "face/watcher.h"
#include "face/worse.h"
#include "kernel/formats/deck_remarks.h"
#include "kernel/grouped.h"
#include "kernel/integrity.h"
#include "kernel/mesh_view.h"
#include "kernel/rulers.h"
#include "kernel/shared_parts.h"
#include "kernel/size_field.h"
#include "kernel/stopwatch.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/volume_rounding.h"
#include "pieces/mesh_files.h"
#include "pieces/piece_trace.h"
#include "pieces/slices.h"
#include "schedule/limit/surface_limit.h"

namespace tetmend::pieces {

namespace {

/// One call of improve().
class Improvement {
 public:
  Improvement(Mesh& mesh, const Options& options, const Division& division, Shelf& shelf,
              face::Portrait* portrait)
      : user_mesh_(mesh),
        options_(options),
        division_(division),
        portrait_(portrait),
        plan_(options),
        watcher_(options),
        file_(mesh.file()),
        input_(MeshAccess::take(mesh)),
        divided_(shelf, ranks_, input_.points.size()),
        trace_(options, plan_, file_) {}

  Result run() {
    try {
      result_.goal = options_.goal;
      prepare();
      work();
      finish();
    } catch (...) {
      user_mesh_ = MeshAccess::make(std::move(input_), file_);
      throw;
    }
    watcher_.rethrow();
    return std::move(result_);
  }
  void note(const std::string& text) {
    watcher_.noted(text);
    result_.notes.push_back(text);
  }
  /// After run(). Null: nothing was recorded.
  std::unique_ptr<TraceRecorder> take_trace(std::string& trouble) {
    return trace_.take_recorder(trouble);
  }

 private:
  void prepare();
  TetMesh build();
  void hold_lengths(TetMesh& mesh);
  void measure_before(const TetMesh& mesh);
  MeshData source(const TetMesh& mesh) const;
  void work();
  void finish();
  void measure_after(Joined& joined);
  void map(const Joined& joined);
  void check_promises() const;
  void give_back(Joined& joined);
  Mesh& user_mesh_;
  const Options& options_;
  const Division& division_;
  face::Portrait* portrait_;  // null: nobody asked for one
  face::Plan plan_;
  face::Watcher watcher_;
  const std::filesystem::path file_;
  MeshData input_;
  OneRank ranks_;
  DividedMesh divided_;
  PieceTrace trace_;
  std::vector<std::uint32_t> tet_numbers_;  // in the input, by slot
  std::shared_ptr<const SizeField> size_field_;
  std::optional<SurfaceChange> unchanged_surface_;
  face::SurfaceMarks marks_;  // where the surface may move
  std::uint64_t surface_before_ = 0;
  face::LocalLengths lengths_;
  Result result_;
};

TetMesh Improvement::build() {
  MeshData data = input_;
  const std::vector<MeshData::Triangle> walls = face::walls_between_parts(data);
  face::put_marks(marks_, data);
  data.triangles.insert(data.triangles.end(), walls.begin(), walls.end());
  hold_shared_inside(data);
  TetMesh mesh =
      face::build_located(file_, data,
                          {.interior = options_.ignore_interior ? InteriorConstraints::dropped
                                                                : InteriorConstraints::kept,
                           .report = &result_.build,
                           .tet_numbers = &tet_numbers_});
  mesh.set_standard(plan_.standard);
  return mesh;
}

void Improvement::prepare() {
  watcher_.begin(Stage::building);
  const Stopwatch watch(result_.building);
  if (!input_.mid_nodes.empty()) throw Error("a mesh of second order cannot be divided");
  plan_.trace.locate(input_);
  face::find_regions(input_, options_);
  face::check_conserve(input_, options_.conserve);
  std::vector<char> is_kept;
  if (!plan_.surface.is_fixed()) {
    marks_ = face::mark_surface(input_);
    is_kept = find_kept_points(input_);
  }
  TetMesh mesh = build();
  const face::ProtectedPart part = face::protect(mesh, options_);
  result_.protected_tets = part.tets;
  result_.protected_bad_tets = part.bad_tets;
  result_.layer_tets = part.layer_tets;
  result_.layer_bad_tets = part.layer_bad_tets;
  hold_lengths(mesh);
  measure_before(mesh);
  std::vector<char> is_protected(input_.tets.size(), 0);
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    if (mesh.is_frozen(TetHandle(slot))) is_protected[tet_numbers_[slot]] = 1;
  }
  const MeshData data = source(mesh);
  mesh = {};
  tet_numbers_ = {};
  add_slices(data, is_protected, divided_, is_kept);
  divided_.end_slices();
}

/// The field is one of the file.
void Improvement::hold_lengths(TetMesh& mesh) {
  if (plan_.sizes.are_wanted()) {
    const std::string size = plan_.sizes.of_mesh();
    if (!size.empty() && !mesh.scale().is_one()) {
      throw OptionError("size", fmt::format("size {}: the lengths of the mesh are so far from "
                                            "ordinary that it cannot be adapted in pieces",
                                            size));
    }
    size_field_ = size.empty() ? plan_.sizes.field_of_places() : plan_.sizes.field(input_, mesh);
    mesh.set_size_field(in_work(*size_field_->wanted(), mesh.scale()));
  } else if (options_.keep_size && mesh.scale().is_one()) {
    size_field_ = std::make_shared<UsualLengths>(mesh);
  }
}

void Improvement::measure_before(const TetMesh& mesh) {
  const Stopwatch watch(result_.measuring);
  result_.before = compute_statistics(mesh, options_.goal);
  result_.rulers_before = measure_rulers(mesh);
  if (plan_.sizes.are_wanted()) {
    result_.sizes_before = face::size_statistics(mesh);
    for (const std::string& text : face::remarks_on(*result_.sizes_before, options_)) note(text);
  }
  lengths_ = face::LocalLengths(mesh, input_.points.size());
  surface_before_ = result_.surface_fingerprint_before = surface_fingerprint(mesh);
  result_.not_positive_before = count_not_positive(mesh, result_.before);
  if (portrait_ != nullptr) portrait_->draw_before(mesh, result_.rulers_before);
  watcher_.watch(nullptr, quality_indicators(mesh));
  for (const std::string& text : deck_remarks(input_)) note(text);
  for (const std::string& text : face::advice_before(mesh, result_)) note(text);
}

/// What the pieces are made of: tets in the order of the file, with their vertices in positive
/// order; of the rest what is kept.
MeshData Improvement::source(const TetMesh& mesh) const {
  MeshData data;
  data.points = input_.points;
  data.point_labels = input_.point_labels;
  data.tets = input_.tets;
  if (result_.build.mirrored || result_.build.reordered_tets > 0) {
    for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
      auto& to = data.tets[tet_numbers_[slot]].vertices;
      for (std::size_t i = 0; i < 4; ++i) to[i] = mesh.origin(mesh.vertices(TetHandle(slot))[i]);
    }
  }
  const MeshView view(mesh);  // its vertices are those of the file, in their order
  data.triangles.assign(view.triangles().begin(), view.triangles().end());
  data.edges.assign(view.edges().begin(), view.edges().end());
  data.required_vertices.assign(view.required_vertices().begin(), view.required_vertices().end());
  return data;
}

void Improvement::work() {
  watcher_.begin(Stage::improving);
  const Stopwatch watch(result_.improving);
  const AimSettings settings(plan_.schedule, plan_.settings);
  TaskOptions task{plan_.registry, plan_.schedule, settings, plan_.standard};
  task.size_field = size_field_;
  task.trace = &trace_;
  task.check_operators = options_.check_operators;
  task.watcher = &watcher_;
  PieceRun run(divided_, division_, task);
  run.set_side_by_side(division_.pieces);
  run.set_limits(
      {result_.before.tets, result_.before.n_bad,
       plan_.growth.most(result_.before.tets).value_or(std::numeric_limits<std::uint64_t>::max()),
       options_.time_limit});
  run.set_stop([&] {
    return watcher_.stopped() || (options_.cancel != nullptr && options_.cancel->load());
  });
  run.set_listener([&](const StepRecord& record) {
    watcher_.watch(nullptr, record.after.indicators);
    result_.passes.push_back(to_pass(record));
  });
  if (!plan_.surface.is_fixed()) {
    plan_.surface.check_length(divided_.diagonal());
    run.hold_surface(plan_.surface.envelope_options());
    unchanged_surface_ = run.surface()->unchanged();
  }
  run.run();
  if (run.stopped()) {
    result_.ending = run.out_of_time() ? Ending::time_limit : Ending::cancelled;
  }
  if (!trace_.note().empty()) note(trace_.note());
  watcher_.begin(Stage::measuring);
  const Figures figures = run.measure_after().figures;
  result_.surface_change = run.surface_change();
  const bool is_kept = !plan_.surface.is_fixed() ||
                       (figures.surface == surface_before_ &&
                        figures.statistics.boundary_triangles == result_.before.boundary_triangles);
  const bool fits =
      is_kept && figures.misfits == 0 && figures.not_positive <= result_.not_positive_before;
  if (!fits) throw Error("the pieces do not fit: this is a bug of tetmend, please report it");
}

void Improvement::finish() {
  Joined joined = join(divided_, input_.points.size());
  measure_after(joined);
  map(joined);
  check_promises();
  if (!face::worse_for_nothing(result_).empty()) {
    note(stay_as_it_was(unchanged_surface_, result_));
    for (std::size_t i = 0; i < result_.vertex_map.size(); ++i) {
      result_.vertex_map[i] = static_cast<std::uint32_t>(i);
    }
    for (std::size_t i = 0; i < result_.tet_map.size(); ++i) {
      result_.tet_map[i] = static_cast<std::uint32_t>(i);
    }
    if (portrait_ != nullptr) {
      portrait_->bad_after = portrait_->bad_before;
      portrait_->are_reasons_known = false;
      portrait_->rulers_after = portrait_->rulers_before;
    }
    user_mesh_ = MeshAccess::make(std::move(input_), file_);
  } else {
    give_back(joined);
  }
  if (!options_.rulers) forget_rulers(result_);
  if (!options_.maps) result_.vertex_map = result_.tet_map = {};
}

void Improvement::measure_after(Joined& joined) {
  const Stopwatch watch(result_.measuring);
  MeshData data = joined.data;
  std::vector<std::uint32_t> numbers;
  TetMesh mesh = face::build_located({}, data, {.report = nullptr, .tet_numbers = &numbers});
  mesh.set_standard(plan_.standard);
  mesh.freeze([&](TetHandle t) { return joined.is_protected[numbers[t.index()]] != 0; });
  result_.after = compute_statistics(mesh, options_.goal);
  result_.rulers_after = measure_rulers(mesh);
  if (plan_.sizes.are_wanted()) {
    mesh.set_size_field(in_work(*size_field_->wanted(), mesh.scale()));
    result_.sizes_after = face::size_statistics(mesh);
  }
  face::LocalLengths now(input_.points.size());
  now.add(mesh, [&](VertexHandle v) {
    const std::uint32_t number = joined.vertex_origins[mesh.origin(v)];
    return number == kGone ? std::nullopt : std::optional<std::uint64_t>(number);
  });
  result_.size_drift = lengths_.drift_to(now);
  result_.surface_fingerprint = surface_fingerprint(mesh);
  result_.not_positive_after = count_not_positive(mesh, result_.after);
  std::vector<std::pair<TetHandle, Hindrance>> hindrances;
  if (options_.limit) result_.limit = find_surface_limit(mesh, options_.cancel, &hindrances);
  if (!result_.limit) hindrances.clear();
  if (portrait_ != nullptr) {
    portrait_->draw_after(mesh, hindrances, result_.rulers_after);
    for (face::DrawnTet& tet : portrait_->bad_after) {
      tet.facts.tet = numbers[tet.facts.tet];
      tet.facts.number = tet.facts.tet + 1;
    }
  }
  for (const std::string& text : face::advice_after(mesh, joined.data, options_, result_)) {
    note(text);
  }
}

/// Where the vertices and tets of the input are, and which tets are not as they were.
void Improvement::map(const Joined& joined) {
  Maps maps = maps_of(joined, input_.points.size(), input_.tets.size());
  result_.vertex_map = std::move(maps.vertices);
  result_.tet_map = std::move(maps.tets);
  std::vector<char> has_moved(joined.vertex_origins.size(), 1);
  for (std::uint32_t v = 0; v < has_moved.size(); ++v) {
    const std::uint32_t origin = joined.vertex_origins[v];
    if (origin == kGone) continue;
    has_moved[v] = joined.data.points[v] != input_.points[origin] ? 1 : 0;
  }
  for (std::uint32_t t = 0; t < joined.tet_origins.size(); ++t) {
    const std::uint32_t origin = joined.tet_origins[t];
    const auto& v = joined.data.tets[t].vertices;
    const bool is_touched =
        origin == PieceTet::kNone ||
        std::any_of(v.begin(), v.end(), [&](std::uint32_t w) { return has_moved[w] != 0; });
    result_.touched_tets += is_touched ? 1 : 0;
  }
}

/// A broken promise would be a bug. Nobody is to work on with such a mesh.
void Improvement::check_promises() const {
  const bool keeps_surface =
      !plan_.surface.is_fixed() ||
      (result_.surface_fingerprint == surface_before_ &&
       result_.after.boundary_triangles == result_.before.boundary_triangles);
  const bool keeps_volume =
      (!plan_.surface.is_fixed() && !plan_.surface.is_flat()) || result_.not_positive_before > 0 ||
      is_rounding(result_.volume_change(), result_.before.scaled_volume,
                  [&] { return std::ldexp(longest_side(input_.points), -result_.before.scale); });
  const bool is_kept =
      keeps_surface && keeps_volume && result_.not_positive_after <= result_.not_positive_before;
  if (!is_kept) throw Error("the pieces do not fit: this is a bug of tetmend, please report it");
}

void Improvement::give_back(Joined& joined) {
  const Stopwatch watch(result_.carrying);
  MeshData data = std::move(joined.data);
  if (face::holds_more(input_)) {
    face::Carried carried =
        face::carry(input_, result_.vertex_map, result_.tet_map, options_.conserve, data,
                    plan_.surface.is_fixed() ? nullptr : &marks_);
    result_.carried = std::move(carried.arrays);
    for (const std::string& text : carried.notes) note(text);
  }
  user_mesh_ = MeshAccess::make(std::move(data));
}

/// The mesh is none the worse for a trace that cannot be written.
void finish(TraceRecorder& trace, Result& result) {
  try {
    trace.finish();
  } catch (const Error& error) {
    result.trace_trouble = error.what();
  }
}

}  // namespace

Pass to_pass(const StepRecord& record) {
  Pass pass;
  pass.name = record.is_zones ? "zones" : "division";
  pass.round = record.number;
  pass.seconds = record.seconds;
  pass.verdicts = record.verdicts;
  pass.items = record.items;
  pass.deferred = record.deferred;
  pass.after = record.after.indicators;
  return pass;
}

void check(const Options& options, const Division& division) {
  tetmend::check(options);
  if (division.pieces <= 1) return;
  constexpr std::size_t kMostPieces = 65'535;
  if (division.pieces > kMostPieces) {
    throw OptionError("pieces",
                      fmt::format("pieces: {} is outside 1 to {}", division.pieces, kMostPieces));
  }
  check_trace_piece(options, division.pieces, division.divisions, division.zone_rounds);
}

namespace {

constexpr std::size_t kLeastTets = 300;  // of a piece

}  // namespace

std::size_t limited_pieces(std::size_t pieces, std::size_t tets) {
  return std::min(pieces, std::max<std::size_t>(2, tets / kLeastTets));
}

std::string why_fewer_pieces(std::size_t asked, std::size_t pieces, std::size_t tets) {
  return fmt::format("{} pieces, not {}: more would have less than {} of the {} tets each",
                     grouped(pieces), grouped(asked), kLeastTets, grouped(tets));
}

std::size_t usual_pieces(std::size_t tets) {
  constexpr std::size_t kTetsOfPiece = 4'000'000;
  return std::max<std::size_t>(1, (tets + kTetsOfPiece - 1) / kTetsOfPiece);
}

namespace {

constexpr std::uint64_t kProgram = 40'000'000;  // bytes, without a piece
constexpr std::uint64_t kBytesPerTet = 130;     // of a piece that is worked on

std::uint64_t room_for_pieces(std::uint64_t memory) {
  return memory > kProgram ? memory - kProgram : 0;
}

}  // namespace

void check_memory(std::uint64_t memory) {
  if (memory == 0 || memory >= kProgram) return;
  throw OptionError("memory", fmt::format("memory: {} bytes is less than the {}M that the program "
                                          "takes without a piece: expected a size such as 2G",
                                          memory, kProgram / 1'000'000));
}

std::size_t pieces_for(std::size_t tets, std::uint64_t memory) {
  const std::uint64_t most =
      std::max<std::uint64_t>(10'000, room_for_pieces(memory) / kBytesPerTet);
  return static_cast<std::size_t>((tets + most - 1) / most);
}

std::size_t pieces_at_a_time(std::size_t tets, std::size_t pieces, std::uint64_t memory) {
  const std::uint64_t of_one = kBytesPerTet * std::max<std::uint64_t>(1, tets / pieces);
  return std::clamp<std::size_t>(room_for_pieces(memory) / of_one, 1, pieces);
}

Result improve(Mesh& mesh, const Options& options, const Division& division,
               const std::filesystem::path& scratch, face::Portrait* portrait,
               std::unique_ptr<TraceRecorder>* trace) {
  check(options, division);
  if (division.pieces <= 1) return tetmend::improve(mesh, options);
  const std::size_t tets = MeshAccess::data(mesh).tets.size();
  Division limited = division;
  limited.pieces = limited_pieces(division.pieces, tets);
  check(options, limited);
  return face::on_threads(face::threads_of(options), [&] {
    MemoryShelf memory;
    FolderShelf folder(scratch);
    Shelf& shelf = scratch.empty() ? static_cast<Shelf&>(memory) : folder;
    Improvement improvement(mesh, options, limited, shelf, portrait);
    if (limited.pieces < division.pieces) {
      improvement.note(why_fewer_pieces(division.pieces, limited.pieces, tets));
    }
    Result result = improvement.run();
    std::unique_ptr<TraceRecorder> made = improvement.take_trace(result.trace_trouble);
    if (trace != nullptr) {
      *trace = std::move(made);
    } else if (made) {
      finish(*made, result);
    }
    return result;
  });
}

}  // namespace tetmend::pieces
