// SPDX-License-Identifier: MIT
// Whether a run is recorded, and what of it.
#include "face/trace_plan.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "kernel/formats/pending_file.h"
#include "kernel/from_chars.h"
#include "trace/surface_setting.h"

namespace tetmend::face {

namespace {

constexpr const char* kAround = "trace_around";

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
  if (!options.trace_around.empty()) refuse(kAround);
  if (!options.trace_operator.empty()) refuse("trace_operator");
  if (options.trace_depth >= 0) refuse("trace_depth");
  if (options.trace_limit > 0) refuse("trace_limit");
}

}  // namespace

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
  if (!file_.empty()) const formats::PendingFile probe(file_);  // vanishes without commit()
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
  const Scale scale = Scale::of(data.points);
  const auto corner = [&](std::uint32_t v) { return scale.to_work(data.points[v]); };
  const auto& corners = data.tets[*tet_].vertices;
  Point centre = Point::Zero();
  double longest = 0;
  for (const std::uint32_t v : corners) {
    centre += corner(v) / 4;
    for (const std::uint32_t w : corners)
      longest = std::max(longest, (corner(v) - corner(w)).norm());
  }
  filter_.around->centre = scale.to_file(centre);
  if (filter_.around->radius == 0) filter_.around->radius = scale.to_file(longest);
}

std::unique_ptr<TraceRecorder> TracePlan::start(const TetMesh& mesh,
                                                const std::filesystem::path& input,
                                                const Schedule& schedule,
                                                const ScheduleSettings& settings) const {
  if (file_.empty()) return nullptr;
  TraceHeader header;
  header.program = fmt::format("tetmend {}", version());
  header.input = input.string();
  header.schedule = schedule.name();
  header.schedule_text = schedule.text();
  header.settings = settings;
  if (!surface_.empty()) header.settings.emplace_back(kSurfaceSetting, surface_);
  return std::make_unique<TraceRecorder>(file_, mesh, std::move(header), filter_);
}

}  // namespace tetmend::face
