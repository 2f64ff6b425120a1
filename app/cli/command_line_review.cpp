#include "app/cli/command_line_review.h"

#include <iostream>

#include <CLI/CLI.hpp>

#include "app/desk/report_command.h"
#include "app/desk/review_command.h"

namespace trocar {

struct ReviewCommandLine {
  ReviewServeOptions serve;
  ReviewAccountOptions account;
  ReviewDemoOptions demo;
  ReviewReportOptions report;
};

namespace {

using Choose = std::function<void(std::function<int()>)>;

void add_serve(CLI::App& review, ReviewServeOptions& o, const Choose& choose) {
  CLI::App* serve = review.add_subcommand("serve", "The desk as web pages, until Ctrl-C");
  serve->add_option("--port", o.port, "Port (0: any that is free)")->capture_default_str()->check(CLI::Range(0, 65535));
  serve->add_flag("--lan", o.lan, "For the network too; everybody signs in");
  serve->add_option("--cert", o.certificate, "Certificate (PEM): with --key the pages go through TLS");
  serve->add_option("--key", o.key, "Private key of the certificate (PEM)");
  serve->add_option("--name", o.names, "A name that the machine goes by in the network, besides its own; repeatable");
  CLI::Option* db = serve->add_option("--db", o.database, "Database file");
  CLI::Option* demo =
      serve->add_flag("--demo", o.demo, "An invented cohort in a file of its own, made the first time (minutes)");
  demo->excludes(db);
  CLI::Option* from = serve->add_option("--from", o.from,
                                        "postgresql://USER@HOST/DATABASE: the record of all stations, kept fresh in a"
                                        " copy (--db FILE, else in the cache)");
  from->excludes(demo);
  CLI::Option* password = serve->add_option("--password-file", o.password_file,
                                            "First line: the password of that database (else PGPASSWORD, ~/.pgpass)");
  password->needs(from);
  serve->add_flag("--recordings", o.recordings, "Fetch the recordings that stations pushed, too")->needs(from);
  serve->callback([&o, choose] { choose([&o] { return review_serve(o, std::cout, std::cerr); }); });
}

void add_accounts(CLI::App& review, ReviewAccountOptions& o, const Choose& choose) {
  CLI::App* account = review.add_subcommand("account", "Who may sign in at the desk");
  account->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, const std::function<int()>& action) {
    CLI::App* command = account->add_subcommand(name, help);
    command->callback([choose, action] { choose(action); });
    command->add_option("--db", o.database, "Database file");
    return command;
  };
  CLI::App* fresh = add("add", "New account; the password is asked for, or read from the input's first line",
                        [&o] { return review_account_add(o, std::cin, std::cout, std::cerr); });
  fresh->add_option("--name", o.name, "As it is printed (default: the login)");
  fresh->add_option("--role", o.role, "trainee (own attempts), instructor (all) or administrator (accounts too)")
      ->capture_default_str();
  fresh->add_option("--trainee", o.trainee, "Code of the trainee whose account it is (default: the login)");
  CLI::App* password =
      add("password", "New password", [&o] { return review_account_password(o, std::cin, std::cout, std::cerr); });
  CLI::App* disable =
      add("disable", "Can no longer sign in", [&o] { return review_account_disable(o, true, std::cout, std::cerr); });
  CLI::App* enable =
      add("enable", "Can sign in again", [&o] { return review_account_disable(o, false, std::cout, std::cerr); });
  for (CLI::App* command : {fresh, password, disable, enable})
    command->add_option("login", o.login, "Name to sign in with")->required();
  CLI::App* list = add("list", "All accounts", [&o] { return review_account_list(o, std::cout, std::cerr); });
  list->add_flag("--json", o.json, "As JSON");
}

void add_demo(CLI::App& review, ReviewDemoOptions& o, const Choose& choose) {
  CLI::App* demo = review.add_subcommand(
      "demo", "A database of eight invented trainees with a hundred attempts, to look at the desk with");
  demo->add_option("--db", o.database, "The demo's own file (default: demo.db beside the usual database)");
  demo->add_option("--jobs", o.jobs, "Attempts at a time, 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0, 256));
  demo->add_flag("--remove", o.remove, "Remove it, with its recordings");
  demo->callback([&o, choose] { choose([&o] { return review_demo(o, std::cout, std::cerr); }); });
}

void add_report(CLI::App& review, ReviewReportOptions& o, const Choose& choose) {
  CLI::App* report =
      review.add_subcommand("report", "A report as PDF or HTML: of a trainee, a cohort, an attempt, or a certificate");
  report->add_option("--trainee", o.trainee, "Code of the trainee");
  report->add_flag("--cohort", o.cohort, "Everybody, or a group");
  report->add_option("--group", o.group, "With --cohort: one group only");
  report->add_option("--attempt", o.attempt, "Number of the attempt, or its beginning");
  report->add_option("--certificate", o.certificate, "Number of the certificate");
  report->add_option("-o,--out", o.out, "File to be made, NAME.pdf or NAME.html; for its owner alone to read")
      ->required();
  report->add_flag("--notes", o.notes, "With the instructors' notes");
  report->add_flag("--force", o.force, "A file of that name gives way");
  report->add_option("--db", o.database, "Database file");
  report->callback([&o, choose] { choose([&o] { return review_report(o, std::cout, std::cerr); }); });
}

}  // namespace

std::shared_ptr<ReviewCommandLine> add_review_command(CLI::App& app, const Choose& choose) {
  auto c = std::make_shared<ReviewCommandLine>();
  CLI::App* review = app.add_subcommand("review", "The instructor's desk");
  review->require_subcommand(1);
  add_serve(*review, c->serve, choose);
  add_accounts(*review, c->account, choose);
  add_demo(*review, c->demo, choose);
  add_report(*review, c->report, choose);
  return c;
}

}  // namespace trocar
