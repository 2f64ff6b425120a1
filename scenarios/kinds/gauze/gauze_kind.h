// Gauze circle cut (E07): a line on gauze that is spread in a frame is cut along with scissors, from the edge in and
// all round.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription gauze_kind();

}  // namespace trocar
