// The porta hepatis as drawn: bile ducts and arteries of one patient. RAS, mm. Thread: any.
//
// Outer calibres (diameter): cystic duct 3-3.5 mm (2-4), common hepatic duct 4.8, common bile duct 5.5 (4-6), hepatic
// artery 4.6-5, right hepatic artery 3.6, cystic artery 2 (1.5-2.5). In the normal variant the right hepatic artery
// crosses behind the common hepatic duct and gives the cystic artery within the triangle of Calot, as in three patients
// of four.
#pragma once

#include <array>

#include "tissue/imaging/phantom/anatomy.h"

namespace trocar::phantom {

struct NamedTube {
  int label;
  Tube tube;
};

/// Common bile, common hepatic and cystic duct; hepatic, right hepatic, left hepatic and cystic artery: where two meet,
/// the wider comes first and owns the place.
std::vector<NamedTube> hilum(const Anatomy& anatomy);

/// Corners of the hepatocystic triangle: gallbladder neck, where the hepatic duct leaves the liver, where the ducts
/// meet.
std::array<Vec, 3> hepatocystic_triangle(const Anatomy& anatomy);

}  // namespace trocar::phantom
