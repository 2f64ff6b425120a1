// Surface touch (E02): discs on an organ pressed with a wanted force, then a block squeezed between the jaws.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription touch_kind();

}  // namespace trocar
