// Operation (E14): stages, each an exercise of another kind, one after the other at places of one organ.
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription operation_kind();

}  // namespace trocar
