#include "app/studies/device/motor_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/session/calibration/torque_rig.h"
#include "haptics/device/device_model.h"
#include "haptics/device/plant/plant_motor.h"

namespace trocar {
namespace {

constexpr double kStep = 50e-6, kLongest = 0.5;  // s
constexpr double kAtRest = 1.0;                  // rad/s2: slower changes count as steady, 0.1 % of a second's run
constexpr double kNominalV = 24;
constexpr double kRpm = 60 / (2 * std::numbers::pi);
constexpr double kWideOpen = 1e4;  // A/V: the supply alone limits the current

/// Joint 1 with nothing but `volts` between its leads.
PlantParameters at_leads(double volts) {
  PlantParameters p = nominal_parameters();
  p.bus_voltage = volts;
  p.current_limit = kWideOpen;
  p.channel[0].amplifier_gain = kWideOpen;
  return p;
}

MotorPoint settle(PlantMotor& motor, const ChannelParameters& c, double command, double speed) {
  double load = 0;
  for (int n = 0; n < 100; ++n) load = motor.advance(command, speed * c.ratio, kStep);
  return {speed, motor.current(), load * c.ratio};
}

bool near(double value, double wanted, double share) { return std::abs(value / wanted - 1) <= share; }

double quiet_nan() { return std::numeric_limits<double>::quiet_NaN(); }

void add_nominal(StudyResult& study, int points) {
  StudyCurves speed{"speed_torque_24v", "Speed against torque at 24 V (figure 3.27)", "torque, mN m", "speed, rpm", {},
                    {{"24 V", {}}}};
  StudyCurves current{
      "current_torque_24v", "Current against torque at 24 V (figure 3.28)", "torque, mN m", "current, A", {},
      {{"24 V", {}}}};
  const double stall = driven_motor_at_leads(kNominalV, 0).torque_nm;
  for (int k = 0; k <= points; ++k) {
    const MotorPoint at = loaded_motor(kNominalV, stall * k / points);
    speed.x.push_back(1e3 * at.torque_nm);
    current.x.push_back(1e3 * at.torque_nm);
    speed.series[0].y.push_back(at.speed_rad_s * kRpm);
    current.series[0].y.push_back(at.current_a);
  }
  const double none = loaded_motor(kNominalV, 0).speed_rad_s * kRpm;
  const MotorPoint hundred = loaded_motor(kNominalV, 0.100);
  const double rpm = hundred.speed_rad_s * kRpm;
  study.cases.push_back({"stall torque at 24 V", "mN m", 1e3 * stall, 240, "240 +-1 %", near(1e3 * stall, 240, 0.01),
                         "Shaft held, 24 V at the leads; thesis: table 3.4."});
  study.cases.push_back({"no-load speed at 24 V", "rpm", none, 9660, "9660 +-3 %", near(none, 9660, 0.03),
                         "Run up without load; the model's motor has no friction of its own (it lies at the joint)."});
  study.cases.push_back({"current at 100 mN m", "A", hundred.current_a, 4.5, "4.31 +-1 % (100 / 23.2)",
                         near(hundred.current_a, 0.1 / 0.0232, 0.01), "24 V, steady; thesis: read off figure 3.28."});
  study.cases.push_back({"speed at 100 mN m", "rpm", rpm, 5600, "5600 +-5 %", near(rpm, 5600, 0.05),
                         "24 V, steady; thesis: read off figure 3.27."});
  study.curves.push_back(speed);
  study.curves.push_back(current);
}

void add_low_voltages(StudyResult& study, int points) {
  StudyCurves speed{
      "speed_torque_1v_5v", "Speed against torque at 1 to 5 V (figure 3.29)", "torque, mN m", "speed, rpm", {}, {}};
  StudyCurves current{
      "current_torque_5v", "Current against torque up to 50 mN m (figure 3.30)", "torque, mN m", "current, A", {},
      {{"5 V", {}}}};
  for (int k = 0; k <= points; ++k) speed.x.push_back(50.0 * k / points);
  current.x = speed.x;
  double worst_torque = 0, worst_current = 0;
  for (int volts = 1; volts <= 5; ++volts) {
    speed.series.push_back({std::to_string(volts) + " V", {}});
    const MotorPoint stall = driven_motor_at_leads(volts, 0);
    worst_torque = std::max(worst_torque, std::abs(stall.torque_nm / (0.010 * volts) - 1));
    worst_current = std::max(worst_current, std::abs(stall.current_a / (0.43 * volts) - 1));
    for (const double mnm : speed.x) {
      const bool turns = mnm * 1e-3 <= stall.torque_nm * (1 + 1e-9);
      const MotorPoint at = loaded_motor(volts, mnm * 1e-3);
      speed.series.back().y.push_back(turns ? at.speed_rad_s * kRpm : quiet_nan());
      if (volts == 5) current.series[0].y.push_back(turns ? at.current_a : quiet_nan());
    }
  }
  const double none = loaded_motor(5, 0).speed_rad_s * kRpm;
  study.cases.push_back({"stall torques at 1 to 5 V off 10 to 50 mN m", "%", 100 * worst_torque, 0, "<= 1",
                         worst_torque <= 0.01,
                         "Largest of five, shaft held, voltage at the leads; thesis: figure 3.29."});
  study.cases.push_back({"stall currents at 1 to 5 V off 0.43 to 2.15 A", "%", 100 * worst_current, 0, "<= 1",
                         worst_current <= 0.01, "Largest of five; thesis: figure 3.30."});
  study.cases.push_back({"no-load speed at 5 V", "rpm", none, 2013, "2013 +-3 %", near(none, 2013, 0.03),
                         "Thesis: 9660 rpm scaled by 5/24."});
  study.curves.push_back(speed);
  study.curves.push_back(current);
}

/// Motor torque of joint 1 against the command, through DAC and amplifier, shaft held.
StudyCurves command_curve(int points) {
  StudyCurves curve{"torque_command",
                    "Torque against the command, through DAC and amplifier, shaft held",
                    "command, V",
                    "motor torque, mN m",
                    {},
                    {{"joint 1", {}}}};
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  TorqueRig rig(device, perfect_cell(), 1);
  const double full = std::ldexp(1.0, device.dac_bits - 1) - 1;
  for (int k = -points; k <= points; ++k) {
    DacFrame codes;
    codes.codes.fill(static_cast<std::int32_t>(std::lround(full * k / points)));
    curve.x.push_back(10 * codes.codes[0] / full);
    curve.series[0].y.push_back(1e3 * rig.burst(codes, codes)[0]);
  }
  return curve;
}

void add_command(StudyResult& study, int points) {
  const StudyCurves curve = command_curve(points / 4);
  const auto& y = curve.series[0].y;
  const double slope = (y.back() - y.front()) / (curve.x.back() - curve.x.front());
  double bent = 0;
  for (std::size_t k = 0; k < y.size(); ++k) bent = std::max(bent, std::abs(y[k] - slope * curve.x[k]));
  study.cases.push_back({"torque of a volt of command, shaft held", "mN m/V", slope, 10, "10 +-1 %",
                         near(slope, 10, 0.01), "-10 to 10 V through the DAC of the simulated device, in its jig."});
  study.cases.push_back(
      {"departure from a straight line", "mN m", bent, {}, "<= 0.01", bent <= 0.01, "The same sweep."});

  StudyCurves moving{"torque_speed_command",
                     "5 V: as a command to the amplifier, and at the motor's leads",
                     "speed, rpm",
                     "motor torque, mN m",
                     {},
                     {{"command 5 V", {}}, {"5 V at the leads", {}}}};
  double headroom = 0;
  for (int k = 0; k <= 10 * points; ++k) {
    const double rpm = 10000.0 * k / (10 * points), speed = rpm / kRpm;
    const double commanded = driven_motor(5, speed).torque_nm, at_the_leads = driven_motor_at_leads(5, speed).torque_nm;
    moving.x.push_back(rpm);
    moving.series[0].y.push_back(1e3 * commanded);
    moving.series[1].y.push_back(at_the_leads > 0 ? 1e3 * at_the_leads : quiet_nan());
    if (commanded > 0.99 * driven_motor(5, 0).torque_nm) headroom = rpm;
  }
  const double kept = driven_motor(5, 1500 / kRpm).torque_nm / driven_motor(5, 0).torque_nm;
  const double lost = driven_motor_at_leads(5, 1500 / kRpm).torque_nm / driven_motor_at_leads(5, 0).torque_nm;
  study.cases.push_back(
      {"share of the torque left at 1500 rpm, 5 V", "1", kept, lost, "1 +-0.1 %", near(kept, 1, 1e-3),
       "The command sets the current; thesis: the same 5 V at the leads, as section 3.4.2 takes it."});
  study.cases.push_back({"speed up to which a 5 V command is followed", "rpm", headroom, 2013, ">= 7000",
                         headroom >= 7000, "Until the 24 V supply leaves less than 99 % of the torque."});
  study.curves.push_back(curve);
  study.curves.push_back(moving);
}

}  // namespace

MotorPoint loaded_motor(double terminal_v, double load_nm) {
  const PlantParameters p = at_leads(terminal_v);
  const ChannelParameters& c = p.channel[0];
  PlantMotor motor(c, p);
  double speed = 0, acceleration = 2 * kAtRest, torque = 0;
  for (double t = 0; t < kLongest && std::abs(acceleration) > kAtRest; t += kStep) {
    torque = motor.advance(1, speed * c.ratio, kStep) * c.ratio;
    acceleration = (torque - load_nm) / c.rotor_inertia;
    if (speed <= 0 && torque <= load_nm && t > 20 * p.amplifier_time_constant) break;  // it stands
    speed = std::max(0.0, speed + kStep * acceleration);
  }
  return {speed, motor.current(), torque};
}

MotorPoint driven_motor(double command_v, double speed_rad_s) {
  const PlantParameters p = nominal_parameters();
  PlantMotor motor(p.channel[0], p);
  return settle(motor, p.channel[0], command_v, speed_rad_s);
}

MotorPoint driven_motor_at_leads(double terminal_v, double speed_rad_s) {
  const PlantParameters p = at_leads(terminal_v);
  PlantMotor motor(p.channel[0], p);
  return settle(motor, p.channel[0], 1, speed_rad_s);
}

StudyResult motor_study(const StudyRequest& request) {
  StudyResult study{"motor", "the simulated plant's motor, amplifier and DAC", {}, {}, {}};
  const int points = request.quick ? 20 : 80;
  add_nominal(study, points);
  add_low_voltages(study, points);
  add_command(study, points);
  return study;
}

}  // namespace trocar
