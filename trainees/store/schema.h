// The tables, views, indices and triggers of the database as SQL. Internal to trainees/.
#pragma once

namespace trocar {

const char* schema_sql();
/// What schema 3 adds: who is active, which programmes are assigned to whom.
const char* programme_schema_sql();

}  // namespace trocar
