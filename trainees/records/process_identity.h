// Which process runs an attempt, so precisely that a reused process number is not taken for it.
//
// Number, boot id (/proc/sys/kernel/random/boot_id) and start time in clock ticks since boot (field 22 of
// /proc/PID/stat). Programs that share a database must see each other's /proc. Thread: any.
#pragma once

#include <cstdint>
#include <string>

namespace trocar {

struct ProcessIdentity {
  std::int64_t pid = 0;
  std::string boot;
  std::int64_t start = 0;  ///< clock ticks since boot
};

/// @throws EnvironmentError without /proc.
ProcessIdentity this_process();

/// False when that very process has ended (a zombie counts as ended) or the machine was booted since.
bool process_lives(const ProcessIdentity& process);

}  // namespace trocar
