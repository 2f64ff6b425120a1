// `trocar programme list|show|save|assign|withdraw|grid|reminders`: what people have to do by when, and who is late.
// Results on `out`, messages on `err`; InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct ProgrammeOptions {
  std::filesystem::path database;  ///< empty: the default path
  std::string name;                ///< of the programme; of reminders "" for all
  std::filesystem::path text;      ///< of save
  std::string trainee, group;      ///< of assign: one of both; of grid and reminders: that group alone
  std::string due;                 ///< of assign: "2026-06-30", "" none
  std::string assignment, reason;  ///< of withdraw
  std::string author;              ///< as printed; empty: who runs the program
  int days = 14;                   ///< of reminders
  bool deactivated = false;        ///< of grid: those too
  bool csv = false;                ///< of grid and reminders
};

/// Each returns the exit code 0. Programmes and the assignments that hold.
int programme_list(const ProgrammeOptions& options, std::ostream& out, std::ostream& err);
/// Its text. @throws InputError: there is none.
int programme_show(const ProgrammeOptions& options, std::ostream& out, std::ostream& err);
/// The next version from a text. @throws InputError with line and column.
int programme_save(const ProgrammeOptions& options, std::ostream& out, std::ostream& err);
int programme_assign(const ProgrammeOptions& options, std::ostream& out, std::ostream& err);
int programme_withdraw(const ProgrammeOptions& options, std::ostream& out, std::ostream& err);
int programme_grid_command(const ProgrammeOptions& options, std::ostream& out, std::ostream& err);
int programme_reminders(const ProgrammeOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
