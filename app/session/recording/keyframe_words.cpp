#include "app/session/recording/keyframe_words.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::uint64_t kLongestText = 4096;

/// Appends words. The same walk over the fields reads them back through WordsIn.
class WordsOut {
 public:
  template <typename T>
  void whole(const T& value) {
    if constexpr (std::is_enum_v<T>)
      whole(static_cast<std::underlying_type_t<T>>(value));
    else
      words.push_back(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
  }
  void exact(const double& value) { words.push_back(std::bit_cast<std::uint64_t>(value)); }
  void rounded(const double& value) { words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(value))); }
  void turn(const Mat3& R) {
    const Eigen::Quaterniond q(R);
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) rounded(part);
  }
  void count(const std::int32_t& value, std::size_t) { whole(value); }
  void set(const std::bitset<32>& bits) { words.push_back(bits.to_ulong()); }
  void text(const std::string& value) {
    const std::size_t size = std::min<std::size_t>(value.size(), kLongestText);
    words.push_back(size);
    for (std::size_t i = 0; i < size; ++i) {
      if (i % 8 == 0) words.push_back(0);
      words.back() |= std::uint64_t{static_cast<unsigned char>(value[i])} << (8 * (i % 8));
    }
  }

  std::vector<std::uint64_t> words;
};

class WordsIn {
 public:
  explicit WordsIn(std::span<const std::uint64_t> words) : rest_(words) {}

  template <typename T>
  void whole(T& value) {
    if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> number{};
      whole(number);
      value = static_cast<T>(number);
    } else {
      const auto number = static_cast<std::int64_t>(take());
      value = static_cast<T>(number);
      if (static_cast<std::int64_t>(value) != number) throw InputError("a number is out of its field's range");
    }
  }
  void exact(double& value) { value = std::bit_cast<double>(take()); }
  void rounded(double& value) {
    const std::uint64_t word = take();
    if (word > std::numeric_limits<std::uint32_t>::max()) throw InputError("a number is out of its field's range");
    value = std::bit_cast<float>(static_cast<std::uint32_t>(word));
  }
  void turn(Mat3& R) {
    Eigen::Quaterniond q;
    for (double* part : {&q.w(), &q.x(), &q.y(), &q.z()}) rounded(*part);
    if (!(q.norm() > 0.5)) throw InputError("a pose has no direction");
    R = q.normalized().toRotationMatrix();
  }
  void count(std::int32_t& value, std::size_t most) {
    whole(value);
    if (value < 0 || static_cast<std::size_t>(value) > most) throw InputError("a count is out of its range");
  }
  void set(std::bitset<32>& bits) { bits = std::bitset<32>(take()); }
  void text(std::string& value) {
    const std::uint64_t size = take();
    if (size > kLongestText) throw InputError("a text is too long");
    value.clear();
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < size; ++i, word >>= 8) {
      if (i % 8 == 0) word = take();
      value += static_cast<char>(word & 0xFF);
    }
  }
  bool done() const { return rest_.empty(); }

 private:
  std::uint64_t take() {
    if (rest_.empty()) throw InputError("a keyframe ends too early");
    const std::uint64_t word = rest_.front();
    rest_ = rest_.subspan(1);
    return word;
  }

  std::span<const std::uint64_t> rest_;
};

template <typename Words, typename V>
void rounded(Words& words, V& vector) {
  for (Eigen::Index i = 0; i < 3; ++i) words.rounded(vector[i]);
}

template <typename Words, typename Seen>
void pose(Words& words, Seen& X) {
  words.turn(X.R);
  rounded(words, X.p);
}

template <typename Words, typename Detail>
void walk_instrument(Words& words, Detail& d) {
  words.turn(d.R_TI);
  for (auto* flag : {&d.contact, &d.tip_contact, &d.clutched, &d.port_held, &d.armed}) words.whole(*flag);
  words.whole(d.fault.code);
  words.whole(d.fault.channel);
  words.whole(d.fault.tick);
  words.exact(d.fault.value);
  rounded(words, d.contact_point_T);
  rounded(words, d.contact_normal_T);
  for (auto* number : {&d.depth_m, &d.depth_in_port_m, &d.winding_c, &d.rendered_grip_n}) words.rounded(*number);
}

template <typename Words, typename Demand>
void walk_demand(Words& words, Demand& d) {
  for (auto* place : {&d.centre_T, &d.normal_T, &d.goal_T})
    for (Eigen::Index i = 0; i < 3; ++i) words.exact((*place)[i]);
  for (Eigen::Index i = 0; i < 9; ++i) words.exact(d.R_TI.data()[i]);
  words.whole(d.oriented);
  for (auto* number : {&d.radius_m, &d.angle_tolerance_rad, &d.band.low_n, &d.band.high_n}) words.exact(*number);
  pose(words, d.object.X_TO);
  rounded(words, d.object.size_m);
  words.whole(d.object.slipping);
  words.count(d.foam_count, d.foam.size());
  for (std::int32_t i = 0; i < d.foam_count; ++i) {
    auto& foam = d.foam[static_cast<std::size_t>(i)];
    for (auto* number : {&foam.stiffness_n_per_m, &foam.low_n, &foam.high_n}) words.exact(*number);
  }
}

template <typename Words, typename Status>
void walk_status(Words& words, Status& s) {
  words.whole(s.phase);
  words.whole(s.cue);
  words.set(s.done);
  for (auto* flag : {&s.force_shown, &s.warning}) words.whole(*flag);
  for (auto* number : {&s.target_index, &s.targets_done, &s.wrong_places, &s.excess_forces, &s.timeouts})
    words.whole(*number);
  for (auto* number : {&s.run_time_s, &s.hold_progress, &s.position_error_m, &s.angle_error_rad, &s.peak_force_n,
                       &s.grip.thickness_m, &s.grip.stiffness_n_per_m})
    words.exact(*number);
  walk_demand(words, s.demand);
}

template <typename Words, typename Frame>
void walk_frame(Words& words, Frame& f) {
  words.whole(f.stamp);
  words.exact(f.t_s);
  words.whole(f.grip);
  words.whole(f.grip_object);
  for (auto* number : {&f.slipped_m, &f.smoke_per_m, &f.lens_fog, &f.lens_blood}) words.rounded(*number);
  words.count(f.object_count, f.object.size());
  words.count(f.pair_count, f.pair.size());
  words.count(f.mark_count, f.mark.size());
  for (std::int32_t i = 0; i < f.object_count; ++i) {
    auto& object = f.object[static_cast<std::size_t>(i)];
    pose(words, object.X_TO);
    rounded(words, object.size_m);
    rounded(words, object.velocity_T);
    words.whole(object.kind);
    words.whole(object.colour);
    words.whole(object.motion);
    words.whole(object.crushed);
  }
  for (std::int32_t i = 0; i < f.mark_count; ++i) {
    auto& mark = f.mark[static_cast<std::size_t>(i)];
    words.whole(mark.kind);
    rounded(words, mark.centre_T);
    words.rounded(mark.radius_m);
    words.rounded(mark.strength);
  }
  for (std::int32_t i = 0; i < f.pair_count; ++i) {
    auto& pair = f.pair[static_cast<std::size_t>(i)];
    words.whole(pair.a);
    words.whole(pair.b);
    rounded(words, pair.point_T);
    rounded(words, pair.normal_T);
    words.rounded(pair.depth_m);
    words.rounded(pair.force_n);
  }
}

template <typename Words, typename Surgery>
void walk_surgery(Words& words, Surgery& s) {
  for (auto* number : {&s.cuts, &s.tears, &s.clips, &s.refusals, &s.refusal, &s.wounds, &s.bile_leaks})
    words.whole(*number);
  for (auto* number : {&s.blood_ml, &s.blood_ml_per_min, &s.sucked_ml, &s.bile_ml, &s.cut_m2, &s.cut_m, &s.heat_j,
                       &s.contact_c, &s.refused_s})
    words.rounded(*number);
}

template <typename Words, typename Frame>
void walk_clips_and_drops(Words& words, Frame& f) {
  words.count(f.clip_count, f.clip.size());
  words.count(f.drop_count, f.drop.size());
  for (std::int32_t i = 0; i < f.clip_count; ++i) pose(words, f.clip[static_cast<std::size_t>(i)]);
  for (std::int32_t i = 0; i < f.drop_count; ++i) {
    rounded(words, f.drop[static_cast<std::size_t>(i)].place_T);
    words.rounded(f.drop[static_cast<std::size_t>(i)].radius_m);
  }
}

template <typename Words, typename Surgery>
void walk_bed(Words& words, Surgery& s) {
  words.rounded(s.bed_free);
  words.rounded(s.bed_hurt);
}

template <typename Words, typename Suture>
void walk_suture(Words& words, Suture& s) {
  for (auto* number : {&s.needles, &s.punctures, &s.stitches, &s.throws, &s.tears, &s.knot}) words.whole(*number);
  words.whole(s.held);
  words.rounded(s.pull_n);
}

/// What single kinds of exercise show.
template <typename Words, typename Status>
void walk_shown(Words& words, Status& s) {
  for (auto* number : {&s.exposure, &s.horizon_rad}) words.rounded(*number);
  words.whole(s.shown_symbol);
  words.count(s.mark_count, s.marks_T.size());
  for (int i = 0; i < s.mark_count; ++i) rounded(words, s.marks_T[static_cast<std::size_t>(i)]);
}

bool shows_more(const DirectorStatus& s) {
  return s.exposure != 0 || s.horizon_rad != 0 || s.shown_symbol >= 0 || s.mark_count > 0;
}

/// What has been done to an organ follows, where something has, behind it clips and drops, where there are some, then
/// the bed, where it is hurt, then what is stitched, and last what single kinds show; each also where something behind
/// it follows.
template <typename Words, typename Keyframe>
void walk(Words& words, Keyframe& k) {
  walk_instrument(words, k.instrument);
  walk_status(words, k.status);
  walk_frame(words, k.tissue);
  words.text(k.status.message);
  words.text(k.status.hint);
}

}  // namespace

std::vector<std::uint64_t> words_of(const TissueKeyframe& keyframe) {
  WordsOut words;
  walk(words, keyframe);
  const bool shown = shows_more(keyframe.status);
  const bool suture = shown || keyframe.tissue.suture != SutureState{};
  const bool bed = suture || keyframe.tissue.surgery.bed_hurt != 0;
  const bool more = bed || keyframe.tissue.clip_count > 0 || keyframe.tissue.drop_count > 0;
  if (more || keyframe.tissue.surgery != SurgeryState{}) walk_surgery(words, keyframe.tissue.surgery);
  if (more) walk_clips_and_drops(words, keyframe.tissue);
  if (bed) walk_bed(words, keyframe.tissue.surgery);
  if (suture) walk_suture(words, keyframe.tissue.suture);
  if (shown) walk_shown(words, keyframe.status);
  return std::move(words.words);
}

void read_words(std::span<const std::uint64_t> words, TissueKeyframe& keyframe) {
  WordsIn in(words);
  walk(in, keyframe);
  if (!in.done()) walk_surgery(in, keyframe.tissue.surgery);
  if (!in.done()) walk_clips_and_drops(in, keyframe.tissue);
  if (!in.done()) walk_bed(in, keyframe.tissue.surgery);
  if (!in.done()) walk_suture(in, keyframe.tissue.suture);
  if (!in.done()) walk_shown(in, keyframe.status);
  if (!in.done()) throw InputError("words of a keyframe are left over");
}

}  // namespace trocar
