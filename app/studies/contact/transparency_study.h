// `trocar study transparency`: force at the stylus that moving it through free air takes, by axis, speed and
// compensation.
//
// A rigid guide leads the stylus along X6, Y6 and Z6 of one pose, forth and back at constant speed, orientation held;
// the whole loop runs with nothing, with the identified weights, and with those and friction feed-forward. Thread: any.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult transparency_study(const StudyRequest& request);

}  // namespace trocar
