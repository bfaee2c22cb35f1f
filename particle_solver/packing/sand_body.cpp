#include "particle_solver/packing/sand_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/stop.hpp"
#include "particle_solver/packing/relaxation.hpp"
#include "particle_solver/search/grain_cells.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles {

namespace {

double cube(double a) {
  return a * a * a;
}

void check(const SoilSpec& soil, const SoilBody& shape, const BodyOptions& options) {
  if (!(shape.volume() > 0.0) || soil.inner_radius < 0.0 || soil.particles < (options.quarter ? 4 : 1))
    throw Stop(
        ExitCode::bad_case,
        "sand: the body needs a size above zero with its cavity inside (a shell: outer_radius > inner_radius >= 0) "
        "and at least one grain in the simulated part: particles >= 4 with quarter symmetry, >= 1 without");
  const Vec3& centre = shape.centre();
  if (options.quarter && (options.centre.x != 0.0 || options.centre.y != 0.0 || centre.x != 0.0 || centre.y != 0.0))
    throw Stop(ExitCode::bad_case,
               "sand: with quarter symmetry charge and sand must be centred above the plate (x = y = 0); "
               "use run.symmetry = \"none\"");
}

/// A grain of the repeated cell near the body.
struct Candidate {
  double outside = 0.0;  // m beyond the nearer surface; negative inside
  Vec3 place;            // m from the centre of the body
  std::uint32_t cell_grain = 0;
};

bool is_image(const PeriodicSides& sides, const Vec3& x) {
  const Vec3 &lower = sides.faces.lower, &upper = sides.faces.upper;
  return x.x < lower.x || x.x >= upper.x || x.y < lower.y || x.y >= upper.y;
}

/// Grains of the repeated cell in and near `shape`, which lies about the origin and goes to `centre`.
std::vector<Candidate> cut(const SoilBody& shape, const Vec3& centre, const PackedCell& cell, double size,
                           const BodyOptions& options) {
  CounterRandom random(options.seed, RandomUse::cell_offset, 0);
  const Vec3 offset{random.uniform(), random.uniform(), random.uniform()};
  const double margin = 4.0 * cell.mean_radius * size;
  const auto cells = [&](double half) { return static_cast<int>((half + margin) / size) + 2; };
  const Vec3& half = shape.half_size();
  const int nx = cells(half.x), ny = cells(half.y), nz = cells(half.z);
  std::vector<Candidate> candidates;
  for (int z = -nz; z <= nz; ++z)
    for (int y = options.quarter ? -1 : -ny; y <= ny; ++y)
      for (int x = options.quarter ? -1 : -nx; x <= nx; ++x)
        for (std::size_t i = 0; i < cell.position.size(); ++i) {
          const Vec3 place = size * (Vec3{double(x), double(y), double(z)} + cell.position[i] - offset);
          if (options.quarter && (place.x < 0.0 || place.y < 0.0)) continue;
          if (options.sides.on() && is_image(options.sides, place + centre)) continue;
          const double outside = shape.beyond(place);
          if (outside < margin) candidates.push_back({outside, place, static_cast<std::uint32_t>(i)});
        }
  return candidates;
}

/// Keeps the `wanted` deepest; equal depths are told apart by their order.
void keep_deepest(std::vector<Candidate>& candidates, std::size_t wanted) {
  if (candidates.size() < wanted)
    throw Stop(ExitCode::bad_case, "sand: too few particles for this body: a grain is thicker than the body");
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.outside < b.outside; });
  candidates.resize(wanted);
}

/// Moves centres off a mirror plane, evenly over the nearest three diameters, before overlaps are relaxed: pushed out
/// by the plane at once, surface grains would be thrown off the body.
double off_plane(double height, double radius) {
  const double depth = 6.0 * radius;
  return height < depth ? radius + height * (depth - radius) / depth : height;
}

/// The grains as a state, near ones near in memory.
SandState make_state(const std::vector<Candidate>& kept, const PackedCell& cell, double size, double total_mass,
                     const Vec3& centre) {
  std::vector<Vec3> places(kept.size());
  std::transform(kept.begin(), kept.end(), places.begin(), [](const Candidate& c) { return c.place; });
  GrainCells cells;
  const double radius = cell.mean_radius * size;
  cells.build(places, 2.2 * radius, nullptr);
  std::vector<Vec3> sorted(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) sorted[i] = places[cells.order()[i]] + centre;
  SandState grains = make_grains(std::move(sorted), radius, total_mass / static_cast<double>(kept.size()));
  if (cell.radius.empty()) return grains;
  double cubes = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    grains.grain_radius.push_back(size * cell.radius[kept[cells.order()[i]].cell_grain]);
    cubes += cube(grains.grain_radius.back());
  }
  for (const double r : grains.grain_radius) grains.grain_mass.push_back(total_mass * cube(r) / cubes);
  return grains;
}

}  // namespace

SandBody fill_body(const SoilSpec& soil, const BodyOptions& options) {
  const SoilBody shape(soil, options.centre);
  check(soil, shape, options);
  const int copies = options.quarter ? 4 : 1;
  const auto wanted = static_cast<std::size_t>(std::llround(static_cast<double>(soil.particles) / copies));
  const PackedCell& cell = pack_cell({options.cell_count, soil.packing, soil.radius_spread, options.seed});
  SandBody body;
  body.cell_size = std::cbrt(shape.volume() * options.cell_count / static_cast<double>(soil.particles));
  body.law = grain_law(soil, body.cell_size);
  body.cell_overlap = cell.max_overlap, body.cell_coordination = cell.coordination;
  const SoilSpec uncut = without_cut_sides(soil, options.sides.period.length);
  SoilSpec at_origin = uncut;
  at_origin.centre = {};
  std::vector<Candidate> kept =
      cut({at_origin, options.centre - shape.centre()}, shape.centre(), cell, body.cell_size, options);
  keep_deepest(kept, wanted);
  const double radius = cell.mean_radius * body.cell_size;
  for (Candidate& c : kept)
    if (options.quarter) c.place.x = off_plane(c.place.x, radius), c.place.y = off_plane(c.place.y, radius);
  body.grains = make_state(kept, cell, body.cell_size, soil.bulk_density * shape.volume() / copies, shape.centre());

  std::optional<Vec3> box;
  if (options.sides.on()) box = options.sides.period.length;
  SandPairs pairs({{1.0, 0.0, 0.0}, {options.quarter}, box, 0.2, options.threads});
  const SoilBody held(uncut, options.centre);
  const BodyBounds bounds{held, 0.35 * radius};
  const RelaxResult relaxed =
      relax_overlaps(body.grains, pairs, {options.overlap, 0.0, options.most_iterations, bounds});
  body.residual_overlap = relaxed.overlap, body.iterations = relaxed.iterations;
  body.coordination = pairs.books().coordination;
  for (const Vec3& p : body.grains.position) body.swelling = std::max(body.swelling, held.beyond(p));
  if (options.sides.on())
    for (Vec3& p : body.grains.position) p = image_inside(options.sides, p);
  return body;
}

}  // namespace standoff::particles
