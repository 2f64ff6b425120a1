// Lift and find (E08): a flap that is lifted and held to read what lies beneath, let down, and what was read is told.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription find_kind();

}  // namespace trocar
