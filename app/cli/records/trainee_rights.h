// `trocar trainee erase|export|note|consent` and `trocar db retention`: what a person may ask of the record, and what
// is said of one. Results on `out`, messages on `err`; InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct TraineeRightsOptions {
  std::filesystem::path database;  ///< empty: the default path
  std::string code;
  bool training = false;  ///< of erase and retention: the training data, too
  bool yes = false;       ///< of erase and retention: without it only told what would go (InputError)
  std::string reason = "request of the person";
  std::filesystem::path output;  ///< of export; empty: standard output
  std::string text, attempt;     ///< of note; attempt: "latest" or a part of its UUID, empty: of the trainee
  std::string author;            ///< as printed; empty: who runs the program
  std::string purpose;           ///< of consent
  bool withdrawn = false;
  int days = 0;  ///< of retention
  bool erase = false;
};

/// @return exit code 0; 3 when something could not be removed (named on `err`).
int trainee_erase(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err);
/// Everything kept of one person as JSON. Never overwrites (InputError); the file is for its owner's eyes only. @return
/// exit code 0
int trainee_export(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err);
/// A note that the trainee meets first next time. @return exit code 0; its UUID is the result.
int trainee_note(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err);
/// @return exit code 0; what holds of every purpose is the result.
int trainee_consent(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err);
/// Trainees whose newest attempt is older than so many days; with `erase` what would go of each, with `yes` too it
/// goes.
/// @return exit code 0; 3 as erase. @throws InputError: somebody would be erased and `yes` is missing.
int db_retention(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
