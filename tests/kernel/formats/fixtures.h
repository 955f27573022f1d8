// SPDX-License-Identifier: MIT
// What the tests of file formats share: a folder of their own, a small mesh with awkward numbers,
// and errors as text.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <unistd.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/mesh_data.h"

namespace tetmend::test {

/// Arrays of a file.
using Integers = std::vector<std::int32_t>;
using Reals = std::vector<double>;

/// What is told of a mesh, but for its tets of both orders.
inline std::vector<std::string> notes_but_of_orders(const MeshData& mesh) {
  std::vector<std::string> notes = mesh.notes;
  std::erase_if(notes, [](const std::string& note) {
    return note.find(" are of second order: ") != std::string::npos;
  });
  return notes;
}

/// A new folder that vanishes at the end of the test; tests may run at the same time.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tetmend-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  std::size_t entries() const {
    const std::filesystem::directory_iterator all(path_);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

 private:
  std::filesystem::path path_;
};

inline void write_text(const std::filesystem::path& file, std::string_view text) {
  std::ofstream(file, std::ios::binary)
      .write(text.data(), static_cast<std::streamsize>(text.size()));
}

inline std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The mesh of a file of this name and content.
inline MeshData read_as(const TempFolder& folder, std::string_view name, std::string_view content) {
  write_text(folder / name, content);
  return read_mesh(folder / name);
}

/// As above, in a folder that is gone afterwards.
inline MeshData read_as(std::string_view name, std::string_view content) {
  return read_as(TempFolder(), name, content);
}

/// The first group of this name, of any dimension; null if there is none.
inline const Group* find_group(const MeshData& mesh, std::string_view name) {
  const auto found = std::find_if(mesh.groups.begin(), mesh.groups.end(),
                                  [&](const Group& group) { return group.name == name; });
  return found == mesh.groups.end() ? nullptr : &*found;
}

/// How text files of MEDIT begin.
inline const std::string kMeditHead = "MeshVersionFormatted 2\nDimension 3\n";

/// What the error says without the folder of the file; "no error" if there is none.
inline std::string error_of_reading(const std::filesystem::path& file) {
  try {
    read_mesh(file);
  } catch (const Error& error) {
    std::string text = error.what();
    const std::string folder = file.parent_path().string() + "/";
    return text.starts_with(folder) ? text.substr(folder.size()) : text;
  }
  return "no error";
}

/// A file that must be refused: the beginning of the message, and a part of the rest.
struct BadFile {
  std::string what;
  std::string content;
  std::string place;
  std::string reason;
};

/// Two tets on five vertices, with labels at the ends of their range and coordinates that are hard
/// to print.
inline MeshData awkward_mesh() {
  constexpr Label kLow = std::numeric_limits<Label>::min();
  constexpr Label kHigh = std::numeric_limits<Label>::max();
  MeshData mesh;
  mesh.points = {{0.1, 1.0 / 3.0, -0.0},
                 {5e-324, std::numeric_limits<double>::max(), 1},
                 {-1.2345678901234567e-300, 2e22, 123456789012345680.0},
                 {std::nextafter(1.0, 2.0), -4e-7, 1e23},
                 {0, 0, -1e100}};
  mesh.point_labels = {0, 7, kLow, kHigh, -1};
  mesh.tets = {{{0, 1, 2, 3}, kHigh}, {{4, 2, 1, 0}, kLow}};
  mesh.triangles = {{{0, 2, 1}, 12}, {{3, 0, 1}, kLow}, {{4, 3, 2}, 0}};
  mesh.edges = {{{0, 4}, 3}, {{2, 1}, kHigh}};
  mesh.required_vertices = {4, 0};
  return mesh;
}

/// Bit for bit: -0.0 is not 0.0.
inline bool same_points(const MeshData& a, const MeshData& b) {
  if (a.points.size() != b.points.size()) return false;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::bit_cast<std::uint64_t>(a.points[i][axis]) !=
          std::bit_cast<std::uint64_t>(b.points[i][axis])) {
        return false;
      }
    }
  }
  return true;
}

inline bool same_mesh(const MeshData& a, const MeshData& b) {
  return same_points(a, b) && a.point_labels == b.point_labels && a.tets == b.tets &&
         a.triangles == b.triangles && a.edges == b.edges &&
         a.required_vertices == b.required_vertices;
}

/// Arrays of data have one row for each of what they belong to.
inline bool data_fit(const std::vector<DataArray>& arrays, std::size_t count) {
  for (const DataArray& array : arrays) {
    if (array.components == 0 || array.size() != array.components * count) return false;
  }
  return true;
}

/// Groups, entities, links and other elements name what is there, and nothing twice.
inline bool extras_are_sound(const MeshData& mesh) {
  const std::size_t points = mesh.points.size();
  const std::array<std::size_t, 4> counts = {points, mesh.edges.size(), mesh.triangles.size(),
                                             mesh.tets.size()};
  bool sound = mesh.point_entities.empty() || mesh.point_entities.size() == points;
  sound = sound && data_fit(mesh.point_data, points) && data_fit(mesh.tet_data, counts[3]) &&
          data_fit(mesh.triangle_data, counts[2]) && data_fit(mesh.edge_data, counts[1]);
  const auto one_for_each = [&](const std::vector<Label>& parts, std::size_t count) {
    sound = sound && (parts.empty() || parts.size() == count);
  };
  one_for_each(mesh.tet_parts, counts[3]);
  one_for_each(mesh.triangle_parts, counts[2]);
  one_for_each(mesh.edge_parts, counts[1]);
  std::set<std::tuple<int, Label, std::string>> groups;  // 0 is no number: told apart by names
  std::set<std::pair<int, Label>> entities;
  for (const Group& group : mesh.groups) {
    if (group.dimension < 0 || group.dimension > 3) return false;
    sound =
        sound &&
        groups.insert({group.dimension, group.number, group.number == 0 ? group.name : ""}).second;
    for (const auto member : group.members) {
      sound = sound && member < counts[static_cast<std::size_t>(group.dimension)];
    }
  }
  for (const GeometricEntity& entity : mesh.entities) {
    sound = sound && entity.dimension >= 0 && entity.dimension < 4 &&
            entities.insert({entity.dimension, entity.tag}).second;
  }
  for (const PeriodicLink& link : mesh.periodic) {
    sound = sound && (link.affine.empty() || link.affine.size() == 16);
    for (const auto& pair : link.points) sound = sound && pair[0] < points && pair[1] < points;
  }
  for (const OtherElements& others : mesh.other_elements) {
    sound = sound && others.vertices.size() == others.labels.size() * others.vertex_count;
    one_for_each(others.parts, others.labels.size());
    for (const auto vertex : others.vertices) sound = sound && vertex < points;
  }
  return sound;
}

/// Everything that `read_mesh` promises for every file it accepts.
inline bool is_sound(const MeshData& mesh) {
  bool sound = mesh.point_labels.empty() || mesh.point_labels.size() == mesh.points.size();
  for (const Point& point : mesh.points) sound = sound && point.allFinite();
  const auto check = [&](const auto& elements) {
    for (const auto& element : elements) {
      for (std::size_t i = 0; i < element.vertices.size(); ++i) {
        sound = sound && element.vertices[i] < mesh.points.size();
        for (std::size_t j = 0; j < i; ++j) {
          sound = sound && element.vertices[i] != element.vertices[j];
        }
      }
    }
  };
  check(mesh.tets);
  check(mesh.triangles);
  check(mesh.edges);
  for (const auto vertex : mesh.required_vertices) sound = sound && vertex < mesh.points.size();
  return sound && extras_are_sound(mesh);
}

/// Numbers one behind the other, in either byte order.
class Bytes {
 public:
  explicit Bytes(std::endian order = std::endian::little) : order_(order) {}
  template <class T>
  Bytes& add(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (order_ != std::endian::native) bytes.assign(bytes.rbegin(), bytes.rend());
    text_ += bytes;
    return *this;
  }
  template <class T>
  Bytes& add_all(const std::vector<T>& values) {
    for (const T value : values) add(value);
    return *this;
  }
  Bytes& text(std::string_view text) {
    text_ += text;
    return *this;
  }
  std::size_t size() const { return text_.size(); }
  const std::string& str() const { return text_; }

 private:
  std::endian order_;
  std::string text_;
};

}  // namespace tetmend::test
