#include "app/studies/contact/contact_comparison.h"

#include <algorithm>

#include "haptics/force_sensor/simulated_force_sensor.h"

namespace trocar {
namespace {

constexpr double kTouchShare = 0.02, kFeltShare = 0.4;
constexpr double kBridge = 0.2;      // s: shorter gaps and spells are noise
constexpr double kLongestLag = 0.4;  // s
constexpr double kEdge = 0.2;        // s after touch and before leaving
constexpr double kSensorLag = ForceSensorConfig{}.lag_s;
constexpr double kLate = 0.5, kWindow = 0.05;  // s

ContactSetting setting_of(double stiffness, PassivityLaw law) {
  ContactSetting setting;
  setting.stiffness = stiffness;
  setting.law = law;
  setting.fixture_kg = kFixtureKg;
  return setting;
}

Wrench mean_of(const std::vector<double>& t, const std::vector<Wrench>& wrenches, const Spell& spell) {
  Wrench mean;
  for (int i = 0; i < 3; ++i) {
    mean.force[i] = mean_over(curve_of(t, wrenches, static_cast<Component>(i)), spell);
    mean.moment[i] = mean_over(curve_of(t, wrenches, static_cast<Component>(i + 3)), spell);
  }
  return mean;
}

}  // namespace

const char* const kContactPlant =
    "simulated: the device as its documents describe it, a hand of normal grip drawn by the seed, a force/torque "
    "sensor of "
    "40 Hz, 0.15 s lag, 20 mN and 0.5 mN m noise";

ComponentComparison compare(const ContactRecording& recording, Component which) {
  ComponentComparison out;
  out.desired = curve_of(recording.t, recording.desired, which);
  out.measured = curve_of(recording.sensor_t, recording.measured, which);
  const double wanted = peak(out.desired);
  out.touched = spells(out.desired, kTouchShare * wanted, kBridge);
  out.asked = spells(out.desired, kFeltShare * wanted, kBridge);
  out.felt = spells(out.measured, kFeltShare * peak(out.measured), kBridge);
  out.lag_s = best_lag(out.desired, out.measured, kLongestLag);
  out.ratio = magnitude_ratio(out.desired, out.measured, kSensorLag);
  return out;
}

MeanWrenches mean_wrenches(const ContactRecording& recording, const Spell& touched) {
  const Spell inner{touched.from_s + kEdge, touched.to_s - kEdge};
  return {mean_of(recording.t, recording.desired, inner),
          mean_of(recording.sensor_t, recording.measured, {inner.from_s + kSensorLag, inner.to_s + kSensorLag})};
}

double late_unrest(const ContactExperiment& experiment, const ContactRecording& recording,
                   const std::vector<Spell>& touched) {
  double largest = 0;
  for (const Spell& hold : holds(experiment, touched, kLate)) {
    largest = std::max(largest, unrest({recording.t, recording.rendered_n}, hold, kWindow));
  }
  return largest;
}

ContactManner soft_manner() { return {"20 N/m", "20", setting_of(20, PassivityLaw::kOff)}; }

ContactManner thesis_manner() {
  ContactManner manner{"20 N/m, gain 5", "20_gain_5", setting_of(20, PassivityLaw::kOff)};
  manner.setting.gain = 5;
  manner.setting.compensation = false;
  return manner;
}

ContactManner stiff_manner() { return {"150 N/m", "150", setting_of(150, PassivityLaw::kBudgeted)}; }

std::vector<std::uint64_t> trial_seeds(const StudyRequest& request) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t i = 0; i < (request.quick ? 1u : 10u); ++i) seeds.push_back(request.seed + i);
  return seeds;
}

StudyCurves component_curves(const std::string& file, const std::string& title, const std::vector<double>& t,
                             const std::vector<Wrench>& wrenches, const std::vector<Component>& components) {
  const bool moments = components.front() >= Component::kMx;
  StudyCurves curves{file, title, "time on the clock of the thesis' figure, s", moments ? "torque, N m" : "force, N",
                     t,    {}};
  for (const Component which : components) {
    curves.series.push_back({component_name(which), curve_of(t, wrenches, which).y});
  }
  return curves;
}

StudyCurves overlay_curves(const std::string& file, const std::string& title, const ContactRecording& recording,
                           Component which) {
  const Curve desired = curve_of(recording.t, recording.desired, which);
  StudyCurves curves = component_curves(file, title, recording.sensor_t, recording.measured, {which});
  curves.y_label = std::string(component_name(which)) + (which >= Component::kMx ? ", N m" : ", N");
  curves.series.front().name = "measured";
  curves.series.push_back({"desired", {}});
  for (const double t : recording.sensor_t) curves.series.back().y.push_back(value_at(desired, t));
  return curves;
}

}  // namespace trocar
