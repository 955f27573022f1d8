// SPDX-License-Identifier: MIT
// Improves a mesh in pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <tetmend/improve.h>

#include "face/portrait.h"
#include "pieces/piece_run.h"
#include "trace/recorder.h"

namespace tetmend::pieces {

/// improve(), but with the mesh divided. The result depends on the mesh, the options and the number
/// of pieces, not on threads or on where the pieces lie. One piece: the same as improve(). For the number
/// see limited_pieces().
/// @param portrait null, or empty; filled for a picture of the run
/// @param scratch folder in which pieces lie that are not worked on; empty: they stay in memory
/// @param trace null, or takes the trace, which is not finished then: see face/recorded.h
/// @throws Error as improve(); for a mesh of second order, and OptionError for an option that pieces
/// cannot have (a surface that moves).
Result improve(Mesh& mesh, const Options& options, const Division& division,
               const std::filesystem::path& scratch = {}, face::Portrait* portrait = nullptr,
               std::unique_ptr<TraceRecorder>* trace = nullptr);

/// For reports.
Pass to_pass(const StepRecord& record);

/// @throws OptionError for options that pieces cannot have.
void check(const Options& options, const Division& division);

/// So many pieces, or fewer where they would be too small: of less than 300 tets. At least 2, unless
/// it is one.
std::size_t limited_pieces(std::size_t pieces, std::size_t tets);
/// For the user, where there are fewer than were asked for.
std::string why_fewer_pieces(std::size_t asked, std::size_t pieces, std::size_t tets);

/// How many pieces a mesh has when nobody says how many. At least 1.
std::size_t usual_pieces(std::size_t tets);

/// @throws OptionError for bytes that are less than the program itself takes; 0: not given
void check_memory(std::uint64_t memory);
/// How many pieces a mesh needs so that one can be worked on in so many bytes. At least 1.
std::size_t pieces_for(std::size_t tets, std::uint64_t memory);
/// How many of so many pieces can be worked on at a time in so many bytes. At least 1; 0 bytes, for
/// not given: 1.
std::size_t pieces_at_a_time(std::size_t tets, std::size_t pieces, std::uint64_t memory);

}  // namespace tetmend::pieces
