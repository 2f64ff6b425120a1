#include "app/commands/review_command.h"

#include <chrono>
#include <mutex>
#include <ostream>
#include <sstream>
#include <thread>

#include <nlohmann/json.hpp>

#include "app/commands/desk_facts.h"
#include "app/commands/desk_films.h"
#include "app/commands/desk_pictures.h"
#include "app/commands/open_database.h"
#include "app/commands/password_prompt.h"
#include "app/commands/text_table.h"
#include "app/demo_cohort.h"
#include "app/interrupt.h"
#include "app/progress_display.h"
#include "app/recorded_result.h"
#include "app/recorder/recording_reader.h"
#include "haptics/input_error.h"
#include "scenarios/scoring/metrics.h"
#include "trainees/accounts.h"
#include "trainees/attempt_store.h"
#include "trainees/live/live_stations.h"
#include "trainees/review/desk_server.h"

namespace trocar {
namespace {

Trace trace_of(const std::filesystem::path& file) {
  const Recording recording = read_recording(file, Reading::kTolerant);
  return rebuild_trace(recording.ticks, recording.rate_hz);
}

std::string words_of_metric(const std::string& metric) {
  const MetricDefinition* known = find_metric(metric);
  return known ? std::string(known->meaning) : "";
}

/// Page threads open what has been opened, migrated and repaired before: quietly.
std::function<Database()> opener(const std::filesystem::path& file) {
  constexpr int kBusy_ms = 5000;
  return [file] { return Database(file, OpenMode::kExisting, kBusy_ms, regrade_file); };
}

/// None without the assets that pictures are made of: the desk is open all the same.
std::unique_ptr<DeskPictures> pictures_of(const std::filesystem::path& file, std::ostream& err) {
  try {
    return std::make_unique<DeskPictures>(find_assets(), opener(file));
  } catch (const EnvironmentError& error) {
    err << "no pictures of attempts: " << error.what() << '\n';
    return nullptr;
  }
}

/// Films that were made before can be watched where none can be made. @param why set to a sentence where none can.
std::unique_ptr<DeskFilms> films_of(const std::filesystem::path& file, std::string& why) {
  try {
    why = DeskFilms::refusal();
    return std::make_unique<DeskFilms>(find_assets(), file, opener(file));
  } catch (const EnvironmentError& error) {
    if (why.empty()) why = std::string("No film: ") + error.what();
    return nullptr;
  }
}

void tell(const review::DeskServer& desk, const ReviewServeOptions& options, std::ostream& out, std::ostream& err) {
  for (const std::string& address : desk.addresses()) out << address << '\n';
  out << std::flush;
  err << "The desk is open" << (options.lan ? " to the network: everybody signs in" : " on this machine") << ". Ctrl-C closes it.\n";
  if (options.lan && options.certificate.empty()) {
    err << "WARNING: without a certificate passwords and results cross the network readable by anybody on it.\n"
           "WARNING: give --cert FILE --key FILE, or keep this to a network where nobody listens.\n";
  }
}

/// The editor begins empty without them.
std::string shipped_rules() {
  try {
    return shipped_progress_rules(find_assets().assets);
  } catch (const EnvironmentError&) {
    return "";
  }
}

Role required_role(const std::string& name) {
  if (const auto role = role_named(name)) return *role;
  throw InputError("--role " + name + ": trainee, instructor and administrator are known");
}

/// @throws Interrupted
void make_demo(const std::filesystem::path& file, int jobs, std::ostream& err) {
  ProgressDisplay progress(err, error_is_terminal());
  err << "Eight invented trainees make their attempts on the simulated plant, each on the clock of its own simulation.\n";
  DemoCohortOptions made;
  made.database = file;
  made.jobs = jobs;
  made.going = [&](int done, int all) {
    progress.show("attempts", static_cast<double>(done) / all);
    return true;
  };
  make_demo_cohort(made, find_assets());
}

/// The database that is served; the demo's is made when it is not there yet.
std::filesystem::path served_database(const ReviewServeOptions& options, std::ostream& err) {
  if (options.demo) {
    const std::filesystem::path demo = demo_database_beside("");
    if (!std::filesystem::exists(demo)) make_demo(demo, 0, err);
    return open_database(demo, OpenMode::kExisting, err).file();
  }
  Database database = open_database(options.database, OpenMode::kCreate, err);
  if (!AttemptStore(database).latest()) err << "No attempt is kept yet: with --demo the desk shows an invented cohort.\n";
  return database.file();
}

}  // namespace

int review_demo(const ReviewDemoOptions& options, std::ostream& out, std::ostream& err) {
  const std::filesystem::path file = options.database.empty() ? demo_database_beside("") : options.database;
  if (options.remove) remove_demo_cohort(file);
  else make_demo(file, options.jobs, err);
  out << file.string() << '\n';
  return 0;
}

int review_serve(const ReviewServeOptions& options, std::ostream& out, std::ostream& err) {
  InterruptWatch interrupt;  // before any thread
  const std::filesystem::path file = served_database(options, err);
  std::mutex said;
  const auto pictures = pictures_of(file, err);
  review::DeskServerOptions served;
  served.open = opener(file);
  served.sources.trace = trace_of;
  served.sources.metric_words = words_of_metric;
  served.sources.level_facts = desk_level_facts;
  served.sources.shipped_rules = shipped_rules();
  served.sources.stations = [file] { return look_at_stations(file); };
  if (pictures) {
    served.sources.picture = [&](const std::string& uuid, double t_s, int width) { return pictures->png(uuid, t_s, width); };
    served.sources.heat = [&](const std::string& uuid, const review::HeatQuestion& q, int width) {
      return pictures->heat(uuid, q.of_force ? HeatOf::kForce : HeatOf::kTime, q.overview, width);
    };
  }
  const auto films = films_of(file, served.sources.no_film);
  if (films) {
    served.sources.film.state = [&](const std::string& uuid) { return films->state(uuid); };
    served.sources.film.part = [&](const std::string& uuid, std::uint64_t from, std::uint64_t count) {
      return films->part(uuid, from, count);
    };
    if (served.sources.no_film.empty()) served.sources.film.make = [&](const std::string& uuid) { films->make(uuid); };
  }
  served.routes = review::desk_routes();
  {
    Database opened = served.open();
    served.demo = is_demo(opened);
  }
  served.port = options.port;
  served.lan = options.lan;
  served.certificate = options.certificate;
  served.key = options.key;
  served.names = options.names;
  served.log = [&](const std::string& line) {
    const std::scoped_lock lock(said);
    err << line << std::endl;
  };
  review::DeskServer desk(std::move(served));
  desk.start();
  tell(desk, options, out, err);
  while (!interrupt.seen()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  desk.stop();
  err << "The desk is closed.\n";
  return 0;
}

int review_account_add(const ReviewAccountOptions& options, std::istream& in, std::ostream& out, std::ostream& err) {
  const Role role = required_role(options.role);
  Database database = open_database(options.database, OpenMode::kCreate, err);
  AccountStore accounts(database);
  const std::string trainee = role == Role::kTrainee && options.trainee.empty() ? options.login : options.trainee;
  const Account made = accounts.add(options.login, options.name.empty() ? options.login : options.name, role, trainee,
                                    new_password(options.login, in, err), "");
  out << made.login << ' ' << role_name(made.role) << '\n';
  bool staff = false;
  for (const Account& account : accounts.list()) staff = staff || account.role != Role::kTrainee;
  if (!staff) err << "No instructor has an account yet, and from now on everybody signs in at the desk:\n"
                     "  trocar review account add LOGIN --role instructor\n";
  return 0;
}

int review_account_password(const ReviewAccountOptions& options, std::istream& in, std::ostream&, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  AccountStore accounts(database);
  if (!accounts.find(options.login)) throw InputError("account \"" + options.login + "\": there is none");
  accounts.set_password(options.login, new_password(options.login, in, err), "");
  err << options.login << ": the password is changed; whoever was signed in with it has to sign in again\n";
  return 0;
}

int review_account_disable(const ReviewAccountOptions& options, bool disabled, std::ostream&, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  AccountStore(database).set_disabled(options.login, disabled, "");
  err << options.login << (disabled ? ": can no longer sign in\n" : ": can sign in again\n");
  return 0;
}

int review_account_list(const ReviewAccountOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const std::vector<Account> accounts = AccountStore(database).list();
  if (options.json) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Account& account : accounts) {
      json.push_back({{"login", account.login},
                      {"name", account.name},
                      {"role", role_name(account.role)},
                      {"trainee", account.trainee_code},
                      {"created_utc", account.created_utc},
                      {"disabled_utc", account.disabled_utc}});
    }
    out << json.dump(2) << '\n';
    return 0;
  }
  TextTable table({{"login"}, {"name"}, {"role"}, {"trainee"}, {"made (UTC)"}, {"disabled (UTC)"}});
  for (const Account& account : accounts) {
    table.add({account.login, account.name, role_name(account.role), account.trainee_code, cell_time(account.created_utc),
               cell_time(account.disabled_utc)});
  }
  table.print(out);
  return 0;
}

}  // namespace trocar
