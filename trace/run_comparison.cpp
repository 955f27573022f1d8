// SPDX-License-Identifier: MIT
#include "trace/run_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/printable.h"

namespace tetmend {

namespace {

using Corners = std::array<Point, 4>;

Corners corners_in_file(const SlotMesh& mesh, TetHandle t) {
  Corners corners;
  const TetVertices& tet = mesh.vertices(t);
  for (unsigned i = 0; i < 4; ++i) corners[i] = mesh.scale().to_file(mesh.point(tet[i]));
  return corners;
}

double signed_volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// The least of the four barycentric coordinates: not negative inside of the tet.
double depth_in(const Corners& tet, const Point& p) {
  const double whole = signed_volume(tet[0], tet[1], tet[2], tet[3]);
  if (whole == 0) return -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  for (unsigned i = 0; i < 4; ++i) {
    Corners part = tet;
    part[i] = p;
    least = std::min(least, signed_volume(part[0], part[1], part[2], part[3]) / whole);
  }
  return least;
}

struct BadTet {
  TetHandle tet;
  Point centroid;
  TetHandle there;                                          // of the other mesh
  double depth = -std::numeric_limits<double>::infinity();  // of the centroid in it
};

std::vector<BadTet> bad_tets(const SlotMesh& mesh) {
  std::vector<BadTet> bad;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || !(mesh.quality(t) < kBadThreshold)) continue;
    const Corners c = corners_in_file(mesh, t);
    bad.push_back({t, (c[0] + c[1] + c[2] + c[3]) / 4, {}});
  }
  return bad;
}

/// Places by the cells of a regular grid.
class PlaceGrid {
 public:
  explicit PlaceGrid(const std::vector<BadTet>& places) {
    low_ = high_ = places.front().centroid;
    for (const BadTet& place : places) {
      low_ = low_.cwiseMin(place.centroid);
      high_ = high_.cwiseMax(place.centroid);
    }
    constexpr double kMostCells = 100;
    cells_ = static_cast<int>(
        std::clamp(std::cbrt(static_cast<double>(places.size())), 1.0, kMostCells));
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      const auto at = cell_of(places[i].centroid);
      by_cell_[number_of(at)].push_back(i);
    }
  }

  /// Calls with each place in the cells that the box of a tet meets.
  template <class Use>
  void near(const Corners& tet, Use use) const {
    Point low = tet[0];
    Point high = tet[0];
    for (const Point& corner : tet) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    for (int k = 0; k < 3; ++k) {
      if (high[k] < low_[k] || low[k] > high_[k]) return;
    }
    const auto from = cell_of(low);
    const auto to = cell_of(high);
    for (int x = from[0]; x <= to[0]; ++x) {
      for (int y = from[1]; y <= to[1]; ++y) {
        for (int z = from[2]; z <= to[2]; ++z) {
          const auto found = by_cell_.find(number_of({x, y, z}));
          if (found == by_cell_.end()) continue;
          for (const std::uint32_t place : found->second) use(place);
        }
      }
    }
  }

 private:
  std::array<int, 3> cell_of(const Point& p) const {
    std::array<int, 3> cell{};
    for (int k = 0; k < 3; ++k) {
      const double size = high_[k] - low_[k];
      const double share = size > 0 ? (p[k] - low_[k]) / size : 0;
      cell[static_cast<std::size_t>(k)] =
          std::clamp(static_cast<int>(share * cells_), 0, cells_ - 1);
    }
    return cell;
  }
  int number_of(const std::array<int, 3>& cell) const {
    return (cell[0] * cells_ + cell[1]) * cells_ + cell[2];
  }

  Point low_, high_;
  int cells_ = 1;
  std::map<int, std::vector<std::uint32_t>> by_cell_;
};

/// Finds the tet of the other mesh at each place: the one in which it lies deepest.
void find_there(const SlotMesh& other, std::vector<BadTet>& bad) {
  if (bad.empty()) return;
  const PlaceGrid grid(bad);
  for (std::uint32_t i = 0; i < other.tet_slots(); ++i) {
    const TetHandle t(i);
    if (other.is_deleted(t)) continue;
    const Corners corners = corners_in_file(other, t);
    grid.near(corners, [&](std::uint32_t place) {
      const double depth = depth_in(corners, bad[place].centroid);
      constexpr double kRounding = -1e-9;
      if (depth < kRounding || depth <= bad[place].depth) return;
      bad[place].depth = depth;
      bad[place].there = t;
    });
  }
}

/// @param first the mesh at the beginning
std::vector<BadAtTime> bad_over_time(const TraceFile& file, const SlotMesh& first) {
  std::vector<BadAtTime> over = {{0, bad_tets(first).size()}};
  for (const TracedPass& pass : file.passes()) {
    over.push_back({pass.events.end_seconds, pass.now.n_bad});
  }
  return over;
}

HistorySubject subject_of(const SlotMesh& mesh, TetHandle t) {
  HistorySubject subject(mesh.vertices(t).begin(), mesh.vertices(t).end());
  std::sort(subject.begin(), subject.end());
  return subject;
}

std::vector<TetPair> pairs_of(const SlotMesh& mesh, const SlotMesh& other,
                              const std::vector<BadTet>& bad) {
  std::vector<TetPair> pairs;
  for (const BadTet& each : bad) {
    if (!each.there.is_valid() || other.quality(each.there) < kBadThreshold) continue;
    pairs.push_back({subject_of(mesh, each.tet), subject_of(other, each.there),
                     mesh.quality(each.tet), other.quality(each.there)});
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const TetPair& one, const TetPair& two) {
    return one.bad_quality < two.bad_quality;
  });
  return pairs;
}

// --- in words ------------------------------------------------------------------------------------

/// Rows of two ledgers, added up by operator; one that is not in a ledger is empty there.
std::map<std::string_view, std::pair<LedgerRow, LedgerRow>> rows_of(const Ledger& a,
                                                                    const Ledger& b) {
  std::map<std::string_view, std::pair<LedgerRow, LedgerRow>> rows;
  for (const LedgerRow& row : a.by_operator()) rows[row.operator_name].first = row;
  for (const LedgerRow& row : b.by_operator()) rows[row.operator_name].second = row;
  return rows;
}

void write_cells(std::string& text, std::string_view name, const LedgerCell& a,
                 const LedgerCell& b) {
  const auto difference = static_cast<std::int64_t>(b.calls) - static_cast<std::int64_t>(a.calls);
  fmt::format_to(std::back_inserter(text), "{:<40} {:>9} {:>9} {:>+9} {:>9.3f} {:>9.3f}\n", name,
                 a.calls, b.calls, difference, a.seconds, b.seconds);
}

void write_rows(std::string& text, std::string_view name, const LedgerRow& a, const LedgerRow& b) {
  text += '\n';
  write_cells(text, name, a.total(), b.total());
  for (std::size_t i = 0; i < kEndingCount; ++i) {
    if (a.cells[i].calls + b.cells[i].calls == 0) continue;
    write_cells(text, fmt::format("  {}", name_of(static_cast<CallEnding>(i))), a.cells[i],
                b.cells[i]);
  }
}

/// What the last pass left that had ended by then.
const TracedPass* pass_before(const TraceFile& file, double seconds) {
  const TracedPass* last = nullptr;
  for (const TracedPass& pass : file.passes()) {
    if (pass.events.end_seconds <= seconds) last = &pass;
  }
  return last;
}

double end_of(const TraceFile& file) {
  return file.passes().empty() ? 0 : file.passes().back().events.end_seconds;
}

void write_time(std::string& text, const TraceFile& a, const TraceFile& b) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "\n{:<20} {:>9} {:>9} {:>9} {:>9}   {}\n", "seconds", "n_bad a", "q_worst a",
                 "n_bad b", "q_worst b", "after the last pass that had ended");
  const auto figures = [&](const TraceFile& file, double seconds) {
    const TracedPass* pass = pass_before(file, seconds);
    if (pass == nullptr) return fmt::format(" {:>9} {:>9}", "-", "-");
    const bool is_over = seconds > end_of(file);
    return fmt::format(" {:>9} {:>9}", fmt::format("{}{}", pass->now.n_bad, is_over ? "." : ""),
                       fmt::format("{:.4f}", pass->now.q_worst));
  };
  constexpr int kSteps = 10;
  const double end = std::max(end_of(a), end_of(b));
  for (int i = 1; i <= kSteps; ++i) {
    const double seconds = i == kSteps ? end : end * i / kSteps;
    fmt::format_to(out, "{:<20.3f}{}{}\n", seconds, figures(a, seconds), figures(b, seconds));
  }
}

void write_pairs(std::string& text, const TraceFile& a, const TraceFile& b,
                 const RunComparison& comparison, std::size_t most) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "\nbad tets at the end: {} in a, {} in b\n", comparison.bad_in_a,
                 comparison.bad_in_b);
  fmt::format_to(out, "bad in a where b has a good tet: {}; bad in b where a has a good one: {}\n",
                 comparison.worse_in_a.size(), comparison.worse_in_b.size());
  if (!comparison.same_beginning) {
    text += "the runs began with different meshes: tets are compared by their place alone\n";
  }
  if (!comparison.same_goal) text += "the goals of the runs differ: good is what each calls good\n";
  const std::size_t count = std::min(most, comparison.worse_in_a.size());
  if (count == 0) return;
  Replay of_a(a, 0);
  Replay of_b(b, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const TetPair& pair = comparison.worse_in_a[i];
    fmt::format_to(out, "\n{} of a, quality {:.4f}, and {} of b, quality {:.4f}\n",
                   as_question(pair.bad), pair.bad_quality, as_question(pair.good),
                   pair.good_quality);
    fmt::format_to(out, "  a: {}\n", history_paragraph(a, history_of(a, of_a, pair.bad)));
    fmt::format_to(out, "  b: {}\n", history_paragraph(b, history_of(b, of_b, pair.good)));
  }
}

std::string name_of_run(const TraceFile& file) {
  const TraceHeader& header = file.header();
  std::string text = fmt::format("{}: {}, schedule {}", printable(file.path().string()),
                                 printable(header.input), printable(header.schedule));
  for (const auto& [name, value] : header.settings) {
    text += fmt::format(", {} = {}", printable(name), printable(value));
  }
  return text;
}

using PairJson = nlohmann::ordered_json;

PairJson vertices_json(const HistorySubject& subject) {
  PairJson numbers = PairJson::array();
  for (const VertexHandle v : subject) numbers.push_back(v.index());
  return numbers;
}

PairJson pairs_json(const std::vector<TetPair>& pairs) {
  PairJson list = PairJson::array();
  for (const TetPair& pair : pairs) {
    list.push_back({{"bad", vertices_json(pair.bad)},
                    {"bad_quality", pair.bad_quality},
                    {"good", vertices_json(pair.good)},
                    {"good_quality", pair.good_quality}});
  }
  return list;
}

PairJson over_time_json(const std::vector<BadAtTime>& over) {
  PairJson list = PairJson::array();
  for (const BadAtTime& each : over) {
    list.push_back({{"seconds", each.seconds}, {"n_bad", each.n_bad}});
  }
  return list;
}

}  // namespace

RunComparison compare_runs(const TraceFile& a, const TraceFile& b) {
  RunComparison comparison;
  comparison.a = make_ledger(a);
  comparison.b = make_ledger(b);
  comparison.same_beginning = a.initial_mesh().fingerprint() == b.initial_mesh().fingerprint();
  Replay of_a(a, 0);
  Replay of_b(b, 0);
  comparison.over_a = bad_over_time(a, of_a.mesh());
  comparison.over_b = bad_over_time(b, of_b.mesh());
  const SlotMesh& mesh_a = of_a.mesh_at(a.event_count());
  const SlotMesh& mesh_b = of_b.mesh_at(b.event_count());
  const Standard& by_a = mesh_a.standard();
  const Standard& by_b = mesh_b.standard();
  comparison.same_goal = by_a.goal() == by_b.goal() && by_a.measure_name() == by_b.measure_name();
  std::vector<BadTet> bad_a = bad_tets(mesh_a);
  std::vector<BadTet> bad_b = bad_tets(mesh_b);
  find_there(mesh_b, bad_a);
  find_there(mesh_a, bad_b);
  comparison.bad_in_a = bad_a.size();
  comparison.bad_in_b = bad_b.size();
  comparison.worse_in_a = pairs_of(mesh_a, mesh_b, bad_a);
  comparison.worse_in_b = pairs_of(mesh_b, mesh_a, bad_b);
  return comparison;
}

std::string format_comparison(const TraceFile& a, const TraceFile& b,
                              const RunComparison& comparison, std::size_t most) {
  std::string text = fmt::format("a = {}\nb = {}\n\n", name_of_run(a), name_of_run(b));
  fmt::format_to(std::back_inserter(text), "{:<40} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
                 "operator, and how its calls ended", "calls a", "calls b", "b - a", "seconds a",
                 "seconds b");
  for (const auto& [name, rows] : rows_of(comparison.a, comparison.b)) {
    write_rows(text, name, rows.first, rows.second);
  }
  write_rows(text, "all operators", comparison.a.all, comparison.b.all);
  write_time(text, a, b);
  write_pairs(text, a, b, comparison, most);
  return text;
}

std::string comparison_json(const TraceFile& a, const TraceFile& b,
                            const RunComparison& comparison) {
  const PairJson json = {{"a", PairJson::parse(ledger_json(a, comparison.a))},
                         {"b", PairJson::parse(ledger_json(b, comparison.b))},
                         {"same_beginning", comparison.same_beginning},
                         {"same_goal", comparison.same_goal},
                         {"bad_in_a", comparison.bad_in_a},
                         {"bad_in_b", comparison.bad_in_b},
                         {"bad_over_time_a", over_time_json(comparison.over_a)},
                         {"bad_over_time_b", over_time_json(comparison.over_b)},
                         {"bad_in_a_good_in_b", pairs_json(comparison.worse_in_a)},
                         {"bad_in_b_good_in_a", pairs_json(comparison.worse_in_b)}};
  return json.dump(2) + "\n";
}

}  // namespace tetmend
