// SPDX-License-Identifier: MIT
#include "mpi/hdf5_arrays.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "pieces/bytes.h"

namespace tetmend::mpi {

using pieces::KindArrays;
using pieces::Ranks;
using pieces::RowKind;

namespace {

constexpr const char* kTrueName = "name";  // an attribute

/// Of this rank, among the rows of all.
std::uint64_t first_row(std::uint64_t mine, Ranks& ranks) {
  std::string bytes;
  pieces::put(mine, bytes);
  const std::vector<std::string> all = ranks.gather(bytes);
  std::uint64_t first = 0;
  for (std::size_t r = 0; r < ranks.number(); ++r) {
    std::string_view rest = all[r];
    std::uint64_t theirs = 0;
    pieces::take(rest, theirs);
    first += theirs;
  }
  return first;
}

/// HDF5 takes '/' and "." for ways to go; readers of .xdmf cut at ':', and blanks at the ends.
bool can_be_table(const std::string& name) {
  const auto is_plain = [](unsigned char c) { return c > ' ' && c != '/' && c != ':' && c != 127; };
  return !name.empty() && name != "." && is_plain(static_cast<unsigned char>(name.front())) &&
         is_plain(static_cast<unsigned char>(name.back())) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return c == ' ' || is_plain(static_cast<unsigned char>(c)); });
}

/// An array of the type that holds the numbers of a table; nothing if there is none.
std::optional<DataArray::Values> values_for(hid_t set) {
  const Hdf5Handle type(H5Dget_type(set), H5Tclose);
  const std::size_t size = H5Tget_size(type);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind == H5T_FLOAT && size <= sizeof(float)) return std::vector<float>();
  if (kind == H5T_FLOAT && size == sizeof(double)) return std::vector<double>();
  if (kind != H5T_INTEGER) return std::nullopt;
  const bool has_sign = H5Tget_sign(type) == H5T_SGN_2;
  if (size < sizeof(std::int32_t) + (has_sign ? 1 : 0)) return std::vector<std::int32_t>();
  if (size < sizeof(std::int64_t) + (has_sign ? 1 : 0)) return std::vector<std::int64_t>();
  return std::nullopt;
}

/// What is in the attribute; else the name of the table.
std::string true_name(hid_t set, const std::string& table) {
  if (H5Aexists(set, kTrueName) <= 0) return table;
  const Hdf5Handle attribute(H5Aopen(set, kTrueName, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return table;
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute, type, static_cast<void*>(&text)) < 0 || text == nullptr) return table;
    std::string name = text;
    H5free_memory(text);
    return name;
  }
  std::string name(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, name.data()) < 0) return table;
  name.resize(std::min(name.find('\0'), name.size()));
  return name;
}

/// Without the name. Nothing for what is no table of so many rows.
std::optional<DataArray> read_table(const Hdf5File& file, const std::string& table,
                                    std::uint64_t rows) {
  const Hdf5Handle set(H5Dopen2(file.id(), table.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.is_open()) return std::nullopt;
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  std::array<hsize_t, 2> size = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2) return std::nullopt;
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  std::optional<DataArray::Values> values = values_for(set);
  if (!values || size[0] != rows || size[1] == 0) return std::nullopt;
  DataArray array;
  array.components = static_cast<std::size_t>(size[1]);
  std::visit(
      [&](auto& numbers) {
        using Number = typename std::decay_t<decltype(numbers)>::value_type;
        numbers = file.read<Number>(table, array.components);
      },
      *values);
  array.values = std::move(*values);
  return array;
}

Hdf5Handle make_group(const Hdf5File& file, const char* name) {
  const Hdf5Handle made(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(made, false);
  H5Pset_link_creation_order(made, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return {H5Gcreate2(file.id(), name, H5P_DEFAULT, made, H5P_DEFAULT), H5Gclose};
}

void write_true_name(const Hdf5File& file, const std::string& table, const std::string& name) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, name.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate_by_name(file.id(), table.c_str(), kTrueName, type, space,
                                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!attribute.is_open() || H5Awrite(attribute, type, name.c_str()) < 0) {
    file.fail("cannot be written");
  }
}

}  // namespace

const char* hdf5_group_of(RowKind kind) {
  constexpr std::array<const char*, 4> kGroups = {"point_data", "cell_data", "triangle_data",
                                                  "edge_data"};
  return kGroups[static_cast<std::size_t>(kind)];
}

std::vector<std::string> hdf5_table_names(const std::vector<DataArray>& arrays) {
  std::vector<std::string> names;
  const auto is_taken = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end() ||
           std::any_of(arrays.begin(), arrays.end(),
                       [&](const DataArray& array) { return array.name == name; });
  };
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const std::string& name = arrays[i].name;
    if (can_be_table(name) && std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
      continue;
    }
    std::string other = fmt::format("array-{}", i + 1);
    while (is_taken(other)) other += '-';
    names.push_back(std::move(other));
  }
  return names;
}

std::vector<std::string> hdf5_names_in(const Hdf5File& file, const std::string& group) {
  const Hdf5Handle opened(H5Gopen2(file.id(), group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!opened.is_open()) return {};
  const Hdf5Handle made(H5Gget_create_plist(opened), H5Pclose);
  unsigned order = 0;
  H5Pget_link_creation_order(made, &order);
  const H5_index_t index =
      (order & H5P_CRT_ORDER_TRACKED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  H5G_info_t info{};
  H5Gget_info(opened, &info);
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const ssize_t size =
        H5Lget_name_by_idx(opened, ".", index, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
    if (size <= 0) continue;
    std::string name(static_cast<std::size_t>(size) + 1, '\0');
    H5Lget_name_by_idx(opened, ".", index, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    names.push_back(std::move(name));
  }
  return names;
}

KindArrays read_hdf5_arrays(const Hdf5File& file, const Hdf5Counts& counts,
                            std::vector<std::string>& notes) {
  KindArrays arrays;
  for (const RowKind kind : pieces::kRowKinds) {
    const std::string group = hdf5_group_of(kind);
    for (const std::string& name : hdf5_names_in(file, group)) {
      const std::string table = fmt::format("{}/{}", group, name);
      std::optional<DataArray> array = read_table(file, table, counts[kind]);
      if (!array) {
        notes.push_back(fmt::format("/{} is not kept: it is no table of {} rows of numbers", table,
                                    counts[kind]));
        continue;
      }
      const Hdf5Handle set(H5Dopen2(file.id(), table.c_str(), H5P_DEFAULT), H5Dclose);
      array->name = true_name(set, name);
      arrays[kind].push_back(std::move(*array));
    }
  }
  return arrays;
}

void write_hdf5_arrays(const Hdf5File& file, const KindArrays& arrays, const Hdf5Counts& counts,
                       Ranks& ranks) {
  for (const RowKind kind : pieces::kRowKinds) {
    if (arrays[kind].empty() || counts[kind] == 0) continue;
    const char* const group = hdf5_group_of(kind);
    if (!make_group(file, group).is_open()) file.fail("cannot be written");
    const std::vector<std::string> names = hdf5_table_names(arrays[kind]);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const DataArray& array = arrays[kind][i];
      const std::string table = fmt::format("{}/{}", group, names[i]);
      const std::uint64_t begin = first_row(array.size() / array.components, ranks);
      std::visit(
          [&](const auto& numbers) {
            file.write(table, numbers, begin, counts[kind], array.components);
          },
          array.values);
      if (names[i] != array.name) write_true_name(file, table, array.name);
    }
  }
}

}  // namespace tetmend::mpi
