// SPDX-License-Identifier: MIT
// The functions and numbers of HDF5 by their own names, found in its library when a file of HDF5 is met. Linked
// with it, a program would load it and the 30 libraries that it needs whenever it starts.
#pragma once

#include <string>

#include <hdf5.h>

namespace tetmend::formats {

/// Loads the library, for a file of this name. @throws Error where it is not installed
void load_hdf5(const std::string& file);
/// The address of a name of HDF5. Precondition for it and what follows: load_hdf5(), and a Hdf5Turn.
void* find_in_hdf5(const char* name);

/// A function, found when it is called first.
template <class Function>
class Hdf5Call;
template <class Result, class... Arguments>
class Hdf5Call<Result (*)(Arguments...)> {
 public:
  using Function = Result (*)(Arguments...);
  explicit constexpr Hdf5Call(const char* name) : name_(name) {}
  Result operator()(Arguments... arguments) const { return Function(*this)(arguments...); }
  operator Function() const {
    if (found_ == nullptr) found_ = reinterpret_cast<Function>(find_in_hdf5(name_));
    return found_;
  }

 private:
  const char* name_;
  mutable Function found_ = nullptr;
};

/// A number that the library has once it is open.
class Hdf5Number {
 public:
  explicit constexpr Hdf5Number(const char* name) : name_(name) {}
  operator hid_t() const { return *static_cast<const hid_t*>(find_in_hdf5(name_)); }

 private:
  const char* name_;
};

// Within this namespace they hide those that <hdf5.h> declares, also for its macros.
#define TETMEND_HDF5_CALL(name) \
  inline const Hdf5Call<decltype(&::name)> name(TETMEND_HDF5_TEXT(name));
#define TETMEND_HDF5_TEXT(name) #name
TETMEND_HDF5_CALL(H5open)
TETMEND_HDF5_CALL(H5check_version)
TETMEND_HDF5_CALL(H5free_memory)
TETMEND_HDF5_CALL(H5Aclose)
TETMEND_HDF5_CALL(H5Acreate_by_name)
TETMEND_HDF5_CALL(H5Aexists_by_name)
TETMEND_HDF5_CALL(H5Aget_space)
TETMEND_HDF5_CALL(H5Aget_type)
TETMEND_HDF5_CALL(H5Aopen_by_name)
TETMEND_HDF5_CALL(H5Aread)
TETMEND_HDF5_CALL(H5Awrite)
TETMEND_HDF5_CALL(H5Dclose)
TETMEND_HDF5_CALL(H5Dcreate2)
TETMEND_HDF5_CALL(H5Dget_create_plist)
TETMEND_HDF5_CALL(H5Dget_space)
TETMEND_HDF5_CALL(H5Dget_storage_size)
TETMEND_HDF5_CALL(H5Dget_type)
TETMEND_HDF5_CALL(H5Dopen2)
TETMEND_HDF5_CALL(H5Dread)
TETMEND_HDF5_CALL(H5Dwrite)
TETMEND_HDF5_CALL(H5Eget_auto2)
TETMEND_HDF5_CALL(H5Eset_auto2)
TETMEND_HDF5_CALL(H5Fclose)
TETMEND_HDF5_CALL(H5Fcreate)
TETMEND_HDF5_CALL(H5Fflush)
TETMEND_HDF5_CALL(H5Fget_file_image)
TETMEND_HDF5_CALL(H5Fopen)
TETMEND_HDF5_CALL(H5Gclose)
TETMEND_HDF5_CALL(H5Gcreate2)
TETMEND_HDF5_CALL(H5Gopen2)
TETMEND_HDF5_CALL(H5Lexists)
TETMEND_HDF5_CALL(H5Lget_info)
TETMEND_HDF5_CALL(H5Literate)
TETMEND_HDF5_CALL(H5Pclose)
TETMEND_HDF5_CALL(H5Pcreate)
TETMEND_HDF5_CALL(H5Pget_external_count)
TETMEND_HDF5_CALL(H5Pget_layout)
TETMEND_HDF5_CALL(H5Pset_fapl_core)
TETMEND_HDF5_CALL(H5Pset_file_image)
TETMEND_HDF5_CALL(H5Pset_fill_time)
TETMEND_HDF5_CALL(H5Pset_link_creation_order)
TETMEND_HDF5_CALL(H5Pset_obj_track_times)
TETMEND_HDF5_CALL(H5Sclose)
TETMEND_HDF5_CALL(H5Screate)
TETMEND_HDF5_CALL(H5Screate_simple)
TETMEND_HDF5_CALL(H5Sget_simple_extent_dims)
TETMEND_HDF5_CALL(H5Sget_simple_extent_ndims)
TETMEND_HDF5_CALL(H5Sget_simple_extent_npoints)
TETMEND_HDF5_CALL(H5Sget_simple_extent_type)
TETMEND_HDF5_CALL(H5Sselect_hyperslab)
TETMEND_HDF5_CALL(H5Tarray_create2)
TETMEND_HDF5_CALL(H5Tclose)
TETMEND_HDF5_CALL(H5Tcopy)
TETMEND_HDF5_CALL(H5Tget_class)
TETMEND_HDF5_CALL(H5Tget_sign)
TETMEND_HDF5_CALL(H5Tget_size)
TETMEND_HDF5_CALL(H5Tget_super)
TETMEND_HDF5_CALL(H5Tis_variable_str)
TETMEND_HDF5_CALL(H5Tset_size)
#undef TETMEND_HDF5_CALL
#define TETMEND_HDF5_NUMBER(name) inline constexpr Hdf5Number name(#name);
TETMEND_HDF5_NUMBER(H5P_CLS_DATASET_CREATE_ID_g)
TETMEND_HDF5_NUMBER(H5P_CLS_FILE_ACCESS_ID_g)
TETMEND_HDF5_NUMBER(H5P_CLS_FILE_CREATE_ID_g)
TETMEND_HDF5_NUMBER(H5P_CLS_GROUP_CREATE_ID_g)
TETMEND_HDF5_NUMBER(H5T_C_S1_g)
TETMEND_HDF5_NUMBER(H5T_NATIVE_DOUBLE_g)
TETMEND_HDF5_NUMBER(H5T_NATIVE_FLOAT_g)
TETMEND_HDF5_NUMBER(H5T_NATIVE_INT32_g)
TETMEND_HDF5_NUMBER(H5T_NATIVE_INT64_g)
TETMEND_HDF5_NUMBER(H5T_NATIVE_SCHAR_g)
#undef TETMEND_HDF5_NUMBER

}  // namespace tetmend::formats
