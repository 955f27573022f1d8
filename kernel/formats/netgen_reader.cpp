// SPDX-License-Identifier: MIT
// Reads Netgen's `.vol`. Sections come in any order; elements mostly before the points.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/netgen.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {
namespace {

/// The number of points as the file says, not checked.
std::int64_t find_point_count(const InputFile& file) {
  const std::string_view text(file.begin(), file.size());
  constexpr std::string_view kSection = "\npoints";
  std::size_t at = text.find(kSection);
  while (at != std::string_view::npos) {
    at += kSection.size();
    const std::size_t digits = text.find_first_not_of(" \t\r\n", at);
    if (digits == std::string_view::npos) return 0;
    std::int64_t count = 0;
    if (digits > at) {
      std::from_chars(text.data() + digits, text.data() + text.size(), count);
      return count;
    }
    at = text.find(kSection, at);
  }
  return 0;
}

/// What comes with surface elements of one kind.
struct SurfaceArrays {
  std::vector<std::int32_t> surface, inside, outside, triangle_numbers;
  std::vector<double> parameters;

  void move_into(std::vector<DataArray>& data, std::size_t width) {
    const auto add = [&](std::string_view name, std::size_t components, auto& values) {
      if (!values.empty()) data.push_back({std::string(name), components, std::move(values)});
    };
    add(kNetgenSurface, 1, surface);
    add(kNetgenInside, 1, inside);
    add(kNetgenOutside, 1, outside);
    add(kNetgenTriangleNumbers, width, triangle_numbers);
    add(kNetgenParameters, 2 * width, parameters);
  }
};

using Segment = std::array<double, kNetgenSegment>;

class NetgenReader {
 public:
  NetgenReader(const InputFile& file, TetPlace* question)
      : text_(file, '#'),
        question_(question),
        last_point_(std::min<std::int64_t>(find_point_count(file), kMostVertices)),
        sorter_(mesh_) {}

  MeshData read() {
    if (text_.at_end()) text_.fail("the file is empty: expected mesh3d");
    const std::string_view first = text_.word();
    if (first != "mesh3d") {
      text_.fail(fmt::format("{} is not the beginning of a mesh of Netgen: expected mesh3d",
                             in_quotes(first)));
    }
    while (read_section()) {
    }
    if (!seen_.contains("points")) text_.fail("the section points is missing");
    finish_edges();
    move_arrays();
    // What the writer says by itself.
    std::erase_if(mesh_.deck, [](const std::string& piece) {
      return piece == "geomtype\n0\n" || piece == "endmesh\n";
    });
    mesh_.variant = kNetgen;
    return std::move(mesh_);
  }

 private:
  /// False at the end of the mesh.
  bool read_section() {
    const std::string_view name = text_.expect_word("the name of a section or endmesh");
    if (std::isalpha(static_cast<unsigned char>(name[0])) == 0) {
      text_.fail(
          fmt::format("{} is not expected here: expected the name of a section", in_quotes(name)));
    }
    if (!seen_.insert(name).second) {
      text_.fail(fmt::format("{} appears for the second time", in_quotes(name)));
    }
    const char* begin = text_.last_word();
    if (name == "endmesh") {
      mesh_.deck.emplace_back(begin, begin + name.size() + text_.bytes_left());
      return false;
    }
    if (!read_elements(name) && !read_names(name)) read_other(name, begin);
    return true;
  }

  bool read_elements(std::string_view name) {
    if (name == "dimension") {
      if (text_.integer("the dimension", 1, 3) != 3) {
        text_.fail("the mesh is not three-dimensional: expected dimension 3");
      }
    } else if (name.starts_with("surfaceelements")) {
      read_surfaces(name);
    } else if (name == "volumeelements") {
      read_volumes();
    } else if (name == "points") {
      read_points();
    } else if (name.starts_with("edgesegments")) {
      read_segments(name);
    } else if (name == "pointelements") {
      read_point_elements();
    } else if (name == "identifications") {
      read_identifications();
    } else {
      return false;
    }
    return true;
  }

  bool read_names(std::string_view section) {
    constexpr std::array<std::string_view, 4> kSections = {"cd3names", "cd2names", "bcnames",
                                                           "materials"};
    const auto* found = std::find(kSections.begin(), kSections.end(), section);
    if (found == kSections.end()) return false;
    const int dimension = static_cast<int>(found - kSections.begin());
    const std::size_t count = text_.count("names", std::string_view("1\n").size());
    std::set<Label> numbers;
    for (std::size_t i = 0; i < count; ++i) {
      const Label number = text_.label("the number of a name");
      if (!numbers.insert(number).second) {
        text_.fail(fmt::format("the number {} appears for the second time", number));
      }
      const std::string_view name = text_.word_on_line();
      const std::string_view more = text_.word_on_line();
      if (!more.empty()) {
        text_.fail(fmt::format("{} is too much: expected one word for a name", in_quotes(more)));
      }
      // "default" is Netgen's word for no name.
      if (!name.empty() && name != "default") this->name(dimension, number) = name;
    }
    return true;
  }

  std::string& name(int dimension, Label number) { return group(dimension, number).name; }

  Group& group(int dimension, Label number) {
    const auto [at, is_new] = groups_.try_emplace({dimension, number}, mesh_.groups.size());
    if (is_new) mesh_.groups.push_back({dimension, number, {}, {}, {}});
    return mesh_.groups[at->second];
  }

  /// Sections that name no points stay as they are.
  void read_other(std::string_view name, const char* begin) {
    constexpr std::array<std::string_view, 4> kVerbatim = {
        "geomtype", "face_colours", "face_transparencies", "identificationtypes"};
    text_.skip_line();
    for (;;) {
      const char* line = text_.position();
      const std::string_view word = text_.word();
      if (word.empty()) break;
      if (std::isalpha(static_cast<unsigned char>(word[0])) != 0) {
        text_.seek(line);
        break;
      }
      text_.skip_line();
    }
    const std::string_view content(begin, static_cast<std::size_t>(text_.position() - begin));
    if (std::find(kVerbatim.begin(), kVerbatim.end(), name) != kVerbatim.end()) {
      mesh_.deck.emplace_back(content.substr(0, content.find_last_not_of(" \t\r\n") + 1));
      mesh_.deck.back() += '\n';
    } else {
      mesh_.notes.push_back(fmt::format("the section {} is not kept", in_quotes(name)));
    }
  }

  void read_vertices(TextReader& text, ElementRow& row, const std::uint8_t* order) const {
    std::array<std::uint32_t, kMostVerticesOfElement> listed{};
    for (std::size_t k = 0; k < row.kind->width; ++k) {
      listed[k] = static_cast<std::uint32_t>(text.integer("a point number", 1, last_point_) - 1);
    }
    for (std::size_t k = 0; k < row.kind->width; ++k) {
      row.vertices[k] = listed[order == nullptr ? k : order[k]];
    }
  }

  void read_volumes() {
    const auto read = [this](TextReader& text, ElementRow& row) {
      row.label = text.label("the number of a material");
      row.place = text.last_word();
      const std::int64_t points = text.integer("the number of points of an element", 0, INT32_MAX);
      constexpr std::array<std::pair<std::int64_t, int>, 5> kTypes = {
          {{4, vtk_tet}, {10, vtk_tet10}, {5, vtk_pyramid}, {6, vtk_prism}, {8, vtk_hexahedron}}};
      const auto* type = std::find_if(kTypes.begin(), kTypes.end(),
                                      [&](const auto& entry) { return entry.first == points; });
      if (type == kTypes.end()) {
        text.fail(
            fmt::format("volume elements with {} points cannot be read: expected 4, 5, 6, 8 "
                        "or 10",
                        points));
      }
      row.kind = element_kind(type->second);
      const bool is_tet = points == 4 || points == 10;
      read_vertices(text, row, is_tet ? kNetgenTet.data() : nullptr);
    };
    const std::size_t count = text_.count("elements", std::string_view("1 4 1 2 3 4\n").size());
    read_element_rows(text_, count, read, [this](const ElementRow& row) {
      sorter_.add(row);
      answer(question_, mesh_, text_, row);
    });
  }

  void read_surfaces(std::string_view section) {
    const bool has_numbers = section == "surfaceelementsgi";
    const bool has_parameters = section == "surfaceelementsuv";
    const std::size_t count = text_.count("elements", std::string_view("1 1 1 0 3 1 2 3\n").size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto surface = text_.label("the number of a surface");
      ElementRow row;
      row.place = text_.last_word();
      row.label = text_.label("the number of a boundary condition");
      const auto inside = text_.label("the number of a domain");
      const auto outside = text_.label("the number of a domain");
      const std::int64_t points = text_.integer("the number of points of an element", 0, INT32_MAX);
      if (points != 3 && points != 4 && points != 6) {
        text_.fail(fmt::format("surface elements with {} points cannot be read: expected 3, 4 or 6",
                               points));
      }
      const std::size_t place = points == 3 ? 0 : points == 4 ? 1 : 2;
      row.kind = element_kind(place == 0 ? vtk_triangle : place == 1 ? vtk_quad : vtk_triangle6);
      read_vertices(text_, row, place == 2 ? kNetgenTriangle6.data() : nullptr);
      sorter_.add(row);
      answer(question_, mesh_, text_, row);
      SurfaceArrays& arrays = arrays_[place];
      arrays.surface.push_back(surface);
      arrays.inside.push_back(inside);
      arrays.outside.push_back(outside);
      for (std::int64_t k = 0; k < points && has_numbers; ++k) {
        arrays.triangle_numbers.push_back(text_.label("the number of a triangle"));
      }
      for (std::int64_t k = 0; k < 2 * points && has_parameters; ++k) {
        arrays.parameters.push_back(text_.real("a parameter"));
      }
    }
  }

  void move_arrays() {
    arrays_[0].move_into(mesh_.triangle_data, 3);
    for (OtherElements& others : mesh_.other_elements) {
      if (others.vtk_type == vtk_quad) arrays_[1].move_into(others.data, 4);
      if (others.vtk_type == vtk_triangle6) arrays_[2].move_into(others.data, 6);
    }
  }

  void read_points() {
    const std::size_t count = text_.count("points", std::string_view("0 0 0\n").size());
    if (count > kMostVertices) text_.fail(fmt::format("{} points are too many", count));
    mesh_.points.resize(count);
    read_rows(text_, count, [this](TextReader& text, std::size_t i) {
      for (int axis = 0; axis < 3; ++axis) mesh_.points[i][axis] = text.real("a coordinate");
    });
  }

  /// Each edge stands there once for each surface that meets it.
  void read_segments(std::string_view section) {
    const bool is_full = section == "edgesegmentsgi2";
    const std::size_t count = text_.count("edges", std::string_view("1 0 1 2\n").size());
    for (std::size_t i = 0; i < count; ++i) {
      Segment segment{};
      segment[0] = text_.label("the number of a surface");
      const char* const place = text_.last_word();
      text_.label("a number");
      std::array<std::uint32_t, 2> ends{};
      for (std::uint32_t& end : ends) {
        end = static_cast<std::uint32_t>(text_.integer("a point number", 1, last_point_) - 1);
      }
      for (std::size_t k = 2; k < segment.size() && is_full; ++k) {
        segment[k] = text_.real("a number of an edge");
      }
      if (!is_full) text_.skip_line();
      add_segment(ends, segment, place);
    }
    if (!is_full && count > 0) {
      mesh_.notes.push_back(
          fmt::format("of {} only the points and surfaces are kept", in_quotes(section)));
    }
  }

  void add_segment(std::array<std::uint32_t, 2> ends, Segment segment, const char* place) {
    const auto [low, high] = std::minmax(ends[0], ends[1]);
    const auto [at, is_new] = edge_of_.try_emplace({low, high}, mesh_.edges.size());
    if (is_new) {
      const double label = segment[6];
      if (!(label >= INT32_MIN && label <= INT32_MAX) || std::nearbyint(label) != label) {
        text_.fail(fmt::format("{} is not the number of an edge: expected an integer", label));
      }
      mesh_.edges.push_back({ends, static_cast<Label>(label)});
      if (is_asked_for(question_, mesh_.edges, mesh_.edges.back())) {
        question_->place = text_.place_of(place);
      }
      segments_.emplace_back();
    }
    segment[1] = mesh_.edges[at->second].vertices == ends ? 1 : -1;
    if (segments_[at->second].size() < kMostSegmentsOfEdge) {
      segments_[at->second].push_back(segment);
    } else {
      lost_segments_ += 1;
    }
  }

  void finish_edges() {
    std::size_t most = 0;
    for (const auto& of_edge : segments_) most = std::max(most, of_edge.size());
    std::vector<double> values;
    values.reserve(segments_.size() * most * kNetgenSegment);
    for (const auto& of_edge : segments_) {
      for (std::size_t k = 0; k < most; ++k) {
        const Segment segment = k < of_edge.size() ? of_edge[k] : Segment{};
        values.insert(values.end(), segment.begin(), segment.end());
      }
    }
    if (most > 0) {
      mesh_.edge_data.push_back(
          {std::string(kNetgenSegments), most * kNetgenSegment, std::move(values)});
    }
    if (lost_segments_ > 0) {
      mesh_.notes.push_back(fmt::format("{} segments of edges with more than {} are not kept",
                                        lost_segments_, kMostSegmentsOfEdge));
    }
  }

  void read_point_elements() {
    const std::size_t count = text_.count("points", std::string_view("1 1\n").size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto point =
          static_cast<std::uint32_t>(text_.integer("a point number", 1, last_point_) - 1);
      group(0, text_.label("the number of a point element")).members.push_back(point);
    }
  }

  void read_identifications() {
    const std::size_t count = text_.count("points", std::string_view("1 2 1\n").size());
    std::map<Label, std::size_t> links;
    for (std::size_t i = 0; i < count; ++i) {
      std::array<std::uint32_t, 2> pair{};
      for (std::uint32_t& point : pair) {
        point = static_cast<std::uint32_t>(text_.integer("a point number", 1, last_point_) - 1);
      }
      const Label number = text_.label("the number of an identification");
      const auto [at, is_new] = links.try_emplace(number, mesh_.periodic.size());
      if (is_new) mesh_.periodic.push_back({2, number, 0, {}, {}});
      mesh_.periodic[at->second].points.push_back(pair);
    }
  }

  TextReader text_;
  TetPlace* question_;
  std::int64_t last_point_;
  MeshData mesh_;
  ElementSorter sorter_;
  std::set<std::string_view> seen_;
  std::array<SurfaceArrays, 3> arrays_;  // of triangles, quadrilaterals, triangles of 6 points
  std::map<std::pair<int, Label>, std::size_t> groups_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edge_of_;
  std::vector<std::vector<Segment>> segments_;  // of each edge
  std::size_t lost_segments_ = 0;
};

}  // namespace

MeshData read_netgen(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return NetgenReader(input, question).read();
}

}  // namespace tetmend::formats
