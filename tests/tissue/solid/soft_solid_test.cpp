// The soft solid as mechanics: force and energy, moduli, beams, relaxation, rest. Its size and accuracy under a tool
// stand in soft_solid_load_test.cpp.
#include "tissue/solid/soft_solid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>

#include "tests/tissue/solid/soft_blocks.h"
#include "tissue/solid/cube_element.h"

namespace trocar::soft_solid_test {
namespace {

using test::elastic;
using test::moved;
using test::SoftBlock;
using test::solid_of;
using test::tight;

constexpr double kEdge = 0.01, kYoung = 5000;
constexpr double kFloat = 1e-5;  // of the size: positions are floats, 6e-8 of it, strains their differences

std::vector<Vec3f> mapped(const SoftSolid& solid, const Mat3& A, const Vec3& shift = Vec3::Zero()) {
  std::vector<Vec3f> out;
  for (const Vec3f& x : solid.rest()) out.push_back((A * x.cast<double>() + shift).cast<float>());
  return out;
}

double largest(const std::vector<Vec3f>& force) {
  double most = 0;
  for (const Vec3f& f : force) most = std::max(most, static_cast<double>(f.norm()));
  return most;
}

/// The map that fits all nodes best, and how far the worst node is from it.
struct Fit {
  Mat3 A;
  double worst_m;
};
Fit affine_fit(const SoftSolid& solid) {
  const auto count = Eigen::Index(solid.node_count());
  Eigen::MatrixXd from(count, 4), to(count, 3);
  for (Eigen::Index n = 0; n < count; ++n) {
    from.row(n) << solid.rest()[std::size_t(n)].cast<double>().transpose(), 1;
    to.row(n) = solid.position()[std::size_t(n)].cast<double>().transpose();
  }
  const Eigen::MatrixXd map = from.colPivHouseholderQr().solve(to);
  return {map.topRows<3>().transpose(), (from * map - to).rowwise().norm().maxCoeff()};
}

/// A block under a uniform stress on all of its faces, free in space.
Fit under_stress(const SoftBlock& block, const TissueSolid& material, const Mat3& stress_pa) {
  SoftSolid solid = solid_of(block, material, tight(block.edge_m));
  const double sizes[3] = {block.nx * block.edge_m, block.ny * block.edge_m, block.nz * block.edge_m};
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      for (const std::int32_t node : block.face(axis, upper))
        solid.load(node, (upper ? 1 : -1) * block.face_share(node, axis) * sizes[(axis + 1) % 3] *
                             sizes[(axis + 2) % 3] * stress_pa.col(axis));
  // Six springs, so that it cannot drift; in equilibrium they are without force.
  std::vector<SoftSpring> pins;
  const auto pin = [&](std::int32_t node, std::initializer_list<int> axes) {
    for (const int axis : axes) pins.push_back({{{node}, {1.0F}}, Vec3::Unit(axis), 100});
  };
  pin(block.id(0, 0, 0), {0, 1, 2});
  pin(block.id(block.nx, 0, 0), {1, 2});
  pin(block.id(0, block.ny, 0), {2});
  for (int round = 0; round < 5; ++round) {
    for (SoftSpring& s : pins) s.stretch_m = s.direction.dot(moved(solid, s.place.node[0]));
    solid.settle(pins, 1e-9, 1);
  }
  return affine_fit(solid);
}

TEST(SoftSolid, AUniformStressGivesAUniformStrainWithTheMaterialsModuli) {
  const SoftBlock block(3, 4, 5, kEdge);
  for (const double nu : {0.3, 0.45, 0.49}) {
    const double G = kYoung / (2 * (1 + nu)), strain = 5e-4, swell = 0.002;
    Mat3 uniaxial = Mat3::Zero(), shear = Mat3::Zero();
    uniaxial(2, 2) = kYoung * strain;
    shear(0, 1) = shear(1, 0) = G * strain;
    const Mat3 tension = kYoung * swell * Mat3::Identity();  // constant forces that press turn a free block over
    const auto symmetric = [](const Fit& fit) { return Mat3(0.5 * (fit.A.transpose() * fit.A - Mat3::Identity())); };
    const Fit pulled = under_stress(block, elastic(kYoung, nu), uniaxial);
    EXPECT_LT(pulled.worst_m, kFloat * 5 * kEdge) << "patch test";
    // Half of C - 1 is the strain but for its square, as the law is linear but for it.
    EXPECT_NEAR(symmetric(pulled)(2, 2), strain, 1e-3 * strain) << "E at nu " << nu;
    EXPECT_NEAR(-symmetric(pulled)(0, 0) / symmetric(pulled)(2, 2), nu, 1e-3);
    EXPECT_NEAR(-symmetric(pulled)(1, 1) / symmetric(pulled)(2, 2), nu, 1e-3);
    const Fit swollen = under_stress(block, elastic(kYoung, nu), tension);
    EXPECT_LT(swollen.worst_m, kFloat * 5 * kEdge);
    // At nu .49 the strain is 4e-5: floats of 5 cm leave 1e-3 of it, averaged over the nodes, and its square as much.
    EXPECT_NEAR(symmetric(swollen).trace(), 3 * swell * (1 - 2 * nu), 3e-3 * 3 * swell * (1 - 2 * nu)) << nu;
    const Fit sheared = under_stress(block, elastic(kYoung, nu), shear);
    EXPECT_LT(sheared.worst_m, kFloat * 5 * kEdge);
    EXPECT_NEAR(2 * symmetric(sheared)(0, 1), strain, 1e-3 * strain) << "G at nu " << nu;
  }
}

TEST(SoftSolid, NothingPushesOnAnInnerNodeOfAUniformlyStretchedBlock) {
  const SoftBlock block(4, 4, 4, kEdge);
  SoftSolid solid = solid_of(block, elastic(kYoung, 0.45), tight(kEdge));
  Mat3 A;
  A << 1.1, 0.03, -0.05, 0.03, 0.93, 0.02, -0.05, 0.02, 1.04;
  solid.place(mapped(solid, A));
  const std::vector<Vec3f> force = solid.elastic_force();
  const double outer = largest(force);
  for (int k = 1; k < 4; ++k)
    for (int j = 1; j < 4; ++j)
      for (int i = 1; i < 4; ++i)
        EXPECT_LT(force[std::size_t(block.id(i, j, k))].norm(), kFloat * outer) << i << " " << j << " " << k;
}

TEST(SoftSolid, RigidMotionsGiveNoForceEvenUpsideDown) {
  const SoftBlock block(3, 3, 3, kEdge);
  SoftSolid solid = solid_of(block, elastic(kYoung, 0.45), tight(kEdge));
  solid.place(test::scrambled(solid.rest(), 0.1 * kEdge, 1));
  const double scale = largest(solid.elastic_force());  // of a tenth of a cell
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  // Steps as large as fast handling makes them: 20 deg in 10 ms.
  for (int deg = 0; deg <= 180; deg += 20) {
    const Mat3 R = Eigen::AngleAxisd(deg * std::numbers::pi / 180, axis).toRotationMatrix();
    solid.place(mapped(solid, R, Vec3(0.01, 0.02, -0.01)));
    // Floats of 4 cm are off by 2e-9 m, 2e-6 of that tenth of a cell.
    EXPECT_LT(largest(solid.elastic_force()), 4e-6 * scale) << deg << " deg";
  }
}

TEST(SoftSolid, ATurnedBlockAnswersAsTheBlockThatWasNotTurned) {
  const SoftBlock block(3, 2, 2, kEdge);
  SoftSolid solid = solid_of(block, elastic(kYoung, 0.45), tight(kEdge));
  const std::vector<Vec3f> bent = test::scrambled(solid.rest(), 0.15 * kEdge, 2);
  solid.place(bent);
  solid.place(bent);
  const std::vector<Vec3f> wanted = solid.elastic_force();
  Mat3 R;
  for (int deg = 0; deg <= 180; deg += 20) {
    R = Eigen::AngleAxisd(deg * std::numbers::pi / 180, Vec3(3, 1, 2).normalized()).toRotationMatrix();
    std::vector<Vec3f> turned;
    for (const Vec3f& x : bent) turned.push_back(R.cast<float>() * x);
    solid.place(turned);
  }
  for (int round = 0; round < 3; ++round)
    solid.place(std::vector<Vec3f>(solid.position().begin(), solid.position().end()));
  const std::vector<Vec3f> force = solid.elastic_force();
  for (std::size_t n = 0; n < solid.node_count(); ++n)
    EXPECT_LT((force[n] - R.cast<float>() * wanted[n]).norm(), 2e-5 * largest(wanted)) << n;
}

/// The law of one cell in double: polar rotation by SVD, shape by the element's matrix over the corners, volume by the
/// determinant.
struct CellLaw {
  double energy_j;
  Eigen::Matrix<double, 24, 1> force_n;
};
CellLaw cell_law(const std::vector<Vec3f>& x, double young, double nu) {
  Eigen::Matrix<double, 24, 1> at, rest, u;
  Mat3 F = Mat3::Zero();
  const auto sign = [](int a) { return Vec3(walsh(1, a), walsh(2, a), walsh(4, a)); };
  for (int a = 0; a < 8; ++a) {
    at.segment<3>(3 * a) = x[std::size_t(a)].cast<double>();
    rest.segment<3>(3 * a) = 0.5 * kEdge * sign(a);
    F += at.segment<3>(3 * a) * sign(a).transpose() / (4 * kEdge);
  }
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat3 R = svd.matrixU() * svd.matrixV().transpose();
  const auto K = cube_matrix(kEdge, young / (2 * (1 + nu)), 0);
  const double bulk = young / (3 * (1 - 2 * nu)), volume = kEdge * kEdge * kEdge, swollen = F.determinant() - 1;
  for (int a = 0; a < 8; ++a) u.segment<3>(3 * a) = R.transpose() * at.segment<3>(3 * a) - rest.segment<3>(3 * a);
  Eigen::Matrix<double, 24, 1> force = -K * u;
  const double energy = -0.5 * u.dot(force) + 0.5 * bulk * volume * swollen * swollen;
  const Mat3 cofactors = F.determinant() * F.inverse().transpose();
  for (int a = 0; a < 8; ++a)
    force.segment<3>(3 * a) =
        (R * force.segment<3>(3 * a) - bulk * volume * swollen * cofactors * sign(a) / (4 * kEdge)).eval();
  return {energy, force};
}

TEST(SoftSolid, EnergyAndForceOfACellAreThoseOfTheLaw) {
  const SoftBlock block(1, 1, 1, kEdge);
  SoftSolid solid = solid_of(block, elastic(kYoung, 0.45), tight(kEdge));
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<Vec3f> x = test::scrambled(solid.rest(), 0.2 * kEdge, seed);
    for (int round = 0; round < 8; ++round) solid.place(x);  // until the rotation follows no more
    const CellLaw wanted = cell_law(x, kYoung, 0.45);
    EXPECT_NEAR(solid.energy_j(), wanted.energy_j, 2e-5 * wanted.energy_j) << seed;
    for (int a = 0; a < 8; ++a)
      EXPECT_LT((solid.elastic_force()[std::size_t(a)].cast<double>() - wanted.force_n.segment<3>(3 * a)).norm(),
                2e-5 * wanted.force_n.norm());
  }
}

TEST(SoftSolid, ForceIsTheSlopeOfTheEnergyUpToTheStrain) {
  // The law leaves out how a cell's rotation changes with its corners; that part is the strain's share of the force, as
  // in every corotational law, so the error shrinks with the strain.
  const SoftBlock block(3, 2, 2, kEdge);
  for (const double size : {0.1, 0.02}) {
    SoftSolid solid = solid_of(block, elastic(kYoung, 0.45), tight(kEdge));
    for (unsigned seed = 0; seed < 10; ++seed) {
      const std::vector<Vec3f> x = test::scrambled(solid.rest(), size * kEdge, seed);
      const std::vector<Vec3f> way =
          test::scrambled(std::vector<Vec3f>(x.size(), Vec3f::Zero()), 0.1 * size * kEdge, seed + 100);
      const auto energy = [&](float share) {
        std::vector<Vec3f> there = x;
        for (std::size_t n = 0; n < there.size(); ++n) there[n] += share * way[n];
        for (int round = 0; round < 6; ++round) solid.place(there);
        return solid.energy_j();
      };
      const double slope = (energy(1) - energy(-1)) / 2;
      energy(0);
      double work = 0, scale = 0;
      const std::vector<Vec3f> force = solid.elastic_force();
      for (std::size_t n = 0; n < solid.node_count(); ++n) {
        work -= static_cast<double>(force[n].dot(way[n]));
        scale += static_cast<double>(force[n].norm() * way[n].norm());
      }
      EXPECT_NEAR(slope, work, size * scale) << "strain " << size << ", state " << seed;
    }
  }
}

TEST(SoftSolid, CantileverBendsAsTimoshenkosBeam) {
  // Cells as wide as a fourth or sixth of the beam: 4 and 3 % are what B-bar cubes reach (tissue.md 2.2).
  for (const int across : {4, 6})
    for (const double nu : {0.3, 0.45, 0.49}) {
      const double width = 0.04, length = 10 * width, force = 5e-4, young = 1e5;
      const SoftBlock block(10 * across, across, across, width / across);
      SoftSolidOptions options = tight(block.edge_m);
      options.tolerance = 1e-5;
      SoftSolid solid = solid_of(block, elastic(young, nu), options);
      for (const std::int32_t node : block.face(0, false)) solid.hold(node, 1e6);
      const auto end = block.face(0, true);
      for (const std::int32_t node : end) solid.load(node, {0, 0, -force * block.face_share(node, 0)});
      solid.settle({}, 1e-7, 20);
      double tip = 0;
      for (const std::int32_t node : end) tip -= moved(solid, node).z() * block.face_share(node, 0);
      const double inertia = std::pow(width, 4) / 12, shear = young / (2 * (1 + nu));
      const double wanted =
          force * std::pow(length, 3) / (3 * young * inertia) + force * length / (5.0 / 6 * shear * width * width);
      EXPECT_NEAR(tip / wanted, 1, across == 4 ? 0.04 : 0.03) << "nu " << nu << ", " << across << " cells";
      RecordProperty("tip_" + std::to_string(across) + "_nu" + std::to_string(int(100 * nu)),
                     std::to_string(tip / wanted));
    }
}

/// A small block between two plates, the upper one driven: the force on it. Next to no mass, so that only the
/// material answers.
class Press {
 public:
  Press(const TissueSolid& material, const Vec3& way, double step_s, int cells = 2)
      : block_(cells, cells, cells, kEdge), way_(way), solid_(make(material, step_s)) {
    for (const std::int32_t node : block_.face(2, false)) solid_.hold(node, kClamp);
    for (const std::int32_t node : block_.face(2, true))
      for (int c = 0; c < 3; ++c) springs_.push_back({{{node}, {1.0F}}, Vec3::Unit(c), kClamp});
  }
  void drive(double share) {
    for (SoftSpring& s : springs_) s.stretch_m = s.direction.dot(moved(solid_, s.place.node[0]) - share * way_);
  }
  /// One step with the plate at that share of its way. @return the force along the way, N
  double step(double share) {
    drive(share);
    solid_.step(springs_);
    return force();
  }
  double still(double share) {
    for (int i = 0; i < 8; ++i) {
      drive(share);
      solid_.settle(springs_, 1e-8, 1);
    }
    return force();
  }
  SoftSolid& solid() { return solid_; }
  const SoftBlock& block() const { return block_; }

 private:
  static constexpr double kClamp = 3e3;  // N/m a node: a thousand times a node's own

  SoftSolid make(TissueSolid material, double step_s) {
    material.density_kg_m3 = 1e-2;
    SoftSolidOptions options = tight(kEdge);
    options.step_s = step_s;
    return solid_of(block_, material, options);
  }
  double force() const {
    double sum = 0;
    for (const SoftSpring& s : springs_) sum -= s.force_n * s.direction.dot(way_.normalized());
    return sum;
  }

  SoftBlock block_;
  Vec3 way_;
  SoftSolid solid_;
  std::vector<SoftSpring> springs_;
};

TissueSolid relaxing() {
  TissueSolid material = elastic(kYoung, 0.45);
  material.prony = {PronyBranch{0.35, 0.1}, PronyBranch{0.25, 5}};
  return material;
}

TEST(SoftSolid, StressRelaxesAsTheSeriesSays) {
  const TissueSolid material = relaxing();
  for (const Vec3& way : {Vec3(0, 0, -1e-4), Vec3(1e-4, 0, 0)}) {
    const double still = Press(elastic(kYoung, 0.45), way, 0.01).still(1);
    Press press(material, way, 0.01);
    const double left = 1 - material.prony[0].share - material.prony[1].share;
    for (int n = 1; n <= 2000; ++n) {
      const double force = press.step(1), t = 0.01 * n;
      double wanted = 1;
      for (const PronyBranch& b : material.prony) wanted += b.share / left * std::exp(-t / b.tau_s);
      ASSERT_NEAR(force / still, wanted, 0.02 * wanted) << t << " s";
    }
  }
}

TEST(SoftSolid, AtAFrequencyTheModulusIsThatOfTheSeries) {
  using Complex = std::complex<double>;
  const TissueSolid material = relaxing();
  const double left = 1 - material.prony[0].share - material.prony[1].share;
  const Vec3 way(1e-4, 0, 0);
  const double still = Press(elastic(kYoung, 0.45), way, 0.01).still(1);
  for (const double hz : {0.1, 1.0, 10.0}) {
    const double omega = 2 * std::numbers::pi * hz;
    Complex wanted = 1;
    for (const PronyBranch& b : material.prony)
      wanted += b.share / left * Complex(0, omega * b.tau_s) / Complex(1, omega * b.tau_s);
    Press press(material, way, 0.01);
    const int period = int(std::lround(100 / hz)), settle = int(std::lround(2500.0 / period)) * period;
    Complex sum = 0;
    const int sampled = std::max(period, 200 / period * period);
    for (int n = 1; n <= settle + sampled; ++n) {
      const double force = press.step(std::sin(omega * 0.01 * n));
      if (n > settle) sum += force * std::exp(Complex(0, -omega * 0.01 * n));
    }
    const Complex modulus = sum * Complex(0, 2) / double(sampled) / still;
    EXPECT_NEAR(std::abs(modulus) / std::abs(wanted), 1, 0.03) << hz << " Hz";
    EXPECT_NEAR(std::arg(modulus / wanted) * 180 / std::numbers::pi, 0, 2) << hz << " Hz";
  }
}

TEST(SoftSolid, NoCycleGivesEnergy) {
  TissueSolid material = relaxing();
  for (const double stiffening : {0.0, 3.0}) {
    material.stiffening = stiffening;
    for (const double hz : {0.2, 1.0, 5.0}) {
      const Vec3 way(2e-3, 0, -1.5e-3);
      Press press(material, way, 0.01);
      const int period = int(std::lround(100 / hz));
      double last = 0;
      for (int cycle = 0; cycle < 6; ++cycle) {
        double work = 0, most = 0;
        for (int n = 1; n <= period; ++n) {
          const double before = std::sin(2 * std::numbers::pi * (n - 1) / period);
          const double now = std::sin(2 * std::numbers::pi * n / period);
          const double force = press.step(now);
          work += 0.5 * (force + last) * (now - before) * way.norm();
          most = std::max(most, std::abs(force) * way.norm());
          last = force;
        }
        // Rounding of the forces over a closed path.
        EXPECT_GT(work, -1e-5 * most) << hz << " Hz, cycle " << cycle << ", stiffening " << stiffening;
      }
    }
  }
}

TEST(SoftSolid, NearlyIncompressibleTissueKeepsItsVolumeWhenSqueezed) {
  // Between two slippery plates, 30 % shorter.
  const SoftBlock block(4, 4, 4, kEdge);
  SoftSolid solid = solid_of(block, elastic(kYoung, 0.49), tight(kEdge));
  std::vector<SoftSpring> springs;
  for (const bool upper : {false, true})
    for (const std::int32_t node : block.face(2, upper)) springs.push_back({{{node}, {1.0F}}, Vec3::UnitZ(), 3e3});
  // So that it does not drift or spin between them; without force.
  springs.push_back({{{block.id(2, 2, 0)}, {1.0F}}, Vec3::UnitX(), 100});
  springs.push_back({{{block.id(2, 2, 0)}, {1.0F}}, Vec3::UnitY(), 100});
  springs.push_back({{{block.id(4, 2, 0)}, {1.0F}}, Vec3::UnitY(), 100});
  const double before = solid.volume_m3();
  for (int i = 0; i < 40; ++i) {
    for (SoftSpring& s : springs) {
      const bool upper = block.nodes[std::size_t(s.place.node[0])].z() > kEdge;
      s.stretch_m =
          s.direction.dot(moved(solid, s.place.node[0])) + (upper ? 0.3 * 4 * kEdge * std::min(1.0, i / 30.0) : 0);
    }
    solid.settle(springs, 1e-8, 1);
  }
  EXPECT_NEAR(solid.volume_m3() / before, 1, 0.02);
  RecordProperty("volume", std::to_string(solid.volume_m3() / before));
}

TEST(SoftSolid, TheClampedNeighbourhoodIsNeverSofterThanTheTruth) {
  const SoftBlock block(4, 4, 3, kEdge);
  std::mt19937 random(5);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  std::vector<SoftCell> cells = block.cells;
  for (SoftCell& cell : cells) cell.fill = 0.15 + 0.85 * uniform();
  TissueSolid material = relaxing();
  SoftSolid solid(block.nodes, cells, std::span(&material, 1), tight(kEdge));
  const auto count = Eigen::Index(3 * block.nodes.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count, count);
  const double h = 0.01, left = 1 - material.prony[0].share - material.prony[1].share;
  double algorithmic = 1;
  for (const PronyBranch& b : material.prony) algorithmic += b.share / left * b.tau_s / (b.tau_s + h);
  const auto K = cube_matrix(kEdge, kYoung / 2.9, kYoung / 0.3);  // nu .45
  for (const SoftCell& cell : cells)
    for (int a = 0; a < 8; ++a) {
      const Eigen::Index row = 3 * cell.node[std::size_t(a)];
      for (int b = 0; b < 8; ++b)
        A.block<3, 3>(row, 3 * cell.node[std::size_t(b)]) += cell.fill * algorithmic * K.block<3, 3>(3 * a, 3 * b);
      A.block<3, 3>(row, row) +=
          (1 + h * 1) / (h * h) * material.density_kg_m3 * cell.fill * 1e-6 / 8 * Mat3::Identity();
    }
  for (const std::int32_t node : block.face(2, false)) {
    solid.hold(node, 20);
    A.block<3, 3>(3 * node, 3 * node) += 20 * Mat3::Identity();
  }
  solid.place(std::vector<Vec3f>(solid.rest().begin(), solid.rest().end()));  // takes up the supports
  const Eigen::LLT<Eigen::MatrixXd> exact(A);
  for (int trial = 0; trial < 30; ++trial) {
    const SoftCell& cell = cells[random() % cells.size()];
    NodeShares place;
    Vec3 x(uniform(), uniform(), uniform()), direction(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
    direction.normalize();
    Eigen::VectorXd J = Eigen::VectorXd::Zero(count);
    for (int a = 0; a < 8; ++a) {
      double share = 1;
      for (int c = 0; c < 3; ++c) share *= (a >> c & 1) != 0 ? x[c] : 1 - x[c];
      place.node.push_back(cell.node[std::size_t(a)]);
      place.share.push_back(float(share));
      J.segment<3>(3 * cell.node[std::size_t(a)]) += share * direction;
    }
    const double truth = J.dot(exact.solve(J));
    double last = 0;
    for (const double radius : {0.012, 0.02, 0.03, 0.1}) {
      const double clamped = solid.compliance(place, direction, radius, true);
      // The iteration stops short by 0.1 %, on the stiff side.
      EXPECT_LT(clamped, truth * (1 + 1e-4)) << radius;
      EXPECT_GT(clamped, last * (1 - 1e-3)) << "more room, softer";
      last = clamped;
    }
    EXPECT_NEAR(last, truth, 2e-3 * truth) << "with nothing clamped it is the truth";
  }
}

}  // namespace
}  // namespace trocar::soft_solid_test
