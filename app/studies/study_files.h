// Writes a study: NAME.csv and NAME.svg for each set of curves, its other files, summary.json, table.md. Same result,
// same bytes.
#pragma once

#include <filesystem>
#include <string>

#include "app/studies/study.h"

namespace trocar {

/// {"study","plant","cases":[{"name","value","unit","thesis","bar","met","definition"}]}
std::string summary_json(const StudyResult& result);
/// GitHub table: measure, thesis, ours, asked for.
std::string table_markdown(const StudyResult& result);
std::string curves_csv(const StudyCurves& curves);
/// A whole <svg> document; at most six series.
std::string curves_svg(const StudyCurves& curves);

/// @throws std::filesystem::filesystem_error, EnvironmentError when the folder cannot be written.
void write_study(const StudyResult& result, const std::filesystem::path& folder);

}  // namespace trocar
