// What the soft solid's solver holds of a node: three components and a zero, one register.
#pragma once

namespace trocar {

struct alignas(16) NodeRow {
  float at[4] = {};
};

}  // namespace trocar
