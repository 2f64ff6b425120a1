// Camera navigation (E04): the instrument is the scope; one sphere after the other is brought into the picture's
// middle.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription camera_kind();

}  // namespace trocar
