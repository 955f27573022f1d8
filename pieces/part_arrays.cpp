// SPDX-License-Identifier: MIT
#include "pieces/part_arrays.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pieces/bytes.h"
#include "pieces/share_slices.h"

namespace tetmend::pieces {

PartArrays::Known& PartArrays::KnownArrays::find(const DataArray& array) {
  const auto [found, is_new] = places.try_emplace(outline_key(array), all.size());
  if (is_new) all.push_back({nothing_of(array), 0, 0});
  return all[found->second];
}

void PartArrays::add(std::vector<DataArray> arrays, std::size_t count) {
  if (count == 0) return;
  ++parts_;
  for (const DataArray& array : arrays) {
    Known& known = known_.find(array);
    if (std::exchange(known.last, parts_) == parts_) continue;  // a second one of that name
    append_values(bytes_of_values(array), known.array);
    ++known.parts;
  }
}

std::vector<DataArray> PartArrays::finish(Ranks& ranks, std::string_view on,
                                          std::vector<std::string>& notes) {
  std::string bytes;
  put(parts_, bytes);
  put(std::uint64_t{known_.all.size()}, bytes);
  for (const Known& known : known_.all) {
    append_outline(known.array, bytes);
    put(known.parts, bytes);
  }
  KnownArrays those;  // of all ranks
  std::uint64_t parts = 0;
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    std::uint64_t theirs = 0;
    std::uint64_t count = 0;
    pieces::take(rest, theirs);
    pieces::take(rest, count);
    parts += theirs;
    for (std::uint64_t i = 0; i < count; ++i) {
      Known& known = those.find(take_outline(rest));
      std::uint64_t having = 0;
      pieces::take(rest, having);
      known.parts += having;
    }
  }
  std::vector<DataArray> arrays;
  for (const Known& known : those.all) {
    if (known.parts == parts) {
      arrays.push_back(std::move(known_.find(known.array).array));
    } else {
      notes.push_back(fmt::format("the array '{}' of {} is not kept: not all parts have it",
                                  known.array.name, on));
    }
  }
  return arrays;
}

std::vector<DataArray> merge_point_arrays(const MergedPoints& merged,
                                          const std::vector<DataArray>& arrays, Ranks& ranks) {
  const RowLayout layout(nothing_of(arrays));
  std::vector<DataArray> values = nothing_of(arrays);
  if (layout.size() == 0) return values;
  const RankRanges ranges(merged.points.size(), ranks);
  std::vector<std::string> to(ranks.count());
  for (std::size_t i = 0; i < merged.numbers.size(); ++i) {
    std::string& bytes = to[ranges.rank_of(merged.numbers[i])];
    put(merged.numbers[i], bytes);
    layout.append_rows(arrays, i, i + 1, bytes);
  }
  std::string rows(merged.points.size() * layout.size(), '\0');
  std::vector<char> is_there(merged.points.size(), 0);
  // Ranks have ranges of the parts: so what comes first is of the first part.
  for (const std::string& from : ranks.exchange(std::move(to))) {
    for (std::string_view rest = from; !rest.empty();) {
      std::uint64_t number = 0;
      pieces::take(rest, number);
      const std::string_view row = take_front(rest, layout.size());
      const std::uint64_t at = number - ranges.begin(ranks.number());
      if (std::exchange(is_there[at], 1) != 0) continue;
      std::copy(row.begin(), row.end(), rows.data() + at * layout.size());
    }
  }
  layout.take_rows(rows, values);
  return values;
}

}  // namespace tetmend::pieces
