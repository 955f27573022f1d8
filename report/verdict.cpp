// SPDX-License-Identifier: MIT
#include "report/verdict.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "explain/page_text.h"

namespace tetmend::report {

namespace {

using explain::escaped;

std::string angles_of(const Figures& figures) {
  return fmt::format("The smallest angle was {} degrees and is {}, the largest was {} and is {}",
                     figures.shown("before.theta_min", 2), figures.shown("after.theta_min", 2),
                     figures.shown("before.theta_max", 2), figures.shown("after.theta_max", 2));
}

std::string goal_of(const Figures& figures) {
  return fmt::format("the goal of {} to {} degrees", figures.shown_digits("goal.min_angle", 6),
                     figures.shown_digits("goal.max_angle", 6));
}

/// What became of the bad tets, as the beginning of a sentence.
std::string bad_tets_of(const Figures& figures) {
  const std::size_t before = figures.count("before.n_bad");
  const std::size_t after = figures.count("after.n_bad");
  const std::string was = figures.shown_count("before.n_bad");
  const std::string is = figures.shown_count("after.n_bad");
  if (before == 0 && after == 0) {
    return fmt::format("No tet missed {}, and none does now ({} before, {} after)",
                       goal_of(figures), was, is);
  }
  if (after == 0) {
    return fmt::format("T{} is reached: {} bad tet{} gone", goal_of(figures).substr(1),
                       before == 1 ? "the " + was : "all " + was, before == 1 ? " is" : "s are");
  }
  std::string text =
      fmt::format("{} of {} bad tets {} left and miss{} {}", is, was, after == 1 ? "is" : "are",
                  after == 1 ? "es" : "", goal_of(figures));
  if (const std::size_t forced = figures.count("limit.n_forced"); forced > 0) {
    text += fmt::format("; the surface forces at least {} of them",
                        figures.shown_count("limit.n_forced"));
  }
  return text;
}

/// True if a promised figure whose name begins so is worse than before.
bool is_worse(const Figures& figures, std::string_view name) {
  const nlohmann::json& worse = figures.at("worse_than_before");
  return std::any_of(worse.begin(), worse.end(), [&](const nlohmann::json& text) {
    return text.is_string() && text.get_ref<const std::string&>().starts_with(name);
  });
}

class Promises {
 public:
  explicit Promises(const Figures& figures) : figures_(figures) {}

  /// A figure of the report that must not be worse.
  void add(std::string_view text, std::string_view path, int decimals, std::string_view worse) {
    const std::string was = fmt::format("before.{}", path);
    const std::string is = fmt::format("after.{}", path);
    if (!figures_.has(was) && !figures_.has(is)) return;
    list.push_back(
        {std::string(text), shown(was, decimals), shown(is, decimals), !is_worse(figures_, worse)});
  }
  /// One that inverted tets go before, where they are mended.
  void add_behind_mending(std::string_view text, std::string_view path, int decimals,
                          std::string_view worse) {
    const std::size_t old_size = list.size();
    add(text, path, decimals, worse);
    if (list.size() > old_size) list.back().is_price = is_mended_ && !list.back().is_kept;
  }

  std::vector<Promise> list;

 private:
  std::string shown(const std::string& path, int decimals) const {
    return decimals < 0 ? figures_.shown_count(path) : figures_.shown(path, decimals);
  }

  const Figures& figures_;
  const bool is_mended_ =
      figures_.count("not_positive_tets.after") < figures_.count("not_positive_tets.before");
};

/// What became of the surface, as the end of a sentence.
std::string surface_of(const Figures& figures) {
  if (!figures.has("surface.tolerance")) return "the surface is untouched";
  if (figures.number("surface.tolerance") == 0) return "the surface has the same shape";
  return fmt::format("the surface moved by {} at most",
                     figures.shown_digits("surface.proven_distance", 3));
}

/// Of a surface that might move that it did not move farther.
Promise promise_of_surface(const Figures& figures) {
  if (figures.has("surface.tolerance")) {
    const bool stays =
        figures.number("surface.proven_distance") <= figures.number("surface.tolerance");
    return {"The surface stays within its tolerance, proven in both directions",
            figures.shown_digits("surface.tolerance", 3),
            figures.shown_digits("surface.proven_distance", 3), stays, true};
  }
  const bool stays =
      figures.is_true("surface.unchanged") &&
      figures.text("surface.fingerprint_before") == figures.text("surface.fingerprint_after");
  return {"The triangles of the surface stay, bit for bit",
          figures.shown_count("before.boundary_triangles"),
          figures.shown_count("after.boundary_triangles"), stays};
}

/// Empty if there are none of this kind.
std::string rows_of(const std::vector<Promise>& promises, bool is_bound) {
  std::string rows;
  for (const Promise& promise : promises) {
    if (promise.is_bound != is_bound) continue;
    rows += fmt::format(
        "<tr class=\"{}\"><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        promise.is_kept ? "kept" : "broken", escaped(promise.text), promise.before, promise.after,
        promise.is_kept    ? "\u2713 kept"
        : promise.is_price ? "\u2717 worse, for mended tets"
                           : "\u2717 broken");
  }
  return rows;
}

std::string headed(std::string_view left, std::string_view right, const std::string& rows) {
  if (rows.empty()) return rows;
  return fmt::format(
      "<table class=\"promises\"><thead><tr><th>promise</th><th>{}</th><th>{}</th><th></th>"
      "</tr></thead><tbody>\n{}</tbody></table>\n",
      left, right, rows);
}

}  // namespace

Verdict verdict_of(const Figures& figures) {
  const bool is_cut = figures.is_true("interrupted") || figures.is_true("out_of_time");
  Verdict verdict{figures.count("after.n_bad") > 0 ? Outcome::missed : Outcome::reached, ""};
  if (is_cut) {
    verdict.outcome = Outcome::interrupted;
    verdict.sentence = figures.is_true("interrupted")
                           ? "The run was interrupted, and this is how far it came: "
                           : "The time limit stopped the run, and this is how far it came: ";
  }
  std::string inverted;
  if (figures.count("not_positive_tets.after") > 0) {
    inverted = fmt::format("; {} of {} inverted or flat tets are left",
                           figures.shown_count("not_positive_tets.after"),
                           figures.shown_count("not_positive_tets.before"));
  }
  verdict.sentence += fmt::format("{}{}. {}; {}.", bad_tets_of(figures), inverted,
                                  angles_of(figures), surface_of(figures));
  return verdict;
}

std::vector<Promise> promises_of(const Figures& figures) {
  constexpr int kCount = -1;
  Promises promises(figures);
  promises.list.push_back(promise_of_surface(figures));
  const std::size_t inverted_before = figures.count("not_positive_tets.before");
  const std::size_t inverted = figures.count("not_positive_tets.after");
  promises.list.push_back({"No more inverted or flat tets, in exact arithmetic",
                           figures.shown_count("not_positive_tets.before"),
                           figures.shown_count("not_positive_tets.after"),
                           inverted <= inverted_before});
  promises.add("No more bad tets", "n_bad", kCount, "a number of bad tets");
  promises.add_behind_mending("No smaller angle, in degrees", "theta_min", 4, "a theta_min");
  promises.add_behind_mending("No larger angle, beyond the goal", "theta_max", 4, "a theta_max");
  promises.add("No larger share of bad angles, in percent", "lambda", 4, "a lambda");
  promises.add("No worse mean ratio of the worst tet", "rulers.mean_ratio.worst", 5,
               "a worst mean ratio");
  promises.add("No worse radius ratio of the worst tet", "rulers.radius_ratio.worst", 5,
               "a worst radius ratio");
  promises.add_behind_mending("No worse edge ratio, beyond 10", "rulers.edge_ratio.worst", 3,
                              "a worst edge ratio");
  promises.add("No worse Jacobian ratio of a curved tet", "second_order.worst_jacobian_ratio", 4,
               "a worst Jacobian ratio");
  return std::move(promises.list);
}

std::string promise_table(const Figures& figures) {
  const std::vector<Promise> promises = promises_of(figures);
  std::string text = headed("tolerance", "moved at most", rows_of(promises, true)) +
                     headed("before", "after", rows_of(promises, false));
  text += fmt::format("<p>Relative change of the volume: {}.</p>\n",
                      figures.shown_digits("volume_change", 2));
  std::string worse;
  for (const nlohmann::json& figure : figures.at("worse_than_before")) {
    worse += fmt::format("<li>{}</li>", escaped(figure.get<std::string>()));
  }
  if (!worse.empty()) text += fmt::format("<p>Worse than before:</p><ul>{}</ul>\n", worse);
  return text;
}

}  // namespace tetmend::report
