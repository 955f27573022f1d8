// SPDX-License-Identifier: MIT
// A file that appears under its name only when it is complete.
#include "kernel/formats/output_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "kernel/error.h"
#include "kernel/first_failure.h"
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
  std::unique_ptr<char[]> larger(new char[capacity_]);
  std::copy_n(bytes_.get(), used_, larger.get());
  bytes_ = std::move(larger);
}

OutputFile::OutputFile(const std::filesystem::path& target) {
  if (formats::is_standard_stream(target)) {
    auto made = platform::create_nameless();
    if (!made) fail_stream(made.error);
    memory_ = std::move(made.value);
  } else {
    file_.emplace(target);
  }
  if (target.extension() == ".gz") {
    gzip_ =
        std::make_unique<formats::GzipWriter>([this](std::string_view bytes) { write_raw(bytes); });
  }
}

OutputFile::~OutputFile() = default;

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
  FirstFailure failure;
  const auto begin = [&](tbb::flow_control& control) {
    if (next == blocks || failure.failed()) control.stop();
    return next++;
  };
  const auto fill_buffer = [&](std::size_t block) {
    failure.guard([&] {
      OutputBuffer& buffer = buffers[block % under_way];
      buffer.clear();
      fill(block, buffer);
    });
    return block;
  };
  const auto write = [&](std::size_t block) {
    if (failure.failed()) return;
    failure.guard([&] { write_out(buffers[block % under_way].content()); });
  };
  tbb::parallel_pipeline(
      under_way,
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, begin) &
          tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, fill_buffer) &
          tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, write));
  failure.rethrow();
}

void OutputFile::finish() {
  if (is_finished_) return;
  flush();
  if (gzip_) gzip_->finish();
  if (file_) file_->finish();
  is_finished_ = true;
}

void OutputFile::commit(const Companions& companions) {
  const std::array<OutputFile*, 1> alone = {this};
  commit_all(alone, companions);
}

void OutputFile::commit_all(std::span<OutputFile* const> outputs, const Companions& companions) {
  std::vector<formats::PendingFile*> files;
  OutputFile* stream = nullptr;
  for (OutputFile* output : outputs) {
    output->finish();
    if (output->file_) {
      files.push_back(&*output->file_);
    } else if (outputs.size() == 1) {
      stream = output;
    } else {
      throw Error("several files cannot go to standard output");
    }
  }
  if (companions) {
    for (formats::PendingFile* file : companions()) files.push_back(file);
  }
  if (files.size() == 1) {
    files.front()->commit();
  } else if (!files.empty()) {
    formats::PendingFile::commit_all(files);
  }
  if (stream != nullptr) stream->copy_to_standard_output();
}

void OutputFile::flush() {
  write_out(buffer_.content());
  buffer_.clear();
}

void OutputFile::use_line_breaks_of(std::string_view text) {
  flush();
  const std::size_t end = text.find('\n');
  is_of_windows_ = end != std::string_view::npos && end > 0 && text[end - 1] == '\r';
}

void OutputFile::put_as_it_is(std::string_view text) {
  if (!is_of_windows_) return put(text);
  flush();
  write_packed(text);
}

void OutputFile::write_out(std::string_view bytes) {
  if (!is_of_windows_) return write_packed(bytes);
  std::string lines;
  lines.reserve(bytes.size() + bytes.size() / 16);
  for (const char c : bytes) {
    if (c == '\n' && !lines.ends_with('\r')) lines += '\r';
    lines += c;
  }
  write_packed(lines);
}

void OutputFile::write_packed(std::string_view bytes) {
  if (gzip_) return gzip_->put(bytes);
  write_raw(bytes);
}

void OutputFile::write_raw(std::string_view bytes) {
  if (file_) return file_->write(bytes);
  const int error = platform::write_fully(memory_.number(), bytes);
  if (error != 0) fail_stream(error);
}

void OutputFile::copy_to_standard_output() {
  std::array<char, 1 << 16> buffer;
  std::uint64_t place = 0;
  for (;;) {
    const auto got = platform::read_at(memory_.number(), place, buffer);
    if (!got) fail_stream(got.error);
    if (got.value == 0) return;
    const std::string_view bytes(buffer.data(), got.value);
    const int error = platform::write_fully(platform::kStandardOutput, bytes);
    if (error != 0) fail_stream(error);
    place += got.value;
  }
}

void OutputFile::fail_stream(int error) {
  throw Error(fmt::format("standard output: cannot be written: {}",
                          std::generic_category().message(error)));
}

}  // namespace tetmend
