// SPDX-License-Identifier: MIT
// Writes Netgen's `.vol`. What a file of Netgen said of surfaces and edges is written again; for
// other meshes it is found from the tets.
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/exact_orientation.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/face_sides.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/netgen.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/unique_names.h"

namespace tetmend::formats {
namespace {

/// Netgen has names for 1, 2, 3... without gaps.
constexpr Label kGreatestNamed = 1000000;

const DataArray* find_array(const ElementList& list, std::string_view name,
                            std::size_t components) {
  if (list.data == nullptr) return nullptr;
  for (const DataArray& array : *list.data) {
    const bool fits =
        components == 0 ? array.components % kNetgenSegment == 0 : array.components == components;
    if (array.name == name && fits && array.size() == list.count * array.components) return &array;
  }
  return nullptr;
}

/// Numbers of an array of Netgen's, or none.
template <class T>
const std::vector<T>* find_values(const ElementList& list, std::string_view name,
                                  std::size_t components) {
  const DataArray* array = find_array(list, name, components);
  return array == nullptr ? nullptr : std::get_if<std::vector<T>>(&array->values);
}

struct SurfaceRow {
  Label surface = 0, label = 0, inside = 0, outside = 0;
  friend auto operator<=>(const SurfaceRow&, const SurfaceRow&) = default;
};

class NetgenWriter {
 public:
  NetgenWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file),
        mesh_(mesh),
        lists_(mesh),
        surfaces_(lists_.of_dimension(2)),
        is_ours_(mesh.data() != nullptr && mesh.data()->variant == kNetgen) {}

  void write() {
    out_.put("mesh3d\ndimension\n3\n");
    if (!put_deck([](std::string_view piece) { return piece.starts_with("geomtype"); })) {
      out_.put("geomtype\n0\n");
    }
    find_surfaces();
    write_surfaces();
    write_volumes();
    write_edges();
    write_points();
    write_links();
    if (mesh_.data() != nullptr) write_names();
    put_deck([](std::string_view piece) {
      return !piece.starts_with("geomtype") && !piece.starts_with("endmesh");
    });
    if (!put_deck([](std::string_view piece) { return piece.starts_with("endmesh"); })) {
      out_.put("endmesh\n");
    }
    out_.commit(mesh_.companions());
  }

 private:
  /// True if there is such a piece.
  template <class Which>
  bool put_deck(const Which& which) {
    bool any = false;
    if (!is_ours_) return false;
    for (const std::string& piece : mesh_.data()->deck) {
      if (!which(piece)) continue;
      out_.put(piece);
      any = true;
    }
    return any;
  }

  void find_surfaces() {
    rows_.resize(surfaces_.size());
    bool all_known = true;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) all_known &= take_known(k);
    if (!all_known) derive();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      for (const SurfaceRow& row : rows_[k]) {
        faces_.try_emplace(row, static_cast<Label>(faces_.size() + 1));
      }
    }
  }

  bool take_known(std::size_t k) {
    const ElementList& list = *surfaces_[k];
    const auto* surface = find_values<std::int32_t>(list, kNetgenSurface, 1);
    const auto* inside = find_values<std::int32_t>(list, kNetgenInside, 1);
    const auto* outside = find_values<std::int32_t>(list, kNetgenOutside, 1);
    if (surface == nullptr || inside == nullptr || outside == nullptr) return false;
    for (std::size_t i = 0; i < list.count; ++i) {
      rows_[k].push_back({(*surface)[i], list.label(i), (*inside)[i], (*outside)[i]});
    }
    return true;
  }

  /// A surface for each label and pair of domains.
  void derive() {
    std::vector<Label> labels;
    for (const ElementList* list : lists_.of_dimension(3)) {
      for (std::size_t i = 0; i < list->count; ++i) labels.push_back(list->label(i));
    }
    const auto domain = [&](std::uint32_t element) {
      return element == kNoElement ? 0 : labels[element];
    };
    const auto sides = find_face_sides(mesh_, lists_);
    std::map<std::tuple<Label, Label, Label>, Label> numbers;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
      rows_[k].clear();
      for (std::size_t i = 0; i < surfaces_[k]->count; ++i) {
        const Label label = surfaces_[k]->label(i);
        const Label inside = domain(sides[k][i].behind);
        const Label outside = domain(sides[k][i].front);
        const auto next = static_cast<Label>(numbers.size() + 1);
        const Label number = numbers.try_emplace({label, inside, outside}, next).first->second;
        rows_[k].push_back({number, label, inside, outside});
      }
    }
  }

  void write_surfaces() {
    std::size_t count = 0;
    bool has_numbers = !surfaces_.empty();
    bool has_parameters = !surfaces_.empty();
    for (const ElementList* list : surfaces_) {
      count += netgen_width(list->kind) > 0 ? list->count : 0;
      const std::size_t width = list->kind.width;
      has_numbers &= find_values<std::int32_t>(*list, kNetgenTriangleNumbers, width) != nullptr;
      has_parameters &= find_values<double>(*list, kNetgenParameters, 2 * width) != nullptr;
    }
    out_.put(fmt::format("\nsurfaceelements{}\n{}\n",
                         has_parameters ? "uv"
                         : has_numbers  ? "gi"
                                        : "",
                         count));
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
      const ElementList& list = *surfaces_[k];
      if (netgen_width(list.kind) == 0) continue;
      const auto* numbers =
          find_values<std::int32_t>(list, kNetgenTriangleNumbers, list.kind.width);
      const auto* parameters = find_values<double>(list, kNetgenParameters, 2 * list.kind.width);
      put_rows(out_, list.count, [&](std::size_t i, OutputBuffer& buffer) {
        const SurfaceRow& row = rows_[k][i];
        for (const Label number : {row.surface, row.label, row.inside, row.outside}) {
          buffer.put_integer(number);
          buffer.put(' ');
        }
        const bool is_second = list.kind.vtk_type == vtk_triangle6;
        put_vertices(buffer, list, i, is_second ? kNetgenTriangle6.data() : nullptr);
        const std::size_t width = list.kind.width;
        for (std::size_t j = i * width; j < (i + 1) * width && has_numbers && !has_parameters;
             ++j) {
          buffer.put(' ');
          buffer.put_integer((*numbers)[j]);
        }
        for (std::size_t j = 2 * i * width; j < 2 * (i + 1) * width && has_parameters; ++j) {
          buffer.put(' ');
          buffer.put_real((*parameters)[j]);
        }
        buffer.put('\n');
      });
    }
  }

  /// 0: Netgen has no such elements.
  static std::size_t netgen_width(const ElementKind& kind) {
    const bool is_first = kind.vtk_type == vtk_tet || kind.vtk_type == vtk_triangle;
    return is_first || netgen_holds(kind.vtk_type) ? kind.width : 0;
  }

  /// `order` is that of the reader; null: the same as VTK's.
  static void put_vertices(OutputBuffer& buffer, const ElementList& list, std::size_t i,
                           const std::uint8_t* order) {
    const auto v = list.vertices(i);
    std::array<std::uint32_t, kMostVerticesOfElement> listed{};
    for (std::size_t k = 0; k < v.size(); ++k) listed[order == nullptr ? k : order[k]] = v[k];
    buffer.put_integer(static_cast<std::int64_t>(v.size()));
    for (std::size_t k = 0; k < v.size(); ++k) {
      buffer.put(' ');
      buffer.put_integer(std::int64_t{listed[k]} + 1);
    }
  }

  /// Netgen's tets are turned round. Those of a mesh that is so already stay. One tet may be inverted,
  /// and has to stay what it is: most decide.
  const std::uint8_t* tet_order() const {
    std::size_t tets = 0;
    std::size_t turned = 0;
    for (const ElementList* list : lists_.of_dimension(3)) {
      if (list->kind.corners != 4) continue;
      tets += list->count;
      for (std::size_t i = 0; i < list->count; ++i) {
        const auto v = list->vertices(i);
        const bool is_turned = is_turned_over(mesh_.point(v[0]), mesh_.point(v[1]),
                                              mesh_.point(v[2]), mesh_.point(v[3]));
        turned += is_turned ? 1 : 0;
      }
    }
    return 2 * turned > tets ? kNetgenTurnedTet.data() : kNetgenTet.data();
  }

  void write_volumes() {
    std::size_t count = 0;
    for (const ElementList* list : lists_.of_dimension(3)) {
      count += netgen_width(list->kind) > 0 ? list->count : 0;
    }
    out_.put(fmt::format("\nvolumeelements\n{}\n", count));
    const std::uint8_t* order = tet_order();
    for (const ElementList* list : lists_.of_dimension(3)) {
      if (netgen_width(list->kind) == 0) continue;
      put_rows(out_, list->count, [&](std::size_t i, OutputBuffer& buffer) {
        buffer.put_integer(list->label(i));
        buffer.put(' ');
        const bool is_tet = list->kind.corners == 4;
        put_vertices(buffer, *list, i, is_tet ? order : nullptr);
        buffer.put('\n');
      });
    }
  }

  using Segment = std::array<double, kNetgenSegment>;

  void write_edges() {
    OutputBuffer rows;
    std::size_t count = 0;
    const auto touching = surfaces_at_edges();
    for (const ElementList* list : lists_.of_dimension(1)) {
      const auto* known = find_values<double>(*list, kNetgenSegments, 0);
      for (std::size_t i = 0; i < list->count; ++i) {
        const auto v = list->vertices(i);
        const std::vector<Segment> segments =
            known != nullptr && !known->empty()
                ? known_segments(*known, i, list->count)
                : made_segments(touching.at(std::minmax(v[0], v[1])), v[0], list->label(i));
        for (const Segment& segment : segments) put_segment(rows, segment, v);
        count += segments.size();
      }
    }
    out_.put(fmt::format("\nedgesegmentsgi2\n{}\n", count));
    out_.put(rows.content());
  }

  static std::vector<Segment> known_segments(const std::vector<double>& values, std::size_t i,
                                             std::size_t edges) {
    const std::size_t width = values.size() / edges;
    std::vector<Segment> segments;
    for (std::size_t k = 0; k < width; k += kNetgenSegment) {
      Segment segment{};
      std::copy_n(values.data() + i * width + k, kNetgenSegment, segment.begin());
      if (k == 0 || segment[1] != 0) segments.push_back(segment);
    }
    return segments;
  }

  struct Touch {
    Label face;
    std::uint32_t from;
  };
  using Touches = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Touch>>;

  static std::vector<Segment> made_segments(const std::vector<Touch>& touches, std::uint32_t first,
                                            Label label) {
    std::vector<Segment> segments;
    const Label one = touches.empty() ? 1 : touches.front().face;
    const Label other = touches.empty() ? 1 : touches.back().face;
    for (const Touch& touch :
         std::span(touches).first(std::min(touches.size(), kMostSegmentsOfEdge))) {
      const double way = touch.from == first ? 1 : -1;
      segments.push_back(
          {double(touch.face), way, 0, 0, double(one), double(other), double(label)});
    }
    if (segments.empty()) segments.push_back({1, 1, 0, 0, 1, 1, double(label)});
    return segments;
  }

  /// For each edge that is named.
  Touches surfaces_at_edges() const {
    Touches touches;
    for (const ElementList* list : lists_.of_dimension(1)) {
      for (std::size_t i = 0; i < list->count; ++i) {
        touches.try_emplace(std::minmax(list->vertices(i)[0], list->vertices(i)[1]));
      }
    }
    if (touches.empty()) return touches;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
      for (std::size_t i = 0; i < surfaces_[k]->count; ++i) {
        const auto v = surfaces_[k]->vertices(i);
        const std::size_t corners = surfaces_[k]->kind.corners;
        for (std::size_t c = 0; c < corners; ++c) {
          const auto found = touches.find(std::minmax(v[c], v[(c + 1) % corners]));
          if (found != touches.end()) found->second.push_back({faces_.at(rows_[k][i]), v[c]});
        }
      }
    }
    return touches;
  }

  static void put_segment(OutputBuffer& rows, const Segment& segment,
                          std::span<const std::uint32_t> v) {
    const bool is_turned = segment[1] < 0;
    rows.put_real(segment[0]);
    rows.put(" 0 ");
    rows.put_integer(std::int64_t{v[is_turned ? 1 : 0]} + 1);
    rows.put(' ');
    rows.put_integer(std::int64_t{v[is_turned ? 0 : 1]} + 1);
    for (std::size_t k = 2; k < segment.size(); ++k) {
      rows.put(' ');
      rows.put_real(segment[k]);
    }
    rows.put('\n');
  }

  void write_points() {
    out_.put(fmt::format("\npoints\n{}\n", mesh_.point_count()));
    put_rows(out_, mesh_.point_count(), [this](std::size_t i, OutputBuffer& buffer) {
      for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) buffer.put(' ');
        buffer.put_real(mesh_.point(i)[axis]);
      }
      buffer.put('\n');
    });
  }

  void write_links() {
    if (mesh_.data() == nullptr) return;
    std::string rows;
    std::size_t count = 0;
    for (const Group& group : mesh_.data()->groups) {
      if (group.dimension != 0 || group.number < 1) continue;
      for (const std::uint32_t member : group.members) {
        rows += fmt::format("{} {}\n", member + 1, group.number);
        ++count;
      }
    }
    if (count > 0) out_.put(fmt::format("\npointelements\n{}\n{}", count, rows));
    rows.clear();
    count = 0;
    Label next = 0;
    for (const PeriodicLink& link : mesh_.data()->periodic) {
      const Label number = is_ours_ ? link.tag : ++next;
      for (const auto& pair : link.points) {
        rows += fmt::format("{} {} {}\n", pair[0] + 1, pair[1] + 1, number);
        ++count;
      }
    }
    if (count > 0) out_.put(fmt::format("\nidentifications\n{}\n{}", count, rows));
  }

  void write_names() {
    const LabelNames names(*mesh_.data());
    constexpr std::array<std::pair<std::string_view, int>, 3> kSections = {
        {{"materials", 3}, {"bcnames", 2}, {"cd2names", 1}}};
    for (const auto& [section, dimension] : kSections) {
      put_names(section, names.named(dimension));
    }
    std::map<Label, const Group*> of_points;
    for (const Group& group : mesh_.data()->groups) {
      if (group.dimension == 0 && !group.name.empty()) of_points[group.number] = &group;
    }
    put_names("cd3names", of_points);
  }

  /// A name is one word.
  void put_names(std::string_view section, const std::map<Label, const Group*>& names) {
    Label last = 0;
    for (const auto& [label, group] : names) last = label <= kGreatestNamed ? label : last;
    if (last < 1) return;
    out_.put(fmt::format("\n{}\n{}\n", section, last));
    UniqueNames taken;
    for (const auto& [label, group] : names) taken.take(group->name);
    for (Label label = 1; label <= last; ++label) {
      const auto found = names.find(label);
      const std::string name = found == names.end() ? "default" : found->second->name;
      out_.put(fmt::format("{} {}\n", label, as_word(name, taken)));
    }
  }

  /// Netgen may have a name twice; one that has to be changed is not to become another.
  static std::string as_word(const std::string& name, UniqueNames& taken) {
    std::string word = name;
    for (char& c : word) {
      if (c == '#' || static_cast<unsigned char>(c) <= ' ') c = '_';
    }
    return word == name ? word : taken.make(word);
  }

  OutputFile out_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::vector<const ElementList*> surfaces_;
  bool is_ours_;
  std::vector<std::vector<SurfaceRow>> rows_;  // as surfaces_
  std::map<SurfaceRow, Label> faces_;          // as Netgen counts them
};

}  // namespace

void write_netgen(const std::filesystem::path& file, const MeshView& mesh) {
  NetgenWriter(file, mesh).write();
}

}  // namespace tetmend::formats
