#include "app/studies/contact/hardware_study.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <limits>
#include <sstream>

#include "app/studies/contact/passivity_grid.h"
#include "app/studies/workspace/workspace_quality.h"
#include "haptics/control/gravity.h"
#include "haptics/control/motor_heat.h"
#include "haptics/control/peak_torque.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar {
namespace {

constexpr std::size_t kFewPresses = 3;
constexpr double kUnevenCounts = 0.1;               // of an edge
constexpr std::array kPeaks{1.0, 1.39, 2.0};        // of 100 mN m; 139 mN m are the amplifier's 6 A
constexpr double kHeatStep = 1e-3, kForEver = 600;  // s

struct Hardware {
  const char* name;
  bool edge_times = false;
  double uneven_counts = 0, peak = 1;
};

constexpr std::array kHardware{Hardware{"as it is"},
                               Hardware{"edge times", true},
                               Hardware{"edge times, uneven disc", true, kUnevenCounts},
                               Hardware{"139 mN m", false, 0, kPeaks[1]},
                               Hardware{"200 mN m", false, 0, kPeaks[2]},
                               Hardware{"edge times and 200 mN m", true, 0, kPeaks[2]}};

GridResult pressed_on(const Hardware& hardware, std::vector<DrawnPress> presses) {
  for (DrawnPress& press : presses) {
    press.wall.device.edge_times = hardware.edge_times;
    press.wall.device.plant->options.encoder.uneven_counts = hardware.uneven_counts;
    press.wall.peak = hardware.peak;
  }
  return run_grid(presses, {{PassivityLaw::kBudgeted}});
}

void add_hardware(StudyResult& study, const Hardware& hardware, const GridResult& result, const GridResult& base) {
  const LawTally &t = result.tally.front(), &as_is = base.tally.front();
  const double presses = static_cast<double>(result.cases.size());
  const auto held_n = [](const GridResult& r) {
    double sum = 0;
    for (const auto& of_case : r.outcome) sum += of_case.front().held_n;
    return sum / static_cast<double>(r.outcome.size());
  };
  const auto within = [](const GridResult& r) {
    return static_cast<double>(std::count_if(r.outcome.begin(), r.outcome.end(), [](const auto& of_case) {
      return !of_case.front().faulted && of_case.front().saturated <= kWithinMotors;
    }));
  };
  const auto add = [&](const char* what, const char* unit, double value, double before, const char* how) {
    study.cases.push_back({std::string(hardware.name) + ": " + what, unit, value, before, "reported", true,
                           std::string(how) + " Beside it the device as it is."});
  };
  add("stable", "1", t.stable / presses, as_is.stable / presses, "Share of the presses, beside the ideal wall.");
  add("force displayed where the motors can", "1", t.displayed, as_is.displayed,
      "Mean of rendered over commanded force at the end of the hold.");
  add("presses that the motors can give", "1", within(result) / presses, within(base) / presses,
      "Share of the presses in whose hold the motors are saturated for no more than half the time.");
  add("force held", "N", held_n(result), held_n(base), "Mean over all presses at the end of the hold.");
  add("least net energy", "mJ", 1e3 * t.least_net_j, 1e3 * as_is.least_net_j,
      "Lowest true energy that control, friction and cables had taken since touch.");
  add("most claimed beyond the truth", "mJ", 1e3 * t.overclaimed_j, 1e3 * as_is.overclaimed_j,
      "How far the account stood above the true energy.");
  add("step of the law", "N", t.law_step_n, as_is.law_step_n, "Most that the law moved the force in a tick.");
}

/// Force that motors of so much torque can give in every direction beside the weight, N.
double force_beside_weight(const DeviceModel& model, const JointVector& q, double motor_nm) {
  const ArmState arm = arm_state(q);
  return worst_direction_force(model, arm, gravity_torque(model, arm), motor_nm);
}

/// The same in the poses of the presses, ascending.
std::vector<double> forces_in_poses(const DeviceModel& model, const std::vector<DrawnPress>& presses, double motor_nm) {
  std::vector<double> force;
  for (const DrawnPress& press : presses) force.push_back(force_beside_weight(model, press.wall.pose, motor_nm));
  std::sort(force.begin(), force.end());
  return force;
}

/// Seconds at a motor torque until the winding reaches `until_c`, from one that has carried `before_nm` for long.
double borne_s(double motor_nm, double before_nm, double until_c) {
  const double kt = DeviceModel().transmission[0].torque_constant;
  MotorHeat heat;
  for (double t = 0; t < 6 * kForEver; t += 0.1) heat.update(before_nm / kt, 0.1);
  double t = 0;
  for (; t < kForEver && heat.winding_c() < until_c; t += kHeatStep) heat.update(motor_nm / kt, kHeatStep);
  return t < kForEver ? t : std::numeric_limits<double>::infinity();
}

/// What more torque gives at rest, and for how long.
void peak_table(StudyResult& study, const std::vector<DrawnPress>& presses) {
  const DeviceModel model;
  const double lasting = model.transmission[0].max_motor_torque;
  const PeakTorqueParameters peak;
  constexpr double kWeightNm = 0.020;  // at the motor: an easy pose held for long
  std::ostringstream table;
  table << "motor_mN_m,current_A,force_home_N,force_median_N,force_5_percent_N,cold_to_85_C_s,held_to_85_C_s,"
           "cold_to_110_C_s,held_to_110_C_s\n"
        << std::setprecision(4);
  const std::vector<double> before = forces_in_poses(model, presses, lasting);
  for (const double factor : kPeaks) {
    const double nm = factor * lasting, fade = MotorHeatParameters().fade_c;
    const std::vector<double> force = forces_in_poses(model, presses, nm);
    const double median = force[force.size() / 2], low = force[force.size() / 20];
    const double home = force_beside_weight(model, home_angles(), nm);
    const double cold_s = borne_s(nm, 0, peak.warm_c), held_s = borne_s(nm, kWeightNm, peak.warm_c);
    table << 1e3 * nm << ',' << nm / model.transmission[0].torque_constant << ',' << home << ',' << median << ',' << low
          << ',' << cold_s << ',' << held_s << ',' << borne_s(nm, 0, fade) << ',' << borne_s(nm, kWeightNm, fade)
          << '\n';
    if (factor == 1) continue;
    std::ostringstream name;
    name << "force in every direction at " << 1e3 * nm << " mN m";
    study.cases.push_back({name.str() + ", median pose", "N", median, before[force.size() / 2], "reported", true,
                           "Of the poses of the presses, beside the weight; beside it 100 mN m."});
    study.cases.push_back({name.str() + ", 5 % of the poses have less", "N", low, before[force.size() / 20], "reported",
                           true, "The same."});
    study.cases.push_back(
        {name.str() + ", borne by a motor that held 20 mN m", "s", held_s, borne_s(lasting, kWeightNm, peak.warm_c),
         "reported", true,
         "Until the winding is at 85 C, where the peak ends; heat model's values from memory; beside it "
         "100 mN m."});
  }
  study.files.push_back({"peak_torque.csv", table.str()});
}

}  // namespace

StudyResult hardware_study(const StudyRequest& request) {
  StudyResult study{"hardware", drawn_plant_words(request.seed, request.nominal), {}, {}};
  const std::vector<DrawnPress> presses =
      grid_cases(request.seed, request.quick ? kFewPresses : kGridPresses, request.nominal);
  peak_table(study, presses);
  const GridResult base = pressed_on(kHardware.front(), presses);
  add_hardware(study, kHardware.front(), base, base);
  for (std::size_t i = 1; i < kHardware.size(); ++i) {
    add_hardware(study, kHardware[i], pressed_on(kHardware[i], presses), base);
  }
  return study;
}

}  // namespace trocar
