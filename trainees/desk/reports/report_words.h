// Words and small blocks that several reports share. Internal to the reports. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trainees/desk/reports/reports.h"

namespace trocar::review {

/// "22 Nov 2026, 13:05"
std::string moment_text(const std::string& utc);
/// "Surface touch L2, mouse"
std::string curve_words(const std::string& exercise, const std::string& level, const std::string& hand);
/// A certificate's evidence as a sentence with its n; text that is no JSON object stays as it is.
std::string evidence_words(const std::string& json);
/// "3 to 5", "4"
std::string span_words(int fewest, int most);
/// "1 Mar 2026 to 9 Apr 2026", the day alone where both are one; "" of nothing.
std::string period_words(const std::string& first_utc, const std::string& last_utc);
printed::Tone tone_of(Flag flag);
/// "passed", "not passed", "no score"
std::string result_words(bool scored, bool passed);
void append(std::vector<printed::Block>& to, std::vector<printed::Block> more);
void note_blocks(std::vector<printed::Block>& to, const std::vector<Note>& notes);
/// "DEMO" or nothing.
std::string mark_of(const ReportSetting& setting);

}  // namespace trocar::review
