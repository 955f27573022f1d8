// SPDX-License-Identifier: MIT
// The bad tets of a mesh one by one: as a list and as a mesh for other programs to show.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>
#include <tetmend/measure.h>

#include "kernel/mesh_data.h"

namespace tetmend::apps {

/// Why a tet is there and resists, in a few words.
std::string reason_of(const BadTet& tet);

/// The first `most`, a line each, under a heading.
std::string format_bad_tets(std::span<const BadTet> tets, std::size_t most);
nlohmann::json to_json(std::span<const BadTet> tets, std::size_t most);

/// Writes a mesh of these tets of `all`, with what is known of each as arrays:
/// `number`, `theta_min`, `theta_max`, `quality`, `free_vertices`, `reason` (as
/// Hindrance).
/// @throws Error when `output` cannot be written
void write_bad_tets(const MeshData& all, const std::filesystem::path& output,
                    std::span<const BadTet> tets);

}  // namespace tetmend::apps
