#include "kestrel/vision/match.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

/// Rows like SIFT's: 128 numbers, few of them large, length about 500.
cv::Mat descriptors(int rows, test::Random& random) {
  cv::Mat result(rows, 128, CV_32F);
  for (int i = 0; i < int(result.total()); ++i) {
    result.at<float>(i) = float(std::floor(std::abs(random.normal()) * 44));
  }
  return result;
}

cv::Mat disturbed(const cv::Mat& rows, double sigma, test::Random& random) {
  cv::Mat result = rows.clone();
  for (int i = 0; i < int(result.total()); ++i) {
    result.at<float>(i) += float(sigma * random.normal());
  }
  return result;
}

double row_distance(const cv::Mat& a, int i, const cv::Mat& b, int j) {
  double sum = 0;
  for (int k = 0; k < 128; ++k) {
    const double d = double(a.at<float>(i, k)) - b.at<float>(j, k);
    sum += d * d;
  }
  return std::sqrt(sum);
}

bool same(const std::vector<Match>& a, const std::vector<Match>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Match& x, const Match& y) {
    return x.in_template == y.in_template && x.in_image == y.in_image && x.ratio == y.ratio;
  });
}

/// Lowe's test by looking at all rows, one to one.
std::vector<Match> brute_force(const cv::Mat& rows, const cv::Mat& image, double ratio) {
  std::vector<Match> best(std::size_t(rows.rows), Match{-1, -1, ratio});
  for (int i = 0; i < image.rows; ++i) {
    double first = std::numeric_limits<double>::infinity();
    double second = first;
    int nearest = 0;
    for (int t = 0; t < rows.rows; ++t) {
      const double d = row_distance(rows, t, image, i);
      if (d < first) {
        second = first;
        first = d;
        nearest = t;
      } else if (d < second) {
        second = d;
      }
    }
    Match& claim = best[std::size_t(nearest)];
    if (first / second < claim.ratio) claim = {nearest, i, first / second};
  }
  return best;
}

TEST(Matcher, AgreesWithBruteForce) {
  // Real SIFT rows: a texture and a turned, smaller, noisy view of it.
  test::Random random("brute");
  const cv::Mat seen = test::texture(260, 200, random);
  cv::Mat image = test::view(seen, test::moved({0.8, 0.4, 0, 0}, {130, 100}, {130, 100}), 260, 200);
  test::add_noise(image, 4, random);
  const PixelBox all{0, 0, 260, 200};
  const cv::Mat rows = detect_keypoints(seen, all, {}).descriptors;
  const cv::Mat in_image = detect_keypoints(image, all, {}).descriptors;
  ASSERT_GT(rows.rows, MatchOptions().checks);  // so that the search really stops early
  const std::vector<Match> found = Matcher(rows, {}).match(in_image);
  std::set<std::pair<int, int>> pairs;
  for (const Match& m : found) pairs.emplace(m.in_template, m.in_image);
  int exact = 0;
  int agreed = 0;
  for (const Match& m : brute_force(rows, in_image, MatchOptions().ratio)) {
    if (m.in_image < 0) continue;
    ++exact;
    agreed += int(pairs.count({m.in_template, m.in_image}));
  }
  ASSERT_GT(exact, 50);
  EXPECT_GE(agreed, 0.95 * exact);
  EXPECT_LE(int(found.size()), 1.05 * exact);  // nor does stopping early invent matches
}

TEST(Matcher, IsExactWhenEveryLeafIsVisited) {
  test::Random random("exact");
  const cv::Mat rows = descriptors(60, random);
  const cv::Mat image = disturbed(rows, 25, random);
  MatchOptions options;
  options.ratio = 0.95;
  const std::vector<Match> found = Matcher(rows, options).match(image);
  ASSERT_EQ(found.size(), 60U);
  for (const Match& m : brute_force(rows, image, options.ratio)) {
    const Match& f = found[std::size_t(m.in_image)];
    EXPECT_EQ(f.in_template, m.in_template);
    EXPECT_NEAR(f.ratio, m.ratio, 1e-5);  // distances are floats
  }
}

TEST(Matcher, KeepsTheMostDistinctiveClaimOnly) {
  test::Random random("claims");
  const cv::Mat rows = descriptors(40, random);
  cv::Mat image;
  image.push_back(disturbed(rows, 12, random));  // image row 40 + i claims the same row better
  image.push_back(disturbed(rows, 3, random));
  image.push_back(disturbed(rows, 8, random));
  const std::vector<Match> found = Matcher(rows, {}).match(image);
  ASSERT_EQ(found.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(found[i].in_image, 40 + int(i));
    EXPECT_EQ(found[i].in_template, int(i));
  }
}

TEST(Matcher, ClaimsNothingForRepeatedStructure) {
  test::Random random("repeated");
  cv::Mat rows = descriptors(40, random);
  rows.row(5).copyTo(rows.row(6));
  const std::vector<Match> found = Matcher(rows, {}).match(rows);
  EXPECT_EQ(found.size(), 38U);  // 0/0 of the two equal rows is no match, 0/d of the others is
  for (const Match& m : found) {
    EXPECT_NE(m.in_template, 5);
    EXPECT_NE(m.in_template, 6);
    EXPECT_EQ(m.ratio, 0);
  }
}

TEST(Matcher, AppliesTheRatioToDistances) {
  cv::Mat rows = cv::Mat::zeros(2, 128, CV_32F);
  rows.at<float>(1, 0) = 100;
  cv::Mat image = cv::Mat::zeros(1, 128, CV_32F);
  image.at<float>(0, 0) = 44;  // 44 from one row, 56 from the other: ratio 0.786
  const std::vector<Match> found = Matcher(rows, {}).match(image);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].in_template, 0);
  EXPECT_NEAR(found[0].ratio, 44.0 / 56.0, 1e-6);
  image.at<float>(0, 0) = 45;  // 45 to 55: 0.818
  EXPECT_TRUE(Matcher(rows, {}).match(image).empty());
}

/// Many rows, few checks: what is found depends on the tree.
struct Search {
  cv::Mat rows;
  cv::Mat image;
  MatchOptions options;
};
Search search() {
  test::Random random("search");
  Search result;
  result.rows = descriptors(300, random);
  result.image = disturbed(result.rows, 45, random);
  result.options.ratio = 0.99;
  result.options.checks = 16;
  return result;
}

TEST(Matcher, IgnoresAndKeepsTheStateOfOtherGenerators) {
  const Search s = search();
  cv::theRNG() = cv::RNG(17);
  const std::vector<Match> first = Matcher(s.rows, s.options).match(s.image);
  EXPECT_EQ(cv::theRNG().state, cv::RNG(17).state);
  cv::theRNG() = cv::RNG(99);
  cv::theRNG().next();
  EXPECT_TRUE(same(first, Matcher(s.rows, s.options).match(s.image)));
  MatchOptions other = s.options;
  other.seed = 2;  // the test can fail: another tree finds other rows
  EXPECT_FALSE(same(first, Matcher(s.rows, other).match(s.image)));
}

TEST(Matcher, IsTheSameOnEveryThreadAtOnce) {
  const Search s = search();
  const Matcher shared(s.rows, s.options);
  const std::vector<Match> here = shared.match(s.image);
  std::vector<std::vector<Match>> there(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < there.size(); ++i) {
    threads.emplace_back([&, i] {
      for (std::size_t k = 0; k < i; ++k) cv::theRNG().next();
      there[i] = i % 2 == 0 ? shared.match(s.image) : Matcher(s.rows, s.options).match(s.image);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& matches : there) EXPECT_TRUE(same(here, matches));
}

TEST(Matcher, DoesNotDependOnEarlierSearches) {
  // FLANN keeps the queue of the longest tree a thread has searched; shorter ones drop branches.
  test::Random random("earlier");
  const cv::Mat longest = descriptors(1500, random);
  for (const int n : {12, 20, 50, 80, 120}) {
    const cv::Mat rows = descriptors(n, random);
    const cv::Mat image = disturbed(rows, 60, random);
    MatchOptions options;
    options.ratio = 0.999;
    options.checks = 32;
    const Matcher matcher(rows, options);
    std::vector<Match> fresh;
    std::vector<Match> later;
    std::thread([&] { fresh = matcher.match(image); }).join();
    std::thread([&] {
      Matcher(longest, options).match(longest.rowRange(0, 20));
      later = matcher.match(image);
    }).join();
    EXPECT_TRUE(same(fresh, later)) << n;
  }
}

TEST(Matcher, KeepsItsOwnRows) {
  test::Random random("own");
  cv::Mat rows = descriptors(30, random);
  const cv::Mat image = rows.clone();
  Matcher matcher(rows, {});
  rows.setTo(0);
  const Matcher moved_to = std::move(matcher);
  EXPECT_EQ(moved_to.match(image).size(), 30U);
}

TEST(Matcher, RefusesWhatIsNoDescriptor) {
  test::Random random("refuses");
  const cv::Mat rows = descriptors(10, random);
  EXPECT_THROW(Matcher(cv::Mat(), {}), std::invalid_argument);
  EXPECT_THROW(Matcher(rows.rowRange(0, 1), {}), std::invalid_argument);
  EXPECT_THROW(Matcher(rows.colRange(0, 64), {}), std::invalid_argument);
  EXPECT_THROW(Matcher(cv::Mat(10, 128, CV_8U), {}), std::invalid_argument);
  const Matcher matcher(rows, {});
  EXPECT_TRUE(matcher.match(cv::Mat()).empty());
  EXPECT_THROW(matcher.match(rows.colRange(0, 64).clone()), std::invalid_argument);
  cv::Mat nonsense = rows.clone();
  for (const float number :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F}) {
    nonsense.at<float>(3, 7) = number;
    EXPECT_THROW(matcher.match(nonsense), std::invalid_argument);
    EXPECT_THROW(Matcher(nonsense, {}), std::invalid_argument);
  }
}

TEST(MatchOptions, NamesWhatIsOutOfRange) {
  EXPECT_NO_THROW(MatchOptions().check());
  for (const double ratio : {0.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    MatchOptions options;
    options.ratio = ratio;
    EXPECT_THROW(options.check(), std::invalid_argument);
  }
  MatchOptions options;
  options.checks = 1;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

TEST(DistinctPairs, CountsAPlaceOnce) {
  Keypoints in_template;
  in_template.at = {{10, 10}, {10, 10}, {30, 10}, {40, 20}, {50, 20}, {80, 40}};
  Keypoints in_image;
  in_image.at = {{110, 60}, {110, 60}, {130, 60}, {130.6, 60}, {150, 70}, {180, 90}};
  const auto pairs =
      distinct_pairs({{0, 0, 0.7},    // two orientations of one place:
                      {1, 1, 0.6},    //   the more distinctive stays
                      {2, 2, 0.3},    // stays
                      {3, 3, 0.5},    // its image place is that of row 2, more distinctive
                      {4, 4, 0.4},    // stays
                      {5, 5, 0.79}},  // stays
                     in_template, in_image);
  ASSERT_EQ(pairs.size(), 4U);
  EXPECT_EQ(pairs[0].in_image.u, 110);
  EXPECT_EQ(pairs[1].in_template.u, 30);
  EXPECT_EQ(pairs[1].in_image.u, 130);
  EXPECT_EQ(pairs[2].in_template.u, 50);
  EXPECT_EQ(pairs[2].in_image.u, 150);
  EXPECT_EQ(pairs[3].in_image.u, 180);
}

TEST(DistinctPairs, PrefersTheSmallerRatioInAnyOrder) {
  Keypoints in_template;
  in_template.at = {{10, 10}, {10, 10}};
  Keypoints in_image;
  in_image.at = {{20, 20}, {40, 40}};
  for (const bool swapped : {false, true}) {
    std::vector<Match> matches{{0, 0, 0.7}, {1, 1, 0.6}};
    if (swapped) std::swap(matches[0], matches[1]);
    const auto pairs = distinct_pairs(matches, in_template, in_image);
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].in_image.u, 40);
  }
  EXPECT_TRUE(distinct_pairs({}, in_template, in_image).empty());
}

}  // namespace
}  // namespace kestrel
