#include "app/session/playback/recorded_moments.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "tissue/tissue_world.h"

namespace trocar {
namespace {

constexpr double kSameTime_s = 1e-9;  // the loop and a row may round one time differently

Mat3 between(const Mat3& a, const Mat3& b, double share) {
  return Eigen::Quaterniond(a).slerp(share, Eigen::Quaterniond(b)).toRotationMatrix();
}

Pose between(const Pose& a, const Pose& b, double share) {
  return {between(a.R, b.R, share), a.p + share * (b.p - a.p)};
}

InstrumentDetail between(const InstrumentDetail& a, const InstrumentDetail& b, double share) {
  InstrumentDetail out = a;
  out.R_TI = between(a.R_TI, b.R_TI, share);
  out.winding_c = std::lerp(a.winding_c, b.winding_c, share);
  out.depth_in_port_m = std::lerp(a.depth_in_port_m, b.depth_in_port_m, share);
  out.rendered_grip_n = std::lerp(a.rendered_grip_n, b.rendered_grip_n, share);
  out.depth_m = std::lerp(a.depth_m, b.depth_m, share);
  if (!a.contact || !b.contact) return out;
  out.contact_point_T += share * (b.contact_point_T - a.contact_point_T);
  out.contact_normal_T = (a.contact_normal_T + share * (b.contact_normal_T - a.contact_normal_T)).normalized();
  return out;
}

/// @param later_s after a.
DirectorStatus between(const DirectorStatus& a, const DirectorStatus& b, double share, double later_s) {
  DirectorStatus out = a;
  if (a.phase == Phase::kRun) out.run_time_s += later_s;
  if (!runs_on(a, b)) return out;
  for (const auto number :
       {&DirectorStatus::hold_progress, &DirectorStatus::position_error_m, &DirectorStatus::angle_error_rad,
        &DirectorStatus::peak_force_n, &DirectorStatus::exposure, &DirectorStatus::horizon_rad})
    out.*number = std::lerp(a.*number, b.*number, share);
  out.demand.centre_T += share * (b.demand.centre_T - a.demand.centre_T);
  out.demand.object.X_TO = between(a.demand.object.X_TO, b.demand.object.X_TO, share);
  return out;
}

TissueFrame between(const TissueFrame& a, const TissueFrame& b, double share, double later_s) {
  TissueFrame out = a;
  out.t_s += later_s;
  if (!runs_on(a, b)) return out;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.object_count); ++i) {
    ObjectState& object = out.object[i];
    object.X_TO = between(a.object[i].X_TO, b.object[i].X_TO, share);
    object.size_m += share * (b.object[i].size_m - a.object[i].size_m);
    object.velocity_T += share * (b.object[i].velocity_T - a.object[i].velocity_T);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.clip_count); ++i)
    out.clip[i] = between(a.clip[i], b.clip[i], share);
  for (const auto number :
       {&TissueFrame::slipped_m, &TissueFrame::smoke_per_m, &TissueFrame::lens_fog, &TissueFrame::lens_blood})
    out.*number = std::lerp(a.*number, b.*number, share);
  return out;
}

/// As far as it has to be turned, and no farther, for its shaft to be the row's.
Mat3 along(const Mat3& R_TI, const Vec3& shaft_T) {
  if (!shaft_T.allFinite() || shaft_T.norm() < 0.5) return R_TI;
  return least_turn(R_TI.col(2), shaft_T).toRotationMatrix() * R_TI;
}

TickRecord record_of(const RecordedTick& row, double rate_hz, const InstrumentDetail& detail) {
  const TraceSample sample = dequantise(row, rate_hz);
  TickRecord record;
  record.in = device_input(row);
  record.amplifiers_armed = detail.armed;
  record.winding_c = detail.winding_c;
  record.stiffness_n_per_m = sample.stiffness_n_per_m;
  if (sample.stiffness_n_per_m > 0) record.k_max_n_per_m = sample.k_max_n_per_m;
  StylusState& stylus = record.stylus;
  stylus.period = row.tick;
  stylus.t_s = sample.t_s;
  stylus.loop = static_cast<LoopState>(row.loop_state);
  stylus.fault = detail.fault;
  stylus.X_TI = {along(detail.R_TI, sample.shaft_T), sample.tip_T};
  stylus.F_I_T.force = sample.force_T;
  if (const double force_n = sample.force_T.norm(); force_n > 0) {
    stylus.commanded_force_T = sample.commanded_n / force_n * sample.force_T;
    stylus.rendered_force_T = sample.rendered_n / force_n * sample.force_T;
  }
  if (sample.commanded_n > 0) stylus.delivered_share = sample.rendered_n / sample.commanded_n;
  stylus.jaw_opening_m = sample.jaw_opening_m;
  stylus.grip_force_n = sample.grip_n;
  stylus.rendered_grip_n = detail.rendered_grip_n;
  stylus.contact = sample.contact;
  stylus.tip_contact = detail.tip_contact;
  stylus.contact_point_T = detail.contact_point_T;
  stylus.contact_normal_T = detail.contact_normal_T;
  stylus.depth_m = detail.depth_m;
  stylus.clutched = detail.clutched;
  stylus.port_held = detail.port_held;
  stylus.depth_in_port_m = detail.depth_in_port_m;
  stylus.saturated = sample.saturated;
  stylus.passivity_active = sample.passivity_active;
  stylus.pedal = sample.pedal;
  stylus.instrument = sample.instrument;
  return record;
}

std::vector<RecordedTick> rows_of_steps(const Recording& recording) {
  std::vector<RecordedTick> rows;
  auto row = recording.ticks.begin();
  for (const std::uint64_t period : recording.schedule.steps) {
    row = std::lower_bound(row, recording.ticks.end(), period,
                           [](const RecordedTick& r, std::uint64_t p) { return r.tick < p; });
    if (row == recording.ticks.end()) break;
    if (row->tick == period && (rows.empty() || rows.back().tick < period)) rows.push_back(*row);
  }
  return rows.empty() ? recording.ticks : rows;
}

double share_between(std::uint64_t before, std::uint64_t after, std::uint64_t period) {
  return after > before ? static_cast<double>(period - before) / static_cast<double>(after - before) : 0;
}

bool alike(const std::vector<ShapeField>& a, const std::vector<ShapeField>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ShapeField& x, const ShapeField& y) {
    return x.name == y.name && x.place == y.place && x.value.size() == y.value.size();
  });
}

}  // namespace

RecordedMoments::RecordedMoments(const Scene& scene, const Recording& recording)
    : scene_(scene), rate_hz_(recording.rate_hz), rows_(rows_of_steps(recording)), track_(recording.tissue) {
  if (rows_.empty() || track_.empty()) throw InputError("the recording holds no keyframes to play");
}

const RecordedTick& RecordedMoments::row_at(double t_s) const {
  const auto after = std::upper_bound(
      rows_.begin(), rows_.end(), t_s + kSameTime_s,
      [this](double t, const RecordedTick& row) { return t < static_cast<double>(row.tick) / rate_hz_; });
  return after == rows_.begin() ? rows_.front() : *std::prev(after);
}

RunMoment RecordedMoments::bare(double t_s) const {
  const RecordedTick& row = row_at(t_s);
  RunMoment moment;
  moment.record = record_of(row, rate_hz_, {});
  moment.t_s = moment.record.stylus.t_s;
  moment.seen = true;
  moment.status.phase = static_cast<Phase>(row.phase);
  return moment;
}

RunMoment RecordedMoments::at(double t_s) const {
  const RecordedTick& row = row_at(t_s);
  const std::lock_guard lock(mutex_);
  if (last_ && last_->record.stylus.period == row.tick) return *last_;
  const std::size_t before = track_.at_or_before(row.tick).value_or(0);
  const std::size_t after = track_.after(row.tick).value_or(before);
  const auto a = decoder_.at(before), b = decoder_.at(after);
  const std::uint64_t period = std::max(row.tick, a->period);
  const double share = share_between(a->period, b->period, period);
  const double later_s = static_cast<double>(period - a->period) / rate_hz_;
  RunMoment moment;
  moment.record = record_of(row, rate_hz_, between(a->instrument, b->instrument, share));
  moment.status = between(a->status, b->status, share, later_s);
  moment.tissue = between(a->tissue, b->tissue, share, later_s);
  moment.t_s = moment.record.stylus.t_s;
  moment.seen = true;
  make_surfaces(row.tick);
  moment.organ_T = last_surface_;
  moment.thin_T = last_thin_;
  last_ = moment;
  return moment;
}

std::optional<RecordedShape> RecordedMoments::shape_of(std::uint64_t period) const {
  const auto before = track_.at_or_before(period, true);
  if (!before) return std::nullopt;
  const auto a = decoder_.at(*before);
  RecordedShape shape{a->topology, a->nodes_T, a->fields};
  const auto after = track_.after(period, true);
  if (!after) return shape;
  const auto b = decoder_.at(*after);
  if (b->topology != a->topology || b->nodes_T.size() != a->nodes_T.size()) return shape;
  const auto share = static_cast<float>(share_between(a->period, b->period, period));
  for (std::size_t i = 0; i < shape.nodes_T.size(); ++i) shape.nodes_T[i] += share * (b->nodes_T[i] - a->nodes_T[i]);
  if (!alike(a->fields, b->fields)) return shape;
  for (std::size_t f = 0; f < shape.fields.size(); ++f)
    for (std::size_t i = 0; i < shape.fields[f].value.size(); ++i)
      shape.fields[f].value[i] = std::lerp(a->fields[f].value[i], b->fields[f].value[i], share);
  return shape;
}

std::optional<RecordedShape> RecordedMoments::shape_at(double t_s) const {
  const RecordedTick& row = row_at(t_s);
  const std::lock_guard lock(mutex_);
  return shape_of(row.tick);
}

const EmbeddedSurface* RecordedMoments::embedded_for(std::uint64_t topology) const {
  // Every change of organ, ducts or suture makes another topology; the organ's own counts its cuts alone.
  const std::uint64_t whole = scene_.embedded->topology();
  if (topology < whole || topology - whole > track_.changes().size()) return nullptr;
  std::vector<const std::string*> cuts;
  for (std::uint64_t i = 0; i < topology - whole; ++i)
    if (const std::string& bytes = track_.changes()[i].bytes;
        !is_duct_change(bytes) && !is_sheet_change(bytes) && !is_suture_event(bytes))
      cuts.push_back(&bytes);
  if (cuts.empty()) return scene_.embedded.get();
  if (!scene_.soft) return nullptr;
  const std::uint64_t wanted = whole + cuts.size();
  if (!cut_ || cut_->rest()->topology > wanted) cut_.emplace(scene_.soft->lattice, scene_.embedded->rest());
  const std::uint64_t before = cut_->rest()->topology;
  while (cut_->rest()->topology < wanted) {
    LatticeChange change;
    if (!cut_->cut(parse_cut(*cuts[cut_->rest()->topology - whole]), change)) return nullptr;
  }
  if (!cut_surface_ || before != wanted) cut_surface_.emplace(cut_->lattice(), cut_->rest());
  return &*cut_surface_;
}

const RecordedMoments::ThinParts& RecordedMoments::thin_for(std::uint64_t topology) const {
  const std::uint64_t made = topology - scene_.embedded->topology();
  if (thin_ && thin_->changes == made) return *thin_;
  std::vector<std::string> changes;
  for (std::uint64_t i = 0; i < made; ++i) changes.push_back(track_.changes()[i].bytes);
  thin_.emplace().changes = made;
  if (!scene_.ducts.empty()) thin_->ducts.emplace(scene_.ducts, changes);
  if (!scene_.sheets.empty()) thin_->sheets.emplace(scene_.sheets, changes);
  if (scene_.suture) thin_->suture.emplace(*scene_.suture, changes);
  return *thin_;
}

std::vector<SurfacePtr> RecordedMoments::ThinParts::at(std::span<const NodePlace> nodes_T) const {
  std::vector<SurfacePtr> parts;
  const auto add = [&](const auto& of) {
    if (!of) return;
    for (SurfacePtr& part : of->at(nodes_T.first(of->nodes()))) parts.push_back(std::move(part));
    nodes_T = nodes_T.subspan(of->nodes());
  };
  add(ducts);
  add(sheets);
  add(suture);
  return parts;
}

/// The same as before while nothing has moved, so that nobody draws it anew; none where the scene has another
/// topology.
void RecordedMoments::make_surfaces(std::uint64_t period) const {
  std::optional<RecordedShape> shape = scene_.embedded ? shape_of(period) : std::nullopt;
  const EmbeddedSurface* embedded = shape ? embedded_for(shape->topology) : nullptr;
  const ThinParts* thin = embedded ? &thin_for(shape->topology) : nullptr;
  if (embedded == nullptr || shape->nodes_T.size() != embedded->nodes() + thin->nodes()) {
    last_surface_ = nullptr;
    last_thin_.clear();
    return;
  }
  if (last_surface_ && shape->topology == last_shape_.topology && shape->nodes_T == last_shape_.nodes_T &&
      shape->fields == last_shape_.fields)
    return;
  const std::span<const NodePlace> nodes(shape->nodes_T);
  last_surface_ = embedded->at(nodes.first(embedded->nodes()), shape->fields);
  last_thin_ = thin->at(nodes.subspan(embedded->nodes()));
  last_shape_ = std::move(*shape);
}

std::size_t RecordedMoments::bytes() const { return rows_.size() * sizeof(RecordedTick) + track_.bytes(); }

}  // namespace trocar
