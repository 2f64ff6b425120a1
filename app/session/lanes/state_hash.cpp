#include "app/session/lanes/state_hash.h"

#include <cstdio>

namespace trocar {

void StateHash::add(const TickRecord& r) {
  const StylusState& s = r.stylus;
  for (const auto count : r.in.counts) add(static_cast<std::uint64_t>(count));
  for (const auto code : r.out.codes) add(static_cast<std::uint64_t>(code));
  add(std::uint64_t{r.in.elapsed_periods} << 32 | r.in.digital_in);
  add(std::uint64_t{r.amplifiers_armed} | std::uint64_t(s.loop) << 8 | std::uint64_t(s.fault.code) << 16 |
      std::uint64_t{s.contact} << 24 | std::uint64_t{s.saturated} << 25 | std::uint64_t{s.passivity_active} << 26 |
      std::uint64_t{s.tip_contact} << 27 | std::uint64_t{s.clutched} << 28 | std::uint64_t{s.port_held} << 29 |
      std::uint64_t{s.pedal} << 30 | std::uint64_t{static_cast<std::uint8_t>(s.fault.channel)} << 32 |
      std::uint64_t{static_cast<std::uint8_t>(s.instrument)} << 40);
  add(std::uint64_t{r.warnings} << 8 | r.in.valid);
  add(s.fault.tick);
  add(s.fault.value);
  add(s.period);
  add(r.patch_stamp);
  add(r.q);
  add(r.qd);
  add(r.torque);
  add(s.X_TI.R);
  add(s.X_TI.p);
  add(s.F_I_T.force);
  add(s.F_I_T.moment);
  add(s.commanded_force_T);
  add(s.rendered_force_T);
  add(s.registration.shift_T);
  add(s.registration.turn);
  add(s.V_TI_T.linear);
  add(s.V_TI_T.angular);
  add(s.contact_point_T);
  add(s.contact_normal_T);
  for (const double value : {r.winding_c, r.det_a, r.contact_scale, r.stored_j, r.min_energy_j, s.t_s, s.jaw_opening_m,
                             s.grip_force_n, s.rendered_grip_n, s.depth_m, s.energy_j}) {
    add(value);
  }
}

void StateHash::add(const ContactPatch& patch) {
  add(patch.stamp);
  add(static_cast<std::uint64_t>(patch.count) << 32 | static_cast<std::uint32_t>(patch.dropped));
  for (int i = 0; i < patch.count; ++i) {
    const PatchTriangle& triangle = patch.triangle[i];
    add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(triangle.id)) << 32 |
        static_cast<std::uint32_t>(triangle.material));
    for (const Vec3& vertex : patch.corners(i)) add(vertex);
  }
  if (patch.glide_s > 0) {
    add(patch.glide_s);
    add(patch.given_j);
    add(patch.hold.point_I);
    add(patch.hold.anchor_T);
    add(patch.hold.stiffness_n_per_m);
    for (int i = 0; i < patch.vertex_count; ++i) add(patch.velocity[static_cast<std::size_t>(i)]);
  }
  add(patch.reach_m);
  for (const ContactMaterial& m : patch.material) {
    for (const double value : {m.stiffness_n_per_m, m.damping_s_per_m, m.mu_static, m.mu_dynamic, m.stribeck_m_s}) {
      add(value);
    }
  }
  add(patch.held.from_I);
  add(patch.held.to_I);
  add(patch.held.radius_m);
  add(patch.grip.thickness_m);
  add(patch.grip.stiffness_n_per_m);
  if (patch.ring.count == 0) return;  // runs without a wire keep their hash
  for (std::int32_t i = 0; i < patch.ring.count; ++i) add(patch.ring.point_T[static_cast<std::size_t>(i)]);
  add(patch.ring.centre_I);
  add(patch.ring.normal_I);
  for (const double value : {patch.ring.play_m, patch.ring.stiffness_n_per_m, patch.ring.damping_s_per_m}) add(value);
}

void StateHash::add(const TissueFrame& frame) {
  add(frame.stamp);
  add(frame.t_s);
  add(static_cast<std::uint64_t>(frame.object_count) | std::uint64_t(frame.grip) << 32);
  add(static_cast<std::uint64_t>(frame.grip_object + 1) << 32 | static_cast<std::uint64_t>(frame.pair_count));
  add(frame.slipped_m);
  for (int i = 0; i < frame.object_count; ++i) {
    const ObjectState& object = frame.object[static_cast<std::size_t>(i)];
    add(object.X_TO.R);
    add(object.X_TO.p);
    add(object.size_m);
    add(object.velocity_T);
    add(static_cast<std::uint64_t>(object.kind) | static_cast<std::uint64_t>(object.colour) << 16 |
        std::uint64_t(object.motion) << 32 | std::uint64_t{object.crushed} << 40);
  }
  for (int i = 0; i < frame.pair_count; ++i) {
    const ContactPair& pair = frame.pair[static_cast<std::size_t>(i)];
    add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(pair.a)) << 32 | static_cast<std::uint32_t>(pair.b));
    add(pair.point_T);
    add(pair.normal_T);
    add(pair.depth_m);
    add(pair.force_n);
  }
  add_marks(frame);
  add_surgery(frame.surgery);
  add_suture(frame.suture);
  add_bites(frame.needle);
  add_clips_and_drops(frame);
  add_duct_marks(frame);
  add_sheet_cuts(frame);
}

/// Nothing while no sheet in a frame is cut: such runs keep their hash. The newest: those before it were told.
void StateHash::add_sheet_cuts(const TissueFrame& frame) {
  if (frame.sheet_cut_count == 0) return;
  add(static_cast<std::uint64_t>(frame.sheet_cut_count));
  const SheetCutSeen& newest =
      frame.sheet_cut[static_cast<std::size_t>((frame.sheet_cut_count - 1) % kMaxSheetCutsSeen)];
  add(newest.from_rest_T);
  add(newest.to_rest_T);
}

/// Nothing while no duct is touched, clipped or cut: such runs keep their hash.
void StateHash::add_duct_marks(const TissueFrame& frame) {
  if (frame.touched_duct >= 0) add(static_cast<std::uint64_t>(frame.touched_duct));
  for (std::int32_t i = 0; i < frame.duct_mark_count; ++i) {
    const DuctMark& mark = frame.duct_mark[static_cast<std::size_t>(i)];
    add(static_cast<std::uint64_t>(mark.kind) | static_cast<std::uint64_t>(mark.duct) << 8);
    for (const double value : {mark.arc_m, mark.share, mark.angle_rad, mark.tip_beyond_m}) add(value);
  }
}

/// Nothing while nothing has been done to an organ: runs without it keep their hash.
void StateHash::add_surgery(const SurgeryState& surgery) {
  if (surgery == SurgeryState{}) return;
  for (const std::int32_t number : {surgery.cuts, surgery.tears, surgery.clips, surgery.refusals, surgery.refusal,
                                    surgery.wounds, surgery.bile_leaks})
    add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(number)));
  for (const double value : {surgery.blood_ml, surgery.blood_ml_per_min, surgery.sucked_ml, surgery.bile_ml,
                             surgery.cut_m2, surgery.cut_m, surgery.heat_j, surgery.contact_c, surgery.refused_s})
    add(value);
  if (surgery.bed_hurt == 0) return;  // runs without a bed, or on one that is whole, keep their hash
  add(surgery.bed_free);
  add(surgery.bed_hurt);
}

/// Nothing where no needle has been brought in: such runs keep their hash.
void StateHash::add_suture(const SutureState& suture) {
  if (suture == SutureState{}) return;
  for (const std::int32_t number :
       {suture.needles, suture.punctures, suture.stitches, suture.throws, suture.tears, suture.knot})
    add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(number)));
  add(std::uint64_t{suture.held});
  add(suture.pull_n);
}

/// Nothing while no needle is in tissue: where it lies is among the places of what is thin.
void StateHash::add_bites(const NeedleSight& needle) {
  for (std::int32_t i = 0; i < needle.bite_count; ++i) {
    const NeedleBite& bite = needle.bite[static_cast<std::size_t>(i)];
    add(static_cast<std::uint64_t>(bite.number) << 1 | std::uint64_t{bite.through});
    for (const Vec3& place : {bite.entry_rest_T, bite.end_rest_T, bite.entry_along_T}) add(place);
    add(bite.load_n);
  }
}

void StateHash::add_clips_and_drops(const TissueFrame& frame) {
  if (frame.clip_count == 0 && frame.drop_count == 0) return;
  add(static_cast<std::uint64_t>(frame.clip_count) << 32 | static_cast<std::uint32_t>(frame.drop_count));
  for (int i = 0; i < frame.clip_count; ++i) {
    add(frame.clip[static_cast<std::size_t>(i)].R);
    add(frame.clip[static_cast<std::size_t>(i)].p);
  }
  for (int i = 0; i < frame.drop_count; ++i) {
    add(frame.drop[static_cast<std::size_t>(i)].place_T);
    add(frame.drop[static_cast<std::size_t>(i)].radius_m);
  }
}

/// Nothing at all while the tissue is unmarked and the air and the lens are clear: runs without them keep their hash.
void StateHash::add_marks(const TissueFrame& frame) {
  if (frame.mark_count == 0 && frame.smoke_per_m == 0 && frame.lens_fog == 0 && frame.lens_blood == 0) return;
  add(static_cast<std::uint64_t>(frame.mark_count));
  for (int i = 0; i < frame.mark_count; ++i) {
    const TissueMark& mark = frame.mark[static_cast<std::size_t>(i)];
    add(std::uint64_t(mark.kind));
    add(mark.centre_T);
    add(mark.radius_m);
    add(mark.strength);
  }
  add(frame.smoke_per_m);
  add(frame.lens_fog);
  add(frame.lens_blood);
}

void StateHash::add(const DirectorStatus& status) {
  add(std::uint64_t(status.phase) | std::uint64_t(status.cue) << 8 |
      static_cast<std::uint64_t>(status.targets_done) << 16 | static_cast<std::uint64_t>(status.wrong_places) << 32);
  add(static_cast<std::uint64_t>(status.target_index + 1) << 32 | static_cast<std::uint64_t>(status.excess_forces));
  add(status.run_time_s);
  add(status.hold_progress);
  add(status.peak_force_n);
  add(status.grip.thickness_m);
  add(status.grip.stiffness_n_per_m);
}

std::string StateHash::hex() const {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state_));
  return digits;
}

}  // namespace trocar
