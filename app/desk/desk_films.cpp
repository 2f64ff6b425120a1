#include "app/desk/desk_films.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

#include "app/picture/films/film.h"
#include "app/picture/films/video_writer.h"
#include "app/picture/gl/headless_context.h"
#include "app/session/keeping/recording_check.h"
#include "haptics/input_error.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_store.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;
using review::FilmState;

constexpr double kReplayShare = 0.25;  ///< of the work, before the first picture
constexpr std::chrono::hours kPartFor{1};
constexpr int kNice = 10;  ///< pages and attempts come first

/// Owner's alone. @throws EnvironmentError
fs::path own_folder(const fs::path& database) {
  const fs::path folder = database.parent_path() / (database.stem().string() + ".films");
  ::mkdir(folder.c_str(), 0700);
  struct stat found = {};
  if (::lstat(folder.c_str(), &found) != 0 || !S_ISDIR(found.st_mode))
    throw EnvironmentError(folder.string() + ": cannot be made, so no films are kept");
  if (found.st_uid != ::geteuid() || (found.st_mode & 0077) != 0)
    throw EnvironmentError(folder.string() + ": belongs to another user or is open to others, so no films are kept");
  return folder;
}

/// Thrown through a replay or film: the desk ends.
struct Ended {};

struct Subject {
  std::string trainee;
  fs::path recording;
};

/// @throws InputError
Subject subject_of(Database& database, const std::string& uuid) {
  const AttemptStore store(database);
  const AttemptSummary found = store.find(uuid);
  if (found.uuid != uuid) throw InputError("attempt " + uuid + ": there is none");
  const AttemptResult stored = store.load(found.row);
  const std::string& file = stored.recording_path;
  std::error_code ignored;
  if (file.empty() || !fs::is_regular_file(file, ignored))
    throw InputError("attempt " + uuid + ": there is no recording of it, so there can be no film");
  if (const std::string foreign = foreign_recording(database, stored); !foreign.empty())
    throw InputError("attempt " + uuid + ": " + foreign);
  return {found.trainee, file};
}

}  // namespace

struct DeskFilms::State {
  State(AssetRoots roots, const fs::path& database, std::function<Database()> opener)
      : assets(std::move(roots)), folder(own_folder(database)), open(std::move(opener)) {}

  fs::path file_of(const std::string& uuid) const {
    require_name_of_attempt(uuid);
    return folder / (uuid + ".mp4");
  }
  void sweep();
  void work(const std::string& uuid, const Subject& subject) noexcept;
  void film(const std::string& uuid, const Subject& subject);
  void going(double part) {
    share = part;
    if (ends) throw Ended();
  }
  void join() {
    if (thread.joinable()) thread.join();
  }

  AssetRoots assets;
  fs::path folder;
  std::function<Database()> open;
  std::mutex mutex;                 // guards making, failed, why, thread
  std::string making, failed, why;  // UUIDs; why the last one failed
  std::atomic<double> share{0};
  std::atomic<bool> ends{false};
  std::thread thread;
};

/// Films without a recording, parts of films that were cut off, and the oldest of too many.
void DeskFilms::State::sweep() {
  struct Kept {
    fs::path file;
    fs::file_time_type time;
    std::uintmax_t bytes;
  };
  std::vector<Kept> kept;
  std::uintmax_t all = 0;
  Database database = open();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::error_code error;
    if (entry.path().extension() == ".part" &&
        fs::file_time_type::clock::now() - entry.last_write_time(error) < kPartFor)
      continue;  // another desk on this database makes it
    bool stays = entry.path().extension() == ".mp4" && entry.is_regular_file(error) && !entry.is_symlink(error);
    try {
      if (stays) subject_of(database, entry.path().stem().string());
    } catch (const InputError&) {
      stays = false;
    }
    if (!stays) {
      fs::remove(entry.path(), error);
      continue;
    }
    kept.push_back({entry.path(), entry.last_write_time(error), entry.file_size(error)});
    all += kept.back().bytes;
  }
  std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.time < b.time; });
  for (std::size_t i = 0; i < kept.size() && all > kMostBytes; ++i) {
    std::error_code ignored;
    fs::remove(kept[i].file, ignored);
    all -= kept[i].bytes;
  }
}

void DeskFilms::State::film(const std::string& uuid, const Subject& subject) {
  const RecordedRun run(subject.recording, assets, "", [this](double part) {
    going(kReplayShare * part);
    return true;
  });
  FilmOptions options;
  options.fps = kFps;
  options.width = kWidth;
  options.height = kHeight;
  options.name = subject.trainee;
  {
    const HeadlessContext context;
    options.preset = context.info().software ? Preset::kSoft : Preset::kFull;
  }
  options.progress = [this](int done, int of) {
    going(kReplayShare + (1 - kReplayShare) * done / of);
    return true;
  };
  VideoWriter video(file_of(uuid), options.width, options.height, options.fps);
  make_film(run, assets, options, [&video](const Image& image) { video.add(image); });
  video.close();
  ::chmod(file_of(uuid).c_str(), 0600);
}

void DeskFilms::State::work(const std::string& uuid, const Subject& subject) noexcept {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::syscall(SYS_gettid)), kNice);
  std::string reason;
  try {
    film(uuid, subject);
  } catch (const Ended&) {
    reason = "The desk was closed before the film was done.";
  } catch (const std::exception& error) {
    reason = error.what();
  }
  const std::scoped_lock lock(mutex);
  failed = reason.empty() ? "" : uuid;
  why = reason;
  making.clear();
}

DeskFilms::DeskFilms(AssetRoots assets, const fs::path& database, std::function<Database()> open)
    : state_(std::make_unique<State>(std::move(assets), database, std::move(open))) {
  state_->sweep();
}

DeskFilms::~DeskFilms() {
  state_->ends = true;
  state_->join();
}

std::string DeskFilms::refusal() {
  if (find_ffmpeg().empty()) return "No film: the program ffmpeg is not on this machine (Debian: apt install ffmpeg).";
  try {
    const HeadlessContext context;
    return "";
  } catch (const EnvironmentError& error) {
    return std::string("No film: ") + error.what();
  }
}

FilmState DeskFilms::state(const std::string& uuid) {
  State& s = *state_;
  FilmState out;
  const std::scoped_lock lock(s.mutex);
  if (s.making == uuid) {
    out.stage = FilmState::Stage::kMaking;
    out.share = s.share;
    out.words = out.share < kReplayShare ? "The run is replayed." : "Pictures are made.";
    return out;
  }
  struct stat found = {};
  if (::lstat(s.file_of(uuid).c_str(), &found) == 0 && S_ISREG(found.st_mode)) {
    out.stage = FilmState::Stage::kReady;
    out.bytes = static_cast<std::uint64_t>(found.st_size);
  } else if (s.failed == uuid) {
    out.stage = FilmState::Stage::kFailed;
    out.words = "The film could not be made: " + s.why;
  }
  return out;
}

void DeskFilms::make(const std::string& uuid) {
  State& s = *state_;
  Database database = s.open();
  const Subject subject = subject_of(database, uuid);
  const std::scoped_lock lock(s.mutex);
  if (s.making == uuid || fs::is_regular_file(fs::symlink_status(s.file_of(uuid)))) return;
  if (!s.making.empty())
    throw InputError("the film of another attempt is being made (" + std::to_string(static_cast<int>(100 * s.share)) +
                     " % of it): one is made at a time, come again then");
  if (s.ends) throw InputError("the desk is being closed");
  s.join();  // of the one before, which has ended
  s.sweep();
  s.share = 0;
  s.failed.clear();
  s.making = uuid;
  s.thread = std::thread([&s, uuid, subject] { s.work(uuid, subject); });
}

std::string DeskFilms::part(const std::string& uuid, std::uint64_t from, std::uint64_t count) {
  const int file = ::open(state_->file_of(uuid).c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) throw InputError("attempt " + uuid + ": there is no film of it");
  std::string out(count, '\0');
  std::size_t have = 0;
  while (have < out.size()) {
    const ssize_t n = ::pread(file, out.data() + have, out.size() - have, static_cast<off_t>(from + have));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    have += static_cast<std::size_t>(n);
  }
  ::close(file);
  out.resize(have);
  if (have == 0) throw InputError("attempt " + uuid + ": its film has gone");
  return out;
}

}  // namespace trocar
