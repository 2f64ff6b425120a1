// `trocar device eval` and `trocar device ik`: the device models on a table of poses.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace trocar {

/// Columns q1_rad..q6_rad in, and optionally all of qd1_rad_s..qd6_rad_s and fx6_N..mz6_Nm (stylus frame); writes the
/// same columns followed by pose, twist, joint torques, holding torques and conditioning.
/// @param device device file whose weights are held; nominal ones when empty.
/// @return exit code. @throws InputError, EnvironmentError.
int device_eval(const std::filesystem::path& input, const std::filesystem::path& output, std::ostream& err,
                const std::filesystem::path& device = {});

/// Columns T00..T23 (stylus in W', m) in; every candidate out as row,solution,in_limits,q1_rad..q6_rad.
/// @return 0, or 2 when a pose has no solution (each is named on `err` with the distance by which it misses).
int device_ik(const std::filesystem::path& input, const std::filesystem::path& output, std::ostream& err);

}  // namespace trocar
