// The patient's circulation, as far as a wound sees it: pressures that drive the blood out, and how they fall with it.
//
//   lost share  s = lost / blood volume
//   strength    1 up to s = 0.3 (ATLS classes I and II: systolic pressure normal), then linear to 0 at s = 0.5
//   pressure    p = outside + (p0 - outside) strength, arterial p0 = mean + pulse pressure * w(phase),
//               w = (sin x + sin 2x / 2) / 2.598: steep rise, slow run-off, mean 0, height 1
//   heart       75 a minute at rest, linear to 140 at s = 0.4: 100 at 0.15 and 124 at 0.3, as ATLS has them
// ATLS classes of blood loss as reprinted in Critical Care 2016;20:100, table 2.
// Pa above the atmosphere, s, m3. Thread: tissue task.
#pragma once

namespace trocar {

inline constexpr double kMmHg = 133.322;  ///< Pa

struct CirculationOptions {
  double mean_arterial_pa = 93 * kMmHg;     ///< 120 over 80 mmHg
  double pulse_pressure_pa = 40 * kMmHg;    ///< systolic less diastolic
  double portal_pa = 20 * kMmHg;            ///< 8 mmHg above the pneumoperitoneum, which raises it alike; unchecked
  double venous_pa = 16 * kMmHg;            ///< hepatic vein under pneumoperitoneum; unchecked
  double pneumoperitoneum_pa = 12 * kMmHg;  ///< outside of every vessel of the cavity
  double heart_hz = 1.25;
  double fastest_heart_hz = 2.33;    ///< class IV
  double fastest_heart_share = 0.4;  ///< of the blood lost at which it is reached
  double blood_m3 = 5e-3;            ///< of an adult of 70 kg
  double tolerated_share = 0.3;      ///< pressure unchanged until then
  double fatal_share = 0.5;          ///< no pressure left; unchecked
};

struct BloodPressures {
  double arterial_pa = 0, portal_pa = 0, venous_pa = 0, outside_pa = 0;
};

class Circulation {
 public:
  explicit Circulation(const CirculationOptions& options = {}) : options_(options) {}

  /// @param lost_m3 of all blood so far
  void step(double step_s, double lost_m3);
  void reset();

  BloodPressures pressures() const;  ///< in the middle of the step
  double mean_arterial_pa() const;
  double heart_hz() const;

 private:
  double strength() const;

  CirculationOptions options_;
  double lost_share_ = 0, phase_ = 0;  ///< of a beat, 0 .. 1
};

}  // namespace trocar
