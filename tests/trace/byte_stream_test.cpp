// SPDX-License-Identifier: MIT
#include "trace/byte_stream.h"

#include <limits>
#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;

TEST_CASE("numbers of every size come back as they were written") {
  const std::vector<std::uint64_t> numbers = {
      0, 1, 127, 128, 16383, 16384, 0xFFFFFFFFu, std::numeric_limits<std::uint64_t>::max()};
  const std::vector<std::int64_t> signed_numbers = {0,
                                                    -1,
                                                    1,
                                                    -64,
                                                    64,
                                                    std::numeric_limits<std::int64_t>::min(),
                                                    std::numeric_limits<std::int64_t>::max()};
  ByteWriter out;
  for (const std::uint64_t n : numbers) out.put(n);
  for (const std::int64_t n : signed_numbers) out.put_signed(n);
  std::uint32_t from = 5;
  out.put_step(0xFFFFFFFFu, from);
  out.put_step(0, from);
  out.put_text("name");
  out.put_raw(0.1);
  ByteReader in(out.bytes());
  for (const std::uint64_t n : numbers) CHECK(in.get() == n);
  for (const std::int64_t n : signed_numbers) CHECK(in.get_signed() == n);
  from = 5;
  CHECK(in.get_step(from) == 0xFFFFFFFFu);
  CHECK(in.get_step(from) == 0);
  CHECK(in.get_text() == "name");
  CHECK(in.get_raw<double>() == 0.1);
  CHECK(in.at_end());
}

TEST_CASE("a number below 128 takes one byte") {
  ByteWriter out;
  out.put(127);
  CHECK(out.size() == 1);
  out.put(128);
  CHECK(out.size() == 3);
}

TEST_CASE("bytes that end too early or ask for more than there is are damage") {
  ByteWriter out;
  out.put_text("a long text");
  for (std::size_t size = 0; size < out.size(); ++size) {
    ByteReader in(out.bytes().first(size));
    CHECK_THROWS_AS(in.get_text(), ByteReader::Damage);
  }
  ByteWriter number;
  number.put(std::uint64_t{1} << 32);
  CHECK_THROWS_AS(ByteReader(number.bytes()).get32(), ByteReader::Damage);
  std::uint32_t zero = 0;
  ByteWriter back;
  back.put_signed(-1);
  CHECK_THROWS_AS(ByteReader(back.bytes()).get_step(zero), ByteReader::Damage);
}
