#include "app/session/setup/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "app/session/setup/force_scale.h"
#include "app/session/setup/motor_pairs.h"
#include "app/session/setup/patch_fit.h"
#include "app/session/setup/placement.h"
#include "app/session/setup/workspace_proof.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/device/pointer_daq.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/kinds/needle/needle_layout.h"
#include "scenarios/layout/board_numbers.h"
#include "scenarios/layout/height_field.h"
#include "scenarios/layout/shaft_room.h"
#include "scenarios/layout/sheet_frame.h"
#include "tissue/interaction/suturing.h"
#include "tissue/organ/organ_set.h"
#include "tissue/solid/embedded_surface.h"
#include "tissue/solid/tissue_table.h"
#include "tissue/theatre_frame.h"
#include "tissue/thin/duct_tube.h"
#include "tissue/thin/sheet_body.h"
#include "tissue/tissue_world.h"

namespace trocar {
const TriangleSurface& felt_surface(const Scene& scene) {
  return scene.adjacent.felt_T.triangles.empty() ? *scene.organ_T : scene.adjacent.felt_T;
}

namespace {

constexpr int kFormat = 1;
constexpr double kPatchAge_s = 0.2;  // twenty steps of the tissue at the least
constexpr double kFarthest = 10;     // m of an image's origin from the theatre's
constexpr const char* kUnreadable = ": the recording's setup cannot be read: ";

nlohmann::json file_json(const DeviceFile& file) { return {{"text", file.text}, {"file", file.name}}; }

std::optional<DeviceFile> file_of(const nlohmann::json& setup, const char* key) {
  if (!setup.contains(key)) return std::nullopt;
  return DeviceFile{setup.at(key).at("text").get<std::string>(), setup.at(key).at("file").get<std::string>()};
}

MotorStates motors_of(const nlohmann::json& setup, const std::string& name) {
  if (!setup.contains(kMotorsKey)) return {};
  const auto motors = motor_states(setup.at(kMotorsKey).get<MotorPairs>());
  if (!motors) throw InputError(name + kUnreadable + kMotorsKey + " is not one pair a motor");
  return *motors;
}

/// Every digit is kept: what is laid from it lies as before, to the last bit.
nlohmann::json placement_json(const OrganPlacement& placement) {
  const Mat3& R = placement.X_TO.R;
  nlohmann::json rows = nlohmann::json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({R(i, 0), R(i, 1), R(i, 2)});
  const Vec3& p = placement.X_TO.p;
  return {{"R", rows},
          {"p_m", {p.x(), p.y(), p.z()}},
          {"roll_rad", placement.roll_rad},
          {"turn_rad", placement.turn_rad},
          {"even_m2", placement.even_m2},
          {"free_m2", placement.free_m2}};
}

/// @throws InputError: a pose that is none.
OrganPlacement placement_of(const nlohmann::json& json, const std::string& name) {
  OrganPlacement out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      out.X_TO.R(static_cast<int>(i), static_cast<int>(j)) = json.at("R").at(i).at(j).get<double>();
    out.X_TO.p[static_cast<int>(i)] = json.at("p_m").at(i).get<double>();
  }
  const Mat3& R = out.X_TO.R;
  const bool rotation = (R * R.transpose() - Mat3::Identity()).norm() < 1e-9 && R.determinant() > 0;
  if (!rotation || !out.X_TO.p.allFinite() || out.X_TO.p.norm() > kFarthest)
    throw InputError(name + kUnreadable + "the organ's place is no pose in the theatre");
  out.roll_rad = json.at("roll_rad").get<double>();
  out.turn_rad = json.at("turn_rad").get<double>();
  out.even_m2 = json.at("even_m2").get<double>();
  out.free_m2 = json.at("free_m2").get<double>();
  return out;
}

const char* law_name(ContactLaw law) { return law == ContactLaw::kThesis ? "thesis" : "proxy"; }

}  // namespace

AssetRoots find_assets() {
  namespace fs = std::filesystem;
  std::vector<fs::path> roots;
  const char* named = std::getenv("TROCAR_ASSETS");
  if (named && !*named) named = nullptr;  // as program_of_record() has it
  if (named) roots.emplace_back(named);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!named && !error) roots.push_back(program.parent_path().parent_path() / "share" / "trocar");
  // A program in its build folder uses the source tree; an installed one never does.
  const fs::path within = program.lexically_relative(TROCAR_BUILD_DIR);
  if (!named && !within.empty() && *within.begin() != "..") roots.emplace_back(TROCAR_SOURCE_DIR);
  std::string looked;
  for (const fs::path& root : roots) {
    // Installed, exercises and hands lie together under the share folder; in the source tree under scenarios.
    for (const fs::path& scripts : {root, root / "scenarios"}) {
      if (fs::is_directory(scripts / "exercises") && fs::is_directory(root / "assets" / "shaders")) {
        return {scripts / "exercises", scripts / "hands", root / "assets"};
      }
    }
    looked += "\n  " + root.string();
  }
  throw EnvironmentError("the program's exercises and assets were not found; looked in" + looked);
}

std::string program_of_record() {
  const char* named = std::getenv("TROCAR_ASSETS");
  return named && *named ? TROCAR_VERSION ", assets of " + std::filesystem::absolute(named).string() : TROCAR_VERSION;
}

namespace {

/// Refuses a surface so fine that a patch would end before the tool can reach its end.
void require_reach(const Scene& scene) {
  const PatchFit fit = patch_fit(scene);
  if (fit.felt()) return;
  throw InputError(scene.organ.manifest.string() + ": the surface is too fine to be felt: " + fit.words());
}

constexpr double kNoticedForce = 0.1;  // share by which a force must differ to be noticed [M]
constexpr double kPointerAwake_s = 0.01;
constexpr double kEntryAside = 0.025, kEntryAbove = 0.015;  // m from the start ball, towards the resting instrument
constexpr int kBetweenDraws = 100000000;                    // numbers between a board's draws, beyond all boards
constexpr double kLatticeCell = 0.010;                      // m
constexpr double kSheetClear = 0.0002;                      // m between a sheet and the organ that it lies on
constexpr double kSteepestSheet = 1.1;                      // rad of the organ beneath it
constexpr double kDuctReach = 0.015;   // m from where a duct's end is drawn to the organ on which it hangs
constexpr double kDuctSought = 0.08;   // m from there, on other organs of its kind
constexpr double kFacesDuct = 0.4;     // cosine between what it hangs on and its way
constexpr double kBesideDuct = 0.008;  // m between its path and the organ

/// The loop's map is set before: pens turn from the resting instrument.
Board lay_out(const Scene& scene, int board, const ShaftRoom* behind_tip) {
  const Exercise& exercise = scene.setup.exercise;
  const Mat3 R_TI_rest = scene.loop.map.instrument_pose(home_pose()).R;
  return kind_of(exercise).lay_out(exercise, scene.level, board, {*scene.organ_T, behind_tip, R_TI_rest});
}

/// Draws until the device can do what the board asks for. On an organ of one's own a few boards of a level come out
/// with too few discs, or where gravity and the hard limit are more than a motor can give. The nominal device is asked,
/// so that a number means the same board at every station. Where kappa follows from
/// the boards, the first that can be laid out is taken: a port that no board can use must show in the proof.
void draw_board(Scene& scene, const ShaftRoom* behind_tip) {
  const std::optional<int>& known = scene.setup.draw;
  const int first = known.value_or(0), end = known ? first + 1 : kBoardDraws;
  InstrumentMap map = scene.loop.map;
  map.force_scale = scene.level.force_scale;
  const bool judged = map.force_scale > 0;  // "auto" follows from the boards as they are drawn first
  std::optional<Board> taken;
  std::exception_ptr refusal;
  for (int draw = first; draw < end; ++draw) {
    try {
      Board board = lay_out(scene, scene.setup.board + draw * kBetweenDraws, behind_tip);
      const bool sound = !judged || board_reach(scene.setup.exercise, board, device_model({}), map).sound({});
      if (!taken || sound) {
        taken = std::move(board);
        scene.draw = draw;
      }
      if (sound) break;
    } catch (const InputError&) {
      if (!refusal) refusal = std::current_exception();
    }
  }
  if (!taken) std::rethrow_exception(refusal);
  scene.board = std::move(*taken);
}

/// Without motors 1. The number of the level, or what the boards allow that `trocar check` proves. One that cannot be
/// laid out cannot be met, and asks nothing.
double force_scale(const Scene& scene, const ShaftRoom* room) {
  if (!scene.loop.daq.motors) return 1;
  if (scene.setup.force_scale) return *scene.setup.force_scale;
  if (scene.level.force_scale > 0) return scene.level.force_scale;
  std::vector<Board> boards;
  for (int k = 0; k < kPracticeBoards + kProvedUnseen; ++k) {
    try {
      boards.push_back(
          lay_out(scene, k < kPracticeBoards ? k : drawn_board(k - kPracticeBoards, scene.level.exam), room));
    } catch (const InputError&) {
    }
  }
  return auto_force_scale(scene.loop.map, scene.loop.device, scene.setup.exercise, boards);
}

/// Refuses a number of which the motors cannot give the board's forces, by more than a hand could tell.
void require_force(const Scene& scene) {
  if (scene.setup.weak_too || scene.level.force_scale <= 0 || !scene.loop.daq.motors) return;
  const Exercise& exercise = scene.setup.exercise;
  const double most = auto_force_scale(scene.loop.map, scene.loop.device, exercise, {scene.board});
  if (scene.level.force_scale <= most * (1 + kNoticedForce)) return;
  std::ostringstream words;
  words << exercise.file.string() << ": level " << scene.level.name << ": force_scale: " << scene.level.force_scale
        << " is more than the device can give on board " << scene.setup.board << ", " << most
        << "; say that, less or \"auto\" (trocar check shows where it falls short)";
  throw InputError(words.str());
}

/// Of an organ that has nothing where the path was drawn: the nearest place that faces its way, with nothing of the
/// organ beside or over the path. nullopt: there is none, or not one end hangs on it.
std::optional<std::vector<Vec3>> path_elsewhere(const DuctPlan& plan, const TriangleSurface& organ_T) {
  if (plan.ends[0] == plan.ends[1]) return std::nullopt;
  const bool first = plan.ends[0] == DuctHold::kOrgan;
  const Vec3 drawn = first ? plan.path_m.front() : plan.path_m.back(),
             way = ((first ? plan.path_m.back() : plan.path_m.front()) - drawn).normalized();
  double drawn_reach = 0;  // from the region's middle
  for (const Vec3& point : plan.path_m) drawn_reach = std::max(drawn_reach, kDuctReach + point.norm());
  const std::vector<Vec3> normals = organ_T.vertex_normals();
  std::vector<std::size_t> facing;
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (normals[v].dot(way) > kFacesDuct && (organ_T.vertices[v] - drawn).norm() < kDuctSought) facing.push_back(v);
  std::sort(facing.begin(), facing.end(), [&](std::size_t a, std::size_t b) {
    return (organ_T.vertices[a] - drawn).squaredNorm() < (organ_T.vertices[b] - drawn).squaredNorm();
  });
  for (const std::size_t v : facing) {
    std::vector<Vec3> path = plan.path_m;
    for (Vec3& point : path) point += organ_T.vertices[v] - drawn;
    const auto free = [&](const Vec3& at) {
      return std::none_of(organ_T.vertices.begin(), organ_T.vertices.end(), [&](const Vec3& vertex) {
        const Vec3 off = vertex - at;
        return off.z() > 0 ? off.head<2>().norm() < kBesideDuct : off.norm() < kBesideDuct;
      });
    };
    const Vec3 end = first ? path.back() : path.front(), middle = (end + organ_T.vertices[v]) / 2;
    if (end.norm() < drawn_reach && free(end) && free(middle)) return path;
  }
  return std::nullopt;
}

/// A path whose ends lie where they hang, the points between moved along with them; nothing: one finds no place.
std::optional<std::vector<Vec3>> hung_path(const DuctPlan& plan, const TriangleSurface& organ_T) {
  std::array<Vec3, 2> shift{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t end = 0; end < 2; ++end) {
    if (plan.ends[end] == DuctHold::kFixed) continue;
    const Vec3& drawn = end == 0 ? plan.path_m.front() : plan.path_m.back();
    const auto nearest = std::min_element(
        organ_T.vertices.begin(), organ_T.vertices.end(),
        [&](const Vec3& a, const Vec3& b) { return (a - drawn).squaredNorm() < (b - drawn).squaredNorm(); });
    shift[end] = *nearest - drawn;
    if (shift[end].norm() > kDuctReach) return path_elsewhere(plan, organ_T);
  }
  std::vector<Vec3> path = plan.path_m;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(path.size() - 1);
    path[i] += (1 - share) * shift[0] + share * shift[1];
  }
  return path;
}

/// The ducts of the exercise that this organ has. @throws InputError: a tissue that is not known.
void hang_ducts(Scene& scene, const TissueTable& tissues) {
  const Exercise& exercise = scene.setup.exercise;
  for (const DuctPlan& plan : exercise.ducts) {
    if (!tissues.knows(plan.material))
      throw InputError(exercise.file.string() + ": duct '" + plan.name + "': 'material': no tissue is called '" +
                       plan.material + "'");
    auto path = plan.organ == scene.organ.material ? hung_path(plan, *scene.organ_T) : std::nullopt;
    if (!path) {
      scene.thin_left_out.push_back(plan.name);
      continue;
    }
    scene.ducts.push_back({plan.name, std::move(*path), plan.outer_radius_m, plan.wall_m,
                           stiffness_choice(tissues.find(plan.material), scene.setup.tissue), plan.ends, plan.content,
                           plan.content == DuctContent::kNothing});
  }
  scene.thin_T = drawn_tubes(scene.ducts);
}

/// Laid on the organ from above, as far as it is there; none: a place of it is beside the organ or too steep.
std::optional<SheetSetup> laid_sheet(const SheetPlan& plan, const HeightField& organ_T) {
  SheetSetup out{
      plan.name, rectangular_sheet(plan.along_m.norm(), plan.across_m, plan.edge_m), {}, plan.thickness_m, {}};
  const Eigen::Vector2d along = plan.along_m.normalized(), across(-along.y(), along.x());
  for (std::size_t v = 0; v < out.drawn_T.vertices.size(); ++v) {
    Vec3& vertex = out.drawn_T.vertices[v];
    if (vertex.y() < 1e-9) out.hinge.push_back(static_cast<std::int32_t>(v));
    const Eigen::Vector2d at = plan.corner_m + vertex.x() * along + vertex.y() * across;
    const auto top = organ_T.top(at.x(), at.y());
    if (!top || top->slope_rad > kSteepestSheet) return std::nullopt;
    vertex = top->position + (plan.thickness_m / 2 + kSheetClear) * top->normal;
  }
  return out;
}

/// Spread in a frame over any organ.
SheetSetup framed_sheet(const SheetPlan& plan, const HeightField& organ_T) {
  SheetSetup out{
      plan.name, rectangular_sheet(plan.along_m.norm(), plan.across_m, plan.edge_m), {}, plan.thickness_m, {}};
  out.framed = true;
  const SheetFrame frame(plan, organ_T);
  for (std::size_t v = 0; v < out.drawn_T.vertices.size(); ++v) {
    Vec3& vertex = out.drawn_T.vertices[v];
    const Eigen::Vector2d place(vertex.x(), vertex.y());
    if (frame.clipped(place)) out.hinge.push_back(static_cast<std::int32_t>(v));
    vertex = frame.at(place);
  }
  return out;
}

/// The sheets of the exercise that this organ has. @throws InputError: a tissue that is not known.
void lay_sheets(Scene& scene, const TissueTable& tissues) {
  const Exercise& exercise = scene.setup.exercise;
  if (exercise.sheets.empty()) return;
  const HeightField field(*scene.organ_T);
  for (const SheetPlan& plan : exercise.sheets) {
    if (!tissues.knows(plan.material))
      throw InputError(exercise.file.string() + ": sheet '" + plan.name + "': 'material': no tissue is called '" +
                       plan.material + "'");
    auto laid = plan.organ.empty()                   ? std::optional(framed_sheet(plan, field))
                : plan.organ == scene.organ.material ? laid_sheet(plan, field)
                                                     : std::nullopt;
    if (!laid) {
      scene.thin_left_out.push_back(plan.name);
      continue;
    }
    laid->material = stiffness_choice(tissues.find(plan.material), scene.setup.tissue);
    scene.sheets.push_back(std::move(*laid));
  }
  for (const SurfacePtr& sheet : drawn_sheets(scene.sheets)) scene.thin_T.push_back(sheet);
}

/// Binds the neighbour that the exercise names, where this organ's scene has one that faces it.
void bind_neighbour(Scene& scene, const TissueTable& tissues, SoftSetup& soft) {
  const std::optional<BedPlan>& plan = scene.setup.exercise.bed;
  if (!plan || plan->organ != scene.organ.material) return;
  const std::vector<Organ>& others = scene.organ.adjacent;
  const auto other =
      std::find_if(others.begin(), others.end(), [&](const Organ& o) { return o.name == plan->neighbour; });
  if (other == others.end()) return;
  if (!tissues.knows(plan->material))
    throw InputError(scene.setup.exercise.file.string() + ": bed: 'material': no tissue is called '" + plan->material +
                     "'");
  const TriangleSurface surface_T = other->surface.transformed(scene.placement.X_TO);
  LatticeOptions options;
  options.cell_m = kLatticeCell;
  options.grid_m = soft.lattice.origin_m;
  const Lattice both = beside(soft.lattice, build_lattice(surface_T, options).lattice);
  const SurfacePtr both_T = both_surfaces(*scene.organ_T, surface_T);
  const TissueSolid neighbour = stiffness_choice(tissues.find(plan->material), scene.setup.tissue);
  BedOptions bed;
  bed.strength_pa = plan->strength_pa;
  bed.energy_j_per_m2 = plan->energy_j_per_m2;
  bed.reach_m = plan->reach_m;
  if (!faces(CutLattice(both, both_T), bed)) return;
  soft.lattice = both;
  soft.neighbour = neighbour;
  soft.bed = bed;
  scene.organ_T = both_T;
  scene.bound = other->name;
}

/// Lays a lattice over the organ where it lies. @throws InputError: a tissue that is none.
void soften(Scene& scene) {
  const TissueTable tissues = TissueTable::load(find_assets().assets / "tissues.toml");
  auto soft = std::make_shared<SoftSetup>();
  try {
    soft->material = stiffness_choice(tissues.find(scene.organ.material), scene.setup.tissue);
  } catch (const std::invalid_argument& error) {  // a recording may name any word
    throw InputError(std::string("tissue: ") + error.what());
  }
  soft->options.solid.edge_m = kLatticeCell;
  soft->breathing = scene.setup.exercise.breathing;
  LatticeOptions options;
  options.cell_m = kLatticeCell;
  soft->lattice = build_lattice(*scene.organ_T, options).lattice;
  bind_neighbour(scene, tissues, *soft);
  scene.embedded = std::make_shared<EmbeddedSurface>(soft->lattice, scene.organ_T);
  scene.soft = std::move(soft);
  hang_ducts(scene, tissues);
  lay_sheets(scene, tissues);
  if (const auto& plan = scene.setup.exercise.suture) {
    SutureSetup suture;
    suture.needle.length_m = plan->needle_m;
    suture.needle.circle = plan->circle;
    suture.thread_m = plan->thread_m;
    suture.jaws.pad_length_m = describe(InstrumentKind::kNeedleDriver).jaw_length_m;
    scene.suture = std::make_shared<const SutureSetup>(suture);
  }
}

/// What the board hides in the organ; one that stands still hides nothing (run_session() refuses it).
void hide(Scene& scene) {
  if (scene.board.nodules.empty() || !scene.soft) return;
  auto soft = std::make_shared<SoftSetup>(*scene.soft);
  for (const HiddenNodule& nodule : scene.board.nodules)
    soft->options.balls.push_back({nodule.centre_T, nodule.radius_m, nodule.stiffness_ratio});
  scene.soft = std::move(soft);
}

/// The ducts where the board has them. @throws InputError: this organ has not all of them
void run_ducts(Scene& scene) {
  const std::vector<std::vector<Vec3>>& paths_T = scene.board.ducts_T;
  if (paths_T.empty() || !scene.soft) return;
  if (scene.ducts.size() != paths_T.size())
    throw InputError("exercise '" + scene.setup.exercise.id + "' happens at ducts that this organ has not (" +
                     joined(scene.thin_left_out) + "): choose a liver");
  for (std::size_t d = 0; d < paths_T.size(); ++d) scene.ducts[d].path_T = paths_T[d];
  scene.thin_T = drawn_tubes(scene.ducts);
}

/// Needles that stand ready where the board has them.
void set_needle_up(Scene& scene) {
  const auto X_TN = needle_stand(scene.setup.exercise, scene.board);
  if (!X_TN || !scene.suture) return;
  auto suture = std::make_shared<SutureSetup>(*scene.suture);
  suture->X_TN = *X_TN;
  suture->stands = true;
  suture->thread_along_T = -X_TN->R.col(2);  // over the organ, away from the jaws
  scene.suture = std::move(suture);
}

/// As the exercise has it lie; nullopt: it says nothing of it, or this organ has not the one that is to be in the
/// middle.
std::optional<Pose> lying(const Exercise& exercise, const Organ& organ) {
  if (!exercise.lie) return std::nullopt;
  const auto middle = std::find_if(organ.adjacent.begin(), organ.adjacent.end(),
                                   [&](const Organ& other) { return other.name == exercise.lie->middle; });
  if (middle == organ.adjacent.end() || middle->surface.vertices.empty()) return std::nullopt;
  Pose X_TO{theatre_from_ras(), Vec3::Zero()};
  for (const int axis : {0, 1, 2})
    X_TO.R = Mat3(Eigen::AngleAxisd(exercise.lie->turned_rad[axis], Vec3::Unit(axis)) * X_TO.R);
  Vec3 sum = Vec3::Zero();
  double top = -INFINITY;
  for (const Vec3& vertex : middle->surface.vertices) {
    sum += X_TO.R * vertex;
    top = std::max(top, (X_TO.R * vertex).z());
  }
  const Vec3 centre = sum / static_cast<double>(middle->surface.vertices.size());
  X_TO.p = -Vec3(centre.x(), centre.y(), top);
  return X_TO;
}

/// Lays the organ, and what lies round it, into the theatre.
void place(Scene& scene) {
  const Exercise& exercise = scene.setup.exercise;
  const Instrument instrument{scene.loop.tool, scene.loop.map};
  if (scene.setup.placement)
    scene.placement = *scene.setup.placement;
  else if (const auto X_TO = lying(exercise, scene.organ))
    scene.placement = measure_placement(scene.organ.surface, *X_TO, exercise.layout, instrument);
  else
    scene.placement = place_organ(scene.organ.surface, exercise, scene.level, instrument);
  scene.organ_T = still_surface(scene.organ.surface.transformed(scene.placement.X_TO));
  if (scene.setup.tissue != kStillTissue) soften(scene);
  if (scene.organ.adjacent.empty()) return;
  const MaterialTable materials = MaterialTable::load(find_assets().assets / "materials.toml");
  scene.adjacent =
      place_adjacent_organs(scene.organ, *scene.organ_T, scene.placement.X_TO, exercise, materials, scene.bound);
}

/// Organ, board, force scale, and the instruments that the exercise takes.
void set_stage(Scene& scene) {
  const Exercise& exercise = scene.setup.exercise;
  std::optional<ShaftRoom> room;
  if (kind_of(exercise).on_organ) {
    place(scene);
    room.emplace(felt_surface(scene), scene.loop.tool, scene.loop.map);
  }
  const ShaftRoom* behind_tip = room ? &*room : nullptr;
  draw_board(scene, behind_tip);
  hide(scene);
  run_ducts(scene);
  set_needle_up(scene);
  if (kind_of(exercise).on_organ) require_reach(scene);
  for (const InstrumentKind kind : exercise.instruments) scene.loop.tools.push_back(make_tool(kind, scene.loop.tool));
  scene.loop.tool = scene.loop.tools.front().shape;
  scene.loop.map.force_scale = force_scale(scene, behind_tip);
  require_force(scene);
}

/// Nothing is homed, armed or late where there is no device.
void spare_the_device(HapticLoopConfig& loop) {
  loop.device.transmission = pointer_transmissions();
  SafetyLimits& limits = loop.safety;
  limits.selftest_s = limits.homing.beam_s = limits.homing.still_s = limits.arm_s = limits.ramp_s = kPointerAwake_s;
  limits.selftest_limit_s = limits.max_missed_share = std::numeric_limits<double>::infinity();
  limits.max_missed_in_a_row = std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

Vec3 entry_T(const Scene& scene) {
  const Vec3 start = scene.board.start_T, rest = scene.loop.map.instrument_pose(home_pose()).p;
  const Vec3 way(rest.x() - start.x(), rest.y() - start.y(), 0);
  return start + kEntryAside * (way.norm() > 1e-6 ? Vec3(way.normalized()) : Vec3::UnitX()) +
         kEntryAbove * Vec3::UnitZ();
}

Organ organ_of(const AttemptSetup& setup, const AssetRoots& assets) {
  if (kind_of(setup.exercise).on_organ) {
    Organ organ = load_organ(find_organ(setup.organ, assets.assets));
    require_sound(organ);
    return organ;
  }
  Organ none;
  none.name = "none";
  return none;
}

Scene build_scene(const AttemptSetup& setup, const AssetRoots& assets, const DaqCapabilities& daq) {
  find_level(setup.exercise, setup.level);  // a wrong level is refused before anything is loaded
  return build_scene(setup, organ_of(setup, assets), daq);
}

Scene build_scene(const AttemptSetup& setup, Organ organ, const DaqCapabilities& daq) {
  Scene scene;
  scene.setup = setup;
  scene.level = find_level(setup.exercise, setup.level);
  scene.organ = std::move(organ);
  scene.loop.daq = daq;
  scene.loop.device = device_model(setup.device, setup.backend);
  scene.loop.map = place_theatre(scene.level);
  set_stage(scene);
  scene.room_share = room_share(scene.loop.map, scene.loop.device, setup.exercise.layout, setup.exercise.soft_force_n);
  scene.loop.safety.max_missed_in_a_row = setup.pace.missed_in_a_row;
  scene.loop.safety.max_missed_share = setup.pace.missed_share;
  scene.loop.safety.max_patch_age_s = std::max(kPatchAge_s, 2 * setup.pace.missed_in_a_row / setup.rate_hz);
  if (!daq.motors) spare_the_device(scene.loop);
  scene.loop.contact_law = setup.contact_law;
  scene.loop.passivity.law = setup.passivity_law;
  scene.loop.pinch_passivity.law = setup.passivity_law;
  scene.loop.clamp_stiffness = setup.clamp_stiffness;
  scene.loop.motors = setup.motors;
  return scene;
}

std::string scene_json(const Scene& scene) {
  const AttemptSetup& s = scene.setup;
  nlohmann::json json = {
      {"format", kFormat},
      {"exercise", {{"text", s.exercise.text}, {"file", s.exercise.file.filename().string()}, {"level", s.level}}},
      {"organ",
       {{"reference", s.organ},
        {"sha256", scene.organ.sha256},
        {"name", scene.organ.name},
        {"synthetic", scene.organ.synthetic},
        {"credit", scene.organ.credit}}},
      {"hand", s.hand},
      {"seed", s.seed},
      {"board", s.board},
      {"rate_hz", scene.loop.daq.rate_hz},
      {"dac_bits", scene.loop.daq.dac_bits},
      {"realtime", s.realtime},
      {"pace", {{"missed_in_a_row", s.pace.missed_in_a_row}, {"missed_share", s.pace.missed_share}}},
      {"contact_law", law_name(s.contact_law)},
      {"passivity_law", passivity_law_name(s.passivity_law)},
      {"clamp_stiffness", s.clamp_stiffness},
      {"force_scale", scene.loop.map.force_scale}};
  if (!scene.loop.daq.motors) json["motors"] = false;
  if (scene.draw > 0) json["draw"] = scene.draw;
  if (s.tissue != kStillTissue) json["tissue"] = s.tissue;
  if (kind_of(s.exercise).on_organ) json["placement"] = placement_json(scene.placement);
  if (is_real_device(s.backend)) json["backend"] = s.backend;  // it homes otherwise than a simulated one
  if (s.device.calibration) json["calibration"] = file_json(*s.device.calibration);
  if (s.device.identified) json["device"] = file_json(*s.device.identified);
  if (scene.loop.motors != MotorStates{}) json[kMotorsKey] = motor_pairs(scene.loop.motors);
  return json.dump();
}

const Rubric& rubric_for(const ExerciseLevel& level, const DaqCapabilities& daq) {
  return daq.motors ? level.rubric : level.pointer.rubric;
}

RecordedSetup parse_scene_json(const std::string& text, const std::string& name) {
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("format").get<int>() != kFormat) throw InputError(name + kUnreadable + "unknown format");
    RecordedSetup out;
    AttemptSetup& s = out.setup;
    const auto& exercise = json.at("exercise");
    s.exercise = parse_exercise(exercise.at("text").get<std::string>(), exercise.at("file").get<std::string>());
    s.level = exercise.at("level").get<std::string>();
    s.organ = json.at("organ").at("reference").get<std::string>();
    out.organ_sha256 = json.at("organ").at("sha256").get<std::string>();
    s.hand = json.at("hand").get<std::string>();
    s.seed = json.at("seed").get<std::int64_t>();
    s.board = json.at("board").get<int>();
    s.draw = json.value("draw", 0);
    s.rate_hz = json.at("rate_hz").get<double>();
    s.realtime = json.value("realtime", false);
    s.tissue = json.value("tissue", kStillTissue);
    if (json.contains("pace")) {  // recordings before live runs kept the defaults
      s.pace = {json.at("pace").at("missed_in_a_row").get<std::uint32_t>(),
                json.at("pace").at("missed_share").get<double>()};
    }
    out.daq = {"replay", s.rate_hz, json.at("dac_bits").get<int>(), json.value("motors", true)};
    out.force_scale = json.at("force_scale").get<double>();
    s.contact_law = json.at("contact_law").get<std::string>() == "thesis" ? ContactLaw::kThesis : ContactLaw::kProxy;
    const auto law = passivity_law_named(json.at("passivity_law").get<std::string>());
    if (!law)
      throw InputError(name + kUnreadable + "passivity law '" + json.at("passivity_law").get<std::string>() + "'");
    s.passivity_law = *law;
    s.clamp_stiffness = json.value("clamp_stiffness", false);
    if (json.contains("placement"))
      s.placement = placement_of(json.at("placement"), name);  // older recordings: looked for again
    s.device = {file_of(json, "calibration"), file_of(json, "device")};
    s.backend = json.value("backend", s.backend);
    s.motors = motors_of(json, name);
    return out;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(name + kUnreadable + error.what());
  }
}

}  // namespace trocar
