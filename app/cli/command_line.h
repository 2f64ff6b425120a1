// The command line: which subcommands and flags there are, and which function each one calls.
//
// Its source and command_line_texts.cpp alone see CLI11. Exit codes: docs/commands.md.
#pragma once

namespace trocar {

/// Parses and runs. @return exit code: 0 done, 1 below the pass mark, 2 bad usage or input, 3 environment, 4 device
/// fault.
int run_command_line(int argc, char** argv);

}  // namespace trocar
