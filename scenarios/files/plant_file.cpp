#include "scenarios/files/plant_file.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "haptics/device/plant/plant_check.h"
#include "haptics/device/plant/plant_fields.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {
namespace {

constexpr int kMostSeed = std::numeric_limits<int>::max(), kMostJitter = 63;

/// Reads a table that may be absent.
template <class Read>
void in_table(StrictTable& root, const char* name, const Read& read) {
  root.allow(name);
  if (!root.has(name)) return;
  StrictTable table = root.table(name);
  read(table);
  table.finish();
}

void read_number(StrictTable& table, const PlantNumber& f, PlantParameters& p) {
  f.at(p) = table.number_or(f.key, f.low, f.high, f.at(p));
}

void read_channel(StrictTable& table, std::span<const ChannelNumber> fields, PlantParameters& p, int channel) {
  for (const ChannelNumber& f : fields) {
    table.allow(f.key);
    if (!table.has(f.key)) continue;
    const bool lower = std::string_view(f.key).find("lower") != std::string_view::npos;
    const double end = (lower ? -1 : 1) * std::numeric_limits<double>::infinity();
    f.at(p, channel) =
        f.endless ? table.number_or_word(f.key, f.low, f.high, "none", end) : table.number(f.key, f.low, f.high);
  }
}

void read_bodies(StrictTable& root, PlantParameters& p) {
  for (const char* name : {"arm", "wrist_motors", "link1", "elbow_motor", "stylus", "jaw", "electronics"}) {
    in_table(root, name, [&](StrictTable& table) {
      for (const PlantNumber& f : plant_numbers()) {
        if (std::string_view(f.table) == name) read_number(table, f, p);
      }
      for (const PlantVector& f : plant_vectors()) {
        if (std::string_view(f.table) == name) f.at(p) = table.vector_or(f.key, f.low, f.high, f.at(p));
      }
    });
  }
}

void read_channels(StrictTable& root, PlantParameters& p) {
  in_table(root, "joints", [&](StrictTable& table) {
    for (int i = 0; i < kArmJoints; ++i) read_channel(table, joint_numbers(), p, i);
  });
  for (int i = 0; i < kArmJoints; ++i) {
    in_table(root, kJointTables[i], [&](StrictTable& table) { read_channel(table, joint_numbers(), p, i); });
  }
  in_table(root, kPinchTable, [&](StrictTable& table) { read_channel(table, pinch_numbers(), p, kPinchChannel); });
}

void read_cable(StrictTable& root, PlantParameters& p) {
  in_table(root, "cable", [&](StrictTable& table) {
    for (int i = 0; i < kArmJoints; ++i) {
      p.options.cable[static_cast<std::size_t>(i)].stiffness = kNominalCable;
      read_channel(table, cable_numbers(), p, i);
    }
    for (int i = 0; i < kArmJoints; ++i) {
      in_table(table, kJointTables[i], [&](StrictTable& joint) { read_channel(joint, cable_numbers(), p, i); });
    }
  });
}

void read_options(StrictTable& root, PlantParameters& p) {
  read_cable(root, p);
  for (const char* name : {"encoder", "beam", "pinch_drive", "heat"}) {
    in_table(root, name, [&](StrictTable& table) {
      for (const PlantNumber& f : option_numbers()) {
        if (std::string_view(f.table) == name) read_number(table, f, p);
      }
      if (std::string_view(name) == "heat") p.options.heat.on = true;
    });
  }
  in_table(root, "delay",
           [&](StrictTable& table) { p.options.jitter_periods = table.integer("jitter_periods", 0, kMostJitter); });
}

void read_sensor(StrictTable& root, PlantFile& plant) {
  in_table(root, "sensor", [&](StrictTable& table) {
    WrenchSensorConfig s;
    s.force.rate_hz = table.number_or("rate_hz", 1, 1000, s.force.rate_hz);
    s.force.lag_s = table.number_or("lag_s", 0, 10, s.force.lag_s);
    s.force.noise_n = table.number_or("noise_n", 0, 10, s.force.noise_n);
    s.force.drift_n_per_h = table.number_or("drift_n_per_h", -100, 100, s.force.drift_n_per_h);
    s.noise_nm = table.number_or("noise_n_m", 0, 1, s.noise_nm);
    s.drift_nm_per_h = table.number_or("drift_n_m_per_h", -10, 10, s.drift_nm_per_h);
    s.fixture_kg = table.number_or("fixture_kg", 0, 1, s.fixture_kg);
    s.fixture_com = table.vector_or("fixture_com_m", -0.5, 0.5, s.fixture_com);
    s.gravity = plant.parameters.gravity;
    plant.sensor = s;
  });
}

void read_reaction(StrictTable& table, HandReaction& r) {
  r.on = true;
  r.notice_n = table.number_or("notice_n", 0.01, 20, r.notice_n);
  r.reflex_s = table.number_or("reflex_s", 0, 2, r.reflex_s);
  r.reflex_gain = table.number_or("reflex_gain", 1, 10, r.reflex_gain);
  r.reaction_s = table.number_or("reaction_s", 0, 2, r.reaction_s);
  r.firm_s = table.number_or("firm_s", 0.05, 5, r.firm_s);
  if (r.firm_s <= r.reaction_s)
    table.fail("firm_s", "'firm_s' must come after 'reaction_s': the fingers need time to close");
}

/// @param seed of the file; -1 without one.
void read_hand(StrictTable& root, int seed, PlantFile& plant) {
  in_table(root, "hand", [&](StrictTable& table) {
    const std::vector<std::string> grips{"fingertip", "light", "normal", "firm"};
    const std::string word = table.choice_or("grip", grips, "normal");
    const auto grip = static_cast<GripPreset>(std::find(grips.begin(), grips.end(), word) - grips.begin());
    const bool drawn = table.flag_or("drawn", false);
    if (drawn && seed < 0) table.fail("drawn", "a drawn hand needs the file's 'seed'");
    HandParameters h = drawn ? draw_hand_parameters(grip, static_cast<std::uint64_t>(seed)) : hand_parameters(grip);
    h.grip_stiffness = table.number_or("grip_n_per_m", 1, 1e4, h.grip_stiffness);
    h.grip_damping = table.number_or("grip_n_s_per_m", 0, 100, h.grip_damping);
    h.hand_mass = table.number_or("hand_kg", 0.01, 10, h.hand_mass);
    h.arm_stiffness = table.number_or("arm_n_per_m", 1, 1e4, h.arm_stiffness);
    h.arm_damping = table.number_or("arm_n_s_per_m", 0, 1000, h.arm_damping);
    h.tremor_m = table.number_or("tremor_m", 0, 0.01, h.tremor_m);
    if (table.flag_or("reacts", false)) {
      if (drawn) h.reaction = draw_hand_reaction(static_cast<std::uint64_t>(seed));
      read_reaction(table, h.reaction);
    }
    plant.hand = h;
  });
}

/// Where the file has the table of a refusal: a joint's value may stand for all joints.
[[noreturn]] void fail_at(StrictTable& root, const PlantRefusal& refusal) {
  const bool joint = refusal.table.starts_with("th") && !root.has(refusal.table);
  const std::string table = joint && root.has("joints") ? "joints" : refusal.table;
  if (root.has(table)) root.table(table).fail(refusal.key, refusal.text());
  root.fail(table, refusal.text());
}

}  // namespace

PlantFile parse_plant(const std::string& text, const std::string& name) {
  StrictTable root = StrictTable::parse(text, name);
  PlantFile plant;
  const int seed = root.integer_or("seed", 0, kMostSeed, -1);
  const bool all = root.choice_or("variation", {"all"}, "") == "all";
  if (all && seed < 0) root.fail("variation", "'variation' needs a 'seed' to draw by");
  const auto drawn_by = static_cast<std::uint64_t>(seed);
  plant.parameters = seed < 0 ? nominal_parameters() : all ? draw_everything(drawn_by) : draw_parameters(drawn_by);
  read_bodies(root, plant.parameters);
  read_channels(root, plant.parameters);
  read_options(root, plant.parameters);
  read_sensor(root, plant);
  read_hand(root, seed, plant);
  root.finish();
  if (const auto refusal = plant_refusal(plant.parameters)) fail_at(root, *refusal);
  plant.name = std::filesystem::path(name).filename().string();
  plant.sha256 = digest::of_bytes(text);
  return plant;
}

PlantFile load_plant(const std::filesystem::path& file) {
  std::error_code none;
  const bool hollow = std::filesystem::is_regular_file(file, none) && std::filesystem::file_size(file, none) == 0;
  const std::string text = hollow ? "" : read_text_file(file.string());
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(file.string() + ": is empty; `trocar device plant` prints a plant file to start from");
  }
  return parse_plant(text, file.string());
}

}  // namespace trocar
