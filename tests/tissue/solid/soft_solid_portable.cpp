// The soft solid once more, without the clones that the processor chooses among: what any machine computes.
#define TROCAR_LANES_CLONED
#define SoftSolid PortableSoftSolid
#define NodeLevels PortableNodeLevels
#include "tissue/solid/node_levels.cpp"  // NOLINT(bugprone-suspicious-include)
#include "tissue/solid/soft_solid.cpp"   // NOLINT(bugprone-suspicious-include)

#include "tests/tissue/solid/soft_solid_path.h"

namespace trocar::test {

std::string portable_bytes() { return bytes_of_run<PortableSoftSolid>(); }

}  // namespace trocar::test
