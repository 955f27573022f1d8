// SPDX-License-Identifier: MIT
// A run that a person watches and may interrupt, and what it reports.
#include "apps/improve_watched.h"

#include <mutex>

#include <nlohmann/json.hpp>
#include <tetmend/option_text.h>

#include "apps/commands.h"
#include "apps/plugin_watch.h"
#include "report/page.h"

namespace tetmend::apps {

Result improve_watched(const ImproveOptions& all, ProgressLine& line,
                       std::optional<Interruption>& interruption,
                       const std::function<Result(const Options&)>& work) {
  Options options = all.run;
  std::mutex line_busy;  // the watch has a thread of its own
  std::optional<PluginWatch> watch;
  if (!options.plugin.empty()) {
    note_crashes();
    const PluginWatch::Limits limits{.attempt = all.attempt_limit, .time = options.time_limit};
    watch.emplace(limits, [&](std::string_view text) {
      const std::lock_guard lock(line_busy);
      line.clear();
      complain(kSuccess, text);
    });
  }
  options.cancel = &Interruption::requested();
  options.progress = [&](const Progress& progress) {
    if (progress.stage == Stage::improving && !interruption) interruption.emplace();
    if (watch) watch->show(progress.stage);
    const std::lock_guard lock(line_busy);
    line.show(progress);
    return true;
  };
  options.note = [&](std::string_view text) {
    const std::lock_guard lock(line_busy);
    line.note(text);
  };
  try {
    return work(options);
  } catch (const OptionError& error) {
    throw Error("--" + message_of(error));
  }
}

std::vector<std::unique_ptr<OutputFile>> make_reports(
    const std::vector<std::filesystem::path>& files, const ImproveReport& report) {
  std::vector<std::unique_ptr<OutputFile>> made;
  if (files.empty()) return made;
  const nlohmann::json json = printable_for(files.front().string(), to_json(report));
  for (const std::filesystem::path& file : files) {
    OutputFile& out = *made.emplace_back(std::make_unique<OutputFile>(file));
    out.put(lower_extension(file) == ".json" ? json.dump(2) + '\n'
                                             : report::write_page(json, report.portrait));
    out.finish();
  }
  return made;
}

void write_reports(const std::vector<std::filesystem::path>& files, const ImproveReport& report) {
  for (const auto& each : make_reports(files, report)) each->commit();
}

}  // namespace tetmend::apps
