#include "app/cli/machine/doctor_command.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/timex.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/machine/doctor_probes.h"
#include "app/picture/gl/headless_context.h"
#include "app/session/lanes/real_time.h"
#include "app/session/setup/scene.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/device/hostmot2/hostmot2_daq.h"
#include "haptics/input_error.h"
#include "scenarios/files/device_file.h"
#include "scenarios/files/exercise_loader.h"
#include "trainees/store/database.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr double kMiB = 1024.0 * 1024.0;
constexpr double kBudgetMiBPerMinute = 0.6;  // a recording's budget: what free room is worth in minutes
constexpr double kLeastFreeMiB = 100;        // an hour of recordings and the database with room to spare
constexpr int kLoopPriority = 80;            // SCHED_FIFO priority that a live loop asks for

enum class State : std::uint8_t { kGood, kWarning, kProblem };

struct Finding {
  const char* name;
  State state = State::kGood;
  std::string text;
};

const char* state_name(State state) {
  switch (state) {
    case State::kGood:
      return "ok";
    case State::kWarning:
      return "warning";
    case State::kProblem:
      return "problem";
  }
  return "";
}

/// The text that `look` gives, or what it throws as a problem.
Finding needed(const char* name, const std::function<std::string()>& look) {
  try {
    return {name, State::kGood, look()};
  } catch (const std::exception& error) {
    return {name, State::kProblem, error.what()};
  }
}

std::string picture() {
  const HeadlessContext context;
  const ContextInfo& info = context.info();
  return info.renderer + ", OpenGL " + info.version + " on " + info.platform +
         (info.software ? ": drawn by the processor" : "");
}

std::string assets() {
  const AssetRoots roots = find_assets();
  return roots.assets.string() + ", " + std::to_string(list_exercises(roots.exercises).size()) + " exercises in " +
         roots.exercises.string();
}

/// The folder of a file, or the nearest above it that is there.
fs::path nearest_folder(const fs::path& file) {
  fs::path folder = file.parent_path();
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

std::string not_writable(const fs::path& place) {
  return place.string() + ": is not writable; give another place by --db FILE or XDG_DATA_HOME";
}

std::string database(const fs::path& file) {
  const auto schema = schema_of_file(file);
  const fs::path folder = nearest_folder(file);
  for (const fs::path& place : {schema ? file : folder, folder})  // beside it lie its log and the recordings
    if (access(place.c_str(), W_OK) != 0) throw EnvironmentError(not_writable(place));
  if (!schema) return file.string() + ": not there yet, the first attempt makes it";
  const int known = shipped_migrations().back().version;
  std::string text = file.string() + ": schema " + std::to_string(*schema);
  if (*schema < known) text += ", migrated to " + std::to_string(known) + " when it is next opened";
  return text;
}

/// Room where the database and its recordings lie, or will.
Finding disk_room(const fs::path& file) {
  const fs::path folder = nearest_folder(file);
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error) return {"disk", State::kProblem, folder.string() + ": " + error.message()};
  if (access(folder.c_str(), W_OK) != 0) return {"disk", State::kProblem, not_writable(folder)};
  const double free = static_cast<double>(space.available) / kMiB;
  const auto minutes = static_cast<long long>(free / kBudgetMiBPerMinute);
  return {"disk", free < kLeastFreeMiB ? State::kProblem : State::kGood,
          std::to_string(static_cast<long long>(free)) + " MiB free in " + folder.string() + ", about " +
              std::to_string(minutes / 60) + " h of recordings"};
}

std::string first_line(const fs::path& file) {
  std::string line;
  std::ifstream in(file);
  std::getline(in, line);
  return line;
}

/// The kernel and its rights are the host's: what is missing is asked for where the container is started.
bool in_container() {
  std::error_code error;
  const char* named = std::getenv("container");
  return (named && *named) || fs::exists("/.dockerenv", error) || fs::exists("/run/.containerenv", error) ||
         !first_line("/run/systemd/container").empty();
}

/// Whether this process has a capability of Linux. @param number of capabilities(7)
bool capable(unsigned number) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::string mask; word == "CapEff:" && status >> mask)
      return (std::strtoull(mask.c_str(), nullptr, 16) >> number & 1) != 0;
  return false;
}

Finding kernel() {
  utsname name = {};
  uname(&name);
  const std::string text = std::string(name.sysname) + " " + name.release;
  if (first_line("/sys/kernel/realtime") == "1") return {"kernel", State::kGood, text + ", real-time"};
  return {"kernel", State::kWarning,
          text + (in_container() ? ": not a real-time kernel; it is the host's: a device wants one there"
                                 : ": not a real-time kernel; for a device: apt install linux-image-rt-amd64")};
}

/// How a process comes to the rights of a live loop, said once.
std::string way_to_rights() {
  if (in_container())
    return "start the container with --cap-add=SYS_NICE --cap-add=IPC_LOCK --ulimit rtprio=" +
           std::to_string(kLoopPriority) + " --ulimit memlock=-1";
  if (geteuid() == 0)
    return "this is root without CAP_SYS_NICE and CAP_IPC_LOCK: whoever started it took them away (systemd: "
           "CapabilityBoundingSet=)";
  return "put \"@realtime - rtprio " + std::to_string(kLoopPriority) +
         "\" and \"@realtime - memlock unlimited\" into /etc/security/limits.d/trocar.conf, then sudo groupadd -f "
         "realtime, sudo usermod -aG realtime $USER, and log in anew";
}

/// Whether a thread here really gets what a live loop asks for.
Finding real_time() {
  bool got = false;
  std::thread([&got] { got = become_real_time(kLoopPriority).empty(); }).join();
  if (got) return {"real-time", State::kGood, "a thread gets SCHED_FIFO " + std::to_string(kLoopPriority)};
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  return {"real-time", State::kWarning,
          "a thread does not get SCHED_FIFO " + std::to_string(kLoopPriority) + " (limit rtprio " +
              std::to_string(limit.rlim_cur) +
              "), scores of a device would be marked as soft real time: " + way_to_rights()};
}

Finding locked_memory() {
  constexpr unsigned kIpcLock = 14;
  constexpr double kLeastMiB = 256;
  if (capable(kIpcLock)) return {"memlock", State::kGood, "all memory may be locked"};
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur == RLIM_INFINITY) return {"memlock", State::kGood, "unlimited"};
  const double mib = static_cast<double>(limit.rlim_cur) / kMiB;
  const std::string text = std::to_string(std::lround(mib)) + " MiB";
  if (mib >= kLeastMiB) return {"memlock", State::kGood, text};
  return {"memlock", State::kWarning,
          text + ": a live loop could not lock its memory and may wait for a page: as for real-time"};
}

Finding idle_states() {
  if (ProcessorsAwake().held()) return {"idle-states", State::kGood, "a live loop keeps the processors out of them"};
  return {
      "idle-states", State::kWarning,
      std::string("/dev/cpu_dma_latency cannot be written: a live loop wakes up later where the processors rest; ") +
          (in_container() ? "start the container with --device /dev/cpu_dma_latency"
                          : "put KERNEL==\"cpu_dma_latency\", GROUP=\"realtime\", MODE=\"0660\" into "
                            "/etc/udev/rules.d/99-trocar.rules, for the group of real-time")};
}

Finding governor() {
  const std::string now = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  if (now.empty()) return {"governor", State::kGood, "the processors' clock is not this system's to set"};
  if (now == "performance") return {"governor", State::kGood, now};
  return {"governor", State::kWarning,
          now + ": the clock sinks when it is idle; for a device: sudo cpupower frequency-set -g performance"};
}

Finding display() {
  const char *x = std::getenv("DISPLAY"), *wayland = std::getenv("WAYLAND_DISPLAY");
  std::string silent;
  if (wayland && *wayland) {
    if (wayland_answers(wayland)) return {"display", State::kGood, std::string("Wayland ") + wayland};
    silent = std::string("WAYLAND_DISPLAY=") + wayland;
  }
  if (x && *x) {
    if (x_answers(x)) return {"display", State::kGood, std::string("X ") + x};
    silent += (silent.empty() ? "DISPLAY=" : ", DISPLAY=") + std::string(x);
  }
  return {"display", State::kWarning,
          (silent.empty() ? "none" : silent + ": nothing answers there") +
              ": no window; trocar demo --headless, run and review work without"};
}

Finding locale() {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(variable);
    if (!value || !*value) continue;
    const std::string text = value;
    const bool utf8 = text.find("UTF-8") != std::string::npos || text.find("utf8") != std::string::npos;
    return {"locale", utf8 ? State::kGood : State::kWarning,
            std::string(variable) + "=" + text +
                (utf8 ? "" : ": not UTF-8; names of people and files are written as UTF-8 all the same")};
  }
  return {"locale", State::kWarning, "none is set: the window speaks English; names are written as UTF-8"};
}

Finding clock_state() {
  timex now = {};
  if (adjtimex(&now) != TIME_ERROR) return {"clock", State::kGood, "set by a time server"};
  return {"clock", State::kWarning,
          std::string("nobody sets it: times in the record are this machine's own; ") +
              (in_container() ? "on the host: " : "") + "sudo timedatectl set-ntp true"};
}

/// Files of a folder whose names begin so, with whether they may be used.
std::string devices(const fs::path& folder, const std::string& begin, bool& closed) {
  std::string out;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.path().filename().string().starts_with(begin)) continue;
    const bool open = access(entry.path().c_str(), R_OK | W_OK) == 0;
    closed = closed || !open;
    out += (out.empty() ? "" : ", ") + entry.path().string() + (open ? "" : " (no right)");
  }
  return out;
}

Finding serial_lines() {
  bool closed = false;
  const std::string found = devices("/dev", "ttyUSB", closed);
  if (found.empty()) return {"serial", State::kGood, "no USB serial line; a force sensor may be on one"};
  return {"serial", closed ? State::kWarning : State::kGood,
          found + (closed ? ": sudo usermod -aG dialout $USER, and log in anew" : "")};
}

/// Both boards that --card names, as the driver would need them.
Finding named_boards(const std::string& card) {
  const std::size_t comma = card.find(',');
  if (comma == std::string::npos)
    return {"boards", State::kProblem, card + ": two boards are expected, #0 first, with a comma: FOLDER,FOLDER"};
  Finding found{"boards", State::kGood, ""};
  for (const std::string& device : {card.substr(0, comma), card.substr(comma + 1)}) {
    const BoardLook look = look_at_board(device);
    if (!look.trouble.empty()) found.state = State::kProblem;
    found.text +=
        (found.text.empty() ? "" : "; ") +
        (look.trouble.empty() ? device + ": there, bound to " + (look.driver.empty() ? "no driver" : look.driver)
                              : look.trouble);
  }
  return found;
}

Finding boards(const std::string& card) {
  if (names_boards(card)) return named_boards(card);
  bool closed = false;
  const std::string found = devices("/dev", "uio", closed);
  if (found.empty())
    return {"boards", State::kGood, "no /dev/uio: no board is bound to it; docs/real_hardware.md says how"};
  return {"boards", closed ? State::kWarning : State::kGood,
          found + (closed ? ": a udev rule must give them to your group (docs/real_hardware.md)" : "")};
}

/// Whether one of this machine's networks is the one that a card is on.
Finding card_network(const std::string& given) {
  const std::string card = given.empty() ? Hostmot2Options{}.card : given;
  const std::string address = card.substr(0, card.find(':'));
  in_addr wanted{};
  if (::inet_pton(AF_INET, address.c_str(), &wanted) != 1) return {"network", State::kProblem, card + ": no address"};
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return {"network", State::kWarning, "this machine's networks cannot be listed"};
  std::string there;
  for (const ifaddrs* one = all; one; one = one->ifa_next) {
    if (!one->ifa_addr || !one->ifa_netmask || one->ifa_addr->sa_family != AF_INET) continue;
    const in_addr own = reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr,
                  mask = reinterpret_cast<const sockaddr_in*>(one->ifa_netmask)->sin_addr;
    if ((own.s_addr & mask.s_addr) == (wanted.s_addr & mask.s_addr) && mask.s_addr != 0)
      there = std::string(one->ifa_name) + ((one->ifa_flags & IFF_RUNNING) != 0U ? "" : ", whose cable is out");
  }
  ::freeifaddrs(all);
  if (!there.empty()) return {"network", State::kGood, address + ", where a Mesa card would be, lies on " + there};
  return {"network", given.empty() ? State::kGood : State::kWarning,
          "none leads to " + address +
              ", where a Mesa card would be: for one, give a port of its own an address beside " +
              "it (docs/real_hardware.md)"};
}

std::string card_words(const std::string& address) {
  hostmot2::CardInquiry card(address, Hostmot2Options{}.setup_wait_s);
  return card.identify().board + " at " + address + "; trocar device card " + address + " says more";
}

Finding force_sensor(const DoctorOptions& options) {
  constexpr auto kPatience = std::chrono::milliseconds(500);
  std::string doubt;
  Finding found = needed("sensor", [&] {
    const std::string& words = options.sensor;
    const auto sensor =
        make_force_sensor(words, options.device.empty() ? std::nullopt : load_device(options.device).sensor);
    std::this_thread::sleep_for(kPatience);
    if (!sensor->sample(Vec3::Zero()).valid)
      throw EnvironmentError(words + ": says nothing that holds; is it powered, and nothing else listening?");
    const WrenchLink link = sensor->link();
    doubt = link.counts.doubt;
    return words + ": " + std::to_string(link.records) + " records in half a second; " +
           (doubt.empty() ? counts_words(link.counts) : doubt);
  });
  if (!doubt.empty()) found.state = State::kWarning;
  return found;
}

std::vector<Finding> findings(const DoctorOptions& options) {
  fs::path file;
  std::string no_file;
  try {
    file = options.database.empty() ? default_database_path() : fs::absolute(options.database);
  } catch (const std::exception& error) {
    no_file = error.what();
  }
  const std::string mesa_card = names_boards(options.card) ? "" : options.card;
  std::vector<Finding> found{
      {"version", State::kGood,
       "trocar " TROCAR_VERSION ", database schema " + std::to_string(shipped_migrations().back().version)},
      {"processors", State::kGood, std::to_string(std::thread::hardware_concurrency())},
      needed("assets", assets),
      needed("picture", picture),
      no_file.empty() ? needed("database", [&] { return database(file); })
                      : Finding{"database", State::kProblem, no_file},
      kernel(),
      real_time(),
      locked_memory(),
      idle_states(),
      governor(),
      display(),
      locale(),
      clock_state(),
      serial_lines(),
      boards(options.card),
      card_network(mesa_card)};
  if (no_file.empty()) found.push_back(disk_room(file));
  if (!mesa_card.empty()) found.push_back(needed("card", [&] { return card_words(mesa_card); }));
  if (!options.sensor.empty()) found.push_back(force_sensor(options));
  return found;
}

}  // namespace

int doctor_command(const DoctorOptions& options, std::ostream& out, std::ostream&) {
  const std::vector<Finding> found = findings(options);
  const bool sound =
      std::none_of(found.begin(), found.end(), [](const Finding& f) { return f.state == State::kProblem; });
  if (options.json) {
    nlohmann::ordered_json json = {{"sound", sound}};
    for (const Finding& finding : found) {
      json["findings"].push_back(
          {{"name", finding.name}, {"state", state_name(finding.state)}, {"text", finding.text}});
    }
    out << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  } else {
    for (const Finding& finding : found) {
      out << std::left << std::setw(9) << state_name(finding.state) << std::setw(12) << finding.name << finding.text
          << '\n';
    }
  }
  return sound ? 0 : 3;
}

void add_doctor(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<DoctorOptions>();
  DoctorOptions& o = *given;
  CLI::App* doctor = add_command(parent, "doctor", "What this machine offers, and what is missing", chosen,
                                 [given] { return doctor_command(*given, std::cout, std::cerr); });
  doctor->add_option("--db", o.database, "Database file");
  doctor->add_option("--card", o.card, "Address of a Mesa card, to be asked too; or the thesis' boards, FOLDER,FOLDER");
  doctor->add_option("--sensor", o.sensor, "A force sensor, net-ft:ADDRESS or serial:DEVICE, to be heard too");
  doctor->add_option("--device", o.device, "Device file whose [sensor] says how many counts a newton has")
      ->check(file_name());
  doctor->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
