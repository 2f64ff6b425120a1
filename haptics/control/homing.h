// How a device of which only counts are known finds its zero: the jig, the light of the jig, what its person does next.
//
// Thesis 3.4.1 and figure 3.26: a stand holds the stylus' place, a coupler lets infrared light through where its turn
// is right; while the receiver sees light and nothing moves the arm is home. Torque is off all the while
// (supervisor.h). Beyond that figure:
//   edges  the light is a window of some degrees of joint 6. Entered once from either side, with the receiver's
//          hysteresis on the same side of both, its middle is the zero of that joint.
//   index  each encoder marks one count a motor turn, 82.8 deg of its joint. A mark seen on the way into the jig tells
//          the joint's zero to a count; the jig only says which turn it was.
// What is wrong is told and keeps the arm unhomed; it goes when it is put right. Places in counts since begin().
// Thread: haptic task; no allocation, no clock.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/device_model.h"
#include "haptics/exchange/homing_report.h"

namespace trocar {

struct HomingLimits {
  double beam_s = 0.05;           ///< light without a break before it counts
  double still_s = 0.5;           ///< no count on any channel
  double debounce_s = 5e-3;       ///< dark and light around an edge last at least so long
  double dark_s = 20;             ///< without light: told
  double limit_s = 120;           ///< not homed: told
  std::int32_t lit_travel = 600;  ///< counts of a joint, 25 deg, under unbroken light: nothing can be so wide
  double window_least = 120, window_most = 480;  ///< counts of the roll, 5 to 20 deg, between the edges [20 and 12 deg]
  double jig_counts = 120;                       ///< that a mark may be off what the jig says: 5 deg
  double roll_counts = 300;                      ///< the same of the roll, which the jig leaves to the light
  double index_turn = 2000;                      ///< counts from mark to mark
  std::array<std::int32_t, kChannels> still_counts{};  ///< a tick that are no motion: noise of a potentiometer
};

class Homing {
 public:
  using Counts = std::array<std::int32_t, kChannels>;
  Homing(const HomingLimits& limits, const HomingModel& model, double period_s)
      : limits_(limits), model_(model), period_s_(period_s) {}

  /// Forgets everything.
  void begin();
  /// One tick. @param delta counts since the last one. @return homed now.
  bool update(const DaqSample& in, const Counts& delta);
  bool still(const Counts& delta) const;

  const HomingReport& report() const { return report_; }
  /// Once homed: counts by which the arm stands off its home.
  const ChannelVector& offset() const { return offset_; }
  /// Once homed: from home to the mark that was seen, counts, nearest; NaN: none was seen.
  ChannelVector marks() const;

 private:
  struct Edge {
    bool seen = false;
    double place = 0;
  };
  void follow(const DaqSample& in, const Counts& delta);
  void see_light(bool beam);
  void see_motion(const Counts& delta);
  void find_trouble();
  HomingStep next_step() const;
  bool settle();
  void tell(HomingTrouble trouble, int channel, double value) {
    report_ = {report_.step, trouble, report_.missing, static_cast<std::int8_t>(channel), value};
  }

  HomingLimits limits_;
  HomingModel model_;
  double period_s_;
  HomingReport report_;
  ChannelVector place_ = ChannelVector::Zero(), offset_ = ChannelVector::Zero();
  ChannelVector lit_from_ = ChannelVector::Zero(), lit_to_ = ChannelVector::Zero();  ///< range under this light
  ChannelVector mark_ = ChannelVector::Zero();
  std::uint8_t marked_ = 0;
  double waited_s_ = 0, beam_s_ = 0, unlit_s_ = 0, still_s_ = 0, lit_place_ = 0;
  int roll_sign_ = 0, entered_sign_ = 0;
  bool dark_seen_ = false, always_lit_ = false;
  Edge upward_, downward_;  ///< light entered with joint 6 growing, falling
};

}  // namespace trocar
