#include "coupling/case/plate_checks.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "coupling/case/scene_findings.hpp"
#include "coupling/case/structural_models.hpp"

namespace standoff {
namespace {

class PlateCheck : private SceneFindings {
 public:
  using SceneFindings::SceneFindings;

  void run() {
    const PlateSpec& p = spec_.plate;
    const Paths mesh{"plate.elements", "run.symmetry"};
    if (usable(mesh))
      finding(!p.is_pipe() && spec_.run.quarter_symmetry && (p.elements[0] % 2 != 0 || p.elements[1] % 2 != 0), mesh,
              fmt::format("quarter symmetry needs even numbers of elements along x and y, not {} and {}", p.elements[0],
                          p.elements[1]),
              "elements are counted over the full plate; the mirror planes cut it in halves");
    model(p), held(p);
    if (p.is_pipe()) pipe();
    const Paths heat{"plate.material.melting_temperature", "plate.material.room_temperature"};
    if (usable(heat))
      finding(p.material.melting_temperature <= p.material.room_temperature, heat,
              fmt::format("melting_temperature {} K is not above room_temperature {} K", p.material.melting_temperature,
                          p.material.room_temperature),
              "strength falls from room to melting temperature");
    if (p.material.law == MaterialLaw::j2_table) flow_table(p.material);
    const Paths cover{"plate.surround_size", "plate.size"};
    if (usable(cover))
      finding(p.surround == "rigid" && p.surround_size < std::max(p.size.x, p.size.y) * (1.0 - touching), cover,
              fmt::format("the wall around the plate is smaller than the plate: surround_size {}, plate {} by {}",
                          mm(p.surround_size), mm(p.size.x), mm(p.size.y)),
              "surround_size is the outer side of the cover plate; surround = \"open\" leaves it out");
  }

  /// What the model cannot stand for.
  void model(const PlateSpec& p) {
    const Paths square{"plate.size", "plate.model"}, layers{"plate.elements", "plate.model"};
    if (usable(square))
      finding(p.model == "single_dof" && p.size.x != p.size.y, square,
              fmt::format("single_dof is a square plate, not one of {} by {}", mm(p.size.x), mm(p.size.y)),
              "make the sides equal, or choose plate_hex64");
    if (usable(layers))
      finding(p.model == "plate_shell" && p.elements[2] != 1, layers,
              fmt::format("a shell has one element through the thickness, not {}", p.elements[2]),
              "its five layers are inside: give 1, or choose plate_hex64");
  }

  void held(const PlateSpec& p) {
    const Paths known{"plate.edges", "plate.model"};
    const StructuralModelEntry& model = structural_model(p.model);
    if (usable(known) && !is_one_of(p.edges, model.edges))
      return finding(true, known, fmt::format("{} does not know edges = \"{}\"", p.model, p.edges),
                     fmt::format("edges with this model: {}; `standoff models` lists those of all", model.edges));
    const Paths frame{"plate.opening", "plate.size", "plate.edges"};
    if (p.edges == "bolted" && usable(frame))
      finding(p.opening >= std::min(p.size.x, p.size.y) * (1.0 - touching), frame,
              fmt::format("the frame does not reach the plate: opening {}, plate {} by {}", mm(p.opening), mm(p.size.x),
                          mm(p.size.y)),
              "size is that of the whole plate, rim included; the opening is the part that can bulge");
    const Paths rest{"plate.edges", "run.settle"};
    const bool flies = p.edges == "free" || (p.edges == "symmetry" && !p.is_pipe());
    if (usable(rest))
      finding(flies && p.model != "rigid_plate" && spec_.run.settle, rest,
              fmt::format("a plate with edges = \"{}\" flies on and never comes to rest", p.edges),
              "run.settle = false ends the run while it moves");
  }

  void pipe() {
    const PlateSpec& p = spec_.plate;
    const Paths mesh{"plate.elements", "plate.model"};
    if (usable(mesh))
      finding(
          p.elements[0] % 4 != 0, mesh,
          fmt::format("{} elements round the pipe do not fill four equal quarters", p.elements[0]),
          "elements are counted round the full pipe, along it and through its wall: make the first a multiple of 4");
    const int layer =
        p.elements[0] / 4 * p.elements[1];  // of a quarter; four elements of one layer are computed at once
    if (usable(mesh))
      finding(
          p.elements[2] > 1 && layer % 4 != 0, mesh,
          fmt::format("{} elements in a layer of the quarter do not fill fours", layer),
          "with several elements through the wall, a quarter of those round times those along must be a multiple of 4");
    finding(!spec_.run.quarter_symmetry, {"run.symmetry", "plate.model"}, "a pipe is computed as a quarter",
            "run.symmetry = \"quarter\"");
    finding(spec_.soil.kind != SoilKind::none, {"soil.kind", "plate.model"}, "a pipe holds no sand",
            "soil.kind = \"none\"");
    const Paths along{"observe.probes", "plate.pipe.length"};
    if (usable(along))
      finding(std::ranges::any_of(spec_.observe.probes, [&](double z) { return z > p.pipe.length; }), along,
              fmt::format("a probe lies beyond the end of the pipe, {}", mm(p.pipe.length)),
              "probes are places along the axis, from z = 0");
  }

  void flow_table(const MaterialSpec& m) {
    const Paths table{"plate.material.plastic_strain", "plate.material.flow_stress"};
    if (!usable(table)) return;
    const auto &strain = m.plastic_strain, &stress = m.flow_stress;
    finding(strain.size() != stress.size(), table,
            fmt::format("the table has {} plastic strains but {} flow stresses", strain.size(), stress.size()),
            "each plastic strain has its flow stress");
    finding(strain.size() > 32, {table[0]}, fmt::format("a table of {} points; at most 32 are kept", strain.size()),
            "straight lines between fewer points will do");
    finding(strain.front() != 0.0, {table[0]}, fmt::format("the table starts at plastic strain {}", strain.front()),
            "the first point is the initial yield stress, at plastic strain 0");
    const auto falls = [](double a, double b) { return b < a; };
    const auto stays = [](double a, double b) { return b <= a; };
    finding(std::ranges::adjacent_find(strain, stays) != strain.end(), {table[0]},
            "the plastic strains of the table do not rise from point to point", "list the points in order");
    finding(std::ranges::adjacent_find(stress, falls) != stress.end(), {table[1]},
            "the flow stress of the table falls somewhere",
            "softening without a length scale depends on the mesh; heat softens by melting_temperature");
  }
};

}  // namespace

void check_plate(const CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics) {
  PlateCheck(spec, settings, diagnostics).run();
}

}  // namespace standoff
