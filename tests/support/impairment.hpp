#pragma once

#include <cstdint>
#include <limits>
#include <queue>
#include <string_view>
#include <vector>

#include "kestrel/link/bytes.hpp"

#include "support/random.hpp"

namespace kestrel::test {

/// How a line is cut into pieces that travel on their own.
enum class Carriage {
  Datagrams,  // UDP: each is lost, late, double or damaged by itself
  Stream,     // TCP: nothing is lost or overtaken; what would be lost holds up all behind it
};

/// What a bad line does. Shares are probabilities in [0, 1], drawn for each piece by itself.
struct ImpairmentOptions {
  double loss = 0;                // never arrives; of a stream: arrives retransmission_s later
  double duplication = 0;         // arrives twice, each with a jitter of its own (datagrams only)
  double corruption = 0;          // one to eight of its bits are flipped
  double truncation = 0;          // arrives shorter (datagrams only)
  double reordering = 0;          // is held back for holdback_s more, so that others overtake it
  double splitting = 0;           // arrives in two pieces (streams only)
  double delay_s = 0;             // of all
  double jitter_s = 0;            // delay_s plus or minus up to this, uniformly, never negative
  double holdback_s = 0.05;       // of what is reordered
  double retransmission_s = 0.2;  // of what a stream loses (Linux: TCP_RTO_MIN, 200 ms)
  double bandwidth_bytes_s = std::numeric_limits<double>::infinity();
  double queue_s = 0.2;  // what would wait longer for its turn is dropped (datagrams only)

  /// Throws std::invalid_argument that names the first option out of range, or of no meaning for
  /// the carriage.
  void check(Carriage carriage) const;
};

/// All that a poor radio does. Corruption passes the checksum about once in 65536.
ImpairmentOptions poor_radio(double loss);

/// What became of the pieces. Of datagrams, sent + duplicated = lost + overflowed + delivered +
/// those still under way; of streams, sent + split = delivered + those still under way.
struct LineCounts {
  long sent = 0;
  long lost = 0;        // of a stream: held up
  long overflowed = 0;  // found the queue full
  long duplicated = 0;
  long corrupted = 0;
  long truncated = 0;
  long reordered = 0;  // held back
  long split = 0;
  long delivered = 0;
};

/// One direction of a bad line, as a function of time and chance alone: the same name, pieces and
/// times give the same arrivals, and each piece draws the same numbers whatever the options are, so
/// that of two lines with one name the worse loses all that the better loses. For any clock.
class ImpairedLine {
 public:
  using Piece = std::vector<std::uint8_t>;

  /// Throws std::invalid_argument for options that do not check. `name` is the seed.
  ImpairedLine(const ImpairmentOptions& options, Carriage carriage, std::string_view name);

  /// Takes a piece at a time not before that of the last.
  void send(Bytes piece, double now_s);

  /// The pieces that have arrived by now, in the order of their arrival.
  std::vector<Piece> arrived(double now_s);

  /// When the next piece arrives; infinity when none is under way.
  double next_arrival_s() const;

  /// Bytes that are under way.
  std::size_t under_way_bytes() const { return under_way_bytes_; }

  const LineCounts& counts() const { return counts_; }

 private:
  /// The chance of one piece.
  struct Draw {
    double loss, duplication, corruption, truncation, reordering, splitting;
    double jitter, jitter_of_copy;  // in [-1, 1)
    double cut;                     // in [0, 1): where it is cut, or split
    std::uint64_t damage;           // which bits
  };
  struct Travelling {
    double arrives_s = 0;
    long order = 0;
    Piece piece;
    bool operator<(const Travelling& other) const;  // the earliest is the greatest
  };

  Draw draw();
  Piece damaged(Bytes piece, const Draw& draw);
  void send_datagram(const Piece& piece, const Draw& draw, double leaves_s);
  void send_stream(const Piece& piece, const Draw& draw, double leaves_s);
  double travel_s(double jitter) const;
  void put(Piece piece, double arrives_s);

  ImpairmentOptions options_;
  Carriage carriage_;
  Random random_;
  std::priority_queue<Travelling> travelling_;
  std::size_t under_way_bytes_ = 0;
  double line_free_s_ = -std::numeric_limits<double>::infinity();
  double last_arrival_s_ = -std::numeric_limits<double>::infinity();  // of a stream
  long order_ = 0;
  LineCounts counts_;
};

}  // namespace kestrel::test
