// SPDX-License-Identifier: MIT
#include "face/growth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "kernel/chunks.h"
#include "kernel/from_chars.h"
#include "kernel/grouped.h"
#include "kernel/star.h"

namespace tetmend::face {

namespace {

constexpr std::size_t kSample = 20'000;

template <class Number>
std::optional<Number> read_whole(std::string_view text) {
  Number number{};
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Mean length of the edges at a vertex.
double local_length(const TetMesh& mesh, VertexHandle v) {
  const auto ring = one_ring(mesh, v);
  double sum = 0;
  for (const VertexHandle other : ring) sum += (mesh.point(other) - mesh.point(v)).norm();
  return ring.empty() ? 0 : sum / static_cast<double>(ring.size());
}

std::optional<std::uint64_t> number_in_file(const TetMesh& mesh, VertexHandle v) {
  const std::uint32_t number = mesh.origin(v);
  return number == TetMesh::kNotFromFile ? std::nullopt : std::optional<std::uint64_t>(number);
}

double at_share(std::vector<double>& ratios, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(ratios.size() - 1));
  std::nth_element(ratios.begin(), ratios.begin() + place, ratios.end());
  return ratios[static_cast<std::size_t>(place)];
}

}  // namespace

Growth::Growth(const std::string& tets, std::size_t more) : text_(tets), more_(more) {
  if (tets.empty()) return;
  std::string_view text = tets;
  if (text.back() == '%') {
    const auto percent = read_whole<double>(text.substr(0, text.size() - 1));
    if (percent && *percent >= 0 && std::isfinite(*percent)) share_ = *percent / 100;
  } else {
    is_meant_ = text.back() == '!';
    if (is_meant_) text.remove_suffix(1);
    number_ = read_whole<std::size_t>(text);
  }
  if (share_ || number_) return;
  throw OptionError("tets",
                    fmt::format("tets: '{}' is neither a share like 10% nor a number", tets));
}

std::optional<std::size_t> Growth::most(std::size_t now) const {
  if (number_ && *number_ < now && !is_meant_) {
    constexpr std::size_t kMostPercent = 100;
    const std::string guess = *number_ <= kMostPercent ? fmt::format(": did you mean {}%?", text_)
                                                       : ": 0% keeps the mesh from growing.";
    throw OptionError("tets",
                      fmt::format("tets: {} is less than the {} tets that are there{} write {}! "
                                  "if that is meant",
                                  text_, grouped(now), guess, text_));
  }
  if (!share_) return number_;
  const double most = std::max((1 + *share_) * static_cast<double>(now),
                               static_cast<double>(now) + static_cast<double>(more_));
  return most < 1e18 ? std::optional(static_cast<std::size_t>(most + 1e-9)) : std::nullopt;
}

LocalLengths::LocalLengths(std::size_t count) : count_(count) {
  step_ = count / kSample + 1;
  lengths_.assign((count + step_ - 1) / step_, 0);
}

LocalLengths::LocalLengths(const TetMesh& mesh, std::size_t count) : LocalLengths(count) {
  measure(mesh, [&](VertexHandle v) { return number_in_file(mesh, v); });
}

void LocalLengths::add(const TetMesh& mesh,
                       const std::function<std::optional<std::uint64_t>(VertexHandle)>& number_of) {
  measure(mesh, number_of);
}

LocalLengths LocalLengths::renewed(const TetMesh& mesh) const {
  LocalLengths now(count_);
  now.measure(mesh, [&](VertexHandle v) {
    const auto number = number_in_file(mesh, v);
    if (!number || *number % step_ != 0 || mesh.changed(v) != 0 || mesh.moved(v) != 0) {
      return number;
    }
    now.lengths_[*number / step_] = lengths_[*number / step_];
    return std::optional<std::uint64_t>();
  });
  return now;
}

/// At the chosen ones of the vertices that have a number.
template <class NumberOf>
void LocalLengths::measure(const TetMesh& mesh, const NumberOf& number_of) {
  constexpr std::size_t kVerticesOfChunk = 4096;
  for_chunks(
      mesh.vertex_slots(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const VertexHandle v(static_cast<std::uint32_t>(i));
          if (mesh.is_deleted(v)) continue;
          const std::optional<std::uint64_t> number = number_of(v);
          if (!number || *number % step_ != 0) continue;
          lengths_[*number / step_] = mesh.scale().to_file(local_length(mesh, v));
        }
      },
      kVerticesOfChunk);
}

SizeDrift LocalLengths::drift_to(const LocalLengths& after) const {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    if (lengths_[i] > 0 && after.lengths_[i] > 0) ratios.push_back(after.lengths_[i] / lengths_[i]);
  }
  if (ratios.empty()) return {};
  return {.one_percent = at_share(ratios, 0.01),
          .median = at_share(ratios, 0.5),
          .ninety_nine_percent = at_share(ratios, 0.99)};
}

}  // namespace tetmend::face
