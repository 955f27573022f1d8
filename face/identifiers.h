// SPDX-License-Identifier: MIT
// Arrays that number points or elements, so that other files can refer to them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/data.h>

#include "kernel/formats/new_numbers.h"

namespace tetmend::face {

/// How such an array comes over: CarriedArray::rule.
inline constexpr std::string_view kIdentifierRule =
    "numbers of their own: what is left keeps its number, new ones are above the largest";

/// One whole number each, no two alike: identifiers, and no values of a field. Of real numbers only
/// under a name that says so, such as "GlobalNodeID". Two numbers alone may be labels.
/// Cost: n log n; a few steps for most fields.
bool are_identifiers(const DataArray& array);

/// Numbers for what is new, above those of arrays that share them: one name, over points or over
/// elements of all kinds.
class NewIdentifiers {
 public:
  /// The arrays must outlive this. Precondition: are_identifiers() is true of one of them.
  explicit NewIdentifiers(std::vector<const DataArray*> arrays);
  NewIdentifiers(const NewIdentifiers&) = delete;
  NewIdentifiers& operator=(const NewIdentifiers&) = delete;

  /// @param same rows of `old`; kGone for a new one, which gets the next number
  DataArray carried(const DataArray& old, std::span<const std::uint32_t> same);

 private:
  std::vector<const DataArray*> arrays_;
  formats::NewNumbers numbers_;
};

/// A sentence about files beside the mesh; empty if nothing has gone and nothing is new.
/// @param of "points" or "tets"
/// @param same as for NewIdentifiers::carried()
std::string identifier_note(const DataArray& old, const DataArray& made, std::string_view of,
                            std::span<const std::uint32_t> same);

}  // namespace tetmend::face
