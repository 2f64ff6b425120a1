#include "trainees/exchange/export/table_export.h"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "trainees/exchange/export/certificate_export.h"
#include "trainees/exchange/export/export_tables.h"
#include "trainees/markup/csv.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

std::string select(const ExportTable& table, const std::string& rows) {
  std::string sql;
  for (const ExportColumn& column : table.columns) sql += (sql.empty() ? "SELECT " : ", ") + std::string(column.sql);
  return sql + " " + rows;
}

std::string csv_cell(const sql::Statement& row, int at, ColumnKind kind) {
  if (row.is_null(at)) return "";
  switch (kind) {
    case ColumnKind::kText:
      return csv_text(row.text(at));
    case ColumnKind::kReal:
      return csv_number(row.real(at));
    case ColumnKind::kInteger:
    case ColumnKind::kTruth:
      return std::to_string(row.integer(at));
  }
  return "";
}

Json json_cell(const sql::Statement& row, int at, ColumnKind kind) {
  if (row.is_null(at)) return nullptr;
  switch (kind) {
    case ColumnKind::kText:
      return row.text(at);
    case ColumnKind::kReal:
      return std::isfinite(row.real(at)) ? Json(row.real(at)) : Json(nullptr);
    case ColumnKind::kInteger:
      return row.integer(at);
    case ColumnKind::kTruth:
      return row.integer(at) != 0;
  }
  return nullptr;
}

void write_csv_header(const ExportTable& table, std::ostream& out) {
  std::vector<std::string> names;
  for (const ExportColumn& column : table.columns) names.emplace_back(column.name);
  out << csv_line(names);
}

/// Rows of one attempt or trainee; the statement is ready for the next afterwards.
void write_csv_rows(const ExportTable& table, sql::Statement& rows, std::int64_t of, std::ostream& out) {
  rows.bind(of);
  std::vector<std::string> fields(table.columns.size());
  while (rows.step()) {
    for (std::size_t i = 0; i < fields.size(); ++i)
      fields[i] = csv_cell(rows, static_cast<int>(i), table.columns[i].kind);
    out << csv_line(fields);
  }
  rows.run();
}

/// @param first column that is taken: parts stand under their attempt, so they do not name it again.
Json json_rows(const ExportTable& table, sql::Statement& rows, std::int64_t of, std::size_t first) {
  rows.bind(of);
  Json list = Json::array();
  while (rows.step()) {
    Json object = Json::object();
    for (std::size_t i = first; i < table.columns.size(); ++i) {
      object[table.columns[i].name] = json_cell(rows, static_cast<int>(i), table.columns[i].kind);
    }
    list.push_back(std::move(object));
  }
  rows.run();
  return list;
}

bool is_notes(const ExportTable& table) { return std::string(table.name) == "notes"; }

/// To attempts of which notes on a trainee are not.
bool narrowed(const ExportChoice& choice) { return !choice.filter.exercise.empty() || !choice.filter.attempt.empty(); }

std::string dumped_table(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json trainee_notes(sqlite3* connection, const ExportChoice& choice) {
  Json notes = Json::array();
  if (narrowed(choice)) return notes;
  for (const ExportTable& table : attempt_parts()) {
    if (!is_notes(table)) continue;
    sql::Statement rows(connection, select(table, notes_of_trainee()));
    for (const std::int64_t trainee : choice.trainees) {
      for (Json& note : json_rows(table, rows, trainee, 1)) notes.push_back(std::move(note));
    }
  }
  return notes;
}

}  // namespace

void write_csv_files(Database& database, const ExportChoice& choice, PendingExport& folder) {
  const auto write = [&](const ExportTable& table) {
    std::ostream& out = folder.file(std::string(table.name) + ".csv");
    write_csv_header(table, out);
    sql::Statement rows(database.connection(), select(table, table.rows_of_attempt));
    for (const std::int64_t attempt : choice.attempts) write_csv_rows(table, rows, attempt, out);
    if (!is_notes(table) || narrowed(choice)) return;
    sql::Statement of_trainee(database.connection(), select(table, notes_of_trainee()));
    for (const std::int64_t trainee : choice.trainees) write_csv_rows(table, of_trainee, trainee, out);
  };
  write(attempts_table());
  for (const ExportTable& table : attempt_parts()) write(table);
  write_certificates_csv(chosen_certificates(database, choice), folder.file("certificates.csv"));
}

void write_json(Database& database, const ExportChoice& choice, std::ostream& out) {
  sqlite3* connection = database.connection();
  std::vector<std::unique_ptr<sql::Statement>> parts;
  for (const ExportTable& table : attempt_parts()) {
    parts.push_back(std::make_unique<sql::Statement>(connection, select(table, table.rows_of_attempt)));
  }
  sql::Statement attempts(connection, select(attempts_table(), attempts_table().rows_of_attempt));
  const Json filter = {{"trainee", choice.filter.trainee},
                       {"group", choice.filter.group},
                       {"exercise", choice.filter.exercise},
                       {"attempt", choice.filter.attempt}};
  out << "{\"schema\":\"trocar-export\",\"schema_version\":" << kExportSchema << ",\"filter\":" << dumped_table(filter)
      << ",\"attempts\":[";
  const char* before = "\n";
  for (const std::int64_t row : choice.attempts) {
    Json attempt = json_rows(attempts_table(), attempts, row, 0).at(0);
    for (std::size_t i = 0; i < parts.size(); ++i)
      attempt[attempt_parts()[i].name] = json_rows(attempt_parts()[i], *parts[i], row, 1);
    out << before << dumped_table(attempt);
    before = ",\n";
  }
  out << "\n],\"notes\":" << dumped_table(trainee_notes(connection, choice))
      << ",\"certificates\":" << certificates_json(chosen_certificates(database, choice)) << "}\n";
}

}  // namespace trocar
