#include "kestrel/eval/track_metrics.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const Corners kFirst{{{10, 20}, {110, 25}, {105, 90}, {12, 85}}};

Homography shift(double u, double v) {
  Homography H;
  H.H(0, 2) = u;
  H.H(1, 2) = v;
  return H;
}

/// A target that stays where it is, labelled in frames 0 .. count-1.
TrackTruth still(int count) {
  TrackTruth truth;
  for (int i = 0; i < count; ++i) truth[i] = kFirst;
  return truth;
}

/// One frame a letter: the digits are that many pixels off, 'X' 50 px off, '.' not found.
TrackEstimate track(const std::string& answers) {
  TrackEstimate estimate;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const char c = answers[i];
    estimate[std::int64_t(i)] = std::nullopt;
    if (c == 'X') estimate[std::int64_t(i)] = shift(30, -40);
    if (c >= '0' && c <= '9') estimate[std::int64_t(i)] = shift(c - '0', 0);
  }
  return estimate;
}

TrackMetrics metrics(const std::string& answers) {
  return track_metrics(still(int(answers.size())), track(answers));
}

TEST(TrackMetrics, ErrorIsTheMeanDistanceOfTheMappedFirstRow) {
  test::Random random("mean distance");
  TrackTruth truth{{7, kFirst}, {9, kFirst}};
  double sum = 0;
  for (Pixel& p : truth[9]) {
    const double u = random.uniform(-5, 5);
    const double v = random.uniform(-5, 5);
    p = {p.u + 3 + u, p.v - 2 + v};
    sum += std::sqrt(u * u + v * v);
  }
  const auto scores = frame_scores(truth, {{7, Homography{}}, {9, shift(3, -2)}});
  ASSERT_EQ(scores.size(), 2u);
  EXPECT_EQ(scores[0].frame, 7);
  EXPECT_EQ(scores[0].error_px, 0);
  EXPECT_EQ(scores[1].frame, 9);
  EXPECT_NEAR(scores[1].error_px.value(), sum / 4, 1e-12);
}

// The row is compared with the first row's corners under the homography, not under its inverse,
// and the scale of the homography means nothing.
TEST(TrackMetrics, APerfectTrackHasNoError) {
  test::Random random("perfect");
  TrackTruth truth{{0, kFirst}};
  TrackEstimate estimate{{0, Homography{}}};
  for (int i = 1; i < 30; ++i) {
    Homography H;
    for (int k = 0; k < 6; ++k) H.H(k % 2, k / 2) += random.uniform(-0.2, 0.2);
    H.H.row(2) << random.uniform(-1e-3, 1e-3), random.uniform(-1e-3, 1e-3), 1;
    for (std::size_t c = 0; c < 4; ++c) truth[i][c] = H * kFirst[c];
    estimate[i] = Homography{random.uniform(-3, 3) * H.H};
  }
  const TrackMetrics m = track_metrics(truth, estimate);
  EXPECT_EQ(m.labelled, 30);
  EXPECT_EQ(m.found, 30);
  EXPECT_EQ(m.within_1px, 1);
  EXPECT_EQ(m.wrong, 0);
  EXPECT_LT(m.max_px.value(), 1e-10);
  EXPECT_EQ(m.longest_gap, 0);
  EXPECT_EQ(m.recoveries, 0);
}

TEST(TrackMetrics, SharesAreOfAllLabelledFrames) {
  const TrackMetrics m = metrics("0123459X..");
  EXPECT_EQ(m.labelled, 10);
  EXPECT_EQ(m.found, 8);
  EXPECT_DOUBLE_EQ(m.within_1px, 0.2);  // a limit counts as within
  EXPECT_DOUBLE_EQ(m.within_2px, 0.3);
  EXPECT_DOUBLE_EQ(m.within_3px, 0.4);
  EXPECT_DOUBLE_EQ(m.within_5px, 0.6);
  EXPECT_DOUBLE_EQ(m.within_10px, 0.7);
  EXPECT_EQ(m.wrong, 1);
}

TEST(TrackMetrics, AFoundFrameIsWithinTenPixelsOrWrong) {
  test::Random random("partition");
  for (int i = 0; i < 100; ++i) {
    std::string answers;
    for (int k = 0; k < 40; ++k) answers += "0123456789X."[random.integer(0, 11)];
    const TrackMetrics m = metrics(answers);
    EXPECT_EQ(std::lround(m.within_10px * m.labelled) + m.wrong, m.found) << answers;
    EXPECT_LE(m.within_1px, m.within_2px);
    EXPECT_LE(m.within_2px, m.within_3px);
    EXPECT_LE(m.within_3px, m.within_5px);
    EXPECT_LE(m.within_5px, m.within_10px);
    EXPECT_LE(m.median_px.value(), m.p95_px.value());
    EXPECT_LE(m.p95_px.value(), m.max_px.value());
  }
  TrackTruth truth = still(2);
  EXPECT_EQ(track_metrics(truth, {{1, shift(10, 0)}}).wrong, 0);
  EXPECT_EQ(track_metrics(truth, {{1, shift(10.01, 0)}}).wrong, 1);
}

TEST(TrackMetrics, QuantilesAreOfTheFoundFrames) {
  EXPECT_EQ(metrics("3.1..2").median_px, 2);
  EXPECT_EQ(metrics("3142").median_px, 2.5);
  EXPECT_EQ(metrics("3X1").max_px, 50);
  EXPECT_EQ(metrics("5").p95_px, 5);
  EXPECT_EQ(metrics("1111111111111111111X").p95_px, 1);  // 19 of 20 are 95 %
  EXPECT_EQ(metrics("111111111111111111X").p95_px, 50);  // 18 of 19 are not
}

TEST(TrackMetrics, NothingFoundHasNoQuantiles) {
  for (const TrackMetrics& m : {metrics("..."), track_metrics({}, track("12"))}) {
    EXPECT_EQ(m.found, 0);
    EXPECT_EQ(m.within_10px, 0);
    EXPECT_FALSE(m.median_px || m.p95_px || m.max_px);
  }
  EXPECT_EQ(metrics("...").longest_gap, 3);
  EXPECT_TRUE(frame_scores({}, track("12")).empty());
}

TEST(TrackMetrics, GapsAreFramesNotFoundInARow) {
  EXPECT_EQ(metrics("0..0...0.").longest_gap, 3);
  EXPECT_EQ(metrics("0..X..0").longest_gap, 2);  // a wrong frame is no loss reported
  EXPECT_EQ(metrics("0123").longest_gap, 0);
}

TEST(TrackMetrics, ARecoveryIsARightFrameAfterALoss) {
  EXPECT_EQ(metrics("0..0...0.").recoveries, 2);
  EXPECT_EQ(metrics("0.X").recoveries, 0);
  EXPECT_EQ(metrics("0.XX0").recoveries, 1);
  EXPECT_EQ(metrics("0X0").recoveries, 0);  // it never said it was lost
  EXPECT_EQ(metrics("..0").recoveries, 1);
}

TEST(TrackMetrics, TheAreaIsTheIntegralOfThePrecisionCurve) {
  test::Random random("area");
  std::string answers;
  for (int k = 0; k < 60; ++k) answers += "0123456789X."[random.integer(0, 11)];
  const auto scores = frame_scores(still(60), track(answers));
  // Errors are whole pixels, so the curve is a staircase: exact by the value on each step.
  double sum = 0;
  for (const double share : precision(scores, {0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5}))
    sum += share;
  EXPECT_NEAR(metrics(answers).area_10px, sum / 10, 1e-12);
  EXPECT_EQ(metrics("000").area_10px, 1);
  EXPECT_EQ(metrics("X..").area_10px, 0);
  EXPECT_DOUBLE_EQ(metrics("5").area_10px, 0.5);
}

TEST(TrackMetrics, PrecisionAgreesWithTheSharesAndGrows) {
  const std::string answers = "0123459X..";
  const auto curve = precision(frame_scores(still(10), track(answers)), {1, 2, 3, 5, 10, 50});
  const TrackMetrics m = metrics(answers);
  EXPECT_EQ(curve, (std::vector<double>{m.within_1px, m.within_2px, m.within_3px, m.within_5px,
                                        m.within_10px, m.coverage()}));
  EXPECT_EQ(precision({}, {1}), std::vector<double>{0});
}

TEST(TrackMetrics, FarWrongIsBeyondTwentyPixels) {
  TrackTruth truth = still(2);
  EXPECT_EQ(track_metrics(truth, {{1, shift(20, 0)}}).far_wrong, 0);
  EXPECT_EQ(track_metrics(truth, {{1, shift(20, 0)}}).wrong, 1);
  EXPECT_EQ(track_metrics(truth, {{1, shift(20.01, 0)}}).far_wrong, 1);
}

TEST(TrackMetrics, ARecoveryTakesTheFramesThatWereNotRight) {
  EXPECT_EQ(metrics("0..0.X.0X").recovery_frames, (std::vector<int>{2, 3}));
  EXPECT_TRUE(metrics("0..0.X.0X").ends_lost);
  EXPECT_FALSE(metrics("0..0").ends_lost);
  EXPECT_TRUE(metrics("000").recovery_frames.empty());
  EXPECT_TRUE(metrics("0...").recovery_frames.empty());  // never right again
  EXPECT_TRUE(metrics("0...").ends_lost);
}

TEST(TrackMetrics, FramesWithoutARowAreNeitherRightNorWrong) {
  TrackTruth truth = still(8);
  truth.erase(3);
  truth.erase(4);
  truth.erase(5);
  const TrackMetrics m = track_metrics(truth, track("00.X.0.0"));
  EXPECT_EQ(m.labelled, 5);
  EXPECT_EQ(m.found, 3);
  EXPECT_EQ(m.wrong, 0);
  EXPECT_EQ(m.found_unlabelled, 2);
  EXPECT_EQ(m.longest_gap, 2);  // frames 2 and 6: the hidden stretch between does not end it
  EXPECT_EQ(m.recoveries, 1);
}

TEST(TrackMetrics, AFrameNeverEstimatedIsNotFound) {
  const TrackMetrics m = track_metrics(still(4), {{0, Homography{}}, {3, Homography{}}});
  EXPECT_EQ(m.found, 2);
  EXPECT_EQ(m.longest_gap, 2);
  EXPECT_DOUBLE_EQ(m.within_1px, 0.5);
}

TEST(TrackMetrics, AHomographyThatIsNoneIsWrong) {
  Homography nan;
  nan.H(1, 1) = kNan;
  Homography to_infinity;
  to_infinity.H.row(2) << -1.0 / 110, 0, 1;  // takes the second corner to infinity
  for (const Homography& bad : {nan, to_infinity, Homography{Eigen::Matrix3d::Zero()}}) {
    const TrackMetrics m = track_metrics(still(2), {{0, Homography{}}, {1, bad}});
    EXPECT_EQ(m.found, 2);
    EXPECT_EQ(m.wrong, 1);
    EXPECT_DOUBLE_EQ(m.within_10px, 0.5);
    EXPECT_EQ(m.max_px, std::numeric_limits<double>::infinity());
  }
}

TEST(TrackMetrics, ALabelThatIsNoneIsWrongToo) {
  TrackTruth truth = still(2);
  truth[1][2].u = kNan;
  EXPECT_EQ(track_metrics(truth, track("00")).wrong, 1);
}

}  // namespace
}  // namespace kestrel
