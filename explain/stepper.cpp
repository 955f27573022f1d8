// SPDX-License-Identifier: MIT
#include "explain/stepper.h"

#include <algorithm>
#include <span>

namespace tetmend::explain {

namespace {

/// The last of the frames, which do not overlap or nest with the inner ones later, that begins
/// before `position`.
template <class Frame>
const EventRange* last_before(std::span<const Frame> frames, std::uint64_t position) {
  const auto after = std::lower_bound(
      frames.begin(), frames.end(), position,
      [](const Frame& frame, std::uint64_t number) { return frame.events.begin < number; });
  return after == frames.begin() ? nullptr : &(after - 1)->events;
}

template <class Frame>
const EventRange* beginning_at(std::span<const Frame> frames, std::uint64_t event) {
  const EventRange* last = last_before(frames, event + 1);
  return last != nullptr && last->begin == event ? last : nullptr;
}

std::uint32_t call_of_last_event(const TraceFile& file, std::uint64_t position) {
  return position == 0 ? kNoCall : file.call_at(position - 1);
}

const EventRange* frame_beginning_at(const TraceFile& file, std::uint64_t event) {
  if (const EventRange* call = beginning_at(file.calls(), event)) return call;
  if (const EventRange* visit = beginning_at(file.visits(), event)) return visit;
  return beginning_at(file.passes(), event);
}

const EventRange* frame_ending_at(const TraceFile& file, std::uint64_t position) {
  const std::uint32_t call = call_of_last_event(file, position);
  if (call != kNoCall) {
    const EventRange& range = file.calls()[call].events;
    return range.end == position ? &range : nullptr;
  }
  for (const EventRange* range :
       {last_before(file.visits(), position), last_before(file.passes(), position)}) {
    if (range != nullptr && range->end == position) return range;
  }
  return nullptr;
}

}  // namespace

std::optional<EventRange> open_frame(const TraceFile& file, std::uint64_t position) {
  std::uint32_t call = call_of_last_event(file, position);
  while (call != kNoCall && file.calls()[call].events.end <= position) {
    call = file.calls()[call].parent;
  }
  if (call != kNoCall) return file.calls()[call].events;
  for (const EventRange* range :
       {last_before(file.visits(), position), last_before(file.passes(), position)}) {
    if (range != nullptr && range->end > position) return *range;
  }
  return std::nullopt;
}

std::uint64_t step_from(const TraceFile& file, std::uint64_t position, Step step,
                        Direction direction) {
  const bool forward = direction == Direction::forward;
  const std::uint64_t end = file.event_count();
  if (position == (forward ? end : 0)) return position;
  if (step == Step::out) {
    const std::optional<EventRange> frame = open_frame(file, position);
    if (!frame) return forward ? end : 0;
    return forward ? frame->end : frame->begin;
  }
  if (step == Step::over) {
    const EventRange* frame =
        forward ? frame_beginning_at(file, position) : frame_ending_at(file, position);
    if (frame != nullptr) return forward ? frame->end : frame->begin;
  }
  return forward ? position + 1 : position - 1;
}

std::optional<std::uint32_t> visit_at(const TraceFile& file, std::uint64_t position) {
  const EventRange* range = last_before(file.visits(), position);
  if (range == nullptr || range->end < position) return std::nullopt;
  const auto visits = file.visits();
  const auto after = std::lower_bound(
      visits.begin(), visits.end(), position,
      [](const Visit& visit, std::uint64_t number) { return visit.events.begin < number; });
  return static_cast<std::uint32_t>(after - visits.begin() - 1);
}

std::vector<std::uint32_t> call_stack(const TraceFile& file, std::uint64_t position) {
  std::vector<std::uint32_t> stack;
  for (std::uint32_t call = call_of_last_event(file, position); call != kNoCall;
       call = file.calls()[call].parent) {
    stack.push_back(call);
  }
  std::reverse(stack.begin(), stack.end());
  return stack;
}

}  // namespace tetmend::explain
