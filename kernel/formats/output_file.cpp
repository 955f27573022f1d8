// SPDX-License-Identifier: MIT
// A file that appears under its name only when it is complete.
#include "kernel/formats/output_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/compile.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include "kernel/error.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/standard_stream.h"

namespace tetmend {

void OutputBuffer::put_integer(std::int64_t value) {
  constexpr std::size_t kLongest = 24;
  char* begin = room_for(kLongest);
  used_ += static_cast<std::size_t>(std::to_chars(begin, begin + kLongest, value).ptr - begin);
}

void OutputBuffer::put_real(double value) {
  constexpr std::size_t kLongest = 32;
  char* begin = room_for(kLongest);
  used_ += static_cast<std::size_t>(fmt::format_to(begin, FMT_COMPILE("{}"), value) - begin);
}

void OutputBuffer::grow(std::size_t size) {
  constexpr std::size_t kLeast = std::size_t{1} << 16;
  capacity_ = std::max({kLeast, 2 * capacity_, used_ + size});
  auto larger = std::make_unique_for_overwrite<char[]>(capacity_);
  std::copy_n(bytes_.get(), used_, larger.get());
  bytes_ = std::move(larger);
}

OutputFile::OutputFile(const std::filesystem::path& target)
    : name_(target.string()), target_(target), is_standard_(formats::is_standard_stream(target)) {
  if (is_standard_) {
    name_ = "standard output";
    fd_ = ::memfd_create("tetmend", MFD_CLOEXEC);
    if (fd_ < 0) fail(errno);
  } else {
    make_temporary();
  }
  if (target.extension() == ".gz") {
    gzip_ =
        std::make_unique<formats::GzipWriter>([this](std::string_view bytes) { write_raw(bytes); });
  }
}

void OutputFile::make_temporary() {
  std::error_code ignored;
  // Renaming onto a link would replace the link, not the file that the user keeps behind it.
  if (const auto real = std::filesystem::canonical(target_, ignored); !ignored) target_ = real;
  mode_t mode = 0;
  struct stat older {};
  if (::stat(target_.c_str(), &older) == 0) {
    if (S_ISDIR(older.st_mode)) fail(EISDIR);
    if (!S_ISREG(older.st_mode)) {
      throw Error(fmt::format("{}: cannot be written: not a regular file", name_));
    }
    // A rename would get past the write protection of the file, which asks the folder only.
    if (::access(target_.c_str(), W_OK) != 0) fail(errno);
    mode = older.st_mode & 0777;
  }
  // The name does not contain the target's, which may have the greatest length allowed.
  for (int attempt = 0; fd_ < 0; ++attempt) {
    temporary_ = target_.parent_path() / fmt::format(".tetmend-{}-{}.tmp", ::getpid(), attempt);
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd_ < 0 && errno != EEXIST) fail(errno);
  }
  if (mode != 0)
    static_cast<void>(::fchmod(fd_, mode));  // best effort: a file system may know no modes
}

OutputFile::~OutputFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!committed_ && !is_standard_) ::unlink(temporary_.c_str());
}

void OutputFile::put(std::string_view text) {
  if (text.size() < kFull) return buffer_.put(text), flush_if_full();
  flush();
  write_out(text);
}

void OutputFile::put_blocks(
    std::size_t blocks, const std::function<void(std::size_t block, OutputBuffer& buffer)>& fill) {
  flush();
  // Blocks leave in order: with so many under way, the last but so many has left its buffer.
  const std::size_t threads = std::min<std::size_t>(
      static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  const std::size_t under_way = threads == 1 ? 1 : 2 * threads;
  std::vector<OutputBuffer> buffers(under_way);
  std::size_t next = 0;
  const auto begin = [&](tbb::flow_control& control) {
    if (next == blocks) control.stop();
    return next++;
  };
  const auto fill_buffer = [&](std::size_t block) {
    OutputBuffer& buffer = buffers[block % under_way];
    buffer.clear();
    fill(block, buffer);
    return block;
  };
  const auto write = [&](std::size_t block) { write_out(buffers[block % under_way].content()); };
  tbb::parallel_pipeline(
      under_way,
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, begin) &
          tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, fill_buffer) &
          tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, write));
}

void OutputFile::finish() {
  if (fd_ < 0) return;
  flush();
  if (gzip_) gzip_->finish();
  if (is_standard_) return;
  const int closed = ::close(fd_);
  fd_ = -1;
  if (closed != 0) fail(errno);
}

void OutputFile::commit() {
  finish();
  if (is_standard_) return copy_to_standard_output();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  committed_ = true;
}

void OutputFile::flush() {
  write_out(buffer_.content());
  buffer_.clear();
}

void OutputFile::write_out(std::string_view bytes) {
  if (gzip_) return gzip_->put(bytes);
  write_raw(bytes);
}

void OutputFile::copy_to_standard_output() {
  std::array<char, 1 << 16> buffer;
  off_t place = 0;
  for (;;) {
    const ssize_t got = ::pread(fd_, buffer.data(), buffer.size(), place);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(errno);
    if (got == 0) return;
    write_to(STDOUT_FILENO, {buffer.data(), static_cast<std::size_t>(got)});
    place += got;
  }
}

void OutputFile::write_to(int fd, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::fail(int error) const {
  throw Error(
      fmt::format("{}: cannot be written: {}", name_, std::generic_category().message(error)));
}

}  // namespace tetmend
