// SPDX-License-Identifier: MIT
// All files of one run: none that is written may be another one of them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tetmend::formats {

/// Files and folders whose names differ in a number alone, with all that lies in them.
struct NumberedFiles {
  std::filesystem::path folder;
  std::string begin;  ///< then come digits
  std::string end;
};

/// Where a mesh, or whatever has one name, lies.
struct FileSet {
  std::vector<std::filesystem::path> files;  ///< need not be there
  std::vector<NumberedFiles> numbered;       ///< how many of these there will be nobody knows
};

/// What one option stands for.
struct FileUse {
  std::string option;  ///< for messages: "IN", "--trace"
  FileSet files;
  /// Not empty, of an input and an output alike: one may replace the other if they are one mesh.
  std::string replaceable = {};
  /// Of an input: what an output under its name would be.
  FileSet home = {};
};

/// Two of them under different options that are one file.
struct FileClash {
  std::filesystem::path file;  ///< as the output names it
  std::string option;
  std::string output;
};

/// Files are the same if they have the same inode or would have the same place: however they are
/// named, through links, and also where they are not there yet.
class RunFiles {
 public:
  void read(const FileUse& use);
  void write(const FileUse& use);
  /// The first file that is written although it is read, or written under another option. A use that
  /// was added first is named first.
  /// Cost: some system calls a file.
  std::optional<FileClash> clash() const;

 private:
  struct File {
    std::filesystem::path name;
    std::filesystem::path place;  ///< absolute, without links
    bool is_there = false;
  };
  struct Use {
    std::string option;
    std::string replaceable;
    std::vector<File> files;
    std::vector<NumberedFiles> numbered;  ///< in folders without links
    std::vector<File> home;
    std::vector<NumberedFiles> home_numbered;
  };

  static File find(const std::filesystem::path& name);
  static std::vector<File> find_all(const FileSet& set);
  static std::vector<NumberedFiles> places_of(const std::vector<NumberedFiles>& numbered);
  static Use look_up(const FileUse& use);
  static bool is_same(const File& a, const File& b);
  static bool is_one_mesh(const Use& input, const Use& output);
  static const File* common(const Use& output, const Use& other);

  std::vector<Use> read_;
  std::vector<Use> written_;
};

}  // namespace tetmend::formats
