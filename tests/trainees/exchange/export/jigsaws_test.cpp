// The layout of JIGSAWS: columns against analytic movements, the way there and back, metrics before and after.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "scenarios/scoring/metrics.h"
#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/jigsaws.h"

namespace trocar::jigsaws_test {
namespace {

using test::sample_motion;

std::vector<std::vector<double>> rows_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (double value = 0; fields >> value;) rows.back().push_back(value);
  }
  return rows;
}

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

TEST(Jigsaws, HasSeventySixColumnsAtThirtyHertz) {
  const auto rows = rows_of(jigsaws_text(sample_motion(1000, 10)));
  ASSERT_EQ(rows.size(), 301u);
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 76u);
    for (int i = 0; i < 19; ++i) {
      ASSERT_EQ(row[static_cast<std::size_t>(i)], 0) << "master left";
      ASSERT_EQ(row[static_cast<std::size_t>(38 + i)], 0) << "slave left";
      ASSERT_EQ(row[static_cast<std::size_t>(19 + i)], row[static_cast<std::size_t>(57 + i)])
          << "master right as slave right";
    }
  }
}

TEST(Jigsaws, PositionsAreThoseOfTheMoment) {
  const Trace trace = sample_motion(1000, 5);
  const auto rows = rows_of(jigsaws_text(trace));
  for (std::size_t k = 0; k < rows.size(); k += 3) {  // every 3rd of 30 Hz is a sample of 1 kHz
    const TraceSample& s = trace.samples[k / 3 * 100];
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(rows[k][static_cast<std::size_t>(57 + i)], s.tip_T[i], 1e-12) << k;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(rows[k][static_cast<std::size_t>(60 + 3 * i + 2)], s.shaft_T[i], 1e-9) << "third column, by rows";
  }
}

TEST(Jigsaws, VelocitiesAreThoseOfAnAnalyticMotion) {
  Trace turning;  // 0.2 m/s along x; the shaft turns about x at 0.5 rad/s
  for (int i = 0; i <= 2000; ++i) {
    TraceSample s;
    s.t_s = i / 1000.0;
    s.tip_T = Vec3(0.2 * s.t_s, 0, 0);
    s.shaft_T = Vec3(0, -std::sin(0.5 * s.t_s), std::cos(0.5 * s.t_s));
    turning.samples.push_back(s);
  }
  for (const auto& row : rows_of(jigsaws_text(turning))) {
    EXPECT_NEAR(row[57 + 12], 0.2, 1e-9);
    EXPECT_NEAR(row[57 + 13], 0, 1e-12);
    EXPECT_NEAR(row[57 + 15], 0.5, 1e-6);
    EXPECT_NEAR(row[57 + 16], 0, 1e-6);
    EXPECT_NEAR(row[57 + 17], 0, 1e-6);
  }
}

TEST(Jigsaws, RotationsAreRotationsWithoutRoll) {
  Mat3 before = Mat3::Identity();
  bool first = true;
  for (const auto& row : rows_of(jigsaws_text(sample_motion(1000, 20)))) {
    Mat3 R;
    for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = row[static_cast<std::size_t>(60 + i)];
    ASSERT_LT((R * R.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-12);
    ASSERT_NEAR(R.determinant(), 1, 1e-12);
    const Eigen::AngleAxisd turn(R * before.transpose());
    if (!first && turn.angle() > 1e-6) {
      ASSERT_LT(std::abs(turn.axis().dot((R.col(2) + before.col(2)).normalized())), 1e-6);
    }
    before = R;
    first = false;
  }
}

TEST(Jigsaws, GripperAngleOpensTheJaws) {
  Trace trace = sample_motion(1000, 1);
  for (TraceSample& s : trace.samples) s.jaw_opening_m = 0.020;  // as wide as the jaws are long: 60 degrees
  for (const auto& row : rows_of(jigsaws_text(trace))) EXPECT_NEAR(row[75], M_PI / 3, 1e-12);
  for (TraceSample& s : trace.samples) s.jaw_opening_m = 0.5;
  EXPECT_NEAR(rows_of(jigsaws_text(trace))[0][75], M_PI, 1e-12) << "no further than open";
}

TEST(Jigsaws, ThereAndBackAgreesWithinTheSampling) {
  for (const double rate : {100.0, 1000.0, 4000.0}) {
    const Trace trace = sample_motion(rate, 8);
    const Trace back = parse_jigsaws(jigsaws_text(trace), "x.txt", JigsawsSide::kRight);
    EXPECT_EQ(back.rate_hz, 30);
    ASSERT_EQ(back.samples.size(), 241u);
    const Trace exact = sample_motion(30, 8);
    for (std::size_t k = 0; k < back.samples.size(); ++k) {
      ASSERT_NEAR(back.samples[k].t_s, exact.samples[k].t_s, 1e-12);
      // linear between samples: an error of at most a (2 pi f)^2 / (8 rate^2)
      const double bound = 0.004 * std::pow(2 * M_PI * 1.7, 2) / (8 * rate * rate) * 2 + 1e-12;
      ASSERT_LT((back.samples[k].tip_T - exact.samples[k].tip_T).norm(), bound) << rate << " Hz, line " << k;
      ASSERT_LT((back.samples[k].shaft_T - exact.samples[k].shaft_T).norm(), 1e-4);
      ASSERT_NEAR(back.samples[k].jaw_opening_m, exact.samples[k].jaw_opening_m, 1e-5);
    }
    const Trace twice = parse_jigsaws(jigsaws_text(back), "x.txt", JigsawsSide::kRight);
    for (std::size_t k = 0; k < back.samples.size(); ++k) {
      ASSERT_LT((twice.samples[k].tip_T - back.samples[k].tip_T).norm(), 1e-12) << "a fixed point";
      ASSERT_LT((twice.samples[k].shaft_T - back.samples[k].shaft_T).norm(), 1e-9);
    }
  }
}

TEST(Jigsaws, MetricsAgreeWithinTwoPercent) {
  const Trace trace = sample_motion(1000, 30);
  const auto before = kinematic_metrics(trace);
  const auto after = kinematic_metrics(parse_jigsaws(jigsaws_text(trace), "x.txt", JigsawsSide::kRight));
  for (const char* name :
       {"time_s", "path_m", "path_x_m", "path_y_m", "path_z_m", "depth_path_m", "angular_path_deg", "speed_mean_mps",
        "speed_max_mps", "speed_peaks", "idle_share", "movements", "sparc", "ldlj", "normalised_jerk"}) {
    const double a = value_of(before, name), b = value_of(after, name);
    EXPECT_NEAR(b, a, 0.02 * std::abs(a) + 1e-12) << name;
  }
}

TEST(Jigsaws, AQuickHandKeepsItsSpeed) {
  Trace trace =
      sample_motion(1000, 20);  // 3 mm at 4 Hz on top: differences at 30 Hz alone would lose a tenth of its speed
  for (TraceSample& s : trace.samples) s.tip_T.z() += 0.003 * std::sin(2 * M_PI * 4 * s.t_s);
  const auto before = kinematic_metrics(trace);
  const auto after = kinematic_metrics(parse_jigsaws(jigsaws_text(trace), "x.txt", JigsawsSide::kRight));
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

TEST(Jigsaws, BeginsWhereTheTraceBegins) {
  Trace trace = sample_motion(1000, 2);
  for (TraceSample& s : trace.samples) s.t_s += 17.25;
  EXPECT_EQ(rows_of(jigsaws_text(trace)).size(), 61u);
  const Trace back = parse_jigsaws(jigsaws_text(trace), "x.txt", JigsawsSide::kRight);
  EXPECT_EQ(back.samples.front().t_s, 0);
  EXPECT_LT((back.samples.front().tip_T - trace.samples.front().tip_T).norm(), 1e-12);
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

TEST(Jigsaws, RefusesTracesThatAreNone) {
  Trace trace = sample_motion(1000, 1);
  const auto message = [](const Trace& t) { return message_of<InputError>([&] { jigsaws_text(t); }); };
  Trace bad = trace;
  bad.samples[500].tip_T.y() = NAN;
  EXPECT_NE(message(bad).find("not finite at 0.5"), std::string::npos);
  bad = trace;
  bad.samples[500].shaft_T = Vec3::Zero();
  EXPECT_FALSE(message(bad).empty());
  bad = trace;
  bad.samples[500].t_s = bad.samples[499].t_s;
  EXPECT_NE(message(bad).find("do not increase"), std::string::npos);
  trace.samples.resize(1);
  EXPECT_FALSE(message(trace).empty());
}

TEST(Jigsaws, TheMetaLineIsSkillSumAndItems) {
  EXPECT_EQ(jigsaws_meta_line({"Suturing_B001", 'N', std::array<int, 6>{1, 2, 3, 4, 5, 1}}),
            "Suturing_B001\tN\t16\t1\t2\t3\t4\t5\t1\n");
  EXPECT_EQ(jigsaws_meta_line({"touch_1", 'X', {}}), "touch_1\tX\t0\t0\t0\t0\t0\t0\t0\n");
}

}  // namespace
}  // namespace trocar::jigsaws_test
