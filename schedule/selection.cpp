// SPDX-License-Identifier: MIT
#include "schedule/selection.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetmend {

namespace {

/// ceil(count * part / whole), in whole numbers.
std::size_t scaled(std::size_t count, std::uint64_t part, std::uint64_t whole) {
  const std::uint64_t rest = count % whole * part;
  return count / whole * part + rest / whole + (rest % whole > 0 ? 1 : 0);
}

}  // namespace

Selection Selection::of_part(std::uint64_t part, std::uint64_t whole) const {
  Selection scaled_one = *this;
  scaled_one.at_least = scaled(at_least, part, whole);
  if (worst != std::numeric_limits<std::size_t>::max()) {
    scaled_one.worst = scaled(worst, part, whole);
  }
  return scaled_one;
}

std::string Selection::describe() const {
  std::string text = fmt::format("below {}", below);
  if (at_least > 0) text += fmt::format(" at_least {}", at_least);
  if (worst != std::numeric_limits<std::size_t>::max()) text += fmt::format(" worst {}", worst);
  if (share < 1) text += fmt::format(" share {}", share);
  if (!labels.empty()) text += fmt::format(" labels {}", fmt::join(labels, ","));
  if (box) {
    const Point& low = box->min();
    const Point& high = box->max();
    text += fmt::format(" box {},{},{},{},{},{}", low.x(), low.y(), low.z(), high.x(), high.y(),
                        high.z());
  }
  if (value) text += fmt::format(" {} {} to {}", value->name, value->low, value->high);
  if (since > 0) text += fmt::format(" since {}", since);
  return text;
}

SelectionTest::SelectionTest(const TetMesh& mesh, const Selection& selection,
                             const TetValues* values, std::span<const Standard> measures)
    : mesh_(mesh),
      selection_(selection),
      plain_(selection.labels.empty() && !selection.box && !selection.value &&
             selection.since == 0) {
  if (selection.value) find_value(values, measures);
}

void SelectionTest::find_value(const TetValues* values, std::span<const Standard> measures) {
  const std::string& name = selection_.value->name;
  if (values != nullptr) named_ = values->find(name);
  if (named_) return;
  for (const Standard& measure : measures) {
    if (measure.measure_name() == name) own_ = &measure;
  }
  if (own_ != nullptr) return;
  try {
    measure_ = &find_quality_measure(name);
  } catch (const Error& error) {
    std::string text = error.what();
    std::vector<std::string_view> own;
    for (const Standard& measure : measures) own.push_back(measure.measure_name());
    if (!own.empty()) text += fmt::format("; measures of the program: {}", fmt::join(own, ", "));
    const auto arrays = values != nullptr ? values->names() : std::vector<std::string>();
    if (!arrays.empty()) text += fmt::format("; arrays of the tets: {}", fmt::join(arrays, ", "));
    throw Error(text);
  }
}

Quality SelectionTest::limit() const {
  return selection_.at_least > 0 ? std::max(selection_.below, kBadThreshold) : selection_.below;
}

bool SelectionTest::admits(TetHandle t) const {
  if (plain_) return true;
  if (!selection_.labels.empty() && std::find(selection_.labels.begin(), selection_.labels.end(),
                                              mesh_.label(t)) == selection_.labels.end())
    return false;
  if (selection_.box) {
    for (const VertexHandle v : mesh_.vertices(t)) {
      if (!selection_.box->contains(mesh_.point_in_file(v))) return false;
    }
  }
  if (selection_.since > 0) {
    const TetVertices& v = mesh_.vertices(t);
    if (std::none_of(v.begin(), v.end(),
                     [&](VertexHandle w) { return mesh_.changed(w) >= selection_.since; }))
      return false;
  }
  if (!selection_.value) return true;
  const double value = value_of(t);
  return value >= selection_.value->low && value <= selection_.value->high;
}

std::size_t SelectionTest::take(std::size_t candidates, std::size_t below) const {
  const double share =
      std::ceil(std::clamp(selection_.share, 0.0, 1.0) * static_cast<double>(mesh_.tet_count()));
  const std::size_t most = std::min(selection_.worst, static_cast<std::size_t>(share));
  return std::min({std::max(below, selection_.at_least), most, candidates});
}

double SelectionTest::value_of(TetHandle t) const {
  if (named_) return named_(mesh_, t);
  const TetVertices& v = mesh_.vertices(t);
  const Point& a = mesh_.point(v[0]);
  const Point& b = mesh_.point(v[1]);
  const Point& c = mesh_.point(v[2]);
  const Point& d = mesh_.point(v[3]);
  if (own_ == nullptr) return measure_->evaluate(a, b, c, d);
  return own_->quality(a, b, c, d) * own_->own()->good;
}

}  // namespace tetmend
