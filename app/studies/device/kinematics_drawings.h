// Drawings of the kinematics study: the device at S1 to S3 laid over each other (figure 3.35), the stylus' way in space
// (figure 3.34), and how the device would hang in each assembly mode (figure 2.12). Thread: any.
#pragma once

#include <vector>

#include "app/studies/study.h"

namespace trocar {

/// device_overlay.svg, stylus_path.svg, assembly_modes.svg.
std::vector<StudyFile> kinematics_drawings();

}  // namespace trocar
