#include "kestrel/calibration/hand_eye_stations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

const std::string kPose = "pose_tx_m,pose_ty_m,pose_tz_m,pose_tux_rad,pose_tuy_rad,pose_tuz_rad";
const std::string kHead = "stamp_s,roll_rad,pitch_rad,yaw_rad," + kPose;

class Stations : public ::testing::Test {
 protected:
  std::vector<HandEyeStation> load(const std::string& text) const {
    return load_stations(folder_.write("s.csv", text));
  }
  std::string error_of(const std::string& text) const {
    return test::message_of([&] { load(text); });
  }
  test::TempFolder folder_;
};

TEST_F(Stations, AreReadWithAndWithoutPlace) {
  const auto plain = load(kHead + "\n1,0.1,0.2,0.3,4,5,6,0.7,0.8,0.9\r\n");
  ASSERT_EQ(plain.size(), 1u);
  EXPECT_EQ(plain[0].stamp_s, 1);
  EXPECT_EQ(plain[0].attitude.roll, 0.1);
  EXPECT_EQ(plain[0].attitude.pitch, 0.2);
  EXPECT_EQ(plain[0].attitude.yaw, 0.3);
  EXPECT_EQ(plain[0].camera_from_target.translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_TRUE(
      plain[0].camera_from_target.rotation.isApprox(rotation_from_vector({0.7, 0.8, 0.9}), 1e-15));
  EXPECT_FALSE(plain[0].position_ned_m.has_value());
  const auto placed = load("north_m,east_m,down_m," + kHead +
                           "\n7,8,9,1,0,0,0,4,5,6,0,0,0\n,,,1,0,0,0,4,5,6,0,0,0\n");
  EXPECT_EQ(placed[0].position_ned_m, Eigen::Vector3d(7, 8, 9));
  EXPECT_FALSE(placed[1].position_ned_m.has_value());
}

TEST_F(Stations, AnglesMayBeDegrees) {
  const auto s = load("stamp_s,roll_deg,pitch_rad,yaw_deg," + kPose + "\n0,90,1,-90,0,0,1,0,0,0\n");
  EXPECT_DOUBLE_EQ(s[0].attitude.roll, M_PI / 2);
  EXPECT_DOUBLE_EQ(s[0].attitude.pitch, 1);
  EXPECT_DOUBLE_EQ(s[0].attitude.yaw, -M_PI / 2);
}

TEST_F(Stations, RowsWithoutAttitudeOrPoseOrWithARivalDoNotCount) {
  const auto s = load(kHead + ",has_rival,extra\n" +
                      "0,,,,0,0,1,0,0,0,0,x\n"    // no attitude
                      "1,0,0,0,,,,,,,,\n"         // no pose
                      "2,0,0,0,0,0,1,0,0,0,1,\n"  // two poses
                      "3,0,0,0,0,0,1,0,0,0,0,\n");
  ASSERT_EQ(s.size(), 1u);
  EXPECT_EQ(s[0].stamp_s, 3);
}

TEST_F(Stations, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(error_of("stamp_s,roll_rad\n0,1\n"), HasSubstr("s.csv:1: pitch_rad: is missing"));
  EXPECT_THAT(error_of("roll_deg," + kHead + "\n"),
              HasSubstr("s.csv:1: roll_deg: is given together with _rad"));
  EXPECT_THAT(error_of("stamp_s," + kHead + "\n"), HasSubstr("stamp_s: is given twice"));
  EXPECT_THAT(error_of(kHead + "\n0,x,0,0,0,0,1,0,0,0\n"), HasSubstr("s.csv:2: 'x' is no number"));
  EXPECT_THAT(error_of(kHead + "\n0,nan,0,0,0,0,1,0,0,0\n"), HasSubstr("'nan' is no number"));
  EXPECT_THAT(error_of(kHead + "\n0,0,0\n"), HasSubstr("s.csv:2: has 3 fields; the header has 10"));
  EXPECT_THAT(error_of(kHead + "\n"), HasSubstr("no row with attitude and pose"));
  EXPECT_THAT(error_of("north_m," + kHead + "\n"), HasSubstr("east_m: is missing"));
}

TEST(ChosenStations, AreApartAndNotTooMany) {
  std::vector<HandEyeStation> all;
  for (int i = 0; i <= 1000; ++i) {
    HandEyeStation s;
    s.stamp_s = i;
    s.attitude.yaw = 0.001 * i;
    all.push_back(s);
  }
  StationOptions options;
  options.smallest_turn_rad = 0.0995;
  EXPECT_EQ(chosen_stations(all, options).size(), 11u);
  options.most = 5;
  const auto five = chosen_stations(all, options);
  ASSERT_EQ(five.size(), 5u);
  EXPECT_EQ(five.front().stamp_s, 0);
  EXPECT_EQ(five.back().stamp_s, 1000);
  options.most = 2;
  EXPECT_THAT(test::message_of([&] { chosen_stations(all, options); }), HasSubstr("most"));
}

}  // namespace
}  // namespace kestrel
