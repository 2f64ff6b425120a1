// What a person is told of attempts that ended with their program (kill -9, power).
//
// Pure but for the machine's time zone. Thread: the window's.
#pragma once

#include <string>

#include "app/window/words/translator.h"
#include "trainees/records/attempt_store.h"

namespace trocar {

/// "14:32", or with the day when that is another one than `now`. @param utc ISO 8601, as the database keeps it. @param
/// now seconds since 1970.
std::string local_time(const std::string& utc, long long now);

/// "The attempt of E01 at 14:32 was cut off; ..." @param name of the exercise, and of whoever it was where that is
/// somebody else. What was whole when it was found is said to be stored.
std::string cut_off_words(const Translator& words, const std::string& name, const AttemptSummary& attempt,
                          long long now);

}  // namespace trocar
