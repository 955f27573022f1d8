// SPDX-License-Identifier: MIT
// Sums of products of doubles without rounding, of which the sign is wanted.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tetmend {

/// Sum of products of `Factors` doubles each: one long integer, in units of the power of two that
/// divides all products [kulisch]. It has a digit for every bit that such a product can have, from
/// the smallest denormal number to the largest double, so nothing is rounded, overflows or
/// underflows. On the stack; cost: see add().
///
///   digits     ... [ 3 ][ 2 ][ 1 ][ 0 ]    of 32 bits each, in 64: carries wait for sign()
///   a product          [2][1][0]           shifted by the exponents of its factors
template <std::size_t Factors>
class ExactSum {
 public:
  /// @param values whatever will be a factor; finite
  explicit ExactSum(std::span<const double> values) {
    int largest = 0;
    unit_ = kExponents;
    for (const double value : values) {
      if (value == 0) continue;
      const int exponent = split(value).exponent;
      unit_ = std::min(unit_, exponent);
      largest = std::max(largest, exponent);
    }
    if (unit_ > largest) unit_ = largest;  // nothing but zeros
    const auto bits = Factors * static_cast<std::size_t>(largest - unit_ + kMantissaBits);
    used_ = bits / 32 + 3;  // a digit for the shift within one, and two for the carries
    std::fill_n(digits_.begin(), used_, 0);
  }

  /// Adds the product of the factors, or subtracts it. At most 2^28 times.
  /// Cost: proportional to the square of Factors; some nanoseconds for three.
  void add(const std::array<double, Factors>& factors, bool subtract = false) {
    std::array<std::uint32_t, 2 * Factors> product = {1};
    std::size_t length = 1;
    std::size_t shift = 0;
    bool is_negative = subtract;
    for (const double factor : factors) {
      if (factor == 0) return;
      const Parts parts = split(factor);
      assert(parts.exponent >= unit_);
      shift += static_cast<std::size_t>(parts.exponent - unit_);
      is_negative ^= factor < 0;
      multiply(product, length, parts.mantissa);
    }
    std::int64_t* digit = &digits_[shift / 32];
    assert(shift / 32 + length < used_);
    for (std::size_t i = 0; i < length; ++i) {
      const std::uint64_t shifted = std::uint64_t{product[i]} << (shift % 32);
      const auto low = static_cast<std::int64_t>(shifted & 0xFFFFFFFFu);
      const auto high = static_cast<std::int64_t>(shifted >> 32);
      digit[i] += is_negative ? -low : low;
      digit[i + 1] += is_negative ? -high : high;
    }
  }

  /// -1, 0 or 1.
  int sign() const {
    std::int64_t carry = 0;
    bool is_zero = true;
    for (std::size_t i = 0; i < used_; ++i) {
      carry += digits_[i];
      is_zero = is_zero && (carry & 0xFFFFFFFF) == 0;
      carry >>= 32;  // towards minus infinity
    }
    return carry < 0 ? -1 : is_zero ? 0 : 1;
  }

 private:
  static constexpr int kMantissaBits = 53;
  static constexpr int kExponents = 2046;  // of finite doubles, as their bits have them: 1 to 2046
  static constexpr std::size_t kMostDigits =
      Factors * static_cast<std::size_t>(kExponents - 1 + kMantissaBits) / 32 + 3;

  /// The magnitude of a double is mantissa * 2^exponent times the smallest denormal, halved.
  struct Parts {
    std::uint64_t mantissa;
    int exponent;  // 1 to 2046
  };
  static Parts split(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto exponent = static_cast<int>(bits >> (kMantissaBits - 1) & 0x7FF);
    constexpr std::uint64_t kHidden = std::uint64_t{1} << (kMantissaBits - 1);
    assert(exponent <= kExponents);
    const std::uint64_t mantissa = bits & (kHidden - 1);
    return exponent == 0 ? Parts{mantissa, 1} : Parts{mantissa | kHidden, exponent};
  }

  /// Adds two digits at most.
  static void multiply(std::array<std::uint32_t, 2 * Factors>& product, std::size_t& length,
                       std::uint64_t mantissa) {
    const std::uint64_t low = mantissa & 0xFFFFFFFFu;
    const std::uint64_t high = mantissa >> 32;
    std::uint64_t before = 0;  // the digit below, as it was
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const std::uint64_t digit = product[i];
      const std::uint64_t of_low = digit * low;
      carry += before * high + (of_low & 0xFFFFFFFFu);
      product[i] = static_cast<std::uint32_t>(carry);
      carry = (carry >> 32) + (of_low >> 32);
      before = digit;
    }
    carry += before * high;
    for (; carry != 0; carry >>= 32) product[length++] = static_cast<std::uint32_t>(carry);
  }

  std::array<std::int64_t, kMostDigits> digits_;  // the first used_ of them
  std::size_t used_ = 0;
  int unit_ = 0;
};

}  // namespace tetmend
