// SPDX-License-Identifier: MIT
// A CGNS file as a tree of nodes. A node is a group of HDF5 that says by its attribute "label" what it
// is; its numbers are the table " data" in it.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/input_file.h"

namespace tetmend::formats {

/// It remembers which nodes were looked at. All functions throw Error, see Hdf5Reader.
class CgnsTree {
 public:
  explicit CgnsTree(const InputFile& input) : file_(open_hdf5(input, "CGNS")) {}

  /// Nodes below one, or "/", that have this label. They count as looked at.
  std::vector<std::string> children(const std::string& path, std::string_view label);
  bool has(const std::string& path) const { return file_->has(data_of(path)); }
  /// The numbers of a node, which counts as looked at.
  std::vector<std::int64_t> integers(const std::string& path);
  std::vector<double> reals(const std::string& path);
  DataArray::Values values(const std::string& path);
  /// Empty if it has none.
  std::string characters(const std::string& path);
  /// Of the first node below one that has this label; empty if there is none.
  std::string text_below(const std::string& path, std::string_view label);
  /// Says that a node, if it is there, has nothing that would be lost.
  void see(const std::string& path) { seen_.insert(path); }

  static std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

  /// A sentence on all nodes of one label that nobody looked at; on those below them none.
  std::vector<std::string> notes_of_the_rest() const;

  [[noreturn]] void fail(const std::string& path, std::string_view reason) const {
    file_->fail(path, reason);
  }

 private:
  static std::string data_of(const std::string& path) { return path + "/ data"; }
  std::vector<std::string> nodes_below(const std::string& path) const;
  std::string label(const std::string& path) const { return file_->text(path, "label"); }

  std::unique_ptr<Hdf5Reader> file_;
  std::set<std::string> seen_;
};

}  // namespace tetmend::formats
