// Frames of volume files, judged and brought to one form, whichever format they came from.
//
// Frame RAS, millimetres. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace trocar {

/// Axes whose cosine is larger than this are not at right angles: float32 storage leaves 1e-6, a gantry tilt 1e-1.
inline constexpr double kSkewTolerance = 1e-4;

/// @param field the header field that gave the frame
/// @param hint what to do about implausible lengths, "" for nothing
/// @throws InputError "FILE: FIELD: ...": not finite, origin more than 100 m away, voxel edges outside 0.01..100 mm,
/// axes (nearly) in one
///         plane; sheared axes are passed with a note
void check_frame(const Eigen::Affine3d& index_to_ras_mm, const std::string& field, const std::string& file,
                 const std::string& hint, std::vector<std::string>& notes);

/// Voxels along each axis, and their number over all.
/// @throws InputError for an axis below 2 voxels, or more than kMostLabelVoxels values
void check_size(const std::array<long long, 3>& size, long long components, const std::string& field,
                const std::string& file);

/// Steps rounded to 2^-20 mm, origin to 2^-10 mm: below what matters, above what float32 or text storage leaves.
Eigen::Affine3d settled_frame(const Eigen::Affine3d& frame);

/// +1 or -1 a row: what turns coordinates of a space into RAS. "RAS", "LAS", "LPS", their long NRRD names, any upper or
/// lower case.
/// @throws InputError naming `file` and `field` for any other
Eigen::Vector3d ras_signs(std::string_view space, const std::string& field, const std::string& file);

/// Millimetres in a unit: "mm", "cm", "dm", "m", "um".
/// @throws InputError naming `field` for any other
double millimetres_in(std::string_view unit, const std::string& field, const std::string& file);

std::string lower_case(std::string_view text);
/// A number as a person reads it: six digits.
std::string plain(double value);

}  // namespace trocar
