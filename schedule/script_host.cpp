// SPDX-License-Identifier: MIT
#include "schedule/script_host.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/bounds.h"
#include "kernel/error.h"
#include "kernel/nearest_word.h"
#include "kernel/printable.h"
#include "kernel/statistics.h"
#include "kernel/workspace.h"
#include "schedule/adapt.h"
#include "schedule/limit/surface_limit.h"
#include "schedule/lua_library.h"
#include "schedule/single_attempt.h"
#include "schedule/vary.h"

namespace tetmend {

namespace {

/// Ten million instructions: a script that only declares is done long before.
constexpr std::size_t kMostWatchesToDescribe = 10000;
/// Where each instruction copies megabytes.
constexpr std::chrono::seconds kMostTimeToDescribe{2};

/// Of one byte that is written as \x1b.
constexpr std::size_t kMostBytesShown = 4;

constexpr const char* kQualityTable = "tetmend quality";

ScriptValue read_table(ScriptValue value, const WordInfo& word) {
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

ScriptValue integer(std::size_t number) {
  return ScriptValue::of_integer(static_cast<double>(number));
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
  constexpr double kMostTets = 1 << 29;
  return {number("q_worst"), static_cast<std::size_t>(std::clamp(number("n_bad"), 0.0, kMostTets)),
          number("q_aver")};
}

// ---- Functions of Lua (schedule/lua_box.h) ------------------------------------------------------

bool is_place_in_list(lua_State* lua, int index, lua_Integer length) {
  if (lua_isinteger(lua, index) == 0) return false;
  const lua_Integer place = lua_tointeger(lua, index);
  return place >= 1 && place <= length;
}

/// What first_of, all_of and sequence return: a copy of their table, marked by their name.
int compose(lua_State* lua, const char* how) {
  charge_arguments(lua);
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

int first_of(lua_State* lua) {
  return compose(lua, "first_of");
}

int all_of(lua_State* lua) {
  return compose(lua, "all_of");
}

int sequence(lua_State* lua) {
  return compose(lua, "sequence");
}

/// Before the word `quality`: a field that is not in its table is asked for when it is read.
int mark_quality_table(lua_State* lua) {
  lua_settop(lua, 0);
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_call(lua, 0, 1);
  luaL_setmetatable(lua, kQualityTable);
  return 1;
}

/// Before the word that measures, as the event __index(table, name): keeps what it finds.
int keep_measured(lua_State* lua) {
  lua_settop(lua, 2);
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_pushvalue(lua, 2);
  lua_getfield(lua, 1, "passes");
  lua_call(lua, 2, 1);
  for (lua_pushnil(lua); lua_next(lua, 3) != 0; lua_pop(lua, 1)) {
    lua_pushvalue(lua, -2);
    lua_pushvalue(lua, -2);
    lua_rawset(lua, 1);
  }
  lua_pushvalue(lua, 2);
  lua_rawget(lua, 3);
  return 1;
}

/// On the scale of quality(): that of the better one of the two angles with this sine. None by a measure
/// of one's own, which need not know angles.
std::optional<double> quality_of_sine(const Standard& standard, std::optional<double> sine) {
  if (!sine || standard.is_own()) return std::nullopt;
  const double angle = std::asin(std::min(*sine, 1.0)) * 180 / std::numbers::pi;
  return std::max(standard.quality_of_angle(angle), standard.quality_of_angle(180 - angle));
}

/// Of the qualities of the 32 worst bad tets that are not frozen; 1: there are none.
double mean_of_worst(const TetMesh& mesh) {
  constexpr std::size_t kFew = 32;
  std::vector<Quality> bad;
  for (std::size_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(static_cast<std::uint32_t>(i));
    if (mesh.is_deleted(t) || mesh.is_frozen(t) || mesh.quality(t) >= kBadThreshold) continue;
    bad.push_back(mesh.quality(t));
  }
  if (bad.empty()) return 1;
  const auto end = bad.begin() + static_cast<std::ptrdiff_t>(std::min(kFew, bad.size()));
  std::partial_sort(bad.begin(), end, bad.end());
  return std::accumulate(bad.begin(), end, 0.0) / static_cast<double>(end - bad.begin());
}

}  // namespace

ScriptHost::ScriptHost(Run* run, const ScheduleSettings& settings)
    : run_(run),
      keeps_measure_(run != nullptr && run->mesh().standard().is_own()),
      settings_(settings),
      lua_({}, [this] { watch(); }) {
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
  const auto bind = [this](auto member) {
    return [this, member](WordCall& call) { (this->*member)(call); };
  };
  const auto add = [&](const char* name, auto member) { lua_.add_word(name, bind(member)); };
  add("description", &ScriptHost::describe);
  add("parameter", &ScriptHost::declare);
  add("begin_round", &ScriptHost::begin_round);
  add("run_schedule", &ScriptHost::run_schedule);
  add("local_reconnection", &ScriptHost::local_reconnection);
  add("smooth", &ScriptHost::smooth);
  add("suppress_points", &ScriptHost::suppress_points);
  add("insert_points", &ScriptHost::insert_points);
  add("polish", &ScriptHost::polish);
  add("adapt", &ScriptHost::adapt);
  add("vary", &ScriptHost::vary);
  add("untangle", &ScriptHost::untangle);
  add("apply", &ScriptHost::apply);
  add("attempt", &ScriptHost::attempt);
  lua_.add_function("first_of", first_of);
  lua_.add_function("all_of", all_of);
  lua_.add_function("sequence", sequence);
  add("goal", &ScriptHost::goal);
  add("judge_by", &ScriptHost::judge_by);
  add("hold_mean", &ScriptHost::hold_mean);
  add("hold_worst", &ScriptHost::hold_worst);
  add("quality_of_angle", &ScriptHost::quality_of_angle);
  lua_.add_word("quality", bind(&ScriptHost::quality), mark_quality_table);
  lua_.add_metamethod(kQualityTable, "__index", bind(&ScriptHost::measure), keep_measured);
  add("limit", &ScriptHost::limit);
  add("is_progress", &ScriptHost::is_progress);
  add("operators", &ScriptHost::operators);
  lua_.add_word("log", bind(&ScriptHost::log), call_with_texts);
  lua_.add_word("print", bind(&ScriptHost::log), call_with_texts);
}

// ---- Declarations -------------------------------------------------------------------------------

void ScriptHost::describe(WordCall& call) {
  info_.description = printable(read_text({"description"}, call.argument(1)));
  call.hold_for_good(info_.description.size());
}

void ScriptHost::declare(WordCall& call) {
  if (working_) throw Error("parameter: to be declared before the first pass");
  const ScriptValue value = read_table(call.argument(1), find_word("parameter"));
  call.charge_steps(info_.parameters.size());
  const ScheduleParameter& parameter =
      info_.parameters.emplace_back(read_parameter(value, info_.parameters));
  call.hold_for_good(memory_of(parameter));
  const auto [number, text] = chosen_value(parameter, settings_);
  switch (parameter.kind) {
    case ScheduleParameter::Kind::integer:
      return call.give(ScriptValue::of_integer(number));
    case ScheduleParameter::Kind::real:
      return call.give(ScriptValue::of_number(number));
    case ScheduleParameter::Kind::flag:
      return call.give(ScriptValue::of_flag(number != 0));
    case ScheduleParameter::Kind::choice:
      return call.give(ScriptValue::of_text(text));
  }
}

// ---- Passes -------------------------------------------------------------------------------------

void ScriptHost::begin_round(WordCall& call) {
  begin_work();
  call.give(integer(++run_->round));
}

/// In an interpreter of its own. A script can run a built-in schedule only, so that none can run
/// itself.
void ScriptHost::run_schedule(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("run_schedule");
  const Schedule schedule = Schedule::builtin(read_text({"run_schedule"}, call.argument(1)));
  const ScheduleSettings settings = read_settings(word, read_table(call.argument(2), word));
  const std::size_t held = run_->held_bytes();
  ScriptHost(run_, settings).execute(schedule);
  call.hold_for_good(run_->held_bytes() - held);
  watch();
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
      arguments.on = run_->for_share(read_selection(subject, argument));
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
    const std::string names = fmt::format("{}", fmt::join(valid, ", "));
    throw Error(fmt::format("{} has no parameter '{}'; valid: {}{}", word.name, name, names,
                            guess_of(name, names)));
  }
  return arguments;
}

template <class Pass>
void ScriptHost::make_pass(WordCall& call, const Pass& pass) {
  const std::size_t passes = run_->records.size();
  const std::size_t held = run_->held_bytes();
  pass();
  call.hold_for_good(run_->held_bytes() - held);
  const bool was_made = run_->records.size() > passes;
  const PassRecord record = was_made ? run_->records.back() : PassRecord{};
  call.give(integer(record.accepted()));
  call.give(integer(record.attempts()));
}

void ScriptHost::local_reconnection(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("local_reconnection");
  const ScriptValue value = read_table(call.argument(1), word);
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
  make_pass(call, [&] { tetmend::local_reconnection(*run_, options); });
}

void ScriptHost::smooth(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("smooth");
  Arguments arguments = read_arguments(word, read_table(call.argument(1), word), {"smoothing"});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  SmoothOptions options;
  options.on = std::move(arguments.on);
  options.settings = std::move(arguments.of_operators[0]);
  options.cycles = static_cast<unsigned>(numbers.integer("cycles"));
  make_pass(call, [&] { tetmend::smooth(*run_, options); });
}

void ScriptHost::suppress_points(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("suppress_points");
  Arguments arguments =
      read_arguments(word, read_table(call.argument(1), word), {"edge_contraction"});
  make_pass(call, [&] {
    tetmend::suppress_points(*run_,
                             {std::move(arguments.on), std::move(arguments.of_operators[0])});
  });
}

void ScriptHost::insert_points(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("insert_points");
  Arguments arguments = read_arguments(word, read_table(call.argument(1), word), {"edge_split"});
  make_pass(call, [&] {
    tetmend::insert_points(*run_, {std::move(arguments.on), std::move(arguments.of_operators[0])});
  });
}

void ScriptHost::polish(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("polish");
  const Arguments arguments = read_arguments(word, read_table(call.argument(1), word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const PolishOptions options = {.below = numbers.real("below"),
                                 .insert = numbers.real("insert"),
                                 .contract = numbers.real("contract"),
                                 .lambda = numbers.real("lambda"),
                                 .grow = numbers.real("grow"),
                                 .smooth = numbers.real("smooth"),
                                 .cycles = static_cast<unsigned>(numbers.integer("cycles"))};
  make_pass(call, [&] { tetmend::polish(*run_, options); });
}

void ScriptHost::adapt(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("adapt");
  const Arguments arguments = read_arguments(word, read_table(call.argument(1), word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const AdaptOptions options = {.floor = numbers.real("floor"),
                                .sweeps = static_cast<unsigned>(numbers.integer("sweeps")),
                                .split = numbers.flag("split"),
                                .contract = numbers.flag("contract")};
  make_pass(call, [&] { tetmend::adapt(*run_, options); });
}

void ScriptHost::vary(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("vary");
  const ScriptValue value = read_table(call.argument(1), word);
  Arguments arguments = read_arguments(word, value, {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  VaryOptions options = {.on = std::move(arguments.on),
                         .rings = static_cast<unsigned>(numbers.integer("rings")),
                         .variants = static_cast<unsigned>(numbers.integer("variants")),
                         .first = static_cast<unsigned>(numbers.integer("first")),
                         .floor = numbers.real("floor")};
  if (const ScriptValue* schedule = value.field("schedule")) {
    options.schedule = Schedule::builtin(read_text({"vary: schedule"}, *schedule));
  }
  if (const ScriptValue* settings = value.field("settings")) {
    options.settings = read_settings(word, *settings);
  }
  make_pass(call, [&] { tetmend::vary(*run_, options); });
}

void ScriptHost::untangle(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("untangle");
  const Arguments arguments = read_arguments(word, read_table(call.argument(1), word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const UntangleOptions options = {
      .where = {.share = numbers.real("share"),
                .at_least = static_cast<std::size_t>(numbers.integer("at_least")),
                .rings = static_cast<unsigned>(numbers.integer("rings"))},
      .looks = static_cast<unsigned>(numbers.integer("looks"))};
  make_pass(call, [&] { tetmend::untangle(*run_, options); });
}

void ScriptHost::apply(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("apply");
  ApplyOptions options;
  options.what = read_composition(run_->registry(), {"apply"}, call.argument(1));
  Arguments arguments = read_arguments(word, read_table(call.argument(2), word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  options.on = std::move(arguments.on);
  options.sweeps = static_cast<unsigned>(numbers.integer("sweeps"));
  options.again = numbers.flag("again");
  make_pass(call, [&] { tetmend::apply(*run_, options); });
}

void ScriptHost::attempt(WordCall& call) {
  begin_work();
  const Composition what = read_composition(run_->registry(), {"attempt"}, call.argument(1));
  if (what.kind != Composition::Kind::one && what.kind != Composition::Kind::sequence) {
    throw Error("attempt: must be one operator or a sequence");
  }
  const std::vector<std::uint32_t> vertices = read_vertices(call.argument(2));
  std::vector<std::uint32_t> tet;
  const ScriptValue third = call.argument(3);
  if (third.kind != ScriptValue::Kind::nothing) tet = read_vertices(third);
  make_pass(call, [&] { attempt_once(*run_, {what, vertices, tet}); });
}

// ---- Questions ----------------------------------------------------------------------------------

void ScriptHost::quality(WordCall& call) {
  begin_work();
  const QualityIndicators now = run_->indicators();
  const Goal goal = run_->mesh().standard().goal();
  ScriptValue table = ScriptValue::empty_table();
  const auto number = [&](const char* name, double value) {
    table.fields.push_back({name, ScriptValue::of_number(value)});
  };
  const auto count = [&](const char* name, std::size_t value) {
    table.fields.push_back({name, integer(value)});
  };
  number("q_worst", now.q_worst);
  count("n_bad", now.n_bad);
  count("n_needles", now.n_needles);
  number("q_aver", now.q_aver);
  number("goal_min", goal.min_angle);
  number("goal_max", goal.max_angle);
  count("tets", run_->mesh().tet_count());
  count("vertices", run_->mesh().vertex_count());
  number("seconds", run_->seconds());
  count("passes", run_->records.size());
  count("date", run_->worker().workspace().date() + 1);  // of the sweep that comes next
  call.give(std::move(table));
}

void ScriptHost::goal(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("goal");
  const Arguments arguments = read_arguments(word, read_table(call.argument(1), word), {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const Standard now = run_->mesh().standard();
  Goal goal = now.goal();
  if (numbers.real("min") > 0) goal = Goal::symmetric(numbers.real("min"));
  if (numbers.real("max") > 0) goal.max_angle = numbers.real("max");
  if (!is_sound(goal)) {
    throw Error(fmt::format("goal: {},{} is no goal", goal.min_angle, goal.max_angle));
  }
  run_->set_standard(now.with_goal(goal));
}

void ScriptHost::judge_by(WordCall& call) {
  begin_work();
  const WordInfo& word = find_word("judge_by");
  const ScriptValue value = read_table(call.argument(1), word);
  const Arguments arguments = read_arguments(word, value, {});
  const ParameterValues numbers(word.name, word.numbers, arguments.numbers);
  const Standard now = run_->mesh().standard();
  const ScriptValue* measure = value.field("measure");
  const double price = numbers.real("price");
  if (measure == nullptr) return run_->set_standard(now.with_price(price));
  const Standard named =
      run_->registry().standard(read_text({"judge_by: measure"}, *measure), now.goal(), price);
  // Schedules say with which terms of tetmend's own measure they work.
  run_->set_standard(keeps_measure_ && !named.is_own() ? now.with_price(price) : named);
}

void ScriptHost::hold_worst(WordCall& call) {
  begin_work();
  if (call.argument_count() > 0) throw Error("hold_worst takes nothing");
  run_->mesh().set_bounds(Bounds::of(run_->mesh()));
}

void ScriptHost::hold_mean(WordCall& call) {
  begin_work();
  const double mean = read_number({"hold_mean"}, call.argument(1));
  run_->mesh().set_bounds(run_->mesh().bounds().with_mean(mean));
}

void ScriptHost::quality_of_angle(WordCall& call) {
  begin_work();
  const double angle = read_number({"quality_of_angle"}, call.argument(1));
  call.give(ScriptValue::of_number(run_->mesh().standard().quality_of_angle(angle)));
}

/// measure(name, passes): fields of a quality table that are not there yet, by the name of one. The
/// table is of the time when so many passes had been made.
void ScriptHost::measure(WordCall& call) {
  const ScriptValue name = call.argument(1);
  const std::string& wanted = name.kind == ScriptValue::Kind::text ? name.text : "?";
  if (wanted != "theta_min" && wanted != "theta_max" && wanted != "lambda" &&
      wanted != "mean_ratio" && wanted != "radius_ratio" && wanted != "q_few") {
    throw Error(
        fmt::format("quality() has no '{}'; valid: date, goal_max, goal_min, lambda, mean_ratio, "
                    "n_bad, n_needles, "
                    "passes, q_aver, q_few, q_worst, radius_ratio, seconds, tets, theta_max, "
                    "theta_min, vertices",
                    wanted));
  }
  const ScriptValue passes = call.argument(2);
  if (!passes.is_integer || passes.number != static_cast<double>(run_->records.size())) {
    throw Error(
        fmt::format("quality(): {} was not read before the next pass, and cannot be "
                    "measured any more",
                    wanted));
  }
  ScriptValue table = ScriptValue::empty_table();
  if (wanted == "q_few") {
    table.fields = {{wanted, ScriptValue::of_number(mean_of_worst(run_->mesh()))}};
    call.give(std::move(table));
    return;
  }
  if (wanted == "mean_ratio" || wanted == "radius_ratio") {
    const double mean = summarize(run_->mesh(), find_quality_measure(wanted)).mean;
    table.fields = {{wanted, ScriptValue::of_number(mean)}};
    call.give(std::move(table));
    return;
  }
  const MeshStatistics statistics =
      compute_statistics(run_->mesh(), run_->mesh().standard().goal());
  table.fields = {{"theta_min", ScriptValue::of_number(statistics.theta_min)},
                  {"theta_max", ScriptValue::of_number(statistics.theta_max)},
                  {"lambda", ScriptValue::of_number(statistics.lambda)}};
  call.give(std::move(table));
}

void ScriptHost::limit(WordCall& call) {
  begin_work();
  const SurfaceLimit now = compute_surface_limit(run_->mesh());
  ScriptValue table = ScriptValue::empty_table();
  const auto count = [&](std::string_view name, std::size_t value) {
    table.fields.push_back({std::string(name), integer(value)});
  };
  const auto bound = [&](const char* name, const std::optional<double>& value) {
    if (value) table.fields.push_back({name, ScriptValue::of_number(*value)});
  };
  count("n_forced", now.n_forced);
  bound("q_worst", quality_of_sine(run_->mesh().standard(), now.q_worst));
  bound("theta_min", now.theta_min);
  bound("theta_max", now.theta_max);
  for (std::size_t i = 0; i < kHindranceCount; ++i) {
    count(to_string(static_cast<Hindrance>(i)), now.bad[i]);
  }
  call.give(std::move(table));
}

void ScriptHost::is_progress(WordCall& call) {
  const auto before = read_indicators({"is_progress: before"}, call.argument(1));
  const auto now = read_indicators({"is_progress: now"}, call.argument(2));
  call.give(ScriptValue::of_flag(tetmend::is_progress(before, now)));
}

void ScriptHost::operators(WordCall& call) {
  begin_work();
  ScriptValue names = ScriptValue::empty_table();
  for (const OperatorInfo* info : run_->registry().operators()) {
    names.list.push_back(ScriptValue::of_text(info->name));
  }
  call.give(std::move(names));
}

void ScriptHost::log(WordCall& call) {
  begin_work();
  std::string text;
  for (int i = 1; i <= call.argument_count(); ++i) {
    const std::string_view part = call.text(i);
    call.hold_in_call(kMostBytesShown * (part.size() + 1));
    if (i > 1) text += ' ';
    text += printable(part);
  }
  call.hold_for_good(sizeof(text) + text.size());
  run_->note(text);
}

}  // namespace tetmend
