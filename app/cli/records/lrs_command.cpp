#include "app/cli/records/lrs_command.h"

#include <iostream>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/progress_display.h"
#include "app/cli/records/export_command.h"
#include "app/cli/records/open_database.h"

namespace trocar {
namespace {

constexpr int kRefused = 1;
constexpr std::chrono::milliseconds kLook{100};

void print_delivery(const DeliveryReport& report, bool json, std::ostream& out) {
  if (json) {
    const nlohmann::ordered_json result{{"delivered", report.delivered},
                                        {"before", report.before},
                                        {"different", report.different},
                                        {"taken_back", report.taken_back},
                                        {"refused", report.refused}};
    out << result.dump(2) << '\n';
    return;
  }
  out << report.delivered << " delivered, " << report.before << " were there before";
  if (report.taken_back > 0) out << ", " << report.taken_back << " taken back that no longer hold";
  if (report.different > 0) out << ", " << report.different << " stand there otherwise and stay";
  out << '\n';
  for (const std::string& line : report.refused) out << "refused: " << line << '\n';
}

}  // namespace

int lrs_command(const LrsOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  ProgressDisplay progress(err, error_is_terminal());
  double share = 0;
  DeliveryOptions delivery;
  delivery.lrs = options.lrs;
  delivery.setting.home_page = options.home_page;
  delivery.at_once = static_cast<std::size_t>(options.at_once);
  delivery.patience = std::chrono::seconds(options.patience_s);
  delivery.going = [&](std::size_t done, std::size_t of) {
    share = static_cast<double>(done) / static_cast<double>(of);
    progress.show("statements", share, std::to_string(done) + " of " + std::to_string(of));
  };
  delivery.log = [&](const std::string& line) {
    progress.clear();
    err << line << '\n';
  };
  delivery.wait = [&](std::chrono::milliseconds whole) {
    for (auto left = whole; left.count() > 0; left -= kLook) {
      progress.show("statements", share, "waits for the store");  // Ctrl-C ends the wait
      std::this_thread::sleep_for(std::min(left, kLook));
    }
  };
  const DeliveryReport report =
      deliver_to_lrs(database, choose_attempts(database, options.filter), remembered_pass_mark(), delivery);
  progress.clear();
  print_delivery(report, options.json, out);
  return report.refused.empty() ? 0 : kRefused;
}

void add_lrs(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<LrsOptions>();
  LrsOptions& o = *given;
  CLI::App* command =
      add_command(parent, "lrs", "Attempts and certificates as xAPI statements to a learning record store, each once",
                  chosen, [given] { return lrs_command(*given, std::cout, std::cerr); });
  command->add_option("url", o.lrs.url, "https://HOST/PATH of the store, before /statements")->required();
  command
      ->add_option("--home-page", o.home_page,
                   "URL of who runs the simulator, of which the trainees' UUIDs are accounts")
      ->required();
  command->add_option("--user", o.lrs.user, "User, or key, of basic authentication");
  command->add_option("--password-file", o.lrs.password_file, "First line: the password (else TROCAR_LRS_PASSWORD)");
  command->add_option("--ca-file", o.lrs.authority, "Certificate of who signed the store's (default: the system's)");
  command->add_flag("--allow-plain-http", o.lrs.plain_http, "Let an http:// address be beyond this machine");
  command->add_option("--batch", o.at_once, "Statements in a request")->check(CLI::Range(1, 1000));
  command->add_option("--patience", o.patience_s, "Seconds to wait altogether for a store that does not answer")
      ->check(CLI::Range(0, 86400));
  add_export_filter(*command, o.filter);
  command->add_flag("--json", o.json, "As JSON");
  command->add_option("--db", o.database, "Database file");
}

}  // namespace trocar
