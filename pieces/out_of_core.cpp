// SPDX-License-Identifier: MIT
//   slices of the file | measure all pieces | divisions and zones | measure all pieces | write
#include "pieces/out_of_core.h"

#include <chrono>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/io.h>

#include "face/arena.h"
#include "face/carry.h"
#include "face/plan.h"
#include "face/watcher.h"
#include "kernel/formats/mesh_io.h"
#include "pieces/improve.h"
#include "pieces/medit_slices.h"
#include "pieces/slices.h"
#include "platform/platform.h"

namespace tetmend::pieces {

namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void check_options(const Options& options) {
  const auto refuse = [](bool given, const char* name, std::string_view option) {
    if (!given) return;
    throw OptionError(name, fmt::format("{}: needs the whole mesh in memory", option));
  };
  refuse(!options.protect.empty(), "protect", "protect");
  refuse(!options.only.empty(), "only", "only");
  refuse(!options.surface.empty() && options.surface != "fixed", "surface", "surface");
  refuse(options.keep_size, "keep_size", "keep-size");
  refuse(!options.conserve.empty(), "conserve", "conserve");
  refuse(options.ignore_interior, "ignore_interior", "ignore-interior");
  refuse(!options.trace.empty(), "trace", "trace");
  refuse(options.check_operators, "check_operators", "check-operators");
}

/// One call of improve_files().
class FileRun {
 public:
  FileRun(const OutOfCore& files, const Options& options, Division& division)
      : files_(files),
        options_(options),
        division_(division),
        plan_(options),
        watcher_(options),
        shelf_(files.scratch) {}

  Result run() {
    result_.goal = options_.goal;
    watcher_.begin(Stage::building);
    {
      const Stopwatch watch(result_.building);
      if (!read()) return improve_whole();
    }
    const ScheduleSettings in_zones = zone_settings(plan_.schedule, options_.set);
    TaskOptions task{plan_.registry, plan_.schedule, options_.set, in_zones, plan_.standard};
    task.fault = files_.fault;
    task.watch = [&](Run& run) {
      run.set_listener(&watcher_);
      run.set_cancel_flag(options_.cancel);
      watcher_.watch(&run, now_);
    };
    task.unwatch = [&] { watcher_.watch(nullptr, now_); };
    PieceRun run(*mesh_, division_, task);
    measure_before(run);
    work(run);
    measure_after(run);
    write();
    watcher_.rethrow();
    return std::move(result_);
  }

 private:
  Result improve_whole();
  bool read();
  bool read_whole();
  void measure_before(PieceRun& run);
  void work(PieceRun& run);
  void measure_after(PieceRun& run);
  void write();
  /// False for one.
  bool is_divided(std::size_t tets) {
    if (division_.pieces == 0) division_.pieces = pieces_for(tets, files_.memory);
    return division_.pieces > 1;
  }

  const OutOfCore& files_;
  const Options& options_;
  Division& division_;
  face::Plan plan_;
  face::Watcher watcher_;
  FolderShelf shelf_;
  std::optional<DividedMesh> mesh_;
  std::size_t vertices_ = 0;
  QualityIndicators now_;
  std::uint64_t surface_before_ = 0;
  Result result_;
};

/// There is memory enough for all of it.
Result FileRun::improve_whole() {
  Mesh mesh = load(files_.input, options_.threads);
  Result result = tetmend::improve(mesh, options_);
  save(files_.output, mesh, options_.threads);
  return result;
}

/// False if one piece is enough: nothing was read then.
bool FileRun::read() {
  const std::optional<MeditSlices> slices = MeditSlices::open(files_.input);
  if (!slices) return read_whole();
  if (!is_divided(slices->counts().tets)) return false;
  vertices_ = slices->counts().vertices;
  mesh_.emplace(shelf_, vertices_);
  slices->add_to(*mesh_, std::min(kTetsOfSlice, 1 + slices->counts().tets / division_.pieces));
  return true;
}

bool FileRun::read_whole() {
  MeshData data = read_mesh(files_.input);
  if (face::holds_more(data) || !data.mid_nodes.empty()) {
    throw Error(
        fmt::format("{}: holds more than tets, labels and constraints, which needs the "
                    "whole mesh in memory",
                    files_.input.string()));
  }
  if (!is_divided(data.tets.size())) return false;
  vertices_ = data.points.size();
  mesh_.emplace(shelf_, vertices_);
  add_slices(data, {}, *mesh_);
  return true;
}

void FileRun::measure_before(PieceRun& run) {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  const Figures figures = run.measure_before();
  const auto fail = [&](std::string_view what) {
    throw Error(fmt::format("{}: {}", files_.input.string(), what));
  };
  if (figures.peculiar > 0) {
    fail("some tets are inverted, flat or turned round, which needs the whole mesh in memory");
  }
  if (figures.layer_tets > 0 && options_.layers == Layers::keep) {
    fail(
        "has boundary layers: keeping them needs the whole mesh in memory; 'layers improve' "
        "gives them up");
  }
  result_.before = figures.statistics;
  surface_before_ = figures.surface;
  result_.not_positive_before = figures.not_positive;
}

void FileRun::work(PieceRun& run) {
  watcher_.begin(Stage::improving);
  const Stopwatch watch(result_.improving);
  run.set_limits(
      {result_.before.tets, result_.before.n_bad,
       plan_.growth.most(result_.before.tets).value_or(std::numeric_limits<std::size_t>::max()),
       options_.time_limit});
  run.set_stop([&] {
    return watcher_.stopped() || (options_.cancel != nullptr && options_.cancel->load());
  });
  run.set_listener([&](const StepRecord& record) {
    now_ = record.after.indicators;
    result_.passes.push_back(to_pass(record));
  });
  run.run();
  if (run.stopped()) {
    result_.ending = run.out_of_time() ? Ending::time_limit : Ending::cancelled;
  }
}

void FileRun::measure_after(PieceRun& run) {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  const Figures figures = run.measure_after();
  result_.after = figures.statistics;
  result_.surface_fingerprint = result_.surface_fingerprint_before = figures.surface;
  result_.not_positive_after = figures.not_positive;
  constexpr double kMostVolumeChange = 1e-9;
  const bool fits = figures.surface == surface_before_ &&
                    result_.after.boundary_triangles == result_.before.boundary_triangles &&
                    result_.not_positive_after <= result_.not_positive_before &&
                    result_.volume_change() <= kMostVolumeChange;
  if (!fits) throw Error("the pieces do not fit: this is a bug of tetmend, please report it");
}

void FileRun::write() {
  if (!result_.worse().empty()) {
    result_.notes.push_back(fmt::format("the mesh is as it was: at the end there was {}",
                                        fmt::join(result_.worse(), "; ")));
    watcher_.noted(result_.notes.back());
    result_.after = result_.before;
    read();  // slices are pieces, too
  }
  if (files_.output.extension() == ".meshb") return write_medit_slices(files_.output, *mesh_);
  const Joined joined = join(*mesh_, vertices_);
  write_mesh(files_.output, MeshView(joined.data));
}

}  // namespace

Result improve_files(const OutOfCore& files, const Options& options, Division& division) {
  check_options(options);
  check(options, division);
  return face::on_threads(options.threads, [&] { return FileRun(files, options, division).run(); });
}

}  // namespace tetmend::pieces
