"""Run by pvpython: `solid_cells.py plate.pvd NODES`. Are the hexahedra with NODES points (64, 27 or 8) in the order ParaView expects?

In the first frame the plate is flat: every cell is a box with evenly spaced points, so its interpolation at any parametric point is
the same point of the box, and ParaView's filter CellSize gives the volume of that box. Points in a wrong order would fold the cell.
Positions are 32-bit floats: 1e-6 of the plate's size, and of the volume three times its share in the shortest edge, the thickness.
In the last frame every cell must still have a positive volume, and a positive Jacobian determinant in the middle.
"""
import sys

from paraview import servermanager
from paraview.simple import CellSize, PVDReader, UpdatePipeline
from vtkmodules.vtkCommonCore import reference

CELL_TYPE = {64: 72, 27: 72, 8: 12}  # VTK_LAGRANGE_HEXAHEDRON of order 3 and 2, VTK_HEXAHEDRON
PLACES = [(1 / 6, 1 / 2, 5 / 6), (1 / 3, 2 / 3, 0.1), (0.9, 0.05, 0.4), (0.5, 0.5, 0.5)]


def evaluate(cell, place):
    at, weights, part = [0.0, 0.0, 0.0], [0.0] * cell.GetNumberOfPoints(), reference(0)
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


def volumes(reader, time):
    """Of each cell, as ParaView's own filter has it."""
    sized = CellSize(Input=reader)
    column = frame(sized, time).GetCellData().GetArray("Volume")
    return [column.GetValue(i) for i in range(column.GetNumberOfTuples())]


path, nodes = sys.argv[1], int(sys.argv[2])
reader = PVDReader(FileName=path)
times = list(reader.TimestepValues)
grid = frame(reader, times[0])
size = max(abs(b) for b in grid.GetBounds())
worst = worst_volume = 0.0
for index, volume in enumerate(volumes(reader, times[0])):
    cell = grid.GetCell(index)
    assert cell.GetCellType() == CELL_TYPE[nodes] and cell.GetNumberOfPoints() == nodes, cell.GetCellType()
    low, high = cell.GetBounds()[0::2], cell.GetBounds()[1::2]
    edges = [b - a for a, b in zip(low, high)]
    for place in PLACES:
        expected = [a + p * edge for a, p, edge in zip(low, place, edges)]
        worst = max([worst, *(abs(x - y) for x, y in zip(evaluate(cell, place), expected))])
    box = edges[0] * edges[1] * edges[2]
    worst_volume = max(worst_volume, abs(volume / box - 1.0) * min(edges) / size)
assert worst < 1e-6 * size, f"a flat cell is not the box of its corners: {worst} m"
assert worst_volume < 3e-6, f"a flat cell has not the volume of the box of its corners: {worst_volume}"
grid = frame(reader, times[-1])
least = min(jacobian(grid.GetCell(i)) for i in range(grid.GetNumberOfCells()))
assert least > 0.0 and min(volumes(reader, times[-1])) > 0.0, f"a cell is inside out: {least}"
names = [grid.GetCellData().GetArrayName(i) for i in range(grid.GetCellData().GetNumberOfArrays())]
for name in ("plastic_strain", "strain_rate_per_s", "von_mises_Pa", "stress_xx_Pa", "thickness_m", "temperature_K"):
    assert name in names, (name, names)
print(f"{grid.GetNumberOfCells()} cells of {nodes} points in order, off by {worst:.1e} m, volume within {worst_volume:.1e}")
