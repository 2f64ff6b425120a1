#include "app/cli/command_line_trainees.h"

#include <iostream>

#include <CLI/CLI.hpp>

#include "app/cli/records/cohort_command.h"
#include "app/cli/records/db_command.h"
#include "app/cli/records/sync_command.h"
#include "app/cli/records/trainee_command.h"
#include "app/cli/records/trainee_rights.h"
#include "app/session/setup/typed_path.h"

namespace trocar {

struct TraineeCommandLine {
  TraineeOptions trainee;
  TraineeRightsOptions rights;
  CohortOptions cohort;
  DbOptions db;
  SyncOptions sync;
  SyncLinkOptions link;
  std::function<void(std::function<int()>)> choose;

  template <class Options>
  CLI::App* add(CLI::App& parent, const char* name, int (*action)(const Options&, std::ostream&, std::ostream&),
                const Options& options, const char* help) {
    CLI::App* command = parent.add_subcommand(name, help);
    command->callback(
        [this, action, &options] { choose([action, &options] { return action(options, std::cout, std::cerr); }); });
    return command;
  }
};

namespace {

using Line = TraineeCommandLine;

const CLI::Validator kTraineePath([](std::string& path) { return typed_path_fault(path); }, "PATH");

CLI::App* group(CLI::App& app, const char* name, const char* help) {
  CLI::App* command = app.add_subcommand(name, help);
  command->require_subcommand(1);
  return command;
}

void add_looking(Line& c, CLI::App& app, CLI::App& trainee) {
  CLI::App* add = c.add(trainee, "add", trainee_add, c.trainee, "Add a trainee");
  CLI::App* list = c.add(trainee, "list", trainee_list, c.trainee, "All trainees");
  CLI::App* show = c.add(trainee, "show", trainee_show, c.trainee, "One trainee's attempts");
  CLI::App* edit =
      c.add(trainee, "edit", trainee_edit, c.trainee, "Name and e-mail address, which an erasure takes along");
  edit->add_option("--name", c.trainee.name, "Name; '' takes it away");
  edit->add_option("--email", c.trainee.email, "E-mail address; '' takes it away");
  for (CLI::App* command : {add, show, edit}) command->add_option("code", c.trainee.code, "Trainee code")->required();
  show->add_option("--limit", c.trainee.limit, "Newest attempts listed, 0: all")->capture_default_str();
  for (CLI::App* command : {add, list, show, edit}) {
    command->add_option("--db", c.trainee.database, "Database file")->check(kTraineePath);
    command->add_flag("--json", c.trainee.json, "As JSON");
  }
  CLI::App* cohort = c.add(app, "cohort", cohort_command, c.cohort, "Who tried what, how often, how well");
  cohort->add_option("--db", c.cohort.database, "Database file");
  cohort->add_option("--trainee", c.cohort.trainee, "One trainee only");
  cohort->add_flag("--json", c.cohort.json, "As JSON");
}

void add_rights(Line& c, CLI::App& trainee) {
  CLI::App* note = c.add(trainee, "note", trainee_note, c.rights, "A note that the trainee meets first next time");
  CLI::App* all = c.add(trainee, "export", trainee_export, c.rights, "Everything kept of one person, as JSON");
  CLI::App* consent = c.add(trainee, "consent", trainee_consent, c.rights,
                            "What a trainee consented to; with a purpose: consent given or withdrawn");
  CLI::App* erase =
      c.add(trainee, "erase", trainee_erase, c.rights, "Erase who a trainee is; attempts stay without a name");
  for (CLI::App* command : {note, all, consent, erase}) {
    command->add_option("code", c.rights.code, "Trainee code, or what an erasure printed: erased-... or the UUID")
        ->required();
    command->add_option("--db", c.rights.database, "Database file");
  }
  note->add_option("text", c.rights.text, "What it says, up to 4000 characters")->required();
  note->add_option("--attempt", c.rights.attempt,
                   "Of one attempt: 'latest' of the trainee, its number, or a part of its UUID");
  all->add_option("-o,--out", c.rights.output, "File (default: standard output)")->check(kTraineePath);
  CLI::Option* purpose = consent->add_option("--purpose", c.rights.purpose, "What for: research, ...");
  consent->add_option("--text", c.rights.text, "The words that were agreed to or withdrawn")->needs(purpose);
  consent->add_flag("--withdrawn", c.rights.withdrawn, "Withdrawn, not given")->needs(purpose);
  for (CLI::App* command : {note, consent, erase})
    command->add_option("--author", c.rights.author, "Who says so (default: $USER)");
  erase->add_flag("--training", c.rights.training, "Every number and recording of theirs, too");
  erase->add_option("--reason", c.rights.reason, "Kept with the erasure")->capture_default_str();
  erase->add_flag("--yes", c.rights.yes, "It cannot be undone");
}

void add_db(Line& c, CLI::App& app) {
  CLI::App* db = group(app, "db", "The database itself");
  CLI::App* check = c.add(*db, "check", db_check, c.db,
                          "File, schema, references, hash chain, audit trail, what people wrote, recordings");
  check->add_flag("--json", c.db.json, "As JSON");
  CLI::App* backup = c.add(*db, "backup", db_backup, c.db, "Consistent copy");
  backup->add_option("-o,--out", c.db.output, "File (default: beside the database)")->check(kTraineePath);
  CLI::App* migrate = c.add(*db, "migrate", db_migrate, c.db, "Bring to this program's schema");
  CLI::App* anchor = c.add(*db, "anchor", db_anchor, c.db, "Begin a new anchor file where the old one was lost");
  CLI::App* rubric = c.add(*db, "rubric", db_rubric, c.db, "Print the exercise file that attempts were graded by");
  rubric->add_option("sha256", c.db.rubric, "At least 4 digits of its sha256")->required();
  for (CLI::App* command : {check, backup, migrate, anchor, rubric})
    command->add_option("--db", c.db.database, "Database file");
  CLI::App* retention = c.add(*db, "retention", db_retention, c.rights, "Trainees who have not been here for long");
  retention->add_option("--days", c.rights.days, "Since their newest attempt")->required()->check(CLI::Range(1, 36500));
  CLI::Option* erase = retention->add_flag("--erase", c.rights.erase, "Who they are, listed; erased with --yes");
  retention->add_flag("--training", c.rights.training, "Every number and recording of theirs, too")->needs(erase);
  retention->add_option("--author", c.rights.author, "Who says so (default: $USER)")->needs(erase);
  retention->add_flag("--yes", c.rights.yes, "Erase them; it cannot be undone")->needs(erase);
  retention->add_option("--db", c.rights.database, "Database file");
}

void add_links(Line& c, CLI::App& sync) {
  CLI::App* link = c.add(sync, "link", sync_link, c.link, "Two trainees are one person, who practises at two stations");
  CLI::App* unlink = c.add(sync, "unlink", sync_unlink, c.link, "Two who were linked are two people after all");
  for (CLI::App* command : {link, unlink}) {
    command->add_option("one", c.link.one, "CODE@STATION, or the trainee's UUID")->required();
    command->add_option("other", c.link.other, "Likewise")->required();
    command->add_option("--at", c.link.at, "postgresql://USER@HOST/DATABASE")->required();
    command->add_option("--password-file", c.link.password_file,
                        "First line: the password (else PGPASSWORD, ~/.pgpass)");
    command->add_option("--author", c.link.author, "Who says so (default: $USER)");
  }
}

void add_sync(Line& c, CLI::App& app) {
  CLI::App* sync =
      c.add(app, "sync", sync_command, c.sync,
            "This station's record to a central PostgreSQL database, or all stations' into a file for a desk");
  CLI::Option* to =
      sync->add_option("--to", c.sync.to,
                       "postgresql://USER@HOST/DATABASE: push what is finished, fetch rules, and what was said of"
                       " the people here");
  CLI::Option* from = sync->add_option(
      "--from", c.sync.from, "postgresql://USER@HOST/DATABASE: fetch what all stations pushed into --db FILE");
  to->excludes(from);
  sync->add_option("--password-file", c.sync.password_file, "First line: the password (else PGPASSWORD, ~/.pgpass)");
  sync->add_option("--station", c.sync.station, "Name of this station (default: the host's)")->needs(to);
  sync->add_flag("--new-station", c.sync.new_station,
                 "Go on under a new UUID: an older copy was put back, or the database was copied")
      ->needs(to);
  sync->add_flag("--with-identity", c.sync.with_identity, "Also codes, names and e-mail addresses")->needs(to);
  sync->add_flag("--apply-erasures", c.sync.apply_erasures, "Erase here too whom another station erased")->needs(to);
  sync->add_option("--db", c.sync.database, "Database file");
  sync->add_flag("--json", c.sync.json, "As JSON");
  sync->add_flag("--recordings", c.sync.recordings, "Also the recordings of attempts; motion tells who moved");
  add_links(c, *sync);
  sync->callback([&c, sync] {
    if (sync->get_subcommands().empty()) c.choose([&c] { return sync_command(c.sync, std::cout, std::cerr); });
  });
}

}  // namespace

std::shared_ptr<TraineeCommandLine> add_trainee_commands(CLI::App& app,
                                                         const std::function<void(std::function<int()>)>& choose) {
  auto c = std::make_shared<TraineeCommandLine>();
  c->choose = choose;
  CLI::App* trainee = group(app, "trainee", "Trainees of a database");
  add_looking(*c, app, *trainee);
  add_rights(*c, *trainee);
  add_db(*c, app);
  add_sync(*c, app);
  return c;
}

}  // namespace trocar
