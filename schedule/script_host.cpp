// SPDX-License-Identifier: MIT
#include "schedule/script_host.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/statistics.h"
#include "schedule/limit/surface_limit.h"
#include "schedule/lua_library.h"
#include "schedule/printable.h"
#include "schedule/single_attempt.h"

namespace tetmend {

namespace {

/// Ten million instructions: a script that only declares is done long before.
constexpr std::size_t kMostWatchesToDescribe = 10000;
/// Where each instruction copies megabytes.
constexpr std::chrono::seconds kMostTimeToDescribe{2};

/// Of one byte that is written as \x1b.
constexpr std::size_t kMostBytesShown = 4;

constexpr const char* kQualityTable = "tetmend quality";

ScriptValue read_table(lua_State* lua, int index, const WordInfo& word) {
  ScriptValue value = read_value(lua, index);
  if (value.kind == ScriptValue::Kind::nothing) value.kind = ScriptValue::Kind::table;
  if (value.kind != ScriptValue::Kind::table) {
    throw Error(fmt::format("{} takes named arguments in braces, not {}: {}", word.name,
                            value.quoted(), word.usage));
  }
  return value;
}

/// "name" or {"name", ...} or false.
std::string read_operator_name(const Registry& registry, const Subject& subject,
                               const ScriptValue& value, Composition& composition) {
  if (value.kind == ScriptValue::Kind::flag && value.number == 0) return {};
  composition = read_composition(registry, subject, value);
  if (composition.kind != Composition::Kind::one) {
    throw Error(fmt::format("{} must be one operator or false", subject.text));
  }
  return composition.operator_name;
}

/// Of an attempt: {number, ...}.
std::vector<std::uint32_t> read_vertices(const ScriptValue& value) {
  std::vector<std::uint32_t> vertices;
  for (const ScriptValue& item : value.list) {
    const double number = read_number({"attempt: vertex"}, item);
    if (!item.is_integer || number < 0 || number >= 0xFFFFFFFFu) {
      throw Error(fmt::format("attempt: {} is no number of a vertex", item.quoted()));
    }
    vertices.push_back(static_cast<std::uint32_t>(number));
  }
  return vertices;
}

/// {name = value, ...} as a user would write it behind --set.
ScheduleSettings read_settings(const WordInfo& word, const ScriptValue& value) {
  if (!value.list.empty()) {
    throw Error(fmt::format("{} takes named parameters only: {}", word.name, word.usage));
  }
  ScheduleSettings settings;
  for (const auto& [name, field] : value.fields) {
    switch (field.kind) {
      case ScriptValue::Kind::number:
        settings.emplace_back(name, fmt::format("{}", field.number));
        break;
      case ScriptValue::Kind::flag:
        settings.emplace_back(name, field.number != 0 ? "true" : "false");
        break;
      default:
        settings.emplace_back(name, read_text(Subject{std::string(word.name)}.of(name), field));
    }
  }
  return settings;
}

std::size_t memory_of(const ScheduleParameter& parameter) {
  std::size_t bytes = sizeof(parameter) + parameter.name.size() + parameter.help.size();
  for (const std::string& choice : parameter.choices) bytes += sizeof(choice) + choice.size();
  return bytes;
}

bool is_place_in_list(lua_State* lua, int index, lua_Integer length) {
  if (lua_isinteger(lua, index) == 0) return false;
  const lua_Integer place = lua_tointeger(lua, index);
  return place >= 1 && place <= length;
}

QualityIndicators read_indicators(const Subject& subject, const ScriptValue& value) {
  const auto number = [&](std::string_view name) {
    const ScriptValue* field = value.field(name);
    if (field == nullptr) {
      throw Error(
          fmt::format("{} needs what quality() returns: there is no {}", subject.text, name));
    }
    return read_number(subject.of(name), *field);
  };
  return {number("q_worst"), static_cast<std::size_t>(std::max(0.0, number("n_bad"))),
          number("q_aver")};
}

}  // namespace

ScriptHost::ScriptHost(Run* run, const ScheduleSettings& settings)
    : run_(run), settings_(settings), lua_({}, [this] { watch(); }) {
  add_words();
}

void ScriptHost::execute(const Schedule& schedule) {
  info_.name = schedule.name();
  try {
    lua_.run(schedule.text(), schedule.name());
    if (run_ != nullptr && !working_) check_settings(info_, settings_);
  } catch (const ScriptStop&) {
  }
}

void ScriptHost::watch() {
  if (run_ == nullptr) {
    const bool is_late = std::chrono::steady_clock::now() - start_ > kMostTimeToDescribe;
    if (++watches_ > kMostWatchesToDescribe || is_late) throw ScriptStop();
    return;
  }
  run_->check_time();
  if (run_->cancelled()) throw ScriptStop();
}

void ScriptHost::begin_work() {
  if (run_ == nullptr) throw ScriptStop();
  if (!working_) check_settings(info_, settings_);
  working_ = true;
  watch();
}

void ScriptHost::add_words() {
  const auto add = [&](const char* name, auto member) {
    lua_.add_word(name, [this, member](lua_State* lua) { return (this->*member)(lua); });
  };
  add("description", &ScriptHost::describe);
  add("parameter", &ScriptHost::declare);
  add("begin_round", &ScriptHost::begin_round);
  add("run_schedule", &ScriptHost::run_schedule);
  add("local_reconnection", &ScriptHost::local_reconnection);
  add("smooth", &ScriptHost::smooth);
  add("suppress_points", &ScriptHost::suppress_points);
  add("insert_points", &ScriptHost::insert_points);
  add("polish", &ScriptHost::polish);
  add("untangle", &ScriptHost::untangle);
  add("apply", &ScriptHost::apply);
  add("attempt", &ScriptHost::attempt);
  for (const char* how : {"first_of", "all_of", "sequence"}) {
    lua_.add_word(how, [this, how](lua_State* lua) { return compose(lua, how); });
  }
  add("goal", &ScriptHost::goal);
  add("judge_by", &ScriptHost::judge_by);
  add("quality_of_angle", &ScriptHost::quality_of_angle);
  add("quality", &ScriptHost::quality);
  add("limit", &ScriptHost::limit);
  add("is_progress", &ScriptHost::is_progress);
  add("operators", &ScriptHost::operators);
  add("log", &ScriptHost::log);
  add("print", &ScriptHost::log);

  luaL_newmetatable(lua_.get(), kQualityTable);
  lua_.push_function([this](lua_State* lua) { return measure(lua); });
  lua_setfield(lua_.get(), -2, "__index");
  lua_pop(lua_.get(), 1);
}

// ---- Declarations -------------------------------------------------------------------------------

int ScriptHost::describe(lua_State* lua) {
  info_.description = printable(read_text({"description"}, read_value(lua, 1)));
  hold_for_good(lua, info_.description.size());
  return 0;
}

int ScriptHost::declare(lua_State* lua) {
  if (working_) throw Error("parameter: to be declared before the first pass");
  const ScriptValue value = read_table(lua, 1, find_word("parameter"));
  charge_steps(lua, info_.parameters.size());
  const ScheduleParameter& parameter =
      info_.parameters.emplace_back(read_parameter(value, info_.parameters));
  hold_for_good(lua, memory_of(parameter));
  const auto [number, text] = chosen_value(parameter, settings_);
  switch (parameter.kind) {
    case ScheduleParameter::Kind::integer:
      lua_pushinteger(lua, static_cast<lua_Integer>(number));
      break;
    case ScheduleParameter::Kind::real:
      lua_pushnumber(lua, number);
      break;
    case ScheduleParameter::Kind::flag:
      lua_pushboolean(lua, number != 0);
      break;
    case ScheduleParameter::Kind::choice:
      lua_pushstring(lua, text.c_str());
      break;
  }
  return 1;
}

// ---- Passes -------------------------------------------------------------------------------------

int ScriptHost::begin_round(lua_State* lua) {
  begin_work();
  lua_pushinteger(lua, ++run_->round);
  return 1;
}

/// In an interpreter of its own. A script can run a built-in schedule only, so that none can run
/// itself.
int ScriptHost::run_schedule(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("run_schedule");
  const Schedule schedule = Schedule::builtin(read_text({"run_schedule"}, read_value(lua, 1)));
  const ScheduleSettings settings = read_settings(word, read_table(lua, 2, word));
  ScriptHost(run_, settings).execute(schedule);
  watch();
  return 0;
}

ScriptHost::Arguments ScriptHost::read_arguments(const WordInfo& word, const ScriptValue& value,
                                                 const std::vector<std::string>& operators) const {
  Arguments arguments;
  arguments.of_operators.resize(operators.size());
  if (!value.list.empty()) {
    throw Error(fmt::format("{} takes named arguments only: {}", word.name, word.usage));
  }
  for (const ScriptValue::Field& entry : value.fields) {
    const std::string& name = entry.name;
    const ScriptValue& argument = entry.value;
    const Subject subject = Subject{std::string(word.name)}.of(name);
    if (name == "on") {
      arguments.on = read_selection(subject, argument);
      continue;
    }
    const bool is_field = std::any_of(word.fields.begin(), word.fields.end(),
                                      [&](const WordField& field) { return field.name == name; });
    if (is_field) continue;  // read by the word itself
    bool known = read_setting(subject, word.numbers, name, argument, arguments.numbers);
    for (std::size_t i = 0; i < operators.size() && !known; ++i) {
      if (operators[i].empty()) continue;
      known = read_setting(subject, run_->registry().find(operators[i]).parameters, name, argument,
                           arguments.of_operators[i]);
    }
    if (known) continue;
    std::vector<std::string_view> valid;
    for (const WordField& field : word.fields) valid.push_back(field.name);
    for (const ParameterSpec& spec : word.numbers) valid.push_back(spec.name);
    for (const std::string& op : operators) {
      if (op.empty()) continue;
      for (const ParameterSpec& spec : run_->registry().find(op).parameters) {
        valid.push_back(spec.name);
      }
    }
    throw Error(fmt::format("{} has no parameter '{}'; valid: {}", word.name, name,
                            fmt::join(valid, ", ")));
  }
  return arguments;
}

template <class Pass>
int ScriptHost::make_pass(lua_State* lua, const Pass& pass) {
  const std::size_t passes = run_->records.size();
  pass();
  const bool was_made = run_->records.size() > passes;
  const PassRecord record = was_made ? run_->records.back() : PassRecord{};
  lua_pushinteger(lua, static_cast<lua_Integer>(record.accepted()));
  lua_pushinteger(lua, static_cast<lua_Integer>(record.attempts()));
  return 2;
}

int ScriptHost::local_reconnection(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("local_reconnection");
  const ScriptValue value = read_table(lua, 1, word);
  LocalReconnectionOptions options;
  Composition edges;
  Composition faces;
  if (const ScriptValue* field = value.field("edges")) {
    options.edge_operator =
        read_operator_name(run_->registry(), {"local_reconnection: edges"}, *field, edges);
  }
  if (const ScriptValue* field = value.field("faces")) {
    options.face_operator =
        read_operator_name(run_->registry(), {"local_reconnection: faces"}, *field, faces);
  }
  Arguments arguments = read_arguments(word, value, {options.edge_operator, options.face_operator});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  options.on = std::move(arguments.on);
  options.edge_settings = std::move(edges.settings);
  options.edge_order = edges.order;
  options.most_edges = edges.most_edges;
  options.face_settings = std::move(faces.settings);
  for (auto& setting : arguments.of_operators[0]) options.edge_settings.push_back(setting);
  for (auto& setting : arguments.of_operators[1]) options.face_settings.push_back(setting);
  options.sweeps = static_cast<unsigned>(numbers.integer("sweeps"));
  return make_pass(lua, [&] { tetmend::local_reconnection(*run_, options); });
}

int ScriptHost::smooth(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("smooth");
  Arguments arguments = read_arguments(word, read_table(lua, 1, word), {"smoothing"});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  SmoothOptions options;
  options.on = std::move(arguments.on);
  options.settings = std::move(arguments.of_operators[0]);
  options.cycles = static_cast<unsigned>(numbers.integer("cycles"));
  return make_pass(lua, [&] { tetmend::smooth(*run_, options); });
}

int ScriptHost::suppress_points(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("suppress_points");
  Arguments arguments = read_arguments(word, read_table(lua, 1, word), {"edge_contraction"});
  return make_pass(lua, [&] {
    tetmend::suppress_points(*run_,
                             {std::move(arguments.on), std::move(arguments.of_operators[0])});
  });
}

int ScriptHost::insert_points(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("insert_points");
  Arguments arguments = read_arguments(word, read_table(lua, 1, word), {"edge_split"});
  return make_pass(lua, [&] {
    tetmend::insert_points(*run_, {std::move(arguments.on), std::move(arguments.of_operators[0])});
  });
}

int ScriptHost::polish(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("polish");
  const Arguments arguments = read_arguments(word, read_table(lua, 1, word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const PolishOptions options = {.below = numbers.real("below"),
                                 .cycles = static_cast<unsigned>(numbers.integer("cycles"))};
  return make_pass(lua, [&] { tetmend::polish(*run_, options); });
}

int ScriptHost::untangle(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("untangle");
  const Arguments arguments = read_arguments(word, read_table(lua, 1, word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const UntangleOptions options = {
      .where = {.share = numbers.real("share"),
                .at_least = static_cast<std::size_t>(numbers.integer("at_least")),
                .rings = static_cast<unsigned>(numbers.integer("rings"))},
      .looks = static_cast<unsigned>(numbers.integer("looks"))};
  return make_pass(lua, [&] { tetmend::untangle(*run_, options); });
}

int ScriptHost::apply(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("apply");
  ApplyOptions options;
  options.what = read_composition(run_->registry(), {"apply"}, read_value(lua, 1));
  Arguments arguments = read_arguments(word, read_table(lua, 2, word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  options.on = std::move(arguments.on);
  options.sweeps = static_cast<unsigned>(numbers.integer("sweeps"));
  options.again = numbers.flag("again");
  return make_pass(lua, [&] { tetmend::apply(*run_, options); });
}

int ScriptHost::attempt(lua_State* lua) {
  begin_work();
  const Composition what = read_composition(run_->registry(), {"attempt"}, read_value(lua, 1));
  if (what.kind != Composition::Kind::one && what.kind != Composition::Kind::sequence) {
    throw Error("attempt: must be one operator or a sequence");
  }
  const std::vector<std::uint32_t> vertices = read_vertices(read_value(lua, 2));
  std::vector<std::uint32_t> tet;
  if (!lua_isnoneornil(lua, 3)) tet = read_vertices(read_value(lua, 3));
  return make_pass(lua, [&] { attempt_once(*run_, {what, vertices, tet}); });
}

int ScriptHost::compose(lua_State* lua, const char* how) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  const auto length = static_cast<lua_Integer>(lua_rawlen(lua, 1));
  lua_newtable(lua);
  const int made = lua_gettop(lua);
  for (lua_Integer i = 1; i <= length; ++i) {
    charge_steps(lua, 1);
    lua_rawgeti(lua, 1, i);
    lua_rawseti(lua, made, i);
  }
  // What is no name is refused by the word that reads the table.
  for (lua_pushnil(lua); lua_next(lua, 1) != 0; lua_pop(lua, 1)) {
    charge_steps(lua, 1);
    if (is_place_in_list(lua, -2, length)) continue;
    lua_pushvalue(lua, -2);
    lua_pushvalue(lua, -2);
    lua_rawset(lua, made);
  }
  lua_pushstring(lua, how);
  lua_setfield(lua, -2, "how");
  return 1;
}

// ---- Questions ----------------------------------------------------------------------------------

int ScriptHost::quality(lua_State* lua) {
  begin_work();
  const QualityIndicators now = run_->indicators();
  lua_newtable(lua);
  const auto number = [&](const char* name, double value) {
    lua_pushnumber(lua, value);
    lua_setfield(lua, -2, name);
  };
  const auto count = [&](const char* name, std::size_t value) {
    lua_pushinteger(lua, static_cast<lua_Integer>(value));
    lua_setfield(lua, -2, name);
  };
  number("q_worst", now.q_worst);
  count("n_bad", now.n_bad);
  count("n_needles", now.n_needles);
  number("q_aver", now.q_aver);
  const Goal goal = run_->mesh().standard().goal();
  number("goal_min", goal.min_angle);
  number("goal_max", goal.max_angle);
  count("tets", run_->mesh().tet_count());
  count("vertices", run_->mesh().vertex_count());
  number("seconds", run_->seconds());
  count("passes", run_->records.size());
  luaL_setmetatable(lua, kQualityTable);
  return 1;
}

int ScriptHost::goal(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("goal");
  const Arguments arguments = read_arguments(word, read_table(lua, 1, word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const Standard now = run_->mesh().standard();
  Goal goal = now.goal();
  if (numbers.real("min") > 0) goal = Goal::symmetric(numbers.real("min"));
  if (numbers.real("max") > 0) goal.max_angle = numbers.real("max");
  if (!is_sound(goal)) {
    throw Error(fmt::format("goal: {},{} is no goal", goal.min_angle, goal.max_angle));
  }
  run_->set_standard(Standard(goal, now.terms(), now.price()));
  return 0;
}

int ScriptHost::judge_by(lua_State* lua) {
  begin_work();
  const WordInfo& word = find_word("judge_by");
  const ScriptValue value = read_table(lua, 1, word);
  const Arguments arguments = read_arguments(word, value, {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const Standard now = run_->mesh().standard();
  Standard::Terms terms = now.terms();
  if (const ScriptValue* measure = value.field("measure")) {
    terms = to_terms(read_text({"judge_by: measure"}, *measure));
  }
  run_->set_standard(Standard(now.goal(), terms, numbers.real("price")));
  return 0;
}

int ScriptHost::quality_of_angle(lua_State* lua) {
  begin_work();
  const double angle = read_number({"quality_of_angle"}, read_value(lua, 1));
  lua_pushnumber(lua, run_->mesh().standard().quality_of_angle(angle));
  return 1;
}

/// A field of a quality table that is not there yet.
int ScriptHost::measure(lua_State* lua) {
  const char* name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?";
  const std::string_view wanted = name;
  if (wanted != "theta_min" && wanted != "theta_max" && wanted != "lambda") {
    throw Error(fmt::format(
        "quality() has no '{}'; valid: lambda, n_bad, n_needles, passes, q_aver, q_worst, "
        "seconds, tets, theta_max, theta_min, vertices",
        wanted));
  }
  lua_getfield(lua, 1, "passes");
  if (lua_tointeger(lua, -1) != static_cast<lua_Integer>(run_->records.size())) {
    throw Error(
        fmt::format("quality(): {} was not read before the next pass, and cannot be "
                    "measured any more",
                    wanted));
  }
  const MeshStatistics statistics =
      compute_statistics(run_->mesh(), run_->mesh().standard().goal());
  const auto keep = [&](const char* field, double value) {
    lua_pushnumber(lua, value);
    lua_setfield(lua, 1, field);
  };
  keep("theta_min", statistics.theta_min);
  keep("theta_max", statistics.theta_max);
  keep("lambda", statistics.lambda);
  lua_getfield(lua, 1, name);
  return 1;
}

int ScriptHost::limit(lua_State* lua) {
  begin_work();
  const SurfaceLimit now = compute_surface_limit(run_->mesh());
  lua_newtable(lua);
  const auto count = [&](std::string_view name, std::size_t value) {
    lua_pushlstring(lua, name.data(), name.size());
    lua_pushinteger(lua, static_cast<lua_Integer>(value));
    lua_rawset(lua, -3);
  };
  const auto bound = [&](const char* name, const std::optional<double>& value) {
    if (!value) return;
    lua_pushnumber(lua, *value);
    lua_setfield(lua, -2, name);
  };
  count("n_forced", now.n_forced);
  bound("q_worst", now.q_worst);
  bound("theta_min", now.theta_min);
  bound("theta_max", now.theta_max);
  for (std::size_t i = 0; i < kHindranceCount; ++i) {
    count(to_string(static_cast<Hindrance>(i)), now.bad[i]);
  }
  return 1;
}

int ScriptHost::is_progress(lua_State* lua) {
  const auto before = read_indicators({"is_progress: before"}, read_value(lua, 1));
  const auto now = read_indicators({"is_progress: now"}, read_value(lua, 2));
  lua_pushboolean(lua, tetmend::is_progress(before, now));
  return 1;
}

int ScriptHost::operators(lua_State* lua) {
  begin_work();
  lua_newtable(lua);
  lua_Integer i = 0;
  for (const OperatorInfo* info : run_->registry().operators()) {
    lua_pushlstring(lua, info->name.data(), info->name.size());
    lua_rawseti(lua, -2, ++i);
  }
  return 1;
}

int ScriptHost::log(lua_State* lua) {
  begin_work();
  std::string text;
  const int count = lua_gettop(lua);
  for (int i = 1; i <= count; ++i) {
    push_text(lua, i);
    std::size_t length = 0;
    const char* part = lua_tolstring(lua, -1, &length);
    hold_in_call(lua, kMostBytesShown * (length + 1));
    if (i > 1) text += ' ';
    text += printable({part, length});
    lua_pop(lua, 1);
  }
  hold_for_good(lua, sizeof(text) + text.size());
  run_->note(text);
  return 0;
}

}  // namespace tetmend
