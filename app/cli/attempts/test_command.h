// `trocar test`: scripted attempts with expectations, a folder of them.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct TestOptions {
  std::vector<std::filesystem::path> paths;  ///< folders (every *.test.toml in them, deeper ones too) and files
  std::string filter;                        ///< only tests whose file or name has this in it
  std::filesystem::path junit;               ///< XML for CI; empty: none
  int jobs = 0;                              ///< at once; 0: one a processor
  bool list = false;                         ///< names only, nothing is run
};

/// Results in the order of the files, whatever `jobs`. @return 0 all passed, 1 one failed, 2 one cannot be read (the
/// others are run all the same).
int test_command(const TestOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
