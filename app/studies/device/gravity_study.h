// `trocar study gravity`: the thesis' experiment 4.2.2 and a released stylus in drawn poses, by four laws for the
// weight.
//
// Laws: none, the thesis' (4.3) to (4.10), the nominal weights turned by one rotation, the weights identified on that
// device. Thread: any; minutes of device time.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult gravity_study(const StudyRequest& request);

}  // namespace trocar
