// The writer of scenarios/files/plant_file.h.
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "haptics/device/plant/plant_fields.h"
#include "scenarios/files/plant_file.h"

namespace trocar {
namespace {

constexpr std::size_t kSourceColumn = 52;

/// The fewest digits that read back as the same number; a stop without end as its word.
std::string plant_digits(double value) {
  if (std::isinf(value)) return "\"none\"";
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  std::string number(text, end);
  return number.find_first_of(".en") == std::string::npos ? number + ".0" : number;
}

class Writer {
 public:
  /// @param on false: the whole table as comments.
  void table(const std::string& name, const std::string& source, bool on = true) {
    lead_ = on ? "" : "# ";
    out_ << '\n';
    line("[" + name + "]", source);
  }
  void number(const char* key, double value, const std::string& source) {
    line(std::string(key) + " = " + plant_digits(value), source);
  }
  void vector(const char* key, const Vec3& v, const std::string& source) {
    line(std::string(key) + " = [" + plant_digits(v[0]) + ", " + plant_digits(v[1]) + ", " + plant_digits(v[2]) + "]",
         source);
  }
  void line(std::string text, const std::string& source) {
    text = lead_ + text;
    out_ << text;
    if (!source.empty())
      out_ << std::string(text.size() < kSourceColumn ? kSourceColumn - text.size() : 1, ' ') << "# " << source;
    out_ << '\n';
  }
  void comment(const std::string& text) {
    std::istringstream lines(text);
    for (std::string one; std::getline(lines, one);) out_ << "# " << one << '\n';
  }
  std::string str() const { return out_.str(); }

 private:
  std::string lead_;
  std::ostringstream out_;
};

void write_bodies(Writer& out, PlantParameters p) {
  const std::pair<const char*, const char*> tables[] = {
      {"arm", "axes W' at home: x, y level, z up"}, {"wrist_motors", "turns with the platform"},
      {"link1", "turns with the platform"},         {"elbow_motor", "turns with the platform"},
      {"stylus", "link 2 and stylus, stylus axes"}, {"jaw", ""},
      {"electronics", "of all seven channels"}};
  for (const auto& [name, what] : tables) {
    out.table(name, what);
    for (const PlantNumber& f : plant_numbers()) {
      if (std::string_view(f.table) == name) out.number(f.key, f.at(p), f.source);
    }
    for (const PlantVector& f : plant_vectors()) {
      if (std::string_view(f.table) == name) out.vector(f.key, f.at(p), f.source);
    }
  }
}

void write_channels(Writer& out, PlantParameters p) {
  for (int i = 0; i < kChannels; ++i) {
    const bool pinch = i == kPinchChannel;
    const char* what = i == 0 ? "what is the same for all six may stand in [joints] instead" : "";
    out.table(pinch ? kPinchTable : kJointTables[i], what);
    for (const ChannelNumber& f : pinch ? pinch_numbers() : joint_numbers()) {
      out.number(f.key, f.at(p, i), i == 0 || pinch ? f.source : "");
    }
  }
}

void write_cable(Writer& out, PlantParameters p) {
  bool on = false;
  for (const CableParameters& cable : p.options.cable) on = on || cable.stiffness > 0;
  out.table("cable",
            on ? "elastic capstan cables"
               : "off: rigid. Elastic capstan cables of all joints, [cable.th1] to [cable.th6] of one",
            on);
  if (!on) p.options.cable[0].stiffness = kNominalCable;
  for (const ChannelNumber& f : cable_numbers()) out.number(f.key, f.at(p, 0), f.source);
  for (int i = 1; on && i < kArmJoints; ++i) {
    out.table(std::string("cable.") + kJointTables[i], "");
    for (const ChannelNumber& f : cable_numbers()) out.number(f.key, f.at(p, i), "");
  }
}

void write_options(Writer& out, PlantParameters p) {
  write_cable(out, p);
  const PlantOptions o = p.options;
  const std::pair<const char*, const char*> tables[] = {{"encoder", "off: nothing missed, no index"},
                                                        {"beam", "as it is: the light of the jig, ideal"},
                                                        {"pinch_drive", "off: a pulley on the motor, its encoder"},
                                                        {"heat", "off: windings stay at their start"}};
  for (const auto& [name, off] : tables) {
    const std::string_view table = name;
    bool on = table == "heat" && o.heat.on;
    PlantParameters plain;
    for (const PlantNumber& f : option_numbers())
      on = on || (table == f.table && table != "heat" && f.at(p) != f.at(plain));
    if (table == "encoder" && !on) p.options.encoder = {1e-6, 100e3};
    out.table(name, on ? "" : off, on);
    for (const PlantNumber& f : option_numbers()) {
      if (std::string_view(f.table) == name) out.number(f.key, f.at(p), f.source);
    }
  }
  out.table("delay", o.jitter_periods > 0 ? "" : "off: always the same", o.jitter_periods > 0);
  out.line("jitter_periods = " + std::to_string(o.jitter_periods > 0 ? o.jitter_periods : 2),
           "most further periods between write and DAC: 0 to 2 ms is an assumption");
}

void write_people(Writer& out) {
  const WrenchSensorConfig s;
  out.table("sensor", "off: these are the ones that run and studies have", false);
  out.number("rate_hz", s.force.rate_hz, "[T]");
  out.number("lag_s", s.force.lag_s, "[T]");
  out.number("noise_n", s.force.noise_n, "assumption");
  out.number("drift_n_per_h", s.force.drift_n_per_h, "assumption");
  out.number("noise_n_m", s.noise_nm, "assumption");
  out.number("drift_n_m_per_h", s.drift_nm_per_h, "assumption");
  out.number("fixture_kg", s.fixture_kg, "hangs on the sensor, in its reading only");
  out.vector("fixture_com_m", s.fixture_com, "stylus axes");
  const HandReaction r;
  out.table("hand", "off: normal grip that does not react", false);
  out.line("grip = \"normal\"", "fingertip, light, normal or firm");
  out.line("drawn = false", "impedance and reaction drawn by the file's seed");
  out.line("reacts = true", "");
  out.number("notice_n", r.notice_n, "assumption");
  out.number("reflex_s", r.reflex_s, "[M] 30 to 50 ms after the touch the arm stiffens");
  out.number("reflex_gain", r.reflex_gain, "assumption");
  out.number("reaction_s", r.reaction_s, "[M] 150 to 200 ms: the fingers begin to close");
  out.number("firm_s", r.firm_s, "the grip is firm: the operator stabilises it");
}

}  // namespace

std::string plant_toml(const PlantParameters& parameters, const std::string& comment) {
  Writer out;
  out.comment(comment);
  out.comment(
      "[T] thesis  [F] public data sheet  [C] computed  [M] remembered data sheet  assumption: nothing is known");
  write_bodies(out, parameters);
  write_channels(out, parameters);
  write_options(out, parameters);
  write_people(out);
  return out.str();
}

}  // namespace trocar
