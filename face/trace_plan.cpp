// SPDX-License-Identifier: MIT
// Whether a run is recorded, and what of it.
#include "face/trace_plan.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/formats/pending_file.h"
#include "kernel/formats/run_files.h"
#include "kernel/from_chars.h"
#include "trace/surface_setting.h"

namespace tetmend::face {

namespace {

constexpr const char* kAround = "trace_around";
constexpr const char* kPiece = "trace_piece";

OptionError around_error(std::string_view reason) {
  return {kAround, fmt::format("{}: {}", kAround, reason)};
}

template <class T>
T read_number(std::string_view text) {
  T value{};
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  bool good = error == std::errc() && end == text.data() + text.size();
  if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
  if (good) return value;
  throw around_error(fmt::format("'{}' is not a number in TET, TET,RADIUS or X,Y,Z,RADIUS", text));
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

// What belongs to a trace means nothing without one.
void check_needs(const Options& options) {
  if (!options.trace.empty()) return;
  const auto refuse = [](const char* name) {
    throw OptionError(name, fmt::format("{}: it needs the option trace", name));
  };
  if (!options.trace_piece.empty()) refuse(kPiece);
  if (!options.trace_around.empty()) refuse(kAround);
  if (!options.trace_operator.empty()) refuse("trace_operator");
  if (options.trace_depth >= 0) refuse("trace_depth");
  if (options.trace_limit > 0) refuse("trace_limit");
}

}  // namespace

std::optional<TracedPiece> TracedPiece::of(const Options& options) {
  const std::string_view text = options.trace_piece;
  if (text.empty()) return std::nullopt;
  const auto read = [&](std::string_view word) {
    std::uint32_t number = 0;
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc() && end == word.data() + word.size()) return number;
    throw OptionError(
        kPiece, fmt::format("{}: '{}' is not of the form ROUND or ROUND:PIECE", kPiece, text));
  };
  TracedPiece made;
  const std::size_t colon = text.find(':');
  made.round = read(text.substr(0, colon));
  if (colon != std::string_view::npos) made.piece = read(text.substr(colon + 1));
  return made;
}

TracePlan::TracePlan(const Options& options, const Registry& registry) : file_(options.trace) {
  for (const std::string& name : options.trace_operator) {
    try {
      registry.find(name);
    } catch (const Error& error) {
      throw OptionError("trace_operator", fmt::format("trace_operator: {}", error.what()));
    }
  }
  if (options.surface != "fixed") surface_ = options.surface;
  filter_.operators = options.trace_operator;
  if (options.trace_depth >= 0) filter_.depth = static_cast<unsigned>(options.trace_depth);
  if (options.trace_limit > 0) filter_.most_bytes = options.trace_limit;
  if (!options.trace_around.empty()) read_around(options.trace_around);
  check_needs(options);
  TracedPiece::of(options);
  if (!file_.empty()) const formats::PendingFile probe(file_);  // vanishes without commit()
}

void TracePlan::check_files(const Options& options, const std::filesystem::path& input) {
  if (options.trace.empty()) return;
  formats::RunFiles files;
  const std::filesystem::path schedule = options.schedule;
  if (!input.empty()) files.read({"the mesh", {source_files(input), {}}});
  if (schedule.extension() == ".lua") files.read({"the schedule", {{schedule}, {}}});
  files.read({"a plugin", {options.plugin, {}}});
  files.write({"the trace", {{options.trace}, {}}});
  if (const auto clash = files.clash()) {
    throw OptionError("trace", fmt::format("trace: {}: {} and {} would be the same file",
                                           clash->file.string(), clash->option, clash->output));
  }
}

void TracePlan::read_around(std::string_view text) {
  const auto parts = split(text);
  if (parts.size() != 1 && parts.size() != 2 && parts.size() != 4) {
    throw around_error(
        fmt::format("'{}' is not of the form TET, TET,RADIUS or X,Y,Z,RADIUS", text));
  }
  filter_.around.emplace();
  if (parts.size() == 4) {
    for (int axis = 0; axis < 3; ++axis) {
      filter_.around->centre[axis] = read_number<double>(parts[static_cast<std::size_t>(axis)]);
    }
  } else {
    tet_ = read_number<std::uint64_t>(parts[0]);
  }
  if (parts.size() > 1) {
    filter_.around->radius = read_number<double>(parts.back());
    if (filter_.around->radius <= 0) {
      throw around_error(fmt::format("the radius {} is not positive", parts.back()));
    }
  }
}

void TracePlan::locate(const MeshData& data) {
  if (!tet_) return;
  if (*tet_ >= data.tets.size()) {
    throw around_error(fmt::format("there is no tet {}; the mesh has {}, counted from 0", *tet_,
                                   data.tets.size()));
  }
  std::array<Point, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = data.points[data.tets[*tet_].vertices[i]];
  locate(corners);
}

void TracePlan::locate(const std::array<Point, 4>& corners) {
  const Scale scale = Scale::of(corners);
  Point centre = Point::Zero();
  double longest = 0;
  for (const Point& p : corners) {
    centre += scale.to_work(p) / 4;
    for (const Point& q : corners) {
      longest = std::max(longest, (scale.to_work(p) - scale.to_work(q)).norm());
    }
  }
  filter_.around->centre = scale.to_file(centre);
  if (filter_.around->radius == 0) filter_.around->radius = scale.to_file(longest);
  tet_.reset();
}

std::optional<Point> TracePlan::place() const {
  if (!filter_.around || tet_) return std::nullopt;
  return filter_.around->centre;
}

TraceHeader TracePlan::header(const std::filesystem::path& input, const Schedule& schedule,
                              const ScheduleSettings& settings) const {
  TraceHeader header;
  header.program = fmt::format("tetmend {}", version());
  header.input = input.string();
  header.schedule = schedule.name();
  header.schedule_text = schedule.text();
  header.settings = settings;
  if (!surface_.empty()) header.settings.emplace_back(kSurfaceSetting, surface_);
  return header;
}

std::unique_ptr<TraceRecorder> TracePlan::start(const TetMesh& mesh,
                                                const std::filesystem::path& input,
                                                const Schedule& schedule,
                                                const ScheduleSettings& settings) const {
  if (file_.empty()) return nullptr;
  return std::make_unique<TraceRecorder>(file_, mesh, header(input, schedule, settings), filter_);
}

std::unique_ptr<TraceRecorder> TracePlan::start_piece(const TetMesh& mesh,
                                                      const std::filesystem::path& input,
                                                      const Schedule& schedule,
                                                      const ScheduleSettings& settings,
                                                      const ScheduleSettings& piece) const {
  if (file_.empty()) return nullptr;
  TraceHeader made = header(input, schedule, settings);
  made.settings.insert(made.settings.end(), piece.begin(), piece.end());
  return std::make_unique<TraceRecorder>(file_, mesh, std::move(made), filter_, TraceClock::steps);
}

}  // namespace tetmend::face
