// A sweep as jobs for more than one machine: a line each for GNU parallel, and a script for an array of Slurm's.
//
// Each job makes its part of the attempts into a file of its own, so that jobs that share a folder share no file.
// Thread: any.
#pragma once

#include <string>

#include "app/cli/sweep/sweep_command.h"

namespace trocar {

/// A word as a POSIX shell takes it.
std::string shell_word(const std::string& text);

/// One shell command a line. @param program its whole path.
std::string job_lines(const SweepOptions& options, const std::string& program);

/// For sbatch: task k of the array makes part k.
std::string slurm_script(const SweepOptions& options, const std::string& program);

}  // namespace trocar
