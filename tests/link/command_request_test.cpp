#include "kestrel/link/command_request.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

mavlink::CommandLong arm() {
  mavlink::CommandLong command;
  command.command = 400;
  command.param1 = 1;
  return command;
}

mavlink::CommandAck answer(std::uint16_t command, std::uint8_t result) {
  mavlink::CommandAck ack;
  ack.command = command;
  ack.result = result;
  return ack;
}

TEST(CommandRequest, IsSentFourTimesHalfASecondApartAndThenGivenUp) {
  CommandRequest request(arm());
  int sent = 0;
  for (int i = 0; i <= 100; ++i) {
    const double now_s = 10 + i * 0.05;
    if (const auto command = request.due(now_s)) {
      EXPECT_EQ(command->confirmation, sent);
      EXPECT_EQ(command->param1, 1);
      EXPECT_NEAR(now_s, 10 + sent * 0.5, 0.051);  // the step of the caller
      ++sent;
    }
  }
  EXPECT_EQ(sent, 4);
  EXPECT_EQ(request.state(), RequestState::Refused);
  EXPECT_EQ(request.words(), "arm: no answer to 4 tries");
}

TEST(CommandRequest, IsNotSentAgainAfterItWasAccepted) {
  CommandRequest request(arm());
  request.due(10);
  request.acknowledge(answer(400, 0), 10.2);
  EXPECT_EQ(request.state(), RequestState::Accepted);
  EXPECT_EQ(request.accepted_s(), 10.2);
  EXPECT_FALSE(request.due(20));
  request.acknowledge(answer(400, 4), 20);
  EXPECT_EQ(request.state(), RequestState::Accepted);
}

TEST(CommandRequest, TakesNoAnswerToAnotherCommandNorOneBeforeItWasSent) {
  CommandRequest request(arm());
  request.acknowledge(answer(400, 0), 9);
  EXPECT_EQ(request.state(), RequestState::Open);
  request.due(10);
  request.acknowledge(answer(176, 0), 10.1);
  EXPECT_EQ(request.state(), RequestState::Open);
}

TEST(CommandRequest, SaysWhyItWasRefused) {
  const char* words[] = {"",
                         "",
                         "arm: denied",
                         "arm: not supported",
                         "arm: failed",
                         "",
                         "arm: cancelled",
                         "arm: result 7"};
  for (const std::uint8_t result : {2, 3, 4, 6, 7}) {
    CommandRequest request(arm());
    request.due(10);
    request.acknowledge(answer(400, result), 10.1);
    EXPECT_EQ(request.state(), RequestState::Refused);
    EXPECT_EQ(request.words(), words[result]);
    EXPECT_FALSE(request.due(20));
  }
}

TEST(CommandRequest, TriesAgainWhenItIsPutOff) {
  CommandRequest request(arm());
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(request.due(10 + i));
    request.acknowledge(answer(400, 1), 10.1 + i);
  }
  EXPECT_EQ(request.state(), RequestState::Open);
  EXPECT_FALSE(request.due(15));
  EXPECT_EQ(request.words(), "arm: temporarily rejected, 4 times");
}

TEST(CommandRequest, WaitsForWhatIsInProgressButNotForEver) {
  CommandRequest request(arm());
  request.due(10);
  request.acknowledge(answer(400, 5), 10.1);
  EXPECT_FALSE(request.due(30));
  EXPECT_EQ(request.state(), RequestState::Open);
  CommandRequest stuck = request;
  request.acknowledge(answer(400, 0), 31);
  EXPECT_EQ(request.state(), RequestState::Accepted);
  stuck.acknowledge(answer(400, 5), 31);
  EXPECT_FALSE(stuck.due(40.2));
  EXPECT_EQ(stuck.state(), RequestState::Refused);
}

TEST(RequestOptions, NameWhatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((RequestOptions{0, 3, 30}.check()), std::invalid_argument);
  EXPECT_THROW((RequestOptions{nan, 3, 30}.check()), std::invalid_argument);
  EXPECT_THROW((RequestOptions{0.5, -1, 30}.check()), std::invalid_argument);
  EXPECT_THROW((RequestOptions{0.5, 3, nan}.check()), std::invalid_argument);
  EXPECT_NO_THROW(RequestOptions{}.check());
}

}  // namespace
}  // namespace kestrel
