// The result of an attempt from its recording alone: what is stored when the loop has ended, and again when a program
// died, or a disk was full, between the end of the recording and the end of the commit.
//
// The recording holds grade (by its own rubric), events, state hash, and the device's receipt. Thread: any.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/session/recording/recording_reader.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// The loop's receipt as the recording keeps it: JSON, numbers to the bit; and back.
std::string receipt_json(const DeviceReceipt& receipt);
/// @param name of the recording, for messages. @throws InputError.
DeviceReceipt parse_receipt(const std::string& json, const std::string& name);

/// What the recording says of the contacts' stiffness. @param name of the recording, for messages. @throws InputError.
void fill_stiffness(const Recording& recording, const std::string& name, DeviceReceipt& device);

/// Grade, events, receipt, hashes. What the attempt began with (exercise, trainee, organ) is left empty.
/// @throws InputError when the setup or the receipt cannot be read.
AttemptResult recorded_result(const Recording& recording, const std::filesystem::path& file);

/// recorded_result() of a file; nothing when the recording was cut off. @throws InputError when it is damaged.
std::optional<AttemptResult> regrade_file(const std::filesystem::path& file);

}  // namespace trocar
