// SPDX-License-Identifier: MIT
// The part of a mesh that a run must leave as it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <tetmend/improve.h>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// @throws OptionError with the valid forms when a region of `protect` or `only` has none of them.
void check_regions(const Options& options);

/// @throws OptionError that names the region when no tet has one of its labels or lies in its box.
void find_regions(const MeshData& data, const Options& options);

/// The regions of the options, asked tet by tet: for a mesh that is nowhere as a whole.
class Regions {
 public:
  /// What was found of them so far. That of several parts of a mesh may be merged.
  struct Seen {
    std::vector<Label> labels;  ///< ascending
    std::array<Point, 2> box = {Point::Constant(std::numeric_limits<double>::infinity()),
                                Point::Constant(-std::numeric_limits<double>::infinity())};
    std::vector<std::uint8_t> found;  ///< by region: some tet is in it
    void merge(const Seen& other);
  };

  /// @throws OptionError as check_regions()
  explicit Regions(const Options& options);
  ~Regions();
  Regions(const Regions&) = delete;
  Regions& operator=(const Regions&) = delete;

  bool are_there() const;
  /// Notes a tet. @param corners in the file
  void see(Label label, const std::array<Point, 4>& corners, Seen& seen) const;
  /// Whether the options leave it as it is.
  bool protect(Label label, const std::array<Point, 4>& corners) const;
  /// All tets were seen. @throws OptionError as find_regions()
  void check(const Seen& seen) const;

 private:
  struct Lists;
  std::unique_ptr<Lists> lists_;
};

/// What protect() did. A tet may be one of both kinds.
struct ProtectedPart {
  std::size_t tets = 0;            ///< in regions
  std::size_t bad_tets = 0;        ///< of them
  std::size_t layer_tets = 0;      ///< in boundary layers
  std::size_t layer_bad_tets = 0;  ///< of them
};

/// Freezes what the options protect: regions, and boundary layers unless they are to be improved.
ProtectedPart protect(TetMesh& mesh, const Options& options);

}  // namespace tetmend::face
