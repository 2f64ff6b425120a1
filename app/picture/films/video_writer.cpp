#include "app/picture/films/video_writer.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>
#include <vector>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kMostWords = 600;  // of ffmpeg's last ones

const std::map<std::string, std::vector<std::string>>& encoders() {
  static const std::vector<std::string> h264{"-c:v", "libx264", "-preset",  "veryfast",
                                             "-crf", "18",      "-pix_fmt", "yuv420p"};
  static const std::vector<std::string> vp9{"-c:v", "libvpx-vp9", "-crf", "28",      "-b:v", "0",        "-deadline",
                                            "good", "-cpu-used",  "5",    "-row-mt", "1",    "-pix_fmt", "yuv420p"};
  static const auto with = [](std::vector<std::string> list, std::initializer_list<std::string> more) {
    list.insert(list.end(), more);
    return list;
  };
  static const std::map<std::string, std::vector<std::string>> known{
      {".mp4", with(h264, {"-movflags", "+faststart", "-f", "mp4"})},
      {".mkv", with(h264, {"-f", "matroska"})},
      {".webm", with(vp9, {"-f", "webm"})}};
  return known;
}

std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::vector<std::string> arguments(const std::string& ffmpeg, const std::filesystem::path& file,
                                   const std::filesystem::path& part, int width, int height, double fps) {
  std::vector<std::string> out{ffmpeg,       "-hide_banner", "-loglevel",
                               "error",      "-xerror",      "-nostdin",
                               "-f",         "rawvideo",     "-pix_fmt",
                               "rgb24",      "-video_size",  std::to_string(width) + "x" + std::to_string(height),
                               "-framerate", number(fps),    "-i",
                               "pipe:0",     "-vf",          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                               "-fflags",    "+bitexact",    "-flags:v",
                               "+bitexact"};
  const auto& encoder = encoders().at(file.extension().string());
  out.insert(out.end(), encoder.begin(), encoder.end());
  // A file name that begins with a dash is no option, and one with a colon no protocol.
  out.insert(out.end(), {"-y", "file:" + std::filesystem::absolute(part).string()});
  return out;
}

struct Descriptor {
  int fd = -1;
  ~Descriptor() { close(); }
  void close() {
    if (fd >= 0) ::close(fd);
    fd = -1;
  }
};

/// Everything that a spawned program begins with: no signal blocked or ignored, a group of its own, so that Ctrl-C ends
/// the attempt and the film is still finished.
struct SpawnRules {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnRules() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnRules() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

[[noreturn]] void no_start(const std::string& ffmpeg, int error) {
  throw EnvironmentError(ffmpeg + ": cannot be started: " + std::strerror(error));
}

pid_t spawn(const std::vector<std::string>& words, int input, int output, int errors) {
  SpawnRules rules;
  posix_spawn_file_actions_adddup2(&rules.files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&rules.files, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&rules.files, errors, STDERR_FILENO);
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, words.front().c_str(), &rules.files, &rules.attributes, argv.data(), environ);
  if (error != 0) no_start(words.front(), error);
  return pid;
}

}  // namespace

std::string find_ffmpeg() {
  const char* path = std::getenv("PATH");
  std::string rest = path ? path : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::filesystem::path file = std::filesystem::path(rest.substr(0, colon)) / "ffmpeg";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) return file.string();
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return "";
}

void check_video_file(const std::filesystem::path& file) {
  if (!encoders().contains(file.extension().string()))
    throw InputError(file.string() + ": a film's name ends with .mp4, .webm or .mkv");
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw InputError(file.string() + ": exists; a film is never overwritten");
  if (!find_ffmpeg().empty()) return;
  throw EnvironmentError(
      "ffmpeg is not on PATH (Debian: apt install ffmpeg); without it --frames DIR writes numbered pictures");
}

struct VideoWriter::State {
  std::filesystem::path file, part;
  int width = 0, height = 0, frames = 0;
  Descriptor pipe, words;
  pid_t pid = -1;

  std::string last_words() const;
  int wait();
  [[noreturn]] void fail(const std::string& what);
  void finish();
};

std::string VideoWriter::State::last_words() const {
  const off_t size = ::lseek(words.fd, 0, SEEK_END);
  if (size <= 0) return "";
  const auto from = std::max<off_t>(0, size - static_cast<off_t>(kMostWords));
  std::string text(static_cast<std::size_t>(size - from), '\0');
  const ssize_t got = ::pread(words.fd, text.data(), text.size(), from);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

int VideoWriter::State::wait() {
  pipe.close();
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) {
      status = -1;
      break;
    }
  }
  pid = -1;
  return status;
}

void VideoWriter::State::fail(const std::string& what) {
  if (pid > 0) wait();
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  const std::string said = last_words();
  throw EnvironmentError(file.string() + ": " + what + (said.empty() ? "" : ": " + said));
}

void VideoWriter::State::finish() {
  if (pid < 0) return;
  const int status = wait();
  if (status != 0) fail("the film could not be finished by ffmpeg");
  if (frames == 0) fail("no picture was made for it");
  std::error_code error;
  // A link never replaces what has come to lie there meanwhile; file systems without links get a plain renaming.
  std::filesystem::create_hard_link(part, file, error);
  if (error == std::errc::file_exists) fail("exists by now; the film is not kept");
  if (!error)
    std::filesystem::remove(part, error);
  else
    std::filesystem::rename(part, file, error);
  if (error) fail("cannot be written: " + error.message());
}

VideoWriter::VideoWriter(const std::filesystem::path& file, int width, int height, double fps)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  if (width < 16 || height < 16 || !(fps > 0))
    throw std::invalid_argument("a film has at least 16 x 16 px and some pictures a second");
  check_video_file(file);
  s.file = file;
  s.part = file.string() + ".part";
  s.width = width;
  s.height = height;
  // ffmpeg would say it too, but only after the first picture.
  const Descriptor trial{::open(s.part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)};
  if (trial.fd < 0) throw EnvironmentError(file.string() + ": cannot be written: " + std::strerror(errno));
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) no_start("ffmpeg", errno);
  s.pipe.fd = ends[0];
  const Descriptor theirs{ends[1]};
  s.words.fd = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  if (s.words.fd < 0) no_start("ffmpeg", errno);
  s.pid = spawn(arguments(find_ffmpeg(), file, s.part, width, height, fps), theirs.fd, s.words.fd, s.words.fd);
}

VideoWriter::~VideoWriter() {
  if (!state_ || state_->pid < 0) return;
  ::kill(state_->pid, SIGKILL);
  state_->wait();
  std::error_code ignored;
  std::filesystem::remove(state_->part, ignored);
}

void VideoWriter::add(const Image& image) {
  State& s = *state_;
  if (image.width != s.width || image.height != s.height)
    throw std::invalid_argument("a film's pictures are of one size");
  if (s.pid < 0) throw std::logic_error("the film has been ended");
  const auto* bytes = image.rgb.data();
  for (std::size_t left = image.rgb.size(); left > 0;) {
    const ssize_t sent = ::send(s.pipe.fd, bytes, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) s.fail("ffmpeg ended before the film did");
    bytes += sent;
    left -= static_cast<std::size_t>(sent);
  }
  ++s.frames;
}

void VideoWriter::close() { state_->finish(); }
int VideoWriter::frames() const { return state_->frames; }

}  // namespace trocar
