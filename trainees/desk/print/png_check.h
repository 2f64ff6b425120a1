// Whether bytes are a whole PNG: signature, chunks that end where they say, checksums, beginning and end. The libraries
// behind a PDF end the program at a broken one. Pure. Thread: any.
#pragma once

#include <string>

namespace trocar::printed {

bool whole_png(const std::string& bytes);

}  // namespace trocar::printed
