#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/bytes.hpp"
#include "kestrel/link/send_queue.hpp"

namespace kestrel {

/// How a connection is looked after.
struct StreamOptions {
  std::size_t queue_frames = 64;  // that wait for a peer that reads slowly
  double silent_s = 5;            // the longest that a peer may leave bytes unacknowledged

  /// Throws std::invalid_argument for fewer than two frames, or a time that is not 1 s to 1 h.
  void check() const;
};

/// One TCP connection that never makes its owner wait: each write takes what the network takes and
/// queues the rest, frame by frame. A peer that vanished without a word (half-open) is noticed by
/// the kernel's probes and by bytes it leaves unacknowledged. Owns its descriptor.
class StreamSocket {
 public:
  enum class State { Connecting, Open, Closed };

  /// Begins to connect; the descriptor becomes writable when that has come to an end. Throws
  /// std::runtime_error when it cannot even begin, for instance without a route.
  static StreamSocket connecting_to(const Address& address, const StreamOptions& options = {});
  /// A connection that is there, from StreamListener. Takes the descriptor.
  static StreamSocket of(int descriptor, const Address& from, const StreamOptions& options = {});

  StreamSocket(StreamSocket&& other) noexcept;
  StreamSocket& operator=(StreamSocket&& other) noexcept;
  StreamSocket(const StreamSocket&) = delete;
  StreamSocket& operator=(const StreamSocket&) = delete;
  ~StreamSocket();

  State state() const { return state_; }
  const Address& peer() const { return peer_; }
  int descriptor() const { return descriptor_; }

  /// Looks whether connecting has come to an end: Connecting becomes Open or Closed.
  State finish_connecting() noexcept;

  /// Sends a frame after those that wait. Nothing is sent before it is open, or after.
  void send(Bytes frame) noexcept;

  /// Sends of what waits as much as the network takes.
  void flush() noexcept;

  /// What has arrived, up to kChunk bytes: good until the next call. Empty when nothing is there,
  /// or, and then the state is Closed, when the peer has closed or is gone.
  Bytes receive() noexcept;

  /// What waits, and what was dropped.
  const SendQueue& queue() const { return queue_; }

  static constexpr std::size_t kChunk = 4096;

 private:
  StreamSocket(int descriptor, const Address& peer, const StreamOptions& options, State state);
  std::size_t write(Bytes bytes) noexcept;

  int descriptor_ = -1;
  Address peer_;
  State state_;
  SendQueue queue_;
  std::vector<std::uint8_t> buffer_;
};

/// Where TCP connections are accepted. Owns its descriptor.
class StreamListener {
 public:
  /// Port 0 takes any free one. Throws std::runtime_error when it cannot listen there.
  static StreamListener bound_to(const Address& address);

  StreamListener(StreamListener&& other) noexcept;
  StreamListener& operator=(StreamListener&& other) noexcept;
  StreamListener(const StreamListener&) = delete;
  StreamListener& operator=(const StreamListener&) = delete;
  ~StreamListener();

  /// This end, with its real port.
  const Address& local() const { return local_; }
  int descriptor() const { return descriptor_; }

  /// The next connection that waits; empty when there is none, or none can be had.
  std::optional<StreamSocket> accept(const StreamOptions& options = {}) noexcept;

 private:
  explicit StreamListener(int descriptor);
  int descriptor_ = -1;
  Address local_;
};

}  // namespace kestrel
