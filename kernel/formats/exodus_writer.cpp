// SPDX-License-Identifier: MIT
// Writes files of Exodus II.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
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

class ExodusWriter {
 public:
  ExodusWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file), mesh_(mesh), lists_(mesh), plan_(mesh, lists_) {}

  void write() {
    collect_variables();
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
          std::pair("maximum_name_length", static_cast<int>(longest_name())),
          std::pair("int64_status", 0)})
      file_.attribute(name, one(value));
    const std::vector<std::string> titles = exodus_pieces(mesh_.data(), "title");
    file_.attribute("title", titles.empty() ? std::string("mesh") : titles[0]);
    file_.dimension("time_step", 0);
    file_.dimension("len_string", 33);
    file_.dimension("len_name", longest_name() + 1);
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
    if (!times.empty() || !of_points_.names().empty() || !of_elements_.names().empty()) {
      file_.add("time_whole", {"time_step"}, std::vector<double>{time});
    }
  }
  /// At least as many bytes as all programs have room for.
  std::size_t longest_name() const {
    std::size_t longest = kShortExodusName;
    const auto look = [&](const std::string& name) { longest = std::max(longest, name.size()); };
    for (const auto& block : plan_.blocks) look(block.set.name);
    for (const auto& set : plan_.node_sets) look(set.name);
    for (const auto* sets : {&plan_.side_sets, &plan_.element_sets}) {
      for (const auto& [set, members] : *sets) look(set.name);
    }
    for (const auto* variables : {&of_points_, &of_elements_})
      std::for_each(variables->names().begin(), variables->names().end(), look);
    return longest;
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
    const auto has_numbers = [](const ElementList& list) {
      return list.kind.dimension == 3 && list.numbers != nullptr &&
             std::any_of(list.numbers->begin(), list.numbers->end(),
                         [](std::int64_t number) { return number > 0; });
    };
    if (std::none_of(lists_.all().begin(), lists_.all().end(), has_numbers)) return;
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

  void collect_variables() {
    if (mesh_.data() == nullptr) return;
    of_points_.add(mesh_.data()->point_data);
    for (const ExodusPlan::Block& block : plan_.blocks) {
      if (has_variables(*block.list)) of_elements_.add(*block.list->data);
    }
  }
  static bool has_variables(const ElementList& list) {
    return list.kind.dimension != 2 && list.data != nullptr;
  }

  void write_variables() {
    if (!of_points_.names().empty()) {
      write_names("num_nod_var", "name_nod_var", of_points_.names());
      std::size_t written = 0;
      for (const DataArray& array : mesh_.data()->point_data) {
        for (std::size_t c = 0; c < array.components; ++c) {
          file_.add(fmt::format("vals_nod_var{}", ++written), {"time_step", "num_nodes"},
                    as_reals(component_values(array, c)));
        }
      }
    }
    if (of_elements_.names().empty()) return;
    write_names("num_elem_var", "name_elem_var", of_elements_.names());
    std::vector<std::int32_t> there(plan_.blocks.size() * of_elements_.names().size(), 0);
    for (std::size_t b = 0; b < plan_.blocks.size(); ++b) {
      if (has_variables(*plan_.blocks[b].list)) write_variables_of_block(b, there);
    }
    file_.add("elem_var_tab", {"num_el_blk", "num_elem_var"}, std::move(there));
  }

  void write_names(const std::string& count, const std::string& table,
                   const std::vector<std::string>& names) {
    file_.dimension(count, names.size());
    file_.add_texts(table, {count, "len_name"}, names);
  }

  void write_variables_of_block(std::size_t b, std::vector<std::int32_t>& there) {
    const std::vector<DataArray>& arrays = *plan_.blocks[b].list->data;
    for (std::size_t a = 0; a < arrays.size(); ++a) {
      for (std::size_t c = 0; c < arrays[a].components; ++c) {
        const std::size_t k = of_elements_.first(arrays, a) + c;
        there[b * of_elements_.names().size() + k] = 1;
        file_.add(fmt::format("vals_elem_var{}eb{}", k + 1, b + 1),
                  {"time_step", fmt::format("num_el_in_blk{}", b + 1)},
                  values_of(arrays[a], c, plan_.blocks[b].elements));
      }
    }
  }
  static std::vector<double> as_reals(const DataArray::Values& values) {
    return std::visit([](const auto& all) { return std::vector<double>(all.begin(), all.end()); },
                      values);
  }
  static std::vector<double> values_of(const DataArray& array, std::size_t component,
                                       const std::vector<std::uint32_t>& elements) {
    std::vector<double> all;
    all.reserve(elements.size());
    std::visit(
        [&](const auto& values) {
          for (const std::uint32_t i : elements)
            all.push_back(static_cast<double>(values[i * array.components + component]));
        },
        array.values);
    return all;
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
  ExodusVariables of_points_, of_elements_;
};

/// Integers that doubles do not have.
void note_rounded(const std::vector<DataArray>& arrays, std::vector<std::string>& notes) {
  for (const DataArray& array : arrays) {
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

/// Only where elements of several kinds may share one is it worth to plan the file: sides and shells
/// are both triangles.
void note_new_labels(const MeshData& mesh, std::vector<std::string>& notes) {
  const MeshView view(mesh);
  const ElementLists lists(view);
  std::map<Label, std::size_t> list_of;
  bool is_shared = false;
  for (std::size_t k = 0; k < lists.all().size(); ++k) {
    const ElementList& list = lists.all()[k];
    is_shared = is_shared || list.kind.dimension == 2;
    std::optional<Label> last;
    for (std::size_t i = 0; i < list.count; ++i) {
      const Label label = list.label(i);
      if (label == last) continue;
      last = label;
      is_shared = is_shared || label < 0 || list_of.try_emplace(label, k).first->second != k;
    }
  }
  if (!is_shared) return;
  const auto [count, first] = ExodusPlan(view, lists).new_labels();
  if (count == 0) return;
  notes.push_back(fmt::format(
      "{} labels change, for .e has a number for each block of one kind: {}", count, first));
}

}  // namespace

std::vector<std::string> not_in_exodus(const std::filesystem::path&, const MeshData& mesh) {
  std::vector<std::string> notes;
  const auto look = [&](const std::vector<DataArray>& arrays) {
    note_component_arrays(arrays, kExodusAxes, UniqueNames(kExodusNames), ".e", notes);
    note_rounded(arrays, notes);
  };
  for (const auto* arrays : {&mesh.point_data, &mesh.tet_data, &mesh.edge_data}) look(*arrays);
  for (const OtherElements& others : mesh.other_elements) {
    const ElementKind* kind = element_kind(others.vtk_type);
    if (kind != nullptr && kind->dimension != 2) look(others.data);
  }
  for (const Group& group : mesh.groups) {
    if (group.dimension != 0 || !group.members.empty()) continue;
    notes.push_back(fmt::format("the group '{}' of no points is not kept: .e has no empty set",
                                printable(group.name)));
  }
  note_new_labels(mesh, notes);
  return notes;
}

void write_exodus(const std::filesystem::path& file, const MeshView& mesh) {
  ExodusWriter(file, mesh).write();
}

}  // namespace tetmend::formats
