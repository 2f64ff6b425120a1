#include "app/organs/import_options.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/progress_display.h"
#include "app/organs/organ_import.h"
#include "app/session/setup/scene.h"

namespace trocar {
namespace {

/// What is typed, before it becomes options.
struct ImportArguments {
  OrganImportOptions import;
  std::vector<std::string> inputs;
  std::vector<double> window, seed;
  double fill_holes_mm = -1;
  int series = 0;
};

int run_import(ImportArguments& c) {
  OrganImportOptions options = c.import;
  options.input = c.inputs.front();
  options.more_inputs.assign(c.inputs.begin() + 1, c.inputs.end());
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

void add_label_options(ImportArguments& c, CLI::App& import) {
  const char* group = "Labels";
  import
      .add_option("--labels", c.import.labels, "Label map, folder of masks, DICOM SEG or RTSTRUCT of the image INPUT")
      ->group(group);
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
  import.add_flag("--largest-part", c.import.largest_only, "Keep nothing but the largest part of a label or a surface")
      ->group(group);
  import
      .add_option("--subject", c.import.subject,
                  "Organ of a scene that exercises are done on (default: the liver, else the largest)")
      ->group(group);
}

void add_threshold_options(ImportArguments& c, CLI::App& import) {
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

void add_surface_options(ImportArguments& c, CLI::App& import) {
  const char* group = "Surfaces";
  import
      .add_option("--unit", c.import.surface.unit,
                  "Length unit of the file: mm, cm, m or um; of a volume that says none also dm")
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

}  // namespace

void add_organ_import(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ImportArguments>();
  ImportArguments& c = *given;
  CLI::App* import =
      add_command(parent, "import", "An organ, or a scene of organs, from CT, MR, label maps or surfaces", chosen,
                  [given] { return run_import(*given); });
  import->add_option("input", c.inputs, std::string(kInputForms) + "; several masks or surfaces make one scene")
      ->required();
  import->add_option("-o,--output", c.import.output, "NAME of the organ files")->required()->check(writable_path());
  import->add_option("--triangles", c.import.triangles, "Triangles aimed at, each organ")->capture_default_str();
  import->add_option("--report", c.import.report, "Page with pictures and figures (HTML)")->check(writable_path());
  import->add_option("--lattice", c.import.lattice_mm, "Also a lattice of cubes of this edge, mm")
      ->check(CLI::Range(1.0, 100.0));
  import->add_option("--tetrahedra", c.import.tetrahedra_mm, "Also tetrahedra of this size, mm")
      ->check(CLI::Range(1.0, 100.0));
  import->add_option(
      "--name", c.import.name,
      "Of several labels or files the one called so; with --all the scene's name; of one label its name");
  import->add_option("--material", c.import.material,
                     "Material (default: by the organ's name); in a scene of the labels without a name");
  import->add_option("--modality", c.import.modality, "CT or MR");
  import->add_option("--licence", c.import.licence,
                     "Licence of the source; unknown when not given, and then it cannot be packaged");
  import->add_option("--credit", c.import.credit, "One line to show with the organ");
  import->add_flag("--json", c.import.json, "Report as JSON");
  add_label_options(c, *import);
  add_threshold_options(c, *import);
  add_surface_options(c, *import);
}

}  // namespace trocar
