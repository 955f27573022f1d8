// SPDX-License-Identifier: MIT
// Names of unfinished files, where the handler of a signal finds and removes them.
#pragma once

#include <cstddef>
#include <filesystem>

namespace tetmend::formats {

/// While one lives, the file of that name is removed if a signal ends the program. Only the first
/// few dozen at a time are looked after.
class TemporaryName {
 public:
  TemporaryName() = default;
  ~TemporaryName() { forget(); }
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  /// Precondition: an EndDelay lives since before the file was made.
  /// @param of_use also without its end: stays when the program crashes
  void remember(const std::filesystem::path& file, bool of_use);
  /// The file has another name now, or is no longer there.
  void forget();

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t slot_ = kNone;
};

/// While one lives, end_by_signal() waits: what must not be done by halves is short.
class EndDelay {
 public:
  EndDelay();
  ~EndDelay();
  EndDelay(const EndDelay&) = delete;
  EndDelay& operator=(const EndDelay&) = delete;
};

enum class Remains : unsigned char {
  none,
  of_use  ///< files that are of use without their end stay
};

/// Removes all files that are looked after. A signal handler may call it.
void remove_temporaries(Remains remains = Remains::none) noexcept;

/// Removes them and lets the signal act as if it had no handler; at once, or when the last EndDelay
/// is gone. For handlers.
void end_by_signal(int number) noexcept;

}  // namespace tetmend::formats
