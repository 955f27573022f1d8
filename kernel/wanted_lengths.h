// SPDX-License-Identifier: MIT
// How long somebody wants edges to be, and how well edges keep to that.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "kernel/quality.h"
#include "kernel/size_field.h"

namespace tetmend {

/// A wanted length at every place. The *relative length* of an edge is its length over the wanted
/// ones, as if they changed linearly along it; edges of 0.71 to 1.41 keep to the field. Immutable; several
/// threads may ask at once.
class TETMEND_API WantedLengths final : public SizeField {
 public:
  using Function = std::function<double(const Point&)>;

  /// Edges that are longer can be halved, shorter ones doubled, and are no farther from 1 then.
  static constexpr double kLeast = 0.70710678118654752;
  static constexpr double kMost = 1.41421356237309505;

  /// The same everywhere. Precondition: above 0.
  explicit WantedLengths(double everywhere) : everywhere_(everywhere) {}
  /// @param at gives a length above 0 at every place, the same whenever it is asked; several threads
  /// ask at once
  /// @param steepest by how much lengths change at most, over the way: what lies between the ends of an edge
  /// is looked at where it can matter
  explicit WantedLengths(Function at, double steepest = std::numeric_limits<double>::infinity())
      : at_(std::move(at)), steepest_(steepest) {}

  double length(const Point& p) const override;
  /// No more edges miss the range than before, and none by more: the worst by no more than the worst
  /// before, the second by no more than the second, and so on.
  bool admits(std::span<const EdgePlaces> before, std::span<const EdgePlaces> now) const override;
  bool looks_back() const override { return true; }
  const WantedLengths* wanted() const override { return this; }

  /// Of an edge that its ends find too long by what is wanted in between, if that is much more.
  double relative_length(const Point& a, const Point& b) const;
  static double relative_length(double length, double wanted_at_a, double wanted_at_b);
  /// 1 within the range; outside the share of its end that is reached, or by which it is passed.
  static double fit(double relative_length);
  /// The place between a and b that makes two edges of the same relative length of one.
  Point middle(const Point& a, const Point& b) const;
  /// The fits below 1 of these edges, ascending.
  std::vector<Quality> misfits(std::span<const EdgePlaces> edges) const;

 private:
  double sampled(const Point& a, const Point& b) const;
  double relative_length(const Point& a, const Point& b, double length, double at_a,
                         double at_b) const;

  /// Changes near one place ask for the same lengths again and again.
  struct Asked {
    Point place = Point::Constant(std::numeric_limits<double>::quiet_NaN());
    double length = 0;
  };
  static constexpr std::size_t kAsked = 65536;  // 2 MB a thread: those of 400,000 tets

  double everywhere_ = 0;
  Function at_;  // none: everywhere_
  double steepest_ = 0;
  mutable tbb::enumerable_thread_specific<std::vector<Asked>> asked_;
};

}  // namespace tetmend
