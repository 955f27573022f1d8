// SPDX-License-Identifier: MIT
// Reads VTK's XML files with an unstructured grid.
//
//   <VTKFile type="UnstructuredGrid" byte_order header_type compressor>
//     <UnstructuredGrid> <Piece NumberOfPoints NumberOfCells>
//       <PointData> <CellData>  DataArrays of any name
//       <Points>                one DataArray of 3 components
//       <Cells>                 connectivity, offsets, types
//     <AppendedData encoding="raw" or "base64"> _...
//
// Raw appended data are no XML: the text is cut off before them.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "kernel/formats/base64.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/vtk_cells.h"
#include "kernel/formats/vtk_roles.h"
#include "kernel/formats/vtu.h"
#include "kernel/formats/vtu_blocks.h"
#include "kernel/formats/vtu_numbers.h"
#include "kernel/from_chars.h"

namespace tetmend::formats {
namespace {

class VtuReader {
 public:
  VtuReader(const InputFile& file, const ReadRequest& request)
      : file_(file),
        text_(file, TextReader::kNoComments),
        request_(request),
        cells_place_(file.begin()) {}

  MeshData read() {
    parse();
    const pugi::xml_node root = document_.child("VTKFile");
    read_head(root);
    const pugi::xml_node grid = child(root, "UnstructuredGrid");
    if (grid.child("FieldData")) mesh_.notes.emplace_back("the field data are not kept");
    if (!grid.child("Piece")) fail(grid, "no Piece is here: expected one");
    for (const pugi::xml_node piece : grid.children("Piece")) read_piece(piece);
    const CellNumbers numbers = take_cells().append_to(mesh_, text_, request_.question);
    const ArrayFailure fail_in_cells = failure_in(cell_arrays_.all);
    adopt_cell_arrays(mesh_, std::move(cell_arrays_.all), numbers,
                      {request_.label_array, fail_in_cells});
    const ArrayFailure fail_in_points = failure_in(point_arrays_.all);
    adopt_point_arrays(mesh_, std::move(point_arrays_.all), fail_in_points);
    return std::move(mesh_);
  }

 private:
  using Kind = VtuType::Kind;
  struct Arrays {
    std::vector<DataArray> all;
    using Key = std::pair<std::string, std::size_t>;      // name and components
    std::map<Key, std::vector<std::size_t>> places = {};  // of all that are alike, in their order
  };

  ArrayFailure failure_in(const std::vector<DataArray>& arrays) const {
    std::vector<std::string> names;
    for (const DataArray& array : arrays) names.push_back(array.name);
    return [this, names](std::size_t which, std::size_t i, std::string_view reason) {
      file_.fail_at_line(file_.begin(),
                         fmt::format("the array '{}', value {}: {}", names[which], i, reason));
    };
  }

  // ---- The XML ---------------------------------------------------------------------------------

  void parse() {
    const std::string_view all(file_.begin(), file_.size());
    if (all.empty()) file_.fail_at_line(all.data(), "the file is empty: expected VTKFile");
    const std::size_t tag = all.find("<AppendedData");
    refuse_many_nodes(all.substr(0, tag));
    std::string text;
    pugi::xml_parse_result result;
    if (tag == std::string_view::npos) {
      result = document_.load_buffer(file_.begin(), file_.size());
    } else {
      const std::size_t begin = all.find('_', std::min(all.find('>', tag), all.size()));
      if (begin == std::string_view::npos) {
        file_.fail_at_line(file_.begin() + tag, "the appended data are missing: expected '_'");
      }
      appended_ = all.substr(begin + 1);
      text.assign(all.substr(0, begin));
      text += "</AppendedData></VTKFile>";
      result = document_.load_buffer(text.data(), text.size());
    }
    const std::size_t first = all.find_first_not_of(" \t\r\n");
    if (!result && (first == std::string_view::npos || all[first] != '<')) {
      file_.fail_at_line(file_.begin(), "this is not the beginning of a VTK XML file: expected <");
    }
    if (!result) {
      const auto at = std::min<std::size_t>(static_cast<std::size_t>(result.offset), all.size());
      file_.fail_at_line(file_.begin() + at,
                         fmt::format("the XML is broken: {}", result.description()));
    }
  }

  /// A node takes more memory than a tag has characters.
  void refuse_many_nodes(std::string_view xml) const {
    constexpr std::size_t kNodeAndText = 128;
    const auto tags = static_cast<std::size_t>(std::count(xml.begin(), xml.end(), '<'));
    if (!is_bomb(file_.size_of_file(), kNodeAndText * tags)) return;
    file_.fail_at_line(
        file_.begin(),
        fmt::format("the gzip file has {} tags, more than a mesh of its size", tags));
  }

  const char* place_of(const pugi::xml_node& node) const {
    const std::ptrdiff_t offset = node.offset_debug();
    return file_.begin() +
           std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(file_.size()));
  }
  [[noreturn]] void fail(const pugi::xml_node& node, std::string_view reason) const {
    file_.fail_at_line(place_of(node), reason);
  }

  pugi::xml_node child(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node found = parent.child(name);
    if (!found) fail(parent, fmt::format("the element {} is missing", name));
    return found;
  }

  void read_head(const pugi::xml_node& root) {
    if (!root) file_.fail_at_line(file_.begin(), "expected the element VTKFile");
    const std::string_view type = root.attribute("type").as_string();
    if (type != "UnstructuredGrid") {
      fail(root,
           fmt::format("the type {} cannot be read: expected UnstructuredGrid", in_quotes(type)));
    }
    const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian") {
      fail(root, fmt::format("the byte order {} is unknown", in_quotes(order)));
    }
    swap_ = (order == "LittleEndian") != (std::endian::native == std::endian::little);
    const std::string_view header = root.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64") {
      fail(root, fmt::format("the header type {} is unknown: expected UInt32 or UInt64",
                             in_quotes(header)));
    }
    header_size_ = header == "UInt32" ? 4 : 8;
    const std::string_view compressor = root.attribute("compressor").as_string();
    const std::optional<VtuPacking> packing = vtu_packing(compressor);
    if (!packing) {
      fail(root, fmt::format("data packed by {} cannot be read: expected none, "
                             "vtkZLibDataCompressor, vtkLZ4DataCompressor or vtkLZMADataCompressor",
                             in_quotes(compressor)));
    }
    if (!can_unpack(*packing)) {
      fail(root, fmt::format("data packed by {} cannot be read: tetmend is built without liblzma",
                             in_quotes(compressor)));
    }
    packing_ = *packing;
    const pugi::xml_node appended = root.child("AppendedData");
    const std::string_view encoding = appended.attribute("encoding").as_string("base64");
    if (appended && encoding != "raw" && encoding != "base64") {
      fail(appended,
           fmt::format("the encoding {} is unknown: expected raw or base64", in_quotes(encoding)));
    }
    is_raw_ = encoding == "raw";
  }

  std::size_t count(const pugi::xml_node& node, const char* name) const {
    const std::string_view word = node.attribute(name).as_string();
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) {
      fail(node, fmt::format("{} is {}: expected a count", name, in_quotes(word)));
    }
    return value;
  }

  // ---- Pieces ----------------------------------------------------------------------------------

  void read_piece(const pugi::xml_node& piece) {
    const std::size_t points = count(piece, "NumberOfPoints");
    const std::size_t cells = count(piece, "NumberOfCells");
    const std::size_t first_point = mesh_.points.size();
    if (points > kMostVertices - first_point)
      fail(piece, fmt::format("{} vertices are too many", points));
    read_points(piece, points);
    read_cells(piece, cells, first_point);
    const bool is_first = first_point == 0 && types_.size() == cells;
    read_arrays(piece.child("PointData"), points, first_point, is_first, point_arrays_);
    read_arrays(piece.child("CellData"), cells, types_.size() - cells, is_first, cell_arrays_);
    if (is_first) read_roles(piece);
  }

  void read_points(const pugi::xml_node& piece, std::size_t points) {
    if (points == 0) return;
    const pugi::xml_node node = child(child(piece, "Points"), "DataArray");
    if (node.attribute("NumberOfComponents").as_uint(1) != 3) {
      fail(node, "points of other than 3 components: expected 3");
    }
    const bool is_text = std::string_view(node.attribute("format").as_string("ascii")) == "ascii";
    mesh_.variant = is_text ? kVtkAscii : kVtkBinary;
    const DataArray::Values values = read_values(node, points, 3);
    mesh_.points.reserve(mesh_.points.size() + points);
    std::visit(
        [&](const auto& numbers) {
          for (std::size_t i = 0; i < points; ++i) {
            const Point point(static_cast<double>(numbers[3 * i]),
                              static_cast<double>(numbers[3 * i + 1]),
                              static_cast<double>(numbers[3 * i + 2]));
            if (!point.allFinite()) {
              fail(node, fmt::format("point {} is not finite: expected three coordinates", i));
            }
            mesh_.points.push_back(point);
          }
        },
        values);
  }

  void read_cells(const pugi::xml_node& piece, std::size_t cells, std::size_t first_point) {
    if (cells == 0) return;
    const pugi::xml_node node = child(piece, "Cells");
    const std::vector<std::int64_t> offsets = integers(array(node, "offsets"), cells);
    const std::vector<std::int64_t> types = integers(array(node, "types"), cells);
    if (offsets.back() < 0) fail(array(node, "offsets"), "an offset is negative");
    std::vector<std::int64_t> connectivity =
        integers(array(node, "connectivity"), static_cast<std::size_t>(offsets.back()));
    for (std::int64_t& vertex : connectivity) {
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh_.points.size() - first_point) {
        fail(node, fmt::format("'{}' is out of range: expected a vertex number, 0 to {}", vertex,
                               static_cast<std::int64_t>(mesh_.points.size() - first_point) - 1));
      }
      vertex += static_cast<std::int64_t>(first_point);
    }
    const std::int64_t first = offsets_.back();
    for (const std::int64_t offset : offsets) offsets_.push_back(first + offset);
    connectivity_.insert(connectivity_.end(), connectivity.begin(), connectivity.end());
    types_.insert(types_.end(), types.begin(), types.end());
    cells_place_ = place_of(node);
  }

  VtkCells take_cells() {
    VtkCells cells;
    cells.count = types_.size();
    cells.has_offsets = true;
    cells.offsets = VtkIntegers(std::move(offsets_), cells_place_);
    cells.connectivity = VtkIntegers(std::move(connectivity_), cells_place_);
    cells.types = VtkIntegers(std::move(types_), cells_place_);
    return cells;
  }

  pugi::xml_node array(const pugi::xml_node& parent, std::string_view name) const {
    for (const pugi::xml_node node : parent.children("DataArray")) {
      if (node.attribute("Name").as_string() == name) return node;
    }
    fail(parent, fmt::format("the DataArray '{}' is missing", name));
  }

  std::vector<std::int64_t> integers(const pugi::xml_node& node, std::size_t size) const {
    const DataArray::Values values = read_values(node, size, 1);
    return std::visit(
        [&](const auto& numbers) {
          if constexpr (!std::is_integral_v<typename std::decay_t<decltype(numbers)>::value_type>) {
            fail(node, "the values are no integers: expected integers");
          }
          return std::vector<std::int64_t>(numbers.begin(), numbers.end());
        },
        values);
  }

  /// Several pieces have the same arrays.
  /// Of several alike in a piece each goes on one of those of the pieces before, in their order.
  void read_arrays(const pugi::xml_node& parent, std::size_t rows, std::size_t rows_before,
                   bool is_first, Arrays& arrays) {
    std::map<Arrays::Key, std::size_t> seen;
    for (const pugi::xml_node node : parent.children("DataArray")) {
      const std::string name = node.attribute("Name").as_string();
      if (find_type(node) == nullptr) {
        note(fmt::format("the array {} is not kept: it holds no numbers", in_quotes(name)));
        continue;
      }
      const std::size_t components =
          node.attribute("NumberOfComponents") ? count(node, "NumberOfComponents") : 1;
      if (components == 0) continue;
      DataArray made{name, components, read_values(node, rows, components)};
      if (has_wrapped(node, made)) {
        note(fmt::format("the array '{}' is not kept: it has numbers above {}", name, INT64_MAX));
        continue;
      }
      std::vector<std::size_t>& alike = arrays.places[{name, components}];
      const std::size_t which = seen[{name, components}]++;
      if (which < alike.size()) {
        append(arrays.all[alike[which]], made);
      } else if (is_first) {
        alike.push_back(arrays.all.size());
        arrays.all.push_back(std::move(made));
      } else {
        note(fmt::format("the array {} is not kept: not every piece has it", in_quotes(name)));
      }
    }
    for (const pugi::xml_node node : parent.children("Array")) {
      note(fmt::format("the array {} is not kept: it holds no numbers",
                       in_quotes(node.attribute("Name").as_string())));
    }
    drop_short(arrays, rows_before + rows);
  }

  void read_roles(const pugi::xml_node& piece) {
    for (const bool of_points : {true, false}) {
      const pugi::xml_node data = piece.child(of_points ? "PointData" : "CellData");
      for (const std::string_view role : vtk_roles()) {
        const std::string array = data.attribute(std::string(role).c_str()).as_string();
        if (!array.empty()) keep_role(mesh_, {of_points, std::string(role), array});
      }
    }
  }

  /// Drops arrays that a piece has not.
  void drop_short(Arrays& arrays, std::size_t rows) {
    const auto dropped = std::erase_if(arrays.all, [&](const DataArray& made) {
      if (made.size() == rows * made.components) return false;
      note(fmt::format("the array {} is not kept: not every piece has it", in_quotes(made.name)));
      return true;
    });
    if (dropped == 0) return;
    arrays.places.clear();
    for (std::size_t i = 0; i < arrays.all.size(); ++i) {
      arrays.places[{arrays.all[i].name, arrays.all[i].components}].push_back(i);
    }
  }

  static void append(DataArray& array, const DataArray& more) {
    std::visit(
        [&](auto& values) {
          using Value = typename std::decay_t<decltype(values)>::value_type;
          std::visit(
              [&](const auto& others) {
                for (const auto other : others) values.push_back(static_cast<Value>(other));
              },
              more.values);
        },
        array.values);
  }

  /// Integers are kept with a sign: greater ones would come out below 0.
  static bool has_wrapped(const pugi::xml_node& node, const DataArray& array) {
    if (std::string_view(node.attribute("type").as_string()) != "UInt64") return false;
    const auto* values = std::get_if<std::vector<std::int64_t>>(&array.values);
    return values != nullptr && std::any_of(values->begin(), values->end(),
                                            [](std::int64_t value) { return value < 0; });
  }

  void note(std::string text) { mesh_.notes.push_back(std::move(text)); }

  // ---- Values ----------------------------------------------------------------------------------

  static const VtuType* find_type(const pugi::xml_node& node) {
    return find_vtu_type(node.attribute("type").as_string());
  }

  DataArray::Values read_values(const pugi::xml_node& node, std::size_t rows,
                                std::size_t components) const {
    const VtuType* type = find_type(node);
    if (type == nullptr) {
      fail(node, fmt::format("the type {} cannot be read: expected Int8 to UInt64, Float32 or "
                             "Float64",
                             in_quotes(node.attribute("type").as_string())));
    }
    // A packed byte gives at most 1032; each value takes at least a byte, or a digit and a blank.
    constexpr std::size_t kBestPacking = 1032;
    const std::size_t most = (packing_ == VtuPacking::none ? 2 : kBestPacking) * file_.size();
    if (components != 0 && rows > most / components) {
      fail(node, fmt::format("{} times {} values cannot fit into the file", rows, components));
    }
    const std::size_t size = rows * components;
    // Arrays may be packed, or name the same bytes of the file.
    kept_ += size * type->size;
    if (is_bomb(file_.size_of_file(), kept_)) {
      fail(node, "the arrays hold hundreds of times the size of the file, which no mesh does");
    }
    const std::string_view format = node.attribute("format").as_string("ascii");
    if (format == "ascii") return parse(node, *type, size);
    if (format != "binary" && format != "appended") {
      fail(node, fmt::format("the format {} is unknown: expected ascii, binary or appended",
                             in_quotes(format)));
    }
    const std::string bytes = format == "binary"
                                  ? unpacked(node, base64_source(node), size * type->size)
                                  : appended(node, size * type->size);
    return decode_vtu(bytes, *type, size, swap_);
  }

  template <class Value>
  std::vector<Value> parse_as(const pugi::xml_node& node, std::size_t size) const {
    const std::string_view all = node.text().get();
    const char* at = all.data();
    const char* const end = at + all.size();
    std::vector<Value> values;
    values.reserve(std::min(size, all.size() / 2 + 1));
    const auto is_space = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    for (;;) {
      while (at < end && is_space(*at)) ++at;
      if (at == end) break;
      Value value{};
      const auto [stop, error] = from_chars(at, end, value);
      if (error != std::errc() || (stop < end && !is_space(*stop))) {
        const char* word_end = std::find_if(at, end, is_space);
        fail(node, fmt::format("{} is not a value of the type: expected a number",
                               in_quotes({at, static_cast<std::size_t>(word_end - at)})));
      }
      values.push_back(value);
      at = stop;
    }
    if (values.size() != size) {
      fail(node, fmt::format("there are {} values: expected {}", values.size(), size));
    }
    return values;
  }

  DataArray::Values parse(const pugi::xml_node& node, const VtuType& type, std::size_t size) const {
    if (type.kind == Kind::real) {
      if (type.size == 4) return parse_as<float>(node, size);
      return parse_as<double>(node, size);
    }
    if (type.is_narrow()) return parse_as<std::int32_t>(node, size);
    if (type.kind == Kind::unsigned_integer && type.size == 8) {
      const std::vector<std::uint64_t> values = parse_as<std::uint64_t>(node, size);
      return std::vector<std::int64_t>(values.begin(), values.end());  // see has_wrapped()
    }
    return parse_as<std::int64_t>(node, size);
  }

  /// Bytes of an array, wherever they come from: next(n) gives the next n, or fewer at the end.
  class Source {
   public:
    Source(std::string_view raw, bool is_base64) : rest_(raw), is_base64_(is_base64) {}

    std::string next(std::size_t size) {
      if (!is_base64_) {
        const std::string_view part = rest_.substr(0, size);
        rest_.remove_prefix(part.size());
        return std::string(part);
      }
      decode_base64(rest_, size, decoded_);
      const std::size_t given = std::min(size, decoded_.size());
      std::string part = decoded_.substr(0, given);
      decoded_.erase(0, given);
      return part;
    }

   private:
    std::string_view rest_;
    bool is_base64_;
    std::string decoded_;  // beyond what was asked for
  };

  static Source base64_source(const pugi::xml_node& node) { return {node.text().get(), true}; }

  std::string appended(const pugi::xml_node& node, std::size_t size) const {
    const std::size_t offset = count(node, "offset");
    if (offset > appended_.size()) {
      fail(node, fmt::format("the offset {} is behind the end of the file", offset));
    }
    return unpacked(node, Source(appended_.substr(offset), !is_raw_), size);
  }

  std::uint64_t header(const pugi::xml_node& node, const std::string& bytes, std::size_t i) const {
    if (bytes.size() < (i + 1) * header_size_) fail(node, "the data are truncated");
    const char* at = bytes.data() + i * header_size_;
    return header_size_ == 4 ? load<std::uint32_t>(at, swap_) : load<std::uint64_t>(at, swap_);
  }

  /// Plain: the number of bytes, then these. In blocks: their number, the size of each and of the
  /// last, the packed size of each; then the blocks. In base64 this header stands for itself.
  std::string unpacked(const pugi::xml_node& node, Source source, std::size_t size) const {
    const auto expect = [&](std::uint64_t given) {
      if (given == size) return;
      fail(node, fmt::format("the array has {} bytes: expected {}", given, size));
    };
    if (packing_ == VtuPacking::none) {
      expect(header(node, source.next(header_size_), 0));
      std::string bytes = source.next(size);
      if (bytes.size() != size) fail(node, "the data are truncated");
      return bytes;
    }
    const std::string first = source.next(3 * header_size_);
    const std::uint64_t blocks = header(node, first, 0);
    if (blocks == 0) {
      expect(0);
      return {};
    }
    const std::uint64_t block_size = header(node, first, 1);
    const std::uint64_t last = header(node, first, 2);
    const std::uint64_t full = last == 0 ? blocks : blocks - 1;
    if (blocks > file_.size() || last > block_size || (full > 0 && block_size > size / full)) {
      fail(node, fmt::format("{} packed blocks of {} bytes, the last of {}, make no sense: the "
                             "array has {} bytes",
                             blocks, block_size, last, size));
    }
    expect(full * block_size + last);
    const std::string sizes = source.next(blocks * header_size_);
    std::string bytes(size, '\0');
    std::size_t done = 0;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const std::uint64_t packed_size = header(node, sizes, i);
      if (packed_size > file_.size()) fail(node, "a packed block is larger than the file");
      const std::string block = source.next(packed_size);
      const std::size_t part = i < full ? block_size : last;
      if (block.size() != packed_size ||
          !unpack_block(packing_, block, bytes.data() + done, part)) {
        fail(node, fmt::format("the packed block {} is damaged or truncated", i));
      }
      done += part;
    }
    return bytes;
  }

  const InputFile& file_;
  TextReader text_;
  const ReadRequest& request_;
  pugi::xml_document document_;
  std::string_view appended_;
  bool swap_ = false;
  VtuPacking packing_ = VtuPacking::none;
  bool is_raw_ = false;
  std::size_t header_size_ = 4;
  mutable std::size_t kept_ = 0;  // bytes of all arrays
  MeshData mesh_;
  std::vector<std::int64_t> offsets_ = {0};
  std::vector<std::int64_t> connectivity_;
  std::vector<std::int64_t> types_;
  const char* cells_place_ = nullptr;
  Arrays point_arrays_;
  Arrays cell_arrays_;
};

}  // namespace

MeshData read_vtu(const std::filesystem::path& file, const ReadRequest& request) {
  const InputFile input(file);
  return VtuReader(input, request).read();
}

}  // namespace tetmend::formats
