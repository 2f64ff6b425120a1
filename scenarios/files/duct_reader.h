// The tables [[ducts]], [[sheets]], [bed], [lie] and [suture] of an exercise file: ducts and vessels beside the organ,
// sheets of tissue on it, the organ bound to it, how it lies, a needle with its thread.
//
// Thread: loading only.
#pragma once

#include <optional>
#include <vector>

#include "scenarios/exercise.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// @return empty where the file names none. @throws InputError with line and column
std::vector<DuctPlan> read_ducts(StrictTable& document);
/// @return empty where the file names none. @throws InputError with line and column
std::vector<SheetPlan> read_sheets(StrictTable& document);
/// @return none where the file names none. @throws InputError with line and column
std::optional<BedPlan> read_bed(StrictTable& document);
/// @return none where the file names none. @throws InputError with line and column
std::optional<LiePlan> read_lie(StrictTable& document);
/// @return none where the file names none. @throws InputError with line and column, also without a driver for it
std::optional<SuturePlan> read_suture(StrictTable& document, const std::vector<InstrumentKind>& instruments);

}  // namespace trocar
