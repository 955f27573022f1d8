// SPDX-License-Identifier: MIT
// The layout of the format: kernel/formats/vtu_writer.cpp.
#include "pieces/vtu_output.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/output_file.h"
#include "kernel/formats/vtu_array.h"
#include "pieces/bytes.h"
#include "pieces/file_walk.h"

namespace tetmend::pieces {

namespace {

using Take = std::function<void(std::string_view)>;

/// An array over all cells, as join_cell_arrays() makes it, and which it is among those of each
/// kind.
struct CellArray {
  DataArray outline;
  ByKind<std::optional<std::size_t>> places;
};

constexpr std::array<RowKind, 3> kCellKinds = {RowKind::tet, RowKind::triangle, RowKind::edge};

/// Of several alike in one kind each is joined with one of the others, in their order.
std::vector<CellArray> join_cell_arrays(const CarriedRows& rows) {
  std::vector<CellArray> joined;
  std::map<OutlineKey, std::vector<std::size_t>> alike;
  for (const RowKind kind : kCellKinds) {
    const std::vector<DataArray>& arrays = rows.layout(kind).arrays();
    std::map<OutlineKey, std::size_t> seen;
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      const OutlineKey key = outline_key(arrays[i]);
      std::vector<std::size_t>& those = alike[key];
      const std::size_t which = seen[key]++;
      if (which == those.size()) {
        those.push_back(joined.size());
        joined.push_back({arrays[i], {}});
      }
      joined[those[which]].places[kind] = i;
    }
  }
  return joined;
}

/// What cells have that have no such array.
std::string bytes_of_nothing(const DataArray& outline, std::size_t count) {
  DataArray nothing = outline;
  append_nothing(count * outline.components, nothing);
  return std::string(bytes_of_values(nothing));
}

/// The first rank writes what all send it. Each array is walked through twice, see VtuArray.
class VtuWriter {
 public:
  /// @param out null on all ranks but the first
  VtuWriter(OutputFile* out, const DividedMesh& mesh, const VtuExtras& extras)
      : out_(out), walk_(mesh), extras_(extras), rows_(extras.rows) {}

  void write() {
    const FileWalk::Counts& counts = walk_.counts();
    put(formats::vtu_head(counts.vertices, counts.tets + counts.triangles + counts.edges));
    write_point_data();
    put("<CellData>\n");
    if (walk_.has_labels() || !extras_.label_array.empty()) {
      write_array(extras_.label_array.empty() ? "CellEntityIds" : extras_.label_array, "Int32", 1,
                  [&](const Take& take) { tell_labels(take); });
    }
    write_rows_of_cells();
    put("</CellData>\n<Points>\n");
    write_array("Points", "Float64", 3, [&](const Take& take) { tell_points(take); });
    put("</Points>\n<Cells>\n");
    write_array("connectivity", "Int64", 1, [&](const Take& take) { tell_connectivity(take); });
    write_array("offsets", "Int64", 1, [&](const Take& take) { tell_offsets(take); });
    write_array("types", "UInt8", 1, [&](const Take& take) { tell_types(take); });
    put("</Cells>\n");
    put(formats::kVtuEnd);
  }

 private:
  void put(std::string_view text) {
    if (out_ != nullptr) out_->put(text);
  }
  template <class Tell>
  void write_array(std::string_view name, std::string_view type, std::size_t components,
                   Tell tell) {
    formats::VtuArray array(name, type, components);
    tell([&](std::string_view bytes) { array.measure(bytes); });
    if (out_ != nullptr) array.begin(*out_);
    tell([&](std::string_view bytes) { array.write(bytes, *out_); });
    if (out_ != nullptr) array.end(*out_);
  }

  void write_point_data() {
    const bool has_rows = rows_ != nullptr && !rows_->layout(RowKind::point).arrays().empty();
    if (!walk_.has_point_labels() && !has_rows) return;
    put("<PointData>\n");
    if (walk_.has_point_labels()) {
      write_array("CellEntityIds", "Int32", 1, [&](const Take& take) { tell_point_labels(take); });
    }
    if (has_rows) write_rows_of_points();
    put("</PointData>\n");
  }
  void write_rows_of_points() {
    const RowLayout& layout = rows_->layout(RowKind::point);
    for (std::size_t i = 0; i < layout.arrays().size(); ++i) {
      const auto pack = [&](std::size_t part, std::size_t begin, const Piece& vertices) {
        return rows_->column(RowKind::point, part, i, begin, begin + vertices.ids.size());
      };
      write_array(layout.arrays()[i],
                  [&](const Take& take) { walk_.vertex_bytes(layout.width(i), pack, take); });
    }
  }
  void write_rows_of_cells() {
    if (rows_ == nullptr) return;
    for (const CellArray& array : join_cell_arrays(*rows_)) {
      write_array(array.outline, [&](const Take& take) { tell_rows_of_cells(array, take); });
    }
  }
  template <class Tell>
  void write_array(const DataArray& outline, Tell tell) {
    write_array(outline.name, formats::vtu_type_of(outline), outline.components, tell);
  }
  void tell_rows_of_cells(const CellArray& array, const Take& take) const {
    const auto tell = [&](RowKind kind, auto list) {
      walk_.pieces(
          [&](std::size_t part, std::string& bytes) {
            const std::size_t count = walk_.count(part, list);
            bytes = array.places[kind] ? rows_->column(kind, part, *array.places[kind], 0, count)
                                       : bytes_of_nothing(array.outline, count);
          },
          take);
    };
    tell(RowKind::tet, &Piece::tets);
    tell(RowKind::triangle, &Piece::triangles);
    tell(RowKind::edge, &Piece::edges);
  }

  void tell_point_labels(const Take& take) const {
    walk_.vertices([&](std::span<const FileVertex> some) {
      std::string bytes;
      for (const FileVertex& vertex : some) pieces::put(vertex.label, bytes);
      take(bytes);
    });
  }
  void tell_points(const Take& take) const {
    walk_.vertices([&](std::span<const FileVertex> some) {
      std::string bytes;
      for (const FileVertex& vertex : some) pieces::put(vertex.point, bytes);
      take(bytes);
    });
  }
  template <class Pack>
  void tell_elements(Pack pack, const Take& take) const {
    walk_.elements(&Piece::tets, pack, take);
    walk_.elements(&Piece::triangles, pack, take);
    walk_.elements(&Piece::edges, pack, take);
  }
  void tell_labels(const Take& take) const {
    tell_elements([](const auto&, Label label, std::string& bytes) { pieces::put(label, bytes); },
                  take);
  }
  void tell_connectivity(const Take& take) const {
    const auto pack = [](const auto& numbers, Label, std::string& bytes) {
      for (const std::uint64_t v : numbers) pieces::put(static_cast<std::int64_t>(v), bytes);
    };
    tell_elements(pack, take);
  }
  /// What follows from the numbers of elements alone: the first rank knows it.
  template <class See>
  void for_each_cell(See see) const {
    if (out_ == nullptr) return;
    const FileWalk::Counts& counts = walk_.counts();
    for (std::uint64_t i = 0; i < counts.tets; ++i) see(4, 10);
    for (std::uint64_t i = 0; i < counts.triangles; ++i) see(3, 5);
    for (std::uint64_t i = 0; i < counts.edges; ++i) see(2, 3);
  }
  void tell_offsets(const Take& take) const {
    std::string bytes;
    std::int64_t end = 0;
    for_each_cell([&](int vertices, int) {
      end += vertices;
      pieces::put(end, bytes);
      if (bytes.size() < kSome) return;
      take(bytes);
      bytes.clear();
    });
    if (!bytes.empty()) take(bytes);
  }
  void tell_types(const Take& take) const {
    std::string bytes;
    for_each_cell([&](int, int type) {
      bytes += static_cast<char>(type);
      if (bytes.size() < kSome) return;
      take(bytes);
      bytes.clear();
    });
    if (!bytes.empty()) take(bytes);
  }

  static constexpr std::size_t kSome = std::size_t{1} << 20;
  OutputFile* out_;
  const FileWalk walk_;
  const VtuExtras& extras_;
  const CarriedRows* rows_;
};

}  // namespace

void write_vtu_slices(const std::filesystem::path& file, const DividedMesh& mesh,
                      const VtuExtras& extras) {
  write_by_first(file, mesh.ranks(),
                 [&](OutputFile* out) { VtuWriter(out, mesh, extras).write(); });
}

}  // namespace tetmend::pieces
