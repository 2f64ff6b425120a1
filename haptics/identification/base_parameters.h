// Base parameters: the combinations of mass parameters that joint torques can tell apart.
//
// Columns of the stacked regressor are taken in a fixed order of preference (the nine that carry weight first: see
// device_model.h, IdentifiedGravity) and kept when they are independent of those kept before (Gram-Schmidt with
// re-orthogonalisation, relative tolerance 1e-9); each other column is a combination of the kept ones, so
// base = grouping * pi and Y(kept) base = Y pi for every motion. SI. Thread: any.
#pragma once

#include <vector>

#include "haptics/identification/arm_regressor.h"

namespace trocar {

inline constexpr int kGravityParameters = 9;  ///< the first of every base set

struct BaseSet {
  std::vector<int> kept;     ///< indices of mass parameters
  Eigen::MatrixXd grouping;  ///< kept.size() x kMassParameters
  int size() const { return static_cast<int>(kept.size()); }
  /// Columns of Y that are kept.
  Eigen::Matrix<double, kArmJoints, Eigen::Dynamic> columns(const TorqueRegressor& Y) const;
};

/// From regressors at seeded random motions inside the joint limits: the same set for every device of this shape.
BaseSet base_parameters();

}  // namespace trocar
