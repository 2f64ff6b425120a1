// Ring on wire (E06): a ring at the instrument's tip is moved along a bent wire from end to end.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription wire_kind();

}  // namespace trocar
