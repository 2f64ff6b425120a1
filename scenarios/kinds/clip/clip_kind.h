// Clip and cut (E11): the cystic duct and the cystic artery named by touch, clipped and divided.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription clip_kind();

}  // namespace trocar
