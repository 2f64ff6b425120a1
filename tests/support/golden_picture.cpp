#include "tests/support/golden_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace trocar::testing_support {
namespace {

double linear(std::uint8_t v) {
  const double c = v / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

bool asked(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

void write_golden(const BlockColours& blocks, const std::string& name) {
  std::ofstream out(golden_file(name));
  out << "# OKLab x 1000 of " << kGoldenColumns << " x " << kGoldenRows
      << " blocks; written by TROCAR_RENEW_GOLDENS=1\n";
  for (const Eigen::Vector3d& lab : blocks)
    out << std::lround(1000 * lab.x()) << ' ' << std::lround(1000 * lab.y()) << ' ' << std::lround(1000 * lab.z())
        << '\n';
}

}  // namespace

/// B. Ottosson, "A perceptual color space for image processing", 2020.
Eigen::Vector3d oklab(const std::uint8_t* srgb) {
  const double r = linear(srgb[0]), g = linear(srgb[1]), b = linear(srgb[2]);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

BlockColours block_colours(const Image& image) {
  BlockColours blocks;
  for (int row = 0; row < kGoldenRows; ++row)
    for (int column = 0; column < kGoldenColumns; ++column) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const int x0 = column * image.width / kGoldenColumns, x1 = (column + 1) * image.width / kGoldenColumns;
      const int y0 = row * image.height / kGoldenRows, y1 = (row + 1) * image.height / kGoldenRows;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += oklab(image.pixel(x, y));
      blocks[static_cast<std::size_t>(row * kGoldenColumns + column)] = sum / ((x1 - x0) * (y1 - y0));
    }
  return blocks;
}

BlockDifference block_difference(const BlockColours& a, const BlockColours& b) {
  BlockDifference out;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = (a[i] - b[i]).norm();
    out.mean += d / static_cast<double>(a.size());
    out.worst = std::max(out.worst, d);
  }
  return out;
}

std::filesystem::path golden_file(const std::string& name) {
  return std::filesystem::path(TROCAR_SOURCE_DIR) / "tests" / "app" / "data" / "golden" / (name + ".txt");
}

BlockColours read_golden(const std::string& name) {
  std::ifstream in(golden_file(name));
  std::string head;
  if (!std::getline(in, head)) throw std::runtime_error(golden_file(name).string() + ": cannot be read");
  BlockColours blocks;
  for (Eigen::Vector3d& lab : blocks) {
    if (!(in >> lab.x() >> lab.y() >> lab.z())) throw std::runtime_error(golden_file(name).string() + ": is cut off");
    lab /= 1000;
  }
  return blocks;
}

void expect_golden(const Image& image, const std::string& name) {
  if (const char* folder = std::getenv("TROCAR_PICTURES"); folder && *folder)
    write_png(std::filesystem::path(folder) / (name + ".png"), image);
  const BlockColours now = block_colours(image);
  if (asked("TROCAR_RENEW_GOLDENS")) return write_golden(now, name);
  const BlockDifference d = block_difference(now, read_golden(name));
  std::printf("%s: mean %.4f (at most %.3f), worst block %.4f (at most %.3f)\n", name.c_str(), d.mean, kGoldenMean,
              d.worst, kGoldenWorst);
  EXPECT_TRUE(alike(d)) << name << " does not look as it did: mean " << d.mean << " of " << kGoldenMean
                        << ", worst block " << d.worst << " of " << kGoldenWorst
                        << ". When that is wanted: TROCAR_RENEW_GOLDENS=1, and look at it with TROCAR_PICTURES=folder";
}

}  // namespace trocar::testing_support
