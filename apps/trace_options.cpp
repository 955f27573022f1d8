// SPDX-License-Identifier: MIT
#include "apps/trace_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/files.h"

namespace tetmend::apps {
namespace {

template <class T>
T read_number(std::string_view text, std::string_view option, std::string_view expected) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  bool good = error == std::errc() && end == text.data() + text.size();
  if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
  if (!good) throw UsageError(fmt::format("{}: '{}' is not {}", option, text, expected));
  return value;
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

/// 5000, 500K, 500M, 5G.
std::size_t read_size(std::string_view text) {
  constexpr std::string_view kUnits = "KMG";
  constexpr std::string_view kExpected = "a size such as 500M (K, M or G)";
  std::size_t unit = 1;
  std::string_view digits = text;
  if (const std::size_t i = text.empty() ? kUnits.npos : kUnits.find(text.back());
      i != kUnits.npos) {
    digits.remove_suffix(1);
    for (std::size_t k = 0; k <= i; ++k) unit *= 1000;
  }
  constexpr std::string_view kOption = "--trace-limit";
  const auto count = read_number<std::size_t>(digits, kOption, kExpected);
  if (count == 0 || count > std::size_t{1} << 50) {
    throw UsageError(fmt::format("{}: '{}' is not {}", kOption, text, kExpected));
  }
  return count * unit;
}

}  // namespace

void add_trace_options(CLI::App& command, TraceOptions& options) {
  CLI::Option* trace =
      command
          .add_option("--trace", options.file,
                      "Record all that happens, for 'tetmend\ntrace'; the run uses one thread then")
          ->type_name("FILE");
  command
      .add_option("--trace-around", options.around,
                  "Record only attempts that aim at a vertex\nin a ball: around a point, or "
                  "around tet N\nof IN, counted from 0 (radius: its\nlongest edge, if not given)")
      ->type_name("TET[,R]|X,Y,Z,R")
      ->needs(trace);
  command
      .add_option("--trace-operator", options.operators,
                  "Record only attempts of this operator, with\nall that they call; may be "
                  "given several\ntimes")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->needs(trace);
  command
      .add_option("--trace-depth", options.depth,
                  "Record only attempts with at most that many\nattempts around them; 0: the "
                  "outermost")
      ->type_name("N")
      ->check(CLI::Range(0, 1000).description(""))
      ->needs(trace);
  command
      .add_option("--trace-limit", options.limit,
                  "End the trace before it is larger, such as\n500M; the run goes on")
      ->type_name("SIZE")
      ->needs(trace);
}

TracePlan::TracePlan(const TraceOptions& options, const Registry& registry) : file_(options.file) {
  for (const std::string& name : options.operators) {
    try {
      registry.find(name);
    } catch (const Error& error) {
      throw UsageError(fmt::format("--trace-operator: {}", error.what()));
    }
  }
  filter_.operators = options.operators;
  if (options.depth >= 0) filter_.depth = static_cast<unsigned>(options.depth);
  if (!options.limit.empty()) filter_.most_bytes = read_size(options.limit);
  if (!options.around.empty()) {
    constexpr std::string_view kOption = "--trace-around";
    constexpr std::string_view kNumber = "a number in TET, TET,RADIUS or X,Y,Z,RADIUS";
    const auto parts = split(options.around);
    if (parts.size() != 1 && parts.size() != 2 && parts.size() != 4) {
      throw UsageError(fmt::format("{}: '{}' is not of the form TET, TET,RADIUS or X,Y,Z,RADIUS",
                                   kOption, options.around));
    }
    filter_.around.emplace();
    if (parts.size() == 4) {
      for (int axis = 0; axis < 3; ++axis) {
        filter_.around->centre[axis] =
            read_number<double>(parts[static_cast<std::size_t>(axis)], kOption, kNumber);
      }
    } else {
      tet_ = read_number<std::uint64_t>(parts[0], kOption, kNumber);
    }
    if (parts.size() > 1) {
      filter_.around->radius = read_number<double>(parts.back(), kOption, kNumber);
      if (filter_.around->radius <= 0) {
        throw UsageError(fmt::format("{}: the radius {} is not positive", kOption, parts.back()));
      }
    }
  }
  if (!file_.empty()) check_writable(file_);
}

void TracePlan::locate(const MeshData& data) {
  if (!tet_) return;
  if (*tet_ >= data.tets.size()) {
    throw Error(fmt::format("--trace-around: there is no tet {}; the mesh has {}, counted from 0",
                            *tet_, data.tets.size()));
  }
  const auto& corners = data.tets[*tet_].vertices;
  Point centre = Point::Zero();
  double longest = 0;
  for (const std::uint32_t v : corners) {
    centre += data.points[v] / 4;
    for (const std::uint32_t w : corners) {
      longest = std::max(longest, (data.points[v] - data.points[w]).norm());
    }
  }
  filter_.around->centre = centre;
  if (filter_.around->radius == 0) filter_.around->radius = longest;
}

std::unique_ptr<TraceRecorder> TracePlan::start(const TetMesh& mesh,
                                                const std::filesystem::path& input,
                                                const ChosenSchedule& chosen) const {
  if (file_.empty()) return nullptr;
  TraceHeader header;
  header.program = "tetmend " TETMEND_VERSION;
  header.input = input.string();
  header.schedule = chosen.schedule.name();
  header.schedule_text = chosen.schedule.text();
  header.settings = chosen.settings;
  return std::make_unique<TraceRecorder>(file_, mesh, std::move(header), filter_);
}

}  // namespace tetmend::apps
