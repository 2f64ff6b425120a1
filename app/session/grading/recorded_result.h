// The result of an attempt from its recording alone: what is stored when the loop has ended, and again when a program
// died, or a disk was full, between the end of the recording and the end of the commit.
//
// The recording holds grade (by its own rubric), events, state hash, and the run report. Thread: any.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/session/recording/recording_reader.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// The loop's run report as the recording keeps it: JSON, numbers to the bit; and back.
std::string run_report_json(const RunReport& run_report);
/// @param name of the recording, for messages. @throws InputError.
RunReport parse_run_report(const std::string& json, const std::string& name);

/// What the recording says of the contacts' stiffness. @param name of the recording, for messages. @throws InputError.
StiffnessReport recorded_stiffness(const Recording& recording, const std::string& name);

/// Grade, events, run report, hashes. What the attempt began with (exercise, trainee, organ) is left empty.
/// @throws InputError when the setup or the run report cannot be read.
AttemptResult recorded_result(const Recording& recording, const std::filesystem::path& file);

/// recorded_result() of a file; nothing when the recording was cut off. @throws InputError when it is damaged.
std::optional<AttemptResult> regrade_file(const std::filesystem::path& file);

}  // namespace trocar
