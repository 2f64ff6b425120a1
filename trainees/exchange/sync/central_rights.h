// Who may do what at the central database. Internal to trainees/exchange/sync. docs/decisions/0030-central-rights.md.
//
// The owner of the schema may everything. A login of a station or a desk reads, and inserts rows in the name of its own
// stations; nothing else. Which login a station belongs to, and when a row came, the server says: the columns login,
// received and seq cannot be given. What must change goes through functions that run with the owner's rights and look
// at who asks.
#pragma once

#include <string>
#include <vector>

#include "trainees/exchange/sync/carried_rows.h"

namespace trocar::sync {

/// Tables, columns, functions and policies, for a centre before version 3.
std::vector<std::string> rights_statements();

/// What version 4 adds to a centre of version 3.
std::vector<std::string> rights_since_3();

/// What version 5 changes: which rows can be brought, and audit.of_desk.
std::vector<std::string> rights_since_4();

/// What a login of a station or a desk is granted, and its end. @param login as it stands in pg_roles.
std::vector<std::string> grant_statements(const std::string& login);
std::vector<std::string> revoke_statements(const std::string& login);

/// SQL that is true for a row of a sealed table that whoever asks may bring: a desk what it likes, a station what is
/// about its own people and attempts. Columns stand by their names alone. "true" for tables that are about nobody.
std::string may_bring(const std::string& table);

/// SQL that is true for a row, of a sealed table or of carried_bases(), that a program may have written: others can
/// take it. "true" for other tables.
std::string is_sound(const std::string& table);

/// SQL that is true where `uuid` names a row as this program does, by a time that is no more than a year ahead.
std::string names_row();
/// The first 48 bits, as hexadecimal digits, that such a UUID has at the most; by the centre's clock.
std::string latest_time();

/// Tables that came with version 4.
const std::vector<std::string>& programme_tables();

}  // namespace trocar::sync
