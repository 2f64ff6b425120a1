#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/studies/tissue/soft_bench.h"
#include "app/studies/tissue/soft_studies.h"

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

}  // namespace

StudyResult multirate_study(const StudyRequest& request) {
  StudyResult study{
      "multirate", "none: a hand's mass on the contact, counts of 0.03 mm, patches seen 5 ms late", {}, {}};
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
  return study;
}

}  // namespace trocar
