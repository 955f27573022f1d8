// SPDX-License-Identifier: MIT
// Writes universal files.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/unv.h"
#include "kernel/formats/unv_elements.h"

namespace tetmend::formats {
namespace {

constexpr std::string_view kMarkLine = "    -1\n";
constexpr std::string_view kBlankField = "          ";  // a field of integers
// Numbers of ten digits would touch those before them.
constexpr std::array<std::int64_t, 2> kLimits = {999'999'999, INT32_MAX};

void put_field(OutputBuffer& buffer, std::int64_t value) {
  const fmt::format_int text(value);
  buffer.put(
      kBlankField.substr(0, kBlankField.size() - std::min(kBlankField.size() - 1, text.size())));
  buffer.put(std::string_view(text.data(), text.size()));
}

/// As Fortran's D25.16, from which the same bits are read.
void put_real_field(OutputBuffer& buffer, double value) {
  std::array<char, 40> text{};
  char* const end = fmt::format_to(text.data(), FMT_COMPILE("{:25.16E}"), value);
  std::replace(text.data(), end, 'E', 'D');
  buffer.put(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
}

/// The rows of an array of ours; null if there is none that fits.
const std::int32_t* own_rows(const std::vector<DataArray>* arrays, std::string_view name,
                             std::size_t components, std::size_t count) {
  if (arrays == nullptr) return nullptr;
  for (const DataArray& array : *arrays) {
    const auto* values = std::get_if<std::vector<std::int32_t>>(&array.values);
    const bool fits = array.components == components && array.size() == components * count;
    if (array.name == name && values != nullptr && fits) return values->data();
  }
  return nullptr;
}

/// Members of groups of one name and number, of whatever dimension.
struct WrittenGroup {
  std::int64_t number = 0;
  std::string name;
  std::vector<std::pair<int, std::int64_t>> members;  ///< type and number
};

class UnvWriter {
 public:
  UnvWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file),
        mesh_(mesh),
        lists_(mesh),
        points_(written_point_numbers(mesh, kLimits)),
        elements_(written_element_numbers(lists_, kLimits)) {}

  void write() {
    if (mesh_.data() != nullptr && mesh_.data()->variant == kUnv) {
      for (const std::string& piece : mesh_.data()->deck) {
        if (piece.starts_with(kUnvGroupsPiece)) {
          groups_ = piece.substr(kUnvGroupsPiece.size());
        } else {
          out_.put(piece);
        }
      }
    }
    write_nodes();
    write_elements();
    write_groups();
    out_.commit(mesh_.companions());
  }

 private:
  void begin(std::string_view dataset) {
    out_.put(kMarkLine);
    out_.put(fmt::format("{:>6}\n", dataset));
  }

  void write_nodes() {
    begin("2411");
    const std::int32_t* own = mesh_.data() == nullptr ? nullptr
                                                      : own_rows(&mesh_.data()->point_data,
                                                                 kUnvNode, 3, mesh_.point_count());
    put_rows(out_, mesh_.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
      put_field(buffer, points_[i]);
      constexpr std::array<std::int32_t, 3> kDefault = {1, 1, 11};
      const std::int32_t* numbers = own == nullptr ? kDefault.data() : own + 3 * i;
      for (int k = 0; k < 3; ++k) put_field(buffer, numbers[k]);
      buffer.put('\n');
      for (int axis = 0; axis < 3; ++axis) put_real_field(buffer, mesh_.point(i)[axis]);
      buffer.put('\n');
    });
    out_.put(kMarkLine);
  }

  void write_elements() {
    begin("2412");
    for (std::size_t k = 0; k < lists_.all().size(); ++k) {
      const ElementList& list = lists_.all()[k];
      const UnvKind* kind = unv_kind_of(list.kind.vtk_type);
      if (kind == nullptr) continue;
      const std::int32_t* own = own_rows(list.data, kUnvElement, 4, list.count);
      put_rows(out_, list.count, [&](std::size_t i, OutputBuffer& buffer) {
        put_field(buffer, elements_[k][i]);
        const std::array<std::int32_t, 4> made = {static_cast<std::int32_t>(kind->written),
                                                  list.label(i), 1, 7};
        const std::int32_t* numbers = own == nullptr ? made.data() : own + 4 * i;
        for (int n = 0; n < 4; ++n) put_field(buffer, numbers[n]);
        put_field(buffer, static_cast<std::int64_t>(list.kind.width));
        buffer.put(is_unv_beam(numbers[0]) ? "\n         0         1         1\n" : "\n");
        put_nodes(buffer, list, *kind, i);
      });
    }
    out_.put(kMarkLine);
  }

  void put_nodes(OutputBuffer& buffer, const ElementList& list, const UnvKind& kind,
                 std::size_t i) const {
    constexpr std::size_t kFieldsOfLine = 8;
    std::array<std::uint32_t, kMostVerticesOfElement> listed{};
    for (std::size_t k = 0; k < list.kind.width; ++k) listed[kind.order[k]] = list.vertices(i)[k];
    for (std::size_t k = 0; k < list.kind.width; ++k) {
      if (k > 0 && k % kFieldsOfLine == 0) buffer.put('\n');
      put_field(buffer, points_[listed[k]]);
    }
    buffer.put('\n');
  }

  std::vector<WrittenGroup> collect_groups() const {
    std::vector<WrittenGroup> made;
    const std::vector<GroupMembers> members = members_of_groups(mesh_, lists_);
    std::map<std::pair<Label, std::string>, std::size_t> place_of;
    for (std::size_t g = 0; g < members.size(); ++g) {
      const Group& group = mesh_.data()->groups[g];
      if (group.name.empty()) continue;  // it is a label
      const auto [at, is_new] = place_of.try_emplace({group.number, group.name}, made.size());
      if (is_new) made.push_back({group.number, group.name, {}});
      auto& listed = made[at->second].members;
      for (const std::uint32_t point : members[g].points) listed.emplace_back(7, points_[point]);
      for (const auto& [list, i] : members[g].elements) {
        if (unv_kind_of(lists_.all()[list].kind.vtk_type) == nullptr) continue;
        listed.emplace_back(8, elements_[list][i]);
      }
    }
    std::erase_if(made, [](const WrittenGroup& group) { return group.members.empty(); });
    return made;
  }

  void write_groups() {
    std::vector<WrittenGroup> groups = collect_groups();
    if (groups.empty()) return;
    std::vector<ElementSet> numbers(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) numbers[g].number = groups[g].number;
    number_sets(numbers);
    begin(groups_);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      std::string& name = groups[g].name;
      if (!is_unv_name(name)) {
        for (char& c : name) {
          if (static_cast<unsigned char>(c) <= ' ') c = '_';
        }
        if (name == "-1") name = "-1_";
      }
      const auto& members = groups[g].members;
      out_.put(fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}{:10}{:10}\n{}\n", numbers[g].number, 0,
                           0, 0, 0, 0, 0, members.size(), name));
      put_rows(out_, (members.size() + 1) / 2, [&](std::size_t row, OutputBuffer& buffer) {
        for (std::size_t i = 2 * row; i < std::min(members.size(), 2 * row + 2); ++i) {
          put_field(buffer, members[i].first);
          put_field(buffer, members[i].second);
          put_field(buffer, 0);
          put_field(buffer, 0);
        }
        buffer.put('\n');
      });
    }
    out_.put(kMarkLine);
  }

  OutputFile out_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::vector<std::int64_t> points_;                 // their numbers
  std::vector<std::vector<std::int64_t>> elements_;  // of each list
  std::string groups_{kUnvGroups};                   // the dataset
};

}  // namespace

bool is_unv_name(std::string_view name) {
  return !name.empty() && name != "-1" && name.front() != ' ' && name.back() != ' ' &&
         std::none_of(name.begin(), name.end(),
                      [](char c) { return static_cast<unsigned char>(c) < ' '; });
}

std::size_t unv_pieces_to_miss(const MeshData& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.deck.begin(), mesh.deck.end(),
                    [](const std::string& piece) { return !piece.starts_with(kUnvGroupsPiece); }));
}

std::vector<std::string> not_in_unv(const std::filesystem::path&, const MeshData& mesh) {
  const MeshView view(mesh);
  const std::vector<GroupMembers> members = members_of_groups(view, ElementLists(view));
  std::size_t empty = 0;
  for (std::size_t g = 0; g < members.size(); ++g) {
    const bool has_none = members[g].points.empty() && members[g].elements.empty();
    if (has_none && !mesh.groups[g].name.empty()) ++empty;
  }
  if (empty == 0) return {};
  return {fmt::format("{} groups have no members: not kept", empty)};
}

void write_unv(const std::filesystem::path& file, const MeshView& mesh) {
  UnvWriter(file, mesh).write();
}

}  // namespace tetmend::formats
