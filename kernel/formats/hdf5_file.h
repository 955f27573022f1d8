// SPDX-License-Identifier: MIT
// Files of HDF5 in memory: tables and texts by their paths, "ENS_MAA/part". Formats that are made of
// them need no header of HDF5, and a program without it says so when a file is opened.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/compression.h"
#include "kernel/formats/input_file.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// False in a program without HDF5. The library has none: a process has room for one HDF5, and who
/// links the library may have another one, as PETSc does.
bool has_hdf5();

/// Rows of `width` characters, each up to the first that is zero, without blanks at the end.
std::vector<std::string> text_rows(std::string_view characters, std::size_t width);

/// What is asked for must be there, unless it says otherwise: all functions throw Error
/// "FILE: /PATH: reason". Links to other files are as if they were not there, and tables that claim more
/// than the file can hold are refused before memory is taken. One such file is open at a time: other
/// threads wait, and the same one would for ever.
class Hdf5Reader {
 public:
  virtual ~Hdf5Reader() = default;

  virtual bool has(const std::string& path) const = 0;
  /// What a group, or "/", holds, in ascending order.
  virtual std::vector<std::string> names(const std::string& group) const = 0;
  /// Rows, columns... of a table.
  virtual std::vector<std::uint64_t> extents(const std::string& table) const = 0;
  /// All numbers of a table, row by row, in the type that holds them; integers that no type of ours
  /// holds are doubles.
  virtual DataArray::Values values(const std::string& table) const = 0;
  /// Those of one value of the first index. The others are not read. Precondition: it has this row.
  virtual DataArray::Values row(const std::string& table, std::uint64_t number) const = 0;
  virtual std::vector<std::int64_t> integers(const std::string& table) const = 0;
  virtual std::vector<double> reals(const std::string& table) const = 0;
  /// See text_rows(). A list of numbers of one byte is one row.
  virtual std::vector<std::string> texts(const std::string& table) const = 0;

  virtual bool has(const std::string& path, const char* attribute) const = 0;
  virtual std::int64_t integer(const std::string& path, const char* attribute) const = 0;
  virtual double real(const std::string& path, const char* attribute) const = 0;
  /// As it stands, with blanks; empty where it is not there.
  virtual std::string text(const std::string& path, const char* attribute) const = 0;

  /// @throws Error that names file and path
  [[noreturn]] void fail(const std::string& path, std::string_view reason) const;

 protected:
  explicit Hdf5Reader(const InputFile& file) : name_(file.name()), file_size_(file.size()) {}

  /// Numbers of a table that are about to be read. All that is read of a file has to be less than a
  /// bomb: a table may be packed, and named again and again.
  void take(const std::string& table, std::uint64_t count) const {
    constexpr std::uint64_t kBytes = 8;  // of one, as it is kept
    taken_ += kBytes * count;
    if (!is_bomb(file_size_, taken_)) return;
    fail(table, fmt::format("with it the tables have {} bytes in all, more than 200 times those "
                            "of the file: they are not read",
                            taken_));
  }

 private:
  std::string name_;
  std::size_t file_size_;
  mutable std::uint64_t taken_ = 0;
};

/// The bytes of `file` must stay. @param format what messages call the format: "MED"
/// @throws Error where they are none of HDF5, or this program has no HDF5
std::unique_ptr<Hdf5Reader> open_hdf5(const InputFile& file, std::string_view format);

/// The same calls make the same bytes. Groups on the way to a path are made if need be.
class Hdf5Writer {
 public:
  using Attribute = std::variant<std::int32_t, double, std::string>;

  virtual ~Hdf5Writer() = default;

  virtual void group(const std::string& path) = 0;
  /// `columns` 0: a list.
  virtual void write(const std::string& table, const DataArray::Values& values,
                     std::size_t columns = 0) = 0;
  /// Each cut at, or filled up with zeros to, `width` characters.
  virtual void write_texts(const std::string& table, const std::vector<std::string>& texts,
                           std::size_t width) = 0;
  /// A list of characters.
  virtual void write_characters(const std::string& table, const std::string& text) = 0;
  virtual void set(const std::string& path, const char* attribute, const Attribute& value) = 0;
  /// The whole file; the last call.
  virtual std::string bytes() = 0;
};

/// @param name what messages call the file
/// @throws Error where this program has no HDF5
std::unique_ptr<Hdf5Writer> make_hdf5(std::string name, std::string_view format);

/// The HDF5 of a program: hdf5_writer.cpp, where a program is linked with it, provides its own when
/// the program starts.
struct Hdf5Driver {
  std::unique_ptr<Hdf5Reader> (*open)(const InputFile& file, std::string_view format);
  std::unique_ptr<Hdf5Writer> (*make)(std::string name);
};
/// `of_program` must outlive all calls. Before any of them.
void provide_hdf5(const Hdf5Driver& of_program);

}  // namespace tetmend::formats
