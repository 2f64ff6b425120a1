#include "scenarios/files/duct_reader.h"

#include <algorithm>
#include <cmath>

#include "scenarios/files/file_units.h"

namespace trocar {
namespace {

using file_units::kMilli;

constexpr std::size_t kMostDucts = 5, kMostSheets = 2;
constexpr double kLeastHinge = 0.005, kMostTriangles = 1200;
constexpr double kKilo = 1e3;
constexpr double kLeastLength = 0.010, kLeastStep = 0.001;  // m of a path, and between two of its points

DuctHold hold_named(const std::string& word) { return word == "organ" ? DuctHold::kOrgan : DuctHold::kFixed; }

DuctContent content_named(const std::string& word) {
  return word == "bile" ? DuctContent::kBile : word == "blood" ? DuctContent::kBlood : DuctContent::kNothing;
}

DuctPlan read_duct(StrictTable table) {
  DuctPlan duct;
  duct.name = table.text("name");
  duct.material = table.text("material");
  duct.organ = table.text("organ");
  duct.content = content_named(table.choice("carries", {"bile", "blood", "nothing"}));
  duct.outer_radius_m = table.number("diameter_mm", 1, 10) / 2 * kMilli;
  duct.wall_m = table.number("wall_mm", 0.1, 5) * kMilli;
  if (duct.wall_m >= duct.outer_radius_m) table.fail("wall_mm", "'wall_mm' must be less than half of 'diameter_mm'");
  duct.ends = {hold_named(table.choice("from", {"organ", "bed"})), hold_named(table.choice("to", {"organ", "bed"}))};
  duct.path_m = table.vectors("path_mm", 2, -200, 200);
  double length = 0;
  for (Vec3& point : duct.path_m) point *= kMilli;
  for (std::size_t i = 1; i < duct.path_m.size(); ++i) {
    const double step = (duct.path_m[i] - duct.path_m[i - 1]).norm();
    if (step < kLeastStep) table.fail("path_mm", "'path_mm' has two points less than 1 mm apart");
    length += step;
  }
  if (length < kLeastLength) table.fail("path_mm", "'path_mm' is shorter than 10 mm");
  table.finish();
  return duct;
}

}  // namespace

std::vector<DuctPlan> read_ducts(StrictTable& document) {
  std::vector<DuctPlan> ducts;
  if (!document.has("ducts")) {
    document.allow("ducts");
    return ducts;
  }
  for (StrictTable& table : document.tables("ducts")) {
    DuctPlan duct = read_duct(table);
    const bool twice = std::any_of(ducts.begin(), ducts.end(), [&](const DuctPlan& d) { return d.name == duct.name; });
    if (twice) table.fail("name", "two ducts are called '" + duct.name + "'");
    if (ducts.size() == kMostDucts) table.fail("name", "there are more than five ducts");
    ducts.push_back(std::move(duct));
  }
  return ducts;
}

std::vector<SheetPlan> read_sheets(StrictTable& document) {
  std::vector<SheetPlan> sheets;
  if (!document.has("sheets")) {
    document.allow("sheets");
    return sheets;
  }
  for (StrictTable& table : document.tables("sheets")) {
    if (sheets.size() == kMostSheets) table.fail("name", "there are more than two sheets");
    SheetPlan sheet;
    sheet.name = table.text("name");
    sheet.material = table.text("material");
    sheet.organ = table.text_or("organ", "");
    const auto [corner_x, corner_y] = table.pair("hinge_from_mm", -200, 200);
    const auto [end_x, end_y] = table.pair("hinge_to_mm", -200, 200);
    sheet.corner_m = Eigen::Vector2d(corner_x, corner_y) * kMilli;
    sheet.along_m = Eigen::Vector2d(end_x, end_y) * kMilli - sheet.corner_m;
    sheet.across_m = table.number("across_mm", 5, 100) * kMilli;
    sheet.thickness_m = table.number("thickness_mm", 0.05, 10) * kMilli;
    sheet.edge_m = table.number("edge_mm", 1, 10) * kMilli;
    const double length = sheet.along_m.norm();
    if (length < kLeastHinge) table.fail("hinge_to_mm", "the hinge is shorter than 5 mm");
    if (length * sheet.across_m > kMostTriangles * sheet.edge_m * sheet.edge_m * std::sqrt(3.0) / 4)
      table.fail("edge_mm", "'edge_mm' makes more than 1200 triangles of it");
    table.finish();
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

std::optional<SuturePlan> read_suture(StrictTable& document, const std::vector<InstrumentKind>& instruments) {
  if (!document.has("suture")) {
    document.allow("suture");
    return std::nullopt;
  }
  StrictTable table = document.table("suture");
  const bool driven =
      std::find(instruments.begin(), instruments.end(), InstrumentKind::kNeedleDriver) != instruments.end();
  if (!driven) document.fail("suture", "'suture' needs a 'needle-driver' among the 'instruments'");
  SuturePlan suture;
  suture.needle_m = table.number("needle_mm", 10, 50) * kMilli;
  suture.circle = table.number("circle", 0.25, 0.7);
  suture.thread_m = table.number("thread_mm", 50, 300) * kMilli;
  table.finish();
  return suture;
}

std::optional<LiePlan> read_lie(StrictTable& document) {
  if (!document.has("lie")) {
    document.allow("lie");
    return std::nullopt;
  }
  StrictTable table = document.table("lie");
  LiePlan lie;
  lie.turned_rad = table.vector("turned_deg", -180, 180) * file_units::kDegrees;
  lie.middle = table.text("middle");
  table.finish();
  return lie;
}

std::optional<BedPlan> read_bed(StrictTable& document) {
  if (!document.has("bed")) {
    document.allow("bed");
    return std::nullopt;
  }
  StrictTable table = document.table("bed");
  BedPlan bed;
  bed.organ = table.text("organ");
  bed.neighbour = table.text("neighbour");
  bed.material = table.text("material");
  bed.strength_pa = table.number("strength_kpa", 0.1, 1000) * kKilo;
  bed.energy_j_per_m2 = table.number("energy_j_per_m2", 0.1, 10000);
  bed.reach_m = table.number("gap_mm", 0.1, 20) * kMilli;
  table.finish();
  return bed;
}

}  // namespace trocar
