// SPDX-License-Identifier: MIT
// Writes decks of Abaqus and CalculiX: the lines of the deck that was read, with the mesh as it is
// now in the places of the old one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <span>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "kernel/formats/included_path.h"
#include "kernel/formats/inp.h"
#include "kernel/formats/inp_fields.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_plan.h"
#include "kernel/formats/inp_types.h"
#include "kernel/formats/output_rows.h"
#include "kernel/parts.h"

namespace tetmend::formats {
namespace {

/// Abaqus and CalculiX read 20 characters of a number: what follows is lost, were it the exponent.
constexpr std::size_t kMostCharacters = 20;

/// "-1.25e-7" in as few characters as possible, with `digits` behind the point.
std::string short_scientific(double value, int digits, bool with_point) {
  std::string text = fmt::format("{:.{}e}", value, digits);
  const std::size_t e = text.find('e');
  std::string mantissa = text.substr(0, e);
  int exponent = std::stoi(text.substr(e + 1));
  if (!with_point) {
    std::erase(mantissa, '.');
    exponent -= digits;
  }
  return fmt::format("{}e{}", mantissa, exponent);
}

/// The nearest number that has room: the same but for small numbers with 16 or 17 digits.
std::string in_room(double value) {
  constexpr int kAllDigits = 16;
  for (int digits = kAllDigits;; --digits) {
    for (const bool with_point : {true, false}) {
      std::string text = short_scientific(value, digits, with_point);
      // The greatest numbers must not be rounded up.
      if (text.size() <= kMostCharacters && std::isfinite(std::strtod(text.c_str(), nullptr))) {
        return text;
      }
    }
  }
}

using RealText = std::array<char, 32>;

std::string_view real_text(double value, RealText& memory, std::string& long_memory) {
  const char* end = fmt::format_to(memory.data(), FMT_COMPILE("{}"), value);
  const std::string_view text(memory.data(), static_cast<std::size_t>(end - memory.data()));
  if (text.size() <= kMostCharacters) return text;
  return long_memory = in_room(value);
}

class InpWriter {
 public:
  InpWriter(const std::filesystem::path& file, const MeshView& mesh)
      : mesh_(mesh), plan_(mesh), out_(file) {}

  void run() {
    for (const InpPiece& piece : plan_.deck.pieces) {
      const bool is_of_deck =
          piece.kind == InpPieceKind::verbatim || piece.kind == InpPieceKind::elements;
      if (!is_of_deck || piece.text.find('\n') == std::string::npos) continue;
      out_.use_line_breaks_of(piece.text);
      break;
    }
    for (const InpPiece& piece : plan_.deck.pieces) write(piece);
    out_.commit(mesh_.companions());
  }

 private:
  void write(const InpPiece& piece) {
    switch (piece.kind) {
      case InpPieceKind::verbatim:
        return out_.put_as_it_is(piece.text);
      case InpPieceKind::nodes:
        return write_nodes(piece);
      case InpPieceKind::elements:
        return write_elements(piece);
      case InpPieceKind::node_set:
        if (piece.type == kInpUnsorted) {
          out_.put_as_it_is(piece.text);
          return out_.put_as_it_is(piece.more);
        }
        return write_set(piece, plan_.nodes_of(piece.groups.at(0)));
      case InpPieceKind::element_set:
        return write_set(piece, plan_.elements_of(piece.groups));
      case InpPieceKind::surface:
        return write_surface(piece);
      case InpPieceKind::face_load:
        return write_load(piece);
      case InpPieceKind::remarks:
        return;  // unpack_deck() takes them out
    }
  }

  void write_nodes(const InpPiece& piece) {
    std::vector<std::int64_t> set;
    std::string name;
    if (!piece.groups.empty()) {
      set = plan_.nodes_of(piece.groups[0]);
      for (const InpOutGroup& group : plan_.groups) {
        if (group.dimension == 0 && group.number == piece.groups[0].number) name = group.name;
      }
    }
    const bool is_alone = plan_.deck.numberings.size() == 1;
    const std::span<const std::uint32_t> own = plan_.points_of(piece.numbering);
    const std::size_t count = is_alone ? mesh_.point_count() : own.size();
    const std::map<std::int64_t, std::string_view> more = more_of_nodes(piece.more);
    const bool is_all = set.size() == count && !set.empty();
    const bool is_quoted = name.find(' ') != std::string::npos;
    if (is_quoted) name = '"' + name + '"';
    out_.put(std::string_view(piece.text).substr(0, piece.text.size() - 1));
    if (is_all) out_.put(fmt::format(", NSET={}", name));
    out_.put('\n');
    put_rows(out_, count, [&](std::size_t k, OutputBuffer& buffer) {
      const std::size_t i = is_alone ? k : own[k];
      RealText memory;
      std::string long_memory;
      buffer.put_integer(plan_.point_numbers[i]);
      for (int axis = 0; axis < 3; ++axis) {
        buffer.put(std::string_view(", "));
        buffer.put(real_text(mesh_.point(i)[axis], memory, long_memory));
      }
      const auto rest = more.find(plan_.point_numbers[i]);
      if (rest != more.end()) buffer.put(rest->second);
      buffer.put('\n');
    });
    if (set.empty() || is_all) return;
    out_.put(fmt::format("*NSET, NSET={}\n", name));
    write_numbers(set);
  }

  /// By the number of the node what stands behind its coordinates: a normal.
  static std::map<std::int64_t, std::string_view> more_of_nodes(std::string_view lines) {
    std::map<std::int64_t, std::string_view> more;
    while (!lines.empty()) {
      const std::string_view line = lines.substr(0, lines.find('\n'));
      lines.remove_prefix(line.size() + 1);
      const std::size_t comma = line.find(',');
      std::int64_t number = 0;
      if (to_integer(line.substr(0, comma), number)) more[number] = line.substr(comma);
    }
    return more;
  }

  void write_elements(const InpPiece& piece) {
    const std::vector<InpPlan::Row> rows = plan_.rows_of(piece.block);
    if (rows.empty()) return;
    out_.put(piece.text);
    put_rows(out_, rows.size(), [&](std::size_t i, OutputBuffer& buffer) {
      constexpr std::size_t kNodesOfLine = 15;
      const InpKind& kind = plan_.kinds[rows[i].kind];
      const std::uint32_t* vertices = kind.of(rows[i].element);
      buffer.put_integer(kind.numbers[rows[i].element]);
      for (std::size_t k = 0; k < kind.width; ++k) {
        buffer.put(std::string_view(k > 0 && k % kNodesOfLine == 0 ? ",\n" : ", "));
        buffer.put_integer(plan_.point_numbers[vertices[vtk_position(kind.vtk_type, k)]]);
      }
      buffer.put('\n');
    });
  }

  /// Numbers, or a range if it is all of the set: not every program reads more than one line of
  /// GENERATE. On request ranges, where these are shorter, or no range.
  void write_set(const InpPiece& piece, const std::vector<std::int64_t>& numbers) {
    const bool given_elsewhere = piece.kind == InpPieceKind::element_set && numbers.empty() &&
                                 piece.more.empty() && !piece.groups.empty();
    if (given_elsewhere) return;
    std::size_t runs = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      runs += i == 0 || numbers[i] != numbers[i - 1] + 1 ? 1 : 0;
    }
    constexpr std::size_t kWorthARange = 3;
    const bool by_ranges = mesh_.variant() == kInpRanges;
    const bool is_list = mesh_.variant() == kInpLists || (runs > 1 && !by_ranges);
    if (is_list || !piece.more.empty() || kWorthARange * runs > numbers.size()) {
      out_.put(piece.text);
      write_numbers(numbers);
      return out_.put(piece.more);
    }
    out_.put(std::string_view(piece.text).substr(0, piece.text.size() - 1));
    out_.put(numbers.empty() ? "\n" : ", GENERATE\n");
    for (std::size_t i = 0; i < numbers.size();) {
      std::size_t end = i + 1;
      while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
      out_.put(fmt::format("{}, {}, 1\n", numbers[i], numbers[end - 1]));
      i = end;
    }
  }

  void write_numbers(const std::vector<std::int64_t>& numbers) {
    constexpr std::size_t kNumbersOfLine = 10;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      out_.put_integer(numbers[i]);
      const bool ends = (i + 1) % kNumbersOfLine == 0 || i + 1 == numbers.size();
      out_.put(ends ? (numbers.size() == 1 ? ",\n" : "\n") : ", ");
    }
  }

  void write_surface(const InpPiece& piece) {
    out_.put(piece.text);
    for (const auto& [tet, face] : plan_.faces_of(piece.groups.at(0))) {
      out_.put(fmt::format("{}{}, S{}\n", piece.instance, tet, face));
    }
    out_.put(piece.more);
  }

  void write_load(const InpPiece& piece) {
    for (const auto& [tet, face] : plan_.faces_of(piece.groups.at(0))) {
      out_.put(fmt::format("{}{}, {}{}{}{}\n", piece.instance, tet, piece.type, face, piece.suffix,
                           piece.text));
    }
    out_.put(piece.more);
  }

  const MeshView& mesh_;
  InpPlan plan_;
  OutputFile out_;
};

}  // namespace

void write_inp(const std::filesystem::path& file, const MeshView& mesh) {
  InpWriter(file, mesh).run();
}

std::vector<std::string> not_in_inp(const std::filesystem::path& file, const MeshData& mesh) {
  std::vector<std::string> notes;
  const auto lost = [&](std::size_t count, std::string_view what) {
    if (count > 0) {
      notes.push_back(fmt::format("{} {} not kept: .inp has no place for them", count, what));
    }
  };
  for (const OtherElements& others : mesh.other_elements) {
    const InpType type = inp_type(inp_type_name(others.vtk_type));
    if (type.width == others.vertex_count && type.kind == InpType::Kind::mesh) continue;
    lost(others.labels.size(), fmt::format("elements of VTK's type {} are", others.vtk_type));
  }
  lost(mesh.periodic.size(), "periodic links are");
  const bool by_labels = !are_finer_than_labels(mesh.tets, mesh.tet_parts) &&
                         !are_finer_than_labels(mesh.triangles, mesh.triangle_parts);
  if (!by_labels) lost(mesh.entities.size(), "entities of the geometry are");
  const bool has_deck = is_inp_deck(mesh.deck);
  if (!has_deck && !mesh.edges.empty()) {
    notes.push_back(fmt::format(
        "{} edges, and groups of them, are kept as sets of their points only", mesh.edges.size()));
  }
  std::size_t rounded = 0;
  RealText memory;
  for (const Point& point : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      const char* end = fmt::format_to(memory.data(), FMT_COMPILE("{}"), point[axis]);
      if (static_cast<std::size_t>(end - memory.data()) <= kMostCharacters) continue;
      rounded += std::strtod(in_room(point[axis]).c_str(), nullptr) != point[axis] ? 1 : 0;
    }
  }
  if (rounded > 0) {
    notes.push_back(
        fmt::format("{} coordinates are rounded to {} characters, which is what Abaqus "
                    "and CalculiX read",
                    rounded, kMostCharacters));
  }
  if (!has_deck) return notes;
  for (std::string& note : included_files_stay(file, unpack_deck(mesh.deck).folder, "*INCLUDE")) {
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace tetmend::formats
