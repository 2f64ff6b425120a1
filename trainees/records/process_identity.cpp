#include "trainees/records/process_identity.h"

#include <unistd.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "haptics/input_error.h"

namespace trocar {
namespace {

std::string boot_id() {
  std::ifstream in("/proc/sys/kernel/random/boot_id");
  std::string id;
  if (!(in >> id)) throw EnvironmentError("/proc/sys/kernel/random/boot_id cannot be read");
  return id;
}

/// Start time of a running process; nothing when there is none or it is a zombie.
std::optional<std::int64_t> start_of(std::int64_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(in, line)) return std::nullopt;
  // The name in parentheses may hold anything, so fields are counted from the last ')': the state is field 3.
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  std::string state, skipped;
  fields >> state;
  for (int field = 4; field < 22; ++field) fields >> skipped;
  std::int64_t start = 0;
  if (!(fields >> start) || state == "Z" || state == "X") return std::nullopt;
  return start;
}

}  // namespace

ProcessIdentity this_process() {
  const auto start = start_of(getpid());
  if (!start) throw EnvironmentError("/proc/self/stat cannot be read");
  return {getpid(), boot_id(), *start};
}

bool process_lives(const ProcessIdentity& process) {
  return process.boot == boot_id() && start_of(process.pid) == process.start;
}

}  // namespace trocar
