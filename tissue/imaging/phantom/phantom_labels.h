// What the numbers of the phantom's label map mean: the table "trocar-phantom".
//
// Numbers below 200 are those of "totalsegmentator-v1" where that table names the organ; the others are our own.
// Thread: constant data.
#pragma once

#include <array>
#include <cstdint>

#include "tissue/imaging/labels/label_table.h"

namespace trocar {

inline constexpr std::string_view kPhantomTable = "trocar-phantom";
/// What the headers of its files say of themselves.
inline constexpr std::string_view kPhantomDescription = "synthetic CT phantom made by Trocar";

/// Every label by the name that the code uses.
namespace phantom_label {
inline constexpr std::uint16_t kSpleen = 1, kKidneyRight = 2, kKidneyLeft = 3, kGallbladder = 4, kLiver = 5,
                               kStomach = 6, kAorta = 7, kVenaCava = 8, kPortalVein = 9, kPancreas = 10,
                               kAdrenalRight = 11, kAdrenalLeft = 12, kOesophagus = 42, kSmallBowel = 55,
                               kDuodenum = 56, kColon = 57, kCysticDuct = 201, kHepaticDuct = 202, kBileDuct = 203,
                               kHepaticArtery = 204, kRightHepaticArtery = 205, kCysticArtery = 206,
                               kLeftHepaticArtery = 207, kSkin = 220, kSubcutaneousFat = 221, kMuscle = 222,
                               kVisceralFat = 223, kOmentum = 224, kHilumFat = 225, kDiaphragm = 226, kVertebrae = 230,
                               kRibs = 231, kLungs = 232, kHeart = 233;
}  // namespace phantom_label

inline constexpr std::array<LabelName, 34> kPhantomLabels{{{phantom_label::kSpleen, "spleen"},
                                                           {phantom_label::kKidneyRight, "kidney_right"},
                                                           {phantom_label::kKidneyLeft, "kidney_left"},
                                                           {phantom_label::kGallbladder, "gallbladder"},
                                                           {phantom_label::kLiver, "liver"},
                                                           {phantom_label::kStomach, "stomach"},
                                                           {phantom_label::kAorta, "aorta"},
                                                           {phantom_label::kVenaCava, "inferior_vena_cava"},
                                                           {phantom_label::kPortalVein, "portal_vein_and_splenic_vein"},
                                                           {phantom_label::kPancreas, "pancreas"},
                                                           {phantom_label::kAdrenalRight, "adrenal_gland_right"},
                                                           {phantom_label::kAdrenalLeft, "adrenal_gland_left"},
                                                           {phantom_label::kOesophagus, "esophagus"},
                                                           {phantom_label::kSmallBowel, "small_bowel"},
                                                           {phantom_label::kDuodenum, "duodenum"},
                                                           {phantom_label::kColon, "colon"},
                                                           {phantom_label::kCysticDuct, "cystic_duct"},
                                                           {phantom_label::kHepaticDuct, "common_hepatic_duct"},
                                                           {phantom_label::kBileDuct, "common_bile_duct"},
                                                           {phantom_label::kHepaticArtery, "hepatic_artery"},
                                                           {phantom_label::kRightHepaticArtery, "right_hepatic_artery"},
                                                           {phantom_label::kCysticArtery, "cystic_artery"},
                                                           {phantom_label::kLeftHepaticArtery, "left_hepatic_artery"},
                                                           {phantom_label::kSkin, "skin"},
                                                           {phantom_label::kSubcutaneousFat, "subcutaneous_fat"},
                                                           {phantom_label::kMuscle, "muscle"},
                                                           {phantom_label::kVisceralFat, "visceral_fat"},
                                                           {phantom_label::kOmentum, "omentum"},
                                                           {phantom_label::kHilumFat, "hilum_fat"},
                                                           {phantom_label::kDiaphragm, "diaphragm"},
                                                           {phantom_label::kVertebrae, "vertebrae"},
                                                           {phantom_label::kRibs, "ribs"},
                                                           {phantom_label::kLungs, "lungs"},
                                                           {phantom_label::kHeart, "heart"}}};

}  // namespace trocar
