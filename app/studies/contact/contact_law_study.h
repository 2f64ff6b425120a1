// `trocar study contact-law`: each fault of the thesis' contact law measured on it and on Trocar's.
//
// Both laws see the same patches and the same motions at 1 kHz, 150 N/m; no device and no hand. Thread: any.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult contact_law_study();

}  // namespace trocar
