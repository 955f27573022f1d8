// SPDX-License-Identifier: MIT
// What the checks before and after a run in pieces add up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "face/advice.h"
#include "face/growth.h"
#include "face/portrait.h"
#include "face/size_statistics.h"
#include "kernel/bounds.h"
#include "kernel/ruler_shares.h"
#include "kernel/statistics.h"
#include "pieces/held_surface.h"
#include "pieces/parting.h"
#include "pieces/piece.h"
#include "pieces/ranks.h"

namespace tetmend::pieces {

/// What a check adds up over all pieces.
struct Figures {
  MeshStatistics statistics;  ///< of the own tets
  std::uint64_t surface = 0;  ///< part of surface_fingerprint()
  std::size_t not_positive = 0;
  std::size_t peculiar = 0;           ///< tets that building turned round, inverted and flat ones
  std::size_t constrained_faces = 0;  ///< interior ones
  std::size_t layer_tets = 0;
  std::size_t touched = 0;  ///< tets that the file does not have, or with a vertex that has moved
  std::size_t protected_tets = 0;      ///< by the user
  std::size_t protected_bad_tets = 0;  ///< of them
  std::size_t misfits = 0;             ///< see HeldSurface::count_misfits()
  RulerShare rulers;                   ///< of all that is its own
  face::SizeCounts sizes;              ///< likewise, where lengths are wanted

  void add(const Figures& other);
};

/// A bad tet that several pieces have, and what one of them knows of it.
struct SharedTet {
  std::array<VertexId, 4> vertices{};  ///< ascending; holders have their bits in this order
  face::Holders holders;
};

/// A bad tet to be named.
struct NamedTet {
  std::uint64_t part = 0;              ///< its number there follows in `facts`
  std::array<VertexId, 4> vertices{};  ///< in its order
  std::array<std::array<double, 3>, 4> corners{};
  std::uint8_t fixed = 0;  ///< a bit for each corner; of a shared tet those that the piece knows
  BadTet facts;
};

/// What no sum has, over the pieces of a rank.
struct Survey {
  WorstScores worst;
  face::LocalLengths lengths;
  VertexId first_id = 0;       ///< of vertices of the file
  std::uint64_t vertices = 0;  ///< of the file
  bool finds_holders = false;  ///< of bad tets
  face::Held held = {};
  std::vector<SharedTet> shared = {};
  std::vector<NamedTet> worst_tets = {};  ///< kMostNamed

  /// That of other parts.
  void add(Survey other);
};

/// How much of a mesh is measured besides its Figures.
struct Wanted {
  bool rulers = false;         ///< and how lengths have changed
  bool histograms = false;     ///< of rulers
  bool holders = false;        ///< of bad tets
  std::uint64_t vertices = 0;  ///< of the file
  std::uint64_t tets = 0;      ///< likewise; 0: not known, which takes more memory
};

/// Bad tets that a report names.
inline constexpr std::size_t kMostNamed = 12;

/// A mesh in pieces, measured.
struct Measured {
  Figures figures;
  std::optional<MeshRulers> rulers;
  std::optional<RulerHistograms> histograms;
  face::LocalLengths lengths;
  // Not in bytes:
  face::Held held;
  std::vector<face::DrawnTet> worst_tets;  ///< kMostNamed of the bad ones, the worst first
};
void append(const Measured& measured, std::string& bytes);
/// @throws Error when the bytes end too early.
Measured take_measured(std::string_view& bytes);

/// All ranks: fills rulers, lengths and what holds bad tets; they are the same on all. Precondition:
/// figures are of all.
/// @param tets  of each part
void add_survey(const std::vector<std::uint64_t>& tets, Survey survey, Ranks& ranks,
                Measured& measured);

/// Of the own tets, for the standard. The same whoever asks: of the coordinates in the order of the piece.
Bounds bounds_of_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
                     const Standard& standard);

/// Builds all of a piece, which fails where a face has more than two tets, and measures what is its
/// own. A face is that of the piece with the lowest part of its vertices: all its tets are there.
/// @param survey null: rulers are not measured
/// @param wanted null: lengths are free. Of an edge out of its range that two parts share nobody knows whether
/// both ends are fixed; it does not count for `between_walls`.
/// @param surface null: it is fixed
Figures measure_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
                    const Standard& standard, Survey* survey, const WantedLengths* wanted,
                    const HeldSurface* surface = nullptr);

/// Counts the rulers of what is its own. @param counts  their bins are set
void count_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
               RulerHistograms& counts);

}  // namespace tetmend::pieces
