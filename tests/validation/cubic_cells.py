"""Run by pvpython: are the cells of plate.pvd true cubic hexahedra in the order ParaView expects?

In the first frame the plate is flat: every cell is a box with evenly spaced points, so its interpolation at any parametric point is
the same point of the box, and its volume is that of the box. Points in a wrong order would fold the cell. Positions are 32-bit
floats: 1e-6 of the plate's size. In the last frame every cell must still have a positive Jacobian determinant in the middle.
"""
import sys

from paraview import servermanager
from paraview.simple import PVDReader, UpdatePipeline
from vtkmodules.vtkCommonCore import reference

CUBIC_HEXAHEDRON = 72  # VTK_LAGRANGE_HEXAHEDRON
PLACES = [(1 / 6, 1 / 2, 5 / 6), (1 / 3, 2 / 3, 0.1), (0.9, 0.05, 0.4), (0.5, 0.5, 0.5)]


def evaluate(cell, place):
    at, weights, part = [0.0, 0.0, 0.0], [0.0] * 64, reference(0)
    cell.EvaluateLocation(part, place, at, weights)
    return at


def jacobian(cell, step=0.05):
    rows = []
    for axis in range(3):
        ends = []
        for sign in (-1, 1):
            place = [0.5, 0.5, 0.5]
            place[axis] += sign * step
            ends.append(evaluate(cell, place))
        rows.append([(high - low) / (2 * step) for low, high in zip(*ends)])
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def frame(reader, time):
    UpdatePipeline(time, reader)
    return servermanager.Fetch(reader)


reader = PVDReader(FileName=sys.argv[1])
times = list(reader.TimestepValues)
grid = frame(reader, times[0])
size = max(abs(b) for b in grid.GetBounds())
worst = 0.0
for index in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(index)
    assert cell.GetCellType() == CUBIC_HEXAHEDRON and cell.GetNumberOfPoints() == 64, cell.GetCellType()
    low, high = cell.GetBounds()[0::2], cell.GetBounds()[1::2]
    for place in PLACES:
        expected = [a + p * (b - a) for a, b, p in zip(low, high, place)]
        worst = max([worst, *(abs(x - y) for x, y in zip(evaluate(cell, place), expected))])
assert worst < 1e-6 * size, f"a flat cell is not the box of its corners: {worst} m"
grid = frame(reader, times[-1])
least = min(jacobian(grid.GetCell(i)) for i in range(grid.GetNumberOfCells()))
assert least > 0.0, f"a cell is inside out: {least}"
names = [grid.GetCellData().GetArrayName(i) for i in range(grid.GetCellData().GetNumberOfArrays())]
for name in ("plastic_strain", "strain_rate_per_s", "von_mises_Pa", "stress_xx_Pa", "thickness_m", "temperature_K"):
    assert name in names, (name, names)
print(f"{grid.GetNumberOfCells()} cubic cells in order, off by {worst:.1e} m")
