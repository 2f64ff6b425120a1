#include "app/studies/device/identified_device.h"

#include "haptics/device/backends/make_backend.h"

namespace trocar {
namespace {

constexpr double kPayloadPlace_m = 0.030;

}  // namespace

PlantParameters drawn_with_payload(std::uint64_t seed, double payload_kg) {
  return with_payload(draw_parameters(seed), payload_kg);
}

PlantParameters with_payload(PlantParameters p, double payload_kg) {
  const Vec3 place(0, 0, kPayloadPlace_m);
  const double whole = p.stylus_mass + payload_kg;
  const Vec3 com = (p.stylus_mass * p.stylus_com + payload_kg * place) / whole;
  // Principal axes stay those of the stylus: the offsets across the roll axis are below a millimetre.
  for (int axis = 0; axis < 3; ++axis) {
    const auto lever = [&](Vec3 r) { return r[axis] = 0, r.squaredNorm(); };
    p.stylus_inertia[axis] += p.stylus_mass * lever(p.stylus_com - com) + payload_kg * lever(place - com);
  }
  p.stylus_mass = whole;
  p.stylus_com = com;
  return p;
}

IdentifyRequest quick_identification() {
  IdentifyRequest request;
  request.poses = 20;
  request.trajectories = 1;
  request.candidates = 5;
  return request;
}

IdentifyRequest seeded_identification(std::uint64_t seed, bool quick) {
  IdentifyRequest request = quick ? quick_identification() : IdentifyRequest{};
  request.seed = seed;
  return request;
}

Identification identify_simulated(const PlantParameters& truth, const IdentifyRequest& request,
                                  const DeviceModel& model) {
  SimulatedDaqConfig config;
  config.plant = truth;
  return identify(*make_backend(kSimulatedBackend, {.simulated = config}).daq, model, request);
}

}  // namespace trocar
