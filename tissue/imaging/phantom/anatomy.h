// One synthetic patient: the numbers in which variants and patients differ, and the solid organs drawn with them.
//
// Signed distances in mm, RAS. The standard patient's liver and gallbladder are fixed: exercises stand on them.
// Thread: any.
#pragma once

#include "tissue/imaging/phantom/phantom.h"
#include "tissue/imaging/phantom/shapes.h"

namespace trocar::phantom {

struct Anatomy {
  PhantomVariant variant = PhantomVariant::kNormal;
  double liver_scale = 1;  ///< of the radii of its lobes; the visceral face stays
  double sac_scale = 1;    ///< of the gallbladder's radii; the neck stays
  double spleen_scale = 1;
  double duct_calibre = 1;    ///< of every bile duct
  double artery_calibre = 1;  ///< of every hepatic and cystic artery
  double junction_mm = 0;     ///< the cystic duct joins so much lower (negative) or higher
  double duct_bow_mm = 0;     ///< the cystic duct bows so much to the right
  double artery_bow_mm = 0;   ///< the cystic artery bows so much towards the head
  double outer_fat_mm = 0;    ///< more subcutaneous fat than the standard patient's 14 mm
  double omentum_mm = 8;      ///< thickness of the apron
  double hilum_fat_mm = 4;    ///< how far fat reaches from the hepatocystic triangle
};

/// @param patient 0 the standard patient of the variant; others draw their natural variation from it
Anatomy anatomy_of(PhantomVariant variant, std::uint64_t patient);

double gallbladder(const Vec& p, const Anatomy& anatomy);
double liver(const Vec& p, const Anatomy& anatomy);
/// The liver's convex mass, without what other organs press into it.
double liver_lobes(const Vec& p, const Anatomy& anatomy);
double spleen(const Vec& p, const Anatomy& anatomy);
/// @param side 1 right, -1 left
double kidney(const Vec& p, double side);
double spine(const Vec& p);
double vena_cava(const Vec& p);
/// The body's outline, `inset` mm within the standard patient's skin.
double trunk(const Vec& p, double inset);

}  // namespace trocar::phantom
