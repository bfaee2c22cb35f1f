#pragma once
// Stage air_collide: collisions of air with air and with detonation products, cell by cell. A particle is in one cell,
// so cells are independent: any number of threads, the same bits.
#include "particle_solver/state/air.hpp"

namespace standoff::particles {

class AirCollide {
 public:
  explicit AirCollide(std::uint64_t seed, int threads) : seed_(seed), threads_(threads) {}
  /// `products` may be null; `step` numbers the call.
  void run(Air& air, GasState* products, double dt, std::uint32_t step);
  long collisions() const { return collisions_; }  // since the start
  template <class Archive>
  void archive(Archive& a) {
    a(collisions_);
  }

 private:
  void collide_cell(Air& air, GasState* products, std::uint32_t cell, double dt, std::uint32_t step, long& done) const;

  std::uint64_t seed_;
  int threads_;
  AirCells::Listing air_, products_;
  long collisions_ = 0;
};

}  // namespace standoff::particles
