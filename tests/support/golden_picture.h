// Golden pictures: 16 x 9 mean colours of a picture in OKLab, kept as text, compared with a tolerance.
//
// A block's mean does not feel on which pixel an edge falls, which differs between rasterisers; it does feel another
// light, another look, and a thing that is missing. Renew them after a wanted change: TROCAR_RENEW_GOLDENS=1 with the
// test's program, look at the pictures (TROCAR_PICTURES=folder writes them), commit both.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include <Eigen/Core>

#include "app/picture/gl/image.h"

namespace trocar::testing_support {

constexpr int kGoldenColumns = 16, kGoldenRows = 9;

/// OKLab (L 0..1) of each block, row by row from the top.
using BlockColours = std::array<Eigen::Vector3d, kGoldenColumns * kGoldenRows>;

Eigen::Vector3d oklab(const std::uint8_t* srgb);
BlockColours block_colours(const Image& image);

/// Of two pictures' blocks: mean and greatest distance in OKLab.
struct BlockDifference {
  double mean = 0, worst = 0;
};
BlockDifference block_difference(const BlockColours& a, const BlockColours& b);
/// Two rasterisers of Mesa (llvmpipe, softpipe) differ by 0.0008 and 0.0028 at most; a lamp of 85 % and a missing
/// instrument by more (tested).
constexpr double kGoldenMean = 0.004, kGoldenWorst = 0.015;
inline bool alike(const BlockDifference& d) { return d.mean <= kGoldenMean && d.worst <= kGoldenWorst; }

std::filesystem::path golden_file(const std::string& name);
/// @throws std::runtime_error: missing or damaged.
BlockColours read_golden(const std::string& name);
/// Compares with the kept one, or writes it when TROCAR_RENEW_GOLDENS is set. A gtest expectation.
void expect_golden(const Image& image, const std::string& name);

}  // namespace trocar::testing_support
