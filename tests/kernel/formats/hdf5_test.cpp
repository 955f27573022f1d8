// SPDX-License-Identifier: MIT
// Files of HDF5: rows of tables, texts.
#include <doctest/doctest.h>

#include "kernel/formats/hdf5_file.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::formats;
using namespace tetmend::test;

TEST_CASE("one row of a table of HDF5 is read, and the others are not") {
  if (!has_hdf5()) return;
  const TempFolder folder;
  const std::filesystem::path path = folder / "a.h5";
  {
    const auto made = make_hdf5("a.h5", "HDF5");
    made->write("steps", std::vector<double>{1, 2, 3, 4, 5, 6}, 3);
    made->write("list", std::vector<std::int32_t>{7, 8, 9});
    write_text(path, made->bytes());
  }
  const InputFile input(path);
  const auto file = open_hdf5(input, "HDF5");
  CHECK(file->row("steps", 0) == DataArray::Values(std::vector<double>{1, 2, 3}));
  CHECK(file->row("steps", 1) == DataArray::Values(std::vector<double>{4, 5, 6}));
  CHECK(file->row("list", 2) == DataArray::Values(std::vector<std::int32_t>{9}));
  CHECK(file->values("steps") == DataArray::Values(std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST_CASE("rows of texts end at the first zero, and without blanks") {
  using Rows = std::vector<std::string>;
  CHECK(text_rows(std::string_view("ab\0xcd  ef", 10), 4) == Rows{"ab", "cd", "ef"});
  CHECK(text_rows("", 4).empty());
  CHECK(text_rows("abc", 0).empty());
}

TEST_CASE("a table of HDF5 that is named again and again counts each time") {
  if (!has_hdf5()) return;
  const TempFolder folder;
  const std::filesystem::path path = folder / "a.h5";
  {
    const auto made = make_hdf5("a.h5", "HDF5");
    made->write("list", std::vector<double>(1000, 0.5));
    write_text(path, made->bytes());
  }
  const InputFile input(path);
  const auto file = open_hdf5(input, "HDF5");
  constexpr int kFree = 1048;  // times 8,000 bytes: less than 8 MB
  for (int k = 0; k < kFree; ++k) CHECK(file->reals("list").size() == 1000);
  CHECK_THROWS_WITH_AS(static_cast<void>(file->values("list")),
                       doctest::Contains("more than 200 times"), Error);
}
