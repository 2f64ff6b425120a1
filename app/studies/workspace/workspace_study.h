// `trocar study workspace`: the region that the stylus reaches, against tables 2.1 and 2.2, and what the device is
// worth in it: conditioning, force, heat, resolution, and what the interference of link l1 costs.
//
// Volumes by cubes (workspace_grid.h); greatest extents by a sweep of the joint box through the forward model, which is
// also the oracle of the cubes. Percentiles of the reference's region are drawn by seed. Thread: any.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult workspace_study(const StudyRequest& request);

}  // namespace trocar
