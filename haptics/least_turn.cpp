#include "haptics/least_turn.h"

namespace trocar {

Eigen::Quaterniond least_turn(const Vec3& from, const Vec3& to) { return Eigen::Quaterniond::FromTwoVectors(from, to); }

}  // namespace trocar
