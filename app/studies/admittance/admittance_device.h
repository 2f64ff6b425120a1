// A simulated admittance device of one axis: a handle with a force sensor on a slide whose drive holds a wanted
// velocity.
//
//   slide     M dv = hand + drive - c v - fc tanh(v / v0)
//   drive     PI on the velocity, F = M w (v_wanted - v) + M w^2 / 4 sum(v_wanted - v) dt, w = 2 pi bandwidth; limited
//   encoder   whole counts; sensor: first-order lag, noise, whole steps
//   hand      handle -[k_g, b_g]- M_h -[K_h, B_h]- intent: the translation of HandModel on one axis
// Every value of the device is an assumption, chosen as a small force-controlled slide would have it: the thesis' own
// device is of the impedance kind. Integrated at 50 us, semi-implicitly. The controller sees counts, force and nothing
// else. N, m, s; positive towards the wall. Thread: one owner.
#pragma once

#include <cstdint>

#include "haptics/device/plant/hand_model.h"
#include "haptics/device/plant/plant_random.h"

namespace trocar {

struct AdmittanceDeviceParameters {
  double slide_kg = 2.0;
  double servo_hz = 30;  ///< bandwidth of the velocity loop: lag 1 / (2 pi bandwidth)
  double drive_limit_n = 60;
  double viscous_n_s_per_m = 2;
  double coulomb_n = 0.5;  ///< behind the drive: the hand does not feel it
  double count_m = 10e-6;  ///< linear encoder
  double sensor_lag_s = 1.5e-3;
  double sensor_noise_n = 0.02;  ///< standard deviation of a sample
  double sensor_step_n = 0.01;
};

class AdmittanceDevice {
 public:
  AdmittanceDevice(const AdmittanceDeviceParameters& parameters, const HandParameters& hand, std::uint64_t seed)
      : p_(parameters), hand_(hand), noise_(seed) {}

  /// One sub-step. @param wanted_m_s of the drive; @param intent_m where the hand wants to be.
  void step(double wanted_m_s, double intent_m, double dt);

  double encoder_m() const;
  /// A sample of the force sensor: draws noise.
  double measured_n();

  double position_m() const { return x_; }
  double speed_m_s() const { return v_; }
  double force_n() const { return force_; }    ///< of the hand on the handle
  double given_j() const { return given_j_; }  ///< true energy that the hand has given

 private:
  AdmittanceDeviceParameters p_;
  HandParameters hand_;
  PlantRandom noise_;
  double x_ = 0, v_ = 0, lost_way_ = 0;  ///< slide; sum of what the drive missed
  double hand_x_ = 0, hand_v_ = 0;       ///< M_h
  double force_ = 0, sensed_ = 0, given_j_ = 0;
};

}  // namespace trocar
