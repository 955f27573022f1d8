// SPDX-License-Identifier: MIT
// The last calls of a run, as a trace that can be looked at while the run is held.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "kernel/tet_mesh.h"
#include "trace/recorder.h"
#include "trace/trace_sink.h"

namespace tetmend::viewer {

/// Two traces are recorded at a time. When the newer one has so many calls, the next pass begins another
/// in place of the older one: so that always has as many of the last calls, and some passes more.
/// Memory: about 10 bytes a call; the mesh at the beginning of each, packed.
class LiveMemory final : public TraceSink {
 public:
  /// @param calls of the schedule that are remembered; of a large mesh more, as each beginning costs
  /// a copy of it
  explicit LiveMemory(std::size_t calls) : calls_(calls) {}
  ~LiveMemory() override = default;
  LiveMemory(const LiveMemory&) = delete;
  LiveMemory& operator=(const LiveMemory&) = delete;

  /// Forgets all, and follows a run over `mesh`, which must be there for each later event.
  void begin(const TetMesh& mesh, const TraceHeader& header);
  /// A trace of the last calls; one that is under way is cut off. Empty: there was no call.
  /// Precondition: no event comes meanwhile.
  std::string look() const;

  void pass_begins(std::string_view name, unsigned round) override;
  void pass_ends(const QualityIndicators& now) override;
  void visit_begins(const TetVertices& tet, Quality quality) override;
  void visit_ends() override;
  void standard_changed(const Standard& standard) override;
  void parameter_changed(std::string_view text);
  void attempt_begins(const AttemptEvent& event) override;
  void candidate_found() override;
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override;
  void edit_made(const TetMesh& mesh, const Journal& journal) noexcept override;
  void edit_undone() noexcept override;

 private:
  struct Part {
    Part(const TetMesh& mesh, const TraceHeader& header) : recorder(bytes, mesh, header) {}
    std::string bytes;
    TraceRecorder recorder;
    std::size_t calls = 0;  // of the schedule
  };
  void tell(const auto& event);

  std::size_t calls_;
  const TetMesh* mesh_ = nullptr;
  TraceHeader header_;
  std::unique_ptr<Part> older_, newer_;
  std::size_t depth_ = 0;  // of calls under way
};

}  // namespace tetmend::viewer
