// Finite strain at a point against closed forms and against another formulation.
//   simple shear, elastic  Hencky strain of F = I + gamma e1 x e2: principal stretch ln l = asinh(gamma / 2), its axis
//   at
//                          tan 2 theta = 2 / gamma: tau_12 = 4 G asinh(gamma/2) / sqrt(4 + gamma^2), tau_11 = gamma / 2
//                          of it (Xiao, Bruhns, Meyers, Acta Mech. 124 (1997) 89). Rounding: 1e-12.
//   closed elastic cycle   stress is a gradient of stored energy: back at F = I nothing is left, and the work of the
//                          trapezoidal rule over N steps is zero to 1 / N^2
//   updated Lagrangian     Hughes & Winget, Int. J. Num. Meth. Eng. 15 (1980) 1862, Jaumann rate and radial return; the
//                          two differ by terms of the size of the elastic strain, sigma / 2G < 1 %
#include <Eigen/Dense>

#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Static = Metal<Hardening::power, RateLaw::none, false, false>;
using Matrix = Eigen::Matrix3d;

MetalParameters steel() {
  return metal_parameters(testing::al6xn());
}

template <class Law>
Matrix kirchhoff(const MetalParameters& metal, const Matrix& f, PointHistory<double>& s, PointResult<double>& r) {
  Mat3<double> h;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h.m[i][j] = f(i, j) - (i == j ? 1.0 : 0.0);
  r = update_point<Law>(metal, h, {0.0, true}, s);
  Matrix p;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) p(i, j) = r.p.m[i][j];
  return p * f.transpose();
}

TEST(MaterialPoint_SimpleShear, ElasticUpToFour_IsTheClosedForm) {
  const MetalParameters metal = steel();
  for (double gamma = 0.01; gamma <= 4.0; gamma *= 1.3) {
    Matrix f = Matrix::Identity();
    f(0, 1) = gamma;
    PointHistory<double> s{};
    PointResult<double> r;
    const Matrix tau = kirchhoff<Elastic>(metal, f, s, r);
    const double shear = 4.0 * metal.shear * std::asinh(0.5 * gamma) / std::sqrt(4.0 + gamma * gamma);
    EXPECT_NEAR(tau(0, 1), shear, 1e-12 * metal.shear) << "Pa at gamma = " << gamma;
    EXPECT_NEAR(tau(0, 0), 0.5 * gamma * shear, 1e-12 * metal.shear) << "Pa at gamma = " << gamma;
    EXPECT_NEAR(tau(1, 1), -0.5 * gamma * shear, 1e-12 * metal.shear) << "Pa at gamma = " << gamma;
    EXPECT_NEAR(tau(2, 2), 0.0, 1e-12 * metal.shear) << "Pa at gamma = " << gamma;
  }
}

/// Around a square of stretch and shear: out along one, out along the other, and back in the same order.
Matrix around(double t) {
  const double stretch = std::clamp(t, 0.0, 1.0) - std::clamp(t - 2.0, 0.0, 1.0);
  const double shear = std::clamp(t - 1.0, 0.0, 1.0) - std::clamp(t - 3.0, 0.0, 1.0);
  Matrix f = Matrix::Identity();
  f(0, 0) += 0.3 * stretch, f(0, 1) = 0.5 * shear;
  return f;
}

TEST(MaterialPoint_ClosedElasticCycle, StretchAndShear_LeavesNoStressAndNoWork) {
  const MetalParameters metal = steel();
  PointHistory<double> s{};
  PointResult<double> r;
  Matrix tau = kirchhoff<Elastic>(metal, around(0.0), s, r), f = around(0.0);
  double work = 0.0, peak = 0.0;
  const int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const Matrix next = around(4.0 * i / steps), before = tau * f.inverse().transpose();
    tau = kirchhoff<Elastic>(metal, next, s, r);
    work += 0.5 * (before + tau * next.inverse().transpose()).cwiseProduct(next - f).sum();
    peak = std::max(peak, r.elastic);
    EXPECT_NEAR(work, r.elastic, 1e-5 * metal.shear * 0.1) << "J/m3 at step " << i;
    f = next;
  }
  EXPECT_LT(tau.norm(), 1e-12 * metal.shear) << "Pa";
  EXPECT_LT(std::fabs(work), 10.0 / (steps * steps) * peak) << "J/m3 of " << peak;
}

/// Updated Lagrangian: Cauchy stress and plastic strain carried by increments.
struct HughesWinget {
  Matrix stress = Matrix::Zero();
  double strain = 0.0;

  void step(const MetalParameters& m, const Matrix& from, const Matrix& to) {
    const Matrix g = (to - from) * (0.5 * (to + from)).inverse(), identity = Matrix::Identity();
    const Matrix d = 0.5 * (g + g.transpose()), w = 0.5 * (g - g.transpose());
    const Matrix q = (identity - 0.5 * w).inverse() * (identity + 0.5 * w);
    stress =
        q * stress * q.transpose() + 2.0 * m.shear * (d - d.trace() / 3.0 * identity) + m.bulk * d.trace() * identity;
    const Matrix dev = stress - stress.trace() / 3.0 * identity;
    const double trial = std::sqrt(1.5) * dev.norm();
    const auto excess = [&](double dp) {
      return trial - 3.0 * m.shear * dp - m.flow.A - m.flow.B * std::pow(std::max(strain + dp, 1e-12), m.flow.n);
    };
    if (excess(0.0) <= 0.0) return;
    double low = 0.0, high = trial / (3.0 * m.shear);
    for (int i = 0; i < 60; ++i) (excess(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    stress -= 3.0 * m.shear * low / trial * dev;
    strain += low;
  }
};

TEST(MaterialPoint_StretchShearAndTurn, AgainstUpdatedLagrangian_AgreesToTheElasticStrain) {
  const MetalParameters metal = steel();
  const auto path = [](double t) {
    Matrix u = Matrix::Identity();
    u(0, 0) = std::exp(0.2 * t), u(1, 1) = u(2, 2) = std::exp(-0.1 * t), u(0, 1) = 0.3 * t;
    return Matrix(Eigen::AngleAxisd(1.5 * t, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix() * u);
  };
  PointHistory<double> s{};
  s.static_stress = metal.flow.A;
  PointResult<double> r;
  HughesWinget other;
  for (int i = 1; i <= 4000; ++i) {
    const Matrix cauchy = kirchhoff<Static>(metal, path(i / 4000.0), s, r) / r.volume_ratio;
    other.step(metal, path((i - 1) / 4000.0), path(i / 4000.0));
    const double mises = std::sqrt(1.5) * cauchy.norm(), scale = std::max(mises, metal.flow.A);
    ASSERT_LT((cauchy - other.stress).norm(), 0.01 * scale) << "Pa at step " << i;
  }
  EXPECT_NEAR(other.strain / s.strain, 1.0, 0.01);
  EXPECT_GT(s.strain, 0.2);
}

}  // namespace
}  // namespace standoff::structure
