// Bench rig for calibrating the amplifiers: the device rests in its jig, a torque cell holds the shaft of every motor.
//
// The rig drives the device through the seam alone (codes out, amplifiers armed or inhibited) and reads its cells. A
// burst ends before the jig would open (kJigReleaseS). The cells are simulated as such cells are: white noise, a zero
// of their own, an error of scale, and the stiction of the brushes, which hides part of the torque from a shaft that
// stands still (stop operator: it opposes the last change). All values are of the rig, none of the device. Torques in N
// m at the motor shaft. Thread: one owner.
#pragma once

#include <cstdint>

#include "haptics/device/plant/plant_random.h"
#include "haptics/device/simulated_daq.h"

namespace trocar {

struct TorqueCellConfig {
  double noise_nm = 0.3e-3;      ///< SD of one sample [assumed: a Nano25 resolves 0.1 mN m]
  double zero_nm = 2e-3;         ///< largest zero [assumed]
  double scale_sd = 1e-3;        ///< SD of the cell's own calibration [assumed]
  double stiction_nm = 0.86e-3;  ///< of the brushes: 37 mA no-load current [thesis table 3.4]
};

/// A rig whose cells are perfect: for studies that measure the device and not the rig.
inline TorqueCellConfig perfect_cell() { return {0, 0, 0, 0}; }

class TorqueRig {
 public:
  struct Zero {
    ChannelVector mean, sd;  ///< N m, and the standard deviation of that mean
  };
  TorqueRig(const SimulatedDaqConfig& device, const TorqueCellConfig& cell, std::uint64_t seed);

  DaqCapabilities capabilities() const { return daq_.capabilities(); }
  const TorqueCellConfig& cell() const { return cell_; }

  /// Amplifiers on for 40 ms: `first`, then `held`; mean of the cells over the last 25 ms. The amplifiers are off
  /// afterwards.
  ChannelVector burst(const DacFrame& first, const DacFrame& held);
  /// The cells' zero: amplifiers inhibited, shafts turned free by hand so that the brushes hold nothing, 2 s.
  Zero rest();

 private:
  ChannelVector sample();  // one period later

  SimulatedDaq daq_;
  TorqueCellConfig cell_;
  PlantRandom random_;
  ChannelVector scale_, zero_;
  ChannelVector hidden_ = ChannelVector::Zero(),
                last_ = ChannelVector::Zero();  ///< held by the brushes, motor torque before
};

}  // namespace trocar
