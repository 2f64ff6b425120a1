// Which rows go between a station's SQLite and the centre's PostgreSQL, and their text form. Internal to
// trainees/exchange/sync.
//
// One line a table says columns and types; statements of both sides are made from it. Other rows stand by their UUID,
// so that row numbers stay at home. Numbers go as the shortest text that reads back to the same bits. Thread: any;
// connections as their owners say.
#pragma once

#include <string>
#include <vector>

#include "trainees/exchange/sync/central_link.h"

struct sqlite3;

namespace trocar::sync {

enum class Kind : char { kText, kInteger, kReal };

struct Column {
  std::string central, local;  ///< name there, name here
  std::string refers = {};     ///< here: SQL for the UUID of the row that r.LOCAL points to; empty: plain value
  std::string found = {};      ///< here: SQL for the row number of the UUID "?"
  Kind kind = Kind::kText;
};

struct CarriedTable {
  std::string name;
  std::vector<Column> columns;
  int keys = 1;           ///< the first so many are the key at the centre
  std::string seal = {};  ///< column at the centre that must be equal where the key is there already
};

/// ruleset, exercise, trainee.
const std::vector<CarriedTable>& carried_bases();
/// Not sealed, may change; only where identities go along.
const CarriedTable& carried_person();
const CarriedTable& carried_attempt();
/// Rows of an attempt, key column 0: its UUID. score comes before what hangs on it.
const std::vector<CarriedTable>& carried_of_attempt();
/// As sealed_tables(), with `digest` as the last column, which no table here has.
const std::vector<CarriedTable>& carried_sealed();
const CarriedTable& carried_sealed(const std::string& name);

/// Rows here whose column 0 is `key`.
std::vector<Values> local_rows(sqlite3* connection, const CarriedTable& table, const std::string& key);

/// Inserts a row here, as it is.
void insert_local(sqlite3* connection, const CarriedTable& table, const Values& row);

std::string create_statement(const CarriedTable& table);

/// Inserts what is not there yet and this login may bring. @returns column 0 of the rows that came in so.
std::vector<std::string> insert_central(CentralLink& link, const CarriedTable& table, const std::vector<Values>& rows,
                                        const std::string& station);

/// Rows at the centre by column 0, in order of the key.
std::vector<Values> central_rows(CentralLink& link, const CarriedTable& table, const std::vector<std::string>& keys);

/// Rows as JSON for json_to_recordset(), by the columns' names at the centre.
std::string json_rows(const CarriedTable& table, const std::vector<Values>& rows);

/// ["a","b"] for json_array_elements_text().
std::string json_list(const std::vector<std::string>& texts);

}  // namespace trocar::sync
