// Reads a table that a spreadsheet wrote: RFC 4180 with whatever separator its language uses.
//
// A UTF-8 byte order mark is passed over; the separator (comma, semicolon, tab) is the one that the first line has most
// of outside quotes, and a first line "sep=;" names it; lines end in LF, CR LF or CR; a quoted field may hold
// separators, doubled quotes and line ends. Empty lines are passed over. Pure. Thread: any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trocar {

struct CsvRow {
  int line = 0;  ///< where it begins, from 1
  std::vector<std::string> fields = {};
};

struct CsvRows {
  char separator = ',';
  bool recoded = false;  ///< the bytes were no UTF-8 and were read as Windows-1252, as Excel writes "CSV" in the West
  std::vector<CsvRow> rows = {};
};

/// @param name for messages. @throws InputError with line and column: UTF-16, a quote that is not closed or stands
/// inside an unquoted field, a zero byte.
CsvRows read_csv(std::string_view bytes, const std::string& name);

}  // namespace trocar
