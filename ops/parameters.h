// SPDX-License-Identifier: MIT
// Parameters of operators: declared once with range, default and help, checked when an operator is
// made.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/api.h>

namespace tetmend {

struct TETMEND_API ParameterSpec {
  enum class Kind { integer, real, flag };
  std::string_view name;
  Kind kind;
  double low;
  double high;
  double initial;
  std::string_view help;
};

using ParameterSettings = std::vector<std::pair<std::string, double>>;

/// The values of all declared parameters: defaults, overridden by settings.
class TETMEND_API ParameterValues {
 public:
  /// @throws Error for an unknown name (with the valid ones), a value out of range, or a fraction
  /// where an integer is wanted.
  ParameterValues(std::string_view owner, std::span<const ParameterSpec> specs,
                  const ParameterSettings& settings);

  /// Precondition: the name is declared.
  double real(std::string_view name) const;
  int integer(std::string_view name) const { return static_cast<int>(real(name)); }
  bool flag(std::string_view name) const { return real(name) != 0; }
  /// "max_level = 5, reflex_only = true": all, as a script writes them.
  std::string describe() const;

 private:
  std::span<const ParameterSpec> specs_;
  std::vector<double> values_;
};

}  // namespace tetmend
