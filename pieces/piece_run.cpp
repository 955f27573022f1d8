// SPDX-License-Identifier: MIT
#include "pieces/piece_run.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "contract/inspector.h"
#include "pieces/bytes.h"
#include "pieces/piece_trace.h"

namespace tetmend::pieces {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct PartFigures {
  std::uint64_t part = 0;
  Figures figures;
};

/// Over all ranks, in the order of the parts: sums of reals are the same for any number of ranks.
Figures sum(const std::vector<PartFigures>& mine, Ranks& ranks,
            std::vector<std::uint64_t>& tets_of_parts) {
  std::string bytes;
  for (const PartFigures& each : mine) put(each, bytes);
  std::vector<PartFigures> parts;
  for (const std::string& from : ranks.gather(bytes)) {
    for (std::string_view rest = from; !rest.empty();) take(rest, parts.emplace_back());
  }
  std::sort(parts.begin(), parts.end(),
            [](const PartFigures& a, const PartFigures& b) { return a.part < b.part; });
  Figures all;
  for (const PartFigures& each : parts) {
    all.add(each.figures);
    tets_of_parts.push_back(each.figures.statistics.tets);
  }
  return all;
}

/// Precondition: both have the same bins.
void add(const RulerHistograms& counts, RulerHistograms& to) {
  for (std::size_t r = 0; r < to.size(); ++r) {
    for (std::size_t bin = 0; bin < to[r].counts.size(); ++bin) {
      to[r].counts[bin] += counts[r].counts[bin];
    }
  }
}

/// Over all ranks.
void add_up(RulerHistograms& counts, Ranks& ranks) {
  std::vector<std::int64_t> all;
  for (const RulerHistogram& of : counts) all.insert(all.end(), of.counts.begin(), of.counts.end());
  ranks.add(all);
  auto from = all.begin();
  for (RulerHistogram& of : counts) {
    for (std::size_t& count : of.counts) count = static_cast<std::size_t>(*from++);
  }
}

/// Of all ranks, in the order of the parts.
std::vector<SurfaceShare> share_surface(std::vector<std::pair<std::uint64_t, SurfaceShare>> mine,
                                        Ranks& ranks) {
  std::string bytes;
  for (const auto& [part, share] : mine) {
    put(part, bytes);
    append(share, bytes);
  }
  std::vector<std::pair<std::uint64_t, SurfaceShare>> all;
  mine = {};
  for (const std::string& from : ranks.gather(bytes)) {
    for (std::string_view rest = from; !rest.empty();) {
      std::uint64_t part = 0;
      take(rest, part);
      all.emplace_back(part, take_share(rest));
    }
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SurfaceShare> shares;
  for (auto& [part, share] : all) shares.push_back(std::move(share));
  return shares;
}

}  // namespace

bool is_better(const Standing& now, const Standing& before) {
  return now.indicators.n_bad < before.indicators.n_bad || now.worst_angle > before.worst_angle;
}

void append(const PartOutcome& outcome, std::string& bytes) {
  put(outcome.part, bytes);
  put(outcome.added, bytes);
  put(outcome.stayed, bytes);
  put(outcome.verdicts, bytes);
  put(outcome.items, bytes);
  put(outcome.deferred, bytes);
  append(outcome.standing, bytes);
}

PartOutcome take_outcome(std::string_view& bytes) {
  PartOutcome outcome;
  take(bytes, outcome.part);
  take(bytes, outcome.added);
  take(bytes, outcome.stayed);
  take(bytes, outcome.verdicts);
  take(bytes, outcome.items);
  take(bytes, outcome.deferred);
  outcome.standing = take_standing(bytes);
  return outcome;
}

void append(const RunState& state, std::string& bytes) {
  put(state.limits, bytes);
  put(state.is_divided, bytes);
  put(state.bounds.has_value(), bytes);
  put(state.bounds.value_or(Bounds()), bytes);
  put(std::uint64_t{state.records.size()}, bytes);
  for (const StepRecord& record : state.records) {
    put(record.is_zones, bytes);
    put(record.number, bytes);
    put(record.pieces, bytes);
    put(record.stayed, bytes);
    put(record.seconds, bytes);
    put(record.verdicts, bytes);
    put(record.items, bytes);
    put(record.deferred, bytes);
    append(record.after, bytes);
  }
}

RunState take_run_state(std::string_view& bytes) {
  RunState state;
  take(bytes, state.limits);
  take(bytes, state.is_divided);
  bool has_bounds = false;
  Bounds bounds;
  take(bytes, has_bounds);
  take(bytes, bounds);
  if (has_bounds) state.bounds = bounds;
  std::uint64_t count = 0;
  take(bytes, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    StepRecord& record = state.records.emplace_back();
    take(bytes, record.is_zones);
    take(bytes, record.number);
    take(bytes, record.pieces);
    take(bytes, record.stayed);
    take(bytes, record.seconds);
    take(bytes, record.verdicts);
    take(bytes, record.items);
    take(bytes, record.deferred);
    record.after = take_standing(bytes);
  }
  return state;
}

void PieceRun::set_limits(const RunLimits& limits) {
  start_ = std::chrono::steady_clock::now();
  state_.limits = limits;
}

double PieceRun::seconds_left() const {
  return state_.limits.seconds - seconds_since(start_);
}

bool PieceRun::is_to_stop() {
  if (state_.limits.seconds > 0 && seconds_left() <= 0) out_of_time_ = true;
  stopped_ = stopped_ || out_of_time_ || (stop_ && stop_());
  return stopped_;
}

/// What stops one rank stops all.
void PieceRun::agree_on_stop() {
  is_to_stop();
  std::array<std::int64_t, 2> votes = {stopped_ ? 1 : 0, out_of_time_ ? 1 : 0};
  mesh_.ranks().add(votes);
  stopped_ = votes[0] > 0;
  out_of_time_ = votes[1] > 0;
}

void PieceRun::divide_first(Shelf* next) {
  if (!state_.is_divided) mesh_.divide(division_.pieces, 0, next);
  state_.is_divided = true;
}

std::string PieceRun::hold_surface(const EnvelopeOptions& options, Shelf* next) {
  divide_first(next);
  std::vector<std::pair<std::uint64_t, SurfaceShare>> mine;
  const DivisionState& state = mesh_.state();
  each_own([&](std::size_t part) -> SideBySide::Use {
    SurfaceShare share =
        share_of_input(mesh_.gathered(part), state.parting, static_cast<std::uint32_t>(part));
    return [&mine, part, share = std::move(share)]() mutable {
      mine.emplace_back(part, std::move(share));
    };
  });
  const std::vector<SurfaceShare> shares = share_surface(std::move(mine), mesh_.ranks());
  surface_ = std::make_unique<HeldSurface>(shares, options, state.low, state.high);
  std::string saved;
  for (const SurfaceShare& share : shares) append(share, saved);
  return saved;
}

void PieceRun::hold_surface(const EnvelopeOptions& options, std::string_view saved) {
  std::vector<SurfaceShare> shares;
  while (!saved.empty()) shares.push_back(take_share(saved));
  const DivisionState& state = mesh_.state();
  surface_ = std::make_unique<HeldSurface>(shares, options, state.low, state.high);
}

/// Until the first step is done, pieces have no patches: what they belong to is looked up.
Piece PieceRun::gathered(std::size_t part) const {
  Piece piece = mesh_.gathered(part);
  if (surface_ && state_.records.empty()) {
    surface_->label(piece, mesh_.state().parting, static_cast<std::uint32_t>(part));
  }
  return piece;
}

void PieceRun::set_side_by_side(std::size_t most) {
  side_by_side_ = SideBySide(most);
  mesh_.set_side_by_side(most);
}

/// Of this rank. See SideBySide.
void PieceRun::each_own(const std::function<SideBySide::Use(std::size_t part)>& make) const {
  const std::vector<std::size_t>& own = mesh_.own();
  side_by_side_.each(own.size(), [&](std::size_t i) { return make(own[i]); });
}

/// Nothing where it is not wanted.
std::optional<Survey> PieceRun::survey_for(const Wanted& wanted) {
  if (!wanted.rulers) return std::nullopt;
  const std::uint64_t tets = std::max(state_.limits.tets, wanted.tets);
  return Survey{.worst = WorstScores(tets),
                .lengths = face::LocalLengths(wanted.vertices),
                .first_id = mesh_.state().first_id,
                .vertices = wanted.vertices,
                .finds_holders = wanted.holders};
}

Measured PieceRun::measure_before(const Wanted& wanted, Shelf* next) {
  divide_first(next);
  std::optional<Survey> survey = survey_for(wanted);
  std::vector<PartFigures> mine;
  Bounds bounds = Bounds::of_goal(options_.standard);
  each_own([&](std::size_t part) -> SideBySide::Use {
    const Piece piece = mesh_.gathered(part);
    const Parting& parting = mesh_.state().parting;
    const auto number = static_cast<std::uint32_t>(part);
    std::optional<Survey> found = survey_for(wanted);
    const Figures figures = measure_own(piece, parting, number, options_.standard,
                                        found ? &*found : nullptr, options_.wanted());
    const Bounds own = bounds_of_own(piece, parting, number, options_.standard);
    return [&, part, figures, own, found = std::move(found)]() mutable {
      mine.push_back({part, figures});
      bounds.widen(own);
      if (survey) survey->add(*std::move(found));
    };
  });
  agree_on_bounds(bounds);
  Measured measured;
  std::vector<std::uint64_t> tets;
  measured.figures = sum(mine, mesh_.ranks(), tets);
  if (survey) add_survey(tets, *std::move(survey), mesh_.ranks(), measured);
  if (!wanted.histograms || !measured.rulers) return measured;
  RulerHistograms& counts = measured.histograms.emplace(bins_for(*measured.rulers));
  for (const std::size_t part : mesh_.own()) {
    count_own(mesh_.gathered(part), mesh_.state().parting, static_cast<std::uint32_t>(part),
              counts);
  }
  add_up(counts, mesh_.ranks());
  return measured;
}

/// No piece may have worse tets than the whole mesh had: which piece has which must not show, and a
/// good one must not be held to its own worst.
void PieceRun::agree_on_bounds(const Bounds& mine) {
  Bounds all = mine;
  std::string bytes;
  put(mine, bytes);
  for (const std::string& from : mesh_.ranks().gather(bytes)) {
    std::string_view rest = from;
    Bounds other;
    take(rest, other);
    all.widen(other);
  }
  state_.bounds = all;
}

void PieceRun::find_bounds() {
  Bounds bounds = Bounds::of_goal(options_.standard);
  each_own([&](std::size_t part) -> SideBySide::Use {
    const Bounds own = bounds_of_own(mesh_.gathered(part), mesh_.state().parting,
                                     static_cast<std::uint32_t>(part), options_.standard);
    return [&bounds, own] { bounds.widen(own); };
  });
  agree_on_bounds(bounds);
}

void PieceRun::run() {
  agree_on_stop();
  if (!stopped_ && !state_.bounds) {
    divide_first(nullptr);
    find_bounds();
  }
  while (!stopped_) {
    const auto start = std::chrono::steady_clock::now();
    std::optional<StepRecord> record = begin_step();
    if (!record) break;
    if (options_.trace != nullptr) {
      options_.trace->begin_round(
          mesh_, {round(), record->is_zones, rings_of(*record), options_.standard});
    }
    std::vector<PartOutcome> mine;
    each_own([&](std::size_t part) -> SideBySide::Use {
      WorkedPart worked = work_on(part, *record);
      mesh_.remove_gathered(part);
      return [&, worked = std::move(worked)]() mutable {
        if (worked.time) times_.push_back(*worked.time);
        mine.push_back(std::move(worked.outcome));
        if (mine.size() == 1) return;  // one list of worst tets is enough
        mine.front().standing.worst.add(std::exchange(mine.back().standing.worst, {}));
      };
    });
    std::vector<PartOutcome> all = share(std::move(mine));
    record->seconds = seconds_since(start);
    agree_on_stop();
    end_step(std::move(*record), std::move(all));
    if (listener_) listener_(state_.records.back());
  }
}

std::optional<StepRecord> PieceRun::begin_step(Shelf* next) {
  StepRecord record;
  const auto step = static_cast<unsigned>(state_.records.size());
  if (step < division_.divisions) {
    record.number = step + 1;
    record.pieces = division_.pieces;
    if (!state_.is_divided) divide_for(record, next);
    state_.is_divided = true;
    return record;
  }
  const unsigned round = step - division_.divisions;
  if (round >= division_.zone_rounds || state_.records.empty()) return std::nullopt;
  const Standing& last = state_.records.back().after;
  if (last.indicators.n_bad == 0) return std::nullopt;
  record.is_zones = true;
  record.number = round + 1;
  if (!state_.is_divided) {
    const bool is_next_pair = round > 0 && round % 2 == 0;
    if (is_next_pair && !is_better(last, state_.records[step - 3].after)) return std::nullopt;
    mesh_.divide_zones(make_zones(last), next);
    state_.is_divided = true;
  }
  record.pieces = mesh_.parts() - mesh_.state().parting.stretches();
  return record;
}

/// A tet may change that has a vertex near a border: its others are one edge further.
void PieceRun::divide_for(const StepRecord& record, Shelf* next) {
  const unsigned shift = record.number - 1;
  const unsigned rings = rings_of(record);
  if (rings > 0) {
    mesh_.divide_near_borders(shift, rings + 1, next);
  } else {
    mesh_.divide(division_.pieces, shift, next);
  }
}

/// Around the worst tets, none that takes more memory than a piece: balls have more tets at their
/// border. In vertices, for these are read without the rest.
ZoneMap PieceRun::make_zones(const Standing& last) const {
  ZoneMap zones(last.worst.take());
  const std::vector<std::int64_t> counts = mesh_.count_vertices(zones);
  const auto vertices = static_cast<std::uint64_t>(counts.back());
  const std::uint64_t tets = std::max<std::uint64_t>(last.tets, 1);
  const std::uint64_t most =
      std::max<std::uint64_t>(2 * tets / 3 / division_.pieces, division_.least_zone);
  zones.cut(std::span(counts).first(zones.balls().size()),
            static_cast<std::int64_t>(std::max<std::uint64_t>(most * vertices / tets, 1)));
  return zones;
}

bool PieceRun::is_active(std::size_t part, const StepRecord& record) const {
  return !record.is_zones || part >= mesh_.state().parting.stretches();
}

PartOutcome PieceRun::work_on_part(std::size_t part, const StepRecord& record) {
  WorkedPart worked = work_on(part, record);
  if (worked.time) times_.push_back(*worked.time);
  return std::move(worked.outcome);
}

/// Other parts may be worked on at the same time.
PieceRun::WorkedPart PieceRun::work_on(std::size_t part, const StepRecord& record) {
  const Piece gathered = this->gathered(part);
  const Parting& parting = mesh_.state().parting;
  const auto number = static_cast<std::uint32_t>(part);
  WorkedPart worked;
  TaskResult result;
  if (!is_active(part, record) || is_to_stop() || gathered.tets.empty()) {
    result.piece = own_part(gathered, parting, number);
  } else {
    const auto start = std::chrono::steady_clock::now();
    try {
      result = pieces::work_on(gathered, parting, number, options_, limits_of(part, record),
                               surface_.get());
    } catch (const contract::Breach& breach) {
      throw Error(fmt::format("round {}, piece {}: {}", round(), part, breach.what()));
    }
    worked.time = {static_cast<std::uint32_t>(state_.records.size()), number, gathered.tets.size(),
                   seconds_since(start)};
  }
  PartOutcome& outcome = worked.outcome;
  outcome.part = part;
  outcome.added = result.added;
  outcome.stayed = result.went_back;
  outcome.standing = standing_of(result.piece, options_.standard, parting.side);
  for (const Piece& rest : mesh_.rest(part)) {
    outcome.standing.add(standing_of(rest, options_.standard, parting.side));
  }
  for (std::size_t i = 0; i < kVerdictCount; ++i) outcome.verdicts[i] = result.verdicts[i];
  outcome.items = result.items;
  outcome.deferred = result.deferred;
  if (options_.fault) options_.fault(part, result.piece);
  mesh_.store(part, result.piece);
  return worked;
}

/// Those of all ranks.
std::vector<PartOutcome> PieceRun::share(std::vector<PartOutcome> mine) {
  if (mesh_.ranks().count() == 1) return mine;
  std::string bytes;
  for (const PartOutcome& outcome : mine) append(outcome, bytes);
  std::vector<PartOutcome> all;
  for (const std::string& from : mesh_.ranks().gather(bytes)) {
    for (std::string_view rest = from; !rest.empty();) all.push_back(take_outcome(rest));
  }
  return all;
}

void PieceRun::end_step(StepRecord record, std::vector<PartOutcome> outcomes) {
  std::sort(outcomes.begin(), outcomes.end(),
            [](const PartOutcome& a, const PartOutcome& b) { return a.part < b.part; });
  std::vector<std::uint64_t> added;
  for (const PartOutcome& outcome : outcomes) {
    added.push_back(outcome.added);
    record.after.add(outcome.standing);
    for (std::size_t i = 0; i < kVerdictCount; ++i) record.verdicts[i] += outcome.verdicts[i];
    record.items += outcome.items;
    record.deferred += outcome.deferred;
    record.stayed += outcome.stayed ? 1 : 0;
  }
  mesh_.number_added(added);
  state_.limits.tets = record.after.tets;
  state_.is_divided = false;
  if (!state_.records.empty()) state_.records.back().after.worst = {};
  state_.records.push_back(std::move(record));
}

unsigned PieceRun::rings_of(const StepRecord& record) const {
  return !record.is_zones && record.number > 1 ? division_.rings : 0;
}

/// Rounds of zones take turns. Those for the worst tets may cost mild ones, and the others remove
/// these again. The worst come first: once all around them is polished, they are harder to move.
/// Pieces leave the worst to them, for a border spoils what is done with costly operators. But zones
/// have only so many: in a mesh that is too large for that each piece goes for its worst.
Aim PieceRun::aim_of(const StepRecord& record) const {
  constexpr std::uint64_t kTetsOfEach = 2'000;
  if (record.is_zones) return record.number % 2 == 1 ? Aim::worst : Aim::but_worst;
  return state_.limits.tets / kTetsOfEach > WorstTets::kMost ? Aim::all : Aim::but_worst;
}

/// Each has an equal share of what the mesh may grow by, and zones have one of the bad tets that were
/// removed: see ZoneMap::share(). Whoever would need more stays as it was.
TaskLimits PieceRun::limits_of(std::size_t part, const StepRecord& record) const {
  TaskLimits limits;
  limits.bounds = state_.bounds.value_or(Bounds());
  limits.is_zone = record.is_zones;
  limits.aim = aim_of(record);
  limits.rings = rings_of(record);
  limits.fresh_rings = division_.fresh_rings;
  limits.whole = state_.limits.tets;
  if (state_.limits.most_tets != std::numeric_limits<std::uint64_t>::max()) {
    limits.most_new_tets = state_.limits.most_tets > state_.limits.tets
                               ? (state_.limits.most_tets - state_.limits.tets) / record.pieces
                               : 0;
  }
  if (record.is_zones) {  // which have the worst tets, so these count
    const std::span<const Ball> balls = mesh_.state().parting.zones.balls();
    const std::size_t zone = part - mesh_.state().parting.stretches();
    limits.whole = balls.size();
    limits.share = static_cast<std::uint64_t>(std::count_if(
        balls.begin(), balls.end(), [&](const Ball& ball) { return ball.zone == zone; }));
  }
  if (limits.aim == Aim::worst) {
    const std::size_t now = state_.records.back().after.indicators.n_bad;
    constexpr std::size_t kShare = 4;  // of what was gained
    const std::size_t gained = state_.limits.n_bad > now ? state_.limits.n_bad - now : 0;
    const Parting& parting = mesh_.state().parting;
    limits.spare_bad = parting.zones.share(gained / kShare, part - parting.stretches());
  }
  if (options_.trace != nullptr && options_.trace->is_of(round(), part)) {
    limits.trace = [this, &record](const TetMesh& mesh) {
      return options_.trace->start(mesh, options_.settings.of(aim_of(record)), division_.pieces);
    };
  }
  if (state_.limits.seconds > 0) limits.seconds = std::max(1e-3, seconds_left());
  return limits;
}

/// Of a round that nobody has worked on.
void PieceRun::store_unchanged() {
  for (const std::size_t part : mesh_.own()) {
    mesh_.store(part, own_part(mesh_.gathered(part), mesh_.state().parting,
                               static_cast<std::uint32_t>(part)));
    mesh_.remove_gathered(part);
  }
  mesh_.number_added(std::vector<std::uint64_t>(mesh_.parts(), 0));
  state_.is_divided = false;
}

Measured PieceRun::measure_after(const Wanted& wanted, const Measured& before, Shelf* next) {
  if (state_.is_divided) store_unchanged();  // the run was stopped before its first round
  mesh_.divide(division_.pieces, division_.divisions, next);
  std::optional<Survey> survey = survey_for(wanted);
  Measured measured;
  std::optional<RulerHistograms> no_counts;
  if (wanted.histograms && before.rulers) no_counts = bins_for(*before.rulers);
  measured.histograms = no_counts;
  std::vector<PartFigures> mine;
  std::vector<std::pair<std::uint64_t, SurfaceShare>> shares;
  each_own([&](std::size_t part) -> SideBySide::Use {
    Piece gathered = this->gathered(part);
    if (surface_) surface_->label_points(gathered, mesh_.first_added());
    const auto number = static_cast<std::uint32_t>(part);
    const Parting& parting = mesh_.state().parting;
    std::optional<Survey> found = survey_for(wanted);
    const Figures figures =
        measure_own(gathered, parting, number, options_.standard, found ? &*found : nullptr,
                    options_.wanted(), surface_.get());
    std::optional<RulerHistograms> counts = no_counts;
    if (counts) count_own(gathered, parting, number, *counts);
    const Piece own = own_part(gathered, parting, number);
    std::optional<SurfaceShare> share;
    if (surface_) share = share_of(own);
    mesh_.store(part, own);
    mesh_.remove_gathered(part);
    return [&, part, figures, found = std::move(found), counts = std::move(counts),
            share = std::move(share)]() mutable {
      mine.push_back({part, figures});
      if (survey) survey->add(*std::move(found));
      if (counts) add(*counts, *measured.histograms);
      if (share) shares.emplace_back(part, *std::move(share));
    };
  });
  if (surface_) {
    surface_change_ = surface_->measure(share_surface(std::move(shares), mesh_.ranks()));
  }
  mesh_.number_added(std::vector<std::uint64_t>(mesh_.parts(), 0));
  std::vector<std::uint64_t> tets;
  measured.figures = sum(mine, mesh_.ranks(), tets);
  if (survey) add_survey(tets, *std::move(survey), mesh_.ranks(), measured);
  if (measured.histograms) add_up(*measured.histograms, mesh_.ranks());
  return measured;
}

}  // namespace tetmend::pieces
