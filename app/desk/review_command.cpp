#include "app/desk/review_command.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>
#include <mutex>
#include <sstream>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/progress_display.h"
#include "app/cli/records/open_database.h"
#include "app/cli/text_table.h"
#include "app/desk/demo_cohort.h"
#include "app/desk/desk_facts.h"
#include "app/desk/desk_recording_check.h"
#include "app/desk/desk_sources.h"
#include "app/desk/password_prompt.h"
#include "app/session/interrupt.h"
#include "app/session/keeping/recording_check.h"
#include "haptics/input_error.h"
#include "trainees/desk/server/desk_server.h"
#include "trainees/exchange/sync/replica_keeper.h"
#include "trainees/files/free_room.h"
#include "trainees/files/size_text.h"
#include "trainees/live/live_stations.h"
#include "trainees/records/accounts.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/demo_record.h"

namespace trocar {
namespace {

/// Pictures and maps of attempts.
void add_pictures(review::DeskSources& sources, DeskPictures& pictures) {
  sources.picture = [&](const std::string& uuid, double t_s, int width) { return pictures.png(uuid, t_s, width); };
  sources.heat = [&](const std::string& uuid, const review::HeatQuestion& q, int width) {
    return pictures.heat(uuid, q.of_force ? HeatOf::kForce : HeatOf::kTime, q.overview, width);
  };
}

/// Films that were made before are shown also where none can be made.
void add_films(review::DeskSources& sources, DeskFilms& films) {
  sources.film.state = [&](const std::string& uuid) { return films.state(uuid); };
  sources.film.part = [&](const std::string& uuid, std::uint64_t from, std::uint64_t count) {
    return films.part(uuid, from, count);
  };
  if (sources.no_film.empty()) sources.film.make = [&](const std::string& uuid) { films.make(uuid); };
}

void tell(const review::DeskServer& desk, const ReviewServeOptions& options, std::ostream& out, std::ostream& err) {
  for (const std::string& address : desk.addresses()) out << address << '\n';
  out << std::flush;
  err << "The desk is open" << (options.lan ? " to the network: everybody signs in" : " on this machine")
      << ". Ctrl-C closes it.\n";
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

/// Without them programmes are made of what was tried.
std::vector<review::ExerciseLevels> shipped_exercises() {
  try {
    return desk_exercises(find_assets().exercises);
  } catch (const EnvironmentError&) {
    return {};
  }
}

/// Without them the desk is in English.
std::shared_ptr<const review::PageLanguages> shipped_languages() {
  try {
    return std::make_shared<review::PageLanguages>(std::filesystem::path(find_assets().assets) / "languages");
  } catch (const EnvironmentError&) {
    return nullptr;
  }
}

constexpr std::uintmax_t kRoomToWrite = 40'000'000;  // bytes: the log grows to 33 MB before it is copied back
constexpr std::chrono::milliseconds kTurn{100};
constexpr int kLast_turns = 30;

Role required_role(const std::string& name) {
  if (const auto role = role_named(name)) return *role;
  throw InputError("--role " + name + ": trainee, instructor and administrator are known");
}

/// @throws Interrupted
void make_demo(const std::filesystem::path& file, int jobs, std::ostream& err) {
  ProgressDisplay progress(err, error_is_terminal());
  err << "Eight invented trainees make their attempts on the simulated plant, each on the clock of its own "
         "simulation.\n";
  DemoCohortOptions made;
  made.database = file;
  made.jobs = jobs;
  made.going = [&](int done, int all) {
    progress.show("attempts", static_cast<double>(done) / all);
    return true;
  };
  make_demo_cohort(made, find_assets());
}

/// The copy of a central record that the desk serves.
std::filesystem::path copy_of_centre(const ReviewServeOptions& options, std::ostream& err) {
  return open_database(options.database.empty() ? default_replica_path({options.from}) : options.database,
                       OpenMode::kCreate, err)
      .file();
}

std::string host_name() {
  char name[256] = "";
  return gethostname(name, sizeof name - 1) == 0 ? name : "here";
}

/// @throws Interrupted
std::unique_ptr<ReplicaKeeper> keeper_of(const ReviewServeOptions& options, const std::filesystem::path& file,
                                         const std::function<void(const std::string&)>& log, std::ostream& err) {
  if (options.from.empty()) return nullptr;
  KeeperOptions kept;
  kept.central = {options.from, options.password_file, options.weak_tls};
  kept.open = desk_opener(file);
  kept.station_name = ("desk " + host_name()).substr(0, 64);
  kept.recordings = options.recordings;
  kept.log = log;
  ProgressDisplay progress(err, error_is_terminal());
  enum class Stage : char { kFilling, kInterrupted, kServing };
  auto stage = std::make_shared<Stage>(Stage::kFilling);
  kept.going = [&progress, stage](std::size_t done, std::size_t all) {
    if (*stage == Stage::kServing) return;
    *stage = Stage::kInterrupted;  // unless it comes back
    progress.show("attempts", static_cast<double>(done) / static_cast<double>(all));
    *stage = Stage::kFilling;
  };
  auto keeper = std::make_unique<ReplicaKeeper>(std::move(kept));
  if (*stage == Stage::kInterrupted)
    throw Interrupted();  // a copy that had been filled would have been served as it was
  *stage = Stage::kServing;
  err << "The record of " << central_name({options.from}) << " is kept in " << file.string()
      << ".\nAccounts of this desk: trocar review account add LOGIN --role instructor --db " << file.string() << '\n';
  return keeper;
}

/// The database that is served; the demo's is made when it is not there yet.
std::filesystem::path served_database(const ReviewServeOptions& options, std::ostream& err) {
  if (!options.from.empty()) return copy_of_centre(options, err);
  if (options.demo) {
    const std::filesystem::path demo = demo_database_beside("");
    if (!std::filesystem::exists(demo)) make_demo(demo, 0, err);
    const Database opened = open_database(demo, OpenMode::kExisting, err);
    if (!is_demo(opened)) {
      throw InputError(
          demo.string() +
          ": holds no demo cohort that this program made. Move it away, or serve it as a record with --db");
    }
    return opened.file();
  }
  Database database = open_database(options.database, OpenMode::kCreate, err);
  if (!AttemptStore(database).latest())
    err << "No attempt is kept yet: with --demo the desk shows an invented cohort.\n";
  return database.file();
}

}  // namespace

int review_demo(const ReviewDemoOptions& options, std::ostream& out, std::ostream& err) {
  const std::filesystem::path file = options.database.empty() ? demo_database_beside("") : options.database;
  if (options.remove) {
    const std::filesystem::path moved = remove_demo_cohort(file);
    err << "The demo lies in this folder now, and nothing needs it: it can be deleted.\n";
    out << moved.string() << '\n';
    return 0;
  }
  make_demo(file, options.jobs, err);
  out << file.string() << '\n';
  return 0;
}

std::string little_room(const std::filesystem::path& folder, std::uintmax_t free_bytes) {
  if (free_bytes >= kRoomToWrite) return "";
  return folder.string() + ": the disk is nearly full, " + size_text(free_bytes) +
         " are free: the desk can be read, but may not keep what is written there. Make room on it";
}

int review_serve(const ReviewServeOptions& options, std::ostream& out, std::ostream& err) {
  InterruptWatch interrupt;  // before any thread
  const std::filesystem::path file = served_database(options, err);
  std::mutex said;
  const auto log = [&](const std::string& line) {
    const std::scoped_lock lock(said);
    err << line << std::endl;
  };
  const auto keeper = keeper_of(options, file, log, err);
  const auto pictures = desk_pictures(file, err);
  review::DeskServerOptions served;
  served.open = desk_opener(file);
  served.sources = desk_sources();
  served.sources.shipped_rules = shipped_rules();
  served.sources.exercises = shipped_exercises();
  served.sources.program = TROCAR_VERSION;
  std::atomic<bool> gone{false};
  served.sources.remove_demo = [&] {
    const std::string moved = remove_demo_cohort(file).string();
    gone = true;
    return moved;
  };
  if (keeper) served.sources.central = [&] { return keeper->status(); };
  served.sources.stations = [file] { return look_at_stations(file); };
  served.sources.station_picture = [file](const std::string& name) { return look_at_picture(file, name); };
  if (pictures) add_pictures(served.sources, *pictures);
  const auto films = desk_films(file, served.sources.no_film);
  if (films) add_films(served.sources, *films);
  DeskRecordingCheck recordings(desk_opener(file));
  served.sources.recordings_checked = [&] { return recordings.state(); };
  served.sources.check_recordings = [&] { recordings.begin(); };
  served.sources.recorded_outcome = recorded_outcome;
  served.routes = review::desk_routes();
  served.languages = shipped_languages();
  {
    Database opened = served.open();
    served.demo = is_demo(opened);
  }
  served.port = options.port;
  served.lan = options.lan;
  served.certificate = options.certificate;
  served.key = options.key;
  served.names = options.names;
  served.log = log;
  review::DeskServer desk(std::move(served));
  desk.start();
  if (keeper) keeper->start();
  recordings.begin();
  const std::filesystem::path folder = file.parent_path();
  if (const std::string little = little_room(folder, room_free(folder)); !little.empty())
    err << "WARNING: " << little << ".\n";
  tell(desk, options, out, err);
  // The page that says that the demo is gone still fetches its style.
  for (int left = kLast_turns; left > 0 && !interrupt.seen(); left -= gone ? 1 : 0) std::this_thread::sleep_for(kTurn);
  desk.stop();
  err << (gone ? "The demo is removed and the desk is closed.\n" : "The desk is closed.\n");
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
  if (!staff)
    err << "No instructor has an account yet, and from now on everybody signs in at the desk:\n"
           "  trocar review account add LOGIN --role instructor\n";
  return 0;
}

int review_account_password(const ReviewAccountOptions& options, std::istream& in, std::ostream&, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  AccountStore accounts(database);
  if (!accounts.find(options.login)) throw InputError("account \"" + options.login + "\": there is none");
  if (options.own) {
    const std::string present = present_password(options.login, in, err);
    accounts.set_own_password(options.login, present, new_password(options.login, in, err));
    err << options.login << ": your password is changed; whoever was signed in with it has to sign in again\n";
    return 0;
  }
  const auto confirmed = options.as.empty() ? std::nullopt : std::optional(required_role(options.as));
  accounts.set_password(options.login, new_password(options.login, in, err), "", confirmed);
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
    table.add({account.login, account.name, role_name(account.role), account.trainee_code,
               cell_time(account.created_utc), cell_time(account.disabled_utc)});
  }
  table.print(out);
  return 0;
}

void add_review_serve(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ReviewServeOptions>();
  ReviewServeOptions& o = *given;
  CLI::App* serve = add_command(parent, "serve", "The desk as web pages, until Ctrl-C", chosen,
                                [given] { return review_serve(*given, std::cout, std::cerr); });
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
  serve->add_flag("--allow-weak-tls", o.weak_tls, "Let that address have an sslmode that does not check who answers")
      ->needs(from);
  serve->add_flag("--recordings", o.recordings, "Fetch the recordings that stations pushed, too")->needs(from);
}

void add_review_account(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ReviewAccountOptions>();
  ReviewAccountOptions& o = *given;
  CLI::App* account = add_group(parent, "account", "Who may sign in at the desk");
  const auto add = [&](const char* name, const char* help, CommandAction action) {
    CLI::App* command = add_command(*account, name, help, chosen, std::move(action));
    command->add_option("--db", o.database, "Database file");
    return command;
  };
  CLI::App* fresh = add("add", "New account; the password is asked for, or read from the input's first line",
                        [given] { return review_account_add(*given, std::cin, std::cout, std::cerr); });
  fresh->add_option("--name", o.name, "As it is printed (default: the login)");
  fresh->add_option("--role", o.role, "trainee (own attempts), instructor (all) or administrator (accounts too)")
      ->capture_default_str();
  fresh->add_option("--trainee", o.trainee, "Code of the trainee whose account it is (default: the login)");
  CLI::App* password = add("password", "New password",
                           [given] { return review_account_password(*given, std::cin, std::cout, std::cerr); });
  password->add_flag("--own", o.own, "Your own, by the present one, which is asked for first");
  password->add_option("--as", o.as,
                       "Role that it is to have, where its row was changed by another way than this program");
  CLI::App* disable = add("disable", "Can no longer sign in",
                          [given] { return review_account_disable(*given, true, std::cout, std::cerr); });
  CLI::App* enable = add("enable", "Can sign in again",
                         [given] { return review_account_disable(*given, false, std::cout, std::cerr); });
  for (CLI::App* command : {fresh, password, disable, enable})
    command->add_option("login", o.login, "Name to sign in with")->required();
  CLI::App* list = add("list", "All accounts", [given] { return review_account_list(*given, std::cout, std::cerr); });
  list->add_flag("--json", o.json, "As JSON");
}

void add_review_demo(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ReviewDemoOptions>();
  ReviewDemoOptions& o = *given;
  CLI::App* demo = add_command(
      parent, "demo", "A database of eight invented trainees with a hundred attempts, to look at the desk with", chosen,
      [given] { return review_demo(*given, std::cout, std::cerr); });
  demo->add_option("--db", o.database, "The demo's own file (default: demo.db beside the usual database)");
  demo->add_option("--jobs", o.jobs, "Attempts at a time, 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0, 256));
  demo->add_flag("--remove", o.remove, "Remove it, with its recordings");
}

}  // namespace trocar
