// Speed and memory of the explicit plate (plate_hex64), as Markdown. Every figure is measured where it is printed:
//   Gauss-point updates a second and core, elastic and flowing, from steps that are timed whole (nodes, elements,
//   books) in
//     processor time of the one thread that computes them, which others on the machine do not lengthen by waiting
//   two threads over one thread, by the clock on the wall: read it only where the load printed below is small
//   peak resident memory of a process that does nothing but step the full 40 x 40 x 1 plate
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "structure_solver/models/plate_hex64/plate_hex64.hpp"
#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace {

using namespace standoff;
using namespace standoff::structure;

/// AL-6XN, 406 mm x 406 mm x 3.4 mm [Borvik 2011, table 3], all effects on.
CaseSpec plate_case(int elements, bool elastic) {
  CaseSpec spec;
  MaterialSpec& m = spec.plate.material;
  m.density = 8060.0, m.youngs_modulus = 195e9, m.poissons_ratio = 0.3;
  m.A = 410e6, m.B = 1902e6, m.n = 0.82, m.C = 0.024, m.reference_rate = 1e-3;
  m.m = 1.03, m.room_temperature = 296.0, m.melting_temperature = 1700.0;
  m.specific_heat = 500.0, m.taylor_quinney = 0.9, m.thermal_expansion = 1.5e-5;
  if (elastic) m.law = MaterialLaw::elastic;
  spec.plate.size = {0.406, 0.406, 0.0034};
  spec.plate.elements = {elements, elements, 1};
  spec.run.quarter_symmetry = false;
  for (const char* name : {"plasticity", "hardening", "strain_rate", "heating", "expansion"})
    spec.effects.push_back({name, !elastic, "", false});
  return spec;
}

/// Every node flows outwards from the centre, v = rate x: the whole plate stretches, all of it yields.
void stretch(PlateHex64& model, double rate) {
  std::vector<double> u(static_cast<std::size_t>(model.relaxation()->dofs()), 0.0), v;
  const PlateMesh& mesh = model.plate().mesh();
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    const Vec3& x = mesh.position[i];
    if ((mesh.fixed[i] & fixed_x) == 0) v.push_back(rate * x.x);
    if ((mesh.fixed[i] & fixed_y) == 0) v.push_back(rate * x.y);
    if ((mesh.fixed[i] & fixed_z) == 0) v.push_back(-2.0 * rate * x.z);
  }
  model.relaxation()->set_state(u, v);
}

std::vector<double> strains(const PlateHex64& model) {
  std::vector<double> p;
  for (long e = 0; e < model.elements(); ++e)
    for (int q = 0; q < hex_points; ++q) p.push_back(model.plate().forces().plastic_strain(e, q));
  return p;
}

struct Speed {
  double per_core_s = 0.0, per_wall_s = 0.0;
  double flowing = 0.0;  // share of Gauss points that flowed while the clock ran
};

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Speed measure(int elements, bool elastic, int threads) {
  CaseSpec spec = plate_case(elements, elastic);
  spec.plate.edges = "free";
  PlateHex64 model(spec, threads);
  stretch(model, elastic ? 1.0 : 2e3);
  for (int i = 0; i < 40; ++i) model.step(model.stable_step());
  const std::vector<double> before = strains(model);
  constexpr int steps = 60;
  const double wall = seconds_of(CLOCK_MONOTONIC), core = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  for (int i = 0; i < steps; ++i) model.step(model.stable_step());
  const double wall_s = seconds_of(CLOCK_MONOTONIC) - wall, core_s = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - core;
  const std::vector<double> after = strains(model);
  double flowed = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) flowed += after[i] > before[i] ? 1.0 : 0.0;
  const auto points = static_cast<double>(after.size());
  return {points * steps / core_s, points * steps / wall_s, flowed / points};
}

/// The fastest of three: others use the machine, too.
Speed fastest(int elements, bool elastic, int threads) {
  Speed best;
  for (int i = 0; i < 3; ++i) {
    const Speed now = measure(elements, elastic, threads);
    best = {std::max(best.per_core_s, now.per_core_s), std::max(best.per_wall_s, now.per_wall_s), now.flowing};
  }
  return best;
}

/// Peak resident MiB of a process of its own that steps the full plate.
double peak_memory(int elements) {
  const pid_t child = fork();
  if (child == 0) {
    PlateHex64 model(plate_case(elements, false), 1);
    stretch(model, 2e3);
    for (int i = 0; i < 60; ++i) model.step(model.stable_step());
    _exit(0);
  }
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  return status == 0 ? static_cast<double>(usage.ru_maxrss) / 1024.0 : -1.0;
}

}  // namespace

int main() {
  const double memory = peak_memory(40);  // first: a child inherits what its parent holds
  std::printf("| full plate | points that flow | Gauss-point updates/s, one core | two threads over one |\n");
  std::printf("| --- | ---: | ---: | ---: |\n");
  for (const bool elastic : {false, true})
    for (const int elements : {20, 40}) {
      const Speed one = fastest(elements, elastic, 1), two = fastest(elements, elastic, 2);
      std::printf("| %s, %d x %d x 1 | %.0f %% | %.2e | %.2f |\n", elastic ? "elastic" : "plastic", elements, elements,
                  100.0 * one.flowing, one.per_core_s, two.per_wall_s / one.per_wall_s);
    }
  std::printf("\nLanes of a register: %s\n", widest_here() == Width::eight_lanes ? "8 (AVX-512)" : "4 (AVX2)");
  std::printf("Peak resident memory of the explicit phase, full plate of 40 x 40 x 1: %.0f MiB\n", memory);
  double load[1] = {0.0};
  if (getloadavg(load, 1) == 1) std::printf("Load of the machine in the last minute: %.1f\n", load[0]);
  return 0;
}
