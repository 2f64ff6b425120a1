// Reach and orient (E01): tip and instrument brought to the place and direction of one pen after the other.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription reach_kind();

}  // namespace trocar
