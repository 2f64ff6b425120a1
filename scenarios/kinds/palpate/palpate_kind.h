// Palpation as a kind of exercise.
//
// Thread: constants.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription palpate_kind();

}  // namespace trocar
