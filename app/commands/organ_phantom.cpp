#include "app/commands/organ_phantom.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "app/commands/organ_import.h"
#include "app/commands/organ_report.h"
#include "haptics/input_error.h"
#include "tissue/imaging/label_table.h"
#include "tissue/imaging/nifti_writer.h"
#include "tissue/imaging/phantom/phantom.h"
#include "tissue/mesh/staged_file.h"

namespace trocar {
namespace {

constexpr const char* kCredit = "synthetic CT phantom made by Trocar";
constexpr const char* kLicence = "CC0-1.0";

std::string readme(const PhantomOptions& options, const LabelVolume& labels) {
  const LabelTable& table = label_table(kDefaultLabelTable);
  std::ostringstream text;
  text << "# Synthetic CT phantom\n\nDrawn from analytic shapes by `trocar organ phantom --seed " << options.seed
       << "`; no patient, no scanner. Licence " << kLicence << ".\n\n- ct.nii.gz: Hounsfield units, int16, voxels of "
       << options.voxel_mm << " mm, RAS\n- labels.nii.gz: labels numbered as in the table " << table.name << ":\n\n";
  for (const auto& [number, voxels] : labels.label_counts())
    text << "  - " << number << " " << table.name_of(number).value_or("unnamed") << ", "
         << std::lround(static_cast<double>(voxels) * labels.voxel_volume_ml()) << " mL\n";
  return text.str();
}

void write_volumes(const std::filesystem::path& folder, const PhantomOptions& options) {
  const CtPhantom phantom = make_phantom(options);
  const LabelVolume& labels = phantom.labels;
  StagedFile ct(folder / "ct.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, phantom.hounsfield));
  StagedFile map(folder / "labels.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, labels.labels));
  StagedFile text(folder / "README.md", readme(options, labels));
  ct.commit();
  map.commit();
  text.commit();
}

WrittenOrgan import_phantom_organ(const std::filesystem::path& folder, const std::string& label, int triangles,
                                  std::ostream& err) {
  OrganImportOptions import;
  import.input = (folder / "ct.nii.gz").string();
  import.labels = (folder / "labels.nii.gz").string();
  import.label = label;
  import.triangles = triangles;
  import.output = (folder / ("phantom-" + label)).string();
  import.licence = kLicence;
  import.credit = kCredit;
  import.synthetic = true;
  return import_organ(import, err);
}

}  // namespace

int organ_phantom(const OrganPhantomOptions& options, std::ostream& out, std::ostream& err) {
  if (options.out.empty()) throw InputError("--out: no folder given");
  write_volumes(options.out, {.seed = options.seed});
  nlohmann::ordered_json organs = nlohmann::ordered_json::array();
  for (const auto& [label, triangles] : {std::pair("liver", 6000), std::pair("gallbladder", 2000)}) {
    const WrittenOrgan organ = import_phantom_organ(options.out, label, triangles, err);
    if (options.json)
      organs.push_back(nlohmann::ordered_json::parse(organ_json(organ.manifest, organ.surface.bounds())));
    if (!options.json) out << organ_text(organ.manifest, organ.surface.bounds());
  }
  const nlohmann::ordered_json report{{"synthetic", true},
                                      {"seed", options.seed},
                                      {"volume", "ct.nii.gz"},
                                      {"labels", "labels.nii.gz"},
                                      {"organs", organs}};
  if (options.json) out << report.dump(2) << "\n";
  return 0;
}

}  // namespace trocar
