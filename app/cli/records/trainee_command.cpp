#include "app/cli/records/trainee_command.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/records/cohort_command.h"
#include "app/cli/records/open_database.h"
#include "app/cli/records/store_json.h"
#include "app/cli/text_table.h"
#include "haptics/input_error.h"
#include "trainees/desk/queries/programme_query.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/standings.h"

namespace trocar {
namespace {

using Side = TextTable::Align;

/// "yes" or "no" as it counts; with who decided it where somebody did.
std::string verdict_cell(const AttemptSummary& attempt) {
  return std::string(attempt.passed ? "yes" : "no") + (attempt.decided_by.empty() ? "" : ", by " + attempt.decided_by) +
         (attempt.soft_real_time ? ", soft real time" : "");
}

void print_attempts(const std::vector<AttemptSummary>& attempts, std::ostream& out) {
  TextTable table({{"no.", Side::kRight},
                   {"started (UTC)"},
                   {"exercise"},
                   {"rubric"},
                   {"level"},
                   {"board", Side::kRight},
                   {"hand"},
                   {"status"},
                   {"score", Side::kRight},
                   {"grade"},
                   {"passed"},
                   {"organ"},
                   {"attempt"}});
  for (const AttemptSummary& attempt : attempts) {
    table.add({std::to_string(attempt.row), cell_time(attempt.started_utc), attempt.exercise_id,
               cell_rubric(attempt.exercise_version, attempt.rubric_sha256), attempt.level,
               std::to_string(attempt.board), attempt.hand, attempt.status, cell(attempt.score, 1), attempt.grade,
               verdict_cell(attempt), attempt.organ_synthetic ? "synthetic" : "", attempt.uuid});
  }
  table.print(out);
}

void print_person(const Trainee& trainee, std::ostream& out) {
  out << trainee.code << "  " << trainee.uuid << '\n';
  if (!trainee.name.empty() || !trainee.email.empty()) {
    out << trainee.name << (trainee.name.empty() || trainee.email.empty() ? "" : ", ") << trainee.email << '\n';
  }
}

/// What the rules say of each curve, with what they rest on.
void print_judgements(const std::vector<CohortLine>& lines, std::ostream& out) {
  TextTable table({{"exercise"},
                   {"level"},
                   {"hand"},
                   {"flag"},
                   {"evidence"},
                   {"n", Side::kRight},
                   {"decided", Side::kRight},
                   {"reliability", Side::kRight},
                   {"rules"}});
  for (const CohortLine& line : lines)
    for (const Judgement& j : line.judgements)
      table.add({line.key.exercise_id, line.key.level, line.key.hand, flag_name(j.flag), j.evidence,
                 std::to_string(j.n), std::to_string(j.decided), cell(j.reliability, 2), j.rule_version});
  table.print(out);
}

/// What programmes ask of them, the most urgent first.
void print_next_steps(const std::vector<Reminder>& steps, std::ostream& out) {
  for (const Reminder& step : steps)
    out << "due " << (step.due.empty() ? "without a date" : step.due) << ": " << step.step.exercise_id << " "
        << step.step.level << ", " << step.missing << " (" << step.programme << ", " << step_state_words(step.state)
        << ")\n";
}

}  // namespace

int trainee_add(const TraineeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kCreate, err);
  TraineeStore store(database);
  if (const auto known = store.find(options.code)) err << "trainee " << known->code << " exists already\n";
  const Trainee trainee = store.ensure_trainee(options.code);
  if (options.json) {
    out << trainee_json(trainee, {}, {});
  } else {
    out << trainee.code << "  " << trainee.uuid << '\n';
  }
  return 0;
}

int trainee_edit(const TraineeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const Trainee trainee = TraineeStore(database).edit(options.code, options.name, options.email, "");
  if (options.json)
    out << trainee_json(trainee, {}, {});
  else
    print_person(trainee, out);
  return 0;
}

int trainee_list(const TraineeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const std::vector<Trainee> trainees = TraineeStore(database).list();
  if (options.json) {
    out << trainees_json(trainees);
    return 0;
  }
  const std::set<std::int64_t> away = deactivated(database.connection());
  TextTable table(
      {{"trainee"}, {"attempts", Side::kRight}, {"passes", Side::kRight}, {"last (UTC)"}, {"since (UTC)"}, {"state"}});
  for (const Trainee& trainee : trainees) {
    table.add({trainee.code, std::to_string(trainee.attempts), std::to_string(trainee.passes),
               cell_time(trainee.last_utc), cell_time(trainee.created_utc),
               away.contains(trainee.id) ? "deactivated" : ""});
  }
  table.print(out);
  return 0;
}

int trainee_show(const TraineeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const auto trainee = TraineeStore(database).find(options.code);
  if (!trainee) throw InputError(database.file().string() + ": no trainee \"" + options.code + "\"");
  const auto attempts = AttemptStore(database).list({trainee->code, "", options.limit});
  CohortFilter filter;
  filter.trainee = trainee->code;
  const auto lines = cohort_lines(database, rules_told(database, err), filter, utc_now());
  if (options.json) {
    out << trainee_json(*trainee, attempts, lines);
    return 0;
  }
  print_person(*trainee, out);
  out << "since " << cell_time(trainee->created_utc) << " UTC\n"
      << trainee->attempts << " attempts, " << trainee->passes << " passed\n";
  print_next_steps(next_steps(database, trainee->code, utc_now()), out);
  if (!lines.empty()) print_judgements(lines, out << '\n');
  if (!attempts.empty()) print_attempts(attempts, out << '\n');
  return 0;
}

void add_trainee_people(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<TraineeOptions>();
  TraineeOptions& o = *given;
  CLI::App* add = add_command(parent, "add", "Add a trainee", chosen,
                              [given] { return trainee_add(*given, std::cout, std::cerr); });
  CLI::App* list = add_command(parent, "list", "All trainees", chosen,
                               [given] { return trainee_list(*given, std::cout, std::cerr); });
  CLI::App* show = add_command(parent, "show", "One trainee's attempts", chosen,
                               [given] { return trainee_show(*given, std::cout, std::cerr); });
  CLI::App* edit = add_command(parent, "edit", "Name and e-mail address, which an erasure takes along", chosen,
                               [given] { return trainee_edit(*given, std::cout, std::cerr); });
  edit->add_option("--name", o.name, "Name; '' takes it away");
  edit->add_option("--email", o.email, "E-mail address; '' takes it away");
  for (CLI::App* command : {add, show, edit}) command->add_option("code", o.code, "Trainee code")->required();
  show->add_option("--limit", o.limit, "Newest attempts listed, 0: all")->capture_default_str();
  for (CLI::App* command : {add, list, show, edit}) {
    command->add_option("--db", o.database, "Database file")->check(writable_path());
    command->add_flag("--json", o.json, "As JSON");
  }
}

}  // namespace trocar
