#include "app/session/setup/recorded_scene.h"

#include "haptics/input_error.h"

namespace trocar {

Scene recorded_scene(const Recording& recording, const std::filesystem::path& file, const AssetRoots& assets,
                     const std::string& organ_now) {
  RecordedSetup recorded = parse_scene_json(recording.session, file.string());
  recorded.setup.weak_too = true;
  if (!organ_now.empty()) recorded.setup.organ = organ_now;
  // Before anything is laid out on it: another organ may well have no room for the board.
  Organ organ = organ_of(recorded.setup, assets);
  if (organ.sha256 != recorded.organ_sha256) {
    throw InputError(organ.manifest.string() +
                     ": not the organ of the recording (its sha256 differs); name that one with --organ");
  }
  Scene scene = build_scene(recorded.setup, std::move(organ), recorded.daq);
  if (scene.loop.map.force_scale != recorded.force_scale) {
    throw InputError(file.string() +
                     ": recorded with another force scale than this program computes; it can be "
                     "graded (trocar score) but not replayed");
  }
  return scene;
}

AttemptSetup recorded_setup(const std::filesystem::path& file) {
  return parse_scene_json(read_recording(file, Reading::kTolerant).session, file.string()).setup;
}

}  // namespace trocar
