#include "app/cli/command_line_organs.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "app/cli/progress_display.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_info.h"
#include "app/organs/organ_inspect.h"
#include "app/organs/organ_package.h"
#include "app/organs/organ_phantom.h"
#include "app/organs/organ_render.h"
#include "app/session/setup/scene.h"
#include "app/session/setup/typed_path.h"
#include "tissue/organ/organ.h"

namespace trocar {

struct OrganCommandLine {
  OrganImportOptions import;
  OrganInspectOptions inspect;
  OrganInfoOptions info;
  OrganRenderOptions render;
  OrganPackageOptions package;
  OrganPhantomOptions phantom;
  std::string organ;
  std::vector<double> window, seed;
  double fill_holes_mm = -1;
  int series = 0;
  std::function<void(std::function<int()>)> choose;

  CLI::App* add(CLI::App& parent, const char* name, const char* help, std::function<int()> action) {
    CLI::App* command = parent.add_subcommand(name, help);
    command->callback([this, action = std::move(action)] { choose(action); });
    return command;
  }
};

namespace {

const CLI::Validator kOrganPath([](std::string& path) { return typed_path_fault(path); }, "PATH");
constexpr const char* kInputs =
    "Label map or image (.nii .nii.gz .nrrd .seg.nrrd .mha .mhd), DICOM folder, zip, DICOMDIR or file, or surface "
    "(.stl .ply .obj .off .glb .gltf .fbx .vtk .vtp .vtu .msh)";

int run_import(OrganCommandLine& c) {
  OrganImportOptions options = c.import;
  if (!c.window.empty()) options.threshold.window = {c.window[0], c.window[1]};
  if (!c.seed.empty()) options.threshold.seed_mm = {c.seed[0], c.seed[1], c.seed[2]};
  if (c.fill_holes_mm >= 0) options.surface.fill_holes_mm = c.fill_holes_mm;
  if (c.series > 0) options.series = c.series;
  if (!options.report.empty()) options.assets = find_assets().assets;
  ProgressDisplay progress(std::cerr, error_is_terminal());
  options.progress = progress.function();
  const int code = organ_import(options, std::cout, std::cerr);
  progress.clear();
  return code;
}

void add_label_options(OrganCommandLine& c, CLI::App& import) {
  const char* group = "Labels";
  import.add_option("--labels", c.import.labels, "Label map, DICOM SEG or RTSTRUCT of the image INPUT")->group(group);
  import
      .add_option("--label", c.import.label,
                  "Label number, name, or LAYER:NUMBER where segments overlap; several make a scene (--label "
                  "liver,gallbladder)")
      ->delimiter(',')
      ->group(group);
  import.add_flag("--all", c.import.all, "Every label, as a scene")->group(group);
  import
      .add_option(
          "--label-table", c.import.label_table,
          "What the numbers mean: totalsegmentator-v1, -v2, -mr, trocar-phantom, or a file (CSV, .ctbl, ITK-SNAP)")
      ->group(group);
  import.add_option("--series", c.series, "Which of several DICOM series (numbers: organ inspect)")
      ->check(CLI::Range(1, 100000))
      ->group(group);
  import.add_flag("--largest-part", c.import.largest_only, "Keep nothing but the largest part of a label")
      ->group(group);
  import
      .add_option("--subject", c.import.subject,
                  "Organ of a scene that exercises are done on (default: the liver, else the largest)")
      ->group(group);
}

void add_threshold_options(OrganCommandLine& c, CLI::App& import) {
  const char* group = "Without labels: a window of values, which knows no anatomy";
  import.add_option("--threshold", c.window, "Lowest and highest value of the image (HU for CT)")
      ->expected(2)
      ->group(group);
  import.add_option("--seed-point", c.seed, "Point in the organ, RAS, mm: grow from it")->expected(3)->group(group);
  import.add_option("--reach", c.import.threshold.reach_mm, "With a seed: look no further than this, mm")
      ->check(CLI::Range(1.0, 1000.0))
      ->group(group);
  import.add_option("--opening", c.import.threshold.opening_mm, "Radius of the opening ball, mm")
      ->check(CLI::Range(0.0, 50.0))
      ->group(group);
  import.add_option("--closing", c.import.threshold.closing_mm, "Radius of the closing ball, mm")
      ->check(CLI::Range(0.0, 50.0))
      ->group(group);
  import.add_flag("--smooth", c.import.threshold.smooth, "Smooth the values first, keeping edges")->group(group);
}

void add_surface_options(OrganCommandLine& c, CLI::App& import) {
  const char* group = "Surfaces";
  import
      .add_option("--unit", c.import.surface.unit,
                  "Length unit of the file: mm, cm or m; of a volume that says none also dm, um")
      ->group(group);
  import.add_option("--frame", c.import.surface.frame, "What x, y, z of the file point at: RAS, LPS, ...")
      ->group(group);
  import.add_option("--up", c.import.surface.up_axis, "Axis of the file that points to the head: x, y or z")
      ->group(group);
  import.add_option("--part", c.import.surface.part, "Node or region to take (names: organ inspect)")->group(group);
  import.add_option("--fill-holes", c.fill_holes_mm, "Fill holes up to this span, mm")
      ->check(CLI::Range(0.1, 200.0))
      ->group(group);
  import.add_flag("--wrap", c.import.surface.wrap, "Shrink-wrap a broken surface")->group(group);
  import.add_option("--wrap-alpha", c.import.surface.wrap_alpha_mm, "Gaps narrower than this are closed by --wrap, mm")
      ->check(CLI::Range(0.1, 50.0))
      ->capture_default_str()
      ->group(group);
}

void add_import(OrganCommandLine& c, CLI::App& organ) {
  CLI::App* import = c.add(organ, "import", "An organ, or a scene of organs, from CT, MR, label maps or surfaces",
                           [&c] { return run_import(c); });
  import->add_option("input", c.import.input, kInputs)->required();
  import->add_option("-o,--output", c.import.output, "NAME of the organ files")->required()->check(kOrganPath);
  import->add_option("--triangles", c.import.triangles, "Triangles aimed at, each organ")->capture_default_str();
  import->add_option("--report", c.import.report, "Page with pictures and figures (HTML)")->check(kOrganPath);
  import->add_option("--lattice", c.import.lattice_mm, "Also a lattice of cubes of this edge, mm")
      ->check(CLI::Range(1.0, 100.0));
  import->add_option("--tetrahedra", c.import.tetrahedra_mm, "Also tetrahedra of this size, mm")
      ->check(CLI::Range(1.0, 100.0));
  import->add_option("--name", c.import.name, "Name of the organ or the scene");
  import->add_option("--material", c.import.material, "Material name (default: by the organ's name)");
  import->add_option("--modality", c.import.modality, "CT or MR");
  import->add_option("--licence", c.import.licence,
                     "Licence of the source; unknown when not given, and then it cannot be packaged");
  import->add_option("--credit", c.import.credit, "One line to show with the organ");
  import->add_flag("--json", c.import.json, "Report as JSON");
  add_label_options(c, *import);
  add_threshold_options(c, *import);
  add_surface_options(c, *import);
}

void add_others(OrganCommandLine& c, CLI::App& organ) {
  CLI::App* inspect = c.add(organ, "inspect", "What an input holds: DICOM series, labels, parts of a surface", [&c] {
    ProgressDisplay progress(std::cerr, error_is_terminal());
    c.inspect.progress = progress.function();
    return organ_inspect(c.inspect, std::cout, std::cerr);
  });
  inspect->add_option("input", c.inspect.input, kInputs)->required();
  inspect->add_option("--label-table", c.inspect.label_table, "Table that names the numbers");
  inspect->add_flag("--json", c.inspect.json, "As JSON");
  const auto manifest = [&c] { return find_organ(c.organ, find_assets().assets); };
  CLI::App* info = c.add(organ, "info", "What an organ is and how good its surface", [&c, manifest] {
    c.info.manifest = manifest();
    return organ_info(c.info, std::cout, std::cerr);
  });
  info->add_flag("--json", c.info.json, "As JSON");
  CLI::App* render = c.add(organ, "render", "A picture of an organ or a scene", [&c, manifest] {
    c.render.manifest = manifest();
    return organ_render(c.render, find_assets().assets, std::cout, std::cerr);
  });
  render->add_option("-o,--output", c.render.output, "PNG file")->required()->check(kOrganPath);
  render->add_option("--width", c.render.width, "px")->capture_default_str();
  render->add_option("--height", c.render.height, "px")->capture_default_str();
  for (CLI::App* command : {info, render})
    command
        ->add_option("organ", c.organ,
                     "NAME.organ.toml, NAME.scene.toml (#ORGAN behind it: another subject) or a shipped organ")
        ->required();
  CLI::App* package = c.add(organ, "package", "Organs with a licence, and their credits, as a zip to pass on", [&c] {
    c.package.assets = find_assets().assets;
    return organ_package(c.package, std::cout, std::cerr);
  });
  package->add_option("organs", c.package.organs, "NAME.organ.toml, NAME.scene.toml or shipped organs")->required();
  package->add_option("-o,--output", c.package.output, "FILE.zip")->required()->check(kOrganPath);
}

void add_phantom(OrganCommandLine& c, CLI::App& organ) {
  CLI::App* phantom = c.add(organ, "phantom", "The synthetic abdominal CT phantom and its organs", [&c] {
    ProgressDisplay progress(std::cerr, error_is_terminal());
    c.phantom.progress = progress.function();
    return organ_phantom(c.phantom, std::cout, std::cerr);
  });
  phantom->add_option("--out", c.phantom.out, "Folder")->required()->check(kOrganPath);
  phantom->add_option("--seed", c.phantom.seed, "Seed of the noise, and of --variant by-seed")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 9e18, "SEED"));
  phantom
      ->add_option("--variant", c.phantom.variant,
                   "normal, short-duct, low-insertion, fat or artery-anterior; by-seed: the one that --seed stands for")
      ->capture_default_str();
  phantom->add_option("--patient", c.phantom.patient, "Natural variation; 0: the standard patient")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 9e18, "PATIENT"));
  phantom->add_option("--voxel", c.phantom.voxel_mm, "Voxel in mm; 1.25 shows ducts and arteries well")
      ->capture_default_str();
  phantom->add_flag("--scene", c.phantom.scene, "The organs round the gallbladder as one scene as well");
  phantom->add_flag("--dicom", c.phantom.dicom, "The CT as a DICOM series as well");
  phantom->add_flag("--json", c.phantom.json, "Report as JSON");
}

}  // namespace

std::shared_ptr<OrganCommandLine> add_organ_commands(CLI::App& app, std::function<void(std::function<int()>)> choose) {
  auto options = std::make_shared<OrganCommandLine>();
  options->choose = std::move(choose);
  CLI::App* organ = app.add_subcommand("organ", "Organs from images and surfaces");
  organ->require_subcommand(1);
  add_import(*options, *organ);
  add_others(*options, *organ);
  add_phantom(*options, *organ);
  return options;
}

}  // namespace trocar
