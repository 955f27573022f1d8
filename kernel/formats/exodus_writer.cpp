// SPDX-License-Identifier: MIT
// Writes files of Exodus II.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/element_orders.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/exodus.h"
#include "kernel/formats/exodus_plan.h"
#include "kernel/formats/exodus_tables.h"
#include "kernel/formats/netcdf_file.h"
#include "kernel/formats/output_file.h"
#include "kernel/printable.h"

namespace tetmend::formats {
namespace {

constexpr std::array<std::int64_t, 1> kMostOfExodus = {INT32_MAX};
constexpr double kMostWhole = 9007199254740992;  // 2^53, up to which doubles hold all integers

class Writer {
 public:
  Writer(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file), mesh_(mesh), lists_(mesh), plan_(mesh, lists_) {}

  void write() {
    begin();
    write_points();
    write_blocks();
    write_sets();
    write_variables();
    write_records();
    file_.write(out_);
    out_.commit(mesh_.companions());
  }

 private:
  // ---- Tables -------------------------------------------------------------------------------------

  static DataArray::Values one(double value) {
    return std::vector<float>{static_cast<float>(value)};
  }
  static DataArray::Values one(std::int32_t value) { return std::vector<std::int32_t>{value}; }

  void begin() {
    for (const char* name : {"api_version", "version"}) file_.attribute(name, one(8.11));
    for (const auto& [name, value] :
         {std::pair("floating_point_word_size", 8), std::pair("file_size", 1),
          std::pair("maximum_name_length", 32), std::pair("int64_status", 0)})
      file_.attribute(name, one(value));
    const std::vector<std::string> titles = exodus_pieces(mesh_.data(), "title");
    file_.attribute("title", titles.empty() ? std::string("mesh") : titles[0]);
    file_.dimension("time_step", 0);
    file_.dimension("len_string", 33);
    file_.dimension("len_name", 33);
    file_.dimension("len_line", 81);
    file_.dimension("four", 4);
    file_.dimension("num_dim", 3);
    counted("num_nodes", mesh_.point_count());
    counted("num_elem", plan_.count);
    counted("num_el_blk", plan_.blocks.size());
    counted("num_node_sets", plan_.node_sets.size());
    counted("num_side_sets", plan_.side_sets.size());
    counted("num_elem_sets", plan_.element_sets.size());
    const std::vector<std::string> times = exodus_pieces(mesh_.data(), "time");
    const double time = times.empty() ? 0 : std::strtod(times[0].c_str(), nullptr);
    if (!times.empty() || has_variables()) {
      file_.add("time_whole", {"time_step"}, std::vector<double>{time});
    }
  }
  bool has_variables() const {
    if (mesh_.data() != nullptr && !mesh_.data()->point_data.empty()) return true;
    return std::any_of(plan_.blocks.begin(), plan_.blocks.end(),
                       [](const ExodusPlan::Block& block) {
                         return has_variables(*block.list) && !block.list->data->empty();
                       });
  }
  void counted(const std::string& name, std::size_t count) {
    if (count > 0) file_.dimension(name, count);
  }

  void write_points() {
    const std::size_t count = mesh_.point_count();
    constexpr std::array<const char*, 3> kNames = {"coordx", "coordy", "coordz"};
    for (std::size_t axis = 0; axis < 3 && count > 0; ++axis) {
      std::vector<double> all(count);
      for (std::size_t i = 0; i < count; ++i)
        all[i] = mesh_.point(i)[static_cast<Eigen::Index>(axis)];
      file_.add(kNames[axis], {"num_nodes"}, std::move(all));
    }
    file_.add_texts("coor_names", {"num_dim", "len_name"}, {"x", "y", "z"});
    const bool has_numbers = mesh_.data() != nullptr && !mesh_.data()->point_numbers.empty();
    if (!has_numbers || count == 0) return;
    const auto numbers = written_point_numbers(mesh_, kMostOfExodus);
    file_.add("node_num_map", {"num_nodes"},
              std::vector<std::int32_t>(numbers.begin(), numbers.end()));
  }

  void write_blocks() {
    if (plan_.blocks.empty()) return;
    std::vector<std::int32_t> ids;
    std::vector<std::string> names;
    for (const ExodusPlan::Block& block : plan_.blocks) {
      ids.push_back(static_cast<std::int32_t>(block.set.number));
      names.push_back(block.set.name);
    }
    file_.add("eb_status", {"num_el_blk"}, std::vector<std::int32_t>(plan_.blocks.size(), 1));
    file_.add("eb_prop1", {"num_el_blk"}, std::move(ids), {{"name", "ID"}});
    file_.add_texts("eb_names", {"num_el_blk", "len_name"}, names);
    for (std::size_t b = 0; b < plan_.blocks.size(); ++b) write_block(plan_.blocks[b], b + 1);
    const bool has_numbers = std::all_of(
        lists_.all().begin(), lists_.all().end(),
        [](const ElementList& list) { return list.kind.dimension < 3 || list.numbers != nullptr; });
    if (!has_numbers) return;
    const auto numbers = written_element_numbers(lists_, kMostOfExodus);
    std::vector<std::int32_t> all;
    for (const ExodusPlan::Block& block : plan_.blocks) {
      for (const std::uint32_t i : block.elements)
        all.push_back(static_cast<std::int32_t>(numbers[block.list_number][i]));
    }
    file_.add("elem_num_map", {"num_elem"}, std::move(all));
  }

  void write_block(const ExodusPlan::Block& block, std::size_t b) {
    const ElementKind& kind = block.list->kind;
    const auto order = upright_first_order(kind.vtk_type);
    std::vector<std::int32_t> nodes;
    for (const std::uint32_t i : block.elements) {
      const auto vertices = block.list->vertices(i);
      for (std::size_t k = 0; k < kind.width; ++k)
        nodes.push_back(static_cast<std::int32_t>(vertices[order.empty() ? k : order[k]] + 1));
    }
    const auto type = std::find_if(kExodusTypes.begin(), kExodusTypes.end(), [&](const auto& each) {
      return each.vtk_type == kind.vtk_type && !each.written.empty();
    });
    const std::string count = fmt::format("num_el_in_blk{}", b);
    const std::string width = fmt::format("num_nod_per_el{}", b);
    file_.dimension(count, block.elements.size());
    file_.dimension(width, kind.width);
    file_.add(fmt::format("connect{}", b), {count, width}, std::move(nodes),
              {{"elem_type", std::string(type->written)}});
  }

  // ---- Sets ---------------------------------------------------------------------------------------

  void write_sets() {
    std::vector<ElementSet> sides, elements;
    for (const auto& [set, members] : plan_.side_sets) sides.push_back(set);
    for (const auto& [set, members] : plan_.element_sets) elements.push_back(set);
    write_heads("ns", "num_node_sets", plan_.node_sets);
    write_heads("ss", "num_side_sets", sides);
    write_heads("els", "num_elem_sets", elements);
    for (std::size_t s = 0; s < plan_.node_sets.size(); ++s) {
      std::vector<std::int32_t> nodes;
      for (const std::uint32_t point : plan_.node_sets[s].points)
        nodes.push_back(static_cast<std::int32_t>(point + 1));
      const std::string count = fmt::format("num_nod_ns{}", s + 1);
      file_.dimension(count, nodes.size());
      file_.add(fmt::format("node_ns{}", s + 1), {count}, std::move(nodes));
    }
    for (std::size_t s = 0; s < plan_.side_sets.size(); ++s)
      write_sides(plan_.side_sets[s].second, s + 1);
    for (std::size_t s = 0; s < plan_.element_sets.size(); ++s) {
      std::vector<std::int32_t> all;
      for (const auto& [k, i] : plan_.element_sets[s].second)
        all.push_back(static_cast<std::int32_t>(plan_.place[k][i]));
      const std::string count = fmt::format("num_ele_els{}", s + 1);
      file_.dimension(count, all.size());
      file_.add(fmt::format("elem_els{}", s + 1), {count}, std::move(all));
    }
  }

  void write_heads(const std::string& kind, const std::string& count,
                   const std::vector<ElementSet>& sets) {
    if (sets.empty()) return;
    std::vector<std::int32_t> ids;
    std::vector<std::string> names;
    for (const ElementSet& set : sets) {
      ids.push_back(static_cast<std::int32_t>(set.number));
      names.push_back(set.name);
    }
    file_.add(kind + "_status", {count}, std::vector<std::int32_t>(sets.size(), 1));
    file_.add(kind + "_prop1", {count}, std::move(ids), {{"name", "ID"}});
    file_.add_texts(kind + "_names", {count, "len_name"}, names);
  }

  void write_sides(const ExodusPlan::Members& members, std::size_t s) {
    std::vector<std::int32_t> elements, sides;
    for (const GroupMembers::Member& member : members) {
      const auto [element, side] = plan_.side(member);
      elements.push_back(element);
      sides.push_back(side);
    }
    const std::string count = fmt::format("num_side_ss{}", s);
    file_.dimension(count, elements.size());
    file_.add(fmt::format("elem_ss{}", s), {count}, std::move(elements));
    file_.add(fmt::format("side_ss{}", s), {count}, std::move(sides));
  }

  // ---- Variables ----------------------------------------------------------------------------------

  static std::vector<std::string> variable_names(const DataArray& array) {
    return component_names(array, kExodusAxes);
  }
  static std::vector<double> component(const DataArray& array, std::size_t c) {
    return std::visit(
        [](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
        component_values(array, c));
  }

  void write_variables() {
    if (mesh_.data() == nullptr) return;
    std::vector<std::string> names;
    std::vector<std::vector<double>> values;
    for (const DataArray& array : mesh_.data()->point_data) {
      const std::vector<std::string> of_array = variable_names(array);
      for (std::size_t c = 0; c < of_array.size(); ++c) {
        names.push_back(of_array[c]);
        values.push_back(component(array, c));
      }
    }
    write_names("num_nod_var", "name_nod_var", names);
    for (std::size_t k = 0; k < names.size(); ++k) {
      file_.add(fmt::format("vals_nod_var{}", k + 1), {"time_step", "num_nodes"},
                std::move(values[k]));
    }
    write_of_elements();
  }

  void write_names(const std::string& count, const std::string& table,
                   const std::vector<std::string>& names) {
    if (names.empty()) return;
    file_.dimension(count, names.size());
    std::vector<std::string> fit;
    for (const std::string& name : names) fit.push_back(fit_exodus_name(name));
    file_.add_texts(table, {count, "len_name"}, fit);
  }

  static bool has_variables(const ElementList& list) {
    return list.kind.dimension != 2 && list.data != nullptr;
  }

  void write_of_elements() {
    std::vector<std::string> names;
    std::map<std::string, std::size_t> number_of;
    for (const ExodusPlan::Block& block : plan_.blocks) {
      if (!has_variables(*block.list)) continue;
      for (const DataArray& array : *block.list->data) {
        for (const std::string& name : variable_names(array)) {
          if (number_of.try_emplace(name, names.size()).second) names.push_back(name);
        }
      }
    }
    if (names.empty()) return;
    write_names("num_elem_var", "name_elem_var", names);
    std::vector<std::int32_t> there(plan_.blocks.size() * names.size(), 0);
    for (std::size_t b = 0; b < plan_.blocks.size(); ++b) {
      if (!has_variables(*plan_.blocks[b].list)) continue;
      for (const DataArray& array : *plan_.blocks[b].list->data) {
        const std::vector<std::string> of_array = variable_names(array);
        for (std::size_t c = 0; c < of_array.size(); ++c) {
          const std::size_t k = number_of.at(of_array[c]);
          if (std::exchange(there[b * names.size() + k], 1) == 1) continue;
          const std::vector<double> all = component(array, c);
          std::vector<double> values;
          for (const std::uint32_t i : plan_.blocks[b].elements) values.push_back(all[i]);
          file_.add(fmt::format("vals_elem_var{}eb{}", k + 1, b + 1),
                    {"time_step", fmt::format("num_el_in_blk{}", b + 1)}, std::move(values));
        }
      }
    }
    file_.add("elem_var_tab", {"num_el_blk", "num_elem_var"}, std::move(there));
  }

  void write_records() {
    const auto lines_of = [&](std::string_view what) {
      std::vector<std::string> lines;
      for (const std::string& piece : exodus_pieces(mesh_.data(), what)) {
        std::istringstream text(piece);
        for (std::string line; std::getline(text, line);) lines.push_back(line);
      }
      return lines;
    };
    std::vector<std::string> records = lines_of("qa");
    records.resize(records.size() / 4 * 4);
    if (!records.empty()) {
      file_.dimension("num_qa_rec", records.size() / 4);
      file_.add_texts("qa_records", {"num_qa_rec", "four", "len_string"}, records);
    }
    if (const auto info = lines_of("info"); !info.empty()) {
      file_.dimension("num_info", info.size());
      file_.add_texts("info_records", {"num_info", "len_line"}, info);
    }
  }

  OutputFile out_;
  NetcdfWriter file_;
  const MeshView& mesh_;
  ElementLists lists_;
  ExodusPlan plan_;
};

/// What of arrays becomes something else.
void note_arrays(const std::vector<DataArray>& arrays, std::vector<std::string>& notes) {
  for (const DataArray& array : arrays) {
    const std::size_t suffix = array.components == 1 ? 0 : 2;
    if (array.name.size() + suffix > kExodusName) {
      notes.push_back(fmt::format("the name of the array '{}' is cut: .e has 32 characters",
                                  printable(array.name)));
    }
    if (array.components != 1 && array.components != 3) {
      notes.push_back(fmt::format("the array '{}' is not kept as one: .e has {} variables of it",
                                  printable(array.name), array.components));
    }
    const auto* large = std::get_if<std::vector<std::int64_t>>(&array.values);
    const auto is_rounded = [](std::int64_t value) {
      return static_cast<double>(value) > kMostWhole || static_cast<double>(value) < -kMostWhole;
    };
    if (large != nullptr && std::any_of(large->begin(), large->end(), is_rounded)) {
      notes.push_back(fmt::format("integers of the array '{}' are rounded: .e has real numbers",
                                  printable(array.name)));
    }
  }
}

}  // namespace

std::vector<std::string> not_in_exodus(const std::filesystem::path&, const MeshData& mesh) {
  std::vector<std::string> notes;
  note_arrays(mesh.point_data, notes);
  note_arrays(mesh.tet_data, notes);
  for (const Group& group : mesh.groups) {
    if (group.dimension != 0 || !group.members.empty()) continue;
    notes.push_back(fmt::format("the group '{}' of no points is not kept: .e has no empty set",
                                printable(group.name)));
  }
  for (const OtherElements& others : mesh.other_elements) {
    const ElementKind* kind = element_kind(others.vtk_type);
    if (kind == nullptr || kind->dimension != 2 || others.data.empty()) continue;
    notes.push_back(
        fmt::format("{} arrays of elements of VTK's type {} are not kept: .e has none of faces",
                    others.data.size(), others.vtk_type));
  }
  return notes;
}

void write_exodus(const std::filesystem::path& file, const MeshView& mesh) {
  Writer(file, mesh).write();
}

}  // namespace tetmend::formats
