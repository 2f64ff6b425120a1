// The tables, views, indices and triggers of the database as SQL. Internal to trainees/.
#pragma once

namespace trocar {

const char* schema_sql();
/// What schema 3 adds: who is active, which programmes are assigned to whom.
const char* programme_schema_sql();
/// What schema 4 changes: rows of an attempt that runs can be removed, so that what somebody put in does not stand.
/// From here on each attempt has an entry of its beginning (integrity/audit.h); an older program would write none.
const char* running_rows_schema_sql();
/// What schema 5 changes: several erasures of a person, revocations of a certificate, withdrawals of an assignment may
/// stand, so that one that somebody put in does not keep the signed one out; attempts of a person are found by name.
const char* endings_schema_sql();

}  // namespace trocar
