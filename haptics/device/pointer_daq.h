// Back-end of the seam without a device: an instrument that goes where mouse, keys or pad point.
//
// There is no arm, no motor and no encoder, so none of them can fault, heat or weaken. The joints of the arm that would
// hold the instrument there are what the seam asks for, and so its joint limits are the limits of the work space: a
// pose beyond them is approached as far as they let it, first with the place, then with the turn. Codes written go
// nowhere; home beam and enabling switch answer as a device's would. A person's clutch, pedal and exchange switch and
// missed periods are passed on. Thread: the haptic task's; no call allocates, locks or throws.
#pragma once

#include <cmath>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/device_model.h"
#include "haptics/device/simulated_world.h"

namespace trocar {

/// Counts a hundred times as fine as the encoders': 0.002 mm at the tip.
std::array<Transmission, kChannels> pointer_transmissions();

class PointerDaq final : public DataAcquisition, public SimulatedWorld {
 public:
  static constexpr double kMostRate = 10;        ///< rad/s of a joint, so that no step is taken for a faulty encoder
  static constexpr double kMostPinchRate = 0.5;  ///< m/s of the jaws' slide

  explicit PointerDaq(double rate_hz);
  DaqCapabilities capabilities() const noexcept override;
  DaqSample read() noexcept override;
  void write(const DacFrame&) noexcept override {}
  void arm(bool enabled) noexcept override { armed_ = enabled; }

  void set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept override;
  void press_clutch(bool pressed) noexcept override { clutch_ = pressed; }
  void press_pedal(bool pressed) noexcept override { pedal_ = pressed; }
  void press_exchange(bool pressed) noexcept override { exchange_ = pressed; }
  void press_deadman(bool pressed) noexcept override { pressed_ = pressed; }
  void lead_arm(const JointVector&, double) noexcept override {}  // there is none
  HandSense sense() const noexcept override;
  void miss_sync() noexcept override { ++missed_; }
  double time_s() const noexcept override { return static_cast<double>(sync_) / rate_hz_; }

 private:
  JointVector wanted_angles() const noexcept;

  double rate_hz_;
  std::array<Transmission, kChannels> transmission_ = pointer_transmissions();
  ChannelVector home_, q_;
  Pose wanted_BS_;
  double jaw_m_;
  bool holding_ = false, pressed_ = true, clutch_ = false, pedal_ = false, exchange_ = false, armed_ = false;
  std::uint32_t missed_ = 0;
  std::uint64_t sync_ = 0;
};

}  // namespace trocar
