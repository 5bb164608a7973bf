#include "kestrel/link/signature_checker.hpp"

#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

constexpr double kNow_s = 1.8e9;  // in the year 2027
constexpr double kUnit_s = 1 / kSigningUnits_per_s;

SigningKey key_of(std::uint8_t byte) {
  SigningKey::Secret secret{};
  secret.fill(byte);
  return SigningKey(secret);
}

/// Who signs a frame, and when.
struct Signed {
  std::uint8_t system_id = 1, component_id = 191, link_id = 0;
  std::uint64_t time = signing_time(kNow_s);
};

Buffer frame_of(const Signed& s, std::uint8_t key = 1) {
  return test::copy(
      signed_frame(Heartbeat{}, {s.system_id, s.component_id, 0}, {s.link_id, s.time}, key_of(key))
          .bytes());
}

Verdict verdict(SignatureChecker& checker, const Buffer& frame, double unix_s = kNow_s) {
  return checker.check(std::get<FrameView>(parse(test::view(frame)).content), unix_s);
}

Signed at(double unix_s) { return {1, 191, 0, signing_time(unix_s)}; }

TEST(SignatureChecker, AcceptsEachFrameOnceAndInOrder) {
  SignatureChecker checker(key_of(1));
  const std::uint64_t start = signing_time(kNow_s);
  for (const std::uint64_t time : {start, start + 1, start + 5, start + 1000}) {
    EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, time})), Verdict::Genuine);
    EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, time})), Verdict::Replayed);
    EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, time - 1})), Verdict::Replayed);
    EXPECT_EQ(checker.newest(), time);
  }
}

TEST(SignatureChecker, StreamsDoNotDisturbEachOther) {
  SignatureChecker checker(key_of(1));
  const std::uint64_t time = signing_time(kNow_s);
  EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, time})), Verdict::Genuine);
  EXPECT_EQ(verdict(checker, frame_of({2, 191, 0, time - 9})), Verdict::Genuine);
  EXPECT_EQ(verdict(checker, frame_of({1, 190, 0, time - 9})), Verdict::Genuine);
  EXPECT_EQ(verdict(checker, frame_of({1, 191, 1, time - 9})), Verdict::Genuine);
  EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, time - 9})), Verdict::Replayed);
  EXPECT_EQ(verdict(checker, frame_of({1, 191, 1, time - 8})), Verdict::Genuine);
}

TEST(SignatureChecker, RefusesWhatIsNotSignedWithTheKey) {
  SignatureChecker checker(key_of(1));
  EXPECT_EQ(verdict(checker, test::copy(encode(Heartbeat{}, {1, 191, 0}).bytes())),
            Verdict::Unsigned);
  EXPECT_EQ(verdict(checker, frame_of({}, 2)), Verdict::Forged);
  Buffer frame = frame_of({});
  frame.back() ^= 1;
  EXPECT_EQ(verdict(checker, frame), Verdict::Forged);
  // The frame as it was is still new.
  EXPECT_EQ(verdict(checker, frame_of({})), Verdict::Genuine);
}

TEST(SignatureChecker, RefusesWhatWasSignedAtAnotherTime) {
  for (const bool running : {false, true}) {
    SignatureChecker checker(key_of(1));
    const double start_s = kNow_s - 70;
    if (running) {
      EXPECT_EQ(verdict(checker, frame_of(at(start_s)), start_s), Verdict::Genuine);
    }
    EXPECT_EQ(verdict(checker, frame_of(at(kNow_s - 60.001))), Verdict::TooOld);
    EXPECT_EQ(verdict(checker, frame_of(at(kNow_s + 60.001))), Verdict::FromFuture);
    EXPECT_EQ(verdict(checker, frame_of(at(kNow_s - 59.999))), Verdict::Genuine);
    EXPECT_EQ(verdict(checker, frame_of(at(kNow_s + 59.999))), Verdict::Genuine);
  }
}

TEST(SignatureChecker, RefusesEverythingWithoutAClock) {
  SignatureChecker checker(key_of(1));
  for (const double unix_s : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(verdict(checker, frame_of({}), unix_s), Verdict::FromFuture);
  }
}

TEST(SignatureChecker, ARefusalChangesNothing) {
  // Two checkers see the same genuine frames, one of them with refused frames in between.
  test::Random random("refusals");
  SignatureChecker pure(key_of(1)), tried(key_of(1));
  std::uint64_t time = signing_time(kNow_s) - 3000;
  for (int i = 0; i < 500; ++i) {
    const auto system = std::uint8_t(random.integer(1, 3));
    const std::vector<Buffer> bad = {frame_of({system, 191, 0, time + 100}, 2),
                                     frame_of({system, 191, 0, signing_time(kNow_s + 61)}),
                                     frame_of({system, 191, 0, signing_time(kNow_s - 61)}),
                                     test::copy(encode(Heartbeat{}, {system, 191, 0}).bytes())};
    for (const Buffer& frame : bad) EXPECT_NE(verdict(tried, frame), Verdict::Genuine);
    time += std::uint64_t(random.integer(-2, 5));
    const Buffer frame = frame_of({system, 191, 0, time});
    EXPECT_EQ(verdict(tried, frame), verdict(pure, frame));
    EXPECT_EQ(tried.newest(), pure.newest());
  }
}

TEST(SignatureChecker, NothingGenuineIsAcceptedTwiceInAnyOrder) {
  test::Random random("replays");
  SignatureChecker checker(key_of(1));
  std::vector<Buffer> sent;
  std::set<Buffer> accepted;
  double now_s = kNow_s;
  for (int i = 0; i < 3000; ++i) {
    // The clock here also jumps, forwards and back.
    now_s += random.uniform(0, 0.5);
    const double jump_s = random.integer(0, 9) == 0 ? random.uniform(-200, 200) : 0;
    if (sent.empty() || random.integer(0, 1) == 0) {
      sent.push_back(
          frame_of({test::random_byte(random), test::random_byte(random), 0, signing_time(now_s)}));
    }
    const Buffer& frame = sent[std::size_t(random.integer(0, int(sent.size()) - 1))];
    if (verdict(checker, frame, now_s + jump_s) != Verdict::Genuine) continue;
    EXPECT_TRUE(accepted.insert(frame).second) << "accepted again";
  }
  EXPECT_GT(accepted.size(), SignatureChecker::kStreams * 2);
}

TEST(SignatureChecker, LiveStreamsAreNotDisplaced) {
  SignatureChecker checker(key_of(1));
  for (std::size_t i = 0; i < SignatureChecker::kStreams; ++i) {
    EXPECT_EQ(verdict(checker, frame_of({std::uint8_t(i + 1)})), Verdict::Genuine);
  }
  EXPECT_EQ(verdict(checker, frame_of({200})), Verdict::NoRoom);
  EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, signing_time(kNow_s) + 1})), Verdict::Genuine);
  // A minute on, those that have been silent since make room; one that speaks does not.
  const double later_s = kNow_s + 60.1;
  EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, signing_time(later_s)}), later_s),
            Verdict::Genuine);
  for (std::size_t i = 1; i < SignatureChecker::kStreams; ++i) {
    EXPECT_EQ(
        verdict(checker, frame_of({std::uint8_t(i + 100), 191, 0, signing_time(later_s)}), later_s),
        Verdict::Genuine);
  }
  EXPECT_EQ(verdict(checker, frame_of({1, 191, 0, signing_time(later_s)}), later_s),
            Verdict::Replayed);
  // Nor do they come back when the clock is set back.
  EXPECT_EQ(verdict(checker, frame_of({9}), kNow_s), Verdict::Replayed);
}

TEST(SignatureChecker, NothingFromBeforeARestartIsAccepted) {
  SignatureChecker before(key_of(1));
  EXPECT_EQ(verdict(before, frame_of({})), Verdict::Genuine);
  SignatureChecker after(key_of(1), before.newest());
  EXPECT_EQ(after.newest(), before.newest());
  EXPECT_EQ(verdict(after, frame_of({}), kNow_s + 1), Verdict::Replayed);
  EXPECT_EQ(verdict(after, frame_of({2}), kNow_s + 1), Verdict::Replayed);
  EXPECT_EQ(verdict(after, frame_of(at(kNow_s + kUnit_s)), kNow_s + 1), Verdict::Genuine);
}

TEST(SignatureChecker, NamesItsVerdicts) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kVerdicts; ++i) names.insert(name(Verdict(i)));
  EXPECT_EQ(names.size(), kVerdicts);
  EXPECT_EQ(names.count(""), 0u);
}

}  // namespace
}  // namespace kestrel::mavlink
