// SPDX-License-Identifier: MIT
// Solution files of MEDIT: what is a length at each vertex is read, all else is refused with its place.
#include "kernel/formats/medit_sizes.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/error.h"

using namespace tetmend;

namespace {

std::filesystem::path write(const std::string& name, const std::string& bytes) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("tetmend_sizes_" + name);
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

std::string failure(const std::string& name, const std::string& bytes) {
  try {
    formats::read_medit_sizes(write(name, bytes));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

template <class T>
void put(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// One solution of a type at each of two vertices.
std::string binary(std::int32_t type, std::int32_t version = 2) {
  std::string bytes;
  put<std::int32_t>(bytes, 1);
  put<std::int32_t>(bytes, version);
  put<std::int32_t>(bytes, 3);  // dimension
  put<std::int32_t>(bytes, 20);
  put<std::int32_t>(bytes, 3);
  put<std::int32_t>(bytes, 62);  // SolAtVertices
  put<std::int32_t>(bytes, 56);
  put<std::int32_t>(bytes, 2);
  put<std::int32_t>(bytes, 1);
  put<std::int32_t>(bytes, type);
  put(bytes, 0.5);
  put(bytes, 0.25);
  put<std::int32_t>(bytes, 54);
  put<std::int32_t>(bytes, 0);
  return bytes;
}

}  // namespace

TEST_CASE("lengths at vertices are read from solution files in text and in binary") {
  const std::vector<double> expected = {0.5, 0.25};
  const std::string text = kMeditHead + "# sizes\nSolAtVertices\n2\n1 1\n0.5\n2.5e-1\nEnd\n";
  CHECK(formats::read_medit_sizes(write("a.sol", text)) == expected);
  CHECK(formats::read_medit_sizes(write("a.solb", binary(1))) == expected);
}

TEST_CASE("a solution file without one length at each vertex is refused with the place") {
  const auto contains = [](const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos;
  };
  const std::string metric =
      failure("m.sol", kMeditHead + "SolAtVertices\n1\n1 3\n1 0 1 0 0 1\nEnd\n");
  CHECK(contains(metric, "m.sol:5"));
  CHECK(contains(metric, "metrics"));
  CHECK(
      contains(failure("z.sol", kMeditHead + "SolAtVertices\n2\n1 1\n0.5\n-1\nEnd\n"), "z.sol:7"));
  CHECK(contains(failure("w.sol", kMeditHead + "SolAtVertices\n2\n1 1\n0.5\nx\n"), "w.sol:7"));
  CHECK(contains(failure("s.sol", kMeditHead + "SolAtVertices\n2\n1 1\n0.5\n"), "s.sol"));
  CHECK(contains(failure("l.sol", kMeditHead + "SolAtVertices\n200000\n1 1\n0.5\n"), "l.sol:4"));
  CHECK(contains(failure("n.sol", kMeditHead + "End\n"), "SolAtVertices is missing"));
  CHECK(contains(failure("v.sol", "Vertices 3\n"), "v.sol:1"));
  CHECK(contains(failure("d.sol", "MeshVersionFormatted 2\nDimension 2\n"), "d.sol:2"));
  CHECK(contains(failure("v.solb", binary(2)), "vectors"));
  CHECK(contains(failure("o.solb", binary(1, 9)), "version 9"));
  CHECK(contains(failure("t.solb", binary(1).substr(0, 50)), "t.solb"));
  CHECK(contains(failure("e.solb", ""), "e.solb"));
}
