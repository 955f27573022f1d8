// SPDX-License-Identifier: MIT
#include "schedule/lua_function.h"

#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "schedule/schedule.h"

namespace tetmend {

namespace {

/// Three hundred million instructions; fewer where the script holds large tables, and each look is dear.
constexpr std::size_t kMostWatches = 300'000;

}  // namespace

struct LuaFunction::Interpreter {
  std::size_t watches = 0;  // of the present call
  LuaState lua{LuaState::Limits{}, [this] {
                 if (++watches > kMostWatches) throw Error("a call does not come to an end");
               }};
};

LuaFunction::LuaFunction(const std::filesystem::path& file, std::string function)
    : file_(file.string()), text_(read_script(file)), function_(std::move(function)) {
  mine();
}

LuaFunction::Interpreter& LuaFunction::mine() const {
  std::shared_ptr<Interpreter>& interpreter = interpreters_.local();
  if (!interpreter) {
    auto made = std::make_shared<Interpreter>();
    made->lua.run(text_, file_);
    interpreter = std::move(made);
  }
  return *interpreter;
}

double LuaFunction::operator()(std::span<const double> arguments) const {
  Interpreter& interpreter = mine();
  interpreter.watches = 0;
  return interpreter.lua.call(function_, arguments);
}

}  // namespace tetmend
