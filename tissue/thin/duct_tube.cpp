#include "tissue/thin/duct_tube.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "haptics/input_error.h"
#include "tissue/thin/rod_in_jaws.h"

namespace trocar {
namespace {

constexpr double kSpacing = 0.002;       // m between nodes: a clip is 1.2 mm wide
constexpr double kSealLength = 0.004;    // m of vessel that hot jaws weld (a choice)
constexpr double kGravity = 9.81;        // m/s2
constexpr std::int32_t kDuctMark = -41;  // where a cut of an organ has a triangle

RodOptions options_of(const DuctSetup& setup, double step_s) {
  RodOptions options = rod_options(setup.material, setup.outer_radius_m, setup.wall_m);
  options.gravity_m_s2 = {0, 0, -kGravity};
  options.step_s = step_s;
  if (setup.slack) options.pre_strain = 0;
  return options;
}

template <typename Value>
void put_of_duct(std::string& out, const Value& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
Value take_of_duct(std::string_view& bytes) {
  if (bytes.size() < sizeof(Value)) throw InputError("a change of a duct ends too early");
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

/// Indices of the nodes by their ids.
std::vector<std::size_t> index_by_id(const ElasticRod& rod) {
  std::vector<std::size_t> index(rod.nodes().size());
  for (std::size_t i = 0; i < index.size(); ++i) index[static_cast<std::size_t>(rod.nodes()[i].id)] = i;
  return index;
}

}  // namespace

std::string duct_change_bytes(const DuctChange& change) {
  std::string out;
  put_of_duct(out, kDuctMark);
  put_of_duct(out, static_cast<std::uint8_t>(change.kind));
  put_of_duct(out, change.duct);
  put_of_duct(out, change.arc_m);
  put_of_duct(out, change.share);
  for (int i = 0; i < 3; ++i) put_of_duct(out, change.offset_rod[i]);
  for (int i = 0; i < 9; ++i) put_of_duct(out, change.rotation_rod(i % 3, i / 3));
  return out;
}

bool is_duct_change(std::string_view bytes) {
  std::int32_t mark = 0;
  if (bytes.size() < sizeof mark) return false;
  std::memcpy(&mark, bytes.data(), sizeof mark);
  return mark == kDuctMark;
}

DuctChange parse_duct_change(std::string_view bytes) {
  DuctChange change;
  if (take_of_duct<std::int32_t>(bytes) != kDuctMark) throw InputError("a change of the tissue is not a duct's");
  const auto kind = take_of_duct<std::uint8_t>(bytes);
  if (kind > static_cast<std::uint8_t>(DuctChange::Kind::kUnclipped)) throw InputError("a change of a duct is unknown");
  change.kind = static_cast<DuctChange::Kind>(kind);
  change.duct = take_of_duct<std::int32_t>(bytes);
  change.arc_m = take_of_duct<double>(bytes);
  change.share = take_of_duct<double>(bytes);
  for (int i = 0; i < 3; ++i) change.offset_rod[i] = take_of_duct<double>(bytes);
  for (int i = 0; i < 9; ++i) change.rotation_rod(i % 3, i / 3) = take_of_duct<double>(bytes);
  const bool sound = std::isfinite(change.arc_m) && std::isfinite(change.share) && change.offset_rod.allFinite() &&
                     change.rotation_rod.allFinite();
  if (!sound || !bytes.empty()) throw InputError("a change of a duct cannot be read");
  return change;
}

DuctTube::DuctTube(const DuctSetup& setup, double step_s)
    : rod(evenly_spaced(setup.path_T, kSpacing), options_of(setup, step_s)), seen(rod) {}

bool DuctTube::apply(const DuctChange& change) {
  switch (change.kind) {
    case DuctChange::Kind::kCut:
    case DuctChange::Kind::kTorn:
      return rod.sever(change.arc_m).has_value();
    case DuctChange::Kind::kNicked:
      lumen.nick(change.arc_m, change.share);
      return true;
    case DuctChange::Kind::kSealed:
      lumen.seal(change.arc_m - kSealLength / 2, change.arc_m + kSealLength / 2, change.share);
      return true;
    case DuctChange::Kind::kClipped: {
      const Mat3 R = rod.frame_at(change.arc_m);
      clips.place(rod, lumen, change.arc_m, change.share,
                  {R * change.rotation_rod, rod.place_at(change.arc_m) + R * change.offset_rod});
      return true;
    }
    case DuctChange::Kind::kAvulsed:
      return true;
    case DuctChange::Kind::kUnclipped: {
      const std::int32_t number = clips.number_at(change.arc_m);
      clips.remove(number, rod, lumen);
      return number > 0;
    }
  }
  return false;
}

DuctChange DuctTube::clip_change(std::int32_t duct, const ElasticRod& rod, double arc_m, double share,
                                 const Pose& X_TI) {
  const Mat3 to_rod = rod.frame_at(arc_m).transpose();
  return {DuctChange::Kind::kClipped, duct, arc_m, share, to_rod * (X_TI.p - rod.place_at(arc_m)), to_rod * X_TI.R};
}

void DuctTube::add_nodes(std::vector<NodePlace>& nodes_T) const {
  for (const std::size_t i : index_by_id(rod)) nodes_T.push_back(rod.nodes()[i].position.cast<float>());
}

std::vector<SurfacePtr> drawn_tubes(std::span<const DuctSetup> ducts) {
  std::vector<SurfacePtr> out;
  for (const DuctSetup& setup : ducts) out.push_back(DuctTube(setup, RodOptions{}.step_s).seen.surface());
  return out;
}

DuctPlayback::DuctPlayback(std::span<const DuctSetup> ducts, std::span<const std::string> changes) {
  for (const DuctSetup& setup : ducts) tubes_.emplace_back(setup, RodOptions{}.step_s);
  for (const std::string& bytes : changes) {
    if (!is_duct_change(bytes)) continue;
    const DuctChange change = parse_duct_change(bytes);
    if (change.duct < 0 || static_cast<std::size_t>(change.duct) >= tubes_.size())
      throw InputError("a change of a duct names one that is not there");
    DuctTube& tube = tubes_[static_cast<std::size_t>(change.duct)];
    tube.apply(change);
    tube.seen.follow(tube.rod, &tube.lumen);  // one cut after the other: its surface grows by each
  }
}

std::size_t DuctPlayback::nodes() const {
  std::size_t sum = 0;
  for (const DuctTube& tube : tubes_) sum += tube.rod.nodes().size();
  return sum;
}

std::vector<SurfacePtr> DuctPlayback::at(std::span<const NodePlace> nodes_T) const {
  assert(nodes_T.size() == nodes());
  std::vector<SurfacePtr> out;
  std::size_t first = 0;
  for (const DuctTube& kept : tubes_) {
    DuctTube tube = kept;  // from the same state each time: the rings' turn hangs on no earlier moment
    const std::vector<std::size_t> index = index_by_id(tube.rod);
    std::vector<Vec3> places(index.size());
    for (std::size_t id = 0; id < index.size(); ++id) places[index[id]] = nodes_T[first + id].cast<double>();
    first += index.size();
    tube.rod.place(places);
    tube.seen.follow(tube.rod, &tube.lumen);
    out.push_back(tube.seen.surface());
  }
  return out;
}

}  // namespace trocar
