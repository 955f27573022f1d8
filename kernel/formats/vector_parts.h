// SPDX-License-Identifier: MIT
// Arrays of vectors in formats that have one number for each point or element alone.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/data.h>

#include "kernel/formats/unique_names.h"

namespace tetmend::formats {

/// What the names of components end in.
using AxisEndings = std::array<std::string_view, 3>;

/// One name for each component: the array's own, its own with the endings of axes, or with numbers.
std::vector<std::string> component_names(const DataArray& array, const AxisEndings& endings);
/// The same of names that fit, and that nothing in `taken` has yet. They stay alike but for their
/// endings, so that they are one array for who reads them.
std::vector<std::string> component_names(const DataArray& array, const AxisEndings& endings,
                                         UniqueNames& taken);
/// What happens to arrays in such a format, where it is not the same: one sentence each, once.
void note_component_arrays(const std::vector<DataArray>& arrays, const AxisEndings& endings,
                           UniqueNames taken, std::string_view extension,
                           std::vector<std::string>& notes);
/// The numbers of one component, as they are.
DataArray::Values component_values(const DataArray& array, std::size_t component);

/// The array of the same name, components and type; null if there is none.
const DataArray* find_like(const std::vector<DataArray>& arrays, const DataArray& wanted);

/// Three arrays of one type, one behind the other, whose names differ in these endings become one.
void join_components(std::vector<DataArray>& arrays, const AxisEndings& endings);

}  // namespace tetmend::formats
