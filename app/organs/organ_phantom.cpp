#include "app/organs/organ_phantom.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/progress_display.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_report.h"
#include "haptics/input_error.h"
#include "tissue/imaging/labels/label_table.h"
#include "tissue/imaging/phantom/dicom_writer.h"
#include "tissue/imaging/phantom/phantom.h"
#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/organ/staged_file.h"

namespace trocar {
namespace {

constexpr const char* kCredit = "synthetic CT phantom made by Trocar";
constexpr const char* kLicence = "CC0-1.0";

/// The variant by its name; "by-seed": the one that the seed stands for.
PhantomVariant variant_of(const OrganPhantomOptions& options) {
  return options.variant == "by-seed" ? phantom_variant_of_seed(options.seed) : phantom_variant(options.variant);
}

PhantomOptions drawn(const OrganPhantomOptions& options) {
  PhantomOptions phantom;
  phantom.voxel_mm = options.voxel_mm, phantom.seed = options.seed, phantom.patient = options.patient;
  phantom.variant = variant_of(options);
  return phantom;
}

std::string readme(const OrganPhantomOptions& options, const LabelVolume& labels) {
  const LabelTable& table = label_table(kPhantomTable);
  std::ostringstream text;
  text << "# Synthetic CT phantom\n\nDrawn from analytic shapes by `trocar organ phantom --variant "
       << phantom_variant_name(variant_of(options)) << " --patient " << options.patient << " --voxel "
       << options.voxel_mm << " --seed " << options.seed << "`; no patient, no scanner. Licence " << kLicence
       << ".\n\n- ct.nii.gz: Hounsfield units, int16, portal venous phase, voxels of " << options.voxel_mm
       << " mm, RAS\n- labels.nii.gz: labels numbered as in the table " << table.name << ":\n\n";
  for (const auto& [number, voxels] : labels.label_counts()) {
    const double volume = static_cast<double>(voxels) * labels.voxel_volume_ml();
    text << "  - " << number << " " << table.name_of(number).value_or("unnamed") << ", ";
    if (volume >= 10) text << std::lround(volume) << " mL\n";
    if (volume < 10) text << std::lround(volume * 100) / 100.0 << " mL\n";
  }
  text << "\nDucts and arteries, centreline length and outer diameter as drawn:\n\n";
  for (const PhantomTube& tube : phantom_hilum(variant_of(options), options.patient))
    text << "  - " << tube.name << ", " << std::lround(tube.length_mm()) << " mm, "
         << std::lround(20 * tube.radii_mm.front()) / 10.0 << " mm\n";
  return text.str();
}

void write_volumes(const OrganPhantomOptions& options) {
  const CtPhantom phantom = make_phantom(drawn(options));
  const LabelVolume& labels = phantom.labels;
  StagedFile ct(options.out / "ct.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, phantom.hounsfield));
  StagedFile map(options.out / "labels.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, labels.labels));
  StagedFile text(options.out / "README.md", readme(options, labels));
  if (options.dicom) write_phantom_dicom(options.out / "dicom", phantom);
  ct.commit();
  map.commit();
  text.commit();
}

/// What the scene holds: everything that a cholecystectomy sees, and what lies round it.
const std::vector<std::string>& scene_labels() {
  static const std::vector<std::string> labels{"liver",
                                               "gallbladder",
                                               "cystic_duct",
                                               "common_hepatic_duct",
                                               "common_bile_duct",
                                               "hepatic_artery",
                                               "right_hepatic_artery",
                                               "left_hepatic_artery",
                                               "cystic_artery",
                                               "portal_vein_and_splenic_vein",
                                               "stomach",
                                               "duodenum",
                                               "pancreas",
                                               "colon",
                                               "small_bowel",
                                               "spleen",
                                               "kidney_right",
                                               "kidney_left"};
  return labels;
}

OrganImportOptions phantom_import(const OrganPhantomOptions& options, const std::string& name) {
  OrganImportOptions import;
  import.input = (options.out / "ct.nii.gz").string();
  import.labels = (options.out / "labels.nii.gz").string();
  import.label_table = kPhantomTable;
  import.output = (options.out / ("phantom-" + name)).string();
  import.licence = kLicence;
  import.credit = kCredit;
  import.synthetic = true;
  import.progress = options.progress;
  return import;
}

WrittenOrgans import_phantom_scene(const OrganPhantomOptions& options, std::ostream& err) {
  constexpr int kTriangles = 2000;
  OrganImportOptions import = phantom_import(options, "abdomen");
  import.label = scene_labels();
  import.triangles = kTriangles;
  import.name = "phantom-abdomen";
  return import_organs(import, err);
}

bool sound(const std::vector<CompiledMember>& organs, const std::vector<OrganCrossing>& crossings) {
  return faults_of(organs, crossings).empty();
}

CompiledMember import_phantom_organ(const OrganPhantomOptions& options, const std::string& label, int triangles,
                                    std::ostream& err) {
  OrganImportOptions import = phantom_import(options, label);
  import.label = {label};
  import.triangles = triangles;
  return std::move(import_organs(import, err).organs[0]);
}

}  // namespace

int organ_phantom(const OrganPhantomOptions& options, std::ostream& out, std::ostream& err) {
  if (options.out.empty()) throw InputError("--out: no folder given");
  write_volumes(options);
  nlohmann::ordered_json organs = nlohmann::ordered_json::array();
  bool all_sound = true;
  for (const auto& [label, triangles] : {std::pair("liver", 6000), std::pair("gallbladder", 2000)}) {
    const CompiledMember organ = import_phantom_organ(options, label, triangles, err);
    all_sound = all_sound && sound({organ}, {});
    if (options.json)
      organs.push_back(nlohmann::ordered_json::parse(organ_json(organ.manifest, organ.surface.bounds())));
    if (!options.json) out << organ_text(organ.manifest, organ.surface.bounds());
  }
  nlohmann::ordered_json scene;
  if (options.scene) {
    const WrittenOrgans abdomen = import_phantom_scene(options, err);
    all_sound = all_sound && sound(abdomen.organs, abdomen.set->crossings);
    scene = nlohmann::ordered_json::parse(scene_report_json(*abdomen.set, abdomen.organs));
    if (!options.json) out << scene_report_text(*abdomen.set, abdomen.organs);
  }
  const nlohmann::ordered_json report{{"synthetic", true},
                                      {"seed", options.seed},
                                      {"variant", phantom_variant_name(variant_of(options))},
                                      {"patient", options.patient},
                                      {"voxel_mm", options.voxel_mm},
                                      {"label_table", kPhantomTable},
                                      {"volume", "ct.nii.gz"},
                                      {"labels", "labels.nii.gz"},
                                      {"organs", organs},
                                      {"scene", scene}};
  if (options.json) out << report.dump(2) << "\n";
  return all_sound ? 0 : 2;
}

void add_organ_phantom(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<OrganPhantomOptions>();
  OrganPhantomOptions& o = *given;
  CLI::App* phantom =
      add_command(parent, "phantom", "The synthetic abdominal CT phantom and its organs", chosen, [given] {
        ProgressDisplay progress(std::cerr, error_is_terminal());
        given->progress = progress.function();
        return organ_phantom(*given, std::cout, std::cerr);
      });
  phantom->add_option("--out", o.out, "Folder")->required()->check(writable_path());
  phantom->add_option("--seed", o.seed, "Seed of the noise, and of --variant by-seed")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 9e18, "SEED"));
  phantom
      ->add_option("--variant", o.variant,
                   "normal, short-duct, low-insertion, fat or artery-anterior; by-seed: the one that --seed stands for")
      ->capture_default_str();
  phantom->add_option("--patient", o.patient, "Natural variation; 0: the standard patient")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 9e18, "PATIENT"));
  phantom->add_option("--voxel", o.voxel_mm, "Voxel in mm; 1.25 shows ducts and arteries well")->capture_default_str();
  phantom->add_flag("--scene", o.scene, "The organs round the gallbladder as one scene as well");
  phantom->add_flag("--dicom", o.dicom, "The CT as a DICOM series as well");
  phantom->add_flag("--json", o.json, "Report as JSON");
}

}  // namespace trocar
