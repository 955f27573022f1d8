// SPDX-License-Identifier: MIT
// Whether a change is worth keeping. Operators propose; a judge decides, once for each proposal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/api.h>

#include "kernel/handles.h"
#include "kernel/quality.h"

namespace tetmend {

class Transaction;

/// Differences below this do not count as progress: they are within reach of rounding, and a run
/// would crawl.
inline constexpr Quality kQualityTolerance = 2e-6f;

/// True if the quality vector `now` is better than `before`: both ascending, compared
/// lexicographically, the shorter better when one continues the other ([chen, 6.1]). The first
/// entry that differs by more than kQualityTolerance decides, and no earlier entry may be lower at
/// all, so true also holds in the strict order.
TETMEND_API bool improves(std::span<const Quality> now, std::span<const Quality> before);

/// How much a tet lacks to be good, (1 - q)^4, or 0: a sum of it weighs one very bad tet against
/// several mild ones.
inline double deficit(double quality) {
  const double lack = std::max(0.0, static_cast<double>(kBadThreshold) - quality);
  return (lack * lack) * (lack * lack);
}

/// The least gain that pays for one more bad tet. Tiny gains, one after the other, would fill the
/// neighbourhood with bad tets.
inline constexpr double kPriceOfBad = 0.002;

/// A worst tet below this quality is desperate: its gain may be paid for with more bad tets.
inline constexpr double kDesperate = 0.4;

/// The qualities of all that a transaction has touched, as they were when it began and as they are
/// now. One for each worker; empty when nothing was compared.
class TETMEND_API Comparison {
 public:
  Comparison() = default;
  /// In any order.
  Comparison(std::vector<Quality> before, std::vector<Quality> now)
      : before_(std::move(before)), now_(std::move(now)), sorted_(false) {}

  void forget();
  void look_at(const Transaction& transaction);
  /// There were tets, and there are.
  bool has_both() const { return !before_.empty() && !now_.empty(); }

  /// Precondition: has_both().
  Quality worst_before() const;
  Quality worst_now() const;
  /// Ascending. Sorted when first asked for: mostly the worst tets decide.
  std::span<const Quality> before();
  std::span<const Quality> now();

 private:
  void sort();

  std::vector<Quality> before_;
  std::vector<Quality> now_;
  bool sorted_ = true;
};

/// What a judge looks at.
struct TETMEND_API Change {
  const Transaction& transaction;
  Comparison& qualities;     ///< buffers; filled by the judge
  TetHandle aimed_at = {};   ///< the tet of the target; invalid if that is a vertex
  TetVertices corners = {};  ///< its vertices before the change
};

/// What a fair judge takes for fair.
struct TETMEND_API Fairness {
  /// What a bad tet lacks counts with this exponent; large: mild ones hardly count.
  double exponent = 4;
  double desperate = kDesperate;  ///< a worst tet below this may gain at a price
  double price = kPriceOfBad;     ///< the least gain for each more bad tet
  /// True: the sum must become less, however many tets share it, so where nothing is bad, nothing
  /// is gained. False: the sum must not grow, and only the price pays for more bad tets.
  bool more_bad = true;
};

/// Decides whether a change stays, and tells a search beforehand what it will ask for. A value of a
/// few words; immutable.
class TETMEND_API Judge {
 public:
  enum class Kind : std::uint8_t {
    strict,
    fair,
    reaches,
    lowers_angle,
    raises_mean,
    fits_lengths,
    opening,
    untangles
  };

  /// The quality vector of what changed is better. Where the standard has a price, more bad tets
  /// are paid for: the worst tet gains the price of each.
  /// DEVIATION: the paper has no price. Without one, a worst tet that rises a little may leave many
  /// mild bad tets behind, and each round begins with more to do.
  static Judge strict() { return Judge(Kind::strict); }
  /// The same, and the bad tets lack no more in sum, or a desperate worst tet gained a price.
  /// DEVIATION: the paper's order alone lets an insertion raise the worst tet a little and leave
  /// more bad tets than it found.
  static Judge fair(const Fairness& fairness);
  /// It is better, or the tet aimed at reaches the goal and no bad tet is new or worse.
  static Judge reaches(Quality goal);
  /// The sine of the largest angle of what changed is above `sine` by the price, and by as much for
  /// each more bad tet; the worst tet is no worse.
  static Judge lowers_angle(double sine);
  /// The mean ratios of what changed, each less `usual`, have a larger sum, no bad tet is new or
  /// worse, and no more angles are bad. With the mean over the mesh for `usual`, that mean rises, whatever the number of tets.
  static Judge raises_mean(double usual);
  /// The edges keep better to the wanted lengths: the vector of the lengths that miss the range, the
  /// worst first, is better in the order of improves(). No new tet is below `least`, or below the worst
  /// there was. Precondition of accepts(): the mesh has wanted lengths.
  static Judge fits_lengths(Quality least);
  /// Fewer tets are inverted or flat, and no more are bad. New edges may have any length.
  static Judge untangles() { return Judge(Kind::untangles); }
  /// The worst tet keeps a share of the quality that the worst had: whoever asks for this judges
  /// the whole of what follows.
  static Judge opening(double share = 0.2);

  Kind kind() const { return kind_; }
  bool looks_at_mean() const { return kind_ == Kind::raises_mean; }
  bool looks_at_lengths() const { return kind_ == Kind::fits_lengths; }
  /// The usual mean ratio. Precondition: looks_at_mean().
  double usual() const { return bound_; }
  /// One sentence.
  std::string_view promise() const;

  /// What the worst new tet must exceed when that of the old ones is `worst`, and an operator asks
  /// for a gain of its own. A search need not look at less.
  double floor(double worst, double least_gain = 0) const;
  /// The most that new tets may lack in sum, see deficit(), when the old ones lack `lack`.
  double deficit_limit(double worst, double lack) const;

  /// The promise, no new tet beyond the bounds of the mesh, no more tets than the workspace allows,
  /// no new edge that the size field does not admit, and no new tet that curved edges do not; an
  /// opening may leave these for a while. Leaves the qualities that it compared in the change. False for a change without edits.
  /// Cost: linear in the tets that changed, mostly; n log n where the worst do not decide, quadratic
  /// for a judge of the mean or of lengths, or with a size field.
  bool accepts(const Change& change) const;

  /// What a judge may ask beside the qualities.
  struct Aim {
    double price = 0;              ///< Standard::price()
    bool reached = false;          ///< the tet aimed at is gone, or as good as the goal
    double sine = 1;               ///< of the largest angle of what changed; 1 if none is obtuse
    bool more_bad_angles = false;  ///< in number, of what changed
    double gain = 0;               ///< of the sum of mean ratios, each less the usual one
    bool fits = false;             ///< the edges keep better to the wanted lengths
  };
  /// The promise itself.
  bool holds_for(Comparison& qualities, const Aim& aim) const;

 private:
  explicit Judge(Kind kind) : kind_(kind) {}

  static bool pays_price(Comparison& qualities, double price);
  bool is_fair(Comparison& qualities) const;
  bool pays(Comparison& qualities) const;
  bool keeps_share(const Comparison& qualities) const;
  bool spares_bad(Comparison& qualities) const;
  static bool untangles(Comparison& qualities);
  bool lowers_angle(Comparison& qualities, double sine) const;
  double lack(std::span<const Quality> qualities) const;

  Kind kind_;
  Fairness fairness_;
  double bound_ = 0;  // goal, sine, usual mean ratio, least quality or share
};

}  // namespace tetmend
