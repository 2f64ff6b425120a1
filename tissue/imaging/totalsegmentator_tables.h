// The classes of TotalSegmentator's three main models, in full: v1 "total" (104), v2 "total" (117), "total_mr" (50).
//
// Source: the class maps "total_v1", "total" and "total_mr" of the program wasserth/TotalSegmentator
// (map_to_binary.py). Thread: constant data.
#pragma once

#include <span>

#include "tissue/imaging/labels/label_table.h"

namespace trocar {

std::span<const LabelName> totalsegmentator_v1();
std::span<const LabelName> totalsegmentator_v2();
std::span<const LabelName> totalsegmentator_mr();

}  // namespace trocar
