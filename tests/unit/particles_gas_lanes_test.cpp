// Law: the single-precision test of the search keeps every body that the exact kernel says is hit; it is a filter whose
// margin must cover its rounding, so the count of lost hits is zero, not small. It must also be worth its while: what
// it keeps for nothing is bounded by a tenth of the hits beside the grazing ones. Source of the margin: gas_lanes.hpp.
#include <random>

#include <gtest/gtest.h>

#include "particle_solver/kernels/gas_impact_time.hpp"
#include "particle_solver/search/gas_cell_grid.hpp"
#include "particle_solver/step/gas_lanes.hpp"

namespace standoff::particles::gas {
namespace {

struct Count {
  long hits = 0, lost = 0, kept = 0;
};

/// Random pairs at distances of a few `contact`, with paths of about `path`, around a point `away` from the origin.
/// Every other pair is turned so that it grazes, where rounding decides.
Count compare(double contact, double path, double away, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto any = [&](double size) { return Vec3{normal(random), normal(random), normal(random)} * size; };
  Count count;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 start = any(1.0) * away, mine = any(path), other = any(path), w = other - mine;
    Vec3 gap = any(contact + path);
    if (k % 2 == 0) {  // closest approach = contact, give or take rounding
      const Vec3 along = w / norm(w), side = gap - along * dot(gap, along);
      gap = side * (contact / norm(side) * (1.0 + 1e-13 * normal(random))) - w * uniform(random);
    }
    const double since = uniform(random) < 0.5 ? 0.0 : 0.5 * uniform(random);
    Lanes lanes;
    lanes.resize(1);
    lanes.set(0, start + gap, other);
    lanes.measure(start + gap, other);
    const Probe probe(lanes, start, mine, since, 1.0, contact);
    const bool hit = impact_time(gap, w, contact, since, 1.0) != no_impact;
    const bool kept = (hit_in_time<Partner::gas>(lanes, 0, probe) & 1u) != 0;
    count.hits += hit, count.lost += hit && !kept, count.kept += kept;
  }
  return count;
}

TEST(GasLanes, PairsThatHit_AreAllKept) {
  for (const double path : {1e-6, 1e-4, 1e-3, 1e-2, 0.3})
    for (const double away : {0.0, 0.2, 10.0}) {
      const Count count = compare(1e-3, path, away, 7);
      EXPECT_EQ(count.lost, 0) << "paths of " << path << " m, " << away << " m away";
      EXPECT_GT(count.hits, 1000) << "paths of " << path << " m";
    }
}

TEST(GasLanes, PairsNearTheOrigin_FewAreKeptForNothing) {
  const Count count = compare(1e-3, 1e-3, 0.2, 9);
  EXPECT_LT(count.kept, 1.1 * static_cast<double>(count.hits) + 10000.0) << "10000 graze";
}

TEST(GasCellGrid, RowsThatAByteCannotCount_AreSortedAndFound) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  std::vector<Vec3> points(3000);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = i % 2 ? Vec3{uniform(random), uniform(random), uniform(random)} : Vec3{0.5, 0.5, 0.5};
  for (const double side : {0.0, 1.0}) {
    GasCellGrid grid;
    grid.shape(points.size(), 0.1, period_of({side, side, side}));
    grid.sort(points);
    std::vector<int> found(points.size());
    const auto look = [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t p = begin; p < end; ++p) ++found[grid.order()[p]];
    };
    side > 0.0 ? grid.visit<true>({0.5, 0.5, 0.5}, 0.1, look) : grid.visit<false>({0.5, 0.5, 0.5}, 0.1, look);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LE(found[i], 1) << "point " << i;
      if (norm(points[i] - Vec3{0.5, 0.5, 0.5}) <= 0.1) {
        EXPECT_EQ(found[i], 1) << "point " << i;
      }
    }
  }
}

}  // namespace
}  // namespace standoff::particles::gas
