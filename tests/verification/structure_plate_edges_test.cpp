// Edges of the plate against theory: omega = lambda sqrt(D / (rho h)) / a^2, a = 406 mm, h = 3.4 mm.
//   pinned  2 pi^2 = 19.739, Navier's closed form; shear and rotary inertia lower it by (pi h / a)^2 / 12 (1 + 2.4 / (1
//   -
//           nu)) = 0.03 % (Mindlin), cubic elements converge from above: 0.5 % at 6 x 6 asked
//   free    six rigid motions, then 13.47 (Leissa, Vibration of Plates, NASA SP-160, table 4.65: 13.489 from above;
//   later
//           13.468); 1 % at 3 x 3
//   bolted  a frame lets the metal between its faces give way: softer than a clamp at its opening, but by no more than
//   a
//           clamp two plate thicknesses farther out would be
#include <Eigen/Eigenvalues>

#include "tests/unit/structure_plate_case.hpp"
#include "tests/verification/structure_frequency.hpp"

namespace standoff::structure {
namespace {

using testing::first_frequency;
using testing::frequency_factor;

CaseSpec with_edges(const char* edges, int elements, bool quarter, double size = 0.406) {
  CaseSpec spec = testing::plate_case(elements, quarter);
  spec.plate.edges = edges, spec.plate.size.x = spec.plate.size.y = size;
  return spec;
}

TEST(PlateEdges_Pinned, FirstFrequency_IsNaviersClosedForm) {
  const CaseSpec spec = with_edges("pinned", 6, true);
  PlateHex64 model(spec, 1);
  EXPECT_NEAR(frequency_factor(first_frequency(model), spec.plate), 2.0 * M_PI * M_PI, 0.005 * 2.0 * M_PI * M_PI);
}

TEST(PlateEdges_Free, WholePlate_HasSixRigidMotionsAndLeissasFirstFrequency) {
  const CaseSpec spec = with_edges("free", 3, false);
  PlateHex64 model(spec, 1);
  RelaxationProblem& plate = *model.relaxation();
  const auto n = plate.dofs();
  const Eigen::SparseMatrix<double> k = plate.stiffness(std::vector<double>(static_cast<std::size_t>(n), 0.0));
  const Eigen::Map<const Eigen::VectorXd> mass(plate.mass().data(), n);
  const Eigen::VectorXd scale = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * Eigen::MatrixXd(k) * scale.asDiagonal();
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  // The stiffness comes from differences, 1e-9 of its largest entry.
  EXPECT_LT(std::max(std::fabs(squares(0)), std::fabs(squares(5))), 1e-8 * squares(n - 1));
  EXPECT_LT(100.0 * std::fabs(squares(5)), squares(6)) << "1/s2: a seventh mode that does not deform";
  EXPECT_NEAR(frequency_factor(std::sqrt(squares(6)) / (2.0 * M_PI), spec.plate), 13.468, 0.01 * 13.468);
}

TEST(PlateEdges_Bolted, FirstFrequency_IsALittleBelowThatOfAClampAtTheOpening) {
  CaseSpec spec = with_edges("bolted", 12, true, 0.609);
  spec.plate.opening = 0.406;  // eight of twelve elements
  PlateHex64 bolted(spec, 1), clamped(with_edges("clamped", 8, true), 1);
  const double f = first_frequency(bolted), clamp = first_frequency(clamped);
  EXPECT_LT(f, clamp * (1.0 - 1e-4)) << "Hz";
  EXPECT_GT(f, clamp * std::pow(0.406 / (0.406 + 4.0 * 0.0034), 2)) << "Hz";
  EXPECT_DOUBLE_EQ(free_half_width(bolted.plate().mesh(), 0), 0.203);
}

// The hinge is without work: momentum closes with the supports, the two nodes stay mirror images, to rounding.
TEST(PlateEdges_Pinned, UnderUnevenLoad_TurnsButDoesNotSlideAndItsBooksClose) {
  for (const int layers : {1, 2}) {
    CaseSpec spec = with_edges("pinned", 4, true);
    spec.plate.elements[2] = layers;
    PlateHex64 model(spec, 1);
    std::vector<Vec3> force = testing::pressure_force(model.plate().mesh(), 2e6);
    for (std::size_t i = 0; i < force.size(); ++i) force[i].x = 20.0 * std::sin(static_cast<double>(i));
    model.set_surface_force(force);
    for (int i = 0; i < 800; ++i) model.step(model.stable_step());
    const StructureLedger l = model.ledger();
    const double scale = norm(l.impulse_received) + norm(l.impulse_of_supports);
    EXPECT_LT(norm(l.momentum - l.impulse_received - l.impulse_of_supports), 1e-12 * scale) << "N s";
    EXPECT_LT(std::fabs(l.balance()), 1e-3 * l.external_work) << "J of " << l.external_work;
    double turned = 0.0;
    for (const Hinge& hinge : model.plate().mesh().hinges) {
      const double a = model.plate().state().u[static_cast<std::size_t>(hinge.lower)].*hinge.component;
      const double b = model.plate().state().u[static_cast<std::size_t>(hinge.upper)].*hinge.component;
      turned = std::max(turned, std::fabs(a));
      ASSERT_NEAR(a + b, 0.0, 1e-15) << "m";
    }
    EXPECT_GT(turned, 1e-6) << "m: the rim turns";
  }
}

// K d = (f(u + t d) - f(u - t d)) / 2t also where two nodes share a degree of freedom. Differences in K: 1e-6.
TEST(PlateEdges_Pinned, StiffnessForRelaxation_IsTheSlopeOfTheForce) {
  PlateHex64 model(with_edges("pinned", 4, true), 1);
  RelaxationProblem& p = *model.relaxation();
  const auto n = static_cast<std::size_t>(p.dofs());
  std::vector<double> plus(n), minus(n), fp(n), fm(n);
  Eigen::VectorXd d(p.dofs());
  for (std::size_t i = 0; i < n; ++i) {
    const double x = std::sin(0.37 * static_cast<double>(i));
    d[static_cast<Eigen::Index>(i)] = x, plus[i] = 1e-9 * x, minus[i] = -1e-9 * x;
  }
  ASSERT_TRUE(p.internal_force(plus, 0.0, fp) && p.internal_force(minus, 0.0, fm));
  const Eigen::VectorXd expected = p.stiffness(std::vector<double>(n, 0.0)) * d;
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR((fp[i] - fm[i]) / 2e-9, expected[static_cast<Eigen::Index>(i)], 1e-6 * expected.cwiseAbs().maxCoeff())
        << "N/m";
}

}  // namespace
}  // namespace standoff::structure
