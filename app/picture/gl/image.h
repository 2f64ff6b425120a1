// An 8-bit RGB picture in memory and its PNG file.
//
// Row 0 is the top row; pixels are tightly packed, sRGB-encoded. Thread: plain value, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace trocar {

struct Image {
  int width = 0, height = 0;      ///< pixels
  std::vector<std::uint8_t> rgb;  ///< width * height * 3 bytes, top row first

  Image() = default;
  /// Black picture. @param w,h pixels, both positive.
  Image(int w, int h) : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3, 0) {}

  std::uint8_t* pixel(int x, int y) {
    return &rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3];
  }
  const std::uint8_t* pixel(int x, int y) const { return const_cast<Image*>(this)->pixel(x, y); }
};

/// Writes a PNG (8-bit RGB, no time stamp: the same picture gives the same bytes).
/// @throws EnvironmentError naming the file when it cannot be written.
void write_png(const std::filesystem::path& path, const Image& image);

/// The same PNG in memory, for embedding.
/// @throws EnvironmentError when libpng fails.
std::vector<std::uint8_t> encode_png(const Image& image);

/// A JPEG in memory, for pictures that come several times a second. @param quality 1..100.
/// @throws EnvironmentError when it fails.
std::string encode_jpeg(const Image& image, int quality);

}  // namespace trocar
