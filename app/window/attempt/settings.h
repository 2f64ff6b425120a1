// What a person has chosen and the program keeps: $XDG_CONFIG_HOME/trocar/settings.toml.
//
// A file that is damaged or newer is left alone and the defaults are used; load() says so in `note`. Thread: the
// window's.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace trocar {

struct Settings {
  std::string language = "";  ///< "": from LANG, English when there is no catalogue
  double scale = 1;           ///< of text and buttons, 1 to 2
  bool left_handed = false;
  bool like_a_fulcrum = false;
  double sensitivity = 1;
  bool sound = true;
  bool tutorial_seen = false;   ///< it has been begun here once
  std::string scope = "0";      ///< tilt of the scope's tip, degrees: "0", "30"
  std::string preset = "auto";  ///< "auto", "low", "soft", "full"
  std::string input = "auto";   ///< "auto", "mouse", "gamepad", "spacemouse", "device"
  bool ask_pin = false;  ///< of this station: whoever has an account at the desk signs in with its PIN or password
  std::map<std::string, std::string> keys = {};  ///< changes of KeyMap
  std::string note = {};                         ///< what went wrong while loading, for who mends the file; not saved
  int note_line = 0;                             ///< of the file where it went wrong; 0: not known
};

std::filesystem::path settings_file();
/// Where save_settings() puts a file that could not be read.
std::filesystem::path unread_settings(const std::filesystem::path& file);
Settings load_settings(const std::filesystem::path& file);
/// Whole or not at all. @throws EnvironmentError.
void save_settings(const std::filesystem::path& file, const Settings& settings);

}  // namespace trocar
