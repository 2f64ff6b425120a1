#include "app/window/attempt/settings.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <toml++/toml.h>

#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "tissue/organ/staged_file.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr int kVersion = 1;
const std::vector<std::string> kPresets{"auto", "low", "soft", "full"};
const std::vector<std::string> kScopes{"0", "30"};
const std::vector<std::string> kInputs{"auto", "mouse", "gamepad", "spacemouse", "device"};

/// [keys] maps names freely; StrictTable asks for names that it knows.
std::map<std::string, std::string> keys_of(const toml::table& document, const std::string& file) {
  std::map<std::string, std::string> keys;
  const toml::table* table = document["keys"].as_table();
  for (const auto& [name, node] : table ? *table : toml::table{}) {
    const auto key = node.value_exact<std::string>();
    const auto at = node.source().begin;
    if (!key)
      throw InputError(file, static_cast<int>(at.line), static_cast<int>(at.column),
                       "keys: a key is given by its name in quotes");
    keys[std::string(name)] = *key;
  }
  return keys;
}

Settings parse(const std::string& text, const std::string& file) {
  Settings settings;
  StrictTable table = StrictTable::parse(text, file);
  const int version = table.integer_or("version", 1, 1000000, kVersion);
  if (version > kVersion)
    throw InputError(file + ": written by a newer trocar (version " + std::to_string(version) + ")");
  settings.language = table.text_or("language", settings.language);
  settings.scale = table.number_or("scale", 1, 2, settings.scale);
  settings.left_handed = table.flag_or("left_handed", settings.left_handed);
  settings.like_a_fulcrum = table.flag_or("like_a_fulcrum", settings.like_a_fulcrum);
  settings.sensitivity = table.number_or("sensitivity", 0.25, 4, settings.sensitivity);
  settings.sound = table.flag_or("sound", settings.sound);
  settings.tutorial_seen = table.flag_or("tutorial_seen", settings.tutorial_seen);
  settings.scope = table.choice_or("scope", kScopes, settings.scope);
  settings.preset = table.choice_or("preset", kPresets, settings.preset);
  settings.input = table.choice_or("input", kInputs, settings.input);
  settings.ask_pin = table.flag_or("ask_pin", settings.ask_pin);
  table.allow("keys");
  table.finish();
  settings.keys = keys_of(toml::parse(text, file), file);
  return settings;
}

/// Line of a message "FILE:LINE:COLUMN: what"; 0: it has none.
int line_in(const std::string& message, const std::string& file) {
  const bool placed = message.size() > file.size() && message.starts_with(file) && message[file.size()] == ':';
  return placed ? std::atoi(message.c_str() + file.size() + 1) : 0;
}

/// Nothing that could not be read is overwritten: it is moved aside first.
void keep_unread(const fs::path& file) {
  if (load_settings(file).note.empty()) return;
  std::error_code error;
  fs::rename(file, unread_settings(file), error);
  if (error) throw EnvironmentError(file.string() + ": cannot be read, nor moved aside: " + error.message());
}

}  // namespace

fs::path settings_file() {
  const auto folder = [](const char* name) -> fs::path {
    const char* value = std::getenv(name);
    return value && *value ? fs::path(value) : fs::path();
  };
  if (const fs::path config = folder("XDG_CONFIG_HOME"); config.is_absolute())
    return config / "trocar" / "settings.toml";
  if (const fs::path home = folder("HOME"); !home.empty()) return home / ".config" / "trocar" / "settings.toml";
  return {};
}

fs::path unread_settings(const fs::path& file) { return file.string() + ".unread"; }

Settings load_settings(const fs::path& file) {
  std::error_code error;
  if (file.empty() || !fs::exists(file, error)) return {};
  try {
    return parse(read_text_file(file.string()), file.string());
  } catch (const InputError& damaged) {
    Settings defaults;
    defaults.note = damaged.what();
    defaults.note_line = line_in(defaults.note, file.string());
    return defaults;
  }
}

void save_settings(const fs::path& file, const Settings& settings) {
  if (file.empty()) throw EnvironmentError("settings: neither XDG_CONFIG_HOME nor HOME is set");
  keep_unread(file);
  toml::table keys;
  for (const auto& [action, key] : settings.keys) keys.insert(action, key);
  toml::table table{{"version", kVersion},
                    {"scale", settings.scale},
                    {"left_handed", settings.left_handed},
                    {"like_a_fulcrum", settings.like_a_fulcrum},
                    {"sensitivity", settings.sensitivity},
                    {"sound", settings.sound},
                    {"tutorial_seen", settings.tutorial_seen},
                    {"scope", settings.scope},
                    {"preset", settings.preset},
                    {"input", settings.input},
                    {"ask_pin", settings.ask_pin},
                    {"keys", keys}};
  if (!settings.language.empty()) table.insert("language", settings.language);
  std::ostringstream text;
  text << "# What was chosen in the window of trocar; it writes this file anew.\n" << table << '\n';
  StagedFile staged(file, text.str());
  staged.commit();
}

}  // namespace trocar
