// Many people at once from a table that a spreadsheet wrote: first looked at, then taken, all in one transaction.
//
// The first line names the columns: code, and any of name (or first name and last name), e-mail, group; also in German
// and French. Other columns are passed over and told. Nothing is written before take_people(), which looks again: what
// another desk has done in between counts. Thread: that of the Database.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trainees/records/assessments.h"

namespace trocar {

enum class RowFate : std::uint8_t {
  kNew,      ///< is added
  kJoins,    ///< is there already, joins the group
  kThere,    ///< is there already: nothing to do
  kRefused,  ///< cannot be taken
};
const char* fate_words(RowFate fate);  ///< "added", "joins the group", "skipped", "refused"

struct ImportRow {
  int line = 0;
  std::string code = {}, name = {}, email = {}, group = {};
  RowFate fate = RowFate::kNew;
  std::string reason = {};  ///< why it is skipped or refused
};

struct ImportPreview {
  std::vector<ImportRow> rows = {};
  std::vector<std::string> remarks = {};  ///< on the whole file: a column passed over, how it was read
  int count(RowFate fate) const;
};

inline constexpr std::size_t kMostImported = 5000;

/// @param name of the file, for messages. @param group of rows that name none; "": none.
/// @throws InputError with line: as read_csv(), no column "code", a column twice, no row, more than kMostImported.
ImportPreview preview_people(Database& database, std::string_view csv, const std::string& name,
                             const std::string& group);

/// Adds who is new and joins groups; what is refused stays out. All in one transaction. @returns what was done.
ImportPreview take_people(Database& database, std::string_view csv, const std::string& name, const std::string& group,
                          const Author& author);

/// One person. @throws InputError: why it is refused, or the code is there already.
void add_person(Database& database, const ImportRow& person, const Author& author);

}  // namespace trocar
