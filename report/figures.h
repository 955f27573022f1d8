// SPDX-License-Identifier: MIT
// The figures of a run on their way into a page: each is shown rounded, and says where in the JSON
// report it stands and what it is there.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace tetmend::report {

/// A report as `tetmend improve --report FILE.json` writes it. A path is names and numbers with
/// points between them: "after.theta_min", "passes.3.seconds". The report must outlive it.
class Figures {
 public:
  explicit Figures(const nlohmann::json& report) : report_(report) {}

  /// Null where there is nothing.
  const nlohmann::json& at(std::string_view path) const;
  bool has(std::string_view path) const { return !at(path).is_null(); }
  /// Not a number where there is none.
  double number(std::string_view path) const;
  /// 0 where there is none.
  std::size_t count(std::string_view path) const;
  bool is_true(std::string_view path) const;
  /// Empty where there is none.
  std::string text(std::string_view path) const;

  // As HTML: <data data-of="after.n_bad" value="1234">1,234</data>.

  std::string shown_count(std::string_view path) const;
  /// With so many decimals, unless that would hide what is not zero.
  std::string shown(std::string_view path, int decimals) const;
  /// With so many digits.
  std::string shown_digits(std::string_view path, int digits) const;
  std::string shown_text(std::string_view path) const;

 private:
  const nlohmann::json& report_;
};

/// Four digits, as in ticks and tips.
std::string short_number(double value);

}  // namespace tetmend::report
