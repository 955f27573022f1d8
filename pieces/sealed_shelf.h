// SPDX-License-Identifier: MIT
// Files of a run that go on after its process: each ends with a seal, by which damage is noticed.
//
//   bytes | how many | checksum of the bytes, the name and the run
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "pieces/shelf.h"

namespace tetmend::pieces {

/// In the folder of a run; without it nothing else there counts.
inline constexpr const char* kRunFile = "run";

/// Each name is a file, which must be complete before it is read: what was appended needs its end().
/// A file has its name when it is complete and on the disk, or that is so after its end(). All bytes
/// of a file are looked at before the first of them is used. What is missing, damaged, of another
/// name, step or run, a link or no regular file is an Error that names the file, and kRunFile, which is
/// to be deleted. Of a name the part before its first dot counts: so a file may be renamed.
class SealedShelf final : public Shelf {
 public:
  /// @param root  folder of the run
  /// @param step  folder in it, which is there; empty: the root
  /// @param run  differs from run to run
  SealedShelf(std::filesystem::path root, std::string step, std::uint32_t run);

  void append(const std::string& name, std::string bytes) override;
  void end(const std::string& name) override;
  void put(const std::string& name, std::string bytes) override;
  void visit(const std::string& name,
             const std::function<void(std::string_view)>& use) const override;
  std::string read(const std::string& name) const override;
  std::string read(const std::string& name, std::uint64_t begin, std::uint64_t size) const override;
  void remove(const std::string& name) override;
  void rename(const std::string& from, const std::string& to) override;
  bool has(const std::string& name) const;
  /// The first bytes of a file, whether it is sound or not; less if it has not so many.
  std::string first_bytes(const std::string& name, std::uint64_t size) const;
  /// An Error of read_parts() is one of damage, but where a file cannot be read.
  void parse(const std::string& name, const std::function<void()>& read_parts) const override;

  /// A file with these bytes ends with that.
  static constexpr std::uint64_t kSealSize = sizeof(std::uint64_t) + sizeof(std::uint32_t);

 private:
  struct Sum {
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;
    void add(std::string_view more);
  };
  std::string seal(const std::string& name, const Sum& sum) const;
  platform::Descriptor open(const std::string& name, std::uint64_t& size) const;
  void check(const std::string& name, const platform::Descriptor& file, std::uint64_t size) const;
  std::string read_from(const std::string& name, const platform::Descriptor& file,
                        std::uint64_t begin, std::uint64_t size) const;
  [[noreturn]] void fail(const std::string& name, std::string_view what) const;
  [[noreturn]] void fail(const std::string& name, std::string_view what, int error) const;

  std::filesystem::path root_;
  std::filesystem::path folder_;
  std::string step_;
  std::uint32_t run_;
  std::map<std::string, Sum> growing_;   // what is appended to
  mutable std::set<std::string> sound_;  // what has been looked at
};

}  // namespace tetmend::pieces
