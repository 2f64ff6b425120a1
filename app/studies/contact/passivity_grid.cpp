#include "app/studies/contact/passivity_grid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <iomanip>
#include <sstream>
#include <thread>

namespace trocar {
namespace {

constexpr double kGridAfterTouch = 1.6;  // s

/// The case's outcomes in `result`.
void press_with_all(std::size_t i, GridResult& result) {
  const WallRig rig(result.cases[i].wall);
  for (std::size_t law = 0; law < result.laws.size(); ++law) {
    const GridLaw& how = result.laws[law];
    result.outcome[i][law] = rig.press({how.law, how.clamp, {}, 0, how.instead}, kGridAfterTouch);
    result.outcome[i][law].trace = {};
  }
  result.ideal[i] = rig.press_ideal(kGridAfterTouch);
  result.ideal[i].trace = {};
}

LawTally add_up_grid(const GridResult& result, std::size_t law) {
  LawTally tally{result.laws[law]};
  int within_motors = 0;
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const WallOutcome &o = result.outcome[i][law], &ideal = result.ideal[i];
    tally.stable += stable_beside(o, ideal);
    tally.stable_alone += o.stable();
    tally.overclaimed_j = std::max(tally.overclaimed_j, o.overclaimed_j);
    tally.least_net_j = std::min(tally.least_net_j, o.least_net_j);
    tally.law_step_n = std::max(tally.law_step_n, o.law_step_n);
    tally.displayed_all += o.displayed / static_cast<double>(result.outcome.size());
    if (o.saturated > kWithinMotors) continue;
    tally.displayed += o.displayed;
    tally.held += ideal.held_n > 0 ? std::min(1.0, o.held_n / ideal.held_n) : 1;
    ++within_motors;
  }
  if (within_motors > 0) tally.displayed /= within_motors, tally.held /= within_motors;
  return tally;
}

}  // namespace

std::vector<DrawnPress> grid_cases(std::uint64_t seed, std::size_t count, bool nominal) {
  PressDraw draw{{150, 300, 750, 1500, 3000}, {0, 2, 4, 6, 9}};
  draw.nominal = nominal;
  return drawn_presses(seed, count, draw);
}

double wilson_low(int hits, int of) {
  if (of <= 0) return 0;
  constexpr double z = 1.96;
  const double n = of, p = hits / n, middle = p + z * z / (2 * n);
  return std::max(0.0, (middle - z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n))) / (1 + z * z / n));
}

std::string GridLaw::name() const {
  return std::string(instead ? comparison_law_name(*instead) : passivity_law_name(law)) + (clamp ? " + clamp" : "");
}

std::vector<GridLaw> grid_laws() {
  std::vector<GridLaw> laws;
  for (const PassivityLawName& known : kPassivityLaws) laws.push_back({known.law});
  for (const ComparisonLaw law : kComparisonLaws) laws.push_back({PassivityLaw::kOff, false, law});
  laws.push_back({PassivityLaw::kBudgeted, true});
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

GridResult run_grid(const std::vector<DrawnPress>& cases, const std::vector<GridLaw>& laws) {
  GridResult result{cases, laws, {}, {}, {}};
  result.outcome.assign(cases.size(), std::vector<WallOutcome>(laws.size()));
  result.ideal.resize(cases.size());
  on_all_processors(cases.size(), [&](std::size_t i) { press_with_all(i, result); });
  for (std::size_t law = 0; law < laws.size(); ++law) result.tally.push_back(add_up_grid(result, law));
  return result;
}

std::string grid_csv(const GridResult& result) {
  std::ostringstream out;
  out << "stiffness_N_m,delay_ms,jitter_ms,grip,grip_stiffness_N_m,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,"
         "direction_x,direction_y,direction_z,speed_m_s,law,stable,settled_s,settled_ideal_s,contacts,late_contacts,"
         "displayed,held_N,held_ideal_N,"
         "saturated,least_true_energy_mJ,least_net_energy_mJ,overclaimed_mJ,law_step_N,largest_step_N,above_30_Hz_N,"
         "passive_share,k_max_N_m,faulted\n"
      << std::setprecision(6);
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const WallCase& c = result.cases[i].wall;
    for (std::size_t law = 0; law < result.laws.size(); ++law) {
      const WallOutcome& o = result.outcome[i][law];
      out << c.stiffness << ',' << 1 + c.device.extra_delay_periods << ',' << c.device.plant->options.jitter_periods
          << ',' << grip_name(result.cases[i].grip) << ',' << c.device.hand.grip_stiffness;
      for (int j = 0; j < kArmJoints; ++j) out << ',' << c.pose[j] / kDegree;
      for (int j = 0; j < 3; ++j) out << ',' << c.direction[j];
      out << ',' << o.touched_at_m_s << ',' << result.laws[law].name() << ',' << stable_beside(o, result.ideal[i])
          << ',' << o.settled_s << ',' << result.ideal[i].settled_s << ',' << o.contacts << ',' << o.late_contacts
          << ',' << o.displayed << ',' << o.held_n << ',' << result.ideal[i].held_n << ',' << o.saturated << ','
          << o.least_true_j * 1e3 << ',' << o.least_net_j * 1e3 << ',' << o.overclaimed_j * 1e3 << ',' << o.law_step_n
          << ',' << o.largest_step_n << ',' << o.shaking_n << ',' << o.passive_share << ',' << o.k_max << ','
          << o.faulted << '\n';
    }
  }
  return out.str();
}

std::string law_table(const GridResult& result) {
  std::ostringstream out;
  out << std::fixed << "| law | stable of " << result.cases.size()
      << " | ... within 0.5 s | force held of the ideal wall's | force displayed where the motors can | ... of what "
         "the motors can, all presses | least net energy, mJ | "
         "most claimed beyond the truth, mJ | step of the law in a tick, N |\n"
         "|---|---|---|---|---|---|---|---|---|\n";
  for (const LawTally& t : result.tally) {
    out << "| " << t.law.name() << " | " << t.stable << " | " << t.stable_alone << " | " << std::setprecision(2)
        << t.held << " | " << t.displayed << " | " << t.displayed_all << " | " << std::setprecision(1)
        << t.least_net_j * 1e3 << " | " << std::setprecision(2) << t.overclaimed_j * 1e3 << " | " << t.law_step_n
        << " |\n";
  }
  return out.str();
}

}  // namespace trocar
