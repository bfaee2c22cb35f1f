// Pipes against closed forms.
//   elastic, slow internal pressure p, free ends (no axial stress): Lame,
//     u(r) = p a^2 / (E (b^2 - a^2)) [(1 - nu) r + (1 + nu) b^2 / r]     Timoshenko & Goodier, Theory of Elasticity,
//     art. 28
//   thin ring of perfectly plastic metal with radial speed V: hoop stress alone, volume kept, the energy is spent at
//     ln(r / r0) = rho V^2 / (2 sigma_y) + sigma_y / (2 E)
// Lame: the cubic shape is exact to 1e-6; a ramp of sin^2 over seven periods of the ring leaves (T / 2 t)^2 of the
// deflection as swing, 5e-3. Ring: strains are logarithmic, the wall is 2 % of the radius, of which terms of second
// order remain, 4e-4; the rim's axial speed takes (L / 4 r)^2 nu^2 of the energy, 1e-4; half a percent covers all.
#include <gtest/gtest.h>

#include "structure_solver/models/pipe_hex64/pipe_hex64.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure::testing {
namespace {

CaseSpec pipe_case(const PipeSpec& pipe, std::array<int, 3> elements, double yield) {
  CaseSpec spec = plate_case(4, true, yield);
  spec.plate.model = "pipe_hex64", spec.plate.edges = "free";
  spec.plate.pipe = pipe;
  spec.plate.elements = elements;
  spec.plate.size = {M_PI * (pipe.inner_diameter + pipe.wall), pipe.length, pipe.wall};
  for (EffectDecision& effect : spec.effects) effect.on = effect.name == "plasticity";
  spec.observe.probes = {0.5 * pipe.length};
  return spec;
}

/// Forces on the inner face of a pressure of 1 Pa.
std::vector<Vec3> unit_pressure(const PipeHex64& model) {
  const SurfaceMesh& surface = model.surface();
  std::vector<Vec3> force(surface.position.size());
  for (const auto& q : surface.quads) {
    const auto at = [&](std::size_t i) { return surface.position[static_cast<std::size_t>(q[i])]; };
    const Vec3 share = -0.125 * cross(at(2) - at(0), at(3) - at(1));  // normals look inwards
    for (const std::int32_t node : q) force[static_cast<std::size_t>(node)] += share;
  }
  return force;
}

TEST(Pipe, SlowInternalPressure_GrowsAsLameSays) {
  const PipeSpec pipe{0.020, 0.010, 0.010};
  for (const std::array<int, 3> elements : {std::array{16, 2, 1}, std::array{16, 1, 2}}) {
    const CaseSpec spec = pipe_case(pipe, elements, 1e12);
    PipeHex64 model(spec, 1);
    const std::vector<Vec3> unit = unit_pressure(model);
    const double e = spec.plate.material.youngs_modulus, a = 0.010, b = 0.020, p = 50e6;
    const double period = 2.0 * M_PI * 0.5 * (a + b) * std::sqrt(spec.plate.material.density / e), ramp = 7.0 * period;
    while (model.time() < ramp) {
      const double now = p * std::pow(std::sin(0.5 * M_PI * model.time() / ramp), 2);
      std::vector<Vec3> force = unit;
      for (Vec3& f : force) f *= now;
      model.set_surface_force(force);
      for (int i = 0; i < 20; ++i) model.step(model.stable_step());
    }
    const double lame = 2.0 * p * a * a * b / (e * (b * b - a * a));
    EXPECT_NEAR(model.probes().front().displacement / lame, 1.0, 1e-2) << elements[2] << " layers, " << lame << " m";
  }
}

TEST(Pipe, EvenPressure_MovesEveryColumnAlike) {
  const CaseSpec spec = pipe_case({0.02543, 0.002593, 0.020}, {24, 3, 1}, 200e6);
  PipeHex64 model(spec, 1);
  std::vector<Vec3> force(unit_pressure(model));
  for (Vec3& f : force) f *= 4e8;
  model.set_surface_force(force);
  for (int i = 0; i < 60; ++i) model.step(model.stable_step());
  SurfaceMotion motion;
  model.surface_motion(motion);
  const auto row = static_cast<std::size_t>(model.plate().mesh().nodes[0]);
  for (std::size_t i = 0; i < motion.position.size(); i += 3) {  // nodes at the same place within their element
    if (i % row % 3 != 0) continue;
    const auto radius = [&](std::size_t k) { return std::hypot(motion.position[k].x, motion.position[k].y); };
    EXPECT_NEAR(radius(i) / radius(i / row * row), 1.0, 1e-6) << "surface node " << i;
  }
  EXPECT_GT(model.extremes().max_plastic_strain, 0.01);
}

// Exact: a held component has no inverse mass.
TEST(Pipe, HeldEnds_StayWhereTheyAreHeld) {
  for (const char* ends : {"free", "symmetry", "clamped"}) {
    CaseSpec spec = pipe_case({0.02543, 0.002593, 0.020}, {16, 3, 1}, 200e6);
    spec.plate.edges = ends;
    PipeHex64 model(spec, 1);
    std::vector<Vec3> force(unit_pressure(model));
    for (Vec3& f : force) f *= 4e8;
    model.set_surface_force(force);
    for (int i = 0; i < 60; ++i) model.step(model.stable_step());
    double along = 0.0, outwards = 0.0;
    const PlateMesh& mesh = model.plate().mesh();
    for (int i = 0; i < mesh.nodes[0]; ++i) {
      const Vec3& u = model.plate().state().u[static_cast<std::size_t>(mesh.node(i, 0, 0))];
      along = std::max(along, std::fabs(u.z)), outwards = std::max(outwards, std::hypot(u.x, u.y));
    }
    EXPECT_EQ(along == 0.0, spec.plate.edges != "free") << ends << ", " << along << " m along the axis";
    EXPECT_EQ(outwards == 0.0, spec.plate.edges == "clamped") << ends << ", " << outwards << " m outwards";
  }
}

TEST(Pipe, PlasticRingWithRadialSpeed_StopsWhereItsEnergyIsSpent) {
  const double r0 = 0.05, wall = 0.001, yield = 200e6;
  const CaseSpec spec = pipe_case({2.0 * r0 - wall, wall, wall}, {16, 1, 1}, yield);
  PipeHex64 model(spec, 1);
  const double speed = 60.0;
  const PlateMesh& mesh = model.plate().mesh();
  std::vector<double> u(static_cast<std::size_t>(model.relaxation()->dofs())), v;
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    const Vec3& x = mesh.position[i];
    const double radius = std::hypot(x.x, x.y);
    if ((mesh.fixed[i] & fixed_x) == 0) v.push_back(speed * x.x / radius);
    if ((mesh.fixed[i] & fixed_y) == 0) v.push_back(speed * x.y / radius);
    v.push_back(0.0);
  }
  model.relaxation()->set_state(u, v);
  double peak = -1.0, now = 0.0;
  while (now > peak) {
    peak = now;
    for (int i = 0; i < 20; ++i) model.step(model.stable_step());
    now = model.centre_deflection();
  }
  const MaterialSpec& m = spec.plate.material;
  const double strain = m.density * speed * speed / (2.0 * yield) + yield / (2.0 * m.youngs_modulus);
  EXPECT_NEAR(std::log1p(peak / r0) / strain, 1.0, 5e-3) << "strain " << strain;
}

}  // namespace
}  // namespace standoff::structure::testing
