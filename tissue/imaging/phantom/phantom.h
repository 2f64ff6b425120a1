// A synthetic abdominal CT with its label map, drawn from analytic shapes: free to ship, of no patient.
//
// Shapes are implicit functions in the patient frame (RAS, mm, origin in front of the spine at the level of the porta
// hepatis); sizes follow common textbook proportions of an adult. Portal venous phase. Labels are numbered as in the
// table "trocar-phantom", which agrees with "totalsegmentator-v1" wherever that table names the organ. The same options
// give the same bytes. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/progress.h"

namespace trocar {

/// The anatomies of exercise E14: what the cystic duct and the cystic artery do, and how much fat hides them.
enum class PhantomVariant { kNormal, kShortDuct, kLowInsertion, kFat, kArteryAnterior };

inline constexpr std::array<PhantomVariant, 5> kPhantomVariants{PhantomVariant::kNormal, PhantomVariant::kShortDuct,
                                                                PhantomVariant::kLowInsertion, PhantomVariant::kFat,
                                                                PhantomVariant::kArteryAnterior};

/// "normal", "short-duct", "low-insertion", "fat", "artery-anterior"
std::string_view phantom_variant_name(PhantomVariant variant);
/// @throws InputError listing the known names
PhantomVariant phantom_variant(std::string_view name);
/// The variant that a scenario's seed stands for: the five in turn, seed 0 the normal one.
PhantomVariant phantom_variant_of_seed(std::uint64_t seed);

inline constexpr double kLeastPhantomVoxelMm = 0.75, kMostPhantomVoxelMm = 12;

struct PhantomOptions {
  double voxel_mm = 2.5;   ///< kLeastPhantomVoxelMm..kMostPhantomVoxelMm
  double noise_hu = 10;    ///< standard deviation in the image
  std::uint64_t seed = 1;  ///< of the noise; labels do not depend on it
  PhantomVariant variant = PhantomVariant::kNormal;
  std::uint64_t patient = 0;  ///< draws natural variation within the variant; 0 is the standard patient
};

struct CtPhantom {
  LabelVolume labels;
  std::vector<std::int16_t> hounsfield;  ///< on the grid of the labels
};

/// @throws InputError for a voxel size or a noise out of range
CtPhantom make_phantom(const PhantomOptions& options, const Progress& progress = {});

/// A duct or vessel as it was drawn, for scenarios that need its course and calibre.
struct PhantomTube {
  std::string name;  ///< of its label
  int label = 0;
  std::vector<Eigen::Vector3d> points_mm;  ///< centreline, steps of about 1 mm, the way that bile or blood flows
  std::vector<double> radii_mm;            ///< outer, one a point

  double length_mm() const;
};

/// Common bile, common hepatic and cystic duct; hepatic, right hepatic, left hepatic and cystic artery.
std::vector<PhantomTube> phantom_hilum(PhantomVariant variant, std::uint64_t patient = 0);

/// Signed distance (approximate, mm, negative inside) of the standard patient's organs, for tests and pictures.
double phantom_liver_mm(const Eigen::Vector3d& point_mm);
double phantom_gallbladder_mm(const Eigen::Vector3d& point_mm);

}  // namespace trocar
