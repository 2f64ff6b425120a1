#include "app/organs/organ_pictures.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>
#include <tuple>

#include "app/organs/slice_picture.h"
#include "app/picture/gl/headless_context.h"
#include "app/picture/models/organ_scene.h"
#include "app/picture/scene/renderer.h"
#include "haptics/input_error.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

constexpr int kSlicePx = 360, kViewWidth = 560, kViewHeight = 420;
constexpr double kRoom = 1.35;  // shown round the organs

const CompiledMember& pictured_subject(const OrganPageContent& content) {
  if (content.set)
    for (const CompiledMember& organ : content.organs)
      if (organ.manifest.name == content.set->subject) return organ;
  return content.organs.front();
}

/// Middle of all organs, but along the normal the middle of the subject, mm.
Vec3 centre_of(const Eigen::AlignedBox3d& box_m, const Vec3& through_mm, int normal) {
  Vec3 centre = 1e3 * box_m.center();
  centre[normal] = through_mm[normal];
  return centre;
}

/// The longer side of the box in the plane, with some room, mm.
double extent_of(const Eigen::AlignedBox3d& box_m, int normal) {
  Vec3 sizes = box_m.sizes();
  sizes[normal] = 0;
  return kRoom * 1e3 * sizes.maxCoeff();
}

std::vector<PagePicture> slices_of(const OrganPageContent& content) {
  Eigen::AlignedBox3d box;
  std::vector<SliceOutline> outlines;
  for (std::size_t n = 0; n < content.organs.size(); ++n) {
    box.extend(content.organs[n].surface.bounds());
    outlines.push_back({&content.organs[n].surface, outline_colour(n)});
  }
  const Vec3 through = 1e3 * volume_centroid_m(pictured_subject(content).surface);
  std::vector<PagePicture> pictures;
  const SliceGround ground{content.image, content.labels};
  for (const auto& [plane, name, normal] :
       {std::tuple(SlicePlane::kAxial, "Axial", 2), std::tuple(SlicePlane::kCoronal, "Coronal", 1),
        std::tuple(SlicePlane::kSagittal, "Sagittal", 0)})
    pictures.push_back({std::string(name) + " slice through the middle of " + pictured_subject(content).manifest.name,
                        encode_png(slice_picture(ground, outlines, plane, centre_of(box, through, normal),
                                                 extent_of(box, normal), kSlicePx))});
  return pictures;
}

/// The compiled organs as the loader would give them.
Organ loaded(const OrganPageContent& content) {
  const auto plain = [](const CompiledMember& member) {
    Organ organ;
    organ.name = member.manifest.name;
    organ.material = member.manifest.material;
    organ.surface = member.surface;
    return organ;
  };
  const CompiledMember& subject = pictured_subject(content);
  Organ organ = plain(subject);
  for (const CompiledMember& member : content.organs)
    if (&member != &subject) organ.adjacent.push_back(plain(member));
  return organ;
}

/// The scope's picture of all organs, the camera turned about the vertical; the instrument is kept out of sight.
SceneView turned(const SceneView& view, double angle_rad, double lift) {
  SceneView out = view;
  out.hud = {};
  const Vec3 back = view.camera.eye_T - view.camera.look_at_T;
  const Mat3 turn = Eigen::AngleAxisd(angle_rad, Vec3::UnitZ()).toRotationMatrix();
  out.camera.eye_T =
      view.camera.look_at_T + (turn * Vec3(back.x(), back.y(), lift * back.z())).normalized() * back.norm();
  out.X_TI.p = Vec3(0, 0, 10);
  return out;
}

std::vector<PagePicture> views_of(const OrganPageContent& content) {
  HeadlessContext context;
  Renderer renderer(context, content.assets);
  const SceneView view = organ_scene(loaded(content));
  std::vector<PagePicture> pictures;
  const auto add = [&](const char* caption, double angle, double lift) {
    pictures.push_back({caption, encode_png(renderer.render(turned(view, angle, lift), kViewWidth, kViewHeight))});
  };
  add("From the feet, as a scope at the navel looks", 0, 1.0);
  add("From the patient's right", -std::numbers::pi / 2, 1.0);
  add("From the front", 0, 6.0);
  return pictures;
}

}  // namespace

Colour outline_colour(std::size_t n) {
  static constexpr std::array<Colour, 8> kColours{{{86, 180, 233, 1},
                                                   {240, 228, 66, 1},
                                                   {0, 158, 115, 1},
                                                   {230, 159, 0, 1},
                                                   {204, 121, 167, 1},
                                                   {213, 94, 0, 1},
                                                   {0, 114, 178, 1},
                                                   {230, 230, 230, 1}}};
  return kColours[n % kColours.size()];
}

std::string css_colour(const Colour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.r, colour.g, colour.b);
  return text;
}

PagePictures page_pictures(const OrganPageContent& content) {
  PagePictures pictures;
  pictures.slices = slices_of(content);
  if (content.assets.empty()) {
    pictures.missing = "no 3-D pictures were asked for";
    return pictures;
  }
  try {
    pictures.views = views_of(content);
  } catch (const EnvironmentError& error) {
    pictures.missing = error.what();
  }
  return pictures;
}

}  // namespace trocar
