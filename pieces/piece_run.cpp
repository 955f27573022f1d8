// SPDX-License-Identifier: MIT
#include "pieces/piece_run.h"

#include <algorithm>
#include <limits>

namespace tetmend::pieces {

namespace {

/// Tets that a zone may have however small the pieces are: so many need little memory.
constexpr std::size_t kLeastZone = 200'000;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

bool is_better(const Standing& now, const Standing& before) {
  return now.indicators.n_bad < before.indicators.n_bad || now.worst_angle > before.worst_angle;
}

void PieceRun::set_limits(const Limits& limits) {
  start_ = std::chrono::steady_clock::now();
  limits_ = limits;
}

double PieceRun::seconds_left() const {
  return limits_.seconds - seconds_since(start_);
}

bool PieceRun::is_to_stop() {
  if (limits_.seconds > 0 && seconds_left() <= 0) out_of_time_ = true;
  stopped_ = stopped_ || out_of_time_ || (stop_ && stop_());
  return stopped_;
}

Figures PieceRun::measure_before() {
  mesh_.divide(division_.pieces, 0);
  is_divided_ = true;
  Figures all;
  for (std::size_t part = 0; part < mesh_.parts(); ++part) {
    all.add(measure_own(mesh_.gathered(part), mesh_.state().parting,
                        static_cast<std::uint32_t>(part), options_.standard.goal()));
  }
  return all;
}

void PieceRun::run() {
  while (!is_to_stop()) {
    StepRecord record;
    if (!begin_step(record)) break;
    const auto start = std::chrono::steady_clock::now();
    work(record);
    record.seconds = seconds_since(start);
    limits_.tets = record.after.tets;
    if (listener_) listener_(record);
    records_.push_back(std::move(record));
  }
}

/// False: all is done.
bool PieceRun::begin_step(StepRecord& record) {
  const auto step = static_cast<unsigned>(records_.size());
  if (step < division_.divisions) {
    record.number = step + 1;
    if (!is_divided_) mesh_.divide(division_.pieces, step);
    is_divided_ = false;
    return true;
  }
  const unsigned round = step - division_.divisions;
  if (round >= division_.zone_rounds || records_.empty()) return false;
  const Standing& last = records_.back().after;
  if (last.indicators.n_bad == 0) return false;
  if (round > 0 && !is_better(last, records_[step - 2].after)) return false;
  const std::vector<WorstTet> worst = last.worst.take();
  const std::size_t most = std::max(kLeastZone, last.tets / division_.pieces);
  record.is_zones = true;
  record.number = round + 1;
  mesh_.divide(division_.pieces, division_.divisions - 1, ZoneMap(worst, most));
  return true;
}

bool PieceRun::is_active(std::size_t part, const StepRecord& record) const {
  return !record.is_zones || part >= mesh_.state().parting.stretches();
}

void PieceRun::work(StepRecord& record) {
  for (std::size_t part = 0; part < mesh_.parts(); ++part) {
    record.pieces += is_active(part, record) ? 1 : 0;
  }
  std::vector<std::uint64_t> added(mesh_.parts(), 0);
  for (std::size_t part = 0; part < mesh_.parts(); ++part) {
    added[part] = work_on_part(part, record);
  }
  mesh_.number_added(added);
}

/// Returns how many vertices it has added.
std::uint64_t PieceRun::work_on_part(std::size_t part, StepRecord& record) {
  const Piece gathered = mesh_.gathered(part);
  const Parting& parting = mesh_.state().parting;
  const auto number = static_cast<std::uint32_t>(part);
  TaskResult result;
  if (!is_active(part, record) || is_to_stop() || gathered.tets.empty()) {
    result.piece = own_part(gathered, parting, number);
  } else {
    result = work_on(gathered, parting, number, options_, limits_of_a_piece(record));
  }
  record.after.add(standing_of(result.piece, options_.standard, parting.side));
  for (std::size_t i = 0; i < kVerdictCount; ++i) record.verdicts[i] += result.verdicts[i];
  record.items += result.items;
  record.deferred += result.deferred;
  record.stayed += result.went_back ? 1 : 0;
  if (options_.fault) options_.fault(part, result.piece);
  mesh_.store(part, result.piece);
  return result.added;
}

/// Each has an equal share of what the mesh may grow by, and zones of the bad tets that were removed:
/// whoever would need more.
TaskLimits PieceRun::limits_of_a_piece(const StepRecord& record) const {
  TaskLimits limits;
  limits.is_zone = record.is_zones;
  if (!record.is_zones && record.number > 1) limits.rings = division_.rings;
  if (limits_.most_tets != std::numeric_limits<std::size_t>::max()) {
    limits.most_new_tets =
        limits_.most_tets > limits_.tets ? (limits_.most_tets - limits_.tets) / record.pieces : 0;
  }
  if (record.is_zones) {
    const std::size_t now = records_.back().after.indicators.n_bad;
    constexpr std::size_t kShare = 20;  // of what was gained
    limits.spare_bad = limits_.n_bad > now ? (limits_.n_bad - now) / kShare / record.pieces : 0;
  }
  if (limits_.seconds > 0) limits.seconds = std::max(1e-3, seconds_left());
  return limits;
}

Figures PieceRun::measure_after() {
  mesh_.divide(division_.pieces, division_.divisions);
  Figures all;
  const std::vector<std::uint64_t> none(mesh_.parts(), 0);
  for (std::size_t part = 0; part < mesh_.parts(); ++part) {
    const Piece gathered = mesh_.gathered(part);
    const auto number = static_cast<std::uint32_t>(part);
    all.add(measure_own(gathered, mesh_.state().parting, number, options_.standard.goal()));
    mesh_.store(part, own_part(gathered, mesh_.state().parting, number));
  }
  mesh_.number_added(none);
  return all;
}

}  // namespace tetmend::pieces
