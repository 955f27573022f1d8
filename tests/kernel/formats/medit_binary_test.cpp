// SPDX-License-Identifier: MIT
// MEDIT binary files of every version and byte order, made by hand, and how bad ones are refused.
#include <doctest/doctest.h>

#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Writes sections as libMeshb does: keyword, position of the next keyword, content.
class Meshb {
 public:
  Meshb(int version, std::endian order) : version_(version), bytes_(order) {
    bytes_.add(std::int32_t{1}).add(std::int32_t{version});
    section(3, 4).bytes_.add(std::int32_t{3});
  }
  Meshb& section(std::int32_t keyword, std::size_t content) {
    bytes_.add(keyword);
    return position(bytes_.size() + (version_ >= 3 ? 8 : 4) + content);
  }
  Meshb& position(std::size_t value) {
    if (version_ >= 3) {
      bytes_.add(static_cast<std::int64_t>(value));
    } else {
      bytes_.add(static_cast<std::int32_t>(value));
    }
    return *this;
  }
  Meshb& integers(const std::vector<std::int64_t>& values) {
    for (const std::int64_t value : values) {
      if (version_ == 4) {
        bytes_.add(value);
      } else {
        bytes_.add(static_cast<std::int32_t>(value));
      }
    }
    return *this;
  }
  Meshb& reals(const std::vector<double>& values) {
    for (const double value : values) {
      if (version_ == 1) {
        bytes_.add(static_cast<float>(value));
      } else {
        bytes_.add(value);
      }
    }
    return *this;
  }
  std::size_t integer_size() const { return version_ == 4 ? 8 : 4; }
  std::size_t real_size() const { return version_ == 1 ? 4 : 8; }

  /// A section of integers: the count, then rows.
  Meshb& rows(std::int32_t keyword, std::int64_t count, const std::vector<std::int64_t>& values) {
    section(keyword, integer_size() * (1 + values.size()));
    return integers({count}).integers(values);
  }
  Meshb& vertices(const std::vector<std::vector<double>>& points, std::int64_t label) {
    section(4, integer_size() + points.size() * (3 * real_size() + integer_size()));
    integers({static_cast<std::int64_t>(points.size())});
    for (const auto& point : points) reals(point).integers({label});
    return *this;
  }
  std::string end() {
    bytes_.add(std::int32_t{54});
    position(0);
    return bytes_.str();
  }
  const std::string& str() const { return bytes_.str(); }

 private:
  int version_;
  Bytes bytes_;
};

const std::vector<std::vector<double>> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0, 1}};

Meshb tetrahedron(int version, std::endian order = std::endian::little) {
  Meshb file(version, order);
  file.rows(8, 1, {1, 2, 3, 4, -7})
      .vertices(kCorners, 5);   // tets first: sections may come in any order
  file.rows(38, 1, {1, 2, 3});  // passed over
  file.rows(6, 1, {1, 2, 3, 8}).rows(5, 1, {1, 4, 9}).rows(15, 2, {4, 1});
  return file;
}

std::string with_bytes(std::string content, std::size_t at, const Bytes& bytes) {
  return content.replace(at, bytes.size(), bytes.str());
}

}  // namespace

TEST_CASE("a binary MEDIT file of versions 1 to 4 in either byte order is read") {
  const TempFolder folder;
  for (const int version : {1, 2, 3, 4}) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      CAPTURE(version);
      write_text(folder / "a.meshb", tetrahedron(version, order).end());
      const MeshData mesh = read_mesh(folder / "a.meshb");
      REQUIRE(mesh.points.size() == 4);
      CHECK(mesh.points[3] == Point(0.25, 0, 1));
      CHECK(mesh.point_labels == std::vector<Label>{5, 5, 5, 5});
      CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, -7}});
      CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 8}});
      CHECK(mesh.edges == std::vector<MeshData::Edge>{{{0, 3}, 9}});
      CHECK(mesh.required_vertices == std::vector<std::uint32_t>{3, 0});
    }
  }
}

TEST_CASE("a MEDIT file whose name ends as that of the other kind is told so") {
  const TempFolder folder;
  const auto refused = [&](const std::string& name, const std::string& content) {
    write_text(folder / name, content);
    return error_of_reading(folder / name);
  };
  for (const int version : {1, 2, 3, 4}) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      CAPTURE(version);
      const std::string told = refused("a.mesh", Meshb(version, order).end());
      CHECK(told.ends_with(
          "a.mesh:1: this looks like a binary MEDIT file: its name should end in .meshb"));
    }
  }
  CHECK(
      refused("a.meshb", "MeshVersionFormatted 2\nDimension 3\n")
          .ends_with("byte 0: this looks like a MEDIT file in text: its name should end in .mesh"));
  const std::string other_version("\1\0\0\0\5\0\0\0", 8);
  CHECK(refused("a.mesh", other_version).find("is not the beginning") != std::string::npos);
  CHECK(refused("a.mesh", other_version.substr(0, 7)).find("is not the beginning") !=
        std::string::npos);
}

TEST_CASE("a binary MEDIT file without an end keyword is read") {
  const TempFolder folder;
  write_text(folder / "a.meshb", tetrahedron(2).str());
  CHECK(read_mesh(folder / "a.meshb").tets.size() == 1);
  Meshb last(3, std::endian::little);
  last.vertices(kCorners, 0);
  // Position 0 marks the last section.
  const std::string content = Bytes()
                                  .text(last.str())
                                  .add(std::int32_t{8})
                                  .add(std::int64_t{0})
                                  .add_all<std::int32_t>({1, 1, 2, 3, 4, 0})
                                  .str();
  write_text(folder / "a.meshb", content);
  CHECK(read_mesh(folder / "a.meshb").tets.size() == 1);
}

TEST_CASE("a binary MEDIT file of any version with a byte changed or cut away never crashes") {
  const TempFolder folder;
  for (const int version : {1, 2, 3, 4}) {
    const auto file = folder / ("a" + std::to_string(version) + ".meshb");
    write_text(file, tetrahedron(version, std::endian::big).end());
    change_each_byte(file, file);
    cut_at_each_byte(file);
  }
}

TEST_CASE("a bad binary MEDIT file is refused with byte and reason") {
  // Version 2: cookie, version, then Dimension at 8, Tetrahedra at 20 (position 24, count 28, row
  // 32), Vertices at 52.
  const std::string good = tetrahedron(2).end();
  const auto int32_at = [&](std::size_t at, std::int32_t value) {
    return with_bytes(good, at, Bytes().add(value));
  };
  const auto with_tets = [](int version, std::int64_t count,
                            const std::vector<std::int64_t>& values) {
    return Meshb(version, std::endian::little).rows(8, count, values).vertices(kCorners, 0).end();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<BadFile> files = {
      {"text", "MeshVersionFormatted 2\n", "0: ", "looks like a MEDIT file in text"},
      {"other text", "solid cube\n", "0: ", "is not that of a binary MEDIT file"},
      {"three bytes", std::string("\x01\0\0", 3),
       "0: ", "the file ends where the cookie 1 is expected"},
      {"only cookie", good.substr(0, 4), "4: ", "the file ends where the version"},
      {"version 5", int32_at(4, 5), "4: ", "version 5 of the format is unknown: expected 1 to 4"},
      {"dimension 2", int32_at(16, 2), "16: ", "the dimension is 2: expected 3"},
      {"no dimension", int32_at(8, 60), "", "the section Dimension is missing"},
      {"keyword 0", int32_at(20, 0), "20: ", "0 is not a keyword"},
      {"position circle", int32_at(24, 8),
       "24: ", "the position 8 of the next keyword is wrong: expected 28 to"},
      {"position itself", int32_at(24, 20), "24: ", "the position 20 of the next keyword is wrong"},
      {"negative position", int32_at(24, -4),
       "24: ", "the position -4 of the next keyword is wrong"},
      {"position too far", int32_at(24, 1 << 30), "24: ", "the file may be truncated"},
      {"twice", with_bytes(good, 52, Bytes().add(std::int32_t{8})),
       "52: ", "the keyword 8 appears for the second time"},
      {"marks twice",
       Bytes().add_all(std::vector<std::int32_t>{1, 2, 3, 20, 3, 13, 32, 0, 13, 44, 0}).str(),
       "32: ", "the keyword 13 appears for the second time"},
      {"count too great", int32_at(28, 2),
       "28: ", "the count of 2 tetrahedra does not match the 20 bytes"},
      {"count too small", int32_at(28, 0), "28: ", "the count of 0 tetrahedra does not match"},
      {"count huge", int32_at(28, INT32_MAX), "28: ", "the count of 2147483647 tetrahedra"},
      {"count negative", int32_at(28, -1), "28: ", "the count of -1 tetrahedra"},
      {"count overflows", with_tets(4, INT64_C(0x6666666666666667), {1, 2, 3, 4, 0}),
       "36: ", "does not match"},
      {"index 0", int32_at(36, 0), "36: ", "0 is out of range: expected a vertex number, 1 to 4"},
      {"index 5", int32_at(36, 5), "36: ", "5 is out of range"},
      {"index negative", int32_at(36, INT32_MIN), "36: ", "is out of range"},
      {"index of 64 bits", with_tets(4, 1, {1, 2, INT64_C(0x100000003), 4, 0}),
       "60: ", "4294967299 is out of range"},
      {"label of 64 bits", with_tets(4, 1, {1, 2, 3, 4, INT64_C(2147483648)}),
       "76: ", "the reference 2147483648"},
      {"not finite", with_bytes(good, 64, Bytes().add(nan)), "64: ", "nan is not a finite number"},
      {"no vertices", Meshb(2, std::endian::little).rows(8, 0, {}).end(),
       "40: ", "the section Vertices is missing"},
      {"no tets", Meshb(3, std::endian::little).vertices(kCorners, 0).end(), "",
       "the section Tetrahedra is missing"},
      {"cubic tets", Meshb(2, std::endian::little).rows(98, 1, {1, 2, 3, 4, 5, 6, 7, 8, 0}).end(),
       "28: ", "elements of keyword 98 cannot be read"},
      {"third order", Meshb(2, std::endian::little).rows(86, 1, {1}).end(),
       "28: ", "elements of keyword 86 cannot be read"},
      {"section without count", Meshb(2, std::endian::little).section(4, 0).end(),
       "28: ", "the number of vertices is expected"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.meshb", bad.content);
    const std::string error = error_of_reading(folder / "a.meshb");
    CHECK_MESSAGE(error.starts_with("a.meshb: byte " + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
