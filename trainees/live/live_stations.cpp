#include "trainees/live/live_stations.h"

#include <algorithm>
#include <tuple>

#include "haptics/input_error.h"
#include "trainees/live/live_clock.h"
#include "trainees/live/live_folder.h"
#include "trainees/live/live_publisher.h"

namespace trocar {
namespace {

constexpr double kPictureOld_s = 5;  ///< from here on it is not of this moment
constexpr double kSilence_s = 3;     ///< longer than any program needs to answer a look

using State = LiveStation::State;

bool lives(const ProcessIdentity& process) {
  try {
    return process_lives(process);
  } catch (const EnvironmentError&) {
    return true;  // not known: its silence will tell
  }
}

/// @param look_s how long ago a desk looked before this time; nothing: it did not, or nobody could have answered yet.
LiveStation judged(StatusSnapshot told, const std::string& here, std::optional<double> look_s, double file_age_s) {
  const bool elsewhere = told.machine != here;  // its processes are not to be seen from here, nor is its clock of boot
  LiveStation out;
  out.age_s = std::max(0.0, elsewhere ? file_age_s : since_boot_s() - told.told_s);
  const bool asked = look_s && *look_s < LivePublisher::kLookedFor_s;
  if (!elsewhere && !lives(told.process))
    out.state = State::kEnded;
  else if (asked && out.age_s > *look_s + kSilence_s)
    out.state = State::kQuiet;
  if (out.state == State::kEnded) out.age_s = std::max(0.0, file_age_s);  // over a boot too
  out.told = std::move(told);
  return out;
}

}  // namespace

LiveStations look_at_stations(const std::filesystem::path& database) {
  LiveFolder folder(database, LiveFolder::Open::kExisting);
  LiveStations out;
  out.refusal = folder.refusal();
  if (!folder.open()) return out;
  const std::string here = machine_name();
  const std::optional<double> look_s = folder.last_look_s();
  for (const std::string& name : folder.names()) {
    const std::optional<std::string> text = folder.read(name);
    std::optional<StatusSnapshot> told = text ? parse_live_text(*text) : std::nullopt;
    const double age_s = folder.age_s(name).value_or(0);
    if (!told) {
      if (text || folder.age_s(name))
        out.unreadable.push_back(name);
      else if (std::filesystem::is_symlink(LiveFolder::beside(database) / name))
        out.unreadable.push_back(name);
      continue;  // else it went between listing and reading: its program ended
    }
    LiveStation station = judged(std::move(*told), here, look_s, age_s);
    if (station.state == State::kEnded && station.age_s > LivePublisher::kLeftFor_s) continue;
    const std::string picture = LiveFolder::picture_of(name);
    if (station.state == State::kRunning && folder.age_s(picture).value_or(kPictureOld_s) < kPictureOld_s)
      station.picture = picture;
    out.stations.push_back(std::move(station));
  }
  folder.look();
  std::sort(out.stations.begin(), out.stations.end(), [](const LiveStation& a, const LiveStation& b) {
    return std::tuple(a.state, a.told.moment.trainee, a.told.process.pid) <
           std::tuple(b.state, b.told.moment.trainee, b.told.process.pid);
  });
  return out;
}

std::optional<std::string> look_at_picture(const std::filesystem::path& database, const std::string& name) {
  const bool plain = name.find_first_not_of("0123456789abcdef-.jpg") == std::string::npos;
  if (!plain || !name.ends_with(LiveFolder::kPicture)) return {};
  LiveFolder folder(database, LiveFolder::Open::kExisting);
  std::optional<std::string> out = folder.read(name);
  if (out && !out->starts_with("\xFF\xD8")) return {};  // no JPEG: a browser need not guess what it is
  folder.look();
  return out;
}

}  // namespace trocar
