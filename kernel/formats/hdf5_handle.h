// SPDX-License-Identifier: MIT
// Objects of HDF5 that close themselves, the types of numbers that memory has, whose turn it is.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include <hdf5.h>

#include "kernel/formats/hdf5_file.h"
#ifdef TETMEND_LOADS_HDF5  // its library by that name; else a program is linked with one
#include "kernel/formats/hdf5_calls.h"
#endif

namespace tetmend::formats {

/// An object of HDF5, which is closed by its own function.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// As memory has a number.
template <class Number>
hid_t hdf5_type();
template <>
inline hid_t hdf5_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
inline hid_t hdf5_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t hdf5_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t hdf5_type<double>() {
  return H5T_NATIVE_DOUBLE;
}

/// HDF5 as Debian builds it is for one thread at a time; and what goes wrong is told by us.
class Hdf5Turn {
 public:
  /// For a file of this name.
  explicit Hdf5Turn([[maybe_unused]] const std::string& file) : lock_(mutex()) {
#ifdef TETMEND_LOADS_HDF5
    load_hdf5(file);
#endif
    H5Eget_auto2(H5E_DEFAULT, &print_, &to_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Turn() {
    H5Eset_auto2(H5E_DEFAULT, print_, to_);
  }
  Hdf5Turn(const Hdf5Turn&) = delete;
  Hdf5Turn& operator=(const Hdf5Turn&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex only;
    return only;
  }

  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* to_ = nullptr;
};

/// A name that no file can have, for HDF5 wants to know that there is none.
inline constexpr const char* kInMemory = "/dev/null/hdf5";

/// See open_hdf5().
std::unique_ptr<Hdf5Reader> open_in_memory(const InputFile& file, std::string_view format);

}  // namespace tetmend::formats
