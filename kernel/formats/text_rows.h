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
#include <span>

#include "kernel/chunks.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {

inline constexpr std::size_t kTextChunkSize = std::size_t{1} << 17;

/// Lines of a text file that are supposed to be rows.
struct TextChunk {
  const char* begin = nullptr;
  const char* end = nullptr;
  std::size_t first = 0;  ///< row
  std::size_t rows = 0;
  const char* stop = nullptr;  ///< behind the last row; null if the chunk is not as supposed
};

/// Cuts the next text, of which row `row` is the first, into `chunks`; gives how many of them are
/// used.
inline std::size_t cut_text(const TextReader& text, std::size_t row, std::size_t count,
                            std::span<TextChunk> chunks) {
  const std::size_t used = std::min(chunks.size(), chunk_count(text.bytes_left(), kTextChunkSize));
  for_chunks(
      used,
      [&](std::size_t k, std::size_t) {
        chunks[k].begin = k == 0 ? text.position() : text.line_after(k * kTextChunkSize);
        chunks[k].end = text.line_after((k + 1) * kTextChunkSize);
        chunks[k].rows = static_cast<std::size_t>(std::count(chunks[k].begin, chunks[k].end, '\n'));
      },
      1);
  for (std::size_t k = 0; k < used; ++k) {
    chunks[k].first = row;
    chunks[k].rows = std::min(chunks[k].rows, count - row);
    row += chunks[k].rows;
  }
  return used;
}

/// Calls read_row(text, i) for each row i from 0 to count - 1, where it stands in `text`, and
/// leaves `text` behind the last one. Rows are read several at once, and a row may be read twice:
/// read_row must write to what belongs to row i only.
template <class ReadRow>
void read_rows(TextReader& text, std::size_t count, const ReadRow& read_row) {
  constexpr std::size_t kChunksAtOnce = 32;
  // To look for the ends of many lines does not pay for a few rows; a file may have many such lists.
  constexpr std::size_t kMany = std::size_t{1} << 14;
  std::size_t row = 0;
  bool regular = count >= kMany && text.at_line_end();
  if (regular) text.skip_line();
  while (regular && row < count && text.bytes_left() > 0) {
    std::array<TextChunk, kChunksAtOnce> chunks;
    const std::size_t used = cut_text(text, row, count, chunks);
    const auto read_chunk = [&](std::size_t k, std::size_t) {
      TextChunk& chunk = chunks[k];
      TextReader part = text.trial(chunk.begin);
      const std::size_t end = chunk.first + chunk.rows;
      try {
        for (std::size_t i = chunk.first; i < end; ++i) read_row(part, i);
      } catch (const TextReader::TrialFailed&) {
        return;
      }
      if (end == count || part.ends_at(chunk.end)) chunk.stop = part.position();
    };
    for_chunks(used, read_chunk, 1);
    for (std::size_t k = 0; k < used && regular && row < count; ++k) {
      regular = chunks[k].stop != nullptr;
      row = chunks[k].first + (regular ? chunks[k].rows : 0);
      text.seek(!regular ? chunks[k].begin : row == count ? chunks[k].stop : chunks[k].end);
    }
  }
  for (; row < count; ++row) read_row(text, row);
}

}  // namespace tetmend::formats
