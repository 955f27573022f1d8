// SPDX-License-Identifier: MIT
// A file as the document is to show it. Reading may take seconds, so it needs no document.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"
#include "viewer/debugger/debugger.h"
#include "viewer/mesh/measured_mesh.h"

namespace tetmend::viewer {

/// Steps of reading a file, for a bar.
enum class OpeningStage : std::uint8_t { reading, building, measuring };

struct OpenedFile {
  std::filesystem::path file;          ///< that was asked for; of a lesson, its trace
  std::unique_ptr<Debugger> debugger;  ///< of a trace; null: a mesh
  MeasuredMesh mesh;                   ///< of a trace, at its beginning
  std::vector<std::string> notes;      ///< see Document::notes()
  std::string remark;                  ///< one of them, for the status line, or empty
  std::string beside;                  ///< what the file holds that the mesh does not; or empty
  /// The mesh as its file has it, where that holds what a run respects; see LiveRun::Input.
  std::shared_ptr<const MeshData> data;
};

/// @param stage is told where the work is; may be null
/// @throws Error when the file cannot be read, with the reason.
OpenedFile read_file(const std::filesystem::path& file, const Standard& standard,
                     std::atomic<OpeningStage>* stage = nullptr);

/// The same, in a thread of its own.
class Opening {
 public:
  Opening(std::filesystem::path file, const Standard& standard);
  const std::filesystem::path& file() const { return file_; }
  /// Waits up to so many seconds. True when it is read, or could not be.
  bool wait(double seconds) const;
  /// In words, and how much lies behind it, 0 to 1.
  std::string_view stage() const;
  double share() const;
  double seconds() const;
  /// Once. @throws Error as read_file()
  OpenedFile take() { return result_.get(); }

 private:
  std::filesystem::path file_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<OpeningStage> stage_ = OpeningStage::reading;
  std::future<OpenedFile> result_;  // last: its end waits for the thread
};

}  // namespace tetmend::viewer
