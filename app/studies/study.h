// One experiment of the thesis, or against it, done again: what it measured, what it drew, what it wrote down.
//
// A study fills a StudyResult and touches no file; study_files.h writes it as data CSV, SVG plots, summary.json and
// table.md. SI in the data; the unit of a case stands beside it. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "haptics/device/plant/plant_parameters.h"

namespace trocar {

/// One number of a study beside what the thesis' method gives and what is asked for.
struct StudyCase {
  std::string name, unit;
  double value = 0;
  std::optional<double> thesis;  ///< the same measure on the thesis' method (StudyResult::beside); absent without one
  std::string bar;               ///< what is asked for, in words: "<= 0.03"
  bool met = false;
  std::string definition;  ///< how it was measured, one sentence
};

/// Curves over one abscissa, for one plot and one CSV file.
struct StudyCurves {
  std::string file;  ///< stem of the file names
  std::string title, x_label, y_label;
  std::vector<double> x;
  struct Series {
    std::string name;
    std::vector<double> y;  ///< as long as x; NaN leaves a gap
  };
  std::vector<Series> series;
  bool logarithmic = false;  ///< both axes; what is not above zero leaves a gap
};

/// A drawing or a table that is no set of curves: written as it stands.
struct StudyFile {
  std::string name;  ///< with its ending: workspace_side.svg
  std::string bytes;
};

/// How the study is to be done.
struct StudyRequest {
  bool quick = false;                         ///< fewer trials of the same kind, for tests; the bars stay
  std::uint64_t seed = 1;                     ///< of everything that is drawn
  std::optional<PlantParameters> plant = {};  ///< of a plant file, instead of the seed's; only where a study takes one
  std::string plant_words = {};               ///< what that file is called
  bool nominal = false;                       ///< the arm of the documents, where a study draws arms otherwise

  std::string sensor = {};  ///< "net-ft" or "serial": forces come through its line too

  PlantParameters true_device() const { return plant ? *plant : draw_parameters(seed); }
  std::string device_words() const { return plant ? plant_words : "seed " + std::to_string(seed); }
};

struct StudyResult {
  std::string study, plant;
  std::vector<StudyCase> cases;
  std::vector<StudyCurves> curves;
  std::vector<StudyFile> files = {};
  std::string beside = "thesis' law";   ///< what StudyCase::thesis is of
  std::vector<std::string> notes = {};  ///< sentences under the table
};

}  // namespace trocar
