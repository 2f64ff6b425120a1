// A practice model of its own folder for tests: nothing of the person who runs them is read or written.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "app/window/practice/practice_model.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::testing_support {

inline AssetRoots source_assets() {
  const std::filesystem::path root = TROCAR_SOURCE_DIR;
  return {root / "scenarios" / "exercises", root / "scenarios" / "hands", root / "assets"};
}

struct PracticeBench {
  test::TemporaryFolder folder;

  PracticeBench() { ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1); }

  /// Without sound: a machine that tests has none, and its library says so at length.
  ModelOptions options() const {
    if (!std::filesystem::exists(folder / "settings.toml"))
      folder.write("settings.toml", "version = 1\nsound = false\ntutorial_seen = true\n");
    ModelOptions o;
    o.database = folder.path() / "trocar.db";
    o.settings = folder.path() / "settings.toml";
    o.language = "en";
    o.seed = 7;
    return o;
  }
  std::unique_ptr<PracticeModel> model(const ModelOptions& given) const {
    return std::make_unique<PracticeModel>(given, source_assets());
  }
  std::unique_ptr<PracticeModel> model() const { return model(options()); }
};

}  // namespace trocar::testing_support
