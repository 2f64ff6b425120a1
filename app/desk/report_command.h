// `trocar review report`: a report of a trainee, a cohort, an attempt, or a certificate, as PDF or HTML by the file's
// name.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct ReviewReportOptions {
  std::filesystem::path database = {};  ///< empty: the default path
  std::filesystem::path out = {};       ///< NAME.pdf or NAME.html
  std::string trainee = {}, attempt = {}, certificate = {}, group = {};
  bool cohort = false;  ///< exactly one of the four is asked for
  bool notes = false;   ///< notes of instructors too
  bool force = false;   ///< a file of that name gives way
};

/// The file's name is the result. @return exit code 0
/// @throws InputError: not one of the four, another ending, a file that is there, nobody of that name.
/// EnvironmentError: a font is missing.
int review_report(const ReviewReportOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
