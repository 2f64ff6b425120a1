// The keys of one level; those that the level it is like has given may be left out.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include <string>

#include "scenarios/files/strict_toml.h"

namespace trocar {

struct LevelKeys {
  StrictTable& table;
  bool derived = false;  ///< another level's values stand already

  /// @param unit SI units in one unit of the key.
  void number(const std::string& key, double low, double high, double unit, double& value) {
    value = unit * (derived ? table.number_or(key, low, high, value / unit) : table.number(key, low, high));
  }
};

}  // namespace trocar
