#include "kestrel/io/run_log.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/log_rows.hpp"
#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string reading_error(const std::filesystem::path& path) {
  try {
    (void)read_log(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// Equal to the last bit, so that -0 and 0 differ and NaN equals NaN.
void expect_same(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return;
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << a << " " << b;
}

template <class Vector>
void expect_same_all(const Vector& a, const Vector& b) {
  for (long i = 0; i < long(a.size()); ++i) expect_same(a[i], b[i]);
}

void expect_same_seen(const LogRow& a, const LogRow& b) {
  EXPECT_EQ(a.frame, b.frame);
  expect_same(a.stamp_s, b.stamp_s);
  EXPECT_EQ(a.miss, b.miss);
  expect_same(a.window.u, b.window.u);
  expect_same(a.window.v, b.window.v);
  expect_same(a.window.width, b.window.width);
  expect_same(a.window.height, b.window.height);
  EXPECT_EQ(std::tie(a.keypoints, a.matches, a.inliers, a.trials),
            std::tie(b.keypoints, b.matches, b.inliers, b.trials));
  ASSERT_EQ(a.image_from_template.has_value(), b.image_from_template.has_value());
  if (a.image_from_template)
    expect_same_all(a.image_from_template->H.reshaped(), b.image_from_template->H.reshaped());
  ASSERT_EQ(a.corners.has_value(), b.corners.has_value());
  for (std::size_t i = 0; a.corners && i < 4; ++i) {
    expect_same((*a.corners)[i].u, (*b.corners)[i].u);
    expect_same((*a.corners)[i].v, (*b.corners)[i].v);
  }
  ASSERT_EQ(a.attitude.has_value(), b.attitude.has_value());
  if (!a.attitude) return;
  expect_same(a.attitude->roll, b.attitude->roll);
  expect_same(a.attitude->pitch, b.attitude->pitch);
  expect_same(a.attitude->yaw, b.attitude->yaw);
}

void expect_same_decided(const LogRow& a, const LogRow& b) {
  ASSERT_EQ(a.pose.has_value(), b.pose.has_value());
  if (a.pose) {
    expect_same_all(a.pose->translation_m, b.pose->translation_m);
    expect_same_all(a.pose->rotation_rad, b.pose->rotation_rad);
    expect_same(a.pose->reprojection_px, b.pose->reprojection_px);
    EXPECT_EQ(a.pose->has_rival, b.pose->has_rival);
  }
  ASSERT_EQ(a.servo.has_value(), b.servo.has_value());
  if (a.servo) {
    expect_same_all(a.servo->error, b.servo->error);
    expect_same(a.servo->error_norm, b.servo->error_norm);
    expect_same(a.servo->condition, b.servo->condition);
    expect_same_all(a.servo->twist.vector(), b.servo->twist.vector());
  }
  ASSERT_EQ(a.decision.has_value(), b.decision.has_value());
  if (a.decision) {
    EXPECT_EQ(a.decision->state, b.decision->state);
    expect_same_all(a.decision->wanted.vector(), b.decision->wanted.vector());
    expect_same_all(a.decision->sent.vector(), b.decision->sent.vector());
  }
  ASSERT_EQ(a.extra.size(), b.extra.size());
  expect_same_all(a.extra, b.extra);
}

TEST(RunLog, ComesBackToTheLastBit) {
  const test::TempFolder folder;
  test::Random random("run_log");
  std::vector<LogRow> rows;
  for (int i = 0; i < 300; ++i) rows.push_back(test::any_row(random, 2));
  {
    RunLog log(folder / "log.csv", {"north_m", "wind_m_s"});
    for (const LogRow& row : rows) log.write(row);
  }
  const LogFile back = read_log(folder / "log.csv");
  EXPECT_FALSE(back.was_interrupted);
  EXPECT_EQ(back.extra_columns, (std::vector<std::string>{"north_m", "wind_m_s"}));
  ASSERT_EQ(back.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    expect_same_seen(rows[i], back.rows[i]);
    expect_same_decided(rows[i], back.rows[i]);
    expect_same(back.extra("wind_m_s")[i], rows[i].extra[1]);
  }
  EXPECT_TRUE(back.extra("no_such_column").empty());
}

TEST(RunLog, HasOneFieldForEachColumn) {
  const test::TempFolder folder;
  test::Random random("run_log.fields");
  RunLog log(folder / "log.csv", {"north_m"});
  LogRow empty;
  empty.extra = {std::nan("")};
  log.write(empty);
  for (int i = 0; i < 50; ++i) log.write(test::any_row(random, 1));
  std::istringstream lines(content(folder / "log.csv"));
  for (std::string line; std::getline(lines, line);)
    EXPECT_EQ(csv_fields(line).size(), log_columns().size() + 1);
}

TEST(RunLog, NamesEveryColumnOnce) {
  const auto columns = log_columns();
  EXPECT_EQ(std::set<std::string>(columns.begin(), columns.end()).size(), columns.size());
  for (const char* column : {"frame", "stamp_s", "h22", "corner3_v_px", "pose_tz_m", "e7",
                             "wc_z_rad_s", "wanted_forward_m_s", "sent_yaw_rate_rad_s", "state"})
    EXPECT_THAT(columns, ::testing::Contains(column));
}

TEST(RunLog, RefusesExtraColumnsThatDoNotFit) {
  const test::TempFolder folder;
  for (const char* column : {"frame", "", "a,b", "Speed", "wind speed"})
    EXPECT_THROW(RunLog(folder / "log.csv", {column}), std::invalid_argument) << column;
  EXPECT_THROW(RunLog(folder / "log.csv", {"one", "one"}), std::invalid_argument);
  RunLog log(folder / "log.csv", {"one"});
  EXPECT_THROW(log.write(LogRow{}), std::invalid_argument);
}

TEST(RunLog, KeepsAllRowsWhenTheProgramIsKilled) {
  const test::TempFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    test::Random random("run_log.killed");
    RunLog log(folder / "log.csv");
    for (int i = 0; i < 10; ++i) log.write(test::any_row(random, 0));
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(read_log(folder / "log.csv").rows.size(), 10u);
}

TEST(RunLog, SaysThatTheDiskIsFull) {
  try {
    RunLog log("/dev/full");
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("No space left"), HasSubstr("another folder")));
  }
}

TEST(ReadLog, DropsALineWithoutEnd) {
  const test::TempFolder folder;
  test::Random random("run_log.interrupted");
  {
    RunLog log(folder / "log.csv", {"north_m"});
    for (int i = 0; i < 3; ++i) log.write(test::any_row(random, 1));
  }
  const std::string whole = content(folder / "log.csv");
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = last + 1; size < whole.size(); size += 41) {
    write_text(folder / "cut.csv", whole.substr(0, size));
    const LogFile back = read_log(folder / "cut.csv");
    EXPECT_EQ(back.rows.size(), 2u);
    EXPECT_TRUE(back.was_interrupted);
  }
}

TEST(ReadLog, TellsFileLineAndColumn) {
  const test::TempFolder folder;
  RunLog(folder / "log.csv").write(LogRow{});
  const std::string whole = content(folder / "log.csv");
  const auto damaged = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    write_text(folder / "bad.csv", text);
    return reading_error(folder / "bad.csv");
  };
  EXPECT_THAT(damaged("\n0,0,", "\n0,x,"), HasSubstr("bad.csv:2: stamp_s: cannot read 'x'"));
  EXPECT_THAT(damaged("\n0,0,", "\n0.5,0,"), HasSubstr("bad.csv:2: frame: cannot read '0.5'"));
  EXPECT_THAT(damaged("\n0,0,", "\n0,0,0,"), HasSubstr("bad.csv:2: "));
  EXPECT_THAT(damaged("found,", "seen,"), HasSubstr("miss: cannot read 'seen'"));
  EXPECT_THAT(damaged("stamp_s,", "time,"), HasSubstr("bad.csv:1: stamp_s: no such column"));
  EXPECT_THAT(damaged(whole, ""), HasSubstr("no header"));
  EXPECT_THAT(reading_error(folder / "none.csv"), HasSubstr("check the path"));
  // A group of columns has values together or not at all.
  std::string half = whole;
  half.insert(half.size() - 2, "1");
  write_text(folder / "half.csv", half);
  EXPECT_THAT(reading_error(folder / "half.csv"), HasSubstr("state: cannot read ''"));
}

// Blots of random grey: texture enough for a template.
cv::Mat blots(int width, int height) {
  test::Random random("run_log.blots");
  cv::Mat picture(height, width, CV_8UC1);
  for (int v = 0; v < height; v += 8)
    for (int u = 0; u < width; u += 8)
      picture(cv::Rect(u, v, std::min(8, width - u), std::min(8, height - v)))
          .setTo(random.integer(0, 255));
  return picture;
}

TEST(LogRow, HoldsTheStep) {
  const cv::Mat picture = blots(200, 160);
  const Template model(picture, {0, 0, 160, 120}, {});
  Frame frame{7, 0.25, picture, Attitude{0.1, 0.2, 0.3}};
  Step step;
  step.track.image_from_template.emplace().H << 1, 0, 5, 0, 2, 7, 0, 0, 1;
  step.track.inliers.resize(9);
  step.track.matches = 11;
  PlanePose pose;
  pose.camera_from_target.translation = {0.1, 0.2, 1.5};
  pose.camera_from_target.rotation = rotation_from_vector({0.1, -0.2, 0.3});
  pose.rival = pose.camera_from_target;
  step.pose = pose;
  step.decision.servo =
      Servo{CameraTwist{{1, 2, 3}, {4, 5, 6}}, Eigen::VectorXd::Constant(8, 0.5), 12};
  step.decision.state = CommandState::Servo;
  step.decision.wanted = {1, 2, 3, 4};
  step.decision.command = {0.1, 0.2, 0.3, 0.4};
  const LogRow row = log_row(frame, model, step);
  EXPECT_EQ(row.frame, 7);
  EXPECT_EQ(row.stamp_s, 0.25);
  EXPECT_EQ(row.inliers, 9);
  EXPECT_EQ(row.matches, 11);
  EXPECT_NEAR((*row.corners)[2].u, 159 + 5, 1e-12);  // centres of corner pixels
  EXPECT_NEAR((*row.corners)[2].v, 119 * 2 + 7, 1e-12);
  EXPECT_EQ(row.attitude->pitch, 0.2);
  EXPECT_EQ(row.pose->translation_m.z(), 1.5);
  EXPECT_NEAR(row.pose->rotation_rad.y(), -0.2, 1e-12);
  EXPECT_TRUE(row.pose->has_rival);
  EXPECT_NEAR(row.servo->error_norm, std::sqrt(8 * 0.25), 1e-12);
  EXPECT_EQ(row.servo->twist.angular.z(), 6);
  EXPECT_EQ(row.decision->wanted.down_m_s, 3);
  EXPECT_EQ(row.decision->sent.yaw_rate_rad_s, 0.4);
}

TEST(LogRow, OfALostFrameHasNoValues) {
  const cv::Mat picture = blots(200, 160);
  const Template model(picture, {0, 0, 160, 120}, {});
  Step step;
  step.track.miss = Miss::FewMatches;
  const LogRow row = log_row(Frame{}, model, step);
  EXPECT_FALSE(row.image_from_template || row.corners || row.pose || row.servo || row.attitude);
  EXPECT_EQ(row.miss, Miss::FewMatches);
  EXPECT_EQ(row.decision->state, CommandState::Hover);
  EXPECT_FALSE(log_row(Frame{}, model, step.track).decision);
}

}  // namespace
}  // namespace kestrel
