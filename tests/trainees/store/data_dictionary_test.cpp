// docs/data_dictionary.md names every table, view and column of the schema, and no other.
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::data_dictionary_test {
namespace {

using Columns = std::set<std::string>;  // "table.column"

Columns of_schema() {
  Columns columns;
  Database database(":memory:");
  sql::Statement rows(database.connection(),
                      "SELECT t.name, c.name FROM sqlite_schema t, pragma_table_info(t.name) c"
                      " WHERE t.type IN ('table', 'view') AND t.name NOT LIKE 'sqlite_%'");
  while (rows.step()) columns.insert(rows.text(0) + "." + rows.text(1));
  return columns;
}

/// "### table" and the rows "| `column` | what |" under it.
Columns of_page(std::map<std::string, std::string>& lines) {
  Columns columns;
  std::ifstream in(TROCAR_SOURCE_DIR "/docs/data_dictionary.md");
  std::string table;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("### "))
      table = line.substr(4);
    else if (line.starts_with("| `"))
      columns.insert(table + "." + line.substr(3, line.find('`', 3) - 3));
    else if (!table.empty() && !line.empty() && !line.starts_with("|") && !line.starts_with("#"))
      lines[table] = line;
  }
  return columns;
}

TEST(DataDictionary, NamesEveryTableAndColumnAndNoOther) {
  std::map<std::string, std::string> lines;
  const Columns page = of_page(lines), schema = of_schema();
  EXPECT_GT(schema.size(), 100u);
  for (const std::string& column : schema) EXPECT_TRUE(page.contains(column)) << column << " is not in the dictionary";
  for (const std::string& column : page) EXPECT_TRUE(schema.contains(column)) << column << " is not in the schema";
}

TEST(DataDictionary, CallsSealedWhatIsSealed) {
  std::map<std::string, std::string> lines;
  of_page(lines);
  std::vector<std::string> sealed = sealed_tables();
  sealed.insert(sealed.end(), {"standing", "assignment", "withdrawal"});  // those that stay here
  for (const auto& [table, line] : lines) {
    const bool is_sealed = std::find(sealed.begin(), sealed.end(), table) != sealed.end();
    EXPECT_EQ(line.find("sealed") != std::string::npos, is_sealed) << table;
  }
}

}  // namespace
}  // namespace trocar::data_dictionary_test
