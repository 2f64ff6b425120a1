// Attempts as CSV files and as one JSON document. Columns and units: docs/exports.md. Thread: the Database's.
#pragma once

#include <iosfwd>

#include "trainees/exchange/export/export_choice.h"
#include "trainees/exchange/export/pending_export.h"

namespace trocar {

/// Of the JSON document and the columns of the CSV files: counts up when a field changes its meaning or goes.
inline constexpr int kExportSchema = 2;

/// attempts.csv, metrics.csv, subscores.csv, caps.csv, events.csv, notes.csv, signatures.csv, overrides.csv,
/// certificates.csv.
void write_csv_files(Database& database, const ExportChoice& choice, PendingExport& folder);

/// {"schema": "trocar-export", "schema_version": 1, "filter": {...}, "attempts": [{..., "metrics": [...], ...}],
/// "notes": [...], "certificates": [...]}
void write_json(Database& database, const ExportChoice& choice, std::ostream& out);

}  // namespace trocar
