// Files as one zip archive in memory, through libzip: names in order, fixed time stamps, so that the same files give
// the same bytes.
//
// Thread: any, not the tick.
#pragma once

#include <map>
#include <string>

namespace trocar {

/// @param files name to bytes. @throws EnvironmentError with libzip's reason
std::string zip_bytes(const std::map<std::string, std::string>& files);

}  // namespace trocar
