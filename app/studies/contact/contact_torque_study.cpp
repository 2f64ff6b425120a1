#include "app/studies/contact/contact_torque_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/studies/contact/contact_comparison.h"

namespace trocar {
namespace {

constexpr double kPerDegree = std::numbers::pi / 180;
constexpr double kSoftTurn = 30 * kPerDegree, kStiffTurn = 22 * kPerDegree;  // of the hand, for 20 and for 150 N/m

Component torque_about(char axis) { return static_cast<Component>(3 + (axis - 'x')); }

struct Findings {
  double asked = 0, felt = 0;               // events, fewest of a trial
  double time_error = 0;                    // s, largest, of the contacts whose times the thesis gives
  double dominance = 0;                     // least |intended torque| over the next larger one, desired
  double signs_asked = 1, signs_felt = 1;   // share of the expected signs
  double ratio = 0;                         // of the intended torque, mean
  double force_ratio = 0;                   // of the larger accompanying force, mean
  double lever = 0, printed = 0;            // N m, mean intended torque of the first contact in its expected sign
  double unrest = 0;                        // N, largest
  double weight_read = 0, weight_left = 0;  // N along X6 before the first contact, means
  ContactRecording first;
};

/// How often the means of the contacts have the signs that the thesis expects.
void add_signs(const TorqueExperiment& t, const std::vector<MeanWrenches>& means, Findings& f) {
  double count = 0, asked = 0, felt = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    for (const ExpectedSign& e : t.contacts[i].expected) {
      count += 1;
      asked += e.sign * component(means[i].desired, e.which) > 0;
      felt += e.sign * component(means[i].measured, e.which) > 0;
    }
  }
  f.signs_asked = std::min(f.signs_asked, asked / count);
  f.signs_felt = std::min(f.signs_felt, felt / count);
}

double dominance(char axis, const Vec3& moment) {
  const int main = axis - 'x';
  return std::abs(moment[main]) / std::max(std::abs(moment[(main + 1) % 3]), std::abs(moment[(main + 2) % 3]));
}

void add_contacts(const TorqueExperiment& t, const ContactRecording& recording, const std::vector<Spell>& touched,
                  double share, Findings& f) {
  std::vector<MeanWrenches> means;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    means.push_back(mean_wrenches(recording, touched[i]));
    f.dominance = std::min(f.dominance, dominance(t.axis, means[i].desired.moment));
    if (!t.contacts[i].thesis_times) continue;
    f.time_error = std::max({f.time_error, std::abs(touched[i].from_s - t.contacts[i].touch_s),
                             std::abs(touched[i].to_s - t.contacts[i].leave_s)});
  }
  add_signs(t, means, f);
  const int main = t.axis - 'x', sign = t.contacts.front().expected.front().sign;
  Curve printed{recording.t, {}};
  for (const Vec3& moment : recording.printed_moment) printed.y.push_back(moment[main]);
  f.printed += share * sign * mean_over(printed, touched.front());
  f.lever += share * sign * mean_over(curve_of(recording.t, recording.desired, torque_about(t.axis)), touched.front());
}

void add_trial(const TorqueExperiment& t, const ContactRecording& recording, double share, Findings& f) {
  const ComponentComparison torque = compare(recording, torque_about(t.axis));
  const ComponentComparison force = compare(recording, t.contacts.front().expected[1].which);
  f.asked = std::min(f.asked, static_cast<double>(torque.asked.size()));
  f.felt = std::min(f.felt, static_cast<double>(torque.felt.size()));
  f.ratio += share * torque.ratio;
  f.force_ratio += share * force.ratio;
  f.unrest = std::max(f.unrest, late_unrest(t.experiment, recording, torque.touched));
  const Spell before{t.experiment.begins_s, recording.sensor_t.front() + 0.5};
  f.weight_read += share * mean_over(curve_of(recording.sensor_t, recording.read, Component::kFx), before);
  f.weight_left += share * mean_over(curve_of(recording.sensor_t, recording.measured, Component::kFx), before);
  if (torque.touched.size() == t.contacts.size()) {
    add_contacts(t, recording, torque.touched, share, f);
  } else {
    f.dominance = f.signs_asked = f.signs_felt = 0;
  }
}

Findings findings_of(char axis, const ContactManner& manner, double turn_rad, const StudyRequest& request) {
  const TorqueExperiment t = torque_experiment(axis, turn_rad);
  const std::vector<std::uint64_t> seeds = trial_seeds(request);
  Findings f;
  f.asked = f.felt = f.dominance = 1e3;
  for (const std::uint64_t seed : seeds) {
    ContactSetting setting = manner.setting;
    setting.seed = seed;
    const ContactRecording recording = record_contacts(t.experiment, setting);
    add_trial(t, recording, 1.0 / static_cast<double>(seeds.size()), f);
    if (seed == seeds.front()) f.first = recording;
  }
  return f;
}

void add_directions(StudyResult& study, const std::string& name, const std::string& axis, const Findings& f) {
  study.cases.push_back({name + ": contacts in the desired torque", "1", f.asked, 2.0, "2", f.asked == 2,
                         "Spells above 40 % of the peak about " + axis + ", fewest of all trials."});
  study.cases.push_back({name + ": contacts in the measured torque", "1", f.felt, 2.0, "2", f.felt == 2,
                         "The same in the sensor's readings."});
  study.cases.push_back(
      {name + ": contact times against the thesis",
       "s",
       f.time_error,
       {},
       "<= 0.1",
       f.time_error <= 0.1,
       "Largest difference of touch and leave, of the contacts whose times the thesis gives, worst trial."});
  study.cases.push_back({name + ": torque about " + axis + " over the next larger one",
                         "1",
                         f.dominance,
                         {},
                         "> 2",
                         f.dominance > 2,
                         "Mean desired torque of a contact, least of all contacts and trials; 1000 stands for more."});
  study.cases.push_back(
      {name + ": expected signs in the desired wrench", "share", f.signs_asked, 1.0, "1", f.signs_asked == 1,
       "Signs of torque and accompanying forces that the thesis expects (3.7), means of each contact, worst trial."});
  study.cases.push_back({name + ": expected signs in the measured wrench", "share", f.signs_felt, 1.0, "1",
                         f.signs_felt == 1, "The same in the sensor's readings without the fixture's weight."});
  study.cases.push_back(
      {name + ": torque about " + axis + " in the expected sense", "N m", f.lever, f.printed, "> 0", f.lever > 0,
       "Mean over the first contact of the desired torque; thesis' law: the lever as printed in 3.3.3, from the "
       "contact to the origin."});
}

void add_magnitudes(StudyResult& study, const std::string& name, const Findings& f, const Findings& thesis) {
  const auto ratio = [&](const std::string& what, double value, double with_gain) {
    study.cases.push_back(
        {name + ": measured over desired " + what, "1", value, with_gain, "1 +- 0.1", std::abs(value - 1) <= 0.1,
         "Least-squares slope at the sensor's lag, mean of the trials; thesis' law: gain 5 left in, nothing "
         "compensated."});
  };
  ratio("torque", f.ratio, thesis.ratio);
  ratio("force", f.force_ratio, thesis.force_ratio);
  study.cases.push_back({name + ": unrest later than 0.5 s after touch", "N", f.unrest, thesis.unrest, "< 0.1",
                         f.unrest < 0.1,
                         "Largest |F - its mean of 50 ms| of the rendered force, all contacts and trials."});
}

void add_weight(StudyResult& study, const Findings& f) {
  study.cases.push_back(
      {"force along X6 before contact, fixture removed", "N", f.weight_left, f.weight_read, "0 +- 0.1",
       std::abs(f.weight_left) <= 0.1,
       "Mean over the first readings, of the trials; thesis' law: as read, the fixture of 0.1 kg hangs along -X6 "
       "(figure 3.49)."});
}

void add_torque_curves(StudyResult& study, char axis, const ContactManner& manner, const Findings& f) {
  using enum Component;
  const std::string end = "_" + manner.stem, with = ", " + manner.name;
  const auto desired = [&](const std::string& figure, std::vector<Component> which) {
    study.curves.push_back(
        component_curves(figure + end, "Desired, simulated plant" + with, f.first.t, f.first.desired, which));
  };
  const auto measured = [&](const std::string& figure, std::vector<Component> which, bool raw = false) {
    study.curves.push_back(component_curves(
        figure + end, (raw ? "As read with the fixture, simulated plant" : "Measured, simulated plant") + with,
        f.first.sensor_t, raw ? f.first.read : f.first.measured, which));
  };
  study.curves.push_back(
      overlay_curves("desired_and_measured" + end, "Cube, simulated plant" + with, f.first, torque_about(axis)));
  if (axis == 'x') {
    desired("figure_3_45", {kMx});
    measured("figure_3_46_torque", {kMx});
    measured("figure_3_46_force", {kFy, kFz});
  } else if (axis == 'y') {
    desired("figure_3_48", {kMy});
    measured("figure_3_49_torque", {kMy});
    measured("figure_3_49_force_as_read", {kFx, kFz}, true);
    measured("figure_3_49_force", {kFx, kFz});
  } else {
    desired("figure_3_51_desired", {kMz});
    measured("figure_3_51_measured", {kMz});
    measured("figure_3_52", {kFx, kFy});
  }
}

}  // namespace

StudyResult torque_study(char axis, const StudyRequest& request) {
  StudyResult study{std::string("torque-") + axis, kContactPlant, {}, {}};
  const std::string name = std::string(1, static_cast<char>(axis - 'x' + 'X')) + "6";
  const Findings thesis = findings_of(axis, thesis_manner(), kSoftTurn, request);
  add_torque_curves(study, axis, thesis_manner(), thesis);
  for (const auto& [manner, turn] : {std::pair{soft_manner(), kSoftTurn}, std::pair{stiff_manner(), kStiffTurn}}) {
    const Findings f = findings_of(axis, manner, turn, request);
    add_directions(study, manner.name, name, f);
    add_magnitudes(study, manner.name, f, thesis);
    if (axis == 'y' && manner.stem == "20") add_weight(study, f);
    add_torque_curves(study, axis, manner, f);
  }
  return study;
}

}  // namespace trocar
