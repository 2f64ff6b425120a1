// `trocar study velocity`: every estimator of a channel's velocity on three motions at the tip, one count 0.208 mm, 1
// kHz.
//
// A reach that meets a wall at 0.45 m/s (minimum jerk over 45 mm), a creep of 10 mm/s and a tremor of 2 mm at 12 Hz,
// each seen through whole counts only. RMS error against the true speed, RMS step from tick to tick, lag by the shift
// that fits best. Published for comparison: haptics notes 1.9, after Janabi-Sharifi, Hayward and Chen 2000.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult velocity_study(const StudyRequest& request);

}  // namespace trocar
