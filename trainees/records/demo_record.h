// Whether a database is the demo's, and whether all in it is still invented.
//
// A demo is one since it was made: the second entry of its audit trail, written before anything else, says so, and no
// later entry, name or row makes a record into one. What stands there is kept out of every record: no attempt begins in
// it once it is whole, nothing is synchronised from or to it. Thread: that of the Database.
#pragma once

#include <string>

#include "trainees/store/database.h"

namespace trocar {

inline constexpr const char* kActionDemo = "demo made";        ///< second entry of a demo's trail
inline constexpr const char* kActionDemoWhole = "demo whole";  ///< every attempt that finished before it is invented

bool is_demo(const Database& database);

/// Makes a database that has just begun the demo's. @throws InputError: something stands in it already.
void mark_demo(Database& database);

/// Every attempt in it is invented; from here on none begins.
void mark_demo_whole(Database& database);

/// UUID of an attempt that the making of the demo did not finish, "" when there is none.
std::string attempt_not_invented(const Database& database);

/// @throws InputError: it is the demo's, whole, and what is asked for belongs to a record. @param what "no attempt
/// ...".
void require_no_demo(const Database& database, const std::string& what);

}  // namespace trocar
