#include "app/cli/records/trainee_rights.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <set>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/records/open_database.h"
#include "app/cli/text_table.h"
#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/records/assessments.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/consents.h"
#include "trainees/records/erasure.h"
#include "trainees/records/trainee_store.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr int kSomethingLeft = 3;

Trainee required(Database& database, const std::string& code) {
  const auto trainee = TraineeStore(database).find(code);
  if (!trainee) throw InputError(database.file().string() + ": no trainee \"" + code + "\"");
  return *trainee;
}

std::string counted(std::size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

ErasureKind kind_of(const TraineeRightsOptions& options) {
  return options.training ? ErasureKind::kTraining : ErasureKind::kIdentity;
}

/// "2 notes, 1 consent" of what there is.
std::string listed_rights(const std::vector<std::pair<int, std::string>>& parts) {
  std::string all;
  for (const auto& [count, what] : parts)
    if (count > 0) all += (all.empty() ? "" : ", ") + counted(static_cast<std::size_t>(count), what);
  return all.empty() ? "nothing more" : all;
}

std::string with_it(const ErasurePreview& p) {
  return listed_rights({{p.notes, "note"},
                        {p.consents, "consent"},
                        {p.groups, "group"},
                        {p.accounts, "account"},
                        {p.assessments, "opinion"},
                        {p.certificates, "certificate"},
                        {p.recordings, "recording"}});
}

void print_previews(const std::vector<ErasurePreview>& previews, bool training, std::ostream& out) {
  TextTable table(
      {{"trainee"}, {"last (UTC)"}, {"attempts", TextTable::Align::kRight}, {"they"}, {"goes with name and code"}});
  for (const ErasurePreview& p : previews)
    table.add(
        {p.code, cell_time(p.last_utc), std::to_string(p.attempts), training ? "are emptied" : "stay", with_it(p)});
  table.print(out);
}

int erase_one(Database& database, const std::string& code, const TraineeRightsOptions& options, const std::string& rule,
              std::ostream& out, std::ostream& err) {
  const ErasureReport report = erase_trainee(database, code, kind_of(options), rule, author_said(options.author));
  const auto notes = static_cast<std::size_t>(report.notes), attempts = static_cast<std::size_t>(report.attempts);
  out << code << ": identity erased, " << counted(notes, "note") << " with it; " << counted(attempts, "attempt")
      << (options.training ? " emptied, " + counted(report.recordings.size(), "file") + " of recordings removed"
                           : " kept without a name")
      << " (" << report.trainee_uuid << ", from now on erased-" << report.trainee_uuid.substr(28) << ")\n";
  for (const std::string& left : report.left) err << left << '\n';
  return report.left.empty() ? 0 : kSomethingLeft;
}

/// One who cannot be erased now keeps nobody else.
int erase_all(Database& database, const std::vector<std::string>& codes, const TraineeRightsOptions& options,
              std::ostream& out, std::ostream& err) {
  const std::string rule = "retention " + std::to_string(options.days) + " days";
  int code = 0;
  for (const std::string& trainee : codes) {
    try {
      code = std::max(code, erase_one(database, trainee, options, rule, out, err));
    } catch (const InputError& error) {
      err << error.what() << '\n';
      code = kSomethingLeft;
    }
  }
  return code;
}

}  // namespace

int trainee_erase(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const Trainee trainee = required(database, options.code);
  if (!options.yes) {
    print_previews({preview_erasure(database, trainee.code, kind_of(options))}, options.training, out);
    throw InputError("trainee " + trainee.code + " (" + counted(static_cast<std::size_t>(trainee.attempts), "attempt") +
                     "): " +
                     (options.training ? "name, code, notes, consents, sign-in, every number and every recording"
                                       : "name, code, notes, consents and sign-in") +
                     " would be erased, which cannot be undone; say --yes");
  }
  return erase_one(database, trainee.code, options, options.reason, out, err);
}

int trainee_export(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const std::string all = everything_about(database, options.code);
  if (options.output.empty()) {
    out << all;
    return 0;
  }
  if (fs::exists(options.output))
    throw InputError(options.output.string() + ": exists already; an export never overwrites");
  std::ofstream file = open_owner_file(options.output);
  if (!(file << all) || !file.flush()) throw EnvironmentError(options.output.string() + ": cannot be written");
  out << options.output.string() << '\n';
  return 0;
}

int trainee_note(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  std::string attempt;
  if (options.attempt == "latest") {
    const auto latest = AttemptStore(database).latest(required(database, options.code).code);
    if (!latest) throw InputError("trainee " + options.code + ": has no attempt yet");
    attempt = latest->uuid;
  } else if (!options.attempt.empty()) {
    attempt = AttemptStore(database).find(options.attempt).uuid;
  }
  out << AssessmentStore(database).add_note(options.code, attempt, options.text, author_said(options.author)).uuid
      << '\n';
  return 0;
}

int trainee_consent(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  ConsentStore consents(database);
  const std::string code = required(database, options.code).code;
  if (!options.purpose.empty())
    consents.record(code, options.purpose, !options.withdrawn, options.text, author_said(options.author));
  std::set<std::string> told;
  TextTable table({{"purpose"}, {"consent"}, {"since (UTC)"}, {"words"}});
  for (const Consent& consent : consents.of(code)) {
    if (!told.insert(consent.purpose).second) continue;  // an older one
    table.add({consent.purpose, consent.given ? "given" : "withdrawn", cell_time(consent.utc), consent.text});
  }
  if (told.empty())
    out << code << ": no consent is recorded\n";
  else
    table.print(out);
  return 0;
}

int db_retention(const TraineeRightsOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const std::vector<std::string> codes = older_than(database, options.days, utc_now());
  if (options.erase && !codes.empty()) {
    if (options.yes) return erase_all(database, codes, options, out, err);
    std::vector<ErasurePreview> previews;
    for (const std::string& trainee : codes) previews.push_back(preview_erasure(database, trainee, kind_of(options)));
    print_previews(previews, options.training, out);
    throw InputError("nobody was erased: " + counted(codes.size(), "trainee") +
                     " would be, which cannot be undone; say --yes");
  }
  TextTable table({{"trainee"}, {"attempts", TextTable::Align::kRight}, {"last (UTC)"}, {"since (UTC)"}});
  for (const std::string& trainee : codes) {
    const Trainee row = required(database, trainee);
    table.add({row.code, std::to_string(row.attempts), cell_time(row.last_utc), cell_time(row.created_utc)});
  }
  if (codes.empty())
    out << "nobody: every trainee was here within " << options.days << " days\n";
  else
    table.print(out);
  return 0;
}

void add_trainee_rights(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<TraineeRightsOptions>();
  TraineeRightsOptions& o = *given;
  CLI::App* note = add_command(parent, "note", "A note that the trainee meets first next time", chosen,
                               [given] { return trainee_note(*given, std::cout, std::cerr); });
  CLI::App* all = add_command(parent, "export", "Everything kept of one person, as JSON", chosen,
                              [given] { return trainee_export(*given, std::cout, std::cerr); });
  CLI::App* consent =
      add_command(parent, "consent", "What a trainee consented to; with a purpose: consent given or withdrawn", chosen,
                  [given] { return trainee_consent(*given, std::cout, std::cerr); });
  CLI::App* erase = add_command(parent, "erase", "Erase who a trainee is; attempts stay without a name", chosen,
                                [given] { return trainee_erase(*given, std::cout, std::cerr); });
  for (CLI::App* command : {note, all, consent, erase}) {
    command->add_option("code", o.code, "Trainee code, or what an erasure printed: erased-... or the UUID")->required();
    command->add_option("--db", o.database, "Database file");
  }
  note->add_option("text", o.text, "What it says, up to 4000 characters")->required();
  note->add_option("--attempt", o.attempt,
                   "Of one attempt: 'latest' of the trainee, its number, or a part of its UUID");
  all->add_option("-o,--out", o.output, "File (default: standard output)")->check(writable_path());
  CLI::Option* purpose = consent->add_option("--purpose", o.purpose, "What for: research, ...");
  consent->add_option("--text", o.text, "The words that were agreed to or withdrawn")->needs(purpose);
  consent->add_flag("--withdrawn", o.withdrawn, "Withdrawn, not given")->needs(purpose);
  for (CLI::App* command : {note, consent, erase})
    command->add_option("--author", o.author, "Who says so (default: $USER)");
  erase->add_flag("--training", o.training, "Every number and recording of theirs, too");
  erase->add_option("--reason", o.reason, "Kept with the erasure")->capture_default_str();
  erase->add_flag("--yes", o.yes, "It cannot be undone");
}

void add_db_retention(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<TraineeRightsOptions>();
  TraineeRightsOptions& o = *given;
  CLI::App* retention = add_command(parent, "retention", "Trainees who have not been here for long", chosen,
                                    [given] { return db_retention(*given, std::cout, std::cerr); });
  retention->add_option("--days", o.days, "Since their newest attempt")->required()->check(CLI::Range(1, 36500));
  CLI::Option* erase = retention->add_flag("--erase", o.erase, "Who they are, listed; erased with --yes");
  retention->add_flag("--training", o.training, "Every number and recording of theirs, too")->needs(erase);
  retention->add_option("--author", o.author, "Who says so (default: $USER)")->needs(erase);
  retention->add_flag("--yes", o.yes, "Erase them; it cannot be undone")->needs(erase);
  retention->add_option("--db", o.database, "Database file");
}

}  // namespace trocar
