// Retract and hold (E09): tissue taken, lifted, held with a wanted pull and let down.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription retract_kind();

}  // namespace trocar
