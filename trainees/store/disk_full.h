// The disk has no room for what was to be written: nothing of it was, and all that is there can be read on.
#pragma once

#include "haptics/input_error.h"

namespace trocar {

class DiskFull : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

}  // namespace trocar
