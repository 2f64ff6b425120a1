#include "app/studies/contact/passivity_grid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <iomanip>
#include <random>
#include <sstream>
#include <thread>

#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

constexpr std::array kGridStiffness{150.0, 300.0, 750.0, 1500.0, 3000.0};  // N/m
constexpr std::array kExtraDelay{0, 2, 4, 6, 9};                           // periods beyond the seam's one
constexpr std::array kGridGrips{GripPreset::kFingertip, GripPreset::kLight, GripPreset::kNormal, GripPreset::kFirm};
constexpr std::array<const char*, 4> kGridGripNames{"fingertip", "light", "normal", "firm"};
constexpr std::array kGridSpeeds{0.1, 0.2, 0.45, 0.9};  // m/s
/// Degrees; spread over what table 2.4 and det A >= 0.35 leave.
constexpr double kPoses[5][6] = {{45, 45, 45, -60, -75, 0},
                                 {40, 50, 45, -75, -85, 20},
                                 {50, 40, 45, -50, -60, -30},
                                 {45, 40, 50, -70, -70, 40},
                                 {42, 47, 43, -85, -90, 0}};
constexpr double kLongestWay = 0.105, kShortWay = 0.060;  // m that a press may need, fast and slow
constexpr double kGridAfterTouch = 1.6;                   // s

}  // namespace

void draw_press(WallCase& c, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  do {
    const double* pose = kPoses[below(5)];
    for (int i = 0; i < kArmJoints; ++i) c.pose[i] = pose[i] * kDegree;
    const Mat3 R_WS = arm_state(c.pose).X_WS.R;
    const int axis = 1 + static_cast<int>(below(2));  // Y6 or Z6, as the thesis' walls
    c.direction = (below(2) == 0 ? 1.0 : -1.0) * R_WS.col(axis);
    c.speed = kGridSpeeds[below(kGridSpeeds.size())];
  } while (!comfortable(c.pose, c.direction, c.speed > 0.5 ? kLongestWay : kShortWay));
}

namespace {

std::vector<WallOutcome> press_with_all(const WallCase& c, const std::vector<GridLaw>& laws) {
  const WallRig rig(c);
  std::vector<WallOutcome> outcomes;
  for (const GridLaw& law : laws) {
    outcomes.push_back(rig.press({law.law, law.clamp}, kGridAfterTouch));
    outcomes.back().trace = {};
  }
  return outcomes;
}

LawTally add_up_grid(const GridResult& result, std::size_t law) {
  LawTally tally{result.laws[law]};
  int counted = 0;
  for (const std::vector<WallOutcome>& row : result.outcome) {
    const WallOutcome& o = row[law];
    tally.stable += o.stable();
    tally.least_true_j = std::min(tally.least_true_j, o.least_true_j);
    tally.observer_gap_j = std::max(tally.observer_gap_j, o.observer_gap_j);
    tally.largest_step_n = std::max(tally.largest_step_n, o.largest_step_n);
    if (!row.front().stable()) continue;  // laws.front() is off
    tally.displayed += o.displayed;
    ++counted;
  }
  if (counted > 0) tally.displayed /= counted;
  return tally;
}

}  // namespace

std::vector<WallCase> grid_cases(std::uint64_t seed, int every) {
  std::mt19937_64 random(seed);
  std::vector<WallCase> kept;
  int number = 0;
  for (const double stiffness : kGridStiffness) {
    for (const int delay : kExtraDelay) {
      for (const GripPreset grip : kGridGrips) {
        WallCase c;
        c.stiffness = stiffness;
        c.extra_delay = delay;
        c.grip = grip;
        draw_press(c, random);
        if (number++ % every == 0) kept.push_back(c);
      }
    }
  }
  return kept;
}

std::vector<GridLaw> grid_laws() {
  std::vector<GridLaw> laws;
  for (const bool clamp : {false, true}) {
    for (const PassivityLawName& known : kPassivityLaws) laws.push_back({known.law, clamp});
  }
  return laws;
}

void on_all_processors(std::size_t count, const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failed(count);
  const auto work = [&] {
    for (std::size_t i; (i = next++) < count;) {
      try {
        task(i);
      } catch (...) {
        failed[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned n = std::max(1u, std::thread::hardware_concurrency()); n > 0; --n) workers.emplace_back(work);
  }
  for (const std::exception_ptr& failure : failed) {
    if (failure) std::rethrow_exception(failure);
  }
}

GridResult run_grid(const std::vector<WallCase>& cases, const std::vector<GridLaw>& laws) {
  GridResult result{cases, laws, {}, {}};
  result.outcome.assign(cases.size(), std::vector<WallOutcome>(laws.size()));
  on_all_processors(cases.size(), [&](std::size_t i) { result.outcome[i] = press_with_all(cases[i], laws); });
  for (std::size_t law = 0; law < laws.size(); ++law) result.tally.push_back(add_up_grid(result, law));
  return result;
}

std::string grid_csv(const GridResult& result) {
  std::ostringstream out;
  out << "stiffness_N_m,delay_ms,grip,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,direction_x,direction_y,direction_z,"
         "speed_m_s,law,stable,settled_s,contacts,late_contacts,displayed,least_true_energy_mJ,observer_gap_mJ,"
         "largest_step_N,passive_share,k_max_N_m,faulted\n"
      << std::setprecision(6);
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const WallCase& c = result.cases[i];
    for (std::size_t law = 0; law < result.laws.size(); ++law) {
      const WallOutcome& o = result.outcome[i][law];
      out << c.stiffness << ',' << 1 + c.extra_delay << ',' << kGridGripNames[static_cast<std::size_t>(c.grip)];
      for (int j = 0; j < kArmJoints; ++j) out << ',' << c.pose[j] / kDegree;
      for (int j = 0; j < 3; ++j) out << ',' << c.direction[j];
      out << ',' << o.touched_at_m_s << ',' << result.laws[law].name() << ',' << o.stable() << ',' << o.settled_s << ','
          << o.contacts << ',' << o.late_contacts << ',' << o.displayed << ',' << o.least_true_j * 1e3 << ','
          << o.observer_gap_j * 1e3 << ',' << o.largest_step_n << ',' << o.passive_share << ',' << o.k_max << ','
          << o.faulted << '\n';
    }
  }
  return out.str();
}

std::string law_table(const GridResult& result) {
  std::ostringstream out;
  out << std::fixed << "| law | stable of " << result.cases.size()
      << " | force displayed where off is stable | least true contact energy, mJ | observer error, mJ | largest step, "
         "N |\n"
         "|---|---|---|---|---|---|\n";
  for (const LawTally& t : result.tally) {
    out << "| " << t.law.name() << " | " << t.stable << " | " << std::setprecision(2) << t.displayed << " | "
        << std::setprecision(1) << t.least_true_j * 1e3 << " | " << std::setprecision(2) << t.observer_gap_j * 1e3
        << " | " << t.largest_step_n << " |\n";
  }
  return out.str();
}

}  // namespace trocar
