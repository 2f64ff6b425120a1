#include "app/session/playback/expert_run.h"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "app/session/session.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr int kNiceness = 10;

std::filesystem::path file_of(const AttemptSetup& setup) {
  std::string all = setup.exercise.text + '\n' + setup.organ + '\n' + setup.tissue + '\n' + std::to_string(setup.seed) +
                    '\n' + setup.hand + '\n' + TROCAR_VERSION;
  std::error_code none;
  if (const auto size = std::filesystem::file_size(setup.organ, none); !none) {  // an organ of one's own may change
    all += '\n' + std::to_string(size) + ' ' +
           std::to_string(std::filesystem::last_write_time(setup.organ).time_since_epoch().count());
  }
  return cache_folder() / ("expert-" + setup.exercise.id + "-" + setup.level + "-" + std::to_string(setup.board) + "-" +
                           digest::of_bytes(all).substr(0, 12) + ".trec");
}

/// Removes a file that did not become what it should.
struct Part {
  std::filesystem::path file;
  ~Part() {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
};

}  // namespace

std::filesystem::path cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return std::filesystem::path(cache) / "trocar";
  if (const char* home = std::getenv("HOME"); home && *home) return std::filesystem::path(home) / ".cache" / "trocar";
  return std::filesystem::temp_directory_path() / "trocar-cache";
}

AttemptSetup expert_setup(const AttemptSetup& of) {
  AttemptSetup setup;
  setup.exercise = of.exercise;
  setup.level = of.level;
  setup.organ = of.organ;
  setup.tissue = of.tissue;
  setup.hand = "expert";
  setup.seed = of.seed;
  setup.board = of.board;
  setup.draw = of.draw;
  setup.placement = of.placement;
  setup.weak_too = of.weak_too;
  return setup;
}

std::filesystem::path expert_recording(const AttemptSetup& setup, const AssetRoots& assets,
                                       const std::function<bool()>& interrupted) {
  const std::filesystem::path file = file_of(setup);
  if (std::filesystem::is_regular_file(file)) return file;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) throw EnvironmentError(file.parent_path().string() + ": cannot be made: " + error.message());
  const Part part{file.string() + "." + std::to_string(::getpid()) + ".part"};
  std::filesystem::remove(part.file, error);
  const Scene scene = build_scene(setup, assets, {"simulated", setup.rate_hz, 16});
  SessionHooks hooks;
  hooks.interrupted = interrupted;
  record_session(scene, assets, hooks, part.file);
  if (interrupted && interrupted()) return {};
  std::filesystem::rename(part.file, file, error);
  if (error) throw EnvironmentError(file.string() + ": cannot be written: " + error.message());
  return file;
}

ExpertRun::~ExpertRun() {
  stop_ = true;
  if (making_.valid()) making_.wait();
}

std::filesystem::path ExpertRun::ask(const AttemptSetup& setup, const AssetRoots& assets) {
  const std::filesystem::path file = file_of(setup);
  if (making_.valid()) {
    if (making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    refusal_ = making_.get();
  }
  if (std::filesystem::is_regular_file(file)) return file;
  if (file == file_ && !refusal_.empty()) return {};
  file_ = file;
  refusal_.clear();
  making_ = std::async(std::launch::async, [this, setup, assets]() -> std::string {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);  // of this thread alone
    try {
      return expert_recording(setup, assets, [this] { return stop_.load(); }).empty() ? "stopped" : "";
    } catch (const std::exception& failed) {
      return failed.what();
    }
  });
  return {};
}

}  // namespace trocar
