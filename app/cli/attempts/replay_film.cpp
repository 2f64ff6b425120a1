#include "app/cli/attempts/replay_film.h"

#include <chrono>
#include <optional>
#include <ostream>

#include "app/cli/progress_display.h"
#include "app/picture/films/film.h"
#include "app/picture/films/video_writer.h"
#include "app/picture/gl/headless_context.h"
#include "app/session/playback/expert_run.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kFilmPicturesPerSecond = 25;

std::string name_of(const Subject& subject) {
  const RecordedSetup recorded = parse_scene_json(subject.recording.session, subject.file.string());
  return subject.stored ? subject.stored->trainee : recorded.setup.hand;
}

struct Beside {
  std::filesystem::path file;
  std::string name;
};

Beside find_beside(const RecordingOptions& options, const Subject& subject, const AssetRoots& assets,
                   std::ostream& err) {
  if (options.beside != "expert") {
    const Subject other = find_subject(options.beside, options.database, err);
    return {other.file, name_of(other)};
  }
  RecordedSetup recorded = parse_scene_json(subject.recording.session, subject.file.string());
  if (!options.organ.empty()) recorded.setup.organ = options.organ;
  return {expert_recording(expert_setup(recorded.setup), assets), "expert"};
}

}  // namespace

Preset film_preset(const std::string& asked, std::ostream& err) {
  if (asked != "auto") return *preset_named(asked);
  const HeadlessContext context;
  if (!context.info().software) return Preset::kFull;
  err << "trocar: no GPU draws here: pictures of preset soft (--preset full is finer and takes about three times as "
         "long)\n";
  return Preset::kSoft;
}

namespace {

/// What is shown while pictures are made. Ctrl-C takes a film away; numbered pictures stay, and that is said.
class FilmProgress {
 public:
  FilmProgress(ProgressDisplay& display, std::filesystem::path frames)
      : display_(display), frames_(std::move(frames)) {}
  bool operator()(int made, int of) {
    const auto now = std::chrono::steady_clock::now();
    if (made == 1) first_ = now;
    try {
      display_.show("pictures", static_cast<double>(made) / of,
                    pace_words(made, of, std::chrono::duration<double>(now - first_).count()));
    } catch (const Interrupted&) {
      if (frames_.empty()) throw;
      throw EnvironmentError("interrupted; " + frames_.string() + " holds the first " + std::to_string(made) + " of " +
                             std::to_string(of) + " pictures");
    }
    return true;
  }

 private:
  ProgressDisplay& display_;
  std::filesystem::path frames_;
  std::chrono::steady_clock::time_point first_;
};

}  // namespace

bool is_film(const RecordingOptions& options) {
  const bool film = !options.video.empty() || !options.beside.empty() || options.speed != 1;
  if (film && options.video.empty() && options.frames.empty())
    throw InputError(
        "--beside and --speed are of a film: name it with --video FILE, or a folder for its pictures with --frames "
        "DIR");
  if (!options.video.empty() && !options.frames.empty()) throw InputError("--video and --frames: one of the two");
  if (!options.beside.empty()) check_size_for_two(options.width, options.height);
  return film;
}

std::optional<SessionOutcome> replay_as_film(const RecordingOptions& options, const Subject& subject,
                                             const AssetRoots& assets, std::ostream& err) {
  ProgressDisplay display(err, error_is_terminal());
  const auto shown = [&display](const char* stage) {
    return [&display, stage](double share) {
      display.show(stage, share);
      return true;
    };
  };
  FilmOptions film;
  film.fps = options.fps.value_or(kFilmPicturesPerSecond);
  film.speed = options.speed;
  film.width = options.width;
  film.height = options.height;
  film.name = name_of(subject);
  film.preset = film_preset(options.preset, err);
  film.progress = FilmProgress(display, options.frames);
  const RecordedRun run(subject.file, assets, options.organ, shown("replay"));
  std::optional<RecordedRun> beside;
  if (!options.beside.empty()) {
    const Beside other = find_beside(options, subject, assets, err);
    film.name_beside = other.name;
    beside.emplace(other.file, assets, options.organ, shown("replay of the second"));
  }
  std::optional<VideoWriter> video;
  if (!options.video.empty()) video.emplace(options.video, film.width, film.height, film.fps);
  const PictureSink sink =
      video ? PictureSink([&video](const Image& image) { video->add(image); }) : numbered_pictures(options.frames);
  const int made = beside ? make_film(run, *beside, assets, film, sink) : make_film(run, assets, film, sink);
  if (video) video->close();
  display.clear();
  err << "trocar: " << made << " frames in " << (video ? options.video : options.frames).string() << '\n';
  if (run.plays_keyframes()) return std::nullopt;
  return run.outcome();
}

}  // namespace trocar
