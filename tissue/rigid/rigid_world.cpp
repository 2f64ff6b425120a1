#include "tissue/rigid/rigid_world.h"

#include <algorithm>
#include <string>

#include "haptics/input_error.h"
#include "tissue/rigid/body_contact.h"

namespace trocar {
namespace {

constexpr double kTableHalf = 0.25;  // m, of the table under the board
constexpr double kTouchSkin = 1e-4;  // m between two blocks that still counts as touching
constexpr int kBoxTriangles = 12;
constexpr std::int32_t kFirstBlockId = kFirstRigidId + 16, kFirstPegId = kFirstRigidId + 4096;
constexpr int kPegSides = 6, kPegTriangles = 3 * kPegSides;

constexpr std::array<std::array<int, 3>, 2> kBoardFaces{{{0, 1, 2}, {0, 2, 3}}};
/// Corners of BoxShape::corner(), counter-clockwise from outside.
constexpr std::array<std::array<int, 3>, kBoxTriangles> kBoxFaces{{{0, 2, 1},
                                                                   {1, 2, 3},
                                                                   {4, 5, 6},
                                                                   {5, 7, 6},
                                                                   {0, 1, 4},
                                                                   {1, 5, 4},
                                                                   {2, 6, 3},
                                                                   {3, 6, 7},
                                                                   {0, 4, 2},
                                                                   {2, 4, 6},
                                                                   {1, 3, 5},
                                                                   {3, 7, 5}}};

/// Corners of RingShape::corner(), counter-clockwise from outside; the hole is not felt.
constexpr std::array<std::array<int, 3>, 8> kRingFaces{
    {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};

/// A peg as a prism with a flat end, as thick as it is in the mean.
void add_peg(const PegPost& peg, std::int32_t first_id, ContactPatch& patch) {
  std::array<Vec3, 2 * kPegSides + 1> corners;
  std::array<std::array<int, 3>, kPegTriangles> faces;
  const Vec3 top = peg.foot_T + Vec3(0, 0, peg.height_m);
  const double radius = peg.radius_m * 2 / (1 + std::cos(M_PI / kPegSides));
  corners[2 * kPegSides] = top;
  for (int k = 0; k < kPegSides; ++k) {
    const double angle = 2 * M_PI * k / kPegSides;
    const Vec3 off(radius * std::cos(angle), radius * std::sin(angle), 0);
    const auto low = static_cast<std::size_t>(k);
    const int next = (k + 1) % kPegSides;
    corners[low] = peg.foot_T + off;
    corners[low + kPegSides] = top + off;
    faces[3 * low] = {k, next, next + kPegSides};
    faces[3 * low + 1] = {k, next + kPegSides, k + kPegSides};
    faces[3 * low + 2] = {k + kPegSides, next + kPegSides, 2 * kPegSides};
  }
  add_surface(patch, corners, faces, first_id, kBoardMaterial);
}

BlockDynamicsSettings dynamics_of(const RigidScene& scene) {
  BlockDynamicsSettings settings;
  if (scene.board) {
    settings.floor_z_m = scene.board->top_z_m;
    settings.friction = scene.board->material.friction;
  }
  settings.pegs = scene.pegs;
  return settings;
}

CapsuleShape in_theatre(const Pose& X_TI, const Capsule& capsule) {
  const Pose X_TC = X_TI * capsule.X_IC;
  return {X_TC.p, X_TC.p - X_TC.R.col(2) * capsule.length_m, capsule.radius_m};
}

}  // namespace

RigidWorld::RigidWorld(const RigidScene& scene, const Tool& tool)
    : scene_(scene), tool_(tool), dynamics_(dynamics_of(scene)) {
  if (scene.blocks.size() > kMaxObjects) {
    throw InputError("a scene holds at most " + std::to_string(kMaxObjects) + " blocks, not " +
                     std::to_string(scene.blocks.size()));
  }
  if (scene.board) {
    floor_z_m_ = scene.board->top_z_m;
    board_ = scene.board->material;
  }
  for (const FoamBlock& block : scene.blocks) {
    if (block.kind < 0 || block.kind >= kMaxPatchMaterials - kFirstFoamMaterial)
      throw InputError("a scene holds at most " + std::to_string(kMaxPatchMaterials - kFirstFoamMaterial) +
                       " kinds of foam");
    RigidBody body;
    body.half = block.size_m / 2;
    body.hole_radius_m = block.hole_radius_m;
    body.mass_kg = block.mass_kg;
    body.X_TB = block.X_TO;
    body.wake();  // it settles by itself
    bodies_.push_back(body);
    foams_.push_back({block, block.stiffness_n_per_m, false});
  }
}

void RigidWorld::step(const JawReading& jaws, bool present, double dt_s) {
  if (present && tool_.kind == InstrumentKind::kGrasper) {
    grip_.update(jaws, board_, floor_z_m_, scene_.pegs, dt_s, bodies_, foams_);
  } else {
    grip_.reset(bodies_);
  }
  dynamics_.step(bodies_, present ? pushers(jaws) : std::vector<Pusher>{}, dt_s);
  list_pairs(jaws, present);
}

std::vector<Pusher> RigidWorld::pushers(const JawReading& jaws) const {
  const ToolCapsules tool = tool_capsules(tool_.shape, jaws.opening_m, {});
  std::vector<Pusher> out;
  for (int c = 0; c < tool.count; ++c) {
    Pusher pusher;
    pusher.shape = in_theatre(jaws.X_TI, tool.at[static_cast<std::size_t>(c)]);
    pusher.velocity_T = jaws.V_TI_T.linear;
    pusher.spin_T = jaws.V_TI_T.angular;
    pusher.about_T = jaws.X_TI.p;
    pusher.spares = c > 0 ? grip_.object() : -1;  // the jaws move what stands between them in their own way
    out.push_back(pusher);
  }
  return out;
}

bool RigidWorld::near_tool(const JawReading& jaws, const Vec3& from_T, const Vec3& to_T, double reach_m) const {
  const ToolCapsules tool = tool_capsules(tool_.shape, jaws.opening_m, grip_.held(bodies_));
  for (int c = 0; c < tool.count; ++c) {
    const CapsuleShape shape = in_theatre(jaws.X_TI, tool.at[static_cast<std::size_t>(c)]);
    const Vec3 way = shape.to_T - shape.from_T;
    for (const Vec3& point : {from_T, to_T}) {
      const double share = std::clamp((point - shape.from_T).dot(way) / std::max(1e-12, way.squaredNorm()), 0.0, 1.0);
      if ((shape.from_T + share * way - point).norm() < kPatchRadius + reach_m) return true;
    }
  }
  return false;
}

void RigidWorld::add_to(const JawReading& jaws, ContactPatch& patch) const {
  if (scene_.board) {
    patch.material[kBoardMaterial] = {board_.stiffness_n_per_m, board_.damping_s_per_m, board_.tool_mu_static,
                                      board_.tool_mu_dynamic};
    const std::array<Vec3, 4> corners{
        Vec3(-kTableHalf, -kTableHalf, floor_z_m_), Vec3(kTableHalf, -kTableHalf, floor_z_m_),
        Vec3(kTableHalf, kTableHalf, floor_z_m_), Vec3(-kTableHalf, kTableHalf, floor_z_m_)};
    add_surface(patch, corners, kBoardFaces, kFirstRigidId, kBoardMaterial);
  }
  for (std::size_t i = 0; i < scene_.pegs.size(); ++i) {
    const PegPost& peg = scene_.pegs[i];
    if (near_tool(jaws, peg.foot_T, peg.foot_T + Vec3(0, 0, peg.height_m), peg.radius_m))
      add_peg(peg, kFirstPegId + static_cast<std::int32_t>(i) * kPegTriangles, patch);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::int32_t material = kFirstFoamMaterial + foams_[i].spec.kind;
    patch.material[static_cast<std::size_t>(material)] = {foams_[i].spec.stiffness_n_per_m, board_.damping_s_per_m,
                                                          board_.tool_mu_static, board_.tool_mu_dynamic};
    if (static_cast<int>(i) == grip_.object() ||
        !near_tool(jaws, bodies_[i].X_TB.p, bodies_[i].X_TB.p, bodies_[i].half.norm()))
      continue;
    const std::int32_t first_id = kFirstBlockId + static_cast<std::int32_t>(i) * kBoxTriangles;
    std::array<Vec3, 8> corners;
    if (bodies_[i].is_ring()) {
      for (int c = 0; c < 6; ++c) corners[static_cast<std::size_t>(c)] = bodies_[i].ring().corner(c);
      add_surface(patch, std::span(corners).first(6), kRingFaces, first_id, material);
      continue;
    }
    for (int c = 0; c < 8; ++c) corners[static_cast<std::size_t>(c)] = bodies_[i].shape().corner(c);
    add_surface(patch, corners, kBoxFaces, first_id, material);
  }
  patch.grip = grip_.block(bodies_, foams_, jaws.X_TI);
}

void RigidWorld::add_pair(std::int32_t a, std::int32_t b, const RigidContacts& contacts, double stiffness_n_per_m) {
  const RigidContact* deepest = nullptr;
  for (int c = 0; c < contacts.count; ++c) {
    const RigidContact& contact = contacts.at[static_cast<std::size_t>(c)];
    if (!deepest || contact.depth_m > deepest->depth_m) deepest = &contact;
  }
  if (!deepest || pairs_.size() >= kMaxContactPairs) return;
  pairs_.push_back({a, b, deepest->point_T, deepest->normal_T, deepest->depth_m, stiffness_n_per_m * deepest->depth_m});
}

void RigidWorld::list_tool_pairs(const JawReading& jaws) {
  const ToolCapsules tool = tool_capsules(tool_.shape, jaws.opening_m, {});
  for (int c = 0; c < tool.count; ++c) {
    const CapsuleShape shape = in_theatre(jaws.X_TI, tool.at[static_cast<std::size_t>(c)]);
    const std::int32_t party = c == 0 ? kPartyShaft : kPartyJaw;
    if (scene_.board) add_pair(party, kPartyBoard, capsule_plane(shape, floor_z_m_), board_.stiffness_n_per_m);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (static_cast<int>(i) == grip_.object()) continue;
      add_pair(party, static_cast<std::int32_t>(i), capsule_body(shape, bodies_[i]), foams_[i].stiffness_n_per_m);
    }
  }
}

void RigidWorld::list_block_pairs() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BoxShape box = bodies_[i].shape();
    const auto a = static_cast<std::int32_t>(i);
    if (scene_.board && bodies_[i].carried && grip_.board_force_n() > 0)
      add_pair(a, kPartyBoard, box_plane({box.X_TB, box.half + Vec3::Constant(kTouchSkin)}, floor_z_m_), 0);
    if (scene_.port && bodies_[i].carried) {
      const PortTube& port = *scene_.port;
      add_pair(a, kPartyPort, box_cylinder(box, {port.centre_T, port.axis_T, port.radius_m, port.length_m}), 0);
    }
    const BoxShape skinned{box.X_TB, box.half + Vec3::Constant(kTouchSkin)};
    for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
      const bool rings = bodies_[i].is_ring();
      add_pair(a, static_cast<std::int32_t>(j),
               rings ? body_body(bodies_[i], bodies_[j], kTouchSkin) : box_box(skinned, bodies_[j].shape()), 0);
    }
  }
}

void RigidWorld::list_pairs(const JawReading& jaws, bool present) {
  pairs_.clear();
  if (present) list_tool_pairs(jaws);
  list_block_pairs();
}

void RigidWorld::describe(TissueFrame& frame) const {
  frame.object_count = static_cast<std::int32_t>(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const RigidBody& body = bodies_[i];
    ObjectState& object = frame.object[i];
    object.X_TO = body.X_TB;
    object.size_m = 2 * body.half;
    object.velocity_T = body.velocity_T;
    object.kind = foams_[i].spec.kind;
    object.colour = foams_[i].spec.colour;
    object.motion = body.carried ? ObjectMotion::kHeld : body.asleep ? ObjectMotion::kResting : ObjectMotion::kMoving;
    object.crushed = foams_[i].crushed;
  }
  frame.grip = grip_.state();
  frame.grip_object = grip_.object();
  frame.slipped_m = grip_.slipped_m();
  frame.pair_count = static_cast<std::int32_t>(pairs_.size());
  std::copy(pairs_.begin(), pairs_.end(), frame.pair.begin());
}

}  // namespace trocar
