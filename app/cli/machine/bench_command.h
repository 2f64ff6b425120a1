// `trocar bench`: what one tick costs, by stage, how fast the lockstep runs, and what the organ compiler costs. Prints;
// never a test.
#pragma once

#include <iosfwd>
#include <string>

namespace trocar {

struct BenchOptions {
  std::string organ = "phantom-liver";
  std::string hand = "expert";
  bool json = false;
};

/// Compiles one organ, runs one attempt in memory, then times the loop and its stages over the recorded ticks. @return
/// 0.
int bench_command(const BenchOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
