// SPDX-License-Identifier: MIT
//   place -> a rank that has all points there -> the number of the first one, which is their id
//   id -> the rank that has that range of ids -> the number among all that there are
#include "pieces/merged_points.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

#include <fmt/format.h>

#include "kernel/error.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

using Place = std::array<std::uint64_t, 3>;

/// Bits of the coordinates; -0 is 0.
Place place_of(const Point& p) {
  Place place{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = p[static_cast<Eigen::Index>(i)] + 0.0;
    std::memcpy(&place[i], &x, sizeof(x));
  }
  return place;
}

std::uint64_t hash(const Place& place) {
  std::uint64_t mixed = 0;
  for (const std::uint64_t bits : place) {
    mixed = (mixed ^ bits) * 0x9E3779B97F4A7C15u;
    mixed ^= mixed >> 32;
  }
  return mixed;
}

struct SentPlace {
  Place place;
  std::uint64_t instance;  // number among the points of all parts
  std::uint64_t part;
};

struct SentPoint {
  std::uint64_t id;
  std::array<double, 3> point;
  Label label;
};

/// Sends one question for each point to a rank, and gives the numbers that came back.
template <class Question, class Ask, class Answer>
std::vector<std::uint64_t> ask_all(std::size_t count, Ranks& ranks, const Ask& ask,
                                   const Answer& answer) {
  std::vector<std::string> to(ranks.count());
  std::vector<std::size_t> asked(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [rank, question] = ask(i);
    asked[i] = rank;
    put(question, to[rank]);
  }
  std::vector<Question> questions;
  std::vector<std::size_t> ends;
  for (const std::string& from : ranks.exchange(std::move(to))) {
    for (std::string_view rest = from; !rest.empty();) pieces::take(rest, questions.emplace_back());
    ends.push_back(questions.size());
  }
  const std::vector<std::uint64_t> numbers = answer(questions);
  std::vector<std::string> back(ranks.count());
  for (std::size_t r = 0, i = 0; r < ends.size(); ++r) {
    for (; i < ends[r]; ++i) put(numbers[i], back[r]);
  }
  const std::vector<std::string> came = ranks.exchange(std::move(back));
  std::vector<std::string_view> rest(came.begin(), came.end());
  std::vector<std::uint64_t> mine(count);
  for (std::size_t i = 0; i < count; ++i) pieces::take(rest[asked[i]], mine[i]);
  return mine;
}

std::vector<std::uint64_t> gather_numbers(std::uint64_t mine, Ranks& ranks) {
  std::string bytes;
  put(mine, bytes);
  std::vector<std::uint64_t> all;
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    pieces::take(rest, all.emplace_back());
  }
  return all;
}

/// Of the points at each place the number of the first.
std::vector<std::uint64_t> first_at_place(const std::vector<SentPlace>& sent) {
  std::vector<std::size_t> order(sent.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sent[a].place != sent[b].place ? sent[a].place < sent[b].place
                                          : sent[a].instance < sent[b].instance;
  });
  std::vector<std::uint64_t> first(sent.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    bool is_twice = false;  // in one part: ascending numbers have ascending parts
    while (end < order.size() && sent[order[end]].place == sent[order[begin]].place) {
      is_twice = is_twice || sent[order[end]].part == sent[order[end - 1]].part;
      ++end;
    }
    const bool is_of_one = sent[order[begin]].part == sent[order[end - 1]].part;
    if (is_twice && !is_of_one) {
      throw Error(
          "two points of a part lie at one place, which another part has, too: the parts must name "
          "their points by numbers of the whole mesh");
    }
    for (std::size_t i = begin; i < end; ++i) {
      first[order[i]] = sent[order[is_of_one ? i : begin]].instance;
    }
    begin = end;
  }
  return first;
}

std::vector<std::uint64_t> ids_by_place(const PartPoints& mine, Ranks& ranks) {
  std::uint64_t before = 0;
  const std::vector<std::uint64_t> counts = gather_numbers(mine.points.size(), ranks);
  for (std::size_t r = 0; r < ranks.number(); ++r) before += counts[r];
  const auto ask = [&](std::size_t i) {
    const SentPlace sent{place_of(mine.points[i]), before + i, mine.part_of[i]};
    return std::pair(static_cast<std::size_t>(hash(sent.place) % ranks.count()), sent);
  };
  return ask_all<SentPlace>(mine.points.size(), ranks, ask, first_at_place);
}

/// Keeps one of the points of each id, and says which it is.
std::vector<std::uint64_t> keep_one_of_each(const std::vector<SentPoint>& sent,
                                            MergedPoints& merged) {
  std::vector<std::size_t> order(sent.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sent[a].id < sent[b].id; });
  std::vector<std::uint64_t> numbers(sent.size());
  const SentPoint* last = nullptr;
  for (const std::size_t i : order) {
    if (last == nullptr || last->id != sent[i].id) {
      last = &sent[i];
      merged.points.emplace_back(last->point[0], last->point[1], last->point[2]);
      merged.labels.push_back(last->label);
    } else if (last->point != sent[i].point) {
      throw Error(fmt::format("point {} of the whole mesh lies at two places", last->id));
    }
    numbers[i] = merged.points.size() - 1;
  }
  return numbers;
}

}  // namespace

MergedPoints merge_points(const PartPoints& mine, Ranks& ranks) {
  MergedPoints merged;
  const bool has_ids = ranks.any(!mine.ids.empty());
  const std::vector<std::uint64_t> ids = has_ids ? mine.ids : ids_by_place(mine, ranks);
  const std::uint64_t largest = ids.empty() ? 0 : *std::max_element(ids.begin(), ids.end());
  const std::vector<std::uint64_t> all = gather_numbers(largest, ranks);
  const std::uint64_t share = *std::max_element(all.begin(), all.end()) / ranks.count() + 1;
  const auto ask = [&](std::size_t i) {
    const Label label = mine.labels.empty() ? 0 : mine.labels[i];
    const Point& p = mine.points[i];
    return std::pair(static_cast<std::size_t>(ids[i] / share),
                     SentPoint{ids[i], {p.x(), p.y(), p.z()}, label});
  };
  const auto answer = [&](const std::vector<SentPoint>& sent) {
    std::vector<std::uint64_t> numbers = keep_one_of_each(sent, merged);
    const std::vector<std::uint64_t> counts = gather_numbers(merged.points.size(), ranks);
    std::uint64_t before = 0;
    for (std::size_t r = 0; r < ranks.number(); ++r) before += counts[r];
    for (std::uint64_t& number : numbers) number += before;
    return numbers;
  };
  merged.numbers = ask_all<SentPoint>(mine.points.size(), ranks, ask, answer);
  const auto is_labelled = [](Label label) { return label != 0; };
  if (!ranks.any(std::any_of(merged.labels.begin(), merged.labels.end(), is_labelled))) {
    merged.labels.clear();
  }
  return merged;
}

}  // namespace tetmend::pieces
