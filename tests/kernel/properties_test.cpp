// SPDX-License-Identifier: MIT
// Property tables by themselves; that they follow a mesh is in tet_mesh_test and transaction_test.
#include "kernel/properties.h"

#include <doctest/doctest.h>

#include "kernel/handles.h"
#include "tests/support/costly.h"

using namespace tetmend;
using tetmend::test::Costly;

TEST_CASE("a table that cannot grow for lack of memory keeps its size") {
  PropertyTable<TetHandle> table;
  table.resize(2);
  const auto number = table.add<int>("number", 7);
  table.add<Costly>("costly", Costly());
  for (const int copies : {0, 1, 3}) {
    Costly::copies_left = copies;
    CHECK_THROWS_AS(table.resize(6), std::bad_alloc);
  }
  Costly::copies_left = Costly::kPlenty;
  table.at(number, TetHandle(1)) = 8;
  table.resize(3);
  CHECK(table.at(number, TetHandle(1)) == 8);
  CHECK(table.at(number, TetHandle(2)) == 7);
}

TEST_CASE("a new property has its default value everywhere, also in slots that come later") {
  PropertyTable<TetHandle> table;
  table.resize(2);
  const auto colour = table.add<std::string>("colour", "grey");
  CHECK(table.at(colour, TetHandle(1)) == "grey");
  table.at(colour, TetHandle(1)) = "red";
  table.resize(3);
  CHECK(table.at(colour, TetHandle(1)) == "red");
  CHECK(table.at(colour, TetHandle(2)) == "grey");
}

TEST_CASE("a property is found by name and type, and only so") {
  PropertyTable<TetHandle> table;
  table.resize(1);
  const auto weight = table.add<double>("weight", 1.5);
  CHECK(weight.is_valid());
  CHECK(table.find<double>("weight").is_valid());
  CHECK(table.at(table.find<double>("weight"), TetHandle(0)) == 1.5);
  CHECK_FALSE(table.find<int>("weight").is_valid());
  CHECK_FALSE(table.find<double>("height").is_valid());
  CHECK_THROWS_WITH_AS(table.add<int>("weight", 0), "property 'weight' exists already", Error);
}

TEST_CASE("removing a property leaves the handles of the others valid and frees its name") {
  PropertyTable<VertexHandle> table;
  table.resize(2);
  const auto first = table.add<int>("first", 1);
  const auto second = table.add<int>("second", 2);
  table.remove(first);
  CHECK_FALSE(table.find<int>("first").is_valid());
  CHECK(table.at(second, VertexHandle(1)) == 2);
  CHECK(table.add<bool>("first", true).is_valid());
}

TEST_CASE("a flag property hands out references like any other") {
  PropertyTable<TetHandle> table;
  table.resize(3);
  const auto flag = table.add<bool>("flag", false);
  bool& reference = table.at(flag, TetHandle(2));
  reference = true;
  CHECK(table.at(flag, TetHandle(2)));
}

TEST_CASE("an entity begins anew with the default values, and saved ones come back") {
  PropertyTable<TetHandle> table;
  table.resize(2);
  const auto number = table.add<int>("number", 7);
  const auto name = table.add<std::string>("name", "none");
  table.at(number, TetHandle(0)) = 8;
  table.at(name, TetHandle(0)) = "eight";
  auto saved = table.save(TetHandle(0));
  table.restore(TetHandle(0), table.initial());
  CHECK(table.at(number, TetHandle(0)) == 7);
  CHECK(table.at(name, TetHandle(0)) == "none");
  table.restore(TetHandle(0), std::move(saved));
  CHECK(table.at(number, TetHandle(0)) == 8);
  CHECK(table.at(name, TetHandle(0)) == "eight");
}

TEST_CASE("gathering keeps the listed entities in the listed order") {
  PropertyTable<TetHandle> table;
  table.resize(4);
  const auto number = table.add<std::uint32_t>("number", 0);
  for (std::uint32_t i = 0; i < 4; ++i) table.at(number, TetHandle(i)) = 10 + i;
  const std::vector<std::uint32_t> kept = {3, 1};
  table.gather(kept);
  CHECK(table.at(number, TetHandle(0)) == 13);
  CHECK(table.at(number, TetHandle(1)) == 11);
  table.resize(3);
  CHECK(table.at(number, TetHandle(2)) == 0);
}

TEST_CASE("a copied table shares nothing with the original") {
  PropertyTable<TetHandle> table;
  table.resize(1);
  const auto number = table.add<int>("number", 1);
  PropertyTable<TetHandle> copy = table;
  copy.at(number, TetHandle(0)) = 2;
  CHECK(table.at(number, TetHandle(0)) == 1);
  table = copy;
  CHECK(table.at(number, TetHandle(0)) == 2);
}
