// The pictures of an import's page as PNG bytes: the organs from three sides, and slices with their outlines.
//
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/organs/organ_page.h"
#include "app/picture/gl/canvas.h"

namespace trocar {

struct PagePicture {
  std::string caption;
  std::vector<std::uint8_t> png;
};

struct PagePictures {
  std::vector<PagePicture> slices, views;
  std::string missing;  ///< why there are no views; "" when there are
};

PagePictures page_pictures(const OrganPageContent& content);

/// Colour of the n-th outline: hues that differ for people who see two colours, too (Okabe and Ito).
Colour outline_colour(std::size_t n);
std::string css_colour(const Colour& colour);

}  // namespace trocar
