// SPDX-License-Identifier: MIT
// Carries out what a script says: gives the words of the language their meaning.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "schedule/lua_state.h"
#include "schedule/schedule.h"
#include "schedule/schedule_parameter.h"
#include "schedule/script_value.h"
#include "schedule/words.h"

namespace tetmend {

/// One execution of one script.
class ScriptHost {
 public:
  /// @param run null: only what the script says about itself is wanted
  ScriptHost(Run* run, const ScheduleSettings& settings);

  /// @throws Error for a mistake in the script or in the settings.
  void execute(const Schedule& schedule);
  const ScheduleInfo& info() const { return info_; }

 private:
  /// The named arguments of a word, read and checked.
  struct Arguments {
    Selection on;
    ParameterSettings numbers;                    // of the word itself, defaults not filled in
    std::vector<ParameterSettings> of_operators;  // in the order of the operators
  };

  void add_words();
  void watch();
  /// Called by each word that is more than a declaration.
  void begin_work();

  int describe(lua_State* lua);
  int declare(lua_State* lua);
  int begin_round(lua_State* lua);
  int run_schedule(lua_State* lua);
  int local_reconnection(lua_State* lua);
  int smooth(lua_State* lua);
  int suppress_points(lua_State* lua);
  int insert_points(lua_State* lua);
  int polish(lua_State* lua);
  int untangle(lua_State* lua);
  int apply(lua_State* lua);
  int attempt(lua_State* lua);
  int compose(lua_State* lua, const char* how);
  int quality(lua_State* lua);
  int measure(lua_State* lua);
  int goal(lua_State* lua);
  int judge_by(lua_State* lua);
  int quality_of_angle(lua_State* lua);
  int limit(lua_State* lua);
  int is_progress(lua_State* lua);
  int operators(lua_State* lua);
  int log(lua_State* lua);

  Arguments read_arguments(const WordInfo& word, const ScriptValue& value,
                           const std::vector<std::string>& operators) const;
  /// Makes a pass; returns to the script how many attempts were accepted and how many made.
  template <class Pass>
  int make_pass(lua_State* lua, const Pass& pass);
  Run* run_;
  const ScheduleSettings& settings_;
  ScheduleInfo info_;
  bool working_ = false;
  std::size_t watches_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  LuaState lua_;
};

}  // namespace tetmend
