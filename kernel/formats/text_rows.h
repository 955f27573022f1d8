// SPDX-License-Identifier: MIT
// Rows of numbers of a text file, read on all threads.
//
//   cut the text at line breaks into chunks of a fixed size; count the lines of each
//   suppose a row on each line: so the first row of each chunk is known, and all are read at once
//   a chunk is right if its last row ends where the next chunk begins
//   from the first chunk that is not (an error, a comment, rows that share lines) the rest is read
//   row by row, which finds the first error of the file and its line
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "kernel/chunks.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {

inline constexpr std::size_t kTextChunkSize = std::size_t{1} << 17;

/// Calls read_row(text, i) for each row i from 0 to count - 1, where it stands in `text`, and
/// leaves `text` behind the last one. Rows are read several at once, and a row may be read twice:
/// read_row must write to what belongs to row i only.
template <class ReadRow>
void read_rows(TextReader& text, std::size_t count, const ReadRow& read_row) {
  struct Chunk {
    const char* begin = nullptr;
    const char* end = nullptr;
    std::size_t first = 0;  // row
    std::size_t lines = 0;
    const char* stop = nullptr;  // behind the last row; null if the chunk is not as supposed
  };
  constexpr std::size_t kChunksAtOnce = 32;
  std::size_t row = 0;
  if (text.at_line_end()) {
    text.skip_line();
    bool regular = true;
    while (regular && row < count && text.bytes_left() > 0) {
      std::array<Chunk, kChunksAtOnce> chunks;
      const std::size_t used =
          std::min(kChunksAtOnce, chunk_count(text.bytes_left(), kTextChunkSize));
      const auto line_begin = [&](std::size_t k) {
        return k == 0 ? text.position() : text.line_after(k * kTextChunkSize);
      };
      for_chunks(
          used,
          [&](std::size_t k, std::size_t) {
            chunks[k].begin = line_begin(k);
            chunks[k].end = line_begin(k + 1);
            chunks[k].lines = static_cast<std::size_t>(
                std::count(chunks[k].begin, std::max(chunks[k].begin, chunks[k].end), '\n'));
          },
          1);
      for (std::size_t k = 0; k < used; ++k) {
        chunks[k].first = row;
        row = std::min(count, row + chunks[k].lines);
      }
      for_chunks(
          used,
          [&](std::size_t k, std::size_t) {
            Chunk& chunk = chunks[k];
            const std::size_t rows = std::min(chunk.lines, count - chunk.first);
            TextReader part = text.trial(chunk.begin);
            try {
              for (std::size_t i = 0; i < rows; ++i) read_row(part, chunk.first + i);
            } catch (const TextReader::TrialFailed&) {
              return;
            }
            const bool last = chunk.first + rows == count;
            if (last || part.ends_at(chunk.end)) chunk.stop = part.position();
          },
          1);
      for (std::size_t k = 0; k < used && regular; ++k) {
        regular = chunks[k].stop != nullptr;
        text.seek(regular ? chunks[k].stop : chunks[k].begin);
        row = regular ? std::min(count, chunks[k].first + chunks[k].lines) : chunks[k].first;
        if (row == count) break;
        if (regular) text.seek(chunks[k].end);
      }
    }
  }
  for (; row < count; ++row) read_row(text, row);
}

}  // namespace tetmend::formats
