// Fields of a CSV file: RFC 4180, UTF-8, lines end in CR LF, numbers to the bit.
//
// Text that a spreadsheet would run as a formula is defused: a field of a text column that begins with = + - @, tab, CR
// or LF gets an apostrophe in front, and so does one that begins with an apostrophe; likewise = + - @ and apostrophe
// after a semicolon, where spreadsheets of other countries begin a cell. Taking one apostrophe away in front and after
// each semicolon gives the text back. Pure. Thread: any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trocar {

/// A field of a text column: defused, quoted where RFC 4180 asks for it.
std::string csv_text(std::string_view text);
/// Shortest decimal that reads back to the same bits; "" for NaN, "inf", "-inf".
std::string csv_number(double value);
/// Fields joined by commas, with CR LF. @param fields as they came from the functions above.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace trocar
