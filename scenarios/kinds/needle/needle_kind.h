// Needle driving (E12): a curved needle through pairs of dots, on the arc of its own circle.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription needle_kind();

}  // namespace trocar
