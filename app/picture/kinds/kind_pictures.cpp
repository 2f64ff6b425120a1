#include <algorithm>

#include "app/picture/kinds/kind_picture.h"

namespace trocar {

// One each of this folder's sources.
KindPicture reach_picture();
KindPicture touch_picture();
KindPicture grasp_picture();
KindPicture camera_picture();
KindPicture wire_picture();
KindPicture gauze_picture();
KindPicture find_picture();
KindPicture retract_picture();
KindPicture palpate_picture();
KindPicture pegs_picture();
KindPicture clip_picture();
KindPicture needle_picture();
KindPicture dissect_picture();
KindPicture operation_picture();

const KindPicture& picture_of(const Exercise& exercise) {
  static const std::vector<KindPicture> pictures{
      reach_picture(), touch_picture(),  grasp_picture(),   camera_picture(),   pegs_picture(),
      wire_picture(),  find_picture(),   retract_picture(), palpate_picture(),  clip_picture(),
      gauze_picture(), needle_picture(), dissect_picture(), operation_picture()};
  return *std::find_if(pictures.begin(), pictures.end(),
                       [&](const KindPicture& picture) { return picture.kind == exercise.kind; });
}

}  // namespace trocar
