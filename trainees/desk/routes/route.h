// One page of the desk as a function: a request in, a response out. The server (desk_server.h) knows sockets, cookies
// and tokens; pages know neither, so that every page is tested without a network.
//
// A route names its method, its path (parts in braces are arguments: "/trainee/{code}") and who may see it. What a
// trainee may see of others is nothing: own_data routes are refused for a trainee whose code is not the one in the
// path.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/trace.h"
#include "trainees/desk/queries/film_state.h"
#include "trainees/desk/queries/recordings_checked.h"
#include "trainees/exchange/sync/replica_status.h"
#include "trainees/live/live_stations.h"
#include "trainees/markup/board_plots.h"
#include "trainees/markup/plots.h"
#include "trainees/records/accounts.h"
#include "trainees/records/attempt_store.h"
#include "trainees/store/database.h"

namespace trocar::review {

struct Request {
  std::string path;
  std::map<std::string, std::string> arguments = {};  ///< of the path, decoded
  std::map<std::string, std::string> query = {};      ///< behind '?', decoded; the last of a name
  std::map<std::string, std::string> form = {};       ///< posted; the token has been checked and taken out
  std::optional<Account> account = {};                ///< who is signed in; always there when the route asks for a role
  std::string token = {};                             ///< goes into every form as <input type=hidden name=token>
  std::string now_utc = {};
  std::string range = {};  ///< header "Range"
  /// Of a route that asks for the password again: why what was given with the form does not count; "" when it does, and
  /// where nobody signs in.
  std::string unconfirmed = {};
  /// Nothing can be written, not even that who posts came; only a route with keeps_form sees this.
  bool disk_full = false;
};

struct Response {
  int status = 200;
  std::string type = "text/html; charset=utf-8";
  std::string body = {};
  std::string location = {};       ///< of a redirection (status 303)
  std::string download = {};       ///< file name: the browser saves it
  std::string content_range = {};  ///< of status 206 and 416
  bool accept_ranges = false;      ///< parts of it may be asked for
};

/// Of an exercise at a level, as its file says.
struct LevelFacts {
  ForceLimits limits = {};
  double pass_at = 75;
  std::map<std::string, bool> less_is_better = {};  ///< of the metrics that the rubric judges
  PoseLimits pose = {};                             ///< of pens
};

/// An exercise of the program with its levels, in their order.
struct ExerciseLevels {
  std::string id = {}, title = {};
  std::vector<std::string> levels = {};
};

/// A map of an attempt on its scene.
struct HeatQuestion {
  bool of_force = false;  ///< else of time
  bool overview = false;  ///< else as the scope saw it
};

/// Films of attempts, made one at a time in the background. Each function may be called by several threads.
struct FilmSource {
  std::function<FilmState(const std::string& attempt_uuid)> state = {};
  /// Begins one, or leaves one that is there or being made. @throws InputError: no recording, or another one is being
  /// made.
  std::function<void(const std::string& attempt_uuid)> make = {};
  /// @throws InputError: not there.
  std::function<std::string(const std::string& attempt_uuid, std::uint64_t from, std::uint64_t count)> part = {};
};

/// What pages need of the rest of the program; each may be empty, and the page says so.
struct DeskSources {
  /// Samples of a recording. @throws InputError when it cannot be read.
  std::function<Trace(const std::filesystem::path& recording)> trace = {};
  /// Picture of the attempt t s after its recording began (as its trace counts) as PNG, at most so wide. @throws
  /// EnvironmentError without graphics.
  std::function<std::string(const std::string& attempt_uuid, double t_s, int width)> picture = {};
  /// Scene of the attempt with such a map painted on it, as PNG. @throws as `picture`.
  std::function<std::string(const std::string& attempt_uuid, const HeatQuestion& question, int width)> heat = {};
  FilmSource film = {};
  std::string no_film = {};  ///< why none can be made; "" when they can
  /// Words for a metric: what it measures and how (for the formula column); "" when unknown.
  /// JPEG of what a station draws now, by LiveStation::picture; nothing where there is none.
  std::function<std::optional<std::string>(const std::string& name)> station_picture = {};
  std::function<std::string(const std::string& metric)> metric_words = {};
  /// What an exercise's file says of a level. @throws InputError: a text or level that cannot be read.
  std::function<LevelFacts(const std::string& exercise_text, const std::string& level)> level_facts = {};
  /// What the contacts of a recording asked of the device, and what it could display. @throws as `trace`.
  std::function<StiffnessReport(const std::filesystem::path& recording)> stiffness = {};
  /// Of the foam blocks of a board, in their order; none where there are none. @throws as `level_facts`.
  std::function<std::vector<GripLimits>(const std::string& exercise_text, const std::string& level, int board)>
      grip_limits = {};
  std::vector<std::string> metrics =
      {};  ///< names that benchmarks may be of; empty: those that the exercise's attempts have
  std::vector<ExerciseLevels> exercises = {};  ///< that programmes may have steps of; besides those that were tried
  std::string shipped_rules = {};  ///< text of the progress rules that came with the program, where the editor begins
  /// How the desk stands with the centre whose record it serves. Called by several threads at once.
  std::function<ReplicaStatus()> central = {};
  /// Programs that share this database and run now.
  std::function<LiveStations()> stations = {};
  /// How far recordings have been graded again in the background; and begins it once more, unless it is at work.
  std::function<RecordingsChecked()> recordings_checked = {};
  std::function<void()> check_recordings = {};
  /// What the recording of an attempt that was cut off is and gives, a sentence for who decides on it.
  std::function<std::string(Database& database, const AttemptResult& attempt)> recorded_outcome = {};
  /// Why what lies in the place of its recording is not to be shown as its own, "" when it may be. Here: the file's
  /// digest; a desk that reads recordings looks into them. @throws EnvironmentError: the file cannot be read.
  std::function<std::string(Database& database, const AttemptResult& attempt)> foreign_recording =
      [](Database&, const AttemptResult& attempt) { return recording_exchanged(attempt) ? kAnotherFile : ""; };
  /// Removes the invented cohort that is served, files and all, and lets the desk end. @throws InputError: it holds no
  /// such cohort.
  std::function<std::string()> remove_demo = {};
  std::string program = {};  ///< its version
};

class DeskMemory;

struct Desk {
  Database& database;
  DeskSources sources = {};
  bool demo = false;                        ///< every page carries the demo ribbon
  std::shared_ptr<DeskMemory> memory = {};  ///< of this database alone; without one every page asks anew
};

enum class Audience : std::uint8_t {
  kEverybody,    ///< sign-in page, style sheet
  kSignedIn,     ///< whoever has an account, about that account alone
  kOwnData,      ///< trainee of argument {code}, of attempt {attempt} or of {certificate}, instructors, administrators
  kInstructors,  ///< and administrators
  kAdministrators,
};

/// Where one sets one's own password: the one form after which a sign-in goes on under another stamp.
inline constexpr const char* kPasswordPath = "/password";

struct Route {
  std::string method, path;
  Audience audience = Audience::kInstructors;
  std::function<Response(const Request&, Desk&)> answer;
  bool asks_password = false;  ///< of a form: once more, in the field "password"
  bool keeps_form = false;     ///< answers with the form as it was sent when the disk is full
};

/// All pages (routes.cpp gathers those of each page's source).
std::vector<Route> desk_routes();

}  // namespace trocar::review
