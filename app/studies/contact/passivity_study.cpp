#include "app/studies/contact/passivity_study.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/studies/contact/passivity_grid.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

constexpr double kPressTravel = 0.105;  // m of the fastest press
constexpr double kReacts = 0.45;        // s after touch at which the operator stiffens
constexpr double kWatched = 2.5;        // s after touch
constexpr double kThesisOff = 0.66, kThesisOn = 0.17, kThesisGravity = 0.08;  // s, figures 4.15, 4.16, 4.18
constexpr std::size_t kQuickGridPresses = 5, kQuickHands = 4, kSettlingHands = 120;
constexpr double kSettlingWatched = 1.5;  // s after touch

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
  c.device.extra_delay_periods = 9;
  c.device.hand = hand_parameters(GripPreset::kFingertip), c.device.hand.tremor_m = 0;
  c.speed = 0.46;
  return c;
}

/// @param known the gain is calibrated: the loop knows that it renders 750 N/m.
WallCase scenario_2(bool known) {
  WallCase c = wall_near_home();
  c.stiffness = known ? 750 : 150;
  c.gain = known ? 1 : 5;
  c.compensated = known;
  c.device.extra_delay_periods = 5;
  c.device.hand = hand_parameters(GripPreset::kLight), c.device.hand.tremor_m = 0;
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

/// What was drawn until the hand sets out to leave.
StudyCurves while_held(StudyCurves curves) {
  const auto held = std::lower_bound(curves.x.begin(), curves.x.end(), kWatched) - curves.x.begin();
  curves.x.resize(static_cast<std::size_t>(held));
  for (StudyCurves::Series& series : curves.series) series.y.resize(curves.x.size());
  return curves;
}

StudyCurves curves_of(const std::string& file, const std::string& title, const WallOutcome& off,
                      const WallOutcome& on) {
  StudyCurves curves{file, title, "time after touch, s", "rendered force, N", off.trace.t, {}};
  std::vector<double> with = on.trace.force_n, without = off.trace.force_n;
  with.resize(curves.x.size(), std::nan(""));
  curves.series = {{"law off", without}, {"budgeted", with}};
  return while_held(curves);
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
  return while_held(curves);
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
                      thesis = rig.press({PassivityLaw::kOff, false, {}, 0, ComparisonLaw::kThesis}, kWatched),
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
  study.cases.push_back(settling("150 N/m at 0.44 m/s, law on", on.settled_s, kThesisOn, "reported", true, how));
  study.cases.push_back(
      settling("150 N/m at 0.96 m/s, law on, weight carried", weight.settled_s, kThesisGravity, "reported", true, how));
  study.curves.push_back(figure("figure_4_15", "0.45 m/s, law off", off));
  study.curves.push_back(figure("figure_4_16", "0.44 m/s, law on", on));
  study.curves.push_back(figure("figure_4_18", "0.96 m/s, law on, weight carried", weight));
}

const LawTally& tally_of(const GridResult& grid, const char* name) {
  return *std::find_if(grid.tally.begin(), grid.tally.end(), [&](const LawTally& t) { return t.law.name() == name; });
}

void passivity_laws(StudyResult& study, const StudyRequest& request) {
  const GridResult grid = run_grid(
      grid_cases(request.seed, request.quick ? kQuickGridPresses : kGridPresses, request.nominal), grid_laws());
  const int presses = static_cast<int>(grid.cases.size());
  const auto share = [&](const LawTally& t) { return static_cast<double>(t.stable) / presses; };
  const LawTally &off = tally_of(grid, "off"), &thesis = tally_of(grid, "thesis"), &on = tally_of(grid, "budgeted"),
                 &clamped = tally_of(grid, "budgeted + clamp");
  const std::string alone = "without shutdown, settled within 0.5 s of touch, with at most two touches later than that",
                    rule = "Presses (grid.csv) " + alone +
                           ", or settled at most 0.1 s later than at a continuous wall with the same arm, hand and "
                           "saturation, with no more late touches.";
  study.cases.push_back(
      {"presses: stable with the law off", "share", share(off), share(thesis), "reported", true, rule});
  study.cases.push_back(
      {"presses: stable with the default law", "share", share(on), share(thesis), ">= 0.99", share(on) >= 0.99, rule});
  study.cases.push_back({"presses: stable, lower bound", "share", wilson_low(on.stable, presses),
                         wilson_low(thesis.stable, presses), ">= 0.97", wilson_low(on.stable, presses) >= 0.97,
                         "Of the 95 % interval of that share (Wilson)."});
  study.cases.push_back({"presses: stable by themselves", "share", static_cast<double>(on.stable_alone) / presses,
                         static_cast<double>(thesis.stable_alone) / presses, "reported", true,
                         "Presses " + alone + ", whatever the ideal wall does."});
  study.cases.push_back({"presses: ideal wall stable by itself", "share",
                         static_cast<double>(std::count_if(grid.ideal.begin(), grid.ideal.end(),
                                                           [](const WallOutcome& o) { return o.stable(); })) /
                             presses,
                         std::nullopt, "reported", true, "The continuous wall by the same rule."});
  study.cases.push_back({"presses: stable with the default law and the K_max clamp", "share", share(clamped),
                         std::nullopt, "reported", true, rule});
  study.cases.push_back({"presses: force displayed where the motors can", "share", on.displayed, thesis.displayed,
                         ">= 0.9", on.displayed >= 0.9,
                         "Rendered over commanded force in the last 0.3 s of the hold, mean over the presses in which "
                         "the motors could give it for at least half of that time."});
  study.cases.push_back({"presses: force held of the ideal wall's", "share", on.held, thesis.held, "reported", true,
                         "Mean force there over that of the continuous wall, at most 1, over the same presses: what is "
                         "missing above is depth, not force."});
  study.cases.push_back({"presses: force displayed of what the motors can", "share", on.displayed_all,
                         thesis.displayed_all, "reported", true,
                         "The same over all presses, of the commanded force as far as the motors can give it."});
  study.cases.push_back(
      {"presses: least net energy", "mJ", on.least_net_j * 1e3, thesis.least_net_j * 1e3, ">= -1",
       on.least_net_j >= -1e-3,
       "True energy that all but weight compensation absorbed since touch, with what friction and "
       "cables of the arm took, lowest over all presses, holds and ways out: below 0 the hand is fed."});
  study.cases.push_back(
      {"presses: step of the law", "N", on.law_step_n, thesis.law_step_n, "< 0.1", on.law_step_n < 0.1,
       "Most that the force moved in a tick beyond standing still and following the spring, as commanded or "
       "as far as the motors can."});
  study.cases.push_back(
      {"presses: most energy claimed beyond the truth", "mJ", on.overclaimed_j * 1e3, std::nullopt, "reported", true,
       "How far the account, with the friction that is sure, stood above the net energy, over all presses."});
  study.files.push_back({"grid.csv", grid_csv(grid)});
  study.files.push_back({"laws.md", law_table(grid)});
}

/// One hand at 150 N/m: through the device, and at a wall that the device would be at best.
struct Settling {
  WallOutcome ours, off, ideal;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void settling_beside_ideal(StudyResult& study, const StudyRequest& request) {
  PressDraw draw{{150}, {0}, 0.2, 1.0};
  draw.nominal = request.nominal;
  const auto presses = drawn_presses(request.seed, request.quick ? kQuickHands : kSettlingHands, draw);
  std::vector<Settling> all(presses.size());
  on_all_processors(all.size(), [&](std::size_t i) {
    const WallRig rig(presses[i].wall);
    all[i] = {rig.press({PassivityLaw::kBudgeted}, kSettlingWatched), rig.press({PassivityLaw::kOff}, kSettlingWatched),
              rig.press_ideal(kSettlingWatched)};
    for (WallOutcome* o : {&all[i].ours, &all[i].off, &all[i].ideal}) o->trace = {};
  });
  std::string table = "grip,speed_m_s,settled_s,settled_off_s,settled_ideal_s,above_30_Hz_N,above_30_Hz_ideal_N\n";
  std::vector<double> more, ours, off, ideal, shaking;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Settling& s = all[i];
    more.push_back(s.ours.settled_s - s.ideal.settled_s);
    off.push_back(s.off.settled_s - s.ideal.settled_s);
    ours.push_back(s.ours.settled_s);
    ideal.push_back(s.ideal.settled_s);
    shaking.push_back(s.ours.shaking_n - s.ideal.shaking_n);
    std::ostringstream row;
    row << grip_name(presses[i].grip) << ',' << s.ours.touched_at_m_s << ',' << s.ours.settled_s << ','
        << s.off.settled_s << ',' << s.ideal.settled_s << ',' << s.ours.shaking_n << ',' << s.ideal.shaking_n << '\n';
    table += row.str();
  }
  const std::string how =
      "150 N/m, 0.2 to 1.0 m/s, drawn hands and arms (settling.csv); the ideal wall is continuous, pushes on the "
      "stylus itself and no harder than the motors can.";
  const auto add = [&](const char* name, const char* unit, double value, double thesis, const char* bar, bool met) {
    study.cases.push_back({name, unit, value, thesis, bar, met, how});
  };
  add("settling above the ideal wall, median", "s", quantile(more, 0.5), quantile(off, 0.5), "<= 0.030",
      quantile(more, 0.5) <= 0.030);
  add("settling above the ideal wall, 95 %", "s", quantile(more, 0.95), quantile(off, 0.95), "<= 0.080",
      quantile(more, 0.95) <= 0.080);
  study.cases.push_back({"settling itself, median", "s", quantile(ours, 0.5), std::nullopt, "reported", true, how});
  study.cases.push_back(
      {"settling of the ideal wall, median", "s", quantile(ideal, 0.5), std::nullopt, "reported", true, how});
  study.cases.push_back({"force above 30 Hz over that of the ideal wall, 95 %", "N", quantile(shaking, 0.95),
                         std::nullopt, "reported", true, how});
  study.files.push_back({"settling.csv", table});
}

}  // namespace

StudyResult passivity_study(const StudyRequest& request) {
  StudyResult study{"passivity",
                    drawn_plant_words(request.seed, request.nominal) + "; the thesis' scenarios on the nominal plant",
                    {},
                    {}};
  scenarios(study);
  experiments(study);
  settling_beside_ideal(study, request);
  passivity_laws(study, request);
  return study;
}

}  // namespace trocar
