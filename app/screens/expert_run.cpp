#include "app/screens/expert_run.h"

#include <chrono>
#include <cstdlib>

#include "app/session.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

std::string make_recording(const AttemptSetup& setup, const AssetRoots& assets, const std::filesystem::path& file,
                           const std::atomic<bool>& stop) {
  try {
    std::filesystem::create_directories(file.parent_path());
    const Scene scene = build_scene(setup, assets, {"simulated", setup.rate_hz, 16});
    const std::filesystem::path part = file.string() + ".part";
    std::filesystem::remove(part);
    SessionHooks hooks;
    hooks.interrupted = [&stop] { return stop.load(); };
    record_session(scene, assets, hooks, part);
    if (stop) {
      std::filesystem::remove(part);
      return "stopped";
    }
    std::filesystem::rename(part, file);
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::filesystem::path file_of(const AttemptSetup& setup) {
  const std::string all = setup.exercise.text + '\n' + setup.organ + '\n' + std::to_string(setup.seed) + '\n' + setup.hand +
                          '\n' + TROCAR_VERSION;
  return cache_folder() / ("expert-" + setup.exercise.id + "-" + setup.level + "-" + std::to_string(setup.board) + "-" +
                           digest::of_bytes(all).substr(0, 12) + ".trocar");
}

}  // namespace

std::filesystem::path cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) return std::filesystem::path(cache) / "trocar";
  if (const char* home = std::getenv("HOME"); home && *home) return std::filesystem::path(home) / ".cache" / "trocar";
  return std::filesystem::temp_directory_path() / "trocar-cache";
}

ExpertRun::~ExpertRun() {
  stop_ = true;
  if (making_.valid()) making_.wait();
}

std::filesystem::path ExpertRun::ask(const AttemptSetup& setup, const AssetRoots& assets) {
  const std::filesystem::path file = file_of(setup);
  if (std::filesystem::is_regular_file(file)) return file;
  if (making_.valid()) {
    if (making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    refusal_ = making_.get();
  }
  if (file == file_ && !refusal_.empty()) return {};
  file_ = file;
  refusal_.clear();
  making_ = std::async(std::launch::async, [this, setup, assets, file] { return make_recording(setup, assets, file, stop_); });
  return {};
}

}  // namespace trocar
