// The anchor file: heads of the audit trail, kept outside the database so that a cut-off end shows. Internal to
// trainees/.
//
// trocar.db.anchor beside trocar.db, a line "POSITION ROW_HASH UTC" after every change, appended and never rewritten. A
// line that a crash cut off is ended with "~" by the next and does not count. It may lag (a crash between commit and
// line), never lead, unless entries were removed or an older copy of the database was put back. Whoever may write the
// folder can forge both: it shows accidents and casual hands, and a head that was noted elsewhere shows the rest.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trainees/integrity/audit.h"

namespace trocar {

std::filesystem::path anchor_path(const std::filesystem::path& database);

/// Appends a line. A failure is left to the next check, which sees a lagging file: the commit has been made already.
void append_anchor(const std::filesystem::path& database, const AuditHead& head);

/// The file as it is, "" when there is none; and a copy of it for a copy of the database.
std::string read_anchor(const std::filesystem::path& database);
void write_anchor(const std::filesystem::path& database, const std::string& text);

/// Problems between file and trail, one line each.
std::vector<std::string> check_anchor(const std::filesystem::path& database, sqlite3* connection);

}  // namespace trocar
