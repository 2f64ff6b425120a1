#include "app/studies/contact/passivity_study.h"

#include <algorithm>
#include <cmath>

#include "app/studies/contact/passivity_grid.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

constexpr double kPressTravel = 0.105;  // m of the fastest press
constexpr double kReacts = 0.45;        // s after touch at which the operator stiffens
constexpr double kWatched = 2.5;        // s after touch
constexpr double kThesisOff = 0.66, kThesisOn = 0.17, kThesisGravity = 0.08;  // s, figures 4.15, 4.16, 4.18
constexpr int kPassivityQuickEvery = 20;                                      // quick form: five cases of the grid

const std::string kSettled =
    "Last time after touch at which the force differs by 0.1 N or more from its centred 50 ms mean";

WallCase wall_near_home() {
  WallCase c;
  c.pose = near_home(kPressTravel);
  c.direction = -arm_state(c.pose).X_WS.R.col(1);  // the right wall lies towards -Y6
  return c;
}

WallCase scenario_1() {
  WallCase c = wall_near_home();
  c.extra_delay = 9;
  c.grip = GripPreset::kFingertip;
  c.speed = 0.46;
  return c;
}

/// @param known the gain is calibrated: the loop knows that it renders 750 N/m.
WallCase scenario_2(bool known) {
  WallCase c = wall_near_home();
  c.stiffness = known ? 750 : 150;
  c.gain = known ? 1 : 5;
  c.compensated = known;
  c.extra_delay = 5;
  c.grip = GripPreset::kLight;
  c.speed = 0.43;
  return c;
}

/// The thesis' experiments: seam's own delay, normal pen grip.
WallCase experiment(double speed, bool compensated) {
  WallCase c = wall_near_home();
  c.speed = speed;
  c.compensated = compensated;
  return c;
}

StudyCurves curves_of(const std::string& file, const std::string& title, const WallOutcome& off,
                      const WallOutcome& on) {
  StudyCurves curves{file, title, "time after touch, s", "rendered force, N", off.trace.t, {}};
  std::vector<double> with = on.trace.force_n, without = off.trace.force_n;
  with.resize(curves.x.size(), std::nan(""));
  curves.series = {{"law off", without}, {"budgeted", with}};
  return curves;
}

/// Figures 4.15, 4.16 and 4.18: what the thesis plots, each scaled to fit one axis.
StudyCurves figure(const std::string& file, const std::string& title, const WallOutcome& o) {
  StudyCurves curves{file, title, "time after touch, s", "in the units of the legend", o.trace.t, {}};
  const auto scaled = [](std::vector<double> values, double by) {
    for (double& v : values) v *= by;
    return values;
  };
  curves.series = {{"depth, cm", scaled(o.trace.position_m, 100)},
                   {"speed, m/s", o.trace.speed_m_s},
                   {"force, N", o.trace.force_n},
                   {"energy, 10 mJ", scaled(o.trace.true_j, 100)}};
  return curves;
}

StudyCase settling(const std::string& name, double value, std::optional<double> thesis, const std::string& bar,
                   bool met, const std::string& more) {
  return {name, "s", value, thesis, bar, met, kSettled + more};
}

void scenarios(StudyResult& study) {
  struct Scenario {
    const char *name, *file;
    WallCase c;
  };
  for (const Scenario& s :
       {Scenario{"S1", "scenario_1", scenario_1()}, Scenario{"S2", "scenario_2", scenario_2(true)}}) {
    const WallRig rig(s.c);
    const WallOutcome off = rig.press({PassivityLaw::kOff}, kWatched),
                      thesis = rig.press({PassivityLaw::kThesis}, kWatched),
                      on = rig.press({PassivityLaw::kBudgeted}, kWatched);
    const std::string name = s.name;
    study.cases.push_back(settling(name + ": law off, no reaction of the operator", off.settled_s, kThesisOff,
                                   ">= 0.5 (unstable)", off.settled_s >= kSettleLimit || off.faulted,
                                   "; watched for 2.5 s, so 2.5 means never."));
    study.cases.push_back(settling(name + ": thesis' law, no reaction", thesis.settled_s, std::nullopt,
                                   "as with the law off", thesis.settled_s == off.settled_s,
                                   "; its observer pairs force and motion of one tick and never acts on a spring."));
    study.cases.push_back(settling(name + ": budgeted law, no reaction", on.settled_s, std::nullopt, "<= 0.5",
                                   on.stable(), "; the default law."));
    study.curves.push_back(curves_of(s.file, name + ": press into the wall, the operator does not react", off, on));
    WallCase reacting = s.c;
    reacting.stiffens_s = kReacts;
    const WallOutcome ended = WallRig(reacting).press({PassivityLaw::kOff}, kWatched);
    study.cases.push_back(settling(name + ": law off, the operator stiffens at 0.45 s", ended.settled_s, kThesisOff,
                                   "0.45 to 0.80", ended.settled_s > kReacts && ended.settled_s < 0.8,
                                   "; the grip turns firm 0.45 s after touch, as the thesis' operator ended it."));
  }
  const WallOutcome blind = WallRig(scenario_2(false)).press({PassivityLaw::kBudgeted}, kWatched);
  study.cases.push_back(settling("S2 with the gain of 5 unknown to the loop: budgeted law", blind.settled_s,
                                 std::nullopt, "reported", true,
                                 "; no observer pays for a force it does not know of: hence trocar device calibrate."));
}

void experiments(StudyResult& study) {
  const WallOutcome off = WallRig(experiment(0.45, false)).press({PassivityLaw::kOff}, kWatched);
  const WallOutcome on = WallRig(experiment(0.44, false)).press({PassivityLaw::kBudgeted}, kWatched);
  const WallOutcome weight = WallRig(experiment(0.96, true)).press({PassivityLaw::kBudgeted}, kWatched);
  const std::string how =
      "; 150 N/m, normal pen grip, 2 ms between latch and force, the hand aims 15 mm past the wall.";
  study.cases.push_back(settling("150 N/m at 0.45 m/s, law off", off.settled_s, kThesisOff, "reported", true, how));
  study.cases.push_back(
      settling("150 N/m at 0.44 m/s, law on", on.settled_s, kThesisOn, "<= 0.17", on.settled_s <= kThesisOn, how));
  study.cases.push_back(settling("150 N/m at 0.96 m/s, law on, weight carried", weight.settled_s, kThesisGravity,
                                 "<= 0.08", weight.settled_s <= kThesisGravity, how));
  study.curves.push_back(figure("figure_4_15", "0.45 m/s, law off", off));
  study.curves.push_back(figure("figure_4_16", "0.44 m/s, law on", on));
  study.curves.push_back(figure("figure_4_18", "0.96 m/s, law on, weight carried", weight));
}

const LawTally& tally_of(const GridResult& grid, PassivityLaw law, bool clamp) {
  return *std::find_if(grid.tally.begin(), grid.tally.end(),
                       [&](const LawTally& t) { return t.law.law == law && t.law.clamp == clamp; });
}

void passivity_laws(StudyResult& study, const StudyRequest& request) {
  const GridResult grid = run_grid(grid_cases(request.seed, request.quick ? kPassivityQuickEvery : 1), grid_laws());
  const double cases = static_cast<double>(grid.cases.size());
  const LawTally &off = tally_of(grid, PassivityLaw::kOff, false),
                 &thesis = tally_of(grid, PassivityLaw::kThesis, false),
                 &on = tally_of(grid, PassivityLaw::kBudgeted, false),
                 &clamped = tally_of(grid, PassivityLaw::kBudgeted, true);
  const std::string rule =
      "Presses of the grid (grid.csv) without shutdown, settled within 0.5 s of touch, with at most "
      "two touches later than that.";
  study.cases.push_back(
      {"grid: stable with the law off", "share", off.stable / cases, thesis.stable / cases, "reported", true, rule});
  study.cases.push_back({"grid: stable with the default law, no clamp", "share", on.stable / cases,
                         thesis.stable / cases, ">= 0.98", on.stable >= 0.98 * cases, rule});
  study.cases.push_back(
      {"grid: force displayed with the default law", "share", on.displayed, std::nullopt, ">= 0.75",
       on.displayed >= 0.75,
       "Rendered over commanded force in the last 0.3 s, mean over the cases that are stable with the "
       "law off; a saturated force counts as displayed."});
  study.cases.push_back({"grid: stable with the default law and the K_max clamp", "share", clamped.stable / cases,
                         std::nullopt, "1", clamped.stable == static_cast<int>(grid.cases.size()), rule});
  study.cases.push_back({"grid: lowest energy that the contact took", "mJ", on.least_true_j * 1e3,
                         thesis.least_true_j * 1e3, "reported", true,
                         "True joint motion times acting contact torque, lowest sum since touch over all presses."});
  study.cases.push_back({"grid: error of the energy observer", "mJ", on.observer_gap_j * 1e3, std::nullopt, "reported",
                         true, "Largest difference of observed and true contact energy over all presses."});
  study.files.push_back({"grid.csv", grid_csv(grid)});
  study.files.push_back({"laws.md", law_table(grid)});
}

}  // namespace

StudyResult passivity_study(const StudyRequest& request) {
  StudyResult study{"passivity", "simulated plant, nominal parameters, 1 kHz", {}, {}};
  scenarios(study);
  experiments(study);
  passivity_laws(study, request);
  return study;
}

}  // namespace trocar
