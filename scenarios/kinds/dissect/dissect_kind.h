// The kind "dissect": strands lifted on a hook and divided by current, then vessels that spurt (dissect_rules.h).
#pragma once

#include "scenarios/kinds/kind.h"

namespace trocar {

KindDescription dissect_kind();

}  // namespace trocar
