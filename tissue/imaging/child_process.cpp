#include "tissue/imaging/child_process.h"

#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>

#include "haptics/input_error.h"

namespace trocar {
namespace {

enum class Outcome : unsigned char { kDone = 'D', kRefused = 'R', kNoMemory = 'M', kFailed = 'F' };

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

/// Kills and reaps the child unless it was reaped.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (reaped_) return;
    kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    reaped_ = true;
    return status;
  }

  /// @return whether it has ended
  bool ended(int& status) {
    const pid_t found = waitpid(id_, &status, WNOHANG);
    reaped_ = reaped_ || found == id_;
    return found == id_;
  }

 private:
  pid_t id_;
  bool reaped_ = false;
};

bool write_to_child(int file, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(file, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

/// Pages of this process, from which the limit of its child counts.
std::uint64_t address_space() {
  unsigned long pages = 0;
  if (FILE* statm = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(statm, "%lu", &pages) != 1) pages = 0;
    std::fclose(statm);
  }
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit(const ChildLimits& limits) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (!kLimitMemory) return;
  const auto most = static_cast<rlim_t>(address_space() + limits.memory_bytes);
  const rlimit memory{most, most};
  setrlimit(RLIMIT_AS, &memory);
}

Outcome answer(const std::function<std::string()>& work, std::string& bytes) {
  try {
    bytes = work();
    return Outcome::kDone;
  } catch (const InputError& error) {
    bytes = error.what();
    return Outcome::kRefused;
  } catch (const std::bad_alloc&) {
    return Outcome::kNoMemory;
  } catch (const std::exception& error) {
    bytes = error.what();
    return Outcome::kFailed;
  }
}

[[noreturn]] void be_child(int answers, const ChildLimits& limits, const std::function<std::string()>& work) {
  limit(limits);
  std::string bytes;
  const auto outcome = static_cast<char>(answer(work, bytes));
  const bool told = write_to_child(answers, &outcome, 1) && write_to_child(answers, bytes.data(), bytes.size());
  _exit(told ? 0 : 1);  // no destructors, no flushing of what the parent has in its buffers
}

std::string read_all(int file) {
  struct stat facts {};
  fstat(file, &facts);
  std::string bytes(static_cast<std::size_t>(facts.st_size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = pread(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

int wait_for(Child& child, const std::string& what, int seconds, const Progress& progress) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  int status = 0;
  for (int pause_us = 200; !child.ended(status); pause_us = pause_us < 20000 ? 2 * pause_us : pause_us) {
    if (std::chrono::steady_clock::now() > end)
      throw InputError(what + ": gave no result within " + std::to_string(seconds) + " s and was stopped");
    report(progress, "reading", -1);
    usleep(static_cast<useconds_t>(pause_us));
  }
  return status;
}

std::string taken(std::string& bytes, const std::string& what) {
  const auto outcome = static_cast<Outcome>(bytes[0]);
  bytes.erase(0, 1);
  switch (outcome) {
    case Outcome::kDone:
      return std::move(bytes);
    case Outcome::kRefused:
      throw InputError(bytes);
    case Outcome::kNoMemory:
      throw InputError(what + ": asks for more memory than an import may have");
    case Outcome::kFailed:
      break;
  }
  throw InputError(what + ": " + bytes);
}

}  // namespace

std::string in_child(const std::string& what, const ChildLimits& limits, const Progress& progress,
                     const std::function<std::string()>& work) {
  const Descriptor answers(memfd_create("trocar-import", MFD_CLOEXEC));
  if (answers.number() < 0) throw EnvironmentError("no memory file for a reader: " + std::string(std::strerror(errno)));
  std::fflush(nullptr);
  const pid_t id = fork();
  if (id < 0) throw EnvironmentError("no process for a reader: " + std::string(std::strerror(errno)));
  if (id == 0) be_child(answers.number(), limits, work);
  Child child(id);
  const int status = wait_for(child, what, limits.seconds, progress);
  if (WIFSIGNALED(status))
    throw InputError(what + ": the reader crashed (" + strsignal(WTERMSIG(status)) + "): the file is damaged");
  std::string bytes = read_all(answers.number());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty())
    throw InputError(what + ": the reader ended without a result: the file is damaged, or memory ran out");
  return taken(bytes, what);
}

}  // namespace trocar
