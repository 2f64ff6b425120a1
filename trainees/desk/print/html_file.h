// Beginning and end of an HTML file that stands by itself. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "trainees/desk/print/report.h"

namespace trocar::printed {

/// @param title not escaped yet.
std::string html_begin(const std::string& title);
std::string html_end();
/// <colgroup> with the columns' shares.
std::string column_widths(const std::vector<Column>& columns);

}  // namespace trocar::printed
