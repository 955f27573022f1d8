// SPDX-License-Identifier: MIT
// What there is to improve a mesh with.
#include <tetmend/catalogue.h>

#include "face/registry.h"
#include "schedule/schedule.h"

namespace tetmend {

namespace {

OperatorDescription::Parameter describe_parameter(const ParameterSpec& spec) {
  using Kind = OperatorDescription::Parameter::Kind;
  OperatorDescription::Parameter parameter;
  parameter.name = spec.name;
  parameter.kind = spec.kind == ParameterSpec::Kind::flag      ? Kind::flag
                   : spec.kind == ParameterSpec::Kind::integer ? Kind::integer
                                                               : Kind::real;
  parameter.low = spec.low;
  parameter.high = spec.high;
  parameter.initial = spec.initial;
  parameter.help = spec.help;
  return parameter;
}

}  // namespace

std::vector<ScheduleInfo> schedules() {
  std::vector<ScheduleInfo> all;
  for (const std::string_view name : builtin_schedule_names()) {
    all.push_back(Schedule::builtin(name).describe());
  }
  return all;
}

ScheduleInfo describe_schedule(const std::string& name_or_file) {
  return Schedule::find(name_or_file).describe();
}

std::string schedule_source(const std::string& name_or_file) {
  return Schedule::find(name_or_file).text();
}

std::vector<OperatorDescription> operators(const std::vector<std::filesystem::path>& plugins) {
  const Registry registry = face::load_registry(plugins);
  std::vector<OperatorDescription> all;
  for (const OperatorInfo* info : registry.operators()) {
    OperatorDescription description;
    description.name = info->name;
    description.target = to_string(info->target);
    description.help = info->help;
    description.plugin = registry.origin(info->name);
    for (const ParameterSpec& spec : info->parameters) {
      description.parameters.push_back(describe_parameter(spec));
    }
    all.push_back(std::move(description));
  }
  return all;
}

std::string_view version() {
  return TETMEND_VERSION;
}

}  // namespace tetmend
