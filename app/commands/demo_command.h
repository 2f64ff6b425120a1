// `trocar demo --headless`: the whole chain once, for someone who has just built the program: picture, score, report.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace trocar {

struct DemoOptions {
  std::filesystem::path output = "demo";
  std::string exercise = "surface-touch";
  std::string level = "L1";
  std::string organ = "phantom-liver";
};

/// Leaves picture.png, score.json, report.html and demo.db with its recordings in the folder; again and again. @return exit code.
int demo_command(const DemoOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
