// SPDX-License-Identifier: MIT
// Reads files of HDF5 in memory.
#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/hdf5_handle.h"

namespace tetmend::formats {
namespace {

/// What zlib packs best, and a little room: a table unpacks to no more times the bytes of the file.
constexpr std::uint64_t kMostUnpacked = 1100;

class MemoryReader final : public Hdf5Reader {
 public:
  MemoryReader(const InputFile& input, std::string_view format)
      : Hdf5Reader(input), turn_(input.name()), input_(input), file_(open(input), H5Fclose) {
    if (input.size() == 0) {
      input.fail_at_byte(input.begin(), "the file is empty: expected a file of HDF5");
    }
    if (file_.is_open()) return;
    throw Error(
        fmt::format("{}: the file cannot be read as one of HDF5, as {} files are: it is of "
                    "another format, or truncated",
                    input.name(), format));
  }

  bool has(const std::string& path) const override {
    if (path == "/") return true;
    for (std::size_t end = 0; end != std::string::npos;) {
      end = path.find('/', end + 1);
      const std::string part = path.substr(0, end);
      H5L_info_t link;
      const bool is_here = H5Lexists(file_, part.c_str(), H5P_DEFAULT) > 0 &&
                           H5Lget_info(file_, part.c_str(), &link, H5P_DEFAULT) >= 0;
      if (!is_here || link.type != H5L_TYPE_HARD) return false;
    }
    return true;
  }

  std::vector<std::string> names(const std::string& path) const override {
    check_is_there(path);
    const Hdf5Handle group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), H5Gclose);
    if (!group.is_open()) fail(path, "the group cannot be read");
    std::vector<std::string> found;
    hsize_t at = 0;
    const auto take = [](hid_t, const char* name, const H5L_info_t* link, void* list) -> herr_t {
      try {
        if (link->type == H5L_TYPE_HARD) {
          static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        }
        return 0;
      } catch (const std::bad_alloc&) {
        return -1;
      }
    };
    if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, &at, take, &found) < 0) {
      fail(path, "the group cannot be read");
    }
    return found;
  }

  std::vector<std::uint64_t> extents(const std::string& path) const override {
    const Table table = open_table(path);
    return {table.extents.begin(), table.extents.end()};
  }

  DataArray::Values values(const std::string& path) const override {
    return values(path, open_table(path));
  }
  DataArray::Values row(const std::string& path, std::uint64_t number) const override {
    Table table = open_table(path);
    table.row = number;
    table.count /= static_cast<std::size_t>(table.extents[0]);
    return values(path, table);
  }
  std::vector<std::int64_t> integers(const std::string& path) const override {
    const Table table = open_table(path);
    const Hdf5Handle type(H5Dget_type(table.set), H5Tclose);
    if (H5Tget_class(type) != H5T_INTEGER) fail(path, "the table holds no integers");
    return numbers<std::int64_t>(path, table);
  }
  std::vector<double> reals(const std::string& path) const override {
    return numbers<double>(path, open_table(path));
  }

  std::vector<std::string> texts(const std::string& path) const override {
    const Table table = open_table(path);
    const Hdf5Handle type(H5Dget_type(table.set), H5Tclose);
    std::size_t width = H5Tget_size(type);
    if (H5Tget_class(type) == H5T_ARRAY) {
      const Hdf5Handle inner(H5Tget_super(type), H5Tclose);
      if (H5Tget_size(inner) != 1) width = 0;
    } else if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) {
      if (width != 1) width = 0;
    }
    if (width == 0) fail(path, "the table holds no texts");
    take(path, table.count * width / 8);
    std::string all(table.count * width, '\0');
    if (!all.empty() && H5Dread(table.set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) < 0) {
      fail(path, "the table cannot be read");
    }
    const bool is_row = H5Tget_class(type) == H5T_INTEGER || table.extents.size() > 1;
    if (width == 1 && is_row) width = static_cast<std::size_t>(table.extents.back());
    return text_rows(all, width);
  }

  bool has(const std::string& path, const char* attribute) const override {
    return has(path) && H5Aexists_by_name(file_, path.c_str(), attribute, H5P_DEFAULT) > 0;
  }
  std::int64_t integer(const std::string& path, const char* attribute) const override {
    return number<std::int64_t>(path, attribute);
  }
  double real(const std::string& path, const char* attribute) const override {
    return number<double>(path, attribute);
  }
  std::string text(const std::string& path, const char* attribute) const override {
    if (!has(path, attribute)) return {};
    const Hdf5Handle opened = open_attribute(path, attribute);
    const Hdf5Handle type(H5Aget_type(opened), H5Tclose);
    const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
    const bool is_null = H5Sget_simple_extent_type(space) == H5S_NULL;
    if (H5Tget_class(type) != H5T_STRING || is_null) return {};
    if (H5Sget_simple_extent_npoints(space) != 1) fail_attribute(path, attribute);
    std::string found;
    if (H5Tis_variable_str(type) > 0) {
      char* text = nullptr;
      if (H5Aread(opened, type, static_cast<void*>(&text)) < 0) fail_attribute(path, attribute);
      if (text != nullptr) found = text;
      H5free_memory(text);
      return found;
    }
    const std::size_t size = H5Tget_size(type);
    if (size > input_.size()) fail_attribute(path, attribute);
    found.resize(size);
    if (H5Aread(opened, type, found.data()) < 0) fail_attribute(path, attribute);
    found.resize(std::min(found.find('\0'), found.size()));
    return found;
  }

 private:
  struct Table {
    Hdf5Handle set;
    std::vector<hsize_t> extents;
    std::size_t count;                // of numbers
    std::optional<hsize_t> row = {};  // all if there is none
  };

  static hid_t open(const InputFile& input) {
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (input.size() == 0 || H5Pset_fapl_core(access, std::size_t{1} << 16, false) < 0) return -1;
    if (H5Pset_file_image(access, const_cast<char*>(input.begin()), input.size()) < 0) {
      throw std::bad_alloc();
    }
    return H5Fopen(kInMemory, H5F_ACC_RDONLY, access);
  }

  void check_is_there(const std::string& path) const {
    if (!has(path)) fail(path, "it is not there, or a link to elsewhere");
  }

  Table open_table(const std::string& path) const {
    check_is_there(path);
    const hid_t set = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    Table table{{set, H5Dclose}, {}, 0};
    if (set < 0) fail(path, "it is no table that can be read");
    const Hdf5Handle space(H5Dget_space(set), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 3) fail(path, "the table has another form than expected");
    table.extents.resize(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space, table.extents.data(), nullptr);
    const Hdf5Handle type(H5Dget_type(set), H5Tclose);
    check_room(path, table, std::max<std::size_t>(H5Tget_size(type), 1));
    return table;
  }

  /// Refuses a table that the file cannot hold, and one that lies in other files.
  void check_room(const std::string& path, Table& table, std::uint64_t bytes_each) const {
    const Hdf5Handle made(H5Dget_create_plist(table.set), H5Pclose);
    const H5D_layout_t layout = H5Pget_layout(made);
    if (H5Pget_external_count(made) > 0 || layout == H5D_VIRTUAL) {
      fail(path, "the table lies in other files");
    }
    const bool is_packed = layout == H5D_CHUNKED;
    const std::uint64_t stored =
        std::min<std::uint64_t>(H5Dget_storage_size(table.set), input_.size());
    // Where nothing is stored all numbers have the value that was agreed on for these.
    const std::uint64_t of_bytes = stored == 0 ? input_.size()
                                   : is_packed ? stored * kMostUnpacked
                                               : stored;
    std::uint64_t room = of_bytes / bytes_each;
    table.count = 1;
    if (std::find(table.extents.begin(), table.extents.end(), 0) != table.extents.end()) {
      table.count = 0;
      return;
    }
    for (const hsize_t extent : table.extents) {
      if (extent > 0 && extent > room) {
        fail(path, fmt::format("{} rows or columns cannot fit into the {} bytes that are stored",
                               extent, stored));
      }
      room = extent == 0 ? room : room / extent;
      table.count *= static_cast<std::size_t>(extent);
    }
  }

  DataArray::Values values(const std::string& path, const Table& table) const {
    const Hdf5Handle type(H5Dget_type(table.set), H5Tclose);
    const std::size_t size = H5Tget_size(type);
    const bool has_sign = H5Tget_sign(type) == H5T_SGN_2;
    if (H5Tget_class(type) == H5T_INTEGER) {
      if (size < 4 + (has_sign ? 1U : 0U)) return numbers<std::int32_t>(path, table);
      if (size < 8 + (has_sign ? 1U : 0U)) return numbers<std::int64_t>(path, table);
    }
    if (H5Tget_class(type) == H5T_FLOAT && size <= 4) return numbers<float>(path, table);
    return numbers<double>(path, table);
  }

  template <class Number>
  std::vector<Number> numbers(const std::string& path, const Table& table) const {
    const Hdf5Handle type(H5Dget_type(table.set), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && kind != H5T_FLOAT) fail(path, "the table holds no numbers");
    take(path, table.count);
    std::vector<Number> all(table.count);
    if (all.empty()) return all;
    const Hdf5Handle from(H5Dget_space(table.set), H5Sclose);
    const hsize_t size = all.size();
    const Hdf5Handle to(H5Screate_simple(1, &size, nullptr), H5Sclose);
    if (table.row) {
      std::vector<hsize_t> begin(table.extents.size(), 0);
      std::vector<hsize_t> counts = table.extents;
      begin[0] = *table.row;
      counts[0] = 1;
      H5Sselect_hyperslab(from, H5S_SELECT_SET, begin.data(), nullptr, counts.data(), nullptr);
    }
    if (H5Dread(table.set, hdf5_type<Number>(), to, from, H5P_DEFAULT, all.data()) < 0) {
      fail(path, "the table cannot be read");
    }
    return all;
  }

  Hdf5Handle open_attribute(const std::string& path, const char* attribute) const {
    check_is_there(path);
    return {H5Aopen_by_name(file_, path.c_str(), attribute, H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
  }
  template <class Number>
  Number number(const std::string& path, const char* attribute) const {
    const Hdf5Handle opened = open_attribute(path, attribute);
    const Hdf5Handle type(H5Aget_type(opened), H5Tclose);
    const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
    const H5T_class_t kind = H5Tget_class(type);
    Number value{};
    if (!opened.is_open() || (kind != H5T_INTEGER && kind != H5T_FLOAT) ||
        H5Sget_simple_extent_npoints(space) != 1 ||
        H5Aread(opened, hdf5_type<Number>(), &value) < 0) {
      fail_attribute(path, attribute);
    }
    return value;
  }
  [[noreturn]] void fail_attribute(const std::string& path, const char* attribute) const {
    fail(path, fmt::format("the attribute {} is not there, or no value", attribute));
  }

  Hdf5Turn turn_;
  const InputFile& input_;
  Hdf5Handle file_;
};

}  // namespace

std::unique_ptr<Hdf5Reader> open_in_memory(const InputFile& file, std::string_view format) {
  return std::make_unique<MemoryReader>(file, format);
}

}  // namespace tetmend::formats
