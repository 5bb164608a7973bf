#include "kestrel/link/frame_reader.hpp"

#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/link/frame_server.hpp"
#include "kestrel/link/stream_socket.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using testing::HasSubstr;

constexpr double kPatience_s = 10;  // of a machine that is busy

FrameHeader numbered(std::uint64_t number) {
  FrameHeader made;
  made.width_px = 32;
  made.height_px = 8;
  made.number = number;
  made.capture_s = link_clock_s();
  return made;
}

std::vector<std::uint8_t> picture(std::uint8_t first) {
  std::vector<std::uint8_t> pixels(256);
  std::iota(pixels.begin(), pixels.end(), first);
  return pixels;
}

Bytes bytes_of(const std::vector<std::uint8_t>& bytes) { return {bytes.data(), bytes.size()}; }

template <class Done>
bool comes_true(const Done& done) {
  for (const double end_s = link_clock_s() + kPatience_s; link_clock_s() < end_s;) {
    if (done()) return true;
  }
  return false;
}

template <class Done>
bool serve_until(FrameServer& server, const Done& done) {
  return comes_true([&] {
    server.serve(0.002);
    return done();
  });
}

/// Over TCP and over a local socket.
class FrameStream : public testing::TestWithParam<bool> {
 protected:
  test::TempFolder folder_;
  FramePlace place_ =
      GetParam() ? FramePlace{{}, folder_ / "frames"} : FramePlace{{"127.0.0.1", 0}, {}};
};
INSTANTIATE_TEST_SUITE_P(Places, FrameStream, testing::Bool(), [](const auto& which) {
  return std::string(which.param ? "local" : "tcp");
});

TEST_P(FrameStream, FramesArriveAsTheyWereSent) {
  FrameServer server(place_);
  FrameReader reader(server.place());
  ASSERT_TRUE(serve_until(server, [&] { return server.counts().readers == 1; }));
  for (const std::uint64_t number : {5u, 6u, 9u}) {
    const auto sent = picture(std::uint8_t(number));
    const FrameHeader head = numbered(number);
    server.publish(head, bytes_of(sent));
    ASSERT_TRUE(serve_until(server, [&] { return reader.counts().received > 0; }));
    const auto frame = reader.next(kPatience_s);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->header.number, number);
    EXPECT_EQ(frame->header.width_px, 32u);
    EXPECT_EQ(frame->pixels, sent);
    EXPECT_EQ(frame->connection, 1);
  }
  EXPECT_TRUE(reader.take_problems().empty());
}

TEST_P(FrameStream, TheNewestFrameIsGivenAndNoneTwice) {
  FrameServer server(place_);
  FrameReader reader(server.place());
  ASSERT_TRUE(serve_until(server, [&] { return server.counts().readers == 1; }));
  for (std::uint64_t k = 0; k < 5; ++k) {
    server.publish(numbered(k), bytes_of(picture(0)));
    ASSERT_TRUE(serve_until(server, [&] { return reader.counts().received == long(k) + 1; }));
  }
  EXPECT_EQ(reader.next(0)->header.number, 4u);
  EXPECT_FALSE(reader.next(0.01));
  EXPECT_EQ(reader.counts().replaced, 4);
}

// The capture lies half a second before the frame is sent: that is seen, whatever clock the sender
// has; what is not seen is the way, which is shorter than what publish and serve took.
TEST_P(FrameStream, AFrameIsDatedByItsCapture) {
  FrameServer server(place_);
  FrameReader reader(server.place());
  ASSERT_TRUE(serve_until(server, [&] { return server.counts().readers == 1; }));
  FrameHeader old = numbered(0);
  const double captured_s = link_clock_s() - 0.5;
  old.capture_s = captured_s;
  const double before_s = link_clock_s();
  server.publish(old, bytes_of(picture(0)));
  ASSERT_TRUE(serve_until(server, [&] { return reader.counts().received == 1; }));
  const double way_s = link_clock_s() - before_s;
  const auto frame = reader.next(0);
  ASSERT_TRUE(frame);
  EXPECT_GE(frame->capture_s, captured_s);
  EXPECT_LE(frame->capture_s, captured_s + way_s);
}

/// A server that sends these bytes to the first who comes, and closes.
void serve_once(StreamListener& listener, const std::vector<std::uint8_t>& bytes) {
  std::optional<StreamSocket> socket;
  ASSERT_TRUE(comes_true([&] { return (socket = listener.accept()).has_value(); }));
  socket->send(bytes_of(bytes));
}

TEST(FrameReader, WhatIsNoFrameIsSaidAndItConnectsAgain) {
  StreamListener listener = StreamListener::bound_to({"127.0.0.1", 0});
  FrameReader reader({listener.local(), {}});
  serve_once(listener, std::vector<std::uint8_t>(60, 'x'));
  ASSERT_TRUE(comes_true([&] { return reader.counts().broken == 1; }));
  EXPECT_THAT(reader.take_problems(), testing::ElementsAre(HasSubstr("no frame begins here")));
  serve_once(listener, {});  // it has come again
  EXPECT_TRUE(comes_true([&] { return reader.counts().connections == 2; }));
  EXPECT_EQ(reader.counts().received, 0);
}

TEST(FrameReader, HalfAFrameIsSaidAndTheNextServerIsRead) {
  Address at;
  std::unique_ptr<FrameReader> reader;
  {
    StreamListener listener = StreamListener::bound_to({"127.0.0.1", 0});
    at = listener.local();
    reader = std::make_unique<FrameReader>(FramePlace{at, {}});
    FrameHeader head = numbered(7);
    head.sent_s = head.capture_s;
    const auto encoded = encode(head);
    std::vector<std::uint8_t> half(encoded.begin(), encoded.end());
    half.resize(kFrameHeaderBytes + 20);
    serve_once(listener, half);
    ASSERT_TRUE(comes_true([&] { return reader->counts().broken == 1; }));
  }
  EXPECT_THAT(reader->last_problem(),
              HasSubstr("the stream ended within frame 7 (20 of 256 bytes)"));
  FrameServer server({at, {}});
  ASSERT_TRUE(serve_until(server, [&] { return server.counts().readers == 1; }));
  server.publish(numbered(0), bytes_of(picture(1)));
  ASSERT_TRUE(serve_until(server, [&] { return reader->counts().received == 1; }));
  EXPECT_EQ(reader->next(0)->connection, 2);
}

TEST(FrameReader, NobodyThereIsSaidOnce) {
  const Address deaf = StreamListener::bound_to({"127.0.0.1", 0}).local();
  FrameReader reader({deaf, {}});
  EXPECT_FALSE(reader.next(0.3));  // two attempts
  EXPECT_THAT(reader.take_problems(),
              testing::ElementsAre(HasSubstr("nobody serves frames there")));
  EXPECT_EQ(reader.counts().connections, 0);
}

}  // namespace
}  // namespace kestrel
