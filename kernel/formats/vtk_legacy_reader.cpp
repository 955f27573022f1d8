// SPDX-License-Identifier: MIT
// Reads legacy VTK files with an unstructured grid.
//
//   # vtk DataFile Version 3.0 | title | ASCII or BINARY | DATASET UNSTRUCTURED_GRID
//   POINTS n type            3 n numbers
//   CELLS n size             n times: k, then k point numbers           (before version 5)
//   CELLS n+1 size           OFFSETS type ... CONNECTIVITY type ...     (since version 5)
//   CELL_TYPES n             n integers
//   CELL_DATA n, POINT_DATA n, each followed by arrays of several kinds
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/vtk_array.h"
#include "kernel/formats/vtk_cells.h"
#include "kernel/formats/vtk_legacy.h"
#include "kernel/formats/vtk_roles.h"

namespace tetmend::formats {
namespace {

std::string lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

class VtkLegacyReader {
 public:
  VtkLegacyReader(const InputFile& file, const ReadRequest& request)
      : text_(file, TextReader::kNoComments), request_(request) {}

  MeshData read() {
    read_header();
    for (;;) {
      const std::string_view word = text_.word();
      if (word.empty()) break;
      read_section(lower_case(word.substr(0, 30)), word);
    }
    const char* end = text_.position();
    if (!has_points_) fail_without("POINTS", end);
    if (!has_cells_) fail_without("CELLS", end);
    if (!has_types_) fail_without("CELL_TYPES", end);
    const CellNumbers numbers = cells_.append_to(mesh_, text_, request_.question);
    adopt_cell_arrays(mesh_, take_arrays(cell_arrays_), numbers,
                      {request_.label_array, failure_in(cell_arrays_)});
    adopt_point_arrays(mesh_, take_arrays(point_arrays_), failure_in(point_arrays_));
    return std::move(mesh_);
  }

 private:
  enum class DataOf { nothing, cells, points };
  struct Array {
    DataArray data;
    const VtkType* type;
    const char* begin;
  };

  static std::vector<DataArray> take_arrays(std::vector<Array>& arrays) {
    std::vector<DataArray> taken;
    for (Array& array : arrays) taken.push_back(std::move(array.data));
    return taken;
  }

  ArrayFailure failure_in(const std::vector<Array>& arrays) {
    return [this, &arrays](std::size_t which, std::size_t i, std::string_view reason) {
      const Array& array = arrays[which];
      text_.fail_at(locate_vtk_value(text_, binary_, *array.type, array.begin, i), reason);
    };
  }

  void read_header() {
    constexpr std::string_view kOpening = "# vtk datafile version ";
    const char* begin = text_.position();
    const std::string first = lower_case(text_.skip_line().substr(0, 60));
    if (first.empty() && text_.bytes_left() == 0) {
      text_.fail_at(begin, "the file is empty: expected '# vtk DataFile Version'");
    }
    if (!first.starts_with(kOpening) || first.size() < kOpening.size() + 3) {
      text_.fail_at(
          begin,
          fmt::format("{} is not the beginning of a legacy VTK file: expected '# vtk DataFile "
                      "Version'",
                      in_quotes(first)));
    }
    major_version_ = first[kOpening.size()] - '0';
    if (major_version_ < 1 || major_version_ > 5 || first[kOpening.size() + 1] != '.') {
      text_.fail_at(begin, fmt::format("the version in {} is unknown: expected 1.0 to 5.1",
                                       in_quotes(first)));
    }
    text_.skip_line();  // the title
    const std::string_view word = text_.expect_word("ASCII or BINARY");
    const std::string coding = lower_case(word.substr(0, 10));
    if (coding != "ascii" && coding != "binary") {
      text_.fail(fmt::format("{} is not expected here: expected ASCII or BINARY", in_quotes(word)));
    }
    binary_ = coding == "binary";
    mesh_.variant = binary_ ? kVtkBinary : kVtkAscii;
    if (binary_) text_.locate_errors_by_byte();
  }

  void read_section(const std::string& name, std::string_view word) {
    if (name == "dataset") {
      read_dataset();
    } else if (name == "field") {
      read_field();
    } else if (name == "metadata") {
      skip_metadata();
    } else if (name == "points") {
      read_points();
    } else if (name == "cells") {
      read_cells();
    } else if (name == "cell_types") {
      read_types();
    } else if (name == "cell_data") {
      data_of_ = DataOf::cells;
      read_data_count(has_cells_, cells_.count, "cells");
    } else if (name == "point_data") {
      data_of_ = DataOf::points;
      read_data_count(has_points_, mesh_.points.size(), "points");
    } else if (data_of_ == DataOf::nothing || !read_attribute(name)) {
      text_.fail(fmt::format(
          "{} is not expected here: expected a keyword of the VTK format such as POINTS, "
          "CELLS, CELL_TYPES or CELL_DATA",
          in_quotes(word)));
    }
  }

  void read_dataset() {
    const std::string_view kind = text_.expect_word("UNSTRUCTURED_GRID");
    if (lower_case(kind.substr(0, 30)) != "unstructured_grid") {
      text_.fail(fmt::format("the data set {} cannot be read: expected UNSTRUCTURED_GRID",
                             in_quotes(kind)));
    }
  }

  std::size_t read_count(std::string_view what) {
    return static_cast<std::size_t>(
        text_.integer(fmt::format("the number of {}", what), 0, INT64_MAX));
  }

  const VtkType& read_type() { return find_vtk_type(text_, text_.expect_word("a data type")); }

  /// Binary values begin behind the line break.
  void begin_values() {
    if (binary_) text_.skip_line();
  }

  void refuse_second(bool seen, std::string_view name) {
    if (seen) text_.fail(fmt::format("'{}' appears for the second time", name));
  }

  void read_points() {
    refuse_second(has_points_, "POINTS");
    has_points_ = true;
    const std::size_t count = read_count("points");
    if (count > kMostVertices) text_.fail(fmt::format("{} vertices are too many", count));
    const VtkType& type = read_type();
    if (type.kind == VtkType::Kind::bit || type.kind == VtkType::Kind::text) {
      text_.fail(fmt::format("points cannot be of type '{}': expected float or double", type.name));
    }
    begin_values();
    checked_vtk_count(text_, binary_, type, count, 3);
    mesh_.points.resize(count);
    if (!binary_) {
      for (Point& point : mesh_.points) {
        for (int axis = 0; axis < 3; ++axis) point[axis] = text_.real("a coordinate");
      }
      return;
    }
    const char* at = text_.bytes(3 * count * type.size, "the points");
    for (Point& point : mesh_.points) {
      for (int axis = 0; axis < 3; ++axis, at += type.size) {
        const double value = load_vtk_real(type, at);
        if (!std::isfinite(value)) {
          text_.fail_at(at, fmt::format("{} is not a finite number: expected a coordinate", value));
        }
        point[axis] = value;
      }
    }
  }

  void read_cells() {
    refuse_second(has_cells_, "CELLS");
    has_cells_ = true;
    const std::size_t count = read_count("cells");
    const std::size_t size = read_count("integers of the cells");
    const VtkType& int_type = find_vtk_type(text_, "int");
    if (major_version_ < 5) {
      begin_values();
      cells_.count = count;
      cells_.connectivity =
          VtkIntegers(text_, binary_, int_type, size, "a vertex number of a cell");
      return;
    }
    cells_.has_offsets = true;
    expect_keyword("OFFSETS");
    const VtkType& offset_type = read_type();
    begin_values();
    cells_.offsets = VtkIntegers(text_, binary_, offset_type, count, "an offset of a cell");
    cells_.count = count == 0 ? 0 : count - 1;
    expect_keyword("CONNECTIVITY");
    const VtkType& connectivity_type = read_type();
    begin_values();
    cells_.connectivity =
        VtkIntegers(text_, binary_, connectivity_type, size, "a vertex number of a cell");
  }

  void expect_keyword(std::string_view name) {
    const std::string_view word = text_.expect_word(name);
    if (lower_case(word.substr(0, 30)) != lower_case(name)) {
      text_.fail(fmt::format("{} is not expected here: expected {}", in_quotes(word), name));
    }
  }

  void read_types() {
    refuse_second(has_types_, "CELL_TYPES");
    has_types_ = true;
    const std::size_t count = read_count("cell types");
    const VtkType& int_type = find_vtk_type(text_, "int");
    begin_values();
    cells_.types = VtkIntegers(text_, binary_, int_type, count, "a cell type");
  }

  void read_data_count(bool known, std::size_t expected, std::string_view what) {
    data_count_ = read_count(what);
    if (!known || data_count_ != expected) {
      text_.fail(
          fmt::format("data of {} {} do not belong to this mesh: expected {}", data_count_, what,
                      known ? std::to_string(expected) : fmt::format("the {} before", what)));
    }
  }

  /// An array of CELL_DATA or POINT_DATA; false if `name` is not the keyword of one.
  bool read_attribute(const std::string& name) {
    if (name == "scalars") {
      read_scalars();
    } else if (name == "vectors") {
      read_attribute_of(3);
    } else if (name == "normals") {
      keep_role("Normals", read_attribute_of(3));
    } else if (name == "tensors") {
      read_attribute_of(9);
    } else if (name == "tensors6") {
      read_attribute_of(6);
    } else if (name == "global_ids") {
      keep_role("GlobalIds", read_attribute_of(1));
    } else if (name == "pedigree_ids") {
      keep_role("PedigreeIds", read_attribute_of(1));
    } else if (name == "edge_flags") {
      const std::string_view array = text_.expect_word("the name of an array");
      skip_values(array, read_type(), data_count_, 1);
    } else if (name == "texture_coordinates") {
      const std::string_view array = text_.expect_word("the name of an array");
      const std::size_t columns = read_count("columns");
      const VtkType& type = read_type();
      begin_values();
      read_array(array, type, data_count_, columns);
    } else if (name == "color_scalars") {
      const std::string_view array = text_.expect_word("the name of an array");
      const std::size_t columns = read_count("columns");
      skip_values(array, find_vtk_type(text_, "unsigned_char"), data_count_, columns);
    } else if (name == "lookup_table") {
      const std::string_view table = text_.expect_word("the name of a table");
      skip_values(table, find_vtk_type(text_, "unsigned_char"), read_count("colors"), 4);
    } else {
      return false;
    }
    return true;
  }

  std::string_view read_attribute_of(std::size_t columns) {
    const std::string_view name = text_.expect_word("the name of an array");
    const VtkType& type = read_type();
    begin_values();
    read_array(name, type, data_count_, columns);
    return name;
  }
  void keep_role(std::string_view role, std::string_view array) {
    formats::keep_role(mesh_, {data_of_ == DataOf::points, std::string(role), decoded(array)});
  }

  void skip_values(std::string_view name, const VtkType& type, std::size_t rows,
                   std::size_t columns) {
    begin_values();
    skip_vtk_values(text_, binary_, type, checked_vtk_count(text_, binary_, type, rows, columns));
    mesh_.notes.push_back(fmt::format("the array {} is not kept", in_quotes(name)));
  }

  void read_scalars() {
    const std::string_view name = text_.expect_word("the name of an array");
    const VtkType& type = read_type();
    std::size_t columns = 1;
    if (!text_.at_line_end()) columns = read_count("components");
    text_.skip_line();
    const char* before = text_.position();
    if (lower_case(text_.word().substr(0, 30)) == "lookup_table") {
      text_.skip_line();
    } else {
      text_.seek(before);  // VTK asks for the table, some writers leave it out
    }
    read_array(name, type, data_count_, columns);
  }

  void read_field() {
    text_.expect_word("the name of a field");
    const std::size_t arrays = text_.count("arrays", 4);
    for (std::size_t i = 0; i < arrays; ++i) {
      std::string_view name = text_.expect_word("the name of an array");
      while (name == "METADATA") {
        skip_metadata();
        name = text_.expect_word("the name of an array");
      }
      const std::size_t columns = read_count("components");
      const std::size_t rows = read_count("tuples");
      const VtkType& type = read_type();
      begin_values();
      read_array(name, type, rows, columns);
    }
  }

  // The block ends with an empty line.
  void skip_metadata() {
    text_.skip_line();
    while (text_.bytes_left() > 0) {
      const std::string_view line = text_.skip_line();
      if (line.empty() || line == "\r") return;
    }
  }

  /// Keeps the array if it has a row of numbers for each cell or point.
  void read_array(std::string_view name, const VtkType& type, std::size_t rows,
                  std::size_t columns) {
    const std::size_t count = checked_vtk_count(text_, binary_, type, rows, columns);
    const bool is_number = type.kind != VtkType::Kind::text && type.kind != VtkType::Kind::bit;
    if (data_of_ == DataOf::nothing || columns == 0 || rows != data_count_ || !is_number) {
      skip_vtk_values(text_, binary_, type, count);
      mesh_.notes.push_back(fmt::format("the array {} is not kept: {}", in_quotes(name),
                                        !is_number ? "it holds no numbers"
                                        : data_of_ == DataOf::nothing
                                            ? "it belongs to no points or cells"
                                            : "it has no row for each point or cell"));
      return;
    }
    auto& arrays = data_of_ == DataOf::points ? point_arrays_ : cell_arrays_;
    const char* begin = text_.position();
    DataArray data{decoded(name), columns, read_vtk_values(text_, binary_, type, count)};
    arrays.push_back({std::move(data), &type, begin});
  }

  /// VTK writes "%20" for a blank in a name, and so on.
  static std::string decoded(std::string_view name) {
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
      unsigned code = 0;
      if (name[i] == '%' && i + 2 < name.size() &&
          std::from_chars(&name[i + 1], &name[i + 1] + 2, code, 16).ptr == &name[i + 1] + 2) {
        text += static_cast<char>(code);
        i += 2;
      } else {
        text += name[i];
      }
    }
    return text;
  }

  [[noreturn]] void fail_without(std::string_view name, const char* end) const {
    text_.fail_at(end, fmt::format("the section {} is missing", name));
  }

  TextReader text_;
  const ReadRequest& request_;
  MeshData mesh_;
  int major_version_ = 0;
  bool binary_ = false;
  bool has_points_ = false;
  bool has_cells_ = false;
  bool has_types_ = false;
  VtkCells cells_;
  DataOf data_of_ = DataOf::nothing;
  std::size_t data_count_ = 0;
  std::vector<Array> cell_arrays_;
  std::vector<Array> point_arrays_;
};

}  // namespace

MeshData read_vtk_legacy(const std::filesystem::path& file, const ReadRequest& request) {
  const InputFile input(file);
  return VtkLegacyReader(input, request).read();
}

}  // namespace tetmend::formats
