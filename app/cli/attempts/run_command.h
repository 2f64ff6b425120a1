// `trocar run`: one scripted, headless attempt, recorded, graded and stored.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "app/session/setup/scene.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

struct RunOptions {
  std::string exercise;  ///< id, number or FILE.toml
  std::string hand;      ///< name or SCRIPT.toml
  std::string level = "L1";
  std::string organ = "phantom-liver";  ///< manifest or shipped name
  std::string tissue;                   ///< one of kTissueWords; empty: the exercise's
  std::string trainee = "guest";
  int attempt = 0;  ///< of a learning hand, from 1; 0: one more than the trainee has at the exercise
  std::int64_t seed = 1;
  std::optional<int> board;          ///< 0-19 practice, not in an exam; none: unseen, drawn by the seed
  std::filesystem::path database;    ///< empty: the default path; ":memory:" keeps nothing
  std::filesystem::path record;      ///< empty: beside the database
  std::filesystem::path frames;      ///< empty: no pictures
  std::filesystem::path video = {};  ///< empty: no film
  std::optional<double> fps;         ///< none: 10 of pictures, 25 of a film
  std::string backend = kSimulatedBackend;
  std::string card = {}, force_sensor = {};  ///< as BackendOptions has them
  double rate_hz = 1000;
  std::string contact_law = "proxy", passivity_law = "budgeted";
  bool clamp = false;                   ///< contacts stiffer than K_max are weakened to it
  std::filesystem::path calibration;    ///< of the amplifiers, written by `trocar device calibrate`; empty: nominal
  std::filesystem::path device;         ///< weights and friction, written by `trocar device identify`; empty: nominal
  std::vector<std::string> injections;  ///< KIND[:CHANNEL[:VALUE]]@SECONDS[+DURATION]
  std::filesystem::path plant = {};     ///< plant file of the simulated device; empty: drawn by the seed
  bool realtime = false;                ///< threads and the clock instead of lockstep
  std::function<bool()> interrupted;    ///< asked during the run: true ends it as aborted
  bool json = false;
};

/// Setup of the options, boards drawn, names resolved. @throws InputError.
AttemptSetup attempt_setup(const RunOptions& options, const AssetRoots& assets);

/// One injected fault from its text, see RunOptions::injections. @throws InputError listing the kinds.
InjectedFault parse_injection(const std::string& text);

/// Runs, records, grades, stores. @param observe may be empty.
AttemptResult run_attempt(const RunOptions& options, const Scene& scene, const AssetRoots& assets, std::ostream& err,
                          const SessionObserver& observe);

/// @return exit code: 0 passed, 1 below the pass mark (or no number), 4 device fault.
int run_command(const RunOptions& options, std::ostream& out, std::ostream& err);

/// Exit code of an attempt that was graded.
int exit_code(const AttemptResult& result);

/// The outcome as a few aligned lines for people.
void print_result(const AttemptResult& result, std::ostream& out);

}  // namespace trocar
