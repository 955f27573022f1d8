// SPDX-License-Identifier: MIT
#include "viewer/commands/controller.h"

#include <cmath>
#include <fstream>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

TEST_CASE("a drag turns the camera and selects nothing, a click selects") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  Controller controller(s.session);
  const double yaw = s.document.view.camera.yaw;
  controller.press(Button::left, 200, 150, false);
  controller.move(240, 150);
  controller.release(240, 150, 1);
  CHECK(s.document.view.camera.yaw != yaw);
  CHECK(std::holds_alternative<std::monostate>(s.document.selection()));
  controller.press(Button::left, 200, 150, false);
  controller.move(201, 150);
  controller.release(201, 150, 2);
  CHECK_FALSE(std::holds_alternative<std::monostate>(s.document.selection()));
}

TEST_CASE("a right drag and a drag with Shift move the target") {
  TestSession s(test::one_tet());
  Controller controller(s.session);
  for (const bool shift : {false, true}) {
    const Camera before = s.document.view.camera;
    controller.press(shift ? Button::left : Button::right, 10, 10, shift);
    controller.move(60, 10);
    controller.release(60, 10, 0);
    CHECK(s.document.view.camera.yaw == before.yaw);
    CHECK(s.document.view.camera.target != before.target);
  }
}

TEST_CASE("a double click comes closer to what it picks") {
  TestSession s(test::kuhn_cube(4, 0, 1));
  Controller controller(s.session);
  const double distance = s.document.view.camera.distance;
  for (const double time : {5.0, 5.2}) {
    controller.press(Button::left, 200, 150, false);
    controller.release(200, 150, time);
  }
  CHECK(s.document.view.camera.distance < distance / 2);
}

TEST_CASE("a key runs its command, and an error becomes a message") {
  TestSession s(test::one_tet());
  Controller controller(s.session);
  controller.key("X");
  CHECK(s.document.view.scene.cuts[0].on);
  controller.key("Ctrl+V");  // nothing there
  CHECK(s.document.message.is_error);
  const Message message = s.document.message;
  controller.key("Ctrl+Alt+Nonsense");
  CHECK(s.document.message.text == message.text);
}

TEST_CASE("a mesh or a view that is dropped is taken") {
  TestSession s(test::one_tet());
  Controller controller(s.session);
  const test::TempFolder folder;
  write_mesh(folder / "two.mesh", test::two_tets());
  controller.drop(folder / "two.mesh");
  CHECK(s.document.mesh().tet_count() == 2);
  std::ofstream(folder / "view.json") << R"({"peel": 4})";
  controller.drop(folder / "view.json");
  CHECK(s.document.view.scene.peel == 4);
  controller.drop(folder / "missing.json");
  CHECK(s.document.message.is_error);
}

TEST_CASE(
    "a word that is typed beside a box is taken back at once, a key that is held is not one") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  Controller controller(s.session);
  const auto type = [&](std::string_view word, double& time) {
    for (const char c : word) {
      const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      controller.letter(c, c == ' ' ? "Space" : std::string(1, capital), time += 0.1);
    }
  };
  double time = 10;
  const auto before = to_json(s.document.view);
  type("beta o", time);
  CHECK(to_json(s.document.view) != before);
  REQUIRE(s.document.offer);
  CHECK(s.document.offer->text.find("\"beta o\"") != std::string::npos);
  s.document.offer->take_back(s.document);
  CHECK(to_json(s.document.view) == before);

  s.document.offer.reset();
  type("++++++", time += 5);
  CHECK_FALSE(s.document.offer);
  for (const char c : std::string("sbeo")) {  // one after the other, each looked at
    const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    controller.letter(c, std::string(1, capital), time += 2);
  }
  CHECK_FALSE(s.document.offer);
}

TEST_CASE(
    "a picture under a name that nobody chose is named and can be removed, as part of a word too") {
  const test::TempFolder folder;
  const std::filesystem::path home = std::filesystem::current_path();
  std::filesystem::current_path(folder / ".");
  TestSession s(test::one_tet());
  Controller controller(s.session);
  controller.letter('p', "P", 10);
  REQUIRE(s.document.offer);
  CHECK(s.document.offer->text.find((folder / "tetmend-view.png").string()) != std::string::npos);
  CHECK(std::filesystem::exists("tetmend-view.png"));
  const Offer first = *s.document.offer;
  first.take_back(s.document);
  CHECK_FALSE(std::filesystem::exists("tetmend-view.png"));

  double time = 20;
  for (const char c : std::string("help pipes")) {
    const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    controller.letter(c, c == ' ' ? "Space" : std::string(1, capital), time += 0.1);
  }
  CHECK(std::filesystem::exists("tetmend-view.png"));
  CHECK(std::filesystem::exists("tetmend-view-2.png"));
  REQUIRE(s.document.offer);
  const Offer word = *s.document.offer;
  word.take_back(s.document);
  CHECK_FALSE(std::filesystem::exists("tetmend-view.png"));
  CHECK_FALSE(std::filesystem::exists("tetmend-view-2.png"));
  std::filesystem::current_path(home);
}

TEST_CASE("what went wrong is forgotten with the next act") {
  TestSession s(test::one_tet());
  Controller controller(s.session);
  controller.key("Ctrl+V");  // nothing there
  REQUIRE(s.document.message.is_error);
  controller.key("E");
  CHECK_FALSE(s.document.message.is_error);
  controller.key("Ctrl+V");
  REQUIRE(s.document.message.is_error);
  controller.press(Button::left, 200, 150, false);
  controller.release(200, 150, 1);
  CHECK_FALSE(s.document.message.is_error);
}

TEST_CASE("a lesson is opened by its JSON file, too, typed or dropped") {
  const std::filesystem::path lesson = TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.json";
  TestSession s(test::one_tet());
  Controller(s.session).drop(lesson);
  CHECK_FALSE(s.document.message.is_error);
  REQUIRE(s.document.debugger() != nullptr);
  CHECK(s.document.debugger()->lesson());
  CHECK(s.document.teaching);
  TestSession typed(test::one_tet());
  typed.run("open", {lesson.string()});
  CHECK(typed.document.debugger() != nullptr);

  const test::TempFolder folder;
  std::ofstream(folder / "view.json") << R"({"peel": 4})";
  CHECK_THROWS_WITH_AS(typed.run("open", {(folder / "view.json").string()}),
                       doctest::Contains("view.json: is no lesson"), Error);
  std::ofstream(folder / "a.json")
      << R"({"title": "", "mesh": "b.mesh", "trace": "b.trace", "steps": [{"at": 0, "text": ""}]})";
  CHECK_THROWS_WITH_AS(typed.run("open", {(folder / "a.json").string()}),
                       doctest::Contains("expected 'a.trace', not 'b.trace'"), Error);
  CHECK(typed.document.debugger() != nullptr);
}

TEST_CASE("ten thousand random events leave a document that can be drawn") {
  TestSession s(test::two_regions());
  const test::TempFolder folder;
  write_mesh(folder / "a.mesh", test::delaunay_ball(60, 2));
  write_mesh(folder / "b.mesh", test::two_regions());
  Controller controller(s.session);
  test::Random random(7);
  std::vector<std::string_view> keys;
  for (const Command& command : commands()) {
    // Pictures would be written into the folder of the tests.
    if (!command.keys.empty() && command.name != "screenshot") keys.push_back(command.keys);
  }
  for (int i = 0; i < 10000; ++i) {
    const double x = random.real(-50, 450);
    const double y = random.real(-50, 350);
    switch (random.index(8)) {
      case 0:
        controller.press(static_cast<Button>(random.index(3)), x, y, random.index(2) == 0);
        break;
      case 1:
        controller.release(x, y, i * 0.1);
        break;
      case 2:
      case 3:
        controller.move(x, y);
        break;
      case 4:
        controller.scroll(random.real(-3, 3), x, y);
        break;
      case 5:
        s.run("brush", {random.real(-0.2, 1.2), random.real(-0.2, 1.2)});
        break;
      case 6:
        controller.key(keys[random.index(keys.size())]);
        break;
      default:
        if (random.index(50) == 0) controller.drop(folder / (i % 2 == 0 ? "a.mesh" : "b.mesh"));
    }
    const Scene& scene = s.document.scene();
    REQUIRE(scene.surface.size() == 3 * scene.surface_tets.size());
    REQUIRE(std::isfinite(glm::length(s.document.view.camera.eye())));
    REQUIRE(s.document.view.camera.distance > 0);
  }
  CHECK(state_of(s.document)["tets"] > 0);
}
