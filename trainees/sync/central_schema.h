// Schema of the central PostgreSQL database, all of it in its schema "trocar". Internal to trainees/sync. docs/many_stations.md.
#pragma once

#include <string>
#include <vector>

namespace trocar::sync {

inline constexpr int kCentralVersion = 1;

/// Statements that make it, in order, in one transaction.
std::vector<std::string> central_schema();

/// Takes away what an erasure that stands at the centre says, whichever station it came from; in order.
const std::vector<std::string>& central_erasing();

}  // namespace trocar::sync
