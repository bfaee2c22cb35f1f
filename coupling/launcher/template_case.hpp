#pragma once
// The case that `standoff new` writes: complete, small enough to run in a minute, every line explained.

namespace standoff::launch {

inline constexpr const char* template_case =
    R"(# A case of Standoff. Values with a dimension are texts with a unit ("3.4 mm"); a bare number there is an error.
# `standoff doc` lists all sections and keys, `standoff doc KEY` explains one, `standoff check .` finds every mistake.

[case]
title = "150 g of C-4 in dry sand, 150 mm from a steel plate"
question = "How far does the plate bulge?"
# use = ["other.toml"]         # other files that this one builds on; what is stated here wins

[charge]
explosive = "c4"               # `standoff presets`; or a table of constants of your own
mass = "150 g"                 # the radius follows from mass and density, or state it
detonator = "far pole"         # the pole away from the plate; or "centre", or a point ["0 mm", "0 mm", "178 mm"]

[soil]                         # leave the section away for a bare charge
kind = "dry"                   # "none", "dry" or "wet"; brings packing, densities and contact law
inner_radius = "30 mm"         # the cavity for the charge
outer_radius = "76.2 mm"
# friction = 0.3               # any value of the preset can be stated

[plate]
model = "plate_hex64"          # `standoff models`
material = "al6xn"             # `standoff presets`; or a table of constants of your own
size = ["406 mm", "406 mm", "3.4 mm"]
edges = "clamped"              # or "pinned", "free", "symmetry", "bolted"
surround = "rigid"             # the cover plate around it; or "open"

[run]
stand_off = "150 mm"           # charge centre to the loaded face
until = "2 ms"                 # end of the loading; then the plate is brought to rest
settle = true
seed = 1                       # another seed is another sample of the same scene
symmetry = "quarter"           # or "none"

[coupling]
scheme = "parallel"            # or "serial", the reference
window = "auto"                # time between exchanges; or "step", or a time such as "1 us"

[effects]                      # `standoff plan .` tells what is on and why; a line here overrides
# strain_rate = "off"

[observe]
interval = "5 us"              # between rows of histories.csv
snapshots = 20                 # frames for ParaView

# Levels of resolution: counts for the full scene. `--level NAME` picks one, else "coarse".
[levels.coarse]
charge = 10_000
soil = 50_000
elements = [10, 10, 1]

[levels.medium]
charge = 40_000
soil = 200_000
elements = [20, 20, 1]

# Figures to compare with, shown beside the results.
# [[references]]
# quantity = "permanent_centre_deflection_m"
# value = "38.5 mm"
# source = "test"
)";

}  // namespace standoff::launch
