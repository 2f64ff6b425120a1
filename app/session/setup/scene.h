// One attempt, set up: everything that is fixed before the loop starts, and its text in the recording.
//
// The same setup drives an attempt, a replay and a picture: they differ only in back-end and executor.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/setup/adjacent_organs.h"
#include "app/session/setup/device_files.h"
#include "haptics/contact/contact_renderer.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/haptic_loop.h"
#include "scenarios/director/director.h"
#include "scenarios/exercise.h"
#include "scenarios/files/plant_file.h"
#include "scenarios/layout/organ_placement.h"
#include "tissue/organ/organ.h"
#include "tissue/surface_snapshot.h"
#include "tissue/thin/sheet_setup.h"

namespace trocar {

class EmbeddedSurface;  // tissue/solid/embedded_surface.h
struct SoftSetup;       // tissue/tissue_world.h
struct SutureSetup;     // tissue/interaction/suturing.h

/// Where the program finds what it ships.
struct AssetRoots {
  std::filesystem::path exercises, hands;
  std::filesystem::path assets;  ///< holds organs/ and shaders/
};

/// Finds the assets of an installed or a just built program. @throws EnvironmentError naming the places looked at.
AssetRoots find_assets();

/// The program's version as the record keeps it, with the folder of its assets where others than its own were named.
std::string program_of_record();

/// How late the loop may be before it is a fault.
struct PaceLimits {
  std::uint32_t missed_in_a_row = 20;
  double missed_share = 0.01;  ///< of the last second
  bool operator==(const PaceLimits&) const = default;
};

/// Live on the simulated device nobody holds a motor, and the machine may be busy with other things: a hole that would
/// be a fault at a real device is tolerated, counted and stated in the run report. At a quarter of a second, about what
/// a person needs to react to what the eye sees, it is no longer the same task and a fault here too.
inline constexpr PaceLimits kSimulatedLivePace{250, 0.25};

struct AttemptSetup {
  Exercise exercise;
  std::string level = "L1";
  std::string organ;                  ///< manifest path or name of a shipped organ, as given
  std::string tissue = kStillTissue;  ///< one of kTissueWords
  std::string hand;                   ///< name or script; a replay knows it and does not use it
  int attempt = 1;                    ///< of a learning hand
  std::int64_t seed = 1;
  int board = 0;
  std::string backend = "simulated";  ///< a name that make_backend() knows; a replay knows it of a real device only
  std::string card = {};              ///< where its card or boards are, of one that has some
  std::string force_sensor = {};      ///< a real one, as make_force_sensor() takes it
  double rate_hz = 1000;
  ContactLaw contact_law = ContactLaw::kProxy;
  PassivityLaw passivity_law = PassivityLaw::kBudgeted;
  bool clamp_stiffness = false;             ///< contacts stiffer than K_max are weakened to it
  DeviceFiles device;                       ///< what the loop knows of its device beyond the nominal model
  MotorStates motors = {};                  ///< how warm they are at first, by the model
  std::vector<InjectedFault> faults;        ///< simulated back-end only
  std::shared_ptr<const PlantFile> plant;   ///< of the simulated back-end; none: drawn by the seed. A replay needs none
  std::optional<OrganPlacement> placement;  ///< where the organ lies, when that is known; none: it is looked for
  std::optional<int> draw;                  ///< which draw of the board, when that is known; none: the first sound one
  std::optional<double> force_scale;        ///< kappa, when it is known; none: the level's
  bool weak_too = false;                    ///< a force scale beyond the device is laid out too: proofs, replays
  bool realtime = false;                    ///< threads and the clock drive the tasks, else lockstep
  PaceLimits pace;
};

/// How often a board is drawn before the first draw is taken as it is, for `trocar check` to refuse.
inline constexpr int kBoardDraws = 8;

/// The setup resolved: organ placed, board laid out, loop configured.
struct Scene {
  AttemptSetup setup;
  ExerciseLevel level;
  Organ organ;
  OrganPlacement placement;
  SurfacePtr organ_T = still_surface({});           ///< shared by all who show it; with a bound neighbour as a part
  std::string bound;                                ///< name of that adjacent organ; empty: none gives way with it
  std::shared_ptr<const SoftSetup> soft;            ///< how it gives way; nullptr: it stands still
  std::shared_ptr<const EmbeddedSurface> embedded;  ///< the organ on the nodes that deform; nullptr: it stands still
  std::vector<DuctSetup> ducts;                     ///< with `soft`, those that the exercise names
  std::vector<std::string> thin_left_out;           ///< names of ducts and sheets that find no place on this organ
  std::vector<SheetSetup> sheets;                   ///< with `soft`, those that the exercise names
  std::vector<SurfacePtr> thin_T;                   ///< as they lie before a run
  std::shared_ptr<const SutureSetup> suture;        ///< with `soft`, a needle with thread; nullptr: none
  AdjacentOrgans adjacent;                          ///< what lies round the organ, when it is one of several
  Board board;
  int draw = 0;  ///< of the board: the first on which the device can do what is asked
  HapticLoopConfig loop;
  double room_share = 1;  ///< of the region, where the device can give the soft force limit
};

/// Everything that the instrument can touch: the organ, with what lies round it.
const TriangleSurface& felt_surface(const Scene& scene);

/// Where an instrument that no arm brings out of its jig comes in: in free space, in sight of the start ball, m, frame
/// T.
Vec3 entry_T(const Scene& scene);

/// @param daq rate and DAC bits of the back-end. @throws InputError.
Scene build_scene(const AttemptSetup& setup, const AssetRoots& assets, const DaqCapabilities& daq);
/// The organ that the setup names; one named "none", without a surface, when the exercise happens without.
Organ organ_of(const AttemptSetup& setup, const AssetRoots& assets);
/// The same on an organ that has been loaded already.
Scene build_scene(const AttemptSetup& setup, Organ organ, const DaqCapabilities& daq);

/// Text for the recording's header: JSON with all that a replay and a regrade need (exercise embedded, organ by hash).
std::string scene_json(const Scene& scene);

/// The setup written by scene_json(). @param name of the recording, for messages. @throws InputError.
struct RecordedSetup {
  AttemptSetup setup;
  std::string organ_sha256;
  DaqCapabilities daq;
  double force_scale = 1;  ///< kappa that the recorded attempt used
};
RecordedSetup parse_scene_json(const std::string& json, const std::string& name);
/// By which an attempt of that level is judged: without motors that of a hand at the pointer.
const Rubric& rubric_for(const ExerciseLevel& level, const DaqCapabilities& daq);

}  // namespace trocar
