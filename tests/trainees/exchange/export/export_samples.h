// Readers that know nothing of the writers, a database with everything that is exported, and movements with known
// numbers.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scoring/trace.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/exchange/export/xapi.h"

namespace trocar::test {

using CsvTable = std::vector<std::vector<std::string>>;

/// RFC 4180 read strictly: lines end in CR LF, quotes only where a field begins. Fails the test on anything else.
CsvTable read_csv(const std::string& text);
/// Cell of the line whose first cell is `key`, under a header; "?" when there is none.
std::string cell_of(const CsvTable& table, const std::string& key, const std::string& header);

std::string bytes_of_file(const std::filesystem::path& file);

/// Names in a folder, sorted; hidden ones too.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// A graded attempt with all fields that a statement has.
XapiAttempt sample_xapi(double score = 81.25);

/// A tip on a sum of slow sines within 10 cm, the shaft leaning, the jaws opening; mirrored about x when left.
Trace sample_motion(double rate_hz, double seconds, bool mirrored = false);

/// A trace of 30 Hz in the columns of JIGSAWS, as the right slave.
std::string jigsaws_layout(const Trace& trace);

}  // namespace trocar::test
