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

  void describe(WordCall& call);
  void declare(WordCall& call);
  void begin_round(WordCall& call);
  void run_schedule(WordCall& call);
  void local_reconnection(WordCall& call);
  void smooth(WordCall& call);
  void suppress_points(WordCall& call);
  void insert_points(WordCall& call);
  void polish(WordCall& call);
  void adapt(WordCall& call);
  void vary(WordCall& call);
  void untangle(WordCall& call);
  void apply(WordCall& call);
  void attempt(WordCall& call);
  void quality(WordCall& call);
  void measure(WordCall& call);
  void goal(WordCall& call);
  void judge_by(WordCall& call);
  void hold_mean(WordCall& call);
  void hold_worst(WordCall& call);
  void quality_of_angle(WordCall& call);
  void limit(WordCall& call);
  void is_progress(WordCall& call);
  void operators(WordCall& call);
  void log(WordCall& call);

  Arguments read_arguments(const WordInfo& word, const ScriptValue& value,
                           const std::vector<std::string>& operators) const;
  /// Makes a pass; returns to the script how many attempts were accepted and how many made.
  template <class Pass>
  void make_pass(WordCall& call, const Pass& pass);
  Run* run_;
  bool keeps_measure_;  // the run began with one of a program or plugin
  const ScheduleSettings& settings_;
  ScheduleInfo info_;
  bool working_ = false;
  std::size_t watches_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  LuaState lua_;
};

}  // namespace tetmend
