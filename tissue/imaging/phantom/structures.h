// Everything that one patient consists of, in the order in which it is asked: the first structure that holds a point
// owns it.
//
// HU of the portal venous phase, 120 kV: liver 112, spleen 122, kidney 185, portal vein 172, aorta 160, vena cava 140,
// pancreas 95, muscle 58, bile 8, fat -100, cancellous bone 190, cortical bone 420. RAS, mm. Thread: any (const).
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "tissue/imaging/phantom/anatomy.h"
#include "tissue/imaging/phantom/hilum.h"

namespace trocar::phantom {

struct Structure {
  std::uint16_t label;
  Box box;                                               ///< holds every point of it
  std::function<double(const Vec&)> distance;            ///< negative inside
  std::function<double(const Vec&, double)> hounsfield;  ///< at a point and its distance
  std::function<bool(const Box&)> misses = {};           ///< no point of the structure lies in the box; may be empty
  std::uint16_t core_label = 0;  ///< of what lies deeper than core_depth within; 0: all is `label`
  double core_depth = 0;
  bool measured = false;  ///< `distance` is right within a factor of two, also far away: whole blocks are decided by it
};

/// A label thinner than a voxel keeps a chain of voxels along this course.
struct ThinCourse {
  std::uint16_t label;
  Tube tube;
};

struct Patient {
  std::vector<Structure> structures;  ///< the last holds every point
  std::vector<ThinCourse> thin;       ///< first wins
  Box field;                          ///< what the scanner sees
};

/// @param sheet_mm least thickness that a sheet (skin, diaphragm) is drawn with
Patient draw_patient(const Anatomy& anatomy, double sheet_mm);

// The parts of draw_patient. ---------------------------------------------------------------------------------------

Box everywhere();
Structure measured(Structure structure);
std::function<double(const Vec&, double)> filled(double hounsfield);
/// @param hounsfield of its blood or tissue
Structure tube_structure(std::uint16_t label, Tube tube, std::function<double(const Vec&, double)> hounsfield);

void add_outside(std::vector<Structure>& to, const Anatomy& anatomy, double sheet_mm);
void add_wall(std::vector<Structure>& to, const Anatomy& anatomy, double sheet_mm);
void add_great_vessels(std::vector<Structure>& to);
void add_upper_gut(std::vector<Structure>& to, const Anatomy& anatomy);
void add_bowel(std::vector<Structure>& to);
/// What the contrast shows within the liver: HU above the liver's own.
std::function<double(const Vec&)> liver_vessels();
/// @param reach farther away the answer is `reach`
double stomach_mass(const Vec& p, double reach);
double heart_mass(const Vec& p);

}  // namespace trocar::phantom
