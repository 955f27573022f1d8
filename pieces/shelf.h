// SPDX-License-Identifier: MIT
// Where pieces lie while others are worked on: in memory, or in files of a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "platform/platform.h"

namespace tetmend::pieces {

/// Bytes by name. Several threads may use shelves but SealedShelf at a time, each other names.
class Shelf {
 public:
  virtual ~Shelf() = default;
  /// Behind what has that name; the name is new otherwise. @throws Error for a full disk.
  virtual void append(const std::string& name, std::string bytes) = 0;
  /// Nothing more will be appended: what was, or nothing, is complete.
  virtual void end(const std::string& /*name*/) {}
  /// In the place of what has that name.
  virtual void put(const std::string& name, std::string bytes) = 0;
  /// Calls `use` with all of it, in its order: at once, or with what each append() has brought.
  virtual void visit(const std::string& name,
                     const std::function<void(std::string_view)>& use) const = 0;
  /// All of it; empty if there is none of that name. @throws Error for a file that cannot be read.
  virtual std::string read(const std::string& name) const = 0;
  /// Some of it, as far as there is so much.
  virtual std::string read(const std::string& name, std::uint64_t begin,
                           std::uint64_t size) const = 0;
  /// Calls read(), which takes apart what has that name: a shelf may say of whom an Error is.
  virtual void parse(const std::string& /*name*/, const std::function<void()>& read) const {
    read();
  }
  virtual void remove(const std::string& name) = 0;
  /// In the place of what has the new name. Does nothing where there is none of the old one.
  virtual void rename(const std::string& from, const std::string& to) = 0;
};

class MemoryShelf final : public Shelf {
 public:
  void append(const std::string& name, std::string bytes) override;
  void put(const std::string& name, std::string bytes) override;
  void visit(const std::string& name,
             const std::function<void(std::string_view)>& use) const override;
  std::string read(const std::string& name) const override;
  std::string read(const std::string& name, std::uint64_t begin, std::uint64_t size) const override;
  void remove(const std::string& name) override;
  void rename(const std::string& from, const std::string& to) override;

 private:
  /// Parts as they came: one string that grows would have room for twice as much.
  using Parts = std::vector<std::string>;
  const Parts* find(const std::string& name) const;
  Parts& make(const std::string& name);

  mutable std::mutex mutex_;  // of the map; who has a name has its parts
  std::map<std::string, Parts> bytes_;
};

/// Each name is a file. For a run that ends with the process: see SealedShelf for others.
class FolderShelf final : public Shelf {
 public:
  /// @param folder is there
  explicit FolderShelf(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void append(const std::string& name, std::string bytes) override;
  void put(const std::string& name, std::string bytes) override;
  void visit(const std::string& name,
             const std::function<void(std::string_view)>& use) const override;
  std::string read(const std::string& name) const override;
  std::string read(const std::string& name, std::uint64_t begin, std::uint64_t size) const override;
  void remove(const std::string& name) override;
  void rename(const std::string& from, const std::string& to) override;

 private:
  bool has(const std::string& name) const;

  std::filesystem::path folder_;
};

/// A folder of its own for a run; goes with all that is in it. Where its process was killed, the next
/// one that is made beside it on the same host removes it.
class ScratchFolder {
 public:
  /// Inside of `parent`. @throws Error when it cannot be made.
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  void lock();

  std::filesystem::path path_;
  platform::Descriptor lock_;  // while it is there
};

}  // namespace tetmend::pieces
