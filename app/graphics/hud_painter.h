// Paints a laid-out head-up display onto a picture. Colours: Okabe and Ito's set, safe for colour vision deficiency.
// Thread: any.
#pragma once

#include "app/graphics/hud_layout.h"
#include "app/graphics/image.h"

namespace trocar {

void paint_hud(Image& image, const HudLayout& layout, FontSet& fonts);

}  // namespace trocar
