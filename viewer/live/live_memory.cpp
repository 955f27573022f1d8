// SPDX-License-Identifier: MIT
#include "viewer/live/live_memory.h"

#include <algorithm>
#include <utility>

namespace tetmend::viewer {

void LiveMemory::begin(const TetMesh& mesh, const TraceHeader& header) {
  mesh_ = &mesh;
  header_ = header;
  depth_ = 0;
  older_.reset();
  newer_ = std::make_unique<Part>(mesh, header);
}

std::string LiveMemory::look() const {
  Part* part = older_ ? older_.get() : newer_.get();
  return part == nullptr || part->calls == 0 ? std::string() : part->recorder.so_far();
}

void LiveMemory::tell(const auto& event) {
  if (older_) event(older_->recorder);
  if (newer_) event(newer_->recorder);
}

void LiveMemory::pass_begins(std::string_view name, unsigned round) {
  constexpr std::size_t kTetsForCall = 10;
  if (newer_ && newer_->calls >= std::max(calls_, mesh_->tet_slots() / kTetsForCall)) {
    older_ = std::exchange(newer_, std::make_unique<Part>(*mesh_, header_));
  }
  tell([&](TraceRecorder& recorder) { recorder.pass_begins(name, round); });
}

void LiveMemory::pass_ends(const QualityIndicators& now) {
  tell([&](TraceRecorder& recorder) { recorder.pass_ends(now); });
}

void LiveMemory::visit_begins(const TetVertices& tet, Quality quality) {
  tell([&](TraceRecorder& recorder) { recorder.visit_begins(tet, quality); });
}

void LiveMemory::visit_ends() {
  tell([&](TraceRecorder& recorder) { recorder.visit_ends(); });
}

void LiveMemory::standard_changed(const Standard& standard) {
  tell([&](TraceRecorder& recorder) { recorder.standard_changed(standard); });
}

void LiveMemory::parameter_changed(std::string_view text) {
  tell([&](TraceRecorder& recorder) { recorder.parameter_changed(text); });
}

void LiveMemory::attempt_begins(const AttemptEvent& event) {
  if (depth_ == 0) {
    for (Part* part : {older_.get(), newer_.get()}) {
      if (part != nullptr) ++part->calls;
    }
  }
  ++depth_;
  tell([&](TraceRecorder& recorder) { recorder.attempt_begins(event); });
}

void LiveMemory::candidate_found() {
  tell([&](TraceRecorder& recorder) { recorder.candidate_found(); });
}

void LiveMemory::attempt_ends(Verdict verdict, std::span<const Quality> before,
                              std::span<const Quality> now) {
  --depth_;
  tell([&](TraceRecorder& recorder) { recorder.attempt_ends(verdict, before, now); });
}

void LiveMemory::edit_made(const TetMesh& mesh, const Journal& journal) noexcept {
  tell([&](TraceRecorder& recorder) { recorder.edit_made(mesh, journal); });
}

void LiveMemory::edit_undone() noexcept {
  tell([&](TraceRecorder& recorder) { recorder.edit_undone(); });
}

}  // namespace tetmend::viewer
