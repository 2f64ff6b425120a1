// Paints a laid-out head-up display onto a picture. Colours: Okabe and Ito's set, safe for colour vision deficiency.
// Thread: any.
#pragma once

#include "app/picture/display/hud_layout.h"
#include "app/picture/gl/image.h"

namespace trocar {

void paint_hud(Image& image, const HudLayout& layout, FontSet& fonts);

}  // namespace trocar
