#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "app/studies/tissue/drawn_contacts.h"
#include "app/studies/tissue/soft_bench.h"
#include "app/studies/tissue/soft_studies.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

struct Bridge {
  RateBridge bridge;
  const char* name;
};
constexpr std::array kBridges{Bridge{RateBridge::kGliding, "ours"}, Bridge{RateBridge::kHeld, "held force"},
                              Bridge{RateBridge::kSpring, "linear coupling"},
                              Bridge{RateBridge::kThesis, "thesis' law"}};
constexpr double kPressDepth = 0.018;  // m that the hand goes in, beyond what the spring of the hand gives back

SoftBenchSetup setup_of(double young_pa, double step_s, RateBridge bridge) {
  SoftBenchSetup setup;
  setup.material.young_pa = young_pa;
  setup.organ.solid.step_s = step_s;
  setup.bridge = bridge;
  return setup;
}

std::string named(const char* measure, double young_pa, double step_s, const SoftHand& hand) {
  return std::string(measure) + ", " + std::to_string(std::lround(young_pa / 1000)) + " kPa, step " +
         std::to_string(std::lround(step_s * 1e3)) + " ms, " + hand.name + " grip";
}

/// Most that the force turns in a tick while the tip is drawn over the organ and back by 40 mm.
double most_turn(int rows, double speed_m_s, double depth_m) {
  SoftBenchSetup setup;
  setup.rows = rows;
  SoftBench bench(setup);
  constexpr double kWay = 0.020, kPress = 0.3;  // m to either side; s
  const double rate = speed_m_s / kWay;         // of x = -kWay cos(rate t): it turns round without a blow
  Vec3 last = Vec3::Zero();
  double most = 0;
  for (int tick = 0; 1e-3 * tick < kPress + 2 * std::numbers::pi / rate; ++tick) {
    const double t = std::max(0.0, 1e-3 * tick - kPress), down = std::min(1.0, 1e-3 * tick / kPress);
    const Vec3 tip = bench.touching(-kWay * std::cos(rate * t), 0.007) + Vec3(0, 0, 0.001 - (depth_m + 0.001) * down);
    const Vec3 force = bench.tick(tip, {kWay * rate * std::sin(rate * t), 0, 0});
    constexpr double kFelt = 0.01;  // N from which on a direction is felt
    if (force.norm() > kFelt && last.norm() > kFelt)
      most = std::max(most, std::atan2(force.cross(last).norm(), force.dot(last)));
    last = force;
  }
  return most;
}

void add_sweeps(const StudyRequest& request, StudyResult& study) {
  for (const double speed : {0.010, 0.050})
    for (const double depth : {0.003, 0.009}) {
      if (request.quick && speed < 0.020) continue;
      char name[80];
      std::snprintf(name, sizeof name, "turn of the force, %.0f mm deep, %.0f mm/s", depth * 1e3, speed * 1e3);
      const double turn = most_turn(request.quick ? 30 : 60, speed, depth) / kDegree;
      study.cases.push_back(
          {name,
           "deg/ms",
           turn,
           {},
           "< 2",
           turn < 2,
           "Most that it turns in a tick, tip to and fro over 40 mm of the organ at up to that speed."});
    }
}

/// Drawn arms with an ideal encoder, and with one of 0.03 mm a count.
void add_arms(const StudyRequest& request, bool stiff, std::size_t arms, std::string& table, StudyResult& study) {
  constexpr std::array kGripNames{"fingertip", "light", "normal", "firm"};
  DrawnContactMeasures worst;
  double counted_j = 0;
  for (std::size_t n = 0; n < arms; ++n) {
    const DrawnContact draw = drawn_contact(request.seed, n, stiff);
    DrawnContactOptions options;
    if (request.quick) options = {40, 0.0125};
    const DrawnContactMeasures ideal = run_drawn_contact(draw, options);
    options.encoder_m = 3e-5;
    const double counted = run_drawn_contact(draw, options).energy_out_j;
    counted_j = std::max(counted_j, counted);
    worst.energy_out_j = std::max(worst.energy_out_j, ideal.energy_out_j);
    worst.stall_growth_n = std::max(worst.stall_growth_n, ideal.stall_growth_n);
    worst.most_step_n = std::max(worst.most_step_n, ideal.most_step_n);
    worst.finite = worst.finite && ideal.finite;
    int stalled = 0;
    for (const auto& stall : draw.stall) stalled += stall.second;
    char row[400];
    std::snprintf(
        row, sizeof row,
        "| %zu | %s | %.2f | %.1f | %.2f | %.0f | %d | %.2f | %.2f | %.2f | %.0f | %.2f | %.4f | %.4f | %.2f | "
        "%.3f |\n",
        n, kGripNames[static_cast<std::size_t>(draw.grip)], draw.mass_kg, draw.young_pa / 1e3, draw.mu_static,
        draw.tilt_rad / kDegree, stalled, draw.loss, ideal.most_n, ideal.slipping, ideal.turned_rad / kDegree,
        ideal.put_in_j * 1e3, ideal.energy_out_j * 1e3, counted * 1e3, ideal.stall_growth_n * 1e3, ideal.most_step_n);
    table += row;
  }
  const std::string of = stiff ? "drawn arms, tissue of 20 to 50 kPa: " : "drawn arms, tissue of 2 to 20 kPa: ";
  const auto add = [&](const char* name, const char* unit, double value, double most, const char* bar,
                       const char* definition) {
    study.cases.push_back({of + name, unit, value, {}, bar, worst.finite && value < most, definition});
  };
  add("energy out", "mJ", worst.energy_out_j * 1e3, 0.05, "< 0.05",
      "Most over the arms that the hand has got back beyond what it had put in; six degrees of freedom, friction, "
      "patches 2 to 9 ms late, up to 30 % of them lost, stalls of 10 to 100 ms.");
  add("energy out, counts of 0.03 mm", "mJ", counted_j * 1e3, 0.05, "< 0.05", "The same arms.");
  add("growth in a stall", "mN", worst.stall_growth_n * 1e3, 1, "< 1",
      "Most that the force grew, from 20 ms into a stall on, beyond stiffness times the tool's way since.");
  add("largest step", "N/ms", worst.most_step_n, 0.3, "< 0.3", "Over the whole of every arm.");
}

}  // namespace

StudyResult multirate_study(const StudyRequest& request) {
  StudyResult study{"multirate",
                    "none: hands on the contact, counts of 0.03 mm, patches seen 5 ms late; drawn arms (seed " +
                        std::to_string(request.seed) + ")",
                    {},
                    {}};
  std::string table =
      "| tissue | step, ms | grip | law | hold, N | solid, N | ripple, N | largest step, N/ms | energy out, mJ |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const double young : {5000.0, 50000.0})
    for (const double step : {0.010, 0.020}) {
      if (request.quick && step > 0.010) continue;
      for (const SoftHand& hand : {kFirmHand, kLightHand})
        for (const Bridge& bridge : kBridges) {
          const PressMeasures m = press(setup_of(young, step, bridge.bridge), hand, kPressDepth);
          char row[300];
          std::snprintf(row, sizeof row, "| %.0f kPa | %.0f | %s | %s | %.3f | %.3f | %.4f | %.4f | %.3f |\n",
                        young / 1e3, step * 1e3, hand.name, bridge.name, m.hold_n, m.tissue_n, m.ripple_n,
                        m.most_step_n, m.energy_out_j * 1e3);
          table += row;
          if (bridge.bridge != RateBridge::kGliding) continue;
          const auto add = [&](const char* name, const char* unit, double value, double most, const char* bar,
                               const char* definition) {
            study.cases.push_back({named(name, young, step, hand), unit, value, {}, bar, value < most, definition});
          };
          add("energy out", "mJ", m.energy_out_j * 1e3, 0.05, "< 0.05",
              "Most that the hand has got back beyond what it had put in.");
          add("steady error", "share", std::abs(m.hold_n - m.tissue_n) / m.tissue_n, 0.03, "< 0.03",
              "Felt force against the solid's own, in the hold.");
          add("ripple", "N", m.ripple_n, 0.05, "< 0.05", "Furthest from its mean in the last second of the hold.");
          const double scale = std::max(1.0, m.hold_n);
          add("largest step", "N/ms per N above 1 N", m.most_step_n / scale, 0.03, "< 0.03",
              "Over the press, the hold and 2 Hz, per newton of the hold where that is more than one.");
        }
    }
  study.files.push_back({"laws.md", table});
  add_sweeps(request, study);
  std::string arms =
      "| arm | grip | device, kg | tissue, kPa | mu | tilt, deg | stalls, ms | lost | most, N | slipping | turned, deg "
      "| "
      "put in, mJ | energy out, mJ | with counts, mJ | grown in a stall, mN | largest step, N/ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  add_arms(request, false, request.quick ? 4 : 40, arms, study);
  if (!request.quick) add_arms(request, true, 12, arms, study);
  study.files.push_back({"arms.md", arms});
  return study;
}

}  // namespace trocar
