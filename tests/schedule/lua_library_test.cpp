// SPDX-License-Identifier: MIT
// What scripts could do to a run by the library alone: hold it up, or make it another one each time.
#include "schedule/lua_library.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "schedule/lua_state.h"
#include "tests/support/text.h"

using namespace tetmend;
using tetmend::test::contains;

namespace {

/// A script that says things, and calls mark() where a test wants to know how often it was watched.
struct Watched {
  std::string said;
  std::string error;
  std::size_t watches = 0;
  std::vector<std::size_t> marks;
  bool stopped = false;

  std::size_t between_marks() const { return marks.size() < 2 ? 0 : marks[1] - marks[0]; }
};

constexpr std::size_t kNever = 1000000000;

/// @param most the watch stops the script so many calls after the first mark
Watched run_watched(const std::string& script, std::size_t most = kNever) {
  Watched watched;
  LuaState lua({}, [&] {
    ++watched.watches;
    if (!watched.marks.empty() && watched.watches >= watched.marks[0] + most) throw ScriptStop();
  });
  const auto say = [&](WordCall& call) {
    for (int i = 1; i <= call.argument_count(); ++i) {
      watched.said += std::string(call.text(i)) + ' ';
    }
  };
  lua.add_word("say", say, call_with_texts);
  lua.add_word("mark", [&](WordCall&) { watched.marks.push_back(watched.watches); });
  try {
    lua.run(script, "test.lua");
  } catch (const Error& error) {
    watched.error = error.what();
  } catch (const ScriptStop&) {
    watched.stopped = true;
  }
  return watched;
}

std::string said(const std::string& script) {
  const Watched watched = run_watched(script);
  return watched.error + watched.said;
}

const std::string kList = "local t = {} for i = 1, 20000 do t[i] = i end ";
const std::string kEmptyTexts = "local t = {} for i = 1, 20000 do t[i] = '' end ";
const std::string kText = "local s = 'x' for i = 1, 20 do s = s .. s end ";  // 1 MB

}  // namespace

TEST_CASE("no function of the library works long without a watch") {
  struct Attack {
    std::string before;
    std::string call;
    std::size_t least_watches;
  };
  const std::vector<Attack> attacks = {
      {kList, "table.sort(t)", 200},
      {kList, "table.sort(t, function() return true end)", 200},
      {kEmptyTexts, "local s = table.concat(t)", 20},
      {kEmptyTexts + kText, "local u = table.concat({s, s}, s)", 45},
      {kList, "table.insert(t, 1, 0)", 19},
      {kList, "table.remove(t, 1)", 19},
      {kList, "local n = select('#', table.unpack(t))", 20},
      {kList, "local p = table.pack(table.unpack(t))", 40},
      {kList, "local p = pairs(t)", 200},
      {kList + "for i = 1, 20000 do t[i] = nil t['k' .. i] = i end ", "local p = pairs(t)", 200},
      {kText, "local u = s:upper()", 16},
      {kText, "local u = s:lower()", 16},
      {kText, "local u = s:sub(2)", 16},
      {kText, "local u = s:byte(1)", 16},
      {kText, "local u = string.char(s:byte(1, 100000))", 100},
      {kText, "local u = string.format('%s', s)", 16},
      {kText + "s = s:sub(1, 60000)", "for i = 1, 40 do local u = string.format('%q', s) end", 30},
      {kText, "local u = tonumber(s, 36)", 16},
      {kText, "say(type(s))", 0},
      {kText + "local u, v = s .. 'a', s .. 'b' ", "for i = 1, 1000 do local e = u == v end", 40},
      {kText + "local u, v = s .. 'a', s .. 'b' ", "for i = 1, 1000 do local e = u < v end", 40},
      {kText, "for i = 1, 100 do local u = s .. i end", 20},
  };
  for (const Attack& attack : attacks) {
    CAPTURE(attack.call);
    const std::string script = attack.before + "mark() " + attack.call + " mark()";
    const Watched whole = run_watched(script);
    CHECK(whole.error == "");
    CHECK(whole.between_marks() >= attack.least_watches);
    if (attack.least_watches < 4) continue;
    const Watched half = run_watched(script, attack.least_watches / 2);
    CHECK(half.stopped);
    CHECK(half.marks.size() == 1);
    CHECK(half.watches == half.marks[0] + attack.least_watches / 2);
  }
}

TEST_CASE("a list that claims an enormous length can be stopped") {
  // Entries at powers of two lead the search for the length astray.
  const std::string trap = "local t = {} for i = 0, 40 do t[1 << i] = '' end mark() ";
  for (const char* call : {"table.insert(t, 1, '')", "table.concat(t, '', 1, 1 << 40)",
                           "table.remove(t, 1)", "table.unpack(t, 1, 1 << 40)", "table.sort(t)"}) {
    CAPTURE(call);
    const Watched watched = run_watched(trap + "local x = " + call, 1000);
    CHECK((watched.stopped || watched.error != "" || watched.watches < 1000));
  }
}

TEST_CASE("texts that one instruction would take long for are refused") {
  CHECK(run_watched("local s = 'x' while true do s = s .. s end").error ==
        "test.lua:1: a text is longer than 4 MB");
  CHECK(run_watched("local t = {} for i = 1, 5 do t[i] = 'x' end\n" + kText +
                    "local u = table.concat(t, s)")
            .error == "test.lua:2: a text is longer than 4 MB");
  CHECK(run_watched(kText + "local u = string.format('%q', s)").error ==
        "test.lua:1: string.format: the text is too long for %q");
}

TEST_CASE("a usual script is watched every thousand instructions and no more often") {
  const Watched watched = run_watched("mark() for i = 1, 100000 do end mark()");
  CHECK(watched.between_marks() >= 90);
  CHECK(watched.between_marks() <= 110);
}

TEST_CASE("table.sort sorts, and what is equal keeps its order") {
  CHECK(said("local t = {5, 2, 9, 1, 7, 3} table.sort(t) say(table.concat(t, ','))") ==
        "1,2,3,5,7,9 ");
  CHECK(said("local t = {'b', 'a', 'c'} table.sort(t, function(x, y) return x > y end) "
             "say(table.concat(t))") == "cba ");
  CHECK(said("local t = {31, 12, 33, 14, 35, 11, 32, 13, 34} "
             "table.sort(t, function(x, y) return x // 10 < y // 10 end) "
             "say(table.concat(t, ','))") == "12,14,11,13,31,33,35,32,34 ");
  CHECK(said("local t = {} table.sort(t) say(#t) t = {4} table.sort(t) say(t[1])") == "0 4 ");
  CHECK(contains(run_watched("table.sort({1, 'a'})").error, "test.lua:1: attempt to compare"));
  CHECK(contains(run_watched("table.sort({2, 1}, 3)").error, "function expected"));
}

TEST_CASE("a comparison that contradicts itself gives some order, in n log n steps, from inside") {
  for (const char* answer :
       {"true", "false", "n % 2 == 0", "n % 3 == 0", "x ~= y", "x * 7919 % 13 < 6"}) {
    CAPTURE(answer);
    const Watched watched = run_watched(
        "local t, n = {}, 0 for i = 1, 1000 do t[i] = i end\n"
        "table.sort(t, function(x, y) n = n + 1 assert(x and y) return " +
        std::string(answer) +
        " end)\n"
        "assert(n <= 10000 and #t == 1000)\n"
        "local seen = {} for i = 1, 1000 do assert(not seen[t[i]]) seen[t[i]] = true end\n"
        "say(t[1], t[500], t[1000])");
    CHECK(watched.error == "");
    CHECK(watched.said == run_watched("local t, n = {}, 0 for i = 1, 1000 do t[i] = i end\n"
                                      "table.sort(t, function(x, y) n = n + 1 return " +
                                      std::string(answer) + " end) say(t[1], t[500], t[1000])")
                              .said);
  }
}

TEST_CASE("an adversary cannot make table.sort slow, so that it would ask the clock for a pivot") {
  // McIlroy: answers only what the order of questions has not fixed yet.
  const Watched watched = run_watched(
      "local n, t, val, solid, candidate, asked = 3000, {}, {}, 0, 0, 0\n"
      "for i = 1, n do t[i] = i val[i] = n end\n"
      "table.sort(t, function(x, y)\n"
      "  asked = asked + 1\n"
      "  if val[x] == n and val[y] == n then\n"
      "    if x == candidate then val[x] = solid else val[y] = solid end\n"
      "    solid = solid + 1\n"
      "  end\n"
      "  if val[x] == n then candidate = x elseif val[y] == n then candidate = y end\n"
      "  return val[x] < val[y]\n"
      "end)\n"
      "say(asked < 3000 * 12)");
  CHECK(watched.error + watched.said == "true ");
}

TEST_CASE("no address is told") {
  CHECK(said("say(tostring({}), tostring(say), tostring(table.sort), tostring(1.5))") ==
        "table function function 1.5 ");
  CHECK(said("say(string.format('%s|%10s|%-6s|%%s|%d', {}, say, nil, 3))") ==
        "table|  function|nil   |%s|3 ");
  CHECK(said("say(('%s'):format({}))") == "table ");
  for (const char* format : {"%p", "%20p", "%-20p", "%%%p", "%d %p"}) {
    CAPTURE(format);
    const std::string error =
        run_watched("say(string.format('" + std::string(format) + "', 1, {}))").error;
    CHECK(contains(error, "test.lua:1: string.format: %p is an address"));
  }
  for (const char* mistake :
       {"error({})", "error(say)", "local x = {} + 1", "local x = {} < {}", "table.concat({{}})",
        "say(#say)", "string.format('%d', {})", "string.format('%q', {})", "table.unpack(say)",
        "local x = {} .. ''", "({})()", "say(nil .. {})", "assert(false, {})"}) {
    CAPTURE(mistake);
    const std::string error = run_watched(mistake).error;
    CHECK(error != "");
    CHECK_FALSE(contains(error, "0x"));
  }
}

TEST_CASE("pairs goes by the whole key, and refuses keys that have no order") {
  CHECK(said("local t = {['a\\0c'] = 3, ['a\\0b'] = 2, a = 1, [true] = 0, [2.5] = 9, [-1] = 8}\n"
             "for k, v in pairs(t) do say(v) end") == "0 8 9 1 2 3 ");
  CHECK(said("local t = {} for i = 1, 9 do t['a\\0' .. i] = i end\n"
             "for k, v in pairs(t) do say(v) end") == "1 2 3 4 5 6 7 8 9 ");
  CHECK(said("local t = {[9007199254740993] = 2, [9007199254740992] = 1, [2.0^60] = 3}\n"
             "for k, v in pairs(t) do say(v) end") == "1 2 3 ");
  for (const char* key : {"{}", "say", "table.sort"}) {
    CAPTURE(key);
    CHECK(run_watched("for k in pairs({[" + std::string(key) + "] = 1}) do end").error ==
          "test.lua:1: pairs: keys must be numbers, strings or booleans");
  }
}

TEST_CASE("lists are edited and joined as in any Lua") {
  CHECK(said("local t = {1, 2} table.insert(t, 3) table.insert(t, 1, 0) table.insert(t, 5, 9) "
             "say(table.concat(t, ' '))") == "0 1 2 3 9 ");
  CHECK(said("local t = {1, 2, 3} say(table.remove(t, 1), table.remove(t), table.remove(t, 2), "
             "table.remove(t), table.remove(t), #t)") == "1 3 nil 2 nil 0 ");
  CHECK(said("say(table.concat({1, 2.5, 'x'}, ', ', 2, 3), table.concat({}), "
             "table.concat({'a'}, '-', 1, 1), table.concat({'a'}, '-', 2))") == "2.5, x  a  ");
  CHECK(
      said("say(table.concat({[math.maxinteger] = 'z'}, '-', math.maxinteger, math.maxinteger))") ==
      "z ");
  CHECK(said("say(table.unpack({1, 2, 3}, 2)) say(table.pack(1, nil).n)") == "2 3 2 ");
  CHECK(said("say(('aZ-ä'):upper(), ('aZ-Ä'):lower(), (''):upper())") == "AZ-ä az-Ä  ");
  for (const char* mistake :
       {"table.insert({}, 5, 1)", "table.insert({}, 1, 1, 1)", "table.insert({})",
        "table.remove({1}, 7)", "table.concat({{}})", "table.insert(3, 1)", "table.sort('x')",
        "table.unpack({}, 1, 1e8)", "string.format('%')", "string.format('%y', 1)",
        "string.format('%d')", "string.upper({})", "table.concat({1}, {})"}) {
    CAPTURE(mistake);
    CHECK(run_watched(mistake).error.starts_with("test.lua:1: "));
  }
}
