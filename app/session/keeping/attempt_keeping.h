// From a scene to a stored result: what an attempt begins with, recording it, its result, storing that.
//
// `trocar run` and the window keep their attempts this way, so that both can be replayed, graded again and recovered
// alike. Thread: that of the store's database.
#pragma once

#include <string>
#include <utility>

#include "app/session/session.h"
#include "trainees/records/attempt_store.h"

namespace trocar {

/// What is known before the loop starts. @param trainee code. @param session UUID of a sign-in at this station, ""
/// none.
AttemptStart attempt_start(const Scene& scene, const std::string& trainee, const std::string& session = "");

/// Records the attempt; when the machine fails it (a full disk), it is ended as aborted with the reason.
std::pair<SessionOutcome, Recording> record_or_abort(AttemptStore& store, const AttemptId& id, const Scene& scene,
                                                     const AssetRoots& assets, const SessionHooks& hooks);

/// What the attempt began with, what its recording says, and what the loop remembers of a stop (kept beside the
/// recording).
AttemptResult kept_result(const AttemptStart& start, const AttemptId& id, const SessionOutcome& outcome,
                          const Recording& recording);

/// A result that cannot be stored is not lost: its recording is whole, and a person can decide by it.
/// @throws EnvironmentError that says so.
void store_or_say(AttemptStore& store, const AttemptId& id, const AttemptResult& result);

}  // namespace trocar
