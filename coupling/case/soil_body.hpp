#pragma once
// The body of sand as a shape: its volume, how far a point lies outside, and where a point is held inside.
//
//   shell     between two spheres about the charge centre        sphere    a ball about soil.centre
//   cylinder  axis along z, about soil.centre                    box       edges along x, y, z, about soil.centre
//
// All but the shell may have a spherical cavity of inner_radius about the charge centre as well; it lies inside the
// body. Distances to a box or a cylinder are the largest over their faces: exact inside and beside a face, smaller than
// the true distance beyond an edge, which is of no concern for cutting (the sign is exact). Lengths in m, volumes in
// m3.
#include "coupling/case/case_spec.hpp"

namespace standoff {

/// The body of a scene that repeats after `period` (DomainSpec): a box that reaches from face to face has no sides.
SoilSpec without_cut_sides(SoilSpec soil, const Vec3& period);

class SoilBody {
 public:
  SoilBody(const SoilSpec& soil, const Vec3& charge_centre);
  const Vec3& centre() const { return centre_; }
  /// Half of the edges of the box around the body.
  const Vec3& half_size() const { return half_; }
  /// Of the sand, without the cavity.
  double volume() const;
  /// Distance beyond the outer surface, negative inside; takes no notice of the cavity.
  double beyond_outside(const Vec3& place) const;
  /// Distance beyond the nearer of outer surface and cavity, negative in the sand.
  double beyond(const Vec3& place) const;
  /// The point itself, or the nearest that lies at most `play` beyond the surfaces.
  Vec3 held(const Vec3& place, double play) const;

 private:
  SoilShape shape_;
  Vec3 centre_, cavity_, half_;
  double cavity_radius_;
};

}  // namespace standoff
