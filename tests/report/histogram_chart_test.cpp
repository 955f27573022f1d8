// SPDX-License-Identifier: MIT
#include "report/histogram_chart.h"

#include <regex>

#include <doctest/doctest.h>

#include "tests/support/text.h"

using namespace tetmend::report;
using tetmend::test::contains;

namespace {

HistogramContent example_histogram() {
  HistogramContent content;
  content.name = "mean_ratio";
  content.title = "mean <ratio>";
  content.help = "at best 1";
  content.unit = "tets";
  for (int i = 0; i <= 40; ++i) content.edges.push_back(i / 40.0);
  content.before.assign(40, 0);
  content.after.assign(40, 0);
  content.before[5] = 1;
  content.before[30] = 1234567;
  content.after[20] = 1000;
  content.after[39] = 7;
  return content;
}

struct Bin {
  std::size_t bin;
  std::string before, after;
};

std::vector<Bin> bins_of(const std::string& html) {
  std::vector<Bin> bins;
  const std::regex form(
      R"re(data-bin="(\d+)".*?<title>[^<]*?: ([\d,]+) \w+ before, ([\d,]+) after)re");
  for (std::sregex_iterator at(html.begin(), html.end(), form), end; at != end; ++at) {
    bins.push_back({std::stoul((*at)[1]), (*at)[2], (*at)[3]});
  }
  return bins;
}

/// The least y of a path, where it is highest.
double top_of(const std::string& html, const std::string& scale, const std::string& classes) {
  const std::size_t group = html.find("class=\"" + scale);
  const std::size_t path = html.find("<path class=\"" + classes, group);
  REQUIRE(path != std::string::npos);
  const std::string text = html.substr(path, html.find("/>", path) - path);
  double top = 1e9;
  const std::regex form(R"(V([\d.]+))");
  for (std::sregex_iterator at(text.begin(), text.end(), form), end; at != end; ++at) {
    top = std::min(top, std::stod((*at)[1]));
  }
  return top;
}

}  // namespace

TEST_CASE("each bin that is shown says its counts, and bins that are left out are empty") {
  const HistogramContent content = example_histogram();
  const std::vector<Bin> bins = bins_of(histogram_chart(content));
  REQUIRE(!bins.empty());
  CHECK(bins.front().bin == 4);
  CHECK(bins.back().bin == 39);
  for (const Bin& bin : bins) {
    if (bin.bin == 5) CHECK(bin.before == "1");
    if (bin.bin == 30) CHECK(bin.before == "1,234,567");
    if (bin.bin == 20) CHECK(bin.after == "1,000");
    if (bin.bin == 39) CHECK(bin.after == "7");
  }
}

TEST_CASE("the fullest bin reaches the top on both scales, a small one only on the logarithmic") {
  const std::string html = histogram_chart(example_histogram());
  constexpr double kTop = 10;
  constexpr double kBottom = 160;
  CHECK(top_of(html, "scale-log", "before") == doctest::Approx(kTop));
  CHECK(top_of(html, "scale-even", "before") == doctest::Approx(kTop));
  CHECK(top_of(html, "scale-log", "after") < kBottom - 60);
  CHECK(top_of(html, "scale-even", "after") > kBottom - 1);
}

TEST_CASE("a chart of nothing, of one bin and of bad angles is drawn") {
  HistogramContent empty = example_histogram();
  empty.before.assign(40, 0);
  empty.after.assign(40, 0);
  CHECK(bins_of(histogram_chart(empty)).size() >= 8);
  HistogramContent angles = example_histogram();
  angles.bad_below = 0.2;
  angles.bad_above = 0.9;
  CHECK(contains(histogram_chart(angles), "class=\"miss\""));
  CHECK(!contains(histogram_chart(example_histogram()), "class=\"miss\""));
  CHECK(!contains(histogram_chart(example_histogram()), "nan"));
}

TEST_CASE("names are texts") {
  const std::string html = histogram_chart(example_histogram());
  CHECK(contains(html, "mean &lt;ratio&gt;"));
  CHECK(!contains(html, "<ratio>"));
}
