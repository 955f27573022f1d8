// SPDX-License-Identifier: MIT
// Elements that no mesh can have: with a vertex twice, or listed a second time.
#include "kernel/formats/degenerate.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/chunks.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/element_kinds.h"
#include "kernel/grouped.h"
#include "kernel/lists_of_kind.h"

namespace tetmend::formats {
namespace {

/// Elements of one kind, each by its corners.
struct CornerRows {
  const std::uint32_t* first = nullptr;
  std::size_t stride = 0;  // in numbers
  std::size_t count = 0;
  std::size_t width = 0;

  std::span<const std::uint32_t> of(std::size_t i) const { return {first + i * stride, width}; }
};

template <class Element>
CornerRows corner_rows(const std::vector<Element>& elements) {
  static_assert(sizeof(Element) % sizeof(std::uint32_t) == 0);
  if (elements.empty()) return {};
  return {elements[0].vertices.data(), sizeof(Element) / sizeof(std::uint32_t), elements.size(),
          std::tuple_size_v<decltype(Element::vertices)>};
}

bool has_corner_twice(std::span<const std::uint32_t> v) {
  if (v.size() == 4) {  // a tet: most elements are
    return (v[0] == v[1]) | (v[0] == v[2]) | (v[0] == v[3]) | (v[1] == v[2]) | (v[1] == v[3]) |
           (v[2] == v[3]);
  }
  bool found = false;
  for (std::size_t i = 1; i < v.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) found |= v[i] == v[j];
  }
  return found;
}

std::vector<std::uint32_t> find_collapsed(const CornerRows& all) {
  const auto parts =
      map_chunks<std::vector<std::uint32_t>>(all.count, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> found;
        for (std::size_t i = begin; i < end; ++i) {
          if (has_corner_twice(all.of(i))) found.push_back(static_cast<std::uint32_t>(i));
        }
        return found;
      });
  std::vector<std::uint32_t> found;
  for (const auto& part : parts) found.insert(found.end(), part.begin(), part.end());
  return found;
}

/// A tet that is there already, and the first with its corners.
struct Repeated {
  std::uint32_t tet = 0;
  std::uint32_t first = 0;
};

/// The same whatever the order of the corners.
std::uint64_t hash_of_corners(std::span<const std::uint32_t> v) {
  std::uint64_t sum = 0;
  for (const std::uint64_t i : v) {
    const std::uint64_t mixed = (i + 1) * 0x9E3779B97F4A7C15u;
    sum += mixed ^ (mixed >> 29);
  }
  return sum;
}

/// Finds tets that may have the corners of another at next to no cost, for most meshes have none. A few
/// more are found.
class Suspicion {
 public:
  Suspicion(const CornerRows& all, std::size_t points)
      : all_(all), bit_of_(all.count), seen_(2 * points), again_(2 * points) {}

  /// Those of a chunk; several threads may.
  void add(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t* v = corners(i);
      const std::uint64_t sum = std::uint64_t{v[0]} + v[1] + v[2] + v[3];
      const std::uint64_t others = v[0] ^ v[1] ^ v[2] ^ v[3];
      const std::uint64_t mixed = (sum << 32 ^ others) * 0x9E3779B97F4A7C15u;
      const auto bit = static_cast<std::uint8_t>(mixed >> 57);
      bit_of_[i] = bit;
      std::atomic<std::uint64_t>& seen = seen_[word(v, bit)];
      const std::uint64_t mask = std::uint64_t{1} << (bit & 63U);
      const bool is_new = (seen.load(std::memory_order_relaxed) & mask) == 0 &&
                          (seen.fetch_or(mask, std::memory_order_relaxed) & mask) == 0;
      if (!is_new) again_[word(v, bit)].fetch_or(mask, std::memory_order_relaxed);
    }
  }
  /// When all have been added.
  bool falls_on(std::size_t i) const {
    const std::uint8_t bit = bit_of_[i];
    return again_[word(corners(i), bit)].load(std::memory_order_relaxed) >> (bit & 63U) & 1U;
  }

 private:
  const std::uint32_t* corners(std::size_t i) const { return all_.first + i * all_.stride; }
  /// One of two for the smallest corner, so that tets that are neighbours use the same memory.
  static std::size_t word(const std::uint32_t* v, std::uint8_t bit) {
    const std::size_t smallest = std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
    return 2 * smallest + (bit >> 6U);
  }

  const CornerRows& all_;
  std::vector<std::uint8_t> bit_of_;  // of each tet, in these two words
  std::vector<std::atomic<std::uint64_t>> seen_, again_;
};

/// Looks at tets whose hash is the same.
class Comparison {
 public:
  explicit Comparison(const CornerRows& all) : all_(all) {}

  template <class Numbers>
  void look_at(const Numbers& tets) {
    rows_.clear();
    for (const auto& [hash, t] : tets) {
      auto& [corners, number] = rows_.emplace_back();
      const auto v = all_.of(t);
      std::copy(v.begin(), v.end(), corners.begin());
      std::sort(corners.begin(), corners.end());
      number = t;
    }
    std::sort(rows_.begin(), rows_.end());
    std::uint32_t first = rows_[0].second;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      if (rows_[i].first != rows_[i - 1].first) {
        first = rows_[i].second;
      } else if (!has_corner_twice(rows_[i].first)) {
        found_.push_back({rows_[i].second, first});
      }
    }
  }
  std::vector<Repeated> take() { return std::move(found_); }

 private:
  const CornerRows& all_;
  std::vector<std::pair<std::array<std::uint32_t, 4>, std::uint32_t>> rows_;
  std::vector<Repeated> found_;
};

/// In ascending order.
std::vector<Repeated> find_repeated(const CornerRows& all, std::size_t points) {
  using Hashed = std::pair<std::uint64_t, std::uint32_t>;
  if (all.count < 2) return {};
  Suspicion suspicion(all, points);
  for_chunks(all.count, [&](std::size_t begin, std::size_t end) { suspicion.add(begin, end); });
  const auto parts =
      map_chunks<std::vector<Hashed>>(all.count, [&](std::size_t begin, std::size_t end) {
        std::vector<Hashed> found;
        for (std::size_t i = begin; i < end; ++i) {
          if (suspicion.falls_on(i))
            found.emplace_back(hash_of_corners(all.of(i)), static_cast<std::uint32_t>(i));
        }
        return found;
      });
  std::vector<Hashed> suspects;
  for (const auto& part : parts) suspects.insert(suspects.end(), part.begin(), part.end());
  std::sort(suspects.begin(), suspects.end());
  Comparison comparison(all);
  for (std::size_t begin = 0, end = 0; begin < suspects.size(); begin = end) {
    for (end = begin + 1; end < suspects.size() && suspects[end].first == suspects[begin].first;)
      ++end;
    if (end - begin > 1) comparison.look_at(std::span(suspects).subspan(begin, end - begin));
  }
  std::vector<Repeated> found = comparison.take();
  std::sort(found.begin(), found.end(),
            [](const Repeated& a, const Repeated& b) { return a.tet < b.tet; });
  return found;
}

/// What a list has, whatever it is called where it comes from.
struct Elements {
  CornerRows corners;
  std::string_view name;
  const std::vector<std::int64_t>& numbers;
  std::function<Label(std::size_t)> label;
};

class Dropping {
 public:
  using PlaceOf = std::function<std::string(int dimension, std::size_t number)>;

  Dropping(MeshData& mesh, const PlaceOf& place_of)
      : mesh_(mesh), place_of_(place_of), is_second_order_(mesh.tets.empty()) {}

  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> tets =
        find(list_of("tet", tets_of(mesh_)), is_second_order_ ? kNoPlaces : 3);
    erase(tets, tets_of(mesh_), 3);
    erase(find(list_of("triangle", triangles_of(mesh_)), 2), triangles_of(mesh_), 2);
    erase(find(list_of("edge", edges_of(mesh_)), 1), edges_of(mesh_), 1);
    for (OtherElements& others : mesh_.other_elements) {
      const std::vector<std::uint32_t> dropped = drop_others(others);
      if (is_second_order_ && others.vtk_type == vtk_tet10) tets = dropped;
    }
    return tets;
  }

 private:
  template <class Lists>
  static Elements list_of(std::string_view name, const Lists& lists) {
    const auto& elements = lists.elements;
    return {corner_rows(elements), name, lists.numbers,
            [&elements](std::size_t i) { return elements[i].label; }};
  }

  /// Numbers of those to be dropped, ascending; they are noted, with places of that dimension.
  std::vector<std::uint32_t> find(const Elements& elements, int dimension) {
    std::vector<std::uint32_t> found = find_collapsed(elements.corners);
    dimension_ = place_of_ ? dimension : kNoPlaces;
    note_collapsed(elements, found);
    if (elements.corners.width < 4) return found;
    const std::vector<Repeated> repeated = find_repeated(elements.corners, mesh_.points.size());
    note_repeated(elements, repeated);
    for (const Repeated& each : repeated) found.push_back(each.tet);
    std::sort(found.begin(), found.end());
    return found;
  }

  /// In the file; of an element without one, its place in the list.
  static std::int64_t number_of(const Elements& elements, std::size_t i) {
    const bool has_number = !elements.numbers.empty() && elements.numbers[i] > 0;
    return has_number ? elements.numbers[i] : static_cast<std::int64_t>(i) + 1;
  }

  /// "tet 49 (vertices 3 3 17 4)"
  std::string describe(const Elements& elements, std::size_t i) const {
    std::vector<std::int64_t> vertices;
    for (const std::uint32_t v : elements.corners.of(i)) {
      vertices.push_back(mesh_.point_numbers.empty() ? std::int64_t{v} + 1
                                                     : mesh_.point_numbers[v]);
    }
    return fmt::format("{} {} (vertices {})", elements.name, number_of(elements, i),
                       fmt::join(vertices, " "));
  }

  /// "a.mesh:12: ", or nothing
  std::string place_of(std::size_t i) const {
    std::string place = dimension_ == kNoPlaces ? std::string() : place_of_(dimension_, i);
    if (!place.empty()) place += ": ";
    return place;
  }

  void note_collapsed(const Elements& elements, const std::vector<std::uint32_t>& found) {
    if (found.empty()) return;
    const std::string first = describe(elements, found[0]);
    mesh_.notes.push_back(place_of(found[0]) +
                          (found.size() == 1
                               ? fmt::format("{} has a vertex twice: dropped", first)
                               : fmt::format("{} {}s have a vertex twice, the first is {}: dropped",
                                             grouped(found.size()), elements.name, first)));
  }

  void note_repeated(const Elements& elements, const std::vector<Repeated>& found) {
    if (found.empty()) return;
    std::string first = fmt::format("tet {} is tet {} again", number_of(elements, found[0].tet),
                                    number_of(elements, found[0].first));
    const Label label = elements.label(found[0].tet);
    if (const Label other = elements.label(found[0].first); label != other) {
      first += fmt::format(", with label {} instead of {}", label, other);
    }
    mesh_.notes.push_back(place_of(found[0].tet) +
                          (found.size() == 1
                               ? first + ": dropped"
                               : fmt::format("{} tets are there already, {} and so on: dropped",
                                             grouped(found.size()), first)));
  }

  /// The rows that stay, of so many.
  static std::vector<std::uint32_t> others_than(const std::vector<std::uint32_t>& dropped,
                                                std::size_t count) {
    std::vector<std::uint32_t> kept;
    auto next = dropped.begin();
    for (std::uint32_t i = 0; i < count; ++i) {
      if (next != dropped.end() && *next == i) {
        ++next;
      } else {
        kept.push_back(i);
      }
    }
    return kept;
  }

  template <class Values>
  static void select(Values& values, const std::vector<std::uint32_t>& rows,
                     std::size_t width = 1) {
    if (values.empty()) return;
    Values selected;
    for (const std::uint32_t row : rows) {
      const auto from = values.begin() + static_cast<std::ptrdiff_t>(row * width);
      selected.insert(selected.end(), from, from + static_cast<std::ptrdiff_t>(width));
    }
    values = std::move(selected);
  }

  template <class Lists>
  void erase(const std::vector<std::uint32_t>& dropped, const Lists& lists, int dimension) {
    if (dropped.empty()) return;
    const std::size_t count = lists.elements.size();
    const std::vector<std::uint32_t> kept = others_than(dropped, count);
    select(lists.elements, kept);
    select(lists.parts, kept);
    select(lists.numbers, kept);
    for (DataArray& array : lists.data) array = selected_rows(array, kept);
    std::vector<std::uint32_t> place(count, kGone);
    for (std::uint32_t i = 0; i < kept.size(); ++i) place[kept[i]] = i;
    for (Group& group : mesh_.groups) {
      if (group.dimension != dimension) continue;
      for (std::uint32_t& member : group.members) member = place[member];
      std::erase(group.members, kGone);
    }
  }

  /// Numbers of those that went.
  std::vector<std::uint32_t> drop_others(OtherElements& others) {
    const ElementKind* const kind = element_kind(others.vtk_type);
    if (kind == nullptr || others.vertex_count != kind->width) return {};
    constexpr std::array<std::pair<int, std::string_view>, 3> kSecondOrder = {
        {{vtk_tet10, "tet"}, {vtk_triangle6, "triangle"}, {vtk_edge3, "edge"}}};
    for (const auto& [type, name] : kSecondOrder) {
      if (others.vtk_type != type) continue;
      const std::vector<std::uint32_t> dropped =
          find({{others.vertices.data(), kind->width, others.labels.size(), kind->corners},
                name,
                others.numbers,
                [&](std::size_t i) { return others.labels[i]; }},
               type == vtk_tet10 && is_second_order_ ? 3 : kNoPlaces);
      if (dropped.empty()) return {};
      const std::vector<std::uint32_t> kept = others_than(dropped, others.labels.size());
      select(others.vertices, kept, kind->width);
      select(others.labels, kept);
      select(others.parts, kept);
      select(others.numbers, kept);
      for (DataArray& array : others.data) array = selected_rows(array, kept);
      return dropped;
    }
    return {};
  }

  static constexpr std::uint32_t kGone = UINT32_MAX;
  static constexpr int kNoPlaces = -1;  // the reader cannot be asked

  MeshData& mesh_;
  const PlaceOf& place_of_;
  bool is_second_order_;       // which its tets will be
  int dimension_ = kNoPlaces;  // of the list at hand
};

}  // namespace

std::vector<std::uint32_t> drop_degenerate(
    MeshData& mesh, const std::function<std::string(int dimension, std::size_t number)>& place_of) {
  return Dropping(mesh, place_of).run();
}

}  // namespace tetmend::formats
