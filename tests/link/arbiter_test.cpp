#include "kestrel/link/arbiter.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

const Claimant kGround{{1, 255, 190}, LinkRole::Ground, 100};
const Claimant kEye{{2, 1, 191}, LinkRole::Vision, 50};
const Claimant kOtherEye{{3, 1, 194}, LinkRole::Vision, 50};
const Claimant kScript{{4, 1, 193}, LinkRole::Script, 10};
constexpr double kFresh_s = 0.5;

std::optional<Refused> offer(Arbiter& arbiter, const Claimant& who, double now_s) {
  return arbiter.offer(who, now_s + kFresh_s, now_s);
}

TEST(Arbiter, GivesControlToWhoComesFirstAndKeepsItAmongEquals) {
  Arbiter arbiter(5);
  EXPECT_EQ(arbiter.state(), ControlState::Idle);
  EXPECT_FALSE(arbiter.owner());
  EXPECT_FALSE(offer(arbiter, kEye, 1));
  EXPECT_EQ(arbiter.owner(), kEye.id);
  EXPECT_EQ(arbiter.state(), ControlState::Owned);
  EXPECT_EQ(offer(arbiter, kOtherEye, 1.1), Refused::NotOwner);
  EXPECT_EQ(offer(arbiter, kScript, 1.1), Refused::NotOwner);
  EXPECT_FALSE(offer(arbiter, kEye, 1.2));
  EXPECT_EQ(arbiter.owner(), kEye.id);
}

TEST(Arbiter, GivesControlToTheHigherPriority) {
  Arbiter arbiter(5);
  EXPECT_FALSE(offer(arbiter, kScript, 1));
  EXPECT_FALSE(offer(arbiter, kEye, 1.1));
  EXPECT_EQ(arbiter.owner(), kEye.id);
  EXPECT_EQ(offer(arbiter, kScript, 1.2), Refused::NotOwner);
  EXPECT_FALSE(offer(arbiter, kGround, 1.3));
  EXPECT_EQ(offer(arbiter, kEye, 1.4), Refused::NotOwner);
  EXPECT_EQ(arbiter.owner(), kGround.id);
}

TEST(Arbiter, HandsOverWhenTheOwnerIsSilentToTheBestThatIsLive) {
  Arbiter arbiter(5);
  EXPECT_FALSE(offer(arbiter, kGround, 1));
  EXPECT_TRUE(offer(arbiter, kScript, 1.4));
  EXPECT_TRUE(offer(arbiter, kEye, 1.3));
  arbiter.update(1.49);
  EXPECT_EQ(arbiter.owner(), kGround.id);
  arbiter.update(1.51);
  EXPECT_EQ(arbiter.owner(), kEye.id);
  arbiter.update(1.81);
  EXPECT_EQ(arbiter.owner(), kScript.id);
  arbiter.update(2);
  EXPECT_FALSE(arbiter.owner());
  EXPECT_EQ(arbiter.state(), ControlState::Hold);
}

// At each setpoint either its source is the owner, or it is refused: two never mix.
TEST(Arbiter, NeverInterleaves) {
  test::Random random("arbiter");
  Arbiter arbiter(5);
  const Claimant all[] = {kGround, kEye, kOtherEye, kScript};
  double now_s = 0;
  for (int i = 0; i < 20000; ++i) {
    now_s += random.uniform(0, 0.02);
    const Claimant& who = all[random.integer(0, 3)];
    if (random.integer(0, 20) == 0) arbiter.heartbeat(who, now_s);
    switch (random.integer(0, 400)) {
      case 0:
        arbiter.take_over();
        break;
      case 1:
        arbiter.lock();
        break;
      case 2:
        arbiter.release();
        break;
      case 3:
        arbiter.stop();
        break;
      case 4:
      case 5:
        arbiter.reset();
        break;
      case 6:
        arbiter.forget(who.id.peer, now_s);
        break;
      default:
        break;
    }
    const ControlState before = arbiter.state();
    const auto refused = offer(arbiter, who, now_s);
    EXPECT_EQ(!refused, arbiter.owner() == who.id);
    if (before == ControlState::Stopped) {
      EXPECT_TRUE(refused == Refused::Stopped || refused == Refused::Dead);
    }
    if (before == ControlState::TakenOver && !refused) {
      EXPECT_EQ(who.role, LinkRole::Ground);
    }
  }
}

TEST(Arbiter, KeepsALockAlsoWithASilentOrGoneOwner) {
  Arbiter arbiter(5);
  EXPECT_FALSE(arbiter.lock());  // to whom?
  EXPECT_FALSE(offer(arbiter, kScript, 1));
  EXPECT_TRUE(arbiter.lock());
  EXPECT_EQ(arbiter.state(), ControlState::Locked);
  EXPECT_EQ(offer(arbiter, kGround, 1.1), Refused::Locked);
  EXPECT_EQ(offer(arbiter, kEye, 3), Refused::Locked);
  EXPECT_FALSE(offer(arbiter, kScript, 3.1));
  arbiter.forget(kScript.id.peer, 3.2);
  EXPECT_EQ(offer(arbiter, kEye, 4), Refused::Locked);
  arbiter.release();
  EXPECT_EQ(arbiter.state(), ControlState::Hold);
  EXPECT_FALSE(offer(arbiter, kEye, 4.1));
}

TEST(Arbiter, LocksToNobodyWhileItIsTakenOverOrStopped) {
  Arbiter arbiter(5);
  arbiter.take_over();
  EXPECT_FALSE(offer(arbiter, kGround, 1));
  EXPECT_FALSE(arbiter.lock());
  arbiter.release();
  EXPECT_FALSE(offer(arbiter, kEye, 1.1));
  arbiter.stop();
  EXPECT_FALSE(arbiter.lock());
  arbiter.reset();
  EXPECT_FALSE(offer(arbiter, kGround, 1.2)) << "a lock is left behind";
}

TEST(Arbiter, KeepsATakeOverAlsoWithoutAnyGround) {
  Arbiter arbiter(5);
  EXPECT_FALSE(offer(arbiter, kEye, 1));
  EXPECT_TRUE(arbiter.lock());
  arbiter.take_over();  // stronger than the lock
  EXPECT_FALSE(arbiter.owner());
  EXPECT_FALSE(arbiter.lock());
  EXPECT_EQ(offer(arbiter, kEye, 1.1), Refused::Locked);
  EXPECT_FALSE(offer(arbiter, kGround, 1.2));
  arbiter.forget(kGround.id.peer, 1.3);
  EXPECT_EQ(arbiter.state(), ControlState::TakenOver);
  EXPECT_EQ(offer(arbiter, kEye, 9), Refused::Dead);  // no heartbeat since 1 s
  arbiter.heartbeat(kEye, 9);
  EXPECT_EQ(offer(arbiter, kEye, 9), Refused::Locked);
  arbiter.update(100);
  EXPECT_FALSE(arbiter.owner());
  arbiter.release();
  arbiter.heartbeat(kEye, 100);
  EXPECT_FALSE(offer(arbiter, kEye, 100));
}

TEST(Arbiter, StopsUntilResetWhoeverSpeaksOrLeaves) {
  Arbiter arbiter(5);
  EXPECT_FALSE(offer(arbiter, kEye, 1));
  arbiter.stop();
  EXPECT_FALSE(arbiter.owner());
  for (const Claimant& who : {kGround, kEye, kScript}) {
    EXPECT_EQ(offer(arbiter, who, 1.1), Refused::Stopped);
  }
  arbiter.take_over();
  arbiter.release();
  arbiter.forget(kGround.id.peer, 2);
  arbiter.update(1000);
  EXPECT_EQ(arbiter.state(), ControlState::Stopped);
  arbiter.reset();
  EXPECT_EQ(arbiter.state(), ControlState::Hold);
  arbiter.heartbeat(kEye, 1000);
  EXPECT_FALSE(offer(arbiter, kEye, 1000));
}

TEST(Arbiter, HoldsAfterAStopThatCameFirst) {
  Arbiter arbiter(5);
  arbiter.stop();
  arbiter.reset();
  EXPECT_EQ(arbiter.state(), ControlState::Hold);
}

TEST(Arbiter, CountsASourceAsDeadWithoutHeartbeats) {
  Arbiter arbiter(5);
  arbiter.heartbeat(kEye, 0);
  for (double now_s = 0; now_s <= 5; now_s += 0.1) EXPECT_FALSE(offer(arbiter, kEye, now_s));
  EXPECT_TRUE(arbiter.take_dead().empty());
  EXPECT_EQ(offer(arbiter, kEye, 5.01), Refused::Dead);
  EXPECT_FALSE(arbiter.owner());
  ASSERT_EQ(arbiter.take_dead().size(), 1u);
  EXPECT_TRUE(arbiter.take_dead().empty());  // told once
  arbiter.heartbeat(kEye, 5.1);
  EXPECT_FALSE(offer(arbiter, kEye, 5.2));
  arbiter.update(10.2);
  EXPECT_EQ(arbiter.take_dead().size(), 1u);
}

TEST(Arbiter, TellsWhoMayCommand) {
  Arbiter arbiter(5);
  EXPECT_TRUE(arbiter.may_command(kEye.id, kEye.role));
  EXPECT_FALSE(offer(arbiter, kEye, 1));
  EXPECT_TRUE(arbiter.may_command(kEye.id, kEye.role));
  EXPECT_FALSE(arbiter.may_command(kScript.id, kScript.role));
  arbiter.take_over();
  EXPECT_FALSE(arbiter.may_command(kEye.id, kEye.role));
  arbiter.release();
  EXPECT_TRUE(arbiter.may_command(kScript.id, kScript.role));
  arbiter.stop();
  EXPECT_FALSE(arbiter.may_command(kEye.id, kEye.role));
}

TEST(Arbiter, HasRoomForAFewSourcesOfEachPeer) {
  Arbiter arbiter(5);
  for (int i = 0; i < 100; ++i) {
    const Claimant who{{7, std::uint8_t(i + 1), 1}, LinkRole::Script, 10};
    const auto refused = offer(arbiter, who, 1);
    EXPECT_EQ(refused == Refused::TooManySources, i >= int(Arbiter::kSourcesPerPeer));
  }
  EXPECT_FALSE(offer(arbiter, kEye, 1));  // the flood takes nobody's room
  EXPECT_FALSE(offer(arbiter, {{7, 200, 1}, LinkRole::Script, 10}, 6.2));  // the dead make room
}

// A dead source that control is locked to speaks again once its heart beats again, not before: its
// place is not given away, so that it cannot come back as somebody new.
TEST(Arbiter, GivesNobodyThePlaceOfADeadOwnerThatIsLockedTo) {
  Arbiter arbiter(5);
  const auto script = [](int i) {
    return Claimant{{7, std::uint8_t(i + 1), 1}, LinkRole::Script, 10};
  };
  EXPECT_FALSE(offer(arbiter, script(0), 1));
  EXPECT_TRUE(arbiter.lock());
  for (int i = 1; i < int(Arbiter::kSourcesPerPeer); ++i) offer(arbiter, script(i), 1);
  offer(arbiter, script(100), 7);  // the dead make room
  EXPECT_EQ(offer(arbiter, script(0), 7.1), Refused::Dead);
  arbiter.heartbeat(script(0), 7.2);
  EXPECT_FALSE(offer(arbiter, script(0), 7.3));
}

}  // namespace
}  // namespace kestrel
