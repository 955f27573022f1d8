// SPDX-License-Identifier: MIT
// The surface that the present one is held to: what an envelope knows and never changes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "envelope/element.h"
#include "envelope/features.h"
#include "envelope/triangle_set.h"

namespace tetmend {

struct EnvelopeOptions;

/// Patches and lines of the reference. Its triangles and, after them, the segments of its lines are
/// its *elements*; patches and, after them, lines are their *sheets*. Exactly flat ones need no
/// elements.
class Reference {
 public:
  /// Elements are numbered like faces and edges of `features`. Where parts of the boundary face each
  /// other across a gap outside, the tolerance is less than half of the gap.
  /// @param points by vertex
  /// @param flat see flatness()
  Reference(std::span<const Point> points, double flat, const SurfaceFeatures& features,
            const EnvelopeOptions& options);

  bool is_flat() const { return elements.empty(); }
  std::uint32_t sheet_of_line(std::uint32_t line) const {
    return static_cast<std::uint32_t>(patches.size()) + line;
  }
  /// The largest tolerance of the elements of a sheet.
  double tolerance(std::uint32_t sheet) const { return tolerances[sheet]; }

  std::vector<SurfaceFeatures::Patch> patches;
  std::vector<SurfaceFeatures::Line> lines;
  double share = 0, length = 0;  ///< what was asked for, see EnvelopeOptions
  double flatness = 0;           ///< see flatness()
  TriangleSet triangles;
  std::vector<Element> elements;
  std::size_t faces = 0;  ///< so many of the elements are triangles
  std::vector<double> tolerances;
  std::vector<double> areas;  ///< by patch
  ElementTree tree;

 private:
  void add_faces(std::span<const Point> points, const SurfaceFeatures& features,
                 const EnvelopeOptions& options);
  void hold_close_parts(const SurfaceFeatures& features);
  void add_segments(std::span<const Point> points, const SurfaceFeatures& features);
};

}  // namespace tetmend
