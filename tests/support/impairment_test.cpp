#include "support/impairment.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

using Piece = ImpairedLine::Piece;
constexpr int kPieces = 20000;

/// A piece that tells its number, and is long enough to be cut and flipped.
Piece numbered(int number) {
  Piece piece(24, 0xA5);
  for (int i = 0; i < 4; ++i) piece[std::size_t(i)] = std::uint8_t(number >> (8 * i));
  return piece;
}

int number_of(const Piece& piece) {
  return int(piece.at(0)) | int(piece.at(1)) << 8 | int(piece.at(2)) << 16 | int(piece.at(3)) << 24;
}

Bytes view(const Piece& piece) { return {piece.data(), piece.size()}; }

/// A piece and when it arrived.
struct Arrival {
  double time_s;
  Piece piece;
};

constexpr double kPeriod_s = 0.01;

/// Sends numbered pieces every kPeriod_s and looks at each moment at which one arrives.
struct LineRun {
  LineRun(const ImpairmentOptions& options, const std::string& name, int pieces = kPieces,
          Carriage carriage = Carriage::Datagrams)
      : line(options, carriage, name) {
    for (int i = 0; i < pieces; ++i) {
      take(i * kPeriod_s);
      line.send(view(numbered(i)), i * kPeriod_s);
    }
    take(1e9);
  }

  void take(double until_s) {
    while (line.next_arrival_s() <= until_s) {
      const double time_s = line.next_arrival_s();
      for (Piece& piece : line.arrived(time_s)) arrivals.push_back({time_s, std::move(piece)});
    }
  }

  std::set<int> numbers() const {
    std::set<int> all;
    for (const Arrival& arrival : arrivals) all.insert(number_of(arrival.piece));
    return all;
  }

  ImpairedLine line;
  std::vector<Arrival> arrivals;
};

/// Five standard deviations of a binomial count: one test in two million fails by chance, and
/// the seeds are fixed.
double five_sigma(double share, int pieces) { return 5 * std::sqrt(pieces * share * (1 - share)); }

TEST(Impairment, WithoutOptionsIsALineThatChangesNothing) {
  for (const Carriage carriage : {Carriage::Datagrams, Carriage::Stream}) {
    const LineRun run({}, "perfect", 1000, carriage);
    ASSERT_EQ(run.arrivals.size(), 1000u);
    for (int i = 0; i < 1000; ++i) {
      EXPECT_EQ(run.arrivals[std::size_t(i)].piece, numbered(i));
      EXPECT_EQ(run.arrivals[std::size_t(i)].time_s, i * kPeriod_s);
    }
  }
}

TEST(Impairment, SharesAreThoseAskedFor) {
  using Share = double ImpairmentOptions::*;
  using Count = long LineCounts::*;
  const std::pair<Share, Count> kinds[] = {
      {&ImpairmentOptions::loss, &LineCounts::lost},
      {&ImpairmentOptions::duplication, &LineCounts::duplicated},
      {&ImpairmentOptions::corruption, &LineCounts::corrupted},
      {&ImpairmentOptions::truncation, &LineCounts::truncated},
      {&ImpairmentOptions::reordering, &LineCounts::reordered}};
  for (const auto& [share, count] : kinds) {
    for (const double wanted : {0.0, 0.01, 0.3, 1.0}) {
      ImpairmentOptions options;
      options.*share = wanted;
      const LineRun run(options, "shares");
      const LineCounts& counts = run.line.counts();
      EXPECT_NEAR(double(counts.*count), kPieces * wanted, five_sigma(wanted, kPieces));
      EXPECT_EQ(counts.sent + counts.duplicated,
                counts.lost + counts.overflowed + counts.delivered);
      EXPECT_EQ(counts.delivered, long(run.arrivals.size()));
      EXPECT_EQ(run.line.under_way_bytes(), 0u);
    }
  }
}

TEST(Impairment, KindsOfDamageComeIndependentlyOfEachOther) {
  ImpairmentOptions options;
  options.loss = 0.5;
  options.duplication = 0.5;
  const LineRun run(options, "independent");
  // A number is missed only where it was lost and not doubled: a quarter.
  EXPECT_NEAR(double(run.numbers().size()), kPieces * 0.75, five_sigma(0.75, kPieces));
}

TEST(Impairment, CorruptionFlipsOneToEightBitsAndKeepsTheLength) {
  ImpairmentOptions options;
  options.corruption = 1;
  const LineRun run(options, "bits", 5000);
  std::set<int> seen;
  for (int i = 0; i < 5000; ++i) {
    const Piece sent = numbered(i);
    const Piece& got = run.arrivals[std::size_t(i)].piece;
    ASSERT_EQ(got.size(), sent.size());
    int flips = 0;
    for (std::size_t k = 0; k < sent.size(); ++k) {
      for (unsigned differing = sent[k] ^ got[k]; differing != 0; differing >>= 1) {
        flips += int(differing & 1u);
      }
    }
    seen.insert(flips);
  }
  EXPECT_EQ(seen, (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Impairment, TruncationLeavesAShorterStart) {
  ImpairmentOptions options;
  options.truncation = 1;
  const LineRun run(options, "short", 1000);
  std::set<std::size_t> lengths;
  for (int i = 0; i < 1000; ++i) {
    const Piece sent = numbered(i);
    const Piece& got = run.arrivals[std::size_t(i)].piece;
    ASSERT_LT(got.size(), sent.size());
    EXPECT_TRUE(std::equal(got.begin(), got.end(), sent.begin()));
    lengths.insert(got.size());
  }
  EXPECT_EQ(lengths.size(), 24u);
}

TEST(Impairment, DelayIsUniformAroundItsMean) {
  ImpairmentOptions options;
  options.delay_s = 0.1;
  options.jitter_s = 0.04;
  const LineRun run(options, "delay");
  double sum_s = 0;
  for (const Arrival& arrival : run.arrivals) {
    const double delay_s = arrival.time_s - number_of(arrival.piece) * kPeriod_s;
    ASSERT_GE(delay_s, 0.06 - 1e-9);
    ASSERT_LE(delay_s, 0.14 + 1e-9);
    sum_s += delay_s;
  }
  // The standard deviation of a uniform width w is w / sqrt(12).
  EXPECT_NEAR(sum_s / kPieces, 0.1, 5 * 0.08 / std::sqrt(12.0 * kPieces));
}

TEST(Impairment, NothingArrivesBeforeItIsSent) {
  ImpairmentOptions options;
  options.jitter_s = 0.5;
  const LineRun run(options, "causal");
  for (const Arrival& arrival : run.arrivals) {
    ASSERT_GE(arrival.time_s, number_of(arrival.piece) * kPeriod_s);
  }
}

TEST(Impairment, JitterAndHoldbackLetDatagramsOvertake) {
  const auto overtaken = [](const ImpairmentOptions& options) {
    const LineRun run(options, "overtake");
    int newest = -1;
    int count = 0;
    for (const Arrival& arrival : run.arrivals) {
      if (number_of(arrival.piece) < newest) ++count;
      newest = std::max(newest, number_of(arrival.piece));
    }
    return count;
  };
  ImpairmentOptions options;
  options.delay_s = 0.1;
  EXPECT_EQ(overtaken(options), 0);
  options.reordering = 0.1;  // each by five periods: overtaken unless the next five are too
  EXPECT_NEAR(overtaken(options), kPieces * 0.1, five_sigma(0.1, kPieces));
  options.reordering = 0;
  options.jitter_s = 0.1;
  EXPECT_GT(overtaken(options), kPieces / 2);
}

TEST(Impairment, BandwidthSpacesWhatIsSent) {
  ImpairmentOptions options;
  options.bandwidth_bytes_s = 24 / kPeriod_s / 2;  // half of what is offered
  options.queue_s = 0.2;
  const LineRun run(options, "narrow", 2000);
  EXPECT_NEAR(double(run.line.counts().overflowed), 1000, 15);  // the queue holds 10
  for (std::size_t i = 1; i < run.arrivals.size(); ++i) {
    EXPECT_GE(run.arrivals[i].time_s - run.arrivals[i - 1].time_s, 2 * kPeriod_s - 1e-9);
    const double waited_s = run.arrivals[i].time_s - number_of(run.arrivals[i].piece) * kPeriod_s;
    EXPECT_LE(waited_s, options.queue_s + 2 * kPeriod_s + 1e-9);
  }
}

TEST(Impairment, AStreamArrivesWholeAndInOrder) {
  ImpairmentOptions options;
  options.loss = 0.2;
  options.splitting = 0.5;
  options.delay_s = 0.03;
  options.jitter_s = 0.03;
  const LineRun run(options, "stream", 5000, Carriage::Stream);
  Piece sent;
  Piece got;
  for (int i = 0; i < 5000; ++i) {
    const Piece piece = numbered(i);
    sent.insert(sent.end(), piece.begin(), piece.end());
  }
  double last_s = 0;
  for (const Arrival& arrival : run.arrivals) {
    got.insert(got.end(), arrival.piece.begin(), arrival.piece.end());
    EXPECT_GE(arrival.time_s, last_s);
    last_s = arrival.time_s;
  }
  EXPECT_EQ(got, sent);
  const LineCounts& counts = run.line.counts();
  EXPECT_NEAR(double(counts.lost), 1000, five_sigma(0.2, 5000));
  EXPECT_GT(counts.split, 2000);
  EXPECT_EQ(counts.sent + counts.split, counts.delivered);
}

TEST(Impairment, WhatAStreamLosesHoldsUpAllBehindIt) {
  ImpairmentOptions options;
  options.loss = 0.01;
  options.retransmission_s = 0.2;
  const LineRun run(options, "held up", 5000, Carriage::Stream);
  long late = 0;
  for (const Arrival& arrival : run.arrivals) {
    const double delay_s = arrival.time_s - number_of(arrival.piece) * kPeriod_s;
    EXPECT_LE(delay_s, 0.2 + 1e-9);
    if (delay_s > 0) ++late;
  }
  // Each loss stops twenty periods, overlaps apart.
  EXPECT_GT(late, 10 * run.line.counts().lost);
}

TEST(Impairment, TheSameNameIsTheSameLine) {
  ImpairmentOptions options;
  options.loss = options.duplication = options.corruption = options.truncation =
      options.reordering = 0.1;
  options.delay_s = options.jitter_s = 0.05;
  const auto times = [&](const std::string& name) {
    std::vector<std::pair<double, Piece>> all;
    for (const Arrival& arrival : LineRun(options, name, 2000).arrivals) {
      all.emplace_back(arrival.time_s, arrival.piece);
    }
    return all;
  };
  EXPECT_EQ(times("one"), times("one"));
  EXPECT_NE(times("one"), times("two"));
}

TEST(Impairment, AWorseLineLosesAllThatABetterOneLoses) {
  std::set<int> better;
  for (const double loss : {0.1, 0.3, 0.5}) {
    ImpairmentOptions options;
    options.loss = loss;
    options.jitter_s = loss;  // another option must not change who is lost
    const std::set<int> got = LineRun(options, "nested", 5000).numbers();
    if (!better.empty()) {
      EXPECT_TRUE(std::includes(better.begin(), better.end(), got.begin(), got.end()));
    }
    better = got;
  }
}

TEST(Impairment, OptionsOutOfRangeAreNamed) {
  const auto why = [](double ImpairmentOptions::*option, double value, Carriage carriage) {
    ImpairmentOptions options;
    options.*option = value;
    return message_of([&] { options.check(carriage); });
  };
  EXPECT_NE(why(&ImpairmentOptions::loss, 1.1, Carriage::Datagrams).find("loss"),
            std::string::npos);
  EXPECT_NE(why(&ImpairmentOptions::delay_s, -1, Carriage::Datagrams).find("delay_s"),
            std::string::npos);
  EXPECT_NE(why(&ImpairmentOptions::jitter_s, std::nan(""), Carriage::Datagrams).find("jitter_s"),
            std::string::npos);
  EXPECT_NE(why(&ImpairmentOptions::bandwidth_bytes_s, 0, Carriage::Stream).find("bandwidth"),
            std::string::npos);
  EXPECT_NE(why(&ImpairmentOptions::duplication, 0.1, Carriage::Stream).find("datagrams"),
            std::string::npos);
  EXPECT_NE(why(&ImpairmentOptions::splitting, 0.1, Carriage::Datagrams).find("streams"),
            std::string::npos);
}

}  // namespace
}  // namespace kestrel::test
