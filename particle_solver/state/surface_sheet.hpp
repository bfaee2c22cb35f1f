#pragma once
// The wetted surface as the particles see it: one smooth sheet of bilinear quads that moves, answers hits with a finite
// mass, and collects the impulse of a window. Rigid quads (infinite mass) continue it where the plate's cover begins.
//
// One contact per particle: the globally closest point of the sheet, ties to the lowest face. No seams, no double
// counting. Effective mass at a point with bilinear weights N_a: 1/m_w = sum N_a^2 / m_a. An impulse J at the point is
// shared to the nodes as N_a J (sum and moment exact) and changes the local node velocities by N_a J / m_a at once, so
// that later hits in the same window meet a wall that already moves; the next exchange replaces that local answer.
// Nodes follow the convention of media.hpp inside a sub-step: a hit at time t shifts the node's starting point.
//
// Sides: gap is positive in front. A sphere is in contact when -radius <= gap < radius; deeper than one radius behind
// it has gone past the sheet (round an open rim) and is left alone, and so is one beside an open rim and behind it.
//
// Limit: the impulse is shared over the nodes of one quad. A particle much heavier than m_w meets a wall that gives way
// like its four nodes until the next exchange; momentum and energy stay exact. inverse_mass tells: m * inverse_mass.
// Threads: const members may be called by many at once; the others by one.
#include <array>
#include <span>
#include <vector>

#include "coupling/contract/surface.hpp"
#include "particle_solver/kernels/turning_sphere.hpp"
#include "particle_solver/search/surface_search.hpp"

namespace standoff::particles {

struct SheetOptions {
  bool quarter = false;  // the mesh covers x >= 0, y >= 0 only
  double surround_half_size =
      0.0;              // m; > 0 adds a rigid ring from the mesh edge to this half width at the edge's height
  bool recedes = true;  // false: particles meet the surface at rest, and do no work on it
};

/// A point of the sheet seen from a position in space.
struct SheetPoint {
  int face = -1;               // -1: none in reach
  double xi = 0.0, eta = 0.0;  // in [-1, 1]
  Vec3 point, normal;          // m; unit normal towards the loaded side
  Vec3 velocity;               // m/s of that point
  double gap = 0.0;            // m, signed distance of the asked position along the normal
  double inverse_mass = 0.0;   // 1/kg; 0 on rigid quads
  bool rigid = false;          // part of the surround
};

/// Outcome of one impact.
struct Impact {
  Vec3 impulse;       // N s on the sheet; the particle takes the opposite
  double work = 0.0;  // J given to the sheet
  double loss = 0.0;  // J dissipated
};

class SurfaceSheet {
 public:
  SurfaceSheet(SurfaceMesh mesh, const SheetOptions& options);

  /// Starts a window: nodes at `motion`. If `keep_pending`, the local answer of the previous window's load, which the
  /// structure has not seen yet (parallel scheme), is added to the node velocities again; otherwise it is dropped.
  void begin_window(const SurfaceMotion& motion, bool keep_pending);

  /// Closest point of the sheet within `reach` of `position` at time t of the current sub-step.
  SheetPoint closest(const Vec3& position, double reach, double t = 0.0) const;

  /// First time in (t_from, t_to] at which a sphere x + v t of `radius` touches the sheet while approaching it; t_from
  /// if it already touches and approaches. Swept, so nothing tunnels. False if none.
  bool first_hit(const Vec3& x, const Vec3& v, double radius, double t_from, double t_to, double& t_hit,
                 SheetPoint& where) const;

  /// Highest position and speed bounds of the sheet for a cheap rejection: no point is above this z during the
  /// sub-step.
  double highest(double t_to) const;

  /// Normal impact with restitution e and Coulomb friction mu at time t of the sub-step; changes the particle's
  /// velocity and the local node velocities, collects the nodal impulses. Momentum exact; energy exact for e = 1, mu =
  /// 0.
  Impact collide(const SheetPoint& where, double mass, double restitution, double friction, double t, Vec3& velocity);
  Impact collide(const SheetPoint& where, SmoothSphere sphere, double restitution, double friction, double t);
  /// The same of a sphere that turns: friction acts on its surface.
  Impact collide(const SheetPoint& where, TurningSphere sphere, double restitution, double friction, double t);
  /// A force law's impulse (force times step) on the sheet at a point; work is impulse times mean wall velocity.
  Impact push(const SheetPoint& where, const Vec3& impulse, double t);

  /// Velocity of that point now, after the hits since `where` was found.
  Vec3 velocity_at(const SheetPoint& where) const;

  /// False: the plate is met at rest, whatever it does.
  bool recedes() const { return recedes_; }
  /// Farthest that the start of this window has set a node, m.
  double jump() const { return jump_; }

  /// End of a sub-step: nodes move on by h.
  void drift(double h);

  /// Window-averaged nodal forces of the plate's own nodes, and start collecting anew.
  void collect_load(double window, SurfaceLoad& load);

  /// True if the sheet lies across z, as a plate does; a pipe about z does not.
  bool is_level() const { return search_.looks_along_z(); }
  std::size_t plate_nodes() const;
  std::size_t plate_faces() const { return plate_faces_; }
  Vec3 total_impulse() const;     // N s on the plate's nodes since the start
  Vec3 surround_impulse() const;  // N s on rigid-ring nodes since the start
  double total_work() const;      // J given to the plate since the start
  /// Impulse per plate node since the start [N s], for the impulse map.
  std::span<const Vec3> node_impulse() const;
  const SurfaceMesh& mesh() const;  // plate quads first, then the ring; the same for nodes
  /// Starting points [m] and velocities [m/s] of the present sub-step, plate nodes first, then the ring.
  std::span<const Vec3> node_position() const { return position_; }
  std::span<const Vec3> node_velocity() const { return velocity_; }
  /// No point of the sheet is below this z during the sub-step.
  double lowest(double t_to) const;

  /// What outlives a sub-step; the mesh is that of the constructor. The search is built anew where it was built last,
  /// so that the same faces are looked at in the same order.
  template <class Archive>
  void archive(Archive& a) {
    std::vector<Vec3> reference(search_.reference().begin(), search_.reference().end());
    a(position_, velocity_, window_impulse_, pending_, node_impulse_, total_impulse_, surround_impulse_, total_work_);
    a(moved_, speed_, top_, rise_, bottom_, sink_, reference);
    if constexpr (Archive::reading) {
      throw_unless_sized(reference.size());
      search_.rebuild(reference);
    }
  }

 private:
  struct Answer {
    Vec3 velocity, inverse_mass;  // m/s; 1/kg by axis
  };
  Answer answer(std::int32_t face, const std::array<double, 4>& weight) const;
  template <class Sphere>
  Impact meet(const SheetPoint& where, Sphere& sphere, double restitution, double friction, double t);
  SheetMotion motion() const { return {position_, velocity_}; }
  double slack(double t) const;
  SheetPoint seen(const SheetFoot& foot) const;
  void give(std::int32_t face, const std::array<double, 4>& weight, const Vec3& impulse, double t, double work);
  void renew_bounds();
  /// A saved sheet that has another number of nodes than the mesh: Stop with code 6.
  void throw_unless_sized(std::size_t reference_nodes) const;

  SurfaceMesh mesh_;
  SurfaceSearch search_;
  std::size_t plate_nodes_ = 0, plate_faces_ = 0;
  bool recedes_ = true;
  std::vector<Vec3> position_, velocity_;  // all nodes
  std::vector<Vec3> inverse_mass_;         // 1/kg by axis; 0 on the ring and across a mirror plane
  std::vector<Vec3> window_impulse_,
      pending_;                     // N s, plate nodes: being collected; sent but not yet seen in the motion
  std::vector<Vec3> node_impulse_;  // N s since the start
  Vec3 total_impulse_, surround_impulse_;
  double total_work_ = 0.0;
  double jump_ = 0.0;  // m, of this window: every window sets it
  // Bounds over all nodes: motion since the bins were built, speed, height and rate of height.
  double moved_ = 0.0, speed_ = 0.0, top_ = 0.0, rise_ = 0.0, bottom_ = 0.0, sink_ = 0.0;
};

}  // namespace standoff::particles
