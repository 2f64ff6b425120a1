// Clock and name of the machine, by which told moments are judged. Thread: any.
#pragma once

#include <string>

namespace trocar {

double since_boot_s();       ///< sleep included; programs of one machine agree on it
std::string machine_name();  ///< in its network; "" when it has none

}  // namespace trocar
