// SPDX-License-Identifier: MIT
// Reads variables and texts of Exodus II.
#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/exodus_tables.h"
#include "kernel/formats/input_file.h"

namespace tetmend::formats {
namespace {

std::vector<DataArray>* data_of(MeshData& mesh, const ElementKind& kind) {
  if (kind.vtk_type == vtk_tet) return &mesh.tet_data;
  if (kind.vtk_type == vtk_edge) return &mesh.edge_data;
  for (OtherElements& others : mesh.other_elements) {
    if (others.vtk_type == kind.vtk_type) return &others.data;
  }
  return nullptr;
}

class VariableReader {
 public:
  VariableReader(const Hdf5Reader& file, MeshData& mesh, std::set<std::string>& known)
      : file_(file), mesh_(mesh), known_(known) {}

  void read_of_points() {
    const std::vector<std::string> names = names_in("name_nod_var");
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string path = find(fmt::format("vals_nod_var{}", k + 1));
      DataArray array{names[k], 1, {}};
      const std::size_t count = mesh_.points.size();
      if (has_no_step_) continue;
      if (!path.empty()) {
        array.values = first_step(path, count, 0);
      } else if (const std::string all = find("vals_nod_var"); !all.empty()) {
        array.values = first_step(all, count, k * count);
      } else {
        note(names[k], "points");
        continue;
      }
      if (count > 0) mesh_.point_data.push_back(std::move(array));
    }
  }

  /// Of volumes and edges: triangles are those of side sets, too, which have no values.
  void read_of_elements(std::span<const ExodusBlock> blocks) {
    const std::vector<std::string> names = names_in("name_elem_var");
    for (std::size_t k = 0; k < names.size(); ++k) {
      for (const ElementKind& kind : kElementKinds) read_of_kind(blocks, kind, names[k], k);
    }
  }

 private:
  std::vector<std::string> names_in(const std::string& path) {
    return find(path).empty() ? std::vector<std::string>() : file_.texts(path);
  }
  /// Empty: it is not there.
  std::string find(const std::string& path) {
    known_.insert(path);
    if (!file_.has(path)) return {};
    const auto extents = file_.extents(path);
    if (std::find(extents.begin(), extents.end(), 0) == extents.end()) return path;
    if (path.starts_with("vals_") && !std::exchange(has_no_step_, true))
      mesh_.notes.emplace_back("the variables are not kept: they have no step");
    return {};
  }
  void note(const std::string& name, std::string_view of) {
    mesh_.notes.push_back(
        fmt::format("the variable {} of {} is not kept: not all have it", in_quotes(name), of));
  }

  DataArray::Values first_step(const std::string& path, std::size_t count, std::size_t first) {
    const bool has_steps = file_.extents(path).size() > 1;
    DataArray::Values values = has_steps ? file_.row(path, 0) : file_.values(path);
    std::visit(
        [&](auto& numbers) {
          if (numbers.size() < first + count) {
            file_.fail(path, fmt::format("the table has {} values: expected at least {}",
                                         numbers.size(), first + count));
          }
          numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(first + count),
                        numbers.end());
          numbers.erase(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(first));
        },
        values);
    return values;
  }

  void read_of_kind(std::span<const ExodusBlock> blocks, const ElementKind& kind,
                    const std::string& name, std::size_t k) {
    std::vector<double> all;
    bool is_somewhere = false;
    bool is_everywhere = true;
    for (const ExodusBlock& block : blocks) {
      if (block.kind == nullptr || block.kind->vtk_type != kind.vtk_type || block.count == 0)
        continue;
      const std::string path = find(fmt::format("vals_elem_var{}eb{}", k + 1, block.index));
      is_somewhere = is_somewhere || !path.empty();
      is_everywhere = is_everywhere && !path.empty();
      if (!is_everywhere) continue;
      const DataArray::Values values = first_step(path, block.count, 0);
      std::visit([&](const auto& from) { all.insert(all.end(), from.begin(), from.end()); },
                 values);
    }
    std::vector<DataArray>* to = data_of(mesh_, kind);
    if (!is_somewhere || has_no_step_) return;
    if (kind.dimension == 2 || !is_everywhere || to == nullptr) return note(name, kind.name);
    to->push_back({name, 1, std::move(all)});
  }

  const Hdf5Reader& file_;
  MeshData& mesh_;
  std::set<std::string>& known_;
  bool has_no_step_ = false;
};

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + '\n';
  return all;
}

/// Dimensions, which are tables in files of HDF5, and tables that say nothing new of a mesh.
bool says_nothing(std::string_view name) {
  for (const std::string_view begin :
       {"num_", "len_", "time_step", "four", "eb_status", "ns_status", "ss_status", "els_status",
        "elem_map", "coor_names", "elem_var_tab", "name_coor"}) {
    if (name.starts_with(begin)) return true;
  }
  return false;
}

}  // namespace

void read_exodus_variables(const Hdf5Reader& file, std::span<const ExodusBlock> blocks,
                           MeshData& mesh, std::set<std::string>& known) {
  VariableReader reader(file, mesh, known);
  reader.read_of_points();
  reader.read_of_elements(blocks);
  for (auto* arrays : {&mesh.point_data, &mesh.tet_data, &mesh.edge_data})
    join_components(*arrays, kExodusAxes);
  for (OtherElements& others : mesh.other_elements) join_components(others.data, kExodusAxes);
}

void note_exodus_rest(const Hdf5Reader& file, MeshData& mesh, std::set<std::string>& known) {
  const auto keep = [&](const char* what, const std::string& text) {
    if (!text.empty()) mesh.deck.push_back(what + std::string(1, '\0') + text);
  };
  keep("title", file.text("/", "title"));
  for (const auto& [path, what] :
       {std::pair("qa_records", "qa"), std::pair("info_records", "info")}) {
    known.insert(path);
    if (file.has(path)) keep(what, joined(file.texts(path)));
  }
  known.insert("time_whole");
  if (const auto times = file.has("time_whole") ? file.reals("time_whole") : std::vector<double>();
      !times.empty()) {
    keep("time", fmt::format("{}", times[0]));
    if (times.size() > 1) {
      mesh.notes.push_back(
          fmt::format("of the {} steps of variables only the first is kept", times.size()));
    }
  }
  std::set<std::string> rest;
  for (std::string name : file.names("/")) {
    if (known.contains(name) || says_nothing(name)) continue;
    if (file.text(name, "NAME").starts_with("This is a netCDF dimension")) continue;
    name.resize(name.find_last_not_of("0123456789") + 1);
    if (rest.insert(name).second) {
      mesh.notes.push_back(fmt::format("the tables {} are not kept", in_quotes(name)));
    }
  }
}

}  // namespace tetmend::formats
