// Schema of the central PostgreSQL database, all of it in its schema "trocar". Internal to trainees/exchange/sync.
// docs/many_stations.md.
//
// Version 2: every row has a number of arrival (column seq); whoever writes holds the lock until the end, so that
// numbers become visible in their order, and central.revision is the highest of what has been committed. Who fetches
// asks for what came after. Version 3: logins of stations and desks, and what each may (central_rights.h). Version 4:
// who is active and what is assigned; stations push from the beginning, for what they wrote of it before. Version 5: no
// rows that nobody can take, and what stations say of groups is of their own people.
#pragma once

#include <string>
#include <vector>

namespace trocar::sync {

inline constexpr int kCentralVersion = 5;

/// Statements that lead from that version to the newest, in order, in one transaction. 0: nothing is there yet.
std::vector<std::string> central_statements(int from);

/// Takes away what an erasure that stands at the centre says, whichever station it came from, of everybody who is
/// linked to that person; in order.
const std::vector<std::string>& central_erasing();

}  // namespace trocar::sync
