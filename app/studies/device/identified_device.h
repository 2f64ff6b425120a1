// A simulated device with true parameters of its own, and what the identifier finds out about it through the seam.
//
// Thread: any; takes some seconds of CPU.
#pragma once

#include <cstdint>

#include "haptics/device/plant/plant_parameters.h"
#include "haptics/identification/identify.h"

namespace trocar {

/// The device of a seed with a mass on its stylus, 30 mm down the roll axis (as a force sensor's fixture would be).
PlantParameters drawn_with_payload(std::uint64_t seed, double payload_kg);
/// Any device with such a mass.
PlantParameters with_payload(PlantParameters device, double payload_kg);

/// 20 poses, one trajectory.
IdentifyRequest quick_identification();
/// The whole one or the quick one, its draws by the seed.
IdentifyRequest seeded_identification(std::uint64_t seed, bool quick);

/// The truth stays behind the seam. @param model where the identifier starts; its transmissions count as true. @throws
/// InputError, EnvironmentError.
Identification identify_simulated(const PlantParameters& truth, const IdentifyRequest& request,
                                  const DeviceModel& model = {});

}  // namespace trocar
