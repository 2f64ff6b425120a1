// Where the homing of the device stands: what its person does next, and what is wrong. Words for it:
// scenarios/director/homing_words.h. Plain values, any thread.
#pragma once

#include <cstdint>

namespace trocar {

enum class HomingStep : std::uint8_t {
  kNone,   ///< not asked for now: before the self-test has passed
  kMarks,  ///< move the joints of `missing` until their marks are seen
  kJig,    ///< stylus into its jig, turned until the light is seen
  kRoll,   ///< turn it through the light to both sides
  kStill,  ///< leave it alone
  kHomed,
};

enum class HomingTrouble : std::uint8_t {
  kNone,
  kMoved,        ///< by channel, while it should have been still
  kDark,         ///< no light for so many seconds
  kAlwaysLit,    ///< light however the arm is moved
  kWrongPose,    ///< channel is so many counts off where the jig should hold it; roll: so wide is its light
  kDeadChannel,  ///< the light came and went and the channel counted nothing
  kTimeout,      ///< not homed after so many seconds
};

struct HomingReport {
  HomingStep step = HomingStep::kNone;
  HomingTrouble trouble = HomingTrouble::kNone;
  std::uint8_t missing = 0;  ///< a bit a joint whose mark has not been seen
  std::int8_t channel = -1;  ///< of the trouble
  double value = 0;          ///< of the trouble: counts, s

  bool operator==(const HomingReport&) const = default;
};

}  // namespace trocar
