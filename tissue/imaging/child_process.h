// Work on files that may be hostile, done in a child process with limits, so that a crash or a hang of a library
// becomes a refusal.
//
// The child is forked, not started anew: call it from a process without other threads that hold locks (the import
// commands). What the work returns comes back through anonymous memory. Under AddressSanitizer the memory limit is left
// out (its shadow counts). Linux.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tissue/progress.h"

namespace trocar {

struct ChildLimits {
  std::uint64_t memory_bytes = std::uint64_t{2} << 30;  ///< address space of the child beyond what it has at its start
  int seconds = 300;                                    ///< wall clock
};

/// Runs `work` in a child and returns the bytes that it returned.
/// @param what begins every message: "scan.dcm" or "scan.dcm: decoding"
/// @param progress asked while waiting; when it throws, the child is killed and the exception goes on
/// @throws InputError with the message of an InputError that the work threw; or saying that it crashed, ran out of
/// memory or of time
std::string in_child(const std::string& what, const ChildLimits& limits, const Progress& progress,
                     const std::function<std::string()>& work);

}  // namespace trocar
