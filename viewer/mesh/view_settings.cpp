// SPDX-License-Identifier: MIT
#include "viewer/mesh/view_settings.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "viewer/mesh/colour_map.h"
#include "viewer/mesh/tet_values.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

constexpr double kAny = std::numeric_limits<double>::max();

/// Valid values of a number.
struct Limits {
  double low = -kAny;
  double high = kAny;
};

constexpr std::array<std::string_view, 3> kBackgrounds = {"gradient", "white", "transparent"};

struct Writer {
  json out = json::object();

  template <class T>
  void operator()(const char* name, const T& value, Limits = {}) {
    out[name] = value;
  }
  void operator()(const char* name, const glm::dvec3& v, Limits = {}) {
    out[name] = {v.x, v.y, v.z};
  }
  void operator()(const char* name, const Background& value, Limits = {}) {
    out[name] = kBackgrounds[static_cast<std::size_t>(value)];
  }
  void operator()(const char* name, const Range& range, Limits = {}) {
    out[name] = {range.low, range.high};
  }
  template <class Visit>
  void group(const char* name, Visit visit) {
    Writer inner;
    visit(inner);
    out[name] = inner.out;
  }
};

/// Takes the keys it is shown; check_all_taken() complains about the others.
class Reader {
 public:
  Reader(const json& in, std::string where) : in_(in), where_(std::move(where)) {
    if (!in.is_object()) fail(where_, "a table of settings", in);
  }

  void operator()(const char* name, bool& value, Limits = {}) {
    if (const json* j = take(name)) {
      if (!j->is_boolean()) fail(path(name), "true or false", *j);
      value = j->get<bool>();
    }
  }
  void operator()(const char* name, double& value, Limits limits = {}) {
    if (const json* j = take(name)) value = number(path(name), *j, limits);
  }
  void operator()(const char* name, int& value, Limits limits) {
    if (const json* j = take(name)) {
      value = static_cast<int>(std::lround(number(path(name), *j, limits)));
    }
  }
  void operator()(const char* name, std::string& value, Limits = {}) {
    if (const json* j = take(name)) {
      if (!j->is_string()) fail(path(name), "a word in quotes", *j);
      value = j->get<std::string>();
    }
  }
  void operator()(const char* name, Background& value, Limits = {}) {
    if (const json* j = take(name)) {
      const auto* found = std::find(kBackgrounds.begin(), kBackgrounds.end(),
                                    j->is_string() ? j->get<std::string>() : "");
      if (found == kBackgrounds.end()) {
        fail(path(name), fmt::format("one of {}", fmt::join(kBackgrounds, ", ")), *j);
      }
      value = static_cast<Background>(found - kBackgrounds.begin());
    }
  }
  void operator()(const char* name, glm::dvec3& value, Limits limits = {}) {
    if (const json* j = take(name)) {
      if (!j->is_array() || j->size() != 3) fail(path(name), "three numbers", *j);
      for (int i = 0; i < 3; ++i) {
        value[i] = number(path(name), (*j)[static_cast<std::size_t>(i)], limits);
      }
    }
  }
  void operator()(const char* name, Range& value, Limits limits = {}) {
    if (const json* j = take(name)) {
      if (!j->is_array() || j->size() != 2) fail(path(name), "two numbers", *j);
      value = {number(path(name), (*j)[0], limits), number(path(name), (*j)[1], limits)};
      if (value.low > value.high) fail(path(name), "the smaller number first", *j);
    }
  }
  void operator()(const char* name, std::vector<Label>& value, Limits = {}) {
    if (const json* j = take(name)) {
      if (!j->is_array() && !(j->is_object() && j->empty())) fail(path(name), "a list", *j);
      value.clear();
      for (const json& item : *j) {
        value.push_back(static_cast<Label>(number(path(name), item, {-0x1p31, 0x1p31 - 1})));
      }
    }
  }
  template <class Visit>
  void group(const char* name, Visit visit) {
    if (const json* j = take(name)) {
      Reader inner(*j, path(name));
      visit(inner);
      inner.check_all_taken();
    } else {
      json nothing = json::object();
      Reader inner(nothing, path(name));
      visit(inner);
    }
  }

  void check_all_taken() const {
    for (const auto& item : in_.items()) {
      if (std::find(names_.begin(), names_.end(), item.key()) != names_.end()) continue;
      throw Error(fmt::format("view: there is no setting '{}': expected one of {}",
                              path(item.key()), fmt::join(names_, ", ")));
    }
  }

 private:
  std::string path(const std::string& name) const {
    return where_.empty() ? name : where_ + "." + name;
  }
  const json* take(const char* name) {
    names_.emplace_back(name);
    const auto found = in_.find(name);
    return found == in_.end() ? nullptr : &*found;
  }
  [[noreturn]] static void fail(const std::string& path, const std::string& expected,
                                const json& got) {
    throw Error(fmt::format("view: {} must be {}, not {}", path.empty() ? "it" : path, expected,
                            got.dump(-1, ' ', true, json::error_handler_t::replace)));
  }
  static double number(const std::string& path, const json& j, Limits limits) {
    if (!j.is_number()) fail(path, "a number", j);
    const double value = j.get<double>();
    if (value >= limits.low && value <= limits.high) return value;
    fail(path, fmt::format("from {} to {}", limits.low, limits.high), j);
  }

  const json& in_;
  std::string where_;
  std::vector<std::string> names_;
};

/// The one list of all settings, for reading and writing. View is const or not.
template <class Visitor, class View>
void visit(Visitor& v, View& view) {
  constexpr double kFar = 1e12;
  v.group("camera", [&](auto& w) {
    w("target", view.camera.target, {-1e100, 1e100});
    w("distance", view.camera.distance, {1.0 / kFar, 1e100});
    w("yaw", view.camera.yaw, {-360, 360});
    w("pitch", view.camera.pitch, {-90, 90});
    w("orthographic", view.camera.orthographic);
  });
  auto& s = view.scene;
  v("colour", s.colour);
  v("map", s.map);
  v("measure", s.measure);
  v("bad", s.bad);
  v("bad_beyond_cuts", s.bad_beyond_cuts);
  v("bad_below", s.bad_below, {-1, 2});
  v("filtered", s.filtered);
  v("range", s.range);
  v("outside", s.outside);
  constexpr std::array<const char*, 3> kCuts = {"cut_1", "cut_2", "cut_3"};
  for (std::size_t i = 0; i < kCuts.size(); ++i) {
    v.group(kCuts[i], [&](auto& w) {
      w("on", s.cuts[i].on);
      w("exact", s.cuts[i].exact);
      w("normal", s.cuts[i].normal, {-1e100, 1e100});
      w("position", s.cuts[i].position, {-kFar, kFar});
    });
  }
  v("peel", s.peel, {0, 1000000});
  v("shrink", s.shrink, {0, 0.9});
  v("ghosts", s.ghosts, {0, 1});
  v("outline", s.outline);
  v("reference", s.reference, {0, 1});
  v("both_ways", s.both_ways);
  v("constraints", s.constraints);
  v("isolate", s.isolate);
  v("hidden_regions", s.hidden_regions);
  v("edges", view.edges);
  v("numbers", view.numbers);
  v("all_numbers", view.all_numbers);
  v("legend", view.legend);
  v("blended", view.blended);
  v("blend", view.blend, {0, 1});
  v("theme", view.theme);
  v("background", view.background);
  v("colour_bar", view.colour_bar);
  v("scale_bar", view.scale_bar);
  v("title", view.title);
}

void check(const ViewSettings& view) {
  const std::string& colour = view.scene.colour;
  if (colour != "region" && colour != kDistance) find_tet_value(colour);
  find_tet_value(view.scene.measure);
  find_colour_map(view.scene.map);
  for (const CutPlane& cut : view.scene.cuts) {
    if (!(glm::length(cut.normal) > 0)) throw Error("view: the normal of a cut must not be 0");
  }
  if (view.theme != "light" && view.theme != "dark") {
    throw Error(fmt::format("view: there is no theme '{}': expected light or dark", view.theme));
  }
}

}  // namespace

void ViewSettings::show_reference(bool on) {
  constexpr double kGhost = 0.3;
  scene.colour = on ? kDistance : "region";
  scene.reference = on ? kGhost : 0;
  colour_bar = on;
}

json to_json(const ViewSettings& view) {
  Writer writer;
  visit(writer, view);
  return writer.out;
}

void apply_json(ViewSettings& view, const json& patch) {
  ViewSettings changed = view;
  Reader reader(patch, "");
  visit(reader, changed);
  reader.check_all_taken();
  check(changed);
  view = changed;
}

void apply_json_text(ViewSettings& view, const std::string& text) {
  const json patch = json::parse(text, nullptr, false);
  if (patch.is_discarded()) throw Error("view: this is no JSON text: " + text.substr(0, 60));
  apply_json(view, patch);
}

}  // namespace tetmend::viewer
