// `trocar organ inspect`: what an input holds, before anything is imported: series of a DICOM folder, segments of a
// label map, parts of a surface, size and values of an image.
//
// List on `out`. Nothing that names a patient. Errors leave as InputError (exit code 2).
#pragma once

#include <iosfwd>
#include <string>

#include "tissue/progress.h"

namespace trocar {

struct OrganInspectOptions {
  std::string input;
  std::string
      label_table;  ///< names for the numbers; "" the file's own, and what the built-in tables agree on is not guessed
  bool json = false;
  Progress progress = {};
};

/// @return exit code 0
int organ_inspect(const OrganInspectOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
