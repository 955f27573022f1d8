// SPDX-License-Identifier: MIT
#include "pieces/piece_trace.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pieces/bytes.h"
#include "pieces/piece_task.h"

namespace tetmend::pieces {

namespace {

constexpr const char* kName = "trace_piece";

}  // namespace

void check_trace_piece(const Options& options, std::size_t pieces, unsigned divisions,
                       unsigned zone_rounds) {
  const auto choice = face::TracedPiece::of(options);
  if (!choice) return;
  const auto refuse = [](const std::string& reason) {
    throw OptionError(kName, fmt::format("{}: {}", kName, reason));
  };
  if (choice->round < 1 || choice->round > divisions + zone_rounds) {
    refuse(fmt::format("there is no round {}: rounds count from 1 to {}", choice->round,
                       divisions + zone_rounds));
  }
  if (!choice->piece) return;
  if (choice->round <= divisions && *choice->piece >= pieces) {
    refuse(fmt::format("there is no piece {} in round {}: it has pieces 0 to {}", *choice->piece,
                       choice->round, pieces - 1));
  }
  if (choice->round > divisions && *choice->piece < pieces) {
    refuse(fmt::format("piece {} is not worked on in round {}: its zones count from {}",
                       *choice->piece, choice->round, pieces));
  }
}

PieceTrace::PieceTrace(const Options& options, face::Plan& plan, std::filesystem::path input)
    : options_(options), plan_(plan), input_(std::move(input)) {
  face::TracePlan::check_files(options, input_);
  is_wanted_ = !options.trace.empty();
  choice_ = face::TracedPiece::of(options).value_or(face::TracedPiece());
  is_explicit_ = choice_.piece.has_value();
}

void PieceTrace::choose(unsigned round, std::uint32_t part) {
  choice_ = {round, part};
  is_explicit_ = true;
}

void PieceTrace::locate(const DividedMesh& mesh, std::optional<std::size_t> part) {
  const std::optional<std::uint64_t> wanted = plan_.trace.tet();
  if (!is_wanted_ || !wanted) return;
  std::string mine;
  const auto look_in = [&](const Piece& piece) {
    for (const PieceTet& tet : piece.tets) {
      const bool is_new = (tet.origin | PieceTet::kProtected) == ~0U;
      if (is_new || (tet.origin & ~PieceTet::kProtected) != *wanted || !mine.empty()) continue;
      for (const std::uint32_t v : tet.vertices) {
        for (const double x : piece.points[v]) put(x, mine);
      }
    }
  };
  if (part) {
    look_in(mesh.gathered(*part));
  } else {
    for (const std::size_t own : mesh.own()) {
      for (const Piece& piece : mesh.all_of(own)) look_in(piece);
    }
  }
  for (const std::string& from : mesh.ranks().gather(mine)) {
    if (from.empty()) continue;
    std::string_view rest = from;
    std::array<Point, 4> corners;
    for (Point& p : corners) {
      for (double& x : p) take(rest, x);
    }
    return plan_.trace.locate(corners);
  }
  const std::string where = part ? fmt::format("piece {}", *part) : "the mesh";
  throw OptionError("trace_around",
                    fmt::format("trace_around: there is no tet {} in {}, or not any "
                                "more; they count from 0",
                                *wanted, where));
}

void PieceTrace::skip(Ranks& ranks) {
  std::error_code error;
  const bool is_there = ranks.is_first() && std::filesystem::exists(options_.trace, error);
  if (!ranks.any(is_there)) {
    throw OptionError(
        kName, fmt::format("{}: round {} is over, and was not recorded", kName, choice_.round));
  }
  is_wanted_ = false;
  note_ = fmt::format("{} is as it was: round {} was over", options_.trace.string(), choice_.round);
}

/// Of the pieces that are worked on; the first of several.
std::optional<std::uint32_t> PieceTrace::with_worst(const DividedMesh& mesh,
                                                    const TracedRound& round) const {
  struct Worst {
    double quality;
    std::uint64_t part;
    bool operator<(const Worst& other) const {
      return std::pair(quality, part) < std::pair(other.quality, other.part);
    }
  };
  const Parting& parting = mesh.state().parting;
  std::string mine;
  for (const std::size_t part : mesh.own()) {
    if (round.is_zones && part < parting.stretches()) continue;
    const std::optional<double> quality =
        worst_free(mesh.gathered(part), parting, static_cast<std::uint32_t>(part), round.rings,
                   round.standard);
    if (quality) put(Worst{*quality, part}, mine);
  }
  std::optional<Worst> worst;
  for (const std::string& from : mesh.ranks().gather(mine)) {
    for (std::string_view rest = from; !rest.empty();) {
      Worst other{};
      take(rest, other);
      if (!worst || other < *worst) worst = other;
    }
  }
  if (!worst) return std::nullopt;
  return static_cast<std::uint32_t>(worst->part);
}

void PieceTrace::begin_round(const DividedMesh& mesh, const TracedRound& round) {
  if (!is_wanted_ || round.number != choice_.round) return;
  has_begun_ = true;
  const Parting& parting = mesh.state().parting;
  const std::size_t first = round.is_zones ? parting.stretches() : 0;
  const std::optional<Point> place = plan_.trace.place();
  if (!is_explicit_ && place) {
    choice_.piece = parting.parts_of({&*place, 1}).front();
  } else if (!is_explicit_) {
    choice_.piece = with_worst(mesh, round);
  }
  if (!choice_.piece) {
    trouble_ = fmt::format("no tet may change in round {}", choice_.round);
  } else if (*choice_.piece < first) {
    trouble_ = fmt::format("no zone of round {} is around that place", choice_.round);
  } else if (*choice_.piece >= parting.parts()) {
    trouble_ = fmt::format("there is no piece {} in round {}: its zones have the numbers {} to {}",
                           *choice_.piece, choice_.round, first, parting.parts() - 1);
  } else {
    note_ = fmt::format("the trace is of round {}, piece {}", choice_.round, *choice_.piece);
    return;
  }
  choice_.piece.reset();
}

TraceSink* PieceTrace::start(const TetMesh& mesh, const ScheduleSettings& settings,
                             std::size_t pieces) {
  has_begun_ = was_made_ = true;
  try {
    recorder_ = plan_.trace.start_piece(
        mesh, input_, plan_.schedule, settings,
        {{"--pieces", fmt::format("{}", pieces)},
         {"--trace-piece", fmt::format("{}:{}", choice_.round, *choice_.piece)}});
  } catch (const Error& error) {
    trouble_ = error.what();
  }
  return recorder_.get();
}

void PieceTrace::finish() {
  try {
    if (recorder_) recorder_->finish();
  } catch (const Error& error) {
    trouble_ = error.what();
  }
  recorder_.reset();
}

/// Why there is none, where no rank has one.
std::string PieceTrace::trouble() const {
  const std::string reason =
      !trouble_.empty() ? trouble_
      : has_begun_      ? fmt::format("piece {} was not worked on", choice_.piece.value_or(0))
                        : fmt::format("the run ended before round {}", choice_.round);
  return fmt::format("{}: {}", options_.trace.string(), reason);
}

std::string PieceTrace::finish_all(Ranks& ranks) {
  finish();
  if (!is_wanted_) return {};
  std::string mine(1, was_made_ ? '1' : '0');
  if (was_made_) mine += trouble_;
  for (const std::string& from : ranks.gather(mine)) {
    if (from.front() == '1') return from.substr(1);  // a recorder names the file itself
  }
  return trouble();
}

std::unique_ptr<TraceRecorder> PieceTrace::take_recorder(std::string& trouble) {
  if (is_wanted_ && !was_made_) trouble = this->trouble();
  if (was_made_) trouble = trouble_;
  return std::move(recorder_);
}

}  // namespace tetmend::pieces
