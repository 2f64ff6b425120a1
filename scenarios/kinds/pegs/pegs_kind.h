// Peg transfer with one hand (E05): rings moved from peg to peg, across the board and back.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription pegs_kind();

}  // namespace trocar
