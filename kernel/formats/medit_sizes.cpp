// SPDX-License-Identifier: MIT
//   text:    MeshVersionFormatted 2   Dimension 3   SolAtVertices 2   1 1   0.5   0.25   End
//   binary:  the sections of a `.meshb`; the one with keyword 62 holds a count, the number of solutions,
//            the type of each, and the values
// A vertex may have several solutions: 1 is a number, 2 a vector, 3 a symmetric matrix, 4 any matrix.
#include "kernel/formats/medit_sizes.h"

#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/medit_binary.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {
namespace {

constexpr std::int64_t kNumber = 1;
constexpr std::int64_t kMostSolutions = 20;

/// What is wrong with the solutions of a vertex, or nothing.
std::string why_no_lengths(std::int64_t solutions, std::int64_t type) {
  if (solutions != 1) {
    return fmt::format("{} solutions at each vertex: expected one, a length", solutions);
  }
  if (type == kNumber) return {};
  return fmt::format("a solution of type {} at each vertex ({}): expected 1, a length", type,
                     type == 2   ? "vectors"
                     : type == 3 ? "metrics"
                                 : "matrices");
}

std::string why_no_length(double value) {
  if (std::isfinite(value) && value > 0) return {};
  return fmt::format("{:g} is no length: expected a number above 0", value);
}

std::vector<double> read_text(const InputFile& file) {
  TextReader reader(file, '#');
  constexpr std::int64_t kMostVersion = 4;
  if (reader.expect_word("'MeshVersionFormatted'") != "MeshVersionFormatted") {
    reader.fail("this is not a solution file of MEDIT: expected 'MeshVersionFormatted'");
  }
  reader.integer("a version", 1, kMostVersion);
  for (std::string_view word = reader.word(); !word.empty(); word = reader.word()) {
    if (word == "End") break;
    if (word == "Dimension") {
      if (reader.integer("a dimension", 2, 3) != 3) reader.fail("expected dimension 3");
    }
    if (word != "SolAtVertices") continue;
    const std::size_t count = reader.count("the number of vertices", 2);
    const std::int64_t solutions = reader.integer("the number of solutions", 1, kMostSolutions);
    const std::int64_t type = reader.integer("the type of a solution", 1, 4);
    if (const auto why = why_no_lengths(solutions, type); !why.empty()) reader.fail(why);
    std::vector<double> lengths;
    lengths.reserve(count);
    while (lengths.size() < count) {
      lengths.push_back(reader.real("a length"));
      if (const auto why = why_no_length(lengths.back()); !why.empty()) reader.fail(why);
    }
    return lengths;
  }
  reader.fail_at(file.end(), "the section SolAtVertices is missing");
}

class BinarySizes {
 public:
  explicit BinarySizes(const InputFile& file) : bytes_(file) {}

  std::vector<double> read() {
    constexpr std::int32_t kEnd = 54;
    constexpr std::int32_t kSolAtVertices = 62;
    read_header();
    while (bytes_.bytes_left() > 0) {
      const auto keyword = bytes_.number<std::int32_t>("a keyword");
      if (keyword == kEnd) break;
      const std::size_t at = bytes_.position();
      const std::int64_t next = version_ >= 3 ? bytes_.number<std::int64_t>("a position")
                                              : bytes_.number<std::int32_t>("a position");
      if (keyword == kSolAtVertices) return version_ == 1 ? values<float>() : values<double>();
      if (next == 0) break;  // the last section of a file without an end keyword
      if (next < static_cast<std::int64_t>(bytes_.position()) ||
          next > static_cast<std::int64_t>(bytes_.size())) {
        bytes_.fail_at(at, fmt::format("the position {} of the next keyword is wrong; the file may "
                                       "be truncated",
                                       next));
      }
      bytes_.seek(static_cast<std::size_t>(next));
    }
    bytes_.fail_at(bytes_.size(), "the section SolAtVertices is missing");
  }

 private:
  void read_header() {
    const auto cookie = bytes_.number<std::int32_t>("the cookie 1");
    if (cookie != 1 && cookie != byte_swapped(std::int32_t{1})) {
      bytes_.fail_at(std::size_t{0}, "this is not a binary solution file of MEDIT");
    }
    bytes_.set_swap(cookie != 1);
    version_ = bytes_.number<std::int32_t>("the version of the format");
    if (version_ >= 1 && version_ <= kNewestMeditVersion) return;
    bytes_.fail_at(sizeof cookie,
                   fmt::format("version {} of the format is unknown: expected 1 to {}", version_,
                               kNewestMeditVersion));
  }

  template <class Real>
  std::vector<double> values() {
    const std::size_t at = bytes_.position();
    const std::int64_t count = version_ == 4 ? bytes_.number<std::int64_t>("a count")
                                             : bytes_.number<std::int32_t>("a count");
    const auto solutions = bytes_.number<std::int32_t>("the number of solutions");
    const std::size_t type_at = bytes_.position();
    const auto type = bytes_.number<std::int32_t>("the type of a solution");
    if (const auto why = why_no_lengths(solutions, type); !why.empty()) {
      bytes_.fail_at(type_at, why);
    }
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.bytes_left() / sizeof(Real)) {
      bytes_.fail_at(at, fmt::format("{} lengths cannot be in what is left of the file", count));
    }
    std::vector<double> lengths;
    lengths.reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      const std::size_t here = bytes_.position();
      lengths.push_back(static_cast<double>(bytes_.number<Real>("a length")));
      if (const auto why = why_no_length(lengths.back()); !why.empty()) bytes_.fail_at(here, why);
    }
    return lengths;
  }

  ByteReader bytes_;
  std::int32_t version_ = 0;
};

}  // namespace

std::vector<double> read_medit_sizes(const std::filesystem::path& path) {
  const InputFile file(path);
  return path.extension() == ".solb" ? BinarySizes(file).read() : read_text(file);
}

}  // namespace tetmend::formats
