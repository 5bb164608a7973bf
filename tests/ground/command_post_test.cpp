#include "kestrel/ground/command_post.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

GroundCommand numbered(const std::string& client, std::uint64_t number) {
  GroundCommand command;
  command.ask = Ask::Alive;
  command.client = client;
  command.number = number;
  return command;
}

TEST(CommandPost, ACommandCountsOnce) {
  CommandPost post("run");
  const std::string a = post.join(0);
  EXPECT_FALSE(post.admit(numbered(a, 1), 0));
  EXPECT_FALSE(post.admit(numbered(a, 5), 0)) << "numbers may be left out";
  EXPECT_EQ(post.admit(numbered(a, 5), 0)->kind, Answer::Kind::Stale);
  EXPECT_EQ(post.admit(numbered(a, 2), 0)->kind, Answer::Kind::Stale);
  EXPECT_FALSE(post.admit(numbered(a, 6), 0));
}

TEST(CommandPost, NumbersStartAboveZero) {
  CommandPost post("run");
  const std::string a = post.join(0);
  EXPECT_EQ(post.admit(numbered(a, 0), 0)->kind, Answer::Kind::Stale);
}

TEST(CommandPost, StrangersAndClientsOfAnotherRunAreRefused) {
  CommandPost before("monday");
  CommandPost post("tuesday");
  const std::string theirs = before.join(0);
  EXPECT_NE(theirs, post.join(0));
  EXPECT_EQ(post.admit(numbered(theirs, 9), 0)->kind, Answer::Kind::Stranger);
  EXPECT_EQ(post.admit(numbered("", 9), 0)->kind, Answer::Kind::Stranger);
}

TEST(CommandPost, OneCommandsAtATime) {
  CommandPost post("run");
  const std::string a = post.join(0);
  const std::string b = post.join(0);
  EXPECT_FALSE(post.commands(a));
  EXPECT_FALSE(post.commands(""));
  EXPECT_EQ(post.take(a, 0).kind, Answer::Kind::Done);
  EXPECT_EQ(post.take(a, 0).kind, Answer::Kind::Done);
  EXPECT_EQ(post.take(b, 1).kind, Answer::Kind::Refused);
  EXPECT_TRUE(post.commands(a));
  EXPECT_FALSE(post.commands(b));
  EXPECT_EQ(post.asker(), b);
}

TEST(CommandPost, WhoGivesUpGivesToWhoAsked) {
  CommandPost post("run");
  const std::string a = post.join(0);
  const std::string b = post.join(0);
  post.take(a, 0);
  EXPECT_EQ(post.release(b).kind, Answer::Kind::Refused);
  post.take(b, 1);
  EXPECT_EQ(post.release(a).kind, Answer::Kind::Done);
  EXPECT_TRUE(post.commands(b));
  EXPECT_EQ(post.asker(), "");
  post.release(b);
  EXPECT_EQ(post.commander(), "");
}

TEST(CommandPost, WhoIsNotAnsweredTakesIt) {
  CommandPost post("run");
  const std::string a = post.join(0);
  const std::string b = post.join(0);
  post.take(a, 0);
  post.take(b, 1);
  EXPECT_EQ(post.take(b, 1 + CommandPost::kPatience_s / 2).kind, Answer::Kind::Refused);
  EXPECT_EQ(post.take(b, 1 + CommandPost::kPatience_s).kind, Answer::Kind::Done)
      << "asking again does not begin the wait anew";
  EXPECT_TRUE(post.commands(b));
}

TEST(CommandPost, ASilentCommanderIsRelieved) {
  CommandPost post("run");
  const std::string a = post.join(0);
  post.take(a, 0);
  EXPECT_FALSE(post.relieve(CommandPost::kSilence_s));
  EXPECT_FALSE(post.admit(numbered(a, 1), 2));
  EXPECT_FALSE(post.relieve(2 + CommandPost::kSilence_s));
  EXPECT_TRUE(post.relieve(2.1 + CommandPost::kSilence_s));
  EXPECT_FALSE(post.relieve(100)) << "once";
  EXPECT_FALSE(post.commands(a));
}

TEST(CommandPost, AFloodOfClientsDoesNotUnseatTheCommander) {
  CommandPost post("run");
  const std::string a = post.join(0);
  const std::string b = post.join(1);
  post.take(a, 0);
  for (std::size_t i = 0; i < 10 * CommandPost::kMaxClients; ++i) post.join(double(i) + 2);
  EXPECT_FALSE(post.admit(numbered(a, 1), 0));
  EXPECT_EQ(post.admit(numbered(b, 1), 0)->kind, Answer::Kind::Stranger);
}

}  // namespace
}  // namespace kestrel
