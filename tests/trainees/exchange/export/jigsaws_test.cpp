// The layout of JIGSAWS: what stands in its columns, metrics of a movement before and after it went through them.
#include <algorithm>
#include <cmath>

#include "scenarios/scoring/metrics.h"
#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/jigsaws.h"

namespace trocar::jigsaws_test {
namespace {

using test::jigsaws_layout;
using test::sample_motion;

double value_of(const std::vector<Metric>& metrics, const std::string& name) {
  for (const Metric& metric : metrics)
    if (metric.name == name) return metric.value.value_or(NAN);
  return NAN;
}

/// A line with the right slave at p, not turned.
std::string line_at(double x, const std::string& rotation = "1 0 0 0 1 0 0 0 1") {
  std::string line;
  for (int i = 0; i < 57; ++i) line += "0 ";
  return line + std::to_string(x) + " 0 0 " + rotation + " 0 0 0 0 0 0 0\n";
}

TEST(Jigsaws, ReadsWhatStandsInTheColumns) {
  const Trace written = sample_motion(30, 8);
  const Trace back = parse_jigsaws(jigsaws_layout(written), "x.txt", JigsawsSide::kRight);
  EXPECT_EQ(back.rate_hz, 30);
  ASSERT_EQ(back.samples.size(), written.samples.size());
  for (std::size_t k = 0; k < back.samples.size(); ++k) {
    ASSERT_NEAR(back.samples[k].t_s, written.samples[k].t_s, 1e-12);
    ASSERT_LT((back.samples[k].tip_T - written.samples[k].tip_T).norm(), 1e-12);
    ASSERT_LT((back.samples[k].shaft_T - written.samples[k].shaft_T).norm(), 1e-12);
    ASSERT_NEAR(back.samples[k].jaw_opening_m, written.samples[k].jaw_opening_m, 1e-12);
  }
}

TEST(Jigsaws, MetricsAgreeWithinTwoPercent) {
  const auto before = kinematic_metrics(sample_motion(1000, 30));
  const auto after =
      kinematic_metrics(parse_jigsaws(jigsaws_layout(sample_motion(30, 30)), "x.txt", JigsawsSide::kRight));
  for (const char* name :
       {"time_s", "path_m", "path_x_m", "path_y_m", "path_z_m", "depth_path_m", "angular_path_deg", "speed_mean_mps",
        "speed_max_mps", "speed_peaks", "idle_share", "movements", "sparc", "ldlj", "normalised_jerk"}) {
    const double a = value_of(before, name), b = value_of(after, name);
    EXPECT_NEAR(b, a, 0.02 * std::abs(a) + 1e-12) << name;
  }
}

TEST(Jigsaws, AQuickHandKeepsItsSpeed) {
  const auto quick = [](double rate_hz) {  // 3 mm at 4 Hz on top: differences at 30 Hz would lose a tenth of its speed
    Trace trace = sample_motion(rate_hz, 20);
    for (TraceSample& s : trace.samples) s.tip_T.z() += 0.003 * std::sin(2 * M_PI * 4 * s.t_s);
    return trace;
  };
  const auto before = kinematic_metrics(quick(1000));
  const auto after = kinematic_metrics(parse_jigsaws(jigsaws_layout(quick(30)), "x.txt", JigsawsSide::kRight));
  for (const char* name : {"path_m", "speed_mean_mps", "speed_max_mps", "sparc"}) {
    EXPECT_NEAR(value_of(after, name), value_of(before, name), 0.02 * std::abs(value_of(before, name))) << name;
  }
}

TEST(Jigsaws, AMirroredTraceHasTheSameMetrics) {
  const auto one = kinematic_metrics(sample_motion(1000, 10)), other = kinematic_metrics(sample_motion(1000, 10, true));
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(*one[i].value, *other[i].value, 1e-6) << one[i].name;
}

TEST(Jigsaws, KinematicMetricsKnowACircle) {
  Trace circle;  // radius 5 cm, once in 4 s, 20 s
  circle.rate_hz = 30;
  for (int i = 0; i <= 600; ++i) {
    TraceSample s;
    s.t_s = i / 30.0;
    const double angle = 2 * M_PI * s.t_s / 4;
    s.tip_T = Vec3(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0);
    circle.samples.push_back(s);
  }
  const auto metrics = kinematic_metrics(circle);
  EXPECT_NEAR(value_of(metrics, "time_s"), 20, 1e-9);
  EXPECT_NEAR(value_of(metrics, "path_m"), 5 * 2 * M_PI * 0.05, 0.01 * 1.57);
  EXPECT_NEAR(value_of(metrics, "speed_mean_mps"), 2 * M_PI * 0.05 / 4, 0.01 * 0.0785);
  EXPECT_NEAR(value_of(metrics, "angular_path_deg"), 0, 1e-9);
  EXPECT_TRUE(std::isnan(value_of(metrics, "economy"))) << "no ideal path is known";
  EXPECT_TRUE(std::isnan(value_of(metrics, "force_max_n"))) << "no force is known";
  for (const Metric& metric : metrics) EXPECT_NE(find_metric(metric.name), nullptr) << metric.name;
  EXPECT_TRUE(kinematic_metrics({}).empty());
}

TEST(Jigsaws, ReadsEitherSide) {
  std::string left;
  for (int i = 0; i < 38; ++i) left += "0 ";
  left += "0.1 0.2 0.3 1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 -0.5 ";
  for (int i = 0; i < 19; ++i) left += "0 ";
  const Trace trace = parse_jigsaws(left + "\n" + left + "\r\n\n", "x.txt", JigsawsSide::kLeft);
  ASSERT_EQ(trace.samples.size(), 2u);
  EXPECT_EQ(trace.samples[1].tip_T, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(trace.samples[1].shaft_T, Vec3(0, 0, 1));
  EXPECT_LT(trace.samples[1].jaw_opening_m, 0) << "the da Vinci's jaws press past closed";
  EXPECT_NE(message_of<InputError>([&] {
              parse_jigsaws(left + "\n" + left, "x.txt", JigsawsSide::kRight);
            }).find("slave right"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] {
              parse_jigsaws(line_at(0) + line_at(1), "x.txt", JigsawsSide::kLeft);
            }).find("slave left"),
            std::string::npos);
}

TEST(Jigsaws, TakesTabsAndCommasToo) {
  std::string text = line_at(0.5) + line_at(0.6);
  const Trace spaces = parse_jigsaws(text, "x.txt", JigsawsSide::kRight);
  for (const char separator : {'\t', ','}) {
    std::string other = text;
    std::replace(other.begin(), other.end(), ' ', separator);
    const Trace trace = parse_jigsaws(other, "x.txt", JigsawsSide::kRight);
    ASSERT_EQ(trace.samples.size(), 2u);
    EXPECT_EQ(trace.samples[1].tip_T, spaces.samples[1].tip_T);
  }
}

TEST(Jigsaws, AFewSamplesAreMeasuredAsTheyAre) {
  const Trace two = parse_jigsaws(line_at(0) + line_at(0.03), "x.txt", JigsawsSide::kRight);
  EXPECT_NEAR(value_of(kinematic_metrics(two), "path_m"), 0.03, 0.01) << "the filter has little to go on";
  const Trace five =
      parse_jigsaws(line_at(0) + line_at(1) + line_at(2) + line_at(3) + line_at(4), "x.txt", JigsawsSide::kRight);
  EXPECT_NEAR(value_of(kinematic_metrics(five), "path_m"), 4, 0.3) << "a straight way stays straight";
}

TEST(Jigsaws, RefusesWhatIsNotTheLayout) {
  const auto message = [](const std::string& text) {
    return message_of<InputError>([&] { parse_jigsaws(text, "x.txt", JigsawsSide::kRight); });
  };
  EXPECT_NE(message(line_at(0) + "1 2 3\n").find("x.txt:2:1: has 3 numbers, not 76"), std::string::npos);
  EXPECT_NE(message("1 2 three\n").find("x.txt:1:5: is no finite number"), std::string::npos);
  EXPECT_NE(message("1 nan\n").find("is no finite number"), std::string::npos);
  EXPECT_NE(message("1 2x\n").find("is no finite number"), std::string::npos);
  EXPECT_NE(message("1e999\n").find("is no finite number"), std::string::npos);
  EXPECT_NE(message(line_at(0, "1 0 0 0 1 0 0 0 2") + line_at(1)).find("no rotation matrix"), std::string::npos);
  EXPECT_NE(message(line_at(0, "1 0 0 0 1 0 0 0 -1") + line_at(1)).find("no rotation matrix"), std::string::npos)
      << "a mirror";
  EXPECT_NE(message(line_at(0)).find("fewer than two lines"), std::string::npos);
  EXPECT_NE(message("").find("fewer than two lines"), std::string::npos);
  EXPECT_EQ(message(line_at(0) + line_at(1)), "");
}

}  // namespace
}  // namespace trocar::jigsaws_test
