#include "kestrel/link/stream_socket.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <poll.h>

#include "loopback.hpp"

namespace kestrel {
namespace {

using State = StreamSocket::State;
using Frame = std::vector<std::uint8_t>;

bool wait_for(int descriptor, short what) {
  pollfd wanted{descriptor, what, 0};
  return ::poll(&wanted, 1, int(test::kPatience_s * 1000)) == 1;
}

/// Two ends of a connection over loopback.
struct Pair {
  StreamSocket client;
  StreamSocket server;
};

Pair connected(const Address& at, const StreamOptions& options = {}) {
  StreamListener listener = StreamListener::bound_to(at);
  StreamSocket client = StreamSocket::connecting_to(listener.local(), options);
  EXPECT_TRUE(wait_for(listener.descriptor(), POLLIN));
  std::optional<StreamSocket> server = listener.accept(options);
  EXPECT_TRUE(server);
  EXPECT_TRUE(wait_for(client.descriptor(), POLLOUT));
  EXPECT_EQ(client.finish_connecting(), State::Open);
  return {std::move(client), std::move(*server)};
}

/// All that arrives until the count is reached or the stream ends.
Frame read(StreamSocket& from, std::size_t count) {
  Frame all;
  while (all.size() < count && from.state() == State::Open && wait_for(from.descriptor(), POLLIN)) {
    const Bytes chunk = from.receive();
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  return all;
}

TEST(StreamSocket, CarriesBytesBothWays) {
  for (const Address& loopback : test::loopbacks()) {
    Pair pair = connected(loopback);
    EXPECT_EQ(pair.server.peer().host, loopback.host);
    EXPECT_EQ(pair.client.receive().size, 0u);  // nothing there, and still open
    EXPECT_EQ(pair.client.state(), State::Open);
    const Frame there = {1, 2, 3};
    const Frame back = {4, 5};
    pair.client.send({there.data(), there.size()});
    EXPECT_EQ(read(pair.server, 3), there);
    pair.server.send({back.data(), back.size()});
    EXPECT_EQ(read(pair.client, 2), back);
  }
}

TEST(StreamSocket, ASlowReaderLosesWholeFramesAndNobodyWaits) {
  StreamOptions options;
  options.queue_frames = 8;
  Pair pair = connected({"127.0.0.1", 0}, options);
  long sent = 0;
  while (pair.client.queue().dropped() < 50) {  // each frame of one number, told by its size
    const Frame frame(1 + std::size_t(sent % 251), std::uint8_t(sent % 251));
    pair.client.send({frame.data(), frame.size()});
    ASSERT_LT(++sent, 1000000) << "no end of what the kernel takes";
  }
  EXPECT_EQ(pair.client.queue().size(), 8u);
  const long dropped = pair.client.queue().dropped();
  std::thread reader([&] {
    const Frame all = read(pair.server, std::size_t(1) << 40);
    long whole = 0;
    for (std::size_t at = 0; at < all.size(); at += 1 + std::size_t(all[at])) {
      ASSERT_LE(at + 1 + all[at], all.size());
      ASSERT_EQ(all[at], all[at + all[at]]);
      ++whole;
    }
    EXPECT_EQ(whole, sent - dropped);
  });
  while (!pair.client.queue().empty() && wait_for(pair.client.descriptor(), POLLOUT)) {
    pair.client.flush();
  }
  { const StreamSocket closed = std::move(pair.client); }
  reader.join();
  EXPECT_EQ(pair.server.state(), State::Closed);
}

TEST(StreamSocket, ARefusedConnectionIsClosed) {
  const Address nobody = StreamListener::bound_to({"127.0.0.1", 0}).local();
  StreamSocket socket = StreamSocket::connecting_to(nobody);
  ASSERT_TRUE(wait_for(socket.descriptor(), POLLOUT));
  EXPECT_EQ(socket.finish_connecting(), State::Closed);
  const Frame frame = {1};
  socket.send({frame.data(), 1});
  EXPECT_TRUE(socket.queue().empty());
}

TEST(StreamSocket, APeerThatClosesIsNoticedByReaderAndWriter) {
  Pair pair = connected({"127.0.0.1", 0});
  { const StreamSocket gone = std::move(pair.server); }
  ASSERT_TRUE(wait_for(pair.client.descriptor(), POLLIN));
  EXPECT_EQ(pair.client.receive().size, 0u);
  EXPECT_EQ(pair.client.state(), State::Closed);

  Pair other = connected({"127.0.0.1", 0});
  { const StreamSocket gone = std::move(other.server); }
  const Frame frame = {1};
  for (int i = 0; i < 1000 && other.client.state() == State::Open; ++i) {
    other.client.send({frame.data(), 1});  // the second at the latest hears that nobody is there
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(other.client.state(), State::Closed);
}

TEST(StreamSocket, AListenerRestartsOnItsPort) {
  StreamListener first = StreamListener::bound_to({"127.0.0.1", 0});
  const Address at = first.local();
  EXPECT_THROW(StreamListener::bound_to(at), std::runtime_error);
  StreamSocket client = StreamSocket::connecting_to(at);
  ASSERT_TRUE(wait_for(first.descriptor(), POLLIN));
  { const std::optional<StreamSocket> closed_first = first.accept(); }
  EXPECT_FALSE(first.accept());
  { const StreamListener gone = std::move(first); }
  EXPECT_NO_THROW(StreamListener::bound_to(at));  // though the old connection lingers
}

std::ptrdiff_t open_descriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                       std::filesystem::directory_iterator());
}

TEST(StreamSocket, OwnsItsDescriptor) {
  const auto before = open_descriptors();
  {
    Pair pair = connected({"127.0.0.1", 0});
    Pair other = connected({"127.0.0.1", 0});
    pair.client = std::move(other.client);
    EXPECT_EQ(pair.client.state(), State::Open);
  }
  EXPECT_EQ(open_descriptors(), before);
}

TEST(StreamSocket, RefusesWhatCannotBe) {
  StreamOptions few;
  few.queue_frames = 1;
  EXPECT_THROW(few.check(), std::invalid_argument);
  StreamOptions never;
  never.silent_s = 0.5;
  EXPECT_THROW(never.check(), std::invalid_argument);
  EXPECT_THROW(StreamSocket::connecting_to({"127.0.0.1", 1}, few), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
