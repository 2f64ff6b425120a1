#include "trainees/records/people_import.h"

#include <algorithm>
#include <map>

#include "haptics/input_error.h"
#include "haptics/utf8.h"
#include "trainees/files/csv_rows.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/signing.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"

namespace trocar {
namespace {

constexpr std::size_t kLongestGroup = 64;

std::string small(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

std::string trimmed(const std::string& text) {
  constexpr const char* kBlank = " \t\r\n";
  std::string out = text;
  for (std::size_t at; (at = out.find("\xC2\xA0")) != std::string::npos;)
    out.replace(at, 2, " ");  // as pages have them
  const std::size_t first = out.find_first_not_of(kBlank);
  return first == std::string::npos ? "" : out.substr(first, out.find_last_not_of(kBlank) - first + 1);
}

enum class ImportColumn : std::uint8_t { kCode, kName, kFirst, kLast, kEmail, kGroup };
constexpr std::pair<const char*, ImportColumn> kColumnNames[] = {
    {"code", ImportColumn::kCode},           {"k\xC3\xBCrzel", ImportColumn::kCode}, {"kuerzel", ImportColumn::kCode},
    {"name", ImportColumn::kName},           {"first name", ImportColumn::kFirst},   {"vorname", ImportColumn::kFirst},
    {"pr\xC3\xA9nom", ImportColumn::kFirst}, {"last name", ImportColumn::kLast},     {"surname", ImportColumn::kLast},
    {"nachname", ImportColumn::kLast},       {"nom", ImportColumn::kLast},           {"email", ImportColumn::kEmail},
    {"e-mail", ImportColumn::kEmail},        {"mail", ImportColumn::kEmail},         {"group", ImportColumn::kGroup},
    {"gruppe", ImportColumn::kGroup},        {"groupe", ImportColumn::kGroup},
};

std::map<ImportColumn, std::size_t> columns_of(const CsvRow& head, const std::string& name,
                                               std::vector<std::string>& remarks) {
  std::map<ImportColumn, std::size_t> out;
  for (std::size_t i = 0; i < head.fields.size(); ++i) {
    const std::string word = small(trimmed(head.fields[i]));
    const auto* at = std::find_if(std::begin(kColumnNames), std::end(kColumnNames),
                                  [&](const auto& known) { return word == known.first; });
    if (at == std::end(kColumnNames)) {
      if (!word.empty()) remarks.push_back("column \"" + trimmed(head.fields[i]) + "\" is not used");
      continue;
    }
    if (!out.emplace(at->second, i).second)
      throw InputError(name, head.line, 1, "two columns for the same: \"" + trimmed(head.fields[i]) + "\"");
  }
  if (!out.contains(ImportColumn::kCode))
    throw InputError(
        name, head.line, 1, "the first line names the columns, and one of them must be \"code\"; found are: " + [&] {
          std::string all;
          for (const std::string& field : head.fields) all += (all.empty() ? "" : ", ") + trimmed(field);
          return all;
        }());
  return out;
}

ImportRow row_of(const CsvRow& row, const std::map<ImportColumn, std::size_t>& columns, const std::string& group) {
  const auto field = [&](ImportColumn column) {
    const auto at = columns.find(column);
    return at == columns.end() || at->second >= row.fields.size() ? std::string() : trimmed(row.fields[at->second]);
  };
  ImportRow out{row.line, field(ImportColumn::kCode), field(ImportColumn::kName), field(ImportColumn::kEmail),
                field(ImportColumn::kGroup)};
  if (out.name.empty()) out.name = trimmed(field(ImportColumn::kFirst) + " " + field(ImportColumn::kLast));
  if (out.group.empty()) out.group = group;
  return out;
}

/// As much of a refused row as tells which it is: its fields may be a file long.
void shorten(ImportRow& row) {
  constexpr std::size_t kShown = 80;
  for (std::string* field : {&row.code, &row.name, &row.email, &row.group}) {
    if (field->size() <= kShown) continue;
    std::size_t end = 0;
    for (std::size_t one = 0; (one = utf8_length(*field, end)) > 0 && end + one <= kShown;) end += one;
    *field = field->substr(0, end) + "...";
  }
}

/// What is wrong with what stands in the row, whoever it is.
void check_row(const ImportRow& row) {
  if (row.code.empty()) throw InputError("has no code");
  check_trainee_code(row.code);
  for (const char* taken : {"guest", "demonstration", "unnamed-", "erased-"})
    if (small(row.code).starts_with(taken)) throw InputError("\"" + row.code + "\" is a code that the program gives");
  if (!row.name.empty()) check_printed("name", row.name);
  if (!row.email.empty()) check_address(row.email);
  if (!row.group.empty()) check_printed("group", row.group, kLongestGroup);
}

class PeopleLook {
 public:
  explicit PeopleLook(sqlite3* connection) : connection_(connection), away_(deactivated(connection)) {}

  void judge(ImportRow& row) {
    const std::string key = small(row.code);
    try {
      check_row(row);
      if (const auto before = lines_.find(key); before != lines_.end())
        throw InputError("the code stands in line " + std::to_string(before->second) + " already");
    } catch (const InputError& error) {
      row.fate = RowFate::kRefused;
      row.reason = error.what();
      shorten(row);
      return;
    }
    lines_.emplace(key, row.line);
    sql::Statement known(connection_, "SELECT trainee_id, name, email FROM person WHERE code = ?");
    if (!known.bind(row.code).step()) return;
    const std::int64_t trainee = known.integer(0);
    row.reason = "is there already";
    if (!row.name.empty() && row.name != known.text(1))
      row.reason += known.text(1).empty() ? " without a name, which is left so" : " as " + known.text(1);
    if (away_.contains(trainee)) row.reason += ", deactivated";
    sql::Statement member(connection_, "SELECT 1 FROM membership WHERE trainee_id = ? AND group_name = ?");
    const bool joins = !row.group.empty() && !member.bind(trainee).bind(row.group).step();
    row.fate = joins ? RowFate::kJoins : RowFate::kThere;
  }

 private:
  sqlite3* connection_;
  std::set<std::int64_t> away_;
  std::map<std::string, int> lines_ = {};
};

ImportPreview looked_at(sqlite3* connection, std::string_view csv, const std::string& name, const std::string& group) {
  if (!group.empty()) check_printed("group", group, kLongestGroup);  // once: each row would repeat it
  const CsvRows read = read_csv(csv, name);
  if (read.rows.empty()) throw InputError(name + ": is empty");
  ImportPreview out;
  if (read.recoded)
    out.remarks.emplace_back("the file is no UTF-8 and was read as Windows-1252: look at the letters of the names");
  const auto columns = columns_of(read.rows.front(), name, out.remarks);
  if (read.rows.size() < 2) throw InputError(name + ": has a first line and nobody below it");
  if (read.rows.size() > kMostImported + 1)
    throw InputError(name + ": has more than " + std::to_string(kMostImported) + " rows");
  PeopleLook look(connection);
  for (std::size_t i = 1; i < read.rows.size(); ++i) {
    ImportRow row = row_of(read.rows[i], columns, group);
    look.judge(row);
    if (read.rows[i].fields.size() > read.rows.front().fields.size()) {
      row.fate = RowFate::kRefused;
      row.reason = "has " + std::to_string(read.rows[i].fields.size()) + " fields, the first line " +
                   std::to_string(read.rows.front().fields.size());
    }
    out.rows.push_back(std::move(row));
  }
  return out;
}

void take_row(sqlite3* connection, TraineeStore& people, const ImportRow& row, const Author& author) {
  const std::int64_t trainee = people.ensure_id(row.code);
  sql::Statement uuid(connection, "SELECT uuid FROM trainee WHERE id = ?");
  uuid.bind(trainee).step();
  if (row.fate == RowFate::kNew && (!row.name.empty() || !row.email.empty())) {
    sql::Statement named(connection, "UPDATE person SET name = ?, email = ? WHERE trainee_id = ?");
    named.bind(row.name).bind(row.email).bind(trainee).run();
    keep_person(connection, uuid.text(0), author.account_uuid);
  }
  if (row.group.empty()) return;
  sql::Statement joined(connection, "INSERT OR IGNORE INTO membership VALUES (?, ?) RETURNING 1");
  const bool fresh = joined.bind(trainee).bind(row.group).step();
  joined.run();
  if (fresh)
    append_audit(connection, "group joined", uuid.text(0), row.group,
                 author.account_uuid.empty() ? "trocar" : author.account_uuid);
}

}  // namespace

const char* fate_words(RowFate fate) {
  switch (fate) {
    case RowFate::kNew:
      return "added";
    case RowFate::kJoins:
      return "joins the group";
    case RowFate::kThere:
      return "skipped";
    case RowFate::kRefused:
      return "refused";
  }
  return "";
}

int ImportPreview::count(RowFate fate) const {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [fate](const ImportRow& row) { return row.fate == fate; }));
}

ImportPreview preview_people(Database& database, std::string_view csv, const std::string& name,
                             const std::string& group) {
  return looked_at(database.connection(), csv, name, group);
}

ImportPreview take_people(Database& database, std::string_view csv, const std::string& name, const std::string& group,
                          const Author& author) {
  AnchoredTransaction transaction(database);
  require_key(database);
  ImportPreview out = looked_at(database.connection(), csv, name, group);
  TraineeStore people(database);
  for (const ImportRow& row : out.rows)
    if (row.fate == RowFate::kNew || row.fate == RowFate::kJoins) take_row(database.connection(), people, row, author);
  transaction.commit();
  return out;
}

void add_person(Database& database, const ImportRow& person, const Author& author) {
  AnchoredTransaction transaction(database);
  require_key(database);
  ImportRow row = person;
  PeopleLook(database.connection()).judge(row);
  if (row.fate != RowFate::kNew) throw InputError("trainee \"" + row.code + "\": " + row.reason);
  TraineeStore people(database);
  take_row(database.connection(), people, row, author);
  transaction.commit();
}

}  // namespace trocar
