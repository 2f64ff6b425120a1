// Desired beside measured for one component of the wrench, and the trials of which a contact study is made: the same
// experiment in the hands of several persons (seeds), first as the thesis had it, then as Trocar has it.
// SI, stylus axes. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/studies/contact/contact_experiment.h"
#include "app/studies/study.h"

namespace trocar {

struct ComponentComparison {
  Curve desired, measured;
  std::vector<Spell> touched;      ///< desired above 2 % of its peak: when the tool was in
  std::vector<Spell> asked, felt;  ///< above 40 % of the peak, desired and measured
  double lag_s = 0, ratio = 0;     ///< measured behind desired; over desired, at the sensor's own lag
};
ComponentComparison compare(const ContactRecording& recording, Component which);

/// Mean force and moment over a contact, desired and measured; its first and last 0.2 s are left out.
struct MeanWrenches {
  Wrench desired, measured;
};
MeanWrenches mean_wrenches(const ContactRecording& recording, const Spell& touched);

/// Largest |F - its mean of 50 ms| of the rendered force later than 0.5 s after touch (H5), until the hand sets out to
/// leave.
double late_unrest(const ContactExperiment& experiment, const ContactRecording& recording,
                   const std::vector<Spell>& touched);

/// One way of doing an experiment.
struct ContactManner {
  std::string name, stem;  ///< in the tables; in file names
  ContactSetting setting;
};
inline constexpr double kFixtureKg = 0.1;  ///< sensor of 63 g and its fixture [assumed]
/// 20 N/m without a passivity law, as in the thesis; the same with its amplifier gain of 5 and nothing compensated;
/// 150 N/m with the default law.
ContactManner soft_manner(), thesis_manner(), stiff_manner();

/// Seeds of the trials: one in the quick form, ten in the full one.
std::vector<std::uint64_t> trial_seeds(const StudyRequest& request);

/// Curves of components against the thesis' clock.
StudyCurves component_curves(const std::string& file, const std::string& title, const std::vector<double>& t,
                             const std::vector<Wrench>& wrenches, const std::vector<Component>& components);

/// One component desired and measured, at the times of the readings.
StudyCurves overlay_curves(const std::string& file, const std::string& title, const ContactRecording& recording,
                           Component which);

/// What the plant of these studies is.
extern const char* const kContactPlant;

}  // namespace trocar
