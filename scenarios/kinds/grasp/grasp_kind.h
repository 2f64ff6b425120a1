// Limited grasp (E03): foam blocks carried to their rings with a grip that neither slips nor crushes.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription grasp_kind();

}  // namespace trocar
