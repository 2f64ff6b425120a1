#include "app/studies/contact/sensitivity_study.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include "app/studies/contact/passivity_grid.h"

namespace trocar {
namespace {

constexpr std::size_t kPresses = 100, kQuickPresses = 3;
constexpr double kLeastStable = 0.95, kLeastNet = -1e-3;  // share, J
constexpr double kLess = 0.5, kMore = 1.5;

/// A property of plant or hand, and how it is scaled.
struct Property {
  const char* name;
  void (*scale)(SimulatedDaqConfig&, double);
};

template <auto Scaled>
void each_channel(SimulatedDaqConfig& device, double by) {
  for (ChannelParameters& channel : device.plant->channel) Scaled(channel) *= by;
}

const std::array kProperties{
    Property{"Coulomb friction", each_channel<[](ChannelParameters& c) -> double& { return c.friction.coulomb; }>},
    Property{"viscous friction", each_channel<[](ChannelParameters& c) -> double& { return c.friction.viscous; }>},
    Property{"presliding way", each_channel<[](ChannelParameters& c) -> double& { return c.friction.bristle_length; }>},
    Property{"presliding damping",
             each_channel<[](ChannelParameters& c) -> double& { return c.friction.damping_inertia; }>},
    Property{"rotor inertia", each_channel<[](ChannelParameters& c) -> double& { return c.rotor_inertia; }>},
    Property{"inertia of platform and legs",
             [](SimulatedDaqConfig& device, double by) { device.plant->platform_inertia *= by; }},
    Property{"damping of the hand",
             [](SimulatedDaqConfig& device, double by) {
               device.hand.grip_damping *= by;
               device.hand.arm_damping *= by;
             }},
};

GridResult pressed(std::vector<DrawnPress> presses, const Property* property, double by) {
  for (DrawnPress& press : presses) {
    if (property)
      property->scale(press.wall.device, by);
    else
      press.wall.device.substep_s *= by;
  }
  return run_grid(presses, {{PassivityLaw::kBudgeted}});
}

bool stands(const GridResult& result, std::size_t i) { return stable_beside(result.outcome[i][0], result.ideal[i]); }

std::size_t changed(const GridResult& result, const GridResult& base) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < base.cases.size(); ++i) count += stands(result, i) != stands(base, i);
  return count;
}

/// "750 N/m: 2, 1500 N/m: 1": unstable presses by stiffness.
std::string where_unstable(const GridResult& result) {
  std::map<double, int> by;
  for (std::size_t i = 0; i < result.cases.size(); ++i) by[result.cases[i].wall.stiffness] += !stands(result, i);
  std::ostringstream out;
  for (const auto& [stiffness, count] : by) {
    if (count > 0) out << (out.str().empty() ? "" : ", ") << stiffness << " N/m: " << count;
  }
  return out.str().empty() ? "none" : out.str();
}

void add_variant(StudyResult& study, const std::string& name, const GridResult& result, const GridResult& base) {
  const LawTally& tally = result.tally.front();
  const double share = tally.stable / static_cast<double>(result.cases.size());
  const double as_drawn = base.tally.front().stable / static_cast<double>(base.cases.size());
  study.cases.push_back({name + ": stable", "1", share, as_drawn, ">= 0.95", share >= kLeastStable,
                         "Share of the presses; beside it that of the arms as drawn. Unstable by stiffness: " +
                             where_unstable(result) + "."});
  study.cases.push_back({name + ": least net energy", "mJ", 1e3 * tally.least_net_j,
                         1e3 * base.tally.front().least_net_j, ">= -1", tally.least_net_j >= kLeastNet,
                         "Lowest true energy that the control, friction and cables had taken since touch, of all "
                         "presses; beside it that of the arms as drawn."});
  study.cases.push_back({name + ": force displayed where the motors can", "1", tally.displayed,
                         base.tally.front().displayed, "reported", true,
                         "Mean of rendered over commanded force at the end of the hold; beside it that of the arms as "
                         "drawn."});
}

}  // namespace

StudyResult sensitivity_study(const StudyRequest& request) {
  StudyResult study{"sensitivity", drawn_plant_words(request.seed, request.nominal), {}, {}};
  const std::vector<DrawnPress> presses =
      grid_cases(request.seed, request.quick ? kQuickPresses : kPresses, request.nominal);
  const GridResult base = pressed(presses, nullptr, 1), finer = pressed(presses, nullptr, kLess);
  const std::size_t flipped = changed(finer, base);
  study.cases.push_back({"sub-steps half as long: verdicts that change", "1", static_cast<double>(flipped),
                         std::nullopt, "0", flipped == 0,
                         "Presses that are stable with one length of the plant's sub-step and not with the other."});
  add_variant(study, "as drawn", base, base);
  for (const Property& property : kProperties) {
    for (const double by : {kLess, kMore}) {
      add_variant(study, std::string(property.name) + (by < 1 ? " -50 %" : " +50 %"), pressed(presses, &property, by),
                  base);
    }
  }
  return study;
}

}  // namespace trocar
