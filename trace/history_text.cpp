// SPDX-License-Identifier: MIT
// A history in words.
#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/spaced.h"
#include "trace/history.h"

namespace tetmend {

std::string_view kind_of(std::span<const VertexHandle> part) {
  constexpr std::array<std::string_view, 5> kKinds = {"", "vertex", "edge", "face", "tet"};
  return kKinds[part.size()];
}

std::string in_words(std::span<const VertexHandle> part) {
  std::string text(kind_of(part));
  for (const VertexHandle v : part) text += fmt::format(" {}", v.index());
  return text;
}

std::string as_question(std::span<const VertexHandle> part) {
  std::string text(kind_of(part));
  for (const VertexHandle v : part)
    text += fmt::format("{}{}", text.back() > '9' ? ':' : ',', v.index());
  return text;
}

namespace {

class Teller {
 public:
  Teller(const TraceFile& file, const History& history) : file_(file), history_(history) {}

  std::string paragraph() {
    who();
    origin();
    aims();
    answer();
    return text_;
  }
  std::string tell(std::size_t most_calls) {
    table();
    calls(most_calls);
    text_ += '\n';
    paragraph();
    text_ += '\n';
    return std::move(text_);
  }

 private:
  template <class... Values>
  void say(fmt::format_string<Values...> text, Values&&... values) {
    if (!text_.empty() && text_.back() != '\n') text_ += ' ';
    fmt::format_to(std::back_inserter(text_), text, std::forward<Values>(values)...);
  }

  const PartHistory& whole() const { return history_.parts.front(); }
  const Call& call(std::uint32_t number) const { return file_.calls()[number]; }

  std::string operator_of(std::uint32_t number) const {
    return spaced(file_.name(call(number).operator_name));
  }
  std::string call_in_words(std::uint32_t number) const {
    const auto target = call(number).target();
    return fmt::format("call {} ({} of {})", number, operator_of(number), in_words(target));
  }
  std::string pass_of(std::uint64_t event) const {
    for (const TracedPass& pass : file_.passes()) {
      if (event >= pass.events.begin && event < pass.events.end) {
        return fmt::format(" in pass {}, round {}", file_.name(pass.name), pass.round);
      }
    }
    return {};
  }

  void who() {
    std::string what = in_words(history_.subject);
    what[0] = 'T';
    if (history_.subject.size() < 4) {
      say("{}{}.", static_cast<char>(std::toupper(in_words(history_.subject)[0])),
          in_words(history_.subject).substr(1));
      return;
    }
    const auto [least, most] = std::minmax_element(history_.angles.begin(), history_.angles.end());
    const bool is_inverted = history_.quality < 0;
    say("{} has quality {:.4f}, {}, angles of {:.2f} to {:.2f} degrees.", what, history_.quality,
        is_inverted                        ? "which is inverted"
        : history_.quality < kBadThreshold ? "which misses the goal of 1"
                                           : "which reaches the goal of 1",
        *least, *most);
  }

  void origin() {
    if (history_.from_beginning) {
      say("It was there from the beginning");
    } else if (history_.made_by == kNoCall) {
      say("It came with event {}{}", history_.made, pass_of(history_.made));
    } else {
      say("It was made by {}{}", call_in_words(history_.made_by), pass_of(history_.made));
    }
    if (!history_.removed) {
      text_ += ", and is there when the trace ends.";
    } else if (history_.removed_by == kNoCall) {
      text_ +=
          fmt::format(", and went with event {}{}.", *history_.removed, pass_of(*history_.removed));
    } else {
      text_ += fmt::format(", and was removed by {}{}.", call_in_words(history_.removed_by),
                           pass_of(*history_.removed));
    }
    if (history_.moves > 0) {
      say("Its vertices were moved {} time{} for good.", history_.moves,
          history_.moves == 1 ? "" : "s");
    }
  }

  void aims() {
    std::uint32_t lasting = 0;
    std::uint32_t trials = 0;
    std::map<std::string_view, std::uint32_t> verdicts;
    for (const HistoryCall& each : history_.calls) {
      if (each.in_trial) {
        ++trials;
        continue;
      }
      ++lasting;
      ++verdicts[call(each.call).verdict_text()];
    }
    if (history_.subject.size() == 4) {
      const auto visits = history_.visits.size();
      if (visits == 0) {
        say("No pass wanted to get rid of it.");
      } else {
        say("Passes wanted to get rid of it {} time{}.", visits, visits == 1 ? "" : "s");
      }
    }
    if (lasting + trials == 0) {
      say("No call aimed at it or a part of it{}.",
          file_.header().filter.empty() ? "" : ", but the trace does not hold all calls");
      return;
    }
    say("{} call{} aimed at it or its parts", lasting, lasting == 1 ? "" : "s");
    std::vector<std::string> words;
    for (const auto& [verdict, number] : verdicts) {
      words.push_back(fmt::format("{} {}{}", number, verdict,
                                  verdict == to_string(Verdict::accepted) ? " for good" : ""));
    }
    if (!words.empty()) text_ += fmt::format(" ({})", fmt::join(words, ", "));
    if (trials > 0) text_ += fmt::format(", {} more in trials that were undone", trials);
    text_ += '.';
  }

  /// What came nearest, and why that was not enough.
  void answer() {
    if (history_.removed || history_.subject.size() < 2) return;
    const bool is_tet = history_.subject.size() == 4;
    const PartHistory* nearest = nullptr;
    for (const PartHistory& part : history_.parts) {
      if (!is_tet && part.part != history_.subject) continue;
      if (part.nearest == kNoCall || call(part.nearest).accepted()) continue;
      if (nearest == nullptr || missing(part) < missing(*nearest)) nearest = &part;
    }
    if (nearest != nullptr && call(nearest->nearest).has_qualities()) {
      const Call& best = call(nearest->nearest);
      say("Nearest came {}: {}: {}.", call_in_words(nearest->nearest), figures_of(best),
          file_.reason(best));
    } else if (nearest != nullptr) {
      say("Nothing that could be built was found; the last answer, of {}: {}.",
          call_in_words(nearest->nearest), file_.reason(call(nearest->nearest)));
    }
    if (is_tet) surface();
  }

  /// How much of the tet stays.
  void surface() {
    const auto on_surface =
        std::count_if(history_.parts.begin(), history_.parts.end(),
                      [](const PartHistory& p) { return p.part.size() == 1 && p.on_surface; });
    const auto fixed_edges =
        std::count_if(history_.parts.begin(), history_.parts.end(),
                      [](const PartHistory& p) { return p.part.size() == 2 && p.on_surface; });
    if (on_surface > 0) {
      say("{} of its 4 vertices and {} of its 6 edges lie on the surface, which stays.", on_surface,
          fixed_edges);
    }
  }

  /// What a refused call had to offer. The worst tet alone may be better: others count, too.
  static std::string figures_of(const Call& call) {
    if (call.worst_after < call.worst_before) {
      return fmt::format("its worst tet had quality {:.4f} and needed more than {:.4f}",
                         call.worst_after, call.worst_before);
    }
    std::string text = fmt::format("its worst tet had quality {:.4f}, as against {:.4f}",
                                   call.worst_after, call.worst_before);
    if (call.bad_after != call.bad_before) {
      text += fmt::format(", with {} bad tet{} in place of {}", call.bad_after,
                          call.bad_after == 1 ? "" : "s", call.bad_before);
    }
    return text;
  }

  double missing(const PartHistory& part) const {
    const Call& best = call(part.nearest);
    return best.has_qualities() ? best.missing() : 1e30;
  }

  void table() {
    text_ += fmt::format("{:<34} {:>7} {:>6} {:>8} {:>6} {:>7}  {}\n", "part", "where", "calls",
                         "for good", "undone", "trials",
                         "nearest refused call, worst tet before and with it");
    for (const PartHistory& part : history_.parts) {
      const bool is_interesting = part.calls + part.in_trials > 0 || part.part.size() == 2;
      if (!is_interesting && &part != &whole()) continue;
      text_ += fmt::format("{:<34} {:>7} {:>6} {:>8} {:>6} {:>7}", in_words(part.part),
                           part.on_surface ? "surface" : "inside", part.calls, part.accepted,
                           part.undone, part.in_trials);
      if (part.nearest != kNoCall && !call(part.nearest).accepted()) {
        const Call& best = call(part.nearest);
        text_ += fmt::format("  {}: {}", part.nearest, best.verdict_text());
        if (best.has_qualities()) {
          text_ += fmt::format(", {:.4f} -> {:.4f}", best.worst_before, best.worst_after);
        }
      }
      text_ += '\n';
    }
  }

  /// In their order. The refused ones from which least was missing come before accepted ones, and
  /// those in trials last.
  std::vector<HistoryCall> nearest_calls(std::size_t most) const {
    std::vector<HistoryCall> chosen = history_.calls;
    if (chosen.size() <= most) return chosen;
    const auto distance = [&](const HistoryCall& each) {
      const Call& c = call(each.call);
      if (each.in_trial) return std::numeric_limits<double>::infinity();
      if (c.accepted()) return 1e20;
      return c.has_qualities() ? c.missing() : 1e30;
    };
    std::sort(chosen.begin(), chosen.end(), [&](const auto& one, const auto& other) {
      const double near = distance(one), far = distance(other);
      return near != far ? near < far : one.call > other.call;
    });
    chosen.resize(most);
    std::sort(chosen.begin(), chosen.end(),
              [](const auto& one, const auto& other) { return one.call < other.call; });
    return chosen;
  }

  void calls(std::size_t most) {
    if (history_.calls.empty()) return;
    const std::vector<HistoryCall> chosen = nearest_calls(most);
    text_ +=
        fmt::format("\n{:>9}  {:<32} {:<28} {:<24}\n", "call", "operator", "target", "verdict");
    for (const HistoryCall& each : chosen) {
      const Call& c = call(each.call);
      const auto target = c.target();
      text_ += fmt::format("{:>9}  {:<32} {:<28} {:<24}", each.call, file_.name(c.operator_name),
                           in_words(target), c.verdict_in_words());
      if (c.has_qualities())
        text_ += fmt::format(" {:.4f} -> {:.4f}", c.worst_before, c.worst_after);
      if (each.in_trial) text_ += "  in a trial that was undone";
      text_ += '\n';
    }
    if (const std::size_t others = history_.calls.size() - chosen.size(); others > 0) {
      text_ += fmt::format(
          "{:>9}  more, in trials or farther from being accepted; --all lists them\n", others);
    }
  }

  const TraceFile& file_;
  const History& history_;
  std::string text_;
};

}  // namespace

std::string history_paragraph(const TraceFile& file, const History& history) {
  return Teller(file, history).paragraph();
}

std::string history_text(const TraceFile& file, const History& history, std::size_t most_calls) {
  return Teller(file, history).tell(most_calls);
}

}  // namespace tetmend
