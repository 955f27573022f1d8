// SPDX-License-Identifier: MIT
#include "trace/ledger.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/printable.h"

namespace tetmend {

namespace {

std::size_t nearness_of(const Call& call) {
  if (!call.has_qualities()) return kNearness.size() + 2;
  const double missing = call.missing();
  if (missing <= 0) return 0;
  const auto* const bound = std::upper_bound(kNearness.begin(), kNearness.end(), missing);
  return 1 + static_cast<std::size_t>(bound - kNearness.begin());
}

/// Seconds of the calls in each.
std::vector<double> inner_seconds(std::span<const Call> calls) {
  std::vector<double> inner(calls.size(), 0);
  for (const Call& call : calls) {
    if (call.parent != kNoCall) inner[call.parent] += call.events.seconds();
  }
  return inner;
}

double percent_of(std::size_t part, std::size_t all) {
  return all == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(all);
}

/// What the nearest of refused calls lacked, or why that is not known.
std::string nearest_in_words(const LedgerCell& cell) {
  if (!std::isfinite(cell.nearest)) return fmt::format("-: {}", kNothingCompared);
  return cell.nearest <= 0 ? "others" : fmt::format("{:.4f}", cell.nearest);
}

void write_line(std::string& text, CallEnding ending, const LedgerCell& cell, std::size_t all) {
  const bool has_nearest = is_refusal(ending) && cell.calls > 0;
  fmt::format_to(std::back_inserter(text), "  {:<42} {:>9} {:>6.1f} {:>9.3f}{}{}\n",
                 name_of(ending), cell.calls, percent_of(cell.calls, all), cell.seconds,
                 has_nearest ? "  " : "", has_nearest ? nearest_in_words(cell) : "");
}

/// What lasted, what did not, and refusals, the most frequent first.
void write_block(std::string& text, std::string_view name, const LedgerRow& row) {
  const LedgerCell total = row.total();
  fmt::format_to(std::back_inserter(text), "\n{:<44} {:>9} {:>6} {:>9.3f}\n", name, total.calls, "",
                 total.seconds);
  write_line(text, CallEnding::for_good, row.cell(CallEnding::for_good), total.calls);
  write_line(text, CallEnding::undone, row.cell(CallEnding::undone), total.calls);
  std::vector<CallEnding> others;
  for (std::size_t i = 0; i < kEndingCount; ++i) {
    const auto ending = static_cast<CallEnding>(i);
    const bool is_other = ending != CallEnding::for_good && ending != CallEnding::undone;
    if (is_other && row.cell(ending).calls > 0) others.push_back(ending);
  }
  std::stable_sort(others.begin(), others.end(), [&](CallEnding one, CallEnding other) {
    return row.cell(one).calls > row.cell(other).calls;
  });
  for (const CallEnding ending : others) write_line(text, ending, row.cell(ending), total.calls);
}

void write_nearness(std::string& text, const LedgerRow& all) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "\nof {} refusals, by what their worst tet lacked\n", all.refused().calls);
  const auto line = [&](const std::string& what, std::size_t count) {
    if (count > 0) fmt::format_to(out, "  {:<42} {:>9}\n", what, count);
  };
  line("nothing: others were not good enough", all.nearness[0]);
  for (std::size_t i = 0; i < kNearness.size(); ++i) {
    line(fmt::format("less than {}", kNearness[i]), all.nearness[i + 1]);
  }
  line("more", all.nearness[kNearness.size() + 1]);
  line(std::string(kNothingCompared), all.nearness[kNearness.size() + 2]);
}

using Json = nlohmann::ordered_json;

Json cells_json(const LedgerRow& row) {
  const std::size_t all = row.total().calls;
  Json cells = Json::object();
  for (std::size_t i = 0; i < kEndingCount; ++i) {
    const LedgerCell& cell = row.cells[i];
    if (cell.calls == 0) continue;
    const auto ending = static_cast<CallEnding>(i);
    Json& json = cells[std::string(name_of(ending))];
    json = {{"calls", cell.calls},
            {"share", percent_of(cell.calls, all) / 100},
            {"seconds", cell.seconds}};
    if (!is_refusal(ending)) continue;
    json["nearest_lacked"] = std::isfinite(cell.nearest) ? Json(cell.nearest) : Json();
    if (!std::isfinite(cell.nearest)) json["why_none"] = kNothingCompared;
  }
  return cells;
}

Json nearness_json(const LedgerRow& row) {
  Json less = Json::array();
  for (std::size_t i = 0; i < kNearness.size(); ++i) {
    less.push_back({{"below", kNearness[i]}, {"calls", row.nearness[i + 1]}});
  }
  return {{"worst_tet_good_enough", row.nearness[0]},
          {"lacked", less},
          {"lacked_more", row.nearness[kNearness.size() + 1]},
          {"nothing_compared", row.nearness[kNearness.size() + 2]}};
}

Json row_json(const LedgerRow& row) {
  return {{"calls", row.total().calls},
          {"seconds", row.total().seconds},
          {"endings", cells_json(row)},
          {"nearness", nearness_json(row)}};
}

}  // namespace

LedgerCell& LedgerCell::operator+=(const LedgerCell& other) {
  calls += other.calls;
  seconds += other.seconds;
  nearest = std::min(nearest, other.nearest);
  return *this;
}

LedgerCell LedgerRow::total() const {
  LedgerCell sum;
  for (const LedgerCell& cell : cells) sum += cell;
  return sum;
}

LedgerCell LedgerRow::refused() const {
  LedgerCell sum;
  for (std::size_t i = 0; i < kEndingCount; ++i) {
    if (is_refusal(static_cast<CallEnding>(i))) sum += cells[i];
  }
  return sum;
}

LedgerRow& LedgerRow::operator+=(const LedgerRow& other) {
  for (std::size_t i = 0; i < kEndingCount; ++i) cells[i] += other.cells[i];
  for (std::size_t i = 0; i < nearness.size(); ++i) nearness[i] += other.nearness[i];
  return *this;
}

std::vector<LedgerRow> Ledger::by_operator() const {
  std::vector<LedgerRow> sums;
  for (const LedgerRow& row : rows) {
    if (sums.empty() || sums.back().operator_name != row.operator_name) {
      sums.push_back({row.operator_name, 0, {}, {}});
    }
    sums.back() += row;
  }
  return sums;
}

Ledger make_ledger(const TraceFile& file) {
  const std::span<const Call> calls = file.calls();
  const std::vector<double> inner = inner_seconds(calls);
  std::map<std::pair<std::uint32_t, unsigned>, LedgerRow> rows;  // by name and level
  for (std::size_t c = 0; c < calls.size(); ++c) {
    const Call& call = calls[c];
    const CallEnding ending = file.ending(call);
    LedgerRow& row = rows[{call.operator_name, call.level}];
    LedgerCell& cell = row.cells[static_cast<std::size_t>(ending)];
    ++cell.calls;
    cell.seconds += call.events.seconds() - inner[c];
    if (!is_refusal(ending)) continue;
    cell.nearest = std::min(cell.nearest, call.missing());
    ++row.nearness[nearness_of(call)];
  }
  Ledger ledger;
  for (auto& [key, row] : rows) {
    row.operator_name = file.name(key.first);
    row.level = key.second;
    ledger.all += row;
    ledger.rows.push_back(row);
  }
  std::sort(ledger.rows.begin(), ledger.rows.end(), [](const LedgerRow& a, const LedgerRow& b) {
    return std::pair(a.operator_name, a.level) < std::pair(b.operator_name, b.level);
  });
  ledger.edits = file.edit_count();
  ledger.lasting = file.edit_count() - file.undo_count();
  return ledger;
}

std::vector<std::uint32_t> calls_in(const TraceFile& file, const LedgerQuestion& question) {
  const std::span<const Call> calls = file.calls();
  std::vector<std::uint32_t> found;
  for (std::uint32_t c = 0; c < calls.size(); ++c) {
    const Call& call = calls[c];
    const bool is_of =
        question.operator_name.empty() || file.name(call.operator_name) == question.operator_name;
    if (!is_of || (question.level && *question.level != call.level)) continue;
    const CallEnding ending = file.ending(call);
    if (question.ending && *question.ending != ending) continue;
    if (question.refused && !is_refusal(ending)) continue;
    found.push_back(c);
  }
  std::stable_sort(found.begin(), found.end(), [&](std::uint32_t a, std::uint32_t b) {
    return calls[a].missing() < calls[b].missing();
  });
  return found;
}

std::string format_ledger(const Ledger& ledger) {
  std::string text;
  fmt::format_to(
      std::back_inserter(text),
      "{} calls: {} accepted for good, {} accepted and undone with a caller, {} refused; "
      "{} of {} edits lasted\n\n{:<44} {:>9} {:>6} {:>9}  {}\n",
      ledger.all.total().calls, ledger.all.cell(CallEnding::for_good).calls,
      ledger.all.cell(CallEnding::undone).calls, ledger.all.refused().calls, ledger.lasting,
      ledger.edits, "operator, and how its calls ended", "calls", "%", "seconds", "nearest lacked");
  for (const LedgerRow& row : ledger.by_operator()) write_block(text, row.operator_name, row);
  write_block(text, "all operators", ledger.all);
  write_nearness(text, ledger.all);
  return text;
}

std::string ledger_json(const TraceFile& file, const Ledger& ledger) {
  Json rows = Json::array();
  for (const LedgerRow& row : ledger.rows) {
    Json json = {{"operator", printable(row.operator_name)}, {"level", row.level}};
    json.update(row_json(row));
    rows.push_back(std::move(json));
  }
  const TraceHeader& header = file.header();
  const Json json = {{"program", printable(header.program)},
                     {"input", printable(header.input)},
                     {"schedule", printable(header.schedule)},
                     {"edits", {{"made", ledger.edits}, {"lasting", ledger.lasting}}},
                     {"all", row_json(ledger.all)},
                     {"rows", rows}};
  return json.dump(2) + "\n";
}

}  // namespace tetmend
