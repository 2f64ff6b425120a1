// Ring on wire against scripted states: gates along the wire, back and forth, jumps, touches, and the ring pulled off.
#include "scenarios/kinds/wire/ring_task.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "haptics/least_turn.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/wire/wire_layout.h"
#include "scenarios/kinds/wire/wire_rules.h"

namespace trocar::ring_task_test {
namespace {

/// The first board of L1 and a director that is fed at 100 Hz.
class RingTest : public testing::Test {
 protected:
  RingTest()
      : exercise_(find_exercise("E06", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises")),
        level_(exercise_.levels[0]),
        board_(lay_out_wire(exercise_, level_, Mat3::Identity(), 0)),
        ring_(ring_of(exercise_, level_)),
        along_(arc_lengths(board_.wire_T)),
        director_(exercise_, level_, board_) {
    state_.loop = LoopState::kActive;
    state_.X_TI.p = board_.start_T;
    feed(1.1);
  }
  void feed(double seconds) {
    for (int i = 0, n = static_cast<int>(std::lround(seconds * 100)); i < n; ++i) {
      state_.t_s += 0.01;
      director_.update(state_);
    }
  }
  /// The ring round that point of the wire, across it but for a turn about `about`, its middle off by `aside_T`.
  void at(std::size_t point, const Vec3& aside_T = Vec3::Zero(), double turn_rad = 0) {
    const Vec3 tangent =
        (board_.wire_T[std::min(point + 1, board_.wire_T.size() - 1)] - board_.wire_T[point - 1]).normalized();
    const Mat3 R = Eigen::AngleAxisd(turn_rad, Vec3::UnitY()).toRotationMatrix() *
                   least_turn(ring_.normal_I, tangent).toRotationMatrix();
    state_.X_TI = {R, board_.wire_T[point] + aside_T - R * ring_.centre_I};
  }
  /// Point by point, two centimetres a second.
  void slide(std::size_t from, std::size_t to, double turn_rad = 0) {
    for (std::size_t i = from; i != to; from < to ? ++i : --i) {
      at(i, Vec3::Zero(), turn_rad);
      feed(0.05);
    }
  }
  int count(const std::string& type) const {
    return static_cast<int>(std::count_if(director_.events().begin(), director_.events().end(),
                                          [&](const Event& e) { return e.type == type; }));
  }
  const Event& last(const std::string& type) const {
    const auto& events = director_.events();
    return *std::find_if(events.rbegin(), events.rend(), [&](const Event& e) { return e.type == type; });
  }

  Exercise exercise_;
  ExerciseLevel level_;
  Board board_;
  RingOnWire ring_;
  std::vector<double> along_;
  StylusState state_;
  Director director_;
};

TEST_F(RingTest, FromEndToEndPassesEveryGateOnce) {
  slide(1, board_.wire_T.size() - 1);
  EXPECT_EQ(director_.status().phase, Phase::kDone);
  EXPECT_EQ(count("TARGET_HELD"), 21);
  EXPECT_EQ(count("WIRE_TOUCHED") + count("RING_OFF"), 0);
  for (const Event& e : director_.events()) EXPECT_TRUE(e.type != "ANGLE_ERROR" || e.value < 0.03) << e.value;
  const ScoringContext context =
      scoring_context(exercise_, level_, board_, director_.events(), AttemptStatus::kCompleted);
  EXPECT_TRUE(context.ring_on_wire);
  EXPECT_EQ(context.objects_done, 21);
  EXPECT_EQ(parse_scoring_context(scoring_context_json(context), "here"), context);
}

TEST_F(RingTest, BackAndForthPassesNoGateTwice) {
  slide(1, 45);
  const int passed = count("TARGET_HELD");
  for (int n = 0; n < 3; ++n) {
    slide(45, 5);
    slide(5, 45);
  }
  EXPECT_EQ(passed, 4);
  EXPECT_EQ(count("TARGET_HELD"), passed);
}

TEST_F(RingTest, AJumpAlongTheWireIsTheRingPulledOff) {
  slide(1, 45);
  at(150);
  feed(0.5);
  EXPECT_EQ(count("TARGET_HELD"), 4);
  EXPECT_EQ(count("RING_OFF"), 1);
  EXPECT_EQ(last("RING_OFF").severity, Severity::kCritical);
  EXPECT_EQ(director_.status().ring, nullptr) << "nothing is felt of a wire that is not in the ring";
  slide(150, 200);
  EXPECT_EQ(count("TARGET_HELD"), 4);
}

TEST_F(RingTest, OffTheWireNothingPassesUntilItIsPutOnWhereItCameOff) {
  at(120);
  feed(1);
  slide(120, 180);
  EXPECT_EQ(count("TARGET_HELD"), 0) << "it must go over the end first";
  slide(1, 45);
  at(45, Vec3(0, 0.020, 0));
  feed(0.1);
  EXPECT_EQ(count("RING_OFF"), 1);
  EXPECT_TRUE(director_.status().warning);
  slide(45, 78);
  EXPECT_EQ(count("TARGET_HELD"), 7);
  EXPECT_EQ(count("RING_OFF"), 1);
}

TEST_F(RingTest, PressedAgainstTheWireItStaysOnAsLongAsTheWireHolds) {
  slide(1, 30);
  const double most =
      ring_.play_m + own_rules<WireRules>(exercise_).holds_n / own_rules<WireRules>(exercise_).stiffness_n_per_m;
  at(30, Vec3(0, most - 0.0005, 0));
  feed(0.1);
  EXPECT_EQ(count("RING_OFF"), 0);
  ASSERT_NE(director_.status().ring, nullptr);
  at(30, Vec3(0, most + 0.0005, 0));
  feed(0.1);
  EXPECT_EQ(count("RING_OFF"), 1);
}

TEST_F(RingTest, TouchesAreToldOnceEachWithTheirTime) {
  slide(1, 30);
  const auto touch = [&](double seconds, double apart) {
    state_.contact = true;
    feed(seconds);
    state_.contact = false;
    feed(apart);
  };
  touch(0.02, 0.3);
  EXPECT_EQ(count("WIRE_TOUCHED"), 0) << "20 ms are none";
  touch(0.3, 0.1);
  touch(0.2, 0.3);
  EXPECT_EQ(count("WIRE_TOUCHED"), 1) << "0.1 s apart: the same";
  EXPECT_NEAR(last("WIRE_TOUCHED").value, 0.5, 1e-9);
  touch(0.1, 0.3);
  EXPECT_EQ(count("WIRE_TOUCHED"), 2);
}

TEST_F(RingTest, TheAngleIsThatOfNewWireOnly) {
  slide(1, 25, 0.3);
  EXPECT_NEAR(last("ANGLE_ERROR").value, 0.3, 0.04);
  at(25);
  feed(20);  // standing there square to it
  slide(25, 36, 0.3);
  EXPECT_EQ(count("ANGLE_ERROR"), 3);
  EXPECT_NEAR(last("ANGLE_ERROR").value, 0.3, 0.06);
}

}  // namespace
}  // namespace trocar::ring_task_test
