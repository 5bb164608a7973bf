#include "kestrel/ground/ground_command.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

GroundCommand good(const std::string& json) {
  const auto parsed = parse_command(json);
  const auto* why = std::get_if<std::string>(&parsed);
  EXPECT_EQ(why, nullptr) << json << ": " << (why != nullptr ? *why : "");
  return why != nullptr ? GroundCommand{} : std::get<GroundCommand>(parsed);
}

std::string refusal(const std::string& json) {
  const auto parsed = parse_command(json);
  const auto* why = std::get_if<std::string>(&parsed);
  return why != nullptr ? *why : "taken";
}

TEST(GroundCommand, EveryWordIsKnownByItsName) {
  for (const Ask ask : kAsks) {
    std::string more;
    if (ask == Ask::Gain) more = ",\"gain_per_s\":0.4";
    if (ask == Ask::Freeze) more = ",\"frame\":12";
    if (ask == Ask::Examine) more = ",\"box\":[1,2,30,40]";
    if (ask == Ask::Use) more = ",\"width_m\":1.5";
    if (ask == Ask::Sticks || ask == Ask::Limits) more = ",\"velocity\":[1,2,3,0.5]";
    if (ask == Ask::Law) more = ",\"law\":\"mean\"";
    if (ask == Ask::Goal) more = ",\"position_m\":[-5,0,1],\"yaw_rad\":0.1";
    const GroundCommand c = good(std::string("{\"do\":\"") + name(ask) +
                                 "\",\"client\":\"a-1\",\"number\":7" + more + "}");
    EXPECT_EQ(c.ask, ask);
    EXPECT_EQ(c.client, "a-1");
    EXPECT_EQ(c.number, 7u);
    EXPECT_EQ(c.gain_per_s.has_value(), ask == Ask::Gain);
    EXPECT_EQ(c.frame.has_value(), ask == Ask::Freeze);
    EXPECT_EQ(c.box.has_value(), ask == Ask::Examine);
    EXPECT_EQ(c.width_m.has_value(), ask == Ask::Use);
    EXPECT_EQ(c.velocity.has_value(), ask == Ask::Sticks || ask == Ask::Limits);
    EXPECT_EQ(c.law.has_value(), ask == Ask::Law);
    EXPECT_EQ(c.goal.has_value(), ask == Ask::Goal);
  }
}

TEST(GroundCommand, NumbersComeThrough) {
  EXPECT_EQ(good(R"({"do":"gain","gain_per_s":0.25})").gain_per_s, 0.25);
  EXPECT_EQ(good(R"({"do":"freeze","frame":90071992547})").frame, 90071992547);
  const PixelBox box = *good(R"({"do":"examine","box":[1,2,30,40]})").box;
  EXPECT_EQ(box.u, 1);
  EXPECT_EQ(box.v, 2);
  EXPECT_EQ(box.width, 30);
  EXPECT_EQ(box.height, 40);
}

TEST(GroundCommand, VelocitiesLawAndGoalComeThrough) {
  const auto sticks = *good(R"({"do":"sticks","velocity":[-0.5,0.25,0,-0.1]})").velocity;
  EXPECT_EQ(sticks.vector(), Eigen::Vector4d(-0.5, 0.25, 0, -0.1));
  EXPECT_EQ(good(R"({"do":"law","law":"2.5d"})").law, "2.5d");
  const auto goal = *good(R"({"do":"goal","position_m":[-5,0.5,-1],"yaw_rad":0.2})").goal;
  EXPECT_EQ(goal.position_m, Eigen::Vector3d(-5, 0.5, -1));
  EXPECT_EQ(goal.yaw_rad, 0.2);
}

TEST(GroundCommand, SticksAndGoalsOutOfRangeAreRefused) {
  for (const char* bad : {"[1,2,3]", "[1,2,3,4,5]", "[1,2,3,NaN]", "[1,2,3,null]", "[1,2,3,1e999]",
                          "[1e7,0,0,0]", "[\"1\",0,0,0]", "{}", "1"}) {
    EXPECT_NE(refusal(std::string(R"({"do":"sticks","velocity":)") + bad + "}"), "taken") << bad;
  }
  for (const char* bad : {"[0,1,1,1]", "[1,1,1,-1]"}) {
    EXPECT_NE(refusal(std::string(R"({"do":"limits","velocity":)") + bad + "}"), "taken") << bad;
  }
  EXPECT_NE(refusal(R"({"do":"goal","position_m":[1,2],"yaw_rad":0})"), "taken");
  EXPECT_NE(refusal(R"({"do":"goal","position_m":[1,2,3]})"), "taken");
  EXPECT_NE(refusal(R"({"do":"goal","position_m":[1,2,3],"yaw_rad":1e9})"), "taken");
  EXPECT_NE(refusal(R"({"do":"law","law":7})"), "taken");
  EXPECT_NE(refusal(R"({"do":"law","law":")" + std::string(65, 'a') + "\"}"), "taken");
}

TEST(GroundCommand, AStopNeedsNothingButItsWord) {
  EXPECT_TRUE(is_stop(good(R"({"do":"abort"})").ask));
  EXPECT_TRUE(is_stop(good(R"({"do":"hover"})").ask));
  EXPECT_FALSE(is_stop(Ask::Start));
}

TEST(GroundCommand, WhatIsNotSoundIsRefusedInWords) {
  EXPECT_EQ(refusal(""), "the command is no JSON");
  EXPECT_EQ(refusal("{\"do\":\"abort\""), "the command is no JSON");
  EXPECT_EQ(refusal("{\"do\":\"abort\"} x"), "the command is no JSON");
  EXPECT_EQ(refusal("\xff\xfe{}"), "the command is no JSON");
  EXPECT_EQ(refusal("[\"abort\"]"), "the command: is no JSON object");
  EXPECT_EQ(refusal("{}"), "the command: \"do\": a word is missing");
  EXPECT_EQ(refusal(R"({"do":1})"), "the command: \"do\": a word is missing");
  EXPECT_EQ(refusal(R"({"do":"fly"})"), "the command: \"do\": there is no such command");
  EXPECT_EQ(refusal(R"({"do":"abort","x":1})"),
            "the command: a key that this command does not have");
  EXPECT_EQ(refusal(R"({"do":"gain"})"), "the command: \"gain_per_s\": is missing");
}

TEST(GroundCommand, NumbersOutOfRangeAreRefused) {
  for (const char* bad : {"0", "-1", "1e999", "1e7", "null", "\"1\"", "true", "NaN", "[1]"}) {
    EXPECT_NE(refusal(std::string(R"({"do":"gain","gain_per_s":)") + bad + "}"), "taken") << bad;
  }
  for (const char* bad : {"-1", "1.5", "9007199254740993", "1e3", "null"}) {
    EXPECT_NE(refusal(std::string(R"({"do":"freeze","frame":)") + bad + "}"), "taken") << bad;
    EXPECT_NE(refusal(std::string(R"({"do":"start","client":"a","number":)") + bad + "}"), "taken");
  }
  for (const char* bad : {"[1,2,3]", "[1,2,3,4,5]", "[1,2,3,4.5]", "[1,2,3,null]", "{}", "[[]]"}) {
    EXPECT_NE(refusal(std::string(R"({"do":"examine","box":)") + bad + "}"), "taken") << bad;
  }
}

TEST(GroundCommand, HugeAndDeepOnesAreRefused) {
  EXPECT_EQ(refusal("{\"do\":\"abort\"" + std::string(kMaxCommandBytes, ' ') + "}"),
            "the command is too long");
  EXPECT_NE(refusal(std::string(1000, '[')), "taken");
  EXPECT_NE(refusal(std::string(500, '[') + std::string(500, ']')), "taken");
  EXPECT_NE(refusal(R"({"do":"start","client":")" + std::string(65, 'a') + "\"}"), "taken");
}

TEST(GroundCommand, AnyBytesAreAnswered) {
  test::Random random("ground commands");
  const std::string start = R"({"do":"examine","client":"a","number":1,"box":[1,2,30,40]})";
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = start;
    for (int k = 0; k < 3; ++k) {
      bytes[std::size_t(random.integer(0, int(bytes.size()) - 1))] = char(random.integer(0, 255));
    }
    const auto parsed = parse_command(bytes);  // whatever it is, it is an answer
    if (const auto* command = std::get_if<GroundCommand>(&parsed)) {
      if (command->box) {
        EXPECT_LE(std::abs(command->box->u), 1e6);
      }
    }
  }
}

}  // namespace
}  // namespace kestrel
