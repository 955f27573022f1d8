// SPDX-License-Identifier: MIT
#include "viewer/live/live_run.h"

#include <algorithm>
#include <thread>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/run_files.h"
#include "ops/plugin.h"
#include "viewer/live/operator_schedule.h"

namespace tetmend::viewer {

namespace {

/// Those that a schedule knows and takes.
ScheduleSettings valid_settings(const ScheduleInfo& info, const ScheduleSettings& settings) {
  ScheduleSettings valid;
  for (const auto& setting : settings) {
    try {
      check_settings(info, {setting});
      valid.push_back(setting);
    } catch (const Error&) {  // of another schedule
    }
  }
  return valid;
}

}  // namespace

LiveRun::LiveRun()
    : name_(builtin_schedule_names().front()), info_(Schedule::builtin(name_).describe()) {}

Schedule LiveRun::load(const std::string& name_or_file) {
  Schedule schedule = find_schedule(registry_, name_or_file);
  info_ = schedule.describe();
  settings_ = valid_settings(info_, settings_);
  return schedule;
}

void LiveRun::load_plugins(std::span<const std::filesystem::path> files) {
  for (const auto& file : files) {
    for (const OperatorInfo* info : load_plugin(file, registry_).operators) {
      plugin_operators_.emplace_back(info->name);
    }
    plugins_.push_back(file);
  }
}

std::vector<Condition> LiveRun::conditions() const {
  std::vector<Condition> conditions;
  for (const Breakpoint& breakpoint : breakpoints) {
    if (breakpoint.on) conditions.push_back(breakpoint.condition);
  }
  return conditions;
}

void LiveRun::tell_breakpoints() {
  if (job_) job_->set_breakpoints(conditions());
}

void LiveRun::set_speed(double changes_a_second) {
  if (!(changes_a_second >= 0)) throw Error("live_speed: changes a second, 0 for no limit");
  speed_ = changes_a_second;
  if (job_) job_->set_speed(speed_);
}

void LiveRun::choose_schedule(const std::string& name_or_file) {
  load(name_or_file);
  name_ = name_or_file;
}

void LiveRun::set(const std::string& parameter, const std::string& value) {
  check_settings(info_, {{parameter, value}});
  std::erase_if(settings_, [&](const auto& setting) { return setting.first == parameter; });
  settings_.emplace_back(parameter, value);
}

std::string LiveRun::value_of(const ScheduleParameter& parameter) const {
  for (const auto& setting : settings_) {
    if (setting.first == parameter.name) return setting.second;
  }
  return parameter.initial_text();
}

/// The trace of a run before may be opened: it can be recorded again.
void LiveRun::check_trace(const std::filesystem::path& mesh) const {
  formats::RunFiles files;
  if (!format_name(mesh).empty()) files.read({"the mesh", {source_files(mesh), {}}});
  if (std::filesystem::path(name_).extension() == ".lua") {
    files.read({"the schedule", {{name_}, {}}});
  }
  files.write({"the trace", {{trace}, {}}});
  if (const auto clash = files.clash()) {
    throw Error(fmt::format("{}: {} and {} would be the same file", clash->file.string(),
                            clash->option, clash->output));
  }
}

void LiveRun::start(Input shown, From from, const std::filesystem::path& file) {
  if (is_active()) throw Error("a run is at work: stop it first");
  check_trace(file);
  Schedule schedule = load(name_);  // the file may have changed
  LivePlan plan{.options = options_for(schedule, shown.mesh.standard()),
                .schedule = std::move(schedule),
                .input = file,
                .trace = trace,
                .paused = paused,
                .speed = speed_,
                .breakpoints = conditions()};
  if (!input_) input_ = std::make_unique<Input>(shown);
  if (input_->mesh.standard() != shown.mesh.standard()) {
    Input judged = *input_;
    judged.mesh.set_standard(shown.mesh.standard());
    judged.statistics = compute_statistics(judged.mesh, judged.mesh.standard().goal());
    input_ = std::make_unique<Input>(std::move(judged));
  }
  const Standard standard = shown.mesh.standard();
  const auto& data = from == From::shown ? shown.data : input_->data;
  MeshData mesh = data                  ? *data
                  : from == From::shown ? std::move(shown.mesh).to_data()
                                        : input_->mesh.to_data();
  job_.reset();
  job_ = std::make_unique<LiveJob>(std::move(mesh), standard, std::move(plan));
}

/// Those of a `tetmend improve` that gives the same mesh.
Options LiveRun::options_for(const Schedule& schedule, const Standard& standard) const {
  Options options;
  if (name_.starts_with(kOperatorPrefix)) {
    options.script = schedule.text();
  } else {
    options.schedule = name_;
  }
  options.set = settings_;
  options.plugin = plugins_;
  options.goal = standard.goal();
  options.measure = standard.measure_name();
  options.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 1024U));
  return options;
}

void LiveRun::ask(Demand demand) {
  if (!is_active()) throw Error("no run is at work");
  job_->ask(demand);
}

std::shared_ptr<const MeshData> LiveRun::whole_data() const {
  return job_ ? job_->whole_data() : nullptr;
}

std::string LiveRun::last_calls() const {
  if (!job_) throw Error("there was no run yet");
  return job_->last_calls();
}

void LiveRun::hold_parameter(const ParameterHold& change) {
  if (!is_active()) throw Error("no run is at work");
  Registry tried = registry_;
  tried.hold(change.operator_name, change.parameter, change.value);
  job_->hold_parameter(change);
}

void LiveRun::forget() {
  job_.reset();
  input_.reset();
}

bool LiveRun::is_active() const {
  const LiveState now = state();
  return now == LiveState::running || now == LiveState::paused || now == LiveState::stopping;
}

}  // namespace tetmend::viewer
