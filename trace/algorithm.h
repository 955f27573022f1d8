// SPDX-License-Identifier: MIT
// What an attempt is to those who explain it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tetmend {

/// The operators whose steps can be shown and explained. Whoever decides by what an attempt is asks
/// for this value; names are for people and for files.
enum class Algorithm : std::uint8_t {
  other,
  shell_transformation,  ///< [chen, Alg. 3]
  recursion,             ///< [chen, Alg. 4]
  edge_removal,
  multi_face_removal,
  smoothing,
  edge_split,
  edge_contraction,
  cavity_insertion,
  polyhedron_reconnection
};

/// True for those that search the best covering of a shell.
constexpr bool searches_covering(Algorithm algorithm) {
  return algorithm >= Algorithm::shell_transformation && algorithm <= Algorithm::multi_face_removal;
}

/// Names of operators, by Algorithm; "" stands for all others.
inline constexpr std::array<std::string_view, 10> kAlgorithmOperators = {
    "",
    "shell_transformation",
    "recursive_shell_transformation",
    "edge_removal",
    "multi_face_removal",
    "smoothing",
    "edge_split",
    "edge_contraction",
    "cavity_insertion",
    "polyhedron_reconnection"};

constexpr std::string_view operator_name(Algorithm algorithm) {
  return kAlgorithmOperators[static_cast<std::size_t>(algorithm)];
}

constexpr Algorithm algorithm_of(std::string_view operator_name) {
  for (std::size_t i = 1; i < kAlgorithmOperators.size(); ++i) {
    if (kAlgorithmOperators[i] == operator_name) return static_cast<Algorithm>(i);
  }
  return Algorithm::other;
}

}  // namespace tetmend
