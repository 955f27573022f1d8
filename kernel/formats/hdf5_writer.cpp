// SPDX-License-Identifier: MIT
// Makes files of HDF5 in memory, and provides the HDF5 of a program.
#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/hdf5_handle.h"

namespace tetmend::formats {
namespace {

/// Groups know in which order they were filled, for MED asks for the n-th of what they hold.
constexpr unsigned kInOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

class MemoryWriter final : public Hdf5Writer {
 public:
  explicit MemoryWriter(std::string name)
      : turn_(name),
        name_(std::move(name)),
        in_order_(H5Pcreate(H5P_GROUP_CREATE), H5Pclose),
        file_(std::in_place, create(), H5Fclose) {
    H5Pset_obj_track_times(in_order_, false);
    H5Pset_link_creation_order(in_order_, kInOrder);
    check(file_->is_open());
  }

  void group(const std::string& path) override {
    for (std::size_t end = 0; end != std::string::npos;) {
      end = path.find('/', end + 1);
      const std::string part = path.substr(0, end);
      if (H5Lexists(*file_, part.c_str(), H5P_DEFAULT) > 0) continue;
      const Hdf5Handle made(H5Gcreate2(*file_, part.c_str(), H5P_DEFAULT, in_order_, H5P_DEFAULT),
                            H5Gclose);
      check(made.is_open());
    }
  }

  void write(const std::string& path, const DataArray::Values& values,
             std::size_t columns) override {
    std::visit(
        [&](const auto& numbers) {
          using Number = typename std::decay_t<decltype(numbers)>::value_type;
          const std::array<hsize_t, 2> extents = {
              numbers.size() / std::max<std::size_t>(columns, 1), columns};
          const Hdf5Handle space(H5Screate_simple(columns == 0 ? 1 : 2, extents.data(), nullptr),
                                 H5Sclose);
          write_table(path, hdf5_type<Number>(), space, numbers.data(), numbers.empty());
        },
        values);
  }

  void write_texts(const std::string& path, const std::vector<std::string>& texts,
                   std::size_t width) override {
    std::string all;
    for (const std::string& text : texts) {
      all += text.substr(0, width);
      all.append(width - std::min(width, text.size()), '\0');
    }
    const hsize_t columns = width;
    const hsize_t rows = texts.size();
    const Hdf5Handle type(H5Tarray_create2(H5T_NATIVE_SCHAR, 1, &columns), H5Tclose);
    const Hdf5Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
    write_table(path, type, space, all.data(), all.empty());
  }

  void write_characters(const std::string& path, const std::string& text) override {
    const hsize_t size = text.size();
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    write_table(path, H5T_NATIVE_SCHAR, space, text.data(), text.empty());
  }

  void set(const std::string& path, const char* attribute, const Attribute& value) override {
    const Hdf5Handle one(H5Screate(H5S_SCALAR), H5Sclose);
    if (const auto* text = std::get_if<std::string>(&value)) {
      const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
      H5Tset_size(type, text->size() + 1);
      return write_attribute(path, attribute, type, one, text->c_str());
    }
    if (const auto* number = std::get_if<std::int32_t>(&value)) {
      return write_attribute(path, attribute, H5T_NATIVE_INT32, one, number);
    }
    write_attribute(path, attribute, H5T_NATIVE_DOUBLE, one, &std::get<double>(value));
  }

  std::string bytes() override {
    check(H5Fflush(*file_, H5F_SCOPE_GLOBAL) >= 0);
    const ssize_t size = H5Fget_file_image(*file_, nullptr, 0);
    check(size >= 0);
    std::string all(static_cast<std::size_t>(size), '\0');
    check(H5Fget_file_image(*file_, all.data(), all.size()) == size);
    file_.reset();
    return all;
  }

 private:
  static hid_t create() {
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, std::size_t{1} << 24, false);
    const Hdf5Handle made(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(made, false);
    H5Pset_link_creation_order(made, kInOrder);
    return H5Fcreate(kInMemory, H5F_ACC_TRUNC, made, access);
  }

  /// In memory nothing but memory can fail.
  void check(bool done) const {
    if (!done) throw Error(fmt::format("{}: cannot be written: not enough memory", name_));
  }

  void write_table(const std::string& path, hid_t type, hid_t space, const void* from,
                   bool is_empty) {
    const Hdf5Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(made, false);
    H5Pset_fill_time(made, H5D_FILL_TIME_NEVER);
    if (path.find('/') != std::string::npos) group(path.substr(0, path.rfind('/')));
    const Hdf5Handle set(
        H5Dcreate2(*file_, path.c_str(), type, space, H5P_DEFAULT, made, H5P_DEFAULT), H5Dclose);
    check(set.is_open());
    check(is_empty || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, from) >= 0);
  }

  void write_attribute(const std::string& path, const char* attribute, hid_t type, hid_t space,
                       const void* from) {
    const Hdf5Handle made(H5Acreate_by_name(*file_, path.c_str(), attribute, type, space,
                                            H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
    check(made.is_open() && H5Awrite(made, type, from) >= 0);
  }

  Hdf5Turn turn_;
  std::string name_;
  Hdf5Handle in_order_;  // how groups are made
  std::optional<Hdf5Handle> file_;
};

[[maybe_unused]] const bool kIsProvided = [] {
  static constexpr Hdf5Driver kDriver = {
      .open = open_in_memory, .make = [](std::string name) -> std::unique_ptr<Hdf5Writer> {
        return std::make_unique<MemoryWriter>(std::move(name));
      }};
  provide_hdf5(kDriver);
  return true;
}();

}  // namespace

}  // namespace tetmend::formats
