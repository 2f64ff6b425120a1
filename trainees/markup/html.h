// Small building blocks of HTML and SVG text: escaping and numbers.
//
// Every string that comes from outside the program passes through escape_html before it enters a page. Thread: any.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

namespace trocar {

/// Safe inside text and inside double-quoted attributes: & < > " ' are replaced, control characters other than tab and
/// newline become U+FFFD, and so does every byte that is not part of well-formed UTF-8.
std::string escape_html(const std::string& text);

/// Four significant digits without trailing zeros; "n/a" for NaN or infinity.
std::string number_text(double value);

/// Fixed decimals.
std::string fixed_text(double value, int decimals);

/// A value in the unit that reads best: metres below 10 m become millimetres, shares stay as they are.
std::pair<double, std::string> readable_unit(double value, const std::string& unit);

/// "312 mm"; "undefined" when empty. Not escaped.
std::string quantity_text(const std::optional<double>& value, const std::string& unit);

/// Standard base64 (RFC 4648) with padding.
std::string base64(std::span<const unsigned char> bytes);

/// "TARGET_HELD" or "time_in_band" as words: "Target held", "Time in band".
std::string words_of(const std::string& identifier);
std::string lower_words_of(const std::string& identifier);  ///< "force max n"

}  // namespace trocar
