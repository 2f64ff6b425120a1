// The tables that csv and json export: columns with their units, and the SQL that reads the rows of one attempt or one
// trainee. Internal to trainees/exchange/export.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trocar {

enum class ColumnKind : std::uint8_t { kText, kInteger, kReal, kTruth };

struct ExportColumn {
  const char* name;
  const char* sql;
  ColumnKind kind = ColumnKind::kText;
};

struct ExportTable {
  const char* name;                   ///< of the file and of the array in JSON
  std::vector<ExportColumn> columns;  ///< the first one is attempt_uuid
  std::string rows_of_attempt;        ///< FROM ... WHERE ... = ?
};

/// One row an attempt.
const ExportTable& attempts_table();
/// What belongs to an attempt, many rows each.
const std::vector<ExportTable>& attempt_parts();
/// Notes on a trainee and no attempt: FROM ... WHERE trainee = ?, with the columns of "notes".
const char* notes_of_trainee();

}  // namespace trocar
