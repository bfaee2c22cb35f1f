// Law: a quarter of a symmetric scene between mirror planes gives the loads of the whole, in the mean over samples: the
// whole impulse and that on the middle of the plate, where the mirrors meet. A bare charge on a rigid plate in a rigid
// wall, 8000 particles in the whole. Tolerance: three standard errors of the difference of the means (from the scatter
// of 32 quarters and 10 wholes); the standard error itself must be below 0.7 % of the impulse (2.5 % in the middle, a
// sixth of the plate), so that a layer one radius thick without gas, or explosive packed along the planes (1.9 to 3.5 %
// of the impulse), would be seen. Means and scatter are in the XML report.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

CaseSpec bare(bool quarter, int seed) {
  standoff::test::CaseFolder folder;
  folder.write("case.toml", std::string(R"([charge]
explosive = "c4"
mass = "150 g"
radius = "28.2 mm"
particles = 8000
[soil]
kind = "none"
[plate]
material = "al6xn"
size = ["400 mm", "400 mm", "3.4 mm"]
[run]
stand_off = "150 mm"
until = "0.3 ms"
)") + "symmetry = \"" + (quarter ? "quarter" : "none") +
                                "\"\nseed = " + std::to_string(seed) + "\n");
  const CaseRead read = folder.read();
  EXPECT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  return read.spec;
}

struct Impulse {
  double whole = 0.0, middle = 0.0;  // N s on the full plate, and within 50 mm of its centre
};

Impulse impulse(bool quarter, int seed) {
  const CaseSpec spec = bare(quarter, seed);
  const double half = 0.2, copies = quarter ? 4.0 : 1.0;
  const SurfaceMesh mesh = test::sheet_mesh(quarter ? 8 : 16, quarter ? 0.0 : -half, half, 1e3, [](double x, double y) {
    return Vec3{x, y, 0.0};
  });
  Scene scene = build_scene(spec, mesh, 1);
  TimeLoop loop(spec, scene, 1);
  SurfaceLoad load;
  constexpr double window = 2e-6;
  for (int k = 0; k < 150; ++k) {
    scene.sheet.begin_window(test::at_rest(mesh), true);
    loop.advance(window * k, window);
    scene.sheet.collect_load(window, load);
  }
  Impulse result;
  for (std::size_t n = 0; n < scene.sheet.plate_nodes(); ++n) {
    const double share = -scene.sheet.node_impulse()[n].z * copies;
    result.whole += share;
    if (std::hypot(mesh.position[n].x, mesh.position[n].y) < 0.0501) result.middle += share;
  }
  return result;
}

struct Mean {
  double mean = 0.0, scatter = 0.0, error = 0.0;
};

Mean mean_of(const std::vector<double>& values) {
  Mean result;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) result.mean += v / n;
  for (const double v : values) result.scatter += (v - result.mean) * (v - result.mean) / (n - 1.0);
  result.scatter = std::sqrt(result.scatter), result.error = result.scatter / std::sqrt(n);
  return result;
}

void expect_same_mean(const std::string& what, const std::vector<double>& quarter, const std::vector<double>& whole,
                      double largest_error) {
  const Mean q = mean_of(quarter), w = mean_of(whole);
  const double error = std::hypot(q.error, w.error);
  const std::string text =
      fmt::format("{}: quarter {:.2f} +- {:.2f} Ns (scatter {:.2f}), full {:.2f} +- {:.2f} Ns ({:.2f})", what, q.mean,
                  q.error, q.scatter, w.mean, w.error, w.scatter);
  testing::Test::RecordProperty(what, text);
  EXPECT_LT(error, largest_error * w.mean) << text;
  EXPECT_NEAR(q.mean, w.mean, 3.0 * error) << text;
}

TEST(QuarterCharge_ManySeeds_LoadsThePlateAsTheWholeCharge, ImpulseAndItsMiddle) {
  std::vector<double> quarter, whole, quarter_middle, whole_middle;
  for (int seed = 1; seed <= 32; ++seed) {
    const Impulse sample = impulse(true, seed);
    quarter.push_back(sample.whole), quarter_middle.push_back(sample.middle);
  }
  for (int seed = 1; seed <= 10; ++seed) {
    const Impulse sample = impulse(false, seed);
    whole.push_back(sample.whole), whole_middle.push_back(sample.middle);
  }
  expect_same_mean("impulse", quarter, whole, 0.007);
  expect_same_mean("impulse within 50 mm", quarter_middle, whole_middle, 0.025);
}

}  // namespace
}  // namespace standoff::particles
