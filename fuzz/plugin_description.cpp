// SPDX-License-Identifier: MIT
// What a plugin says of its operators: refused with an Error of one line, or good for everything
// that is done with a description. A line for each field: the name, the help, then parameters
// "NAME KIND LOW HIGH INITIAL HELP".
#include <cstdlib>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/target.h"
#include "kernel/error.h"
#include "ops/registry.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

std::string word_of(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  std::string word(line.substr(0, end));
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

std::unique_ptr<Operator> make_nothing(const ParameterValues& values) {
  require_one_line(values.describe().empty() ? "none" : values.describe());
  return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  std::deque<std::string> texts;  // what the description points at
  const auto keep = [&](std::string_view text) -> std::string_view {
    return texts.emplace_back(text);
  };
  OperatorInfo info{};
  info.target = static_cast<TargetKind>(bytes.below(5));
  info.make = bytes.below(8) == 0 ? nullptr : make_nothing;
  info.name = keep(bytes.line());
  info.help = keep(bytes.line());
  std::vector<ParameterSpec> parameters;
  while (!bytes.empty()) {
    std::string_view line = bytes.line();
    ParameterSpec spec{};
    spec.name = keep(word_of(line));
    spec.kind =
        static_cast<ParameterSpec::Kind>(std::strtol(word_of(line).c_str(), nullptr, 10) % 4);
    spec.low = std::strtod(word_of(line).c_str(), nullptr);
    spec.high = std::strtod(word_of(line).c_str(), nullptr);
    spec.initial = std::strtod(word_of(line).c_str(), nullptr);
    spec.help = keep(line);
    parameters.push_back(spec);
  }
  info.parameters = parameters;
  Registry registry = Registry::builtin();
  const std::size_t known = registry.operators().size();
  try {
    registry.add(info, "stranger.so");
    require(registry.operators().size() == known + 1, "what was added is there");
    require_one_line(info.name);
    require_one_line(info.help);
    ParameterSettings settings;
    for (const ParameterSpec& spec : parameters) settings.emplace_back(spec.name, spec.initial);
    registry.make(info.name, settings);
  } catch (const Error& error) {
    require_one_line(error.what());
  }
  return 0;
}
