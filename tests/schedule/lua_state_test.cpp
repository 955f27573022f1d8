// SPDX-License-Identifier: MIT
// The box around the interpreter: what scripts cannot reach, and how they are stopped.
#include "schedule/lua_state.h"

#include <array>
#include <new>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "schedule/lua_library.h"
#include "schedule/script_value.h"
#include "tests/support/text.h"

using namespace tetmend;
using tetmend::test::contains;

namespace {

/// What the script reports by `say(...)`, and the message of its error.
struct Spoken {
  std::string said;
  std::string error;
};

Spoken run_saying(const std::string& text, LuaState::Limits limits = {}) {
  Spoken spoken;
  LuaState lua(limits);
  const auto say = [&](WordCall& call) {
    for (int i = 1; i <= call.argument_count(); ++i) {
      spoken.said += std::string(call.text(i)) + ' ';
    }
  };
  lua.add_word("say", say, call_with_texts);
  lua.add_word("fail", [](WordCall&) { throw Error("no such luck"); });
  try {
    lua.run(text, "test.lua");
  } catch (const Error& error) {
    spoken.error = error.what();
  }
  return spoken;
}

}  // namespace

TEST_CASE("an interpreter that lacks memory throws, wherever it runs out") {
  bool made = false;
  std::size_t tries = 0;
  for (std::size_t memory = 0; !made; memory += 256, ++tries) {
    try {
      LuaState lua({.memory = memory});
      lua.add_word("word", [](WordCall&) {});
      made = true;
    } catch (const std::bad_alloc&) {
    }
  }
  CHECK(tries > 20);
}

TEST_CASE("a word that lacks memory ends the script") {
  LuaState lua;
  lua.add_word("fill", [](WordCall&) { throw std::bad_alloc(); });
  CHECK_THROWS_AS(lua.run("fill()", "test.lua"), std::bad_alloc);
}

TEST_CASE("a script computes, loops and calls words") {
  CHECK(run_saying("local s = 0 for i = 1, 4 do s = s + i end say(s, math.max(3, 7))").said ==
        "10 7 ");
  CHECK(run_saying("say(string.format('%.2f', 1/3), ('abc'):upper(), #'xy')").said ==
        "0.33 ABC 2 ");
  CHECK(run_saying("local t = {3, 1, 2} table.sort(t) say(table.concat(t, ','))").said == "1,2,3 ");
}

TEST_CASE("what reaches outside, differs from run to run or cannot be interrupted is not there") {
  for (const char* name : {"io", "os", "require", "load", "loadstring", "loadfile", "dofile",
                           "debug", "package", "coroutine", "pcall", "xpcall", "setmetatable",
                           "getmetatable", "rawset", "rawget", "next", "collectgarbage", "utf8"}) {
    CAPTURE(name);
    CHECK(contains(run_saying(std::string("say(") + name + ")").error,
                   "test.lua:1: unknown name '" + std::string(name) + "'; valid: "));
    CHECK(contains(run_saying(std::string("say(_G)")).error, "unknown name '_G'"));
  }
  for (const char* field : {"math.random", "math.randomseed", "string.rep", "string.find",
                            "string.gsub", "string.dump", "table.move"}) {
    CAPTURE(field);
    CHECK(run_saying(std::string("say(") + field + ")").said == "nil ");
  }
  CHECK(run_saying("local s = 'x' say(s.rep)").said == "nil ");
  CHECK(contains(run_saying("say(('x'):rep(1e9))").error, "test.lua:1:"));
}

TEST_CASE("compiled scripts are refused") {
  CHECK(contains(run_saying(std::string("\x1bLua\x54\x00", 6)).error,
                 "test.lua: attempt to load a binary chunk"));
}

TEST_CASE("an unknown name is an error with its line and the names that there are") {
  const std::string error = run_saying("local x = 1\n\nsaay(x)").error;
  CHECK(contains(error, "test.lua:3: unknown name 'saay'; valid: "));
  CHECK(contains(error, "say"));
  CHECK(contains(run_saying("mine = 1\nsay(mien)").error, "mine"));
}

TEST_CASE("a script makes globals of its own and cannot overwrite words") {
  CHECK(run_saying("total = 2 say(total + 1)").said == "3 ");
  CHECK(run_saying("function twice(x) return 2 * x end say(twice(4))").said == "8 ");
  CHECK(run_saying("say = 3").error ==
        "test.lua:1: 'say' is a word of the language and cannot be set");
  CHECK(contains(run_saying("\nfunction pairs() end").error, "test.lua:2: 'pairs' is a word"));
}

TEST_CASE("a mistake in grammar is an error with its line and the word") {
  CHECK(run_saying("local = 3").error == "test.lua:1: <name> expected near '='");
  CHECK(contains(run_saying("say(1)\nif true").error, "test.lua:2:"));
}

TEST_CASE("the error of a word is an error of the line that called it") {
  CHECK(run_saying("\nlocal function f() fail() end\nf()").error == "test.lua:2: no such luck");
  CHECK(run_saying("error('I give up')").error == "test.lua:1: I give up");
  CHECK(run_saying("error({})").error == "test.lua: error(table) was called");
  CHECK(
      contains(run_saying("local t\nsay(t.x)").error, "test.lua:2: attempt to index a nil value"));
}

TEST_CASE("endless recursion is an error with its line") {
  CHECK(contains(run_saying("local function f()\n  return 1 + f()\nend\nf()").error,
                 "test.lua:2: stack overflow"));
}

TEST_CASE("a script that wants too much memory is stopped") {
  const LuaState::Limits limits{.memory = std::size_t{8} << 20};
  CHECK(run_saying("local t = {}\nlocal i = 0\nwhile true do\n  i = i + 1\n  t[i] = 'x' .. i\nend",
                   limits)
            .error.starts_with("test.lua:"));
  CHECK(contains(run_saying("local t = {} while true do t[#t + 1] = {} end", limits).error, " MB"));
  CHECK(contains(run_saying("local s = 'x' while true do s = s .. s end", limits).error,
                 "test.lua:1: the script holds more than 6 MB"));
  CHECK(contains(run_saying("local s = 'x' while true do s = s .. s .. s .. s end",
                            {.memory = std::size_t{2} << 20})
                     .error,
                 "test.lua: the script needs more than 2 MB"));
  CHECK(run_saying("local t = {} for i = 1, 1000 do t[i] = i end say(#t)", limits).said == "1000 ");
}

TEST_CASE("a script is stopped wherever it is, and what the watch throws comes out") {
  struct Enough {};
  for (const char* text : {"while true do end", "repeat until false", "::top:: goto top",
                           "local function f() return f() end f()", "for i = 1, math.huge do end",
                           "local t = {1, 2, 3} while true do table.sort(t) end"}) {
    CAPTURE(text);
    int left = 5;
    LuaState lua({}, [&] {
      if (--left == 0) throw ScriptStop();
    });
    CHECK_THROWS_AS(lua.run(text, "test.lua"), ScriptStop);
    CHECK(left == 0);
  }
}

TEST_CASE("pairs goes through a table in the order of its keys") {
  CHECK(run_saying("for k, v in pairs({b = 1, a = 2, c = 3, 10, 20}) do say(k, v) end").said ==
        "1 10 2 20 a 2 b 1 c 3 ");
  CHECK(run_saying("local t = {x = 1, y = 2} for k in pairs(t) do t[k] = nil end\n"
                   "for k in pairs(t) do say(k) end say('end')")
            .said == "end ");
}

TEST_CASE("tostring tells no addresses") {
  CHECK(run_saying("say(tostring({}), tostring(say), tostring(1.5), tostring(nil))").said ==
        "table function 1.5 nil ");
}

TEST_CASE("every message begins with the file, and shows no control characters") {
  CHECK(run_saying("error('a\\0b\\27[31mred\\nline')").error ==
        "test.lua:1: a\\x00b\\x1b[31mred\\nline");
  CHECK(run_saying("error('no place', 0)").error == "test.lua:1: no place");
  CHECK(run_saying("error(nil)").error == "test.lua: error(nil) was called");
  CHECK(run_saying("local x = " + std::string(300, '(')).error.starts_with("test.lua:"));
  CHECK(run_saying("local x = '\x1b").error.starts_with("test.lua:1: unfinished string"));
  CHECK_FALSE(contains(run_saying("local x = '\x1b").error, "\x1b"));
  CHECK(run_saying("local s = 'x' for i = 1, 20 do s = s .. s end error(s)").error.size() < 5000);
  CHECK(run_saying("for i = 1, 10000 do _ENV['name' .. i] = i end say(nope)").error.size() < 5000);
  LuaState lua;
  const std::string long_name =
      "/a/folder/with/a/name/that/is/far/too/long/for/a/message/of/lua.lua";
  try {
    lua.run("\nerror('x')", long_name);
    CHECK(false);
  } catch (const Error& error) {
    CHECK(contains(error.what(), "/a/message/of/lua.lua:2: x"));
    CHECK(std::string(error.what()).starts_with("..."));
  }
}

TEST_CASE("what words hold outside of the interpreter has one budget") {
  const LuaState::Limits limits{.outside = std::size_t{1} << 20};
  LuaState lua(limits);
  lua.add_word("keep", [](WordCall& call) { call.hold_for_good(std::size_t{100} << 10); });
  lua.add_word("need", [](WordCall& call) { call.hold_in_call(std::size_t{600} << 10); });
  CHECK_NOTHROW(lua.run("for i = 1, 100 do need() end", "test.lua"));
  CHECK_NOTHROW(lua.run("for i = 1, 4 do keep() need() end", "test.lua"));
  CHECK_THROWS_WITH_AS(
      lua.run("keep()\nneed()", "test.lua"),
      "test.lua:2: arguments, notes, descriptions and records of passes take more than 1 MB",
      Error);
  CHECK_THROWS_AS(lua.run("for i = 1, 100 do keep() end", "test.lua"), Error);
}

TEST_CASE("a function of a script is called with numbers, for a number") {
  std::size_t watches = 0;
  LuaState lua({}, [&] {
    if (++watches > 100) throw Error("too long");
  });
  lua.run(
      "function f(x, y) return x - 2 * y end\n"
      "function g(x) return {x} end\n"
      "function h(x)\n return x.y\n end\n"
      "function loop() while true do end end\n"
      "word = 3",
      "test.lua");
  const auto message_of = [&](const std::string& function) -> std::string {
    try {
      lua.call(function, std::array{1.0});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  CHECK(lua.call("f", std::array{1.0, 0.25}) == 0.5);
  CHECK(message_of("g") == "test.lua: g returns a table, but a number is wanted");
  CHECK(message_of("h") == "test.lua:4: attempt to index a number value (local 'x')");
  CHECK(message_of("none") == "test.lua: the script has no function none");
  CHECK(message_of("word") == "test.lua: the script has no function word");
  CHECK(message_of("log") == "test.lua: the script has no function log");
  CHECK(message_of("loop") == "test.lua:6: too long");
  CHECK(lua.call("f", std::array{3.0, 1.0}) == 1);  // none of that does harm
}
