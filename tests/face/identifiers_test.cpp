// SPDX-License-Identifier: MIT
// Which arrays number points or elements, and what new ones are called.
#include "face/identifiers.h"

#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>

using namespace tetmend;
using namespace tetmend::face;

TEST_CASE("whole numbers of which no two are alike are identifiers, reals by their name alone") {
  const std::vector<std::int32_t> ids = {7, 3, 5, -1};
  CHECK(are_identifiers({"anything", 1, ids}));
  CHECK(are_identifiers({"anything", 1, std::vector<std::int64_t>{1LL << 40, 2, 3}}));
  CHECK(!are_identifiers({"anything", 2, ids}));
  CHECK(!are_identifiers({"anything", 1, std::vector<std::int32_t>{7, 3, 7}}));
  CHECK(!are_identifiers({"anything", 1, std::vector<std::int32_t>{1, 2}}));  // labels of two tets
  for (const std::string name : {"GlobalNodeID", "GLOBAL_IDS", "node_id", "Ids", "elementNumber"}) {
    CAPTURE(name);
    CHECK(are_identifiers({name, 1, std::vector<double>{1, 2, 4}}));
    CHECK(!are_identifiers({name, 1, std::vector<double>{1, 2.5, 4}}));
    CHECK(are_identifiers({name, 1, std::vector<float>{1, 2, 4}}));
    CHECK(!are_identifiers({name, 1, std::vector<float>{1, 2.5F, 4}}));
    CHECK(!are_identifiers({name, 1, std::vector<float>{1, 2, 33554432}}));  // 2^25: no 2^25 + 1
  }
  for (const std::string name : {"fluid", "solid", "temperature", ""}) {
    CAPTURE(name);
    CHECK(!are_identifiers({name, 1, std::vector<double>{1, 2, 4}}));
  }
}

TEST_CASE("new points and elements get numbers above the largest of all that share them") {
  const DataArray tets{"id", 1, std::vector<std::int32_t>{10, 30, 20}};
  const DataArray faces{"id", 1, std::vector<std::int32_t>{99}};
  NewIdentifiers numbers({&tets, &faces});
  const std::vector<std::uint32_t> same = {2, kGone, 0, kGone};
  const DataArray made = numbers.carried(tets, same);
  CHECK(made == DataArray{"id", 1, std::vector<std::int32_t>{20, 100, 10, 101}});
  const std::string note = identifier_note(tets, made, "tets", same);
  CHECK(note.find("1 of 3 numbers are gone, 2 are new, from 100 on") != std::string::npos);
  CHECK(identifier_note(tets, tets, "tets", std::vector<std::uint32_t>{0, 1, 2}).empty());
}

TEST_CASE("numbers in single precision stay below those that it does not tell apart") {
  const DataArray ids{"id", 1, std::vector<float>{1, 16777215, 3}};
  NewIdentifiers numbers({&ids});
  CHECK(numbers.carried(ids, std::vector<std::uint32_t>{0, 1, 2, kGone, kGone}) ==
        DataArray{"id", 1, std::vector<float>{1, 16777215, 3, 16777216, 2}});
}

TEST_CASE("where the type holds no greater number, new ones lie between the old") {
  const DataArray ids{"id", 1, std::vector<std::int32_t>{1, INT32_MAX, 3}};
  NewIdentifiers numbers({&ids});
  CHECK(numbers.carried(ids, std::vector<std::uint32_t>{0, 1, 2, kGone, kGone}) ==
        DataArray{"id", 1, std::vector<std::int32_t>{1, INT32_MAX, 3, 2, 4}});
}
