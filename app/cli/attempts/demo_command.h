// `trocar demo --headless`: the whole chain once, for someone who has just built the program: picture, score, report.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct DemoOptions {
  std::filesystem::path output = "demo";
  std::string exercise = "surface-touch";
  std::string level = "L1";
  std::string organ = "phantom-liver";
  std::filesystem::path video = {};  ///< empty: no film
};

/// Leaves picture.png, score.json, report.html and demo.db with its recordings in the folder, and the film where it
/// shall be; again and again. @return exit code.
int demo_command(const DemoOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
