#include "particle_solver/packing/packed_cell.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/stop.hpp"
#include "particle_solver/packing/cell_cache.hpp"
#include "particle_solver/packing/relaxation.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles {

namespace {

constexpr Vec3 unit_box{1.0, 1.0, 1.0};

void check(const PackedCellOptions& options) {
  if (options.count >= 2 && options.fill > 0.0 && options.fill < 0.70 && options.radius_spread >= 0.0 &&
      options.radius_spread < 0.5)
    return;
  throw Stop(ExitCode::bad_case,
             "sand: cannot pack a cell with these values. Needed: at least 2 grains, packing between 0 and 0.70 "
             "(random close packing is 0.64), radius_spread between 0 and 0.5.");
}

std::vector<double> draw_radii(const PackedCellOptions& options) {
  std::vector<double> radii(static_cast<std::size_t>(options.count));
  double cubes = 0.0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    CounterRandom random(options.seed, RandomUse::cell_radius, static_cast<std::uint32_t>(i));
    radii[i] = 1.0 + options.radius_spread * (2.0 * random.uniform() - 1.0);
    cubes += radii[i] * radii[i] * radii[i];
  }
  const double scale = std::cbrt(options.fill / (4.0 / 3.0 * std::numbers::pi * cubes));
  for (double& r : radii) r *= scale;
  return radii;
}

std::vector<Vec3> draw_centres(const PackedCellOptions& options) {
  std::vector<Vec3> centres(static_cast<std::size_t>(options.count));
  for (std::size_t i = 0; i < centres.size(); ++i) {
    CounterRandom random(options.seed, RandomUse::cell_packing, static_cast<std::uint32_t>(i));
    centres[i].x = random.uniform(), centres[i].y = random.uniform(), centres[i].z = random.uniform();
  }
  return centres;
}

PackedCell pack(const PackedCellOptions& options) {
  const std::vector<double> radii = draw_radii(options);
  PackedCell cell;
  for (const double r : radii) cell.mean_radius += r / options.count;
  SandState grains = make_grains(draw_centres(options), cell.mean_radius, 1.0);
  if (options.radius_spread > 0.0) grains.grain_radius = radii;
  SandPairs pairs({{1.0, 0.0, 0.0}, {}, unit_box, 0.2, 1});
  const RelaxResult relaxed = relax_overlaps(grains, pairs, {});
  const SandBooks& books = pairs.books();
  cell.max_overlap = relaxed.overlap, cell.iterations = relaxed.iterations;
  cell.coordination = books.coordination;
  cell.residual_pressure = (books.virial.x + books.virial.y + books.virial.z) / 3.0;
  cell.radius = grains.grain_radius;
  cell.position = std::move(grains.position);
  const auto wrap = [](double x) { return x - std::floor(x) < 1.0 ? x - std::floor(x) : 0.0; };
  for (Vec3& p : cell.position) p = {wrap(p.x), wrap(p.y), wrap(p.z)};
  return cell;
}

PackedCell load_or_pack(const PackedCellOptions& options) {
  check(options);
  const std::string folder = cell_cache_folder(), path = folder + "/" + cell_file_name(options);
  if (!folder.empty())
    if (std::optional<PackedCell> known = load_cell(path)) return std::move(*known);
  PackedCell cell = pack(options);
  if (!folder.empty()) store_cell(path, cell);
  return cell;
}

}  // namespace

const PackedCell& pack_cell(const PackedCellOptions& options) {
  static std::mutex guard;
  static std::map<PackedCellOptions, std::unique_ptr<PackedCell>> packed;
  const std::lock_guard<std::mutex> lock(guard);
  std::unique_ptr<PackedCell>& cell = packed[options];
  if (!cell) cell = std::make_unique<PackedCell>(load_or_pack(options));
  return *cell;
}

}  // namespace standoff::particles
