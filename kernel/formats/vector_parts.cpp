// SPDX-License-Identifier: MIT
// Arrays of vectors in formats that have one number for each point or element alone.
#include "kernel/formats/vector_parts.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "kernel/printable.h"

namespace tetmend::formats {

std::vector<std::string> component_names(const DataArray& array, const AxisEndings& endings) {
  if (array.components == 1) return {array.name};
  std::vector<std::string> names;
  for (std::size_t c = 0; c < array.components; ++c) {
    names.push_back(array.components == 3 ? array.name + std::string(endings[c])
                                          : fmt::format("{}_{}", array.name, c + 1));
  }
  return names;
}

std::vector<std::string> component_names(const DataArray& array, const AxisEndings& endings,
                                         UniqueNames& taken) {
  DataArray named{array.name, array.components, {}};
  const std::size_t longest = component_names({{}, array.components, {}}, endings).back().size();
  NameRules rules = taken.rules();
  const bool is_short = rules.most != SIZE_MAX;
  if (is_short) rules.most -= longest;
  for (int number = 1;; ++number) {
    const std::string ending = number == 1 ? "" : fmt::format("_{}", number);
    NameRules before = rules;
    if (is_short) before.most -= ending.size();
    named.name = fit_name(array.name, before) + ending;
    const std::vector<std::string> names = component_names(named, endings);
    if (std::any_of(names.begin(), names.end(), [&](const auto& name) { return taken.has(name); }))
      continue;
    for (const std::string& name : names) taken.take(name);
    return names;
  }
}

void note_component_arrays(const std::vector<DataArray>& arrays, const AxisEndings& endings,
                           UniqueNames taken, std::string_view extension,
                           std::vector<std::string>& notes) {
  const auto note = [&](std::string sentence) {
    if (std::find(notes.begin(), notes.end(), sentence) == notes.end())
      notes.push_back(std::move(sentence));
  };
  for (const DataArray& array : arrays) {
    const std::string name = printable(array.name);
    const std::vector<std::string> names = component_names(array, endings, taken);
    if (names != component_names(array, endings)) {
      note(fmt::format("the name of the array '{}' is not kept as it is: {} has other rules", name,
                       extension));
    }
    if (array.components != 1 && array.components != 3) {
      note(fmt::format("the array '{}' is not kept as one: {} has {} arrays of it", name, extension,
                       array.components));
    }
  }
}

DataArray::Values component_values(const DataArray& array, std::size_t component) {
  return std::visit(
      [&](const auto& values) -> DataArray::Values {
        std::decay_t<decltype(values)> of_component;
        of_component.reserve(values.size() / array.components);
        for (std::size_t i = component; i < values.size(); i += array.components)
          of_component.push_back(values[i]);
        return of_component;
      },
      array.values);
}

const DataArray* find_like(const std::vector<DataArray>& arrays, const DataArray& wanted) {
  const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& array) {
    return array.name == wanted.name && array.components == wanted.components &&
           array.values.index() == wanted.values.index();
  });
  return found == arrays.end() ? nullptr : &*found;
}

void join_components(std::vector<DataArray>& arrays, const AxisEndings& endings) {
  std::vector<DataArray> joined;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const std::string_view first = arrays[i].name;
    const bool may_begin =
        i + 2 < arrays.size() && first.ends_with(endings[0]) && first.size() > endings[0].size();
    const std::string name(may_begin ? first.substr(0, first.size() - endings[0].size()) : first);
    const auto is_axis = [&](std::size_t k) {
      const DataArray& array = arrays[i + k];
      return array.components == 1 && array.name == name + std::string(endings[k]) &&
             array.values.index() == arrays[i].values.index() && array.size() == arrays[i].size();
    };
    if (!may_begin || !is_axis(0) || !is_axis(1) || !is_axis(2)) {
      joined.push_back(std::move(arrays[i]));
      continue;
    }
    DataArray vectors{name, 3, arrays[i].values};
    std::visit(
        [&](auto& all) {
          using Numbers = std::decay_t<decltype(all)>;
          all.resize(3 * all.size());
          for (std::size_t k = 0; k < 3; ++k) {
            const Numbers& from = std::get<Numbers>(arrays[i + k].values);
            for (std::size_t j = 0; j < from.size(); ++j) all[3 * j + k] = from[j];
          }
        },
        vectors.values);
    joined.push_back(std::move(vectors));
    i += 2;
  }
  arrays = std::move(joined);
}

}  // namespace tetmend::formats
