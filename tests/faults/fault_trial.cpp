// SPDX-License-Identifier: MIT
#include "tests/faults/fault_trial.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <type_traits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tetmend/improve.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/statistics.h"
#include "kernel/surface_fingerprint.h"
#include "tests/faults/failing_memory.h"
#include "tests/support/threads.h"
#include "trace/recorder.h"
#include "trace/replay.h"
#include "trace/trace_file.h"

namespace tetmend::test {

namespace {

constexpr std::size_t kBlocks = 4;

class Hash {
 public:
  template <class T>
  Hash& add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    std::array<unsigned char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    for (const unsigned char byte : bytes) sum_ = (sum_ ^ byte) * 1099511628211u;
    return *this;
  }
  Hash& add(const Point& point) { return add(point.x()).add(point.y()).add(point.z()); }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 1469598103934665603u;
};

/// Of all that a mesh holds of its live tets and vertices but their qualities, which follow.
std::uint64_t state_of(const TetMesh& mesh) {
  Hash hash;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    hash.add(i).add(mesh.label(t));
    for (const VertexHandle v : mesh.vertices(t)) hash.add(v.index());
    for (const HalfFace f : mesh.neighbours(t)) hash.add(f.code());
    hash.add(mesh.is_touched(t)).add(mesh.is_created(t)).add(mesh.has_constraints(t));
  }
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh.is_deleted(v)) continue;
    hash.add(i).add(mesh.point(v)).add(mesh.tet_of(v).index());
    hash.add(mesh.changed(v)).add(mesh.moved(v)).add(mesh.origin(v)).add(mesh.is_fixed(v));
  }
  return hash.sum();
}

/// Of the places of all tets, in whatever order.
template <class Tets, class PointOf>
std::uint64_t places_of(const Tets& tets, const PointOf& point_of) {
  std::uint64_t sum = 0;
  for (const auto& tet : tets) {
    Hash hash;
    for (const auto& v : tet.vertices) hash.add(point_of(v));
    sum += hash.sum();
  }
  return sum;
}

std::uint64_t places_of(const MeshData& data) {
  return places_of(data.tets, [&](std::uint32_t v) { return data.points[v]; });
}

bool equal(const PassRecord& x, const PassRecord& y) {
  return x.name == y.name && x.round == y.round && x.verdicts == y.verdicts && x.items == y.items &&
         x.after.q_worst == y.after.q_worst && x.after.n_bad == y.after.n_bad &&
         x.after.q_aver == y.after.q_aver;
}

/// The threads of the arena are awake when it returns, so that short runs have them.
void wake_threads() {
  constexpr std::chrono::milliseconds kPatience(20);
  std::atomic<int> awake = 0;
  tbb::parallel_for(
      0, tbb::this_task_arena::max_concurrency(),
      [&](int) {
        const auto start = std::chrono::steady_clock::now();
        ++awake;
        while (awake < tbb::this_task_arena::max_concurrency() &&
               std::chrono::steady_clock::now() - start < kPatience) {
          std::this_thread::yield();
        }
      },
      tbb::simple_partitioner());
}

/// Sees whether more than one thread works.
class Threads final : public ProgressListener {
 public:
  bool more_than_one() const { return more_; }
  void progress(std::string_view, unsigned, double) override {
    if (std::this_thread::get_id() != first_) more_ = true;
  }
  void pass_done(std::string_view, unsigned, const QualityIndicators&) override {}

 private:
  std::thread::id first_ = std::this_thread::get_id();
  bool more_ = false;
};

/// What a call throws but std::bad_alloc is a finding.
template <class Call>
bool returns(const Call& call, FaultOutcome& outcome) {
  try {
    call();
    return true;
  } catch (const std::bad_alloc&) {
  } catch (const std::exception& error) {
    outcome.findings.push_back(fmt::format("another exception: {}", error.what()));
  }
  return false;
}

}  // namespace

MeshData fault_mesh(const std::string& name) {
  if (name == "tangled") return contract::kuhn_cube(5, 0.6, 10);
  if (name == "lattice") return contract::kuhn_cube(5, 0.33, 3);
  if (name == "large_tangled") return contract::kuhn_cube(9, 0.6, 10);
  if (name == "large_lattice") return contract::kuhn_cube(9, 0.33, 3);
  return read_mesh(name);
}

/// Counts the attempts that are kept, and hands all on to a recorder.
class FaultTrial::Witness final : public TraceSink {
 public:
  explicit Witness(TraceRecorder* recorder) : recorder_(recorder) {}

  std::function<void()> on_kept;
  std::size_t kept = 0;

  void pass_begins(std::string_view name, unsigned round) override {
    if (recorder_ != nullptr) recorder_->pass_begins(name, round);
  }
  void pass_ends(const QualityIndicators& now) override {
    if (recorder_ != nullptr) recorder_->pass_ends(now);
  }
  void visit_begins(const TetVertices& tet, Quality quality) override {
    if (recorder_ != nullptr) recorder_->visit_begins(tet, quality);
  }
  void visit_ends() override {
    if (recorder_ != nullptr) recorder_->visit_ends();
  }
  void standard_changed(const Standard& standard) override {
    if (recorder_ != nullptr) recorder_->standard_changed(standard);
  }
  void attempt_begins(const AttemptEvent& event) override {
    ++depth_;
    if (recorder_ != nullptr) recorder_->attempt_begins(event);
  }
  void candidate_found() override {
    if (recorder_ != nullptr) recorder_->candidate_found();
  }
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override {
    if (recorder_ != nullptr) recorder_->attempt_ends(verdict, before, now);
    if (--depth_ > 0 || verdict != Verdict::accepted) return;
    ++kept;
    if (on_kept) on_kept();
  }
  void edit_made(const TetMesh& mesh, const Journal& journal) noexcept override {
    if (recorder_ != nullptr) recorder_->edit_made(mesh, journal);
  }
  void edit_undone() noexcept override {
    if (recorder_ != nullptr) recorder_->edit_undone();
  }

 private:
  TraceRecorder* recorder_;
  unsigned depth_ = 0;
};

FaultTrial::FaultTrial(MeshData data, const std::string& schedule, Form form)
    : data_(std::move(data)),
      schedule_(Schedule::builtin(schedule)),
      form_(form),
      start_(TetMesh::sorted(data_)),
      surface_(surface_fingerprint(start_)),
      not_positive_(count_not_positive(start_)) {
  if (form == Form::face) {
    note_states_of_face();
  } else {
    note_states();
  }
}

void FaultTrial::note_state(std::uint64_t state) {
  states_.push_back(state);
  known_states_.insert(state);
}

void FaultTrial::set_up(Run& run) const {
  if (form_ == Form::divided || form_ == Form::threads) run.set_block_count(kBlocks);
}

void FaultTrial::note_states() {
  TetMesh mesh = start_;
  Witness witness(nullptr);
  witness.on_kept = [&] { note_state(state_of(mesh)); };
  note_state(state_of(mesh));
  on_threads(1, [&] {
    Run run(mesh, registry_);
    set_up(run);
    run.set_trace(&witness);
    improve(run, schedule_);
    passes_ = run.records;
  });
}

/// By the trace of the run, which is the only one to see the mesh on the way.
void FaultTrial::note_states_of_face() {
  const std::filesystem::path file = folder_ / "face.trace";
  Mesh mesh = MeshAccess::make(data_);
  improve(mesh, {.schedule = schedule_.name(), .trace = file});
  const TraceFile trace(file);
  Replay replay(trace);
  const auto note = [&] { note_state(places_of(replay.mesh().to_data())); };
  note_state(places_of(data_));
  for (const Call& call : trace.calls()) {
    if (call.depth > 0 || !call.accepted()) continue;
    replay.seek(call.events.end);
    note();
  }
  if (states_.back() != places_of(MeshAccess::data(mesh))) {
    throw Error("the run does not end with the last state of its trace");
  }
}

FaultOutcome FaultTrial::run(long n) {
  return form_ == Form::face ? run_face(n) : run_schedule(n);
}

FaultOutcome FaultTrial::run_schedule(long n) {
  FaultOutcome outcome;
  TetMesh mesh = start_;
  std::unique_ptr<TraceRecorder> recorder;
  if (form_ == Form::recorded) {
    recorder = std::make_unique<TraceRecorder>(folder_ / "run.trace", mesh, TraceHeader());
  }
  Witness witness(recorder.get());
  bool complete = false;
  on_threads(form_ == Form::threads ? 2 : 1, [&] {
    std::optional<Run> run;
    Threads threads;
    wake_threads();
    {
      const FailingMemory memory(n);
      complete = returns(
          [&] {
            run.emplace(mesh, registry_);
            set_up(*run);
            run->set_listener(&threads);
            if (recorder) run->set_trace(&witness);
            improve(*run, schedule_);
          },
          outcome);
      outcome.failed = memory.has_failed();
    }
    outcome.on_two_threads = threads.more_than_one();
    if (run) check_passes(*run, outcome);
  });
  check_mesh(mesh, outcome);
  if (form_ != Form::threads) check_state(state_of(mesh), complete, outcome);
  if (!recorder) return outcome;
  if (state_of(mesh) != states_[witness.kept]) {
    outcome.findings.emplace_back("the mesh is not what it was when the last attempt was kept");
  }
  check_trace(mesh, *recorder, outcome);
  return outcome;
}

FaultOutcome FaultTrial::run_face(long n) {
  FaultOutcome outcome;
  Mesh mesh = MeshAccess::make(data_);
  const Options options = {.schedule = schedule_.name()};
  bool complete = false;
  {
    const FailingMemory memory(n);
    complete = returns([&] { improve(mesh, options); }, outcome);
    outcome.failed = memory.has_failed();
  }
  check_mesh(TetMesh(MeshAccess::data(mesh)), outcome);
  check_state(places_of(MeshAccess::data(mesh)), complete, outcome);
  return outcome;
}

void FaultTrial::check_mesh(const TetMesh& mesh, FaultOutcome& outcome) const {
  const auto check = [&](bool holds, std::string_view finding) {
    if (!holds) outcome.findings.emplace_back(finding);
  };
  for (const Finding& finding : check_integrity(mesh, 3)) {
    outcome.findings.push_back(finding.message);
  }
  check(surface_fingerprint(mesh) == surface_, "the surface changed");
  check(count_not_positive(mesh) <= not_positive_, "more tets are inverted");
  TetMesh copy = mesh;
  copy.set_standard(start_.standard());
  check(quality_indicators(copy).q_worst >= quality_indicators(start_).q_worst,
        "the worst tet is worse");
}

void FaultTrial::check_state(std::uint64_t state, bool complete, FaultOutcome& outcome) const {
  if (complete ? state == states_.back() : known_states_.contains(state)) return;
  outcome.findings.emplace_back(complete ? "the mesh is not what the run makes of it"
                                         : "the mesh is in no state between two attempts");
}

void FaultTrial::check_passes(const Run& run, FaultOutcome& outcome) const {
  const std::size_t count = run.records.size();
  const bool as_known = count <= passes_.size() &&
                        std::equal(run.records.begin(), run.records.end(), passes_.begin(), equal);
  if (!as_known) outcome.findings.emplace_back("the passes recorded are not those finished");
  if (run.indicators().q_aver != quality_indicators(run.mesh()).q_aver) {
    outcome.findings.emplace_back("the indicators of the run are not those of its mesh");
  }
}

/// A trace that did not suffer itself leads to the mesh.
void FaultTrial::check_trace(const TetMesh& mesh, TraceRecorder& recorder,
                             FaultOutcome& outcome) const {
  try {
    recorder.finish();
  } catch (const Error&) {
    return;  // out of memory
  }
  const TraceFile trace(folder_ / "run.trace");
  Replay replay(trace);
  replay.seek(trace.event_count());
  if (replay.mesh().fingerprint() != SlotMesh(mesh).fingerprint()) {
    outcome.findings.emplace_back("the trace leads to another mesh");
  }
}

}  // namespace tetmend::test
