// The tables, views, indices and triggers of the database as SQL. Internal to trainees/.
#pragma once

namespace trocar {

const char* schema_sql();

}  // namespace trocar
