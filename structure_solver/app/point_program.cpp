#include "structure_solver/app/point_program.hpp"

#include <iostream>
#include <string>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/case_reader.hpp"
#include "coupling/contract/participant_main.hpp"
#include "coupling/output/atomic_file.hpp"
#include "coupling/output/csv_table.hpp"
#include "structure_solver/materials/point_driver.hpp"
#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {
namespace {

constexpr double rates[] = {1e-3, 1.0, 1e3, 1e4};  // 1/s
constexpr double middle_rate = 1.0;
constexpr int temperatures = 7;  // from room temperature to 0.9 of the way to melting
constexpr double last_strain = 0.5;
constexpr int steps = 500, rows = 100;  // of a curve

using Curve = std::vector<PointState>;

template <Hardening Hard>
Curve trace_with(const MetalParameters& metal, RateLaw rate, const PointPath& path) {
  switch (rate) {
    case RateLaw::power:
      return trace_point<Metal<Hard, RateLaw::power, true, false>>(metal, path);
    case RateLaw::logarithmic:
      return trace_point<Metal<Hard, RateLaw::logarithmic, true, false>>(metal, path);
    case RateLaw::none:
      break;
  }
  return trace_point<Metal<Hard, RateLaw::none, true, false>>(metal, path);
}

Curve trace(const MetalParameters& metal, const MetalEffects& effects, const PointPath& path) {
  switch (effects.hardening) {
    case Hardening::power:
      return trace_with<Hardening::power>(metal, effects.rate, path);
    case Hardening::table:
      return trace_with<Hardening::table>(metal, effects.rate, path);
    case Hardening::none:
      break;
  }
  return trace_with<Hardening::none>(metal, effects.rate, path);
}

std::string flow_curves(const CaseSpec& spec) {
  const MetalEffects effects = metal_effects(spec);
  if (!effects.plasticity) throw Stop(ExitCode::bad_case, "the material does not yield: it has no flow curve");
  const MetalParameters metal = metal_parameters(spec.plate.material);
  const double room = metal.flow.room_temperature, melting = metal.flow.melting_temperature;
  std::vector<std::vector<double>> table;
  const auto add = [&](double rate, double temperature, bool heated) {
    const Curve curve = trace(metal, effects, {rate, last_strain, steps, temperature, !heated});
    for (std::size_t i = steps / rows - 1; i < curve.size(); i += steps / rows)
      table.push_back(
          {curve[i].plastic_strain, rate, temperature, heated ? 1.0 : 0.0, curve[i].stress, curve[i].temperature});
  };
  for (const double rate : rates) {
    add(rate, room, false);
    if (effects.heating) add(rate, room, true);
  }
  for (int i = 1; i < temperatures; ++i)
    add(middle_rate, room + 0.9 * (melting - room) * i / (temperatures - 1), false);
  return csv_text({"plastic_strain", "rate_per_s", "start_temperature_K", "heated", "stress_Pa", "temperature_K"},
                  table);
}

}  // namespace

bool asks_for_point(int argc, char** argv) {
  return argc > 1 && std::string(argv[1]) == "point";
}

int point_program(int argc, char** argv) {
  return participant_main("standoff-structure point", [&] {
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
      throw Stop(ExitCode::bad_case, "this processor has no AVX2 and FMA instructions, which Standoff needs");
    const std::vector<std::string> words(argv + 2, argv + argc);
    if (words.size() != 4 || words[0] != "--case" || words[2] != "--out")
      throw Stop(ExitCode::bad_case, "usage: standoff-structure point --case CASE.toml --out FOLDER");
    const CaseRead read = read_case(words[1], {});
    for (const std::string& error : read.errors) std::cerr << error << '\n';
    if (!read.errors.empty()) throw Stop(ExitCode::bad_case, fmt::format("{} errors in the case", read.errors.size()));
    write_atomically(words[3] + "/flow_curves.csv", flow_curves(read.spec));
  });
}

}  // namespace standoff::structure
