// SPDX-License-Identifier: MIT
// Brings all that a file holds besides its mesh over to the improved mesh.
#include "face/carry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "face/bodies.h"
#include "face/identifiers.h"
#include "face/overlap.h"
#include "face/tet_locator.h"
#include "kernel/chunks.h"
#include "kernel/face_matcher.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/medit_vectors.h"
#include "kernel/geometry.h"
#include "kernel/grouping.h"
#include "kernel/lists_of_kind.h"
#include "kernel/parts.h"
#include "kernel/shared_parts.h"
#include "kernel/tet_faces.h"

namespace tetmend::face {

namespace {

constexpr std::string_view kLinear = "linear in the old mesh";
constexpr std::string_view kNearest = "of the nearest old vertex";
constexpr std::string_view kConserved = "mean of the old tets by shared volume";
constexpr std::string_view kCentroid = "of the old tet at the centroid";

double volume_of_tet(const MeshData& data, const MeshData::Tet& tet) {
  const auto& v = tet.vertices;
  return std::abs(
             volume6(data.points[v[0]], data.points[v[1]], data.points[v[2]], data.points[v[3]])) /
         6;
}

/// The same vertices in any order are the same element.
template <std::size_t N>
std::array<std::uint32_t, N> sorted(std::array<std::uint32_t, N> vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// By point: it is a vertex of tets, and of no face of one tet only.
std::vector<bool> inner_vertices(const MeshData& data) {
  std::vector<bool> is_inside(data.points.size(), false);
  for (const MeshData::Tet& tet : data.tets) {
    for (const std::uint32_t v : tet.vertices) is_inside[v] = true;
  }
  FaceMatcher matcher(data.points.size(), 4 * data.tets.size());
  for (std::uint32_t t = 0; t < data.tets.size(); ++t) {
    const auto& v = data.tets[t].vertices;
    for (std::uint32_t k = 0; k < 4; ++k) {
      matcher.add(4 * t + k, {v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]});
    }
  }
  matcher.for_single([&](const std::array<std::uint32_t, 3>& face) {
    for (const std::uint32_t v : face) is_inside[v] = false;
  });
  return is_inside;
}

/// Finds elements by their two or three vertices. Of several that are alike each is taken once, in their
/// order.
class OldElements {
 public:
  /// @param vertices ascending
  template <std::size_t N>
  void add(const std::array<std::uint32_t, N>& vertices) {
    all_.push_back(key_of(vertices, static_cast<std::uint32_t>(all_.size())));
  }
  /// Before the first take().
  void sort() {
    std::sort(all_.begin(), all_.end());
    taken_.assign(all_.size(), 0);
  }
  /// The number of the next that was added with these vertices, or kGone.
  template <std::size_t N>
  std::uint32_t take(const std::array<std::uint32_t, N>& vertices) {
    const Key wanted = key_of(vertices, 0);
    const auto first = std::lower_bound(all_.begin(), all_.end(), wanted);
    const auto place = static_cast<std::size_t>(first - all_.begin());
    if (place == all_.size() || !is_alike(*first, wanted)) return kGone;
    const std::size_t next = place + taken_[place];
    if (next == all_.size() || !is_alike(all_[next], wanted)) return kGone;
    ++taken_[place];
    return static_cast<std::uint32_t>(all_[next].second);
  }

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;  // the vertices, then the number

  template <std::size_t N>
  static Key key_of(const std::array<std::uint32_t, N>& vertices, std::uint32_t number) {
    static_assert(N == 2 || N == 3);
    const std::uint64_t last = N == 3 ? vertices[N - 1] : 0;
    return {std::uint64_t{vertices[0]} << 32 | vertices[1], last << 32 | number};
  }
  static bool is_alike(const Key& a, const Key& b) {
    return a.first == b.first && a.second >> 32 == b.second >> 32;
  }

  std::vector<Key> all_;
  std::vector<std::uint32_t> taken_;  // of those alike, at the first of them
};

/// Over a mesh, of a component of an array.
struct Integral {
  double of_values = 0;
  double of_sizes = 0;  // absolute values
};

/// Adds what tets from `begin` on, of these volumes, make of a component.
/// @param values of the component; the next row's is `stride` further
template <class Value, class Stride>
void add_integral(const MeshData& data, std::size_t begin, std::span<const double> volumes,
                  const Value* values, Stride stride, bool is_of_points, Integral& integral) {
  const auto value = [&](std::size_t row) { return static_cast<double>(values[row * stride]); };
  Integral sum = integral;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    double mean = 0;
    if (is_of_points) {
      const auto& v = data.tets[begin + i].vertices;
      mean = (value(v[0]) + value(v[1]) + value(v[2]) + value(v[3])) / 4;
    } else {
      mean = value(begin + i);
    }
    const double part = volumes[i] * mean;
    sum.of_values += part;
    sum.of_sizes += std::abs(part);
  }
  integral = sum;
}

template <class Value>
void add_integrals(const MeshData& data, std::size_t begin, std::span<const double> volumes,
                   const std::vector<Value>& values, bool is_of_points,
                   std::vector<Integral>& integrals) {
  const std::size_t components = integrals.size();
  constexpr std::integral_constant<std::size_t, 1> kOne{};
  if (components == 1)
    return add_integral(data, begin, volumes, values.data(), kOne, is_of_points, integrals[0]);
  for (std::size_t k = 0; k < components; ++k) {
    add_integral(data, begin, volumes, values.data() + k, components, is_of_points, integrals[k]);
  }
}

/// Of the components of each array of points, then of tets. Each volume is computed once.
std::vector<std::vector<Integral>> integrals_of(const MeshData& data) {
  constexpr std::size_t kTetsAtOnce = 512;
  std::vector<std::vector<Integral>> all;
  for (const DataArray& array : data.point_data) all.emplace_back(array.components);
  for (const DataArray& array : data.tet_data) all.emplace_back(array.components);
  std::vector<double> volumes;
  for (std::size_t begin = 0; begin < data.tets.size() && !all.empty(); begin += kTetsAtOnce) {
    volumes.clear();
    const std::size_t end = std::min(begin + kTetsAtOnce, data.tets.size());
    for (std::size_t t = begin; t < end; ++t) volumes.push_back(volume_of_tet(data, data.tets[t]));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_of_points = i < data.point_data.size();
      const DataArray& array =
          is_of_points ? data.point_data[i] : data.tet_data[i - data.point_data.size()];
      std::visit(
          [&](const auto& values) {
            add_integrals(data, begin, volumes, values, is_of_points, all[i]);
          },
          array.values);
    }
  }
  return all;
}

class Carrying {
 public:
  Carrying(const MeshData& before, std::span<const std::uint32_t> vertex_map,
           std::span<const std::uint32_t> tet_map, std::span<const std::string> conserve,
           MeshData& now, const SurfaceMarks* marks)
      : before_(before), now_(now), vertex_map_(vertex_map), conserve_(conserve), marks_(marks) {
    old_point_ = inverse(vertex_map, now.points.size());
    old_tet_ = inverse(tet_map, now.tets.size());
    stayed_.resize(now.points.size());
    for (std::uint32_t i = 0; i < now.points.size(); ++i) {
      const std::uint32_t old = old_point_[i];
      stayed_[i] = old != kGone && before.points[old] == now.points[i] ? 1 : 0;
    }
    moved_from_.assign(now.tets.size(), kGone);
    for (std::uint32_t i = 0; i < now.tets.size(); ++i) {
      if (old_tet_[i] != kGone && !has_changed(now.tets[i])) continue;
      moved_from_[i] = std::exchange(old_tet_[i], kGone);
      changed_.push_back(i);
    }
  }

  Carried run() {
    std::optional<TetLocator> locator;
    if (needs_places() || marks_ != nullptr) {
      std::vector<std::uint32_t> gone = gone_tets();
      origins_.emplace(now_, old_point_, changed_,
                       marks_ != nullptr ? Bodies(before_) : Bodies(before_, gone));
      if (needs_places()) locator.emplace(before_, origins_->bodies(), std::move(gone));
    }
    now_.point_numbers = numbers_of(before_.point_numbers, old_point_);
    now_.tet_numbers = numbers_of(before_.tet_numbers, old_tet_);
    now_.taken_point_numbers = before_.taken_point_numbers;
    now_.taken_element_numbers = before_.taken_element_numbers;
    carry_points(locator);
    carry_tets(locator);
    static const std::vector<Label> kNone;
    carry_elements(triangles_of(before_), triangles_of(now_), 2,
                   marks_ != nullptr ? marks_->triangles : kNone);
    carry_elements(edges_of(before_), edges_of(now_), 1, marks_ != nullptr ? marks_->edges : kNone);
    carry_groups();
    carry_others();
    carry_required_vertices();
    now_.entities = before_.entities;
    now_.deck = before_.deck;
    now_.variant = before_.variant;
    now_.label_array = before_.label_array;
    return tell();
  }

 private:
  static std::vector<std::uint32_t> inverse(std::span<const std::uint32_t> map, std::size_t count) {
    std::vector<std::uint32_t> inverse(count, kGone);
    for (std::uint32_t i = 0; i < map.size(); ++i) {
      if (map[i] != kGone) inverse[map[i]] = i;
    }
    return inverse;
  }

  bool has_members(int dimension) const {
    return std::any_of(before_.groups.begin(), before_.groups.end(), [&](const Group& group) {
      return group.dimension == dimension && !group.members.empty();
    });
  }
  bool stayed(std::uint32_t point) const { return stayed_[point] != 0; }
  bool has_changed(const MeshData::Tet& tet) const {
    return !std::all_of(tet.vertices.begin(), tet.vertices.end(),
                        [this](std::uint32_t v) { return stayed(v); });
  }

  /// Places are looked up for points or tets.
  bool needs_places() const {
    return !before_.point_data.empty() || has_members(0) || needs_tets();
  }
  bool needs_tets() const {
    return !before_.tet_data.empty() || !before_.tet_parts.empty() || has_members(3);
  }

  /// Of the old tets those that are not there any more as they were.
  std::vector<std::uint32_t> gone_tets() const {
    std::vector<std::uint32_t> gone;
    std::vector<char> is_same(before_.tets.size(), 0);
    for (const std::uint32_t t : old_tet_) {
      if (t != kGone) is_same[t] = 1;
    }
    for (std::uint32_t t = 0; t < is_same.size(); ++t) {
      if (is_same[t] == 0) gone.push_back(t);
    }
    return gone;
  }

  void carry_points(const std::optional<TetLocator>& locator) {
    if (!before_.point_entities.empty()) {
      now_.point_entities.assign(now_.points.size(), {-1, 0});
      for (std::size_t i = 0; i < now_.points.size(); ++i) {
        if (old_point_[i] != kGone) now_.point_entities[i] = before_.point_entities[old_point_[i]];
      }
    }
    if (before_.point_data.empty() && !has_members(0)) return;
    places_.resize(now_.points.size());
    for_chunks(places_.size(), [&](std::size_t begin, std::size_t end) {
      Origin origin;
      for (std::size_t i = begin; i < end; ++i) {
        const auto point = static_cast<std::uint32_t>(i);
        if (stayed(point) || locator->is_empty()) continue;
        origins_->of_point(point, origin);
        places_[i] = locator->find(now_.points[i], origin);
      }
    });
    for (const DataArray& array : before_.point_data) {
      if (are_identifiers(array)) {
        NewIdentifiers numbers({&array});
        now_.point_data.push_back(renumbered(array, old_point_, "points", numbers));
        continue;
      }
      DataArray& made = now_.point_data.emplace_back(DataArray{array.name, array.components, {}});
      std::visit([&](const auto& old) { made.values = interpolated(old, array.components); },
                 array.values);
    }
  }

  template <class Value>
  std::vector<Value> interpolated(const std::vector<Value>& old, std::size_t components) const {
    std::vector<Value> made(places_.size() * components);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      for (std::size_t k = 0; k < components; ++k) {
        Value& value = made[i * components + k];
        if (stayed(static_cast<std::uint32_t>(i))) {
          value = old[old_point_[i] * components + k];
          continue;
        }
        const auto& v = before_.tets[places_[i].tet].vertices;
        const auto& weights = places_[i].weights;
        if constexpr (std::is_integral_v<Value>) {
          const auto* most = std::max_element(weights.begin(), weights.end());
          value = old[v[static_cast<std::size_t>(most - weights.begin())] * components + k];
        } else {
          // From the first vertex on, so that a constant stays what it is.
          const auto at = [&](std::size_t c) {
            return static_cast<double>(old[v[c] * components + k]);
          };
          double sum = at(0);
          for (std::size_t c = 1; c < 4; ++c) sum += weights[c] * (at(c) - at(0));
          value = static_cast<Value>(sum);
        }
      }
    }
    return made;
  }

  DataArray renumbered(const DataArray& array, std::span<const std::uint32_t> same,
                       std::string_view of, NewIdentifiers& numbers) {
    DataArray made = numbers.carried(array, same);
    std::string note = identifier_note(array, made, of, same);
    if (!note.empty()) notes_.push_back(std::move(note));
    return made;
  }
  /// Those that elements of all kinds share.
  NewIdentifiers& identifiers_of_elements(const std::string& name) {
    const auto known = element_identifiers_.find(name);
    if (known != element_identifiers_.end()) return known->second;
    std::vector<const DataArray*> arrays;
    const auto add = [&](const std::vector<DataArray>& list) {
      for (const DataArray& array : list) {
        if (array.name == name && array.components == 1) arrays.push_back(&array);
      }
    };
    add(before_.tet_data);
    add(before_.triangle_data);
    add(before_.edge_data);
    for (const OtherElements& others : before_.other_elements) add(others.data);
    return element_identifiers_.try_emplace(name, std::move(arrays)).first->second;
  }
  /// By new tet the old one with these vertices, though they may have moved.
  std::vector<std::uint32_t> same_tets() const {
    std::vector<std::uint32_t> same = old_tet_;
    for (const std::uint32_t t : changed_) same[t] = moved_from_[t];
    return same;
  }

  void carry_tets(const std::optional<TetLocator>& locator) {
    if (!needs_tets()) return;
    const std::vector<Shares> shares =
        conserve_.empty() ? std::vector<Shares>() : find_shares(*locator);
    for_chunks(changed_.size(), [&](std::size_t begin, std::size_t end) {
      Origin origin;
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t t = changed_[i];
        origins_->of_tet(t, origin);
        origin.tet = moved_from_[t];
        old_tet_[t] = locator->find_tet(centroid(now_.tets[t]), origin);
      }
    });
    if (!before_.tet_parts.empty()) {
      now_.tet_parts.resize(now_.tets.size());
      for (std::size_t i = 0; i < old_tet_.size(); ++i) {
        now_.tet_parts[i] = before_.tet_parts[old_tet_[i]];
      }
    }
    for (const DataArray& array : before_.tet_data) {
      if (!is_conserved(array) && are_identifiers(array)) {
        now_.tet_data.push_back(
            renumbered(array, same_tets(), "tets", identifiers_of_elements(array.name)));
        continue;
      }
      now_.tet_data.push_back(is_conserved(array) ? conserved(array, shares)
                                                  : formats::selected_rows(array, old_tet_));
    }
  }

  bool is_conserved(const DataArray& array) const {
    return std::find(conserve_.begin(), conserve_.end(), array.name) != conserve_.end();
  }

  /// Old tets that a new one shares volume with, and which part of it.
  using Shares = std::vector<std::pair<std::uint32_t, double>>;

  static std::array<Point, 4> corners(const MeshData& data, const MeshData::Tet& tet) {
    std::array<Point, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = data.points[tet.vertices[k]];
    return corners;
  }

  /// Empty for a tet that is as before.
  std::vector<Shares> find_shares(const TetLocator& locator) const {
    std::vector<Shares> shares(now_.tets.size());
    for_chunks(shares.size(), [&](std::size_t begin, std::size_t end) {
      Origin origin;
      for (std::size_t i = begin; i < end; ++i) {
        if (old_tet_[i] != kGone) continue;
        origins_->of_tet(static_cast<std::uint32_t>(i), origin);
        const std::array<Point, 4> tet = corners(now_, now_.tets[i]);
        double sum = 0;
        for (const std::uint32_t old : locator.near(tet, origin.bodies)) {
          const double shared = overlap(tet, corners(before_, before_.tets[old]));
          if (shared > 0) shares[i].emplace_back(old, shared);
          sum += shared;
        }
        for (auto& share : shares[i]) share.second /= sum;
      }
    });
    return shares;
  }

  /// Precondition: real numbers.
  DataArray conserved(const DataArray& array, const std::vector<Shares>& shares) const {
    DataArray made = formats::selected_rows(array, old_tet_);
    std::visit(
        [&](const auto& old) {
          using Values = std::decay_t<decltype(old)>;
          using Value = typename Values::value_type;
          auto& now = std::get<Values>(made.values);
          for (std::size_t i = 0; i < shares.size(); ++i) {
            for (std::size_t k = 0; k < array.components && !shares[i].empty(); ++k) {
              double mean = 0;
              for (const auto& [tet, share] : shares[i]) {
                mean += share * static_cast<double>(old[tet * array.components + k]);
              }
              now[i * array.components + k] = static_cast<Value>(mean);
            }
          }
        },
        array.values);
    return made;
  }

  Point centroid(const MeshData::Tet& tet) const {
    Point sum = Point::Zero();
    for (const std::uint32_t v : tet.vertices) sum += now_.points[v];
    return sum / 4;
  }

  /// Of an element, as it is in one of the meshes.
  template <class Element>
  static Point middle(const MeshData& data, const Element& element) {
    Point sum = Point::Zero();
    for (const std::uint32_t v : element.vertices) sum += data.points[v];
    return sum / static_cast<double>(element.vertices.size());
  }

  /// The nearest of the old elements that an element of a changed surface is like, of the same body if
  /// there is one; kGone for a wall that nobody named. Cost: linear.
  template <class Element>
  std::uint32_t model_of(const Element& element, const std::vector<Element>& old,
                         const std::vector<Label>& marks) const {
    const Point here = middle(now_, element);
    for (const bool is_anywhere : {false, true}) {
      std::uint32_t nearest = kGone;
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t i = 0; i < old.size(); ++i) {
        if ((marks.empty() ? old[i].label : marks[i]) != element.label) continue;
        const double distance = (middle(before_, old[i]) - here).squaredNorm();
        if (!(distance < least)) continue;
        if (!is_anywhere && !origins_->may_be_one(element.vertices, old[i].vertices)) continue;
        least = distance;
        nearest = i;
      }
      if (nearest != kGone) return nearest;
    }
    return kGone;
  }

  /// Elements come back in an order of their own, and with walls that nobody named.
  template <class Old, class New>
  void carry_elements(const Old& old, const New& made, std::size_t dimension,
                      const std::vector<Label>& marks) {
    using Element = typename std::remove_reference_t<decltype(made.elements)>::value_type;
    OldElements places;
    for (const auto& element : old.elements) {
      auto vertices = element.vertices;
      for (std::uint32_t& v : vertices) v = vertex_map_[v];
      places.add(sorted(vertices));
    }
    places.sort();
    const std::set<decltype(Element::vertices)> walls = walls_now<Element>();
    std::vector<std::uint32_t> from;  // whose values it takes
    std::vector<std::uint32_t> same;  // kGone for a new one
    std::vector<Element> kept;
    for (const Element& element : made.elements) {
      const std::uint32_t found = places.take(sorted(element.vertices));
      const bool is_old = found != kGone;
      if (!is_old && (marks_ == nullptr || walls.contains(sorted(element.vertices)))) continue;
      const std::uint32_t model = is_old ? found : model_of(element, old.elements, marks);
      if (model == kGone) continue;
      from.push_back(model);
      same.push_back(is_old ? model : kGone);
      kept.push_back(element);
      if (!marks.empty()) kept.back().label = old.elements[model].label;
    }
    made.elements = std::move(kept);
    const bool are_all_old = std::find(same.begin(), same.end(), kGone) == same.end();
    for (const DataArray& array : old.data) {
      made.data.push_back(are_all_old || !are_identifiers(array)
                              ? formats::selected_rows(array, from)
                              : renumbered(array, same, dimension == 2 ? "triangles" : "edges",
                                           identifiers_of_elements(array.name)));
    }
    if (!old.parts.empty()) {
      for (const std::uint32_t i : from) made.parts.push_back(old.parts[i]);
    }
    made.numbers = numbers_of(old.numbers, same);
    std::vector<std::uint32_t>& map = element_maps_[dimension];
    map.assign(old.elements.size(), kGone);
    for (std::uint32_t i = 0; i < from.size(); ++i) {
      if (same[i] != kGone) {
        map[from[i]] = i;
      } else {
        new_elements_[dimension].push_back({from[i], i});
      }
    }
  }

  /// What walls_between_parts() and hold_shared_inside() added, sorted; they cannot have changed.
  template <class Element>
  std::set<decltype(Element::vertices)> walls_now() const {
    std::set<decltype(Element::vertices)> walls;
    if (marks_ == nullptr) return walls;
    const auto add = [&](decltype(Element::vertices) wall) {
      for (std::uint32_t& v : wall) v = vertex_map_[v];
      walls.insert(sorted(wall));
    };
    const SharedParts inside = find_shared_inside(before_, find_shared_parts(before_));
    if constexpr (std::is_same_v<Element, MeshData::Triangle>) {
      for (const MeshData::Triangle& wall : walls_between_parts(before_)) add(wall.vertices);
      for (const auto& face : inside.faces) add(face);
    } else {
      for (const auto& edge : inside.edges) add(edge);
    }
    return walls;
  }

  /// New ones have no number yet.
  static std::vector<std::int64_t> numbers_of(const std::vector<std::int64_t>& old,
                                              const std::vector<std::uint32_t>& from) {
    std::vector<std::int64_t> numbers;
    if (old.empty()) return numbers;
    numbers.reserve(from.size());
    for (const std::uint32_t i : from) numbers.push_back(i == kGone ? 0 : old[i]);
    return numbers;
  }

  void carry_groups() {
    for (Group group : before_.groups) {
      if (group.members.empty()) {
        now_.groups.push_back(std::move(group));
        continue;
      }
      switch (group.dimension) {
        case 0:
          group.members = points_of(group.members, !formats::is_medit_mark(group.name));
          break;
        case 3:
          group.members = tets_of(group.members);
          break;
        default:
          group.members = elements_of(group.members, static_cast<std::size_t>(group.dimension));
      }
      now_.groups.push_back(std::move(group));
    }
    for (PeriodicLink link : before_.periodic) {
      std::erase_if(link.points, [this](const auto& pair) {
        return vertex_map_[pair[0]] == kGone || vertex_map_[pair[1]] == kGone;
      });
      for (auto& pair : link.points) pair = {vertex_map_[pair[0]], vertex_map_[pair[1]]};
      now_.periodic.push_back(std::move(link));
    }
  }

  using Members = std::vector<std::uint32_t>;

  // There may be as many groups as members: each takes time for its own alone, not for the mesh.

  /// The points that are left; of a set that fills a volume also new ones in tets that it holds
  /// wholly. A mark, such as of corners, is of single points.
  Members points_of(const Members& old, bool may_fill) {
    held_.resize(before_.points.size(), 0);
    for (const std::uint32_t v : old) held_[v] = 1;
    Members members;
    for (const std::uint32_t v : old) {
      if (vertex_map_[v] != kGone) members.push_back(vertex_map_[v]);
    }
    if (may_fill && fills_volume(old)) {
      index_new_points();
      for (const std::uint32_t v : old) {
        for (const std::uint32_t i : new_points_at_.group(v)) {
          const std::uint32_t point = new_points_[i];
          if (holds(before_.tets[places_[point].tet])) members.push_back(point);
        }
      }
    }
    for (const std::uint32_t v : old) held_[v] = 0;
    return in_order(std::move(members));
  }
  bool holds(const MeshData::Tet& tet) const {
    return std::all_of(tet.vertices.begin(), tet.vertices.end(),
                       [this](std::uint32_t v) { return held_[v] != 0; });
  }
  /// It holds a vertex within the volume, or all vertices of tets: others mark places on the surface.
  bool fills_volume(const Members& old) {
    if (is_inside_.empty()) is_inside_ = inner_vertices(before_);
    if (std::any_of(old.begin(), old.end(), [this](std::uint32_t v) { return is_inside_[v]; })) {
      return true;
    }
    return !before_.tets.empty() &&
           std::all_of(before_.tets.begin(), before_.tets.end(),
                       [this](const MeshData::Tet& tet) { return holds(tet); });
  }
  /// New points by a corner of the old tet that they lie in.
  void index_new_points() {
    if (!new_points_at_.begin.empty()) return;
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < now_.points.size(); ++i) {
      if (old_point_[i] != kGone) continue;
      new_points_.push_back(i);
      corners.push_back(before_.tets[places_[i].tet].vertices[0]);
    }
    new_points_at_ = group_by_key(corners, static_cast<std::uint32_t>(before_.points.size()));
  }

  Members tets_of(const Members& old) {
    if (tets_from_.begin.empty()) {
      tets_from_ = group_by_key(old_tet_, static_cast<std::uint32_t>(before_.tets.size()));
    }
    Members members;
    for (const std::uint32_t t : old) {
      const auto made = tets_from_.group(t);
      members.insert(members.end(), made.begin(), made.end());
    }
    return in_order(std::move(members));
  }

  Members elements_of(const Members& old, std::size_t dimension) {
    auto& made = new_elements_[dimension];
    if (!std::is_sorted(made.begin(), made.end())) std::sort(made.begin(), made.end());
    Members members;
    for (const std::uint32_t i : old) {
      if (element_maps_[dimension][i] != kGone) members.push_back(element_maps_[dimension][i]);
      auto at = std::lower_bound(made.begin(), made.end(), std::pair(i, std::uint32_t{0}));
      for (; at != made.end() && at->first == i; ++at) members.push_back(at->second);
    }
    return in_order(std::move(members));
  }

  static Members in_order(Members members) {
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    return members;
  }

  /// Their vertices all stayed, with what lies between them. Who takes them from the tets makes a mesh
  /// that no solver can use.
  void carry_others() {
    now_.other_elements = before_.other_elements;
    for (OtherElements& others : now_.other_elements) {
      for (std::uint32_t& v : others.vertices) v = vertex_map_[v];
    }
    const std::size_t lost = count_lost_parts(before_, vertex_map_, now_);
    if (lost == 0) return;
    throw Error(fmt::format(
        "{} faces, edges or points that tets had in common with other elements are gone: "
        "this is a bug of tetmend, please report it",
        lost));
  }
  /// Without those that were required for the sake of other elements.
  void carry_required_vertices() {
    if (before_.other_elements.empty()) return;
    std::vector<bool> was_required(before_.points.size(), false);
    for (const std::uint32_t v : before_.required_vertices) was_required[v] = true;
    std::erase_if(now_.required_vertices, [&](std::uint32_t v) {
      return old_point_[v] == kGone || !was_required[old_point_[v]];
    });
  }

  Carried tell() const {
    const auto then = integrals_of(before_);
    const auto now = integrals_of(now_);
    std::vector<CarriedArray> carried;
    for (std::size_t i = 0; i < then.size(); ++i) {
      std::vector<ComponentIntegral> components;
      for (std::size_t k = 0; k < then[i].size(); ++k) {
        components.push_back({then[i][k].of_values, then[i][k].of_sizes, now[i][k].of_values});
      }
      const std::size_t points = before_.point_data.size();
      const bool is_of_points = i < points;
      const DataArray& array = is_of_points ? before_.point_data[i] : before_.tet_data[i - points];
      carried.push_back(
          carried_array(array, is_of_points, !is_of_points && is_conserved(array), components));
    }
    return {std::move(carried), notes_};
  }

  const MeshData& before_;
  MeshData& now_;
  std::span<const std::uint32_t> vertex_map_;
  std::span<const std::string> conserve_;
  const SurfaceMarks* marks_;              // null: the surface is fixed
  std::vector<char> stayed_;               // new points that are old ones where they were
  std::vector<std::uint32_t> old_point_;   // by new number; kGone: it is new
  std::vector<std::uint32_t> old_tet_;     // likewise; kGone also where a vertex has moved
  std::vector<std::uint32_t> moved_from_;  // the old tet with the vertices of one that has changed
  std::vector<std::uint32_t> changed_;     // new tets that are not as they were
  std::optional<Origins> origins_;         // where values are looked up
  std::vector<bool> is_inside_;            // old points; empty: not asked for yet
  std::vector<char> held_;                 // old points of the group at hand
  std::vector<std::uint32_t> new_points_;
  Grouping new_points_at_;        // what of them is at an old point; empty: not asked for yet
  Grouping tets_from_;            // new tets by the old tet that they are from; likewise
  std::vector<TetPlace> places_;  // in the old mesh, of points that are new or have moved
  std::array<std::vector<std::uint32_t>, 4> element_maps_;
  // New ones of a changed surface, each with the old one that it is like.
  std::array<std::vector<std::pair<std::uint32_t, std::uint32_t>>, 4> new_elements_;
  std::map<std::string, NewIdentifiers> element_identifiers_;  // by name of arrays
  std::vector<std::string> notes_;
};

}  // namespace

bool holds_more(const MeshData& data) {
  const auto any = [](const auto&... lists) { return (!lists.empty() || ...); };
  return any(data.tet_parts, data.triangle_parts, data.edge_parts, data.point_entities,
             data.point_data, data.tet_data, data.triangle_data, data.edge_data, data.groups,
             data.entities, data.periodic, data.other_elements, data.point_numbers,
             data.tet_numbers, data.mid_nodes, data.deck, data.variant, data.label_array);
}

std::vector<MeshData::Triangle> walls_between_parts(const MeshData& data) {
  if (!are_finer_than_labels(data.tets, data.tet_parts)) return {};
  std::vector<MeshData::Triangle> walls;
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& a, const TetFace* b) {
    if (b == nullptr || data.tet_parts[a.tet] == data.tet_parts[b->tet] ||
        data.tets[a.tet].label != data.tets[b->tet].label) {
      return;
    }
    walls.push_back({a.vertices, 0});
  });
  std::vector<std::array<std::uint32_t, 3>> named;
  for (const MeshData::Triangle& triangle : data.triangles)
    named.push_back(sorted(triangle.vertices));
  std::sort(named.begin(), named.end());
  std::erase_if(walls, [&](const MeshData::Triangle& wall) {
    return std::binary_search(named.begin(), named.end(), wall.vertices);
  });
  return walls;
}

Carried carry(const MeshData& before, std::span<const std::uint32_t> vertex_map,
              std::span<const std::uint32_t> tet_map, std::span<const std::string> conserve,
              MeshData& now, const SurfaceMarks* marks) {
  return Carrying(before, vertex_map, tet_map, conserve, now, marks).run();
}

CarriedArray carried_array(const DataArray& array, bool is_of_points, bool is_conserved,
                           std::span<const ComponentIntegral> integrals) {
  const bool is_real = array.values.index() >= 2;
  if (!is_conserved && are_identifiers(array)) {
    return {array.name, is_of_points ? "points" : "tets", std::string(kIdentifierRule), 0};
  }
  const std::string_view rule = !is_of_points ? is_conserved ? kConserved : kCentroid
                                : is_real     ? kLinear
                                              : kNearest;
  double worst = 0;
  for (const auto& [then, size, now] : integrals) {
    if (now == then) continue;
    const double error = std::abs(now - then) / std::max(size, std::abs(now));
    worst = std::isfinite(error) ? std::max(worst, error) : worst;
  }
  return {array.name, is_of_points ? "points" : "tets", std::string(rule), worst};
}

void check_conserve(const MeshData& data, std::span<const std::string> conserve) {
  for (const std::string& name : conserve) {
    const auto has_name = [&](const DataArray& array) { return array.name == name; };
    const auto found = std::find_if(data.tet_data.begin(), data.tet_data.end(), has_name);
    if (found == data.tet_data.end()) {
      std::vector<std::string> names;
      for (const DataArray& array : data.tet_data) names.push_back(array.name);
      const std::string known =
          names.empty() ? "they have none" : fmt::format("they have {}", fmt::join(names, ", "));
      throw OptionError(
          "conserve", fmt::format("conserve: no array of the tets is named '{}': {}", name, known));
    }
    if (found->values.index() < 2) {
      throw OptionError("conserve",
                        fmt::format("conserve: '{}' has integers, whose mean is none", name));
    }
  }
}

}  // namespace tetmend::face
