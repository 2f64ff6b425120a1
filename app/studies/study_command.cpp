#include "app/studies/study_command.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/session/setup/true_plant.h"
#include "app/studies/admittance/admittance_study.h"
#include "app/studies/contact/contact_law_study.h"
#include "app/studies/contact/contact_torque_study.h"
#include "app/studies/contact/hardware_study.h"
#include "app/studies/contact/passivity_study.h"
#include "app/studies/contact/sensitivity_study.h"
#include "app/studies/contact/transparency_study.h"
#include "app/studies/contact/walls_study.h"
#include "app/studies/contact/zwidth_study.h"
#include "app/studies/device/force_study.h"
#include "app/studies/device/gravity_study.h"
#include "app/studies/device/kinematics_study.h"
#include "app/studies/device/motor_study.h"
#include "app/studies/device/plant_study.h"
#include "app/studies/device/velocity_study.h"
#include "app/studies/study_files.h"
#include "app/studies/timing/timing_study.h"
#include "app/studies/tissue/soft_studies.h"
#include "app/studies/workspace/workspace_study.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

struct KnownStudy {
  const char* name;
  StudyResult (*run)(const StudyRequest&);
  bool takes_plant = false;  ///< works on the device of the request
  bool draws = false;        ///< works on an arm drawn for each trial
  bool reads_sensor = false;
};

/// In the order of the thesis, then what goes beyond it.
constexpr std::array kStudies{
    KnownStudy{"kinematics", kinematics_study},
    KnownStudy{"motor", motor_study},
    KnownStudy{.name = "force", .run = force_study, .reads_sensor = true},
    KnownStudy{"walls", walls_study},
    KnownStudy{"torque-x", [](const StudyRequest& request) { return torque_study('x', request); }},
    KnownStudy{"torque-y", [](const StudyRequest& request) { return torque_study('y', request); }},
    KnownStudy{"torque-z", [](const StudyRequest& request) { return torque_study('z', request); }},
    KnownStudy{"gravity", gravity_study, true},
    KnownStudy{"passivity", passivity_study, false, true},
    KnownStudy{"admittance", admittance_study},
    KnownStudy{"velocity", velocity_study},
    KnownStudy{"zwidth", zwidth_study, false, true},
    KnownStudy{"sensitivity", sensitivity_study, false, true},
    KnownStudy{"hardware", hardware_study, false, true},
    KnownStudy{"transparency", transparency_study, true},
    KnownStudy{"workspace", workspace_study},
    KnownStudy{"plant", plant_study, true},
    KnownStudy{"contact-law", [](const StudyRequest&) { return contact_law_study(); }},
    KnownStudy{"indentation", indentation_study},
    KnownStudy{"relaxation", relaxation_study},
    KnownStudy{"grasp", grasp_study},
    KnownStudy{"cutting", cutting_study},
    KnownStudy{"suturing", suturing_study},
    KnownStudy{"multirate", multirate_study},
    KnownStudy{"solvers", solvers_study},
    KnownStudy{"tissue-scaling", tissue_scaling_study},
    KnownStudy{"timing", timing_study},
};

std::string names_where(bool KnownStudy::*which) {
  std::string names;
  for (const KnownStudy& known : kStudies) {
    if (known.*which) names += std::string(names.empty() ? "" : ", ") + known.name;
  }
  return names;
}

StudyRequest request_of(const StudyOptions& options, const KnownStudy& study) {
  StudyRequest request{options.quick, options.seed};
  if (options.nominal && !study.draws) {
    throw InputError("study " + options.name + " draws no arms; --nominal is for " + names_where(&KnownStudy::draws));
  }
  request.nominal = options.nominal;
  if (!options.sensor.empty() && !study.reads_sensor)
    throw InputError("study " + options.name + " reads no force sensor; --sensor is for " +
                     names_where(&KnownStudy::reads_sensor));
  request.sensor = options.sensor;
  if (options.plant.empty()) return request;
  if (!study.takes_plant) {
    throw InputError("study " + options.name + " works on a device of its own; --plant is for " +
                     names_where(&KnownStudy::takes_plant));
  }
  const TruePlant plant = true_plant(options.plant, options.seed);
  request.plant = plant.parameters;
  request.plant_words = plant.words;
  return request;
}

}  // namespace

std::vector<std::string> study_names() {
  std::vector<std::string> names;
  for (const KnownStudy& study : kStudies) names.emplace_back(study.name);
  return names;
}

int study_command(const StudyOptions& options, std::ostream& out, std::ostream& err) {
  const auto study = std::find_if(kStudies.begin(), kStudies.end(),
                                  [&](const KnownStudy& known) { return options.name == known.name; });
  if (study == kStudies.end()) {
    std::string known;
    for (const std::string& name : study_names()) known += " " + name;
    throw InputError("no study '" + options.name + "'; there are:" + known);
  }
  const StudyResult result = study->run(request_of(options, *study));
  write_study(result, options.out);
  out << (options.json ? summary_json(result) : table_markdown(result));
  err << "trocar: data, plots and summary.json in " << options.out.string() << '\n';
  const bool met = std::all_of(result.cases.begin(), result.cases.end(), [](const StudyCase& c) { return c.met; });
  return met ? 0 : 1;
}

void add_study(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<StudyOptions>();
  StudyOptions& o = *given;
  std::string studies;
  for (const std::string& name : study_names()) studies += (studies.empty() ? "" : ", ") + name;
  CLI::App* study = add_command(parent, "study", "Do an experiment again: data, plots, summary", chosen,
                                [given] { return study_command(*given, std::cout, std::cerr); });
  study->add_option("name", o.name, "One of: " + studies)->required();
  study->add_option("--out", o.out, "Folder")->required()->check(writable_path());
  study->add_flag("--quick", o.quick, "Fewer trials of the same kind");
  study->add_option("--plant", o.plant, "Plant file of the device, instead of the seed's: gravity, transparency, plant")
      ->check(file_name());
  study
      ->add_option("--sensor", o.sensor,
                   "Forces also through the line of this sensor, its peer fed by the simulated device: force")
      ->check(CLI::IsMember({"net-ft", "serial"}));
  study->add_flag("--nominal", o.nominal,
                  "The arm of the documents instead of drawn ones: " + names_where(&KnownStudy::draws));
  study->add_option("--seed", o.seed, "Of everything that is drawn")->capture_default_str()->check(seed_range());
  study->add_flag("--json", o.json, "Summary as JSON");
}

}  // namespace trocar
