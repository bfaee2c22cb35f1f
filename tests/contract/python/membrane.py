#!/usr/bin/python3
"""A third-party structure: the plate as a membrane at its yield tension N = A t, a net of nodes that moves along z.

    m w'' = f + sum over bonds k (w_j - w_i),   k = N * (width that the bond carries) / (its length)

A thin clamped plate far beyond its bending range carries load like this until the time of its largest deflection; it never
unloads plastically, so only the way to the peak means something. Run it with

    standoff run cases/borvik_2011/dry_150mm --structure "exec:tests/contract/python/membrane.py"
"""
import argparse
import json
import math
import sys
import tomllib

import numpy

from wire import participant


def number(text):
    return float(str(text).split()[0])  # resolved cases are in SI


class Membrane:
    def __init__(self, case):
        plate, self.quarter = case["plate"], case["run"]["symmetry"] == "quarter"
        self.copies = 4 if self.quarter else 1
        lx, ly, thickness = map(number, plate["size"])
        cells = [3 * n // (2 if self.quarter else 1) for n in plate["elements"][:2]]
        x, y = (numpy.linspace(0.0 if self.quarter else -0.5 * size, 0.5 * size, n + 1)
                for size, n in zip((lx, ly), cells))
        hx, hy = x[1] - x[0], y[1] - y[0]
        width = [numpy.full(n + 1, h) for n, h in zip(cells, (hx, hy))]
        for w in width:
            w[[0, -1]] *= 0.5
        tension = number(plate["material"]["A"]) * thickness
        self.kx = tension * width[1][:, None] / hx  # bonds along x, rows of y
        self.ky = tension * width[0][None, :] / hy
        self.mass = number(plate["material"]["density"]) * thickness * numpy.outer(width[1], width[0])
        self.free = numpy.ones_like(self.mass)
        self.free[:, -1] = self.free[-1, :] = 0.0
        if not self.quarter:
            self.free[:, 0] = self.free[0, :] = 0.0
        self.rest = numpy.stack([*numpy.meshgrid(x, y), numpy.zeros_like(self.mass)], axis=-1).reshape(-1, 3)
        first = (numpy.arange(cells[1])[:, None] * len(x) + numpy.arange(cells[0])).reshape(-1, 1)
        self.quads = first + numpy.array([0, 1, len(x) + 1, len(x)])  # counter-clockwise seen from the charge
        limit = 0.9 / math.sqrt(tension / (self.mass[1, 1] / (hx * hy)) * (1 / hx**2 + 1 / hy**2))
        # A long window would be stable too, but the particles would meet a surface that is not yet where it should be:
        # one passage of a wave through the thickness and back is what the mass of a node stands for.
        material = plate["material"]
        self.step = min(limit, 2 * thickness / math.sqrt(number(material["youngs_modulus"]) / number(material["density"])))
        self.centre = (0, 0) if self.quarter else (len(y) // 2, len(x) // 2)
        self.w, self.v = numpy.zeros_like(self.mass), numpy.zeros_like(self.mass)
        self.received, self.supports, self.work, self.gap, self.steps = numpy.zeros(3), numpy.zeros(3), 0.0, 0.0, 0

    def bonds(self):
        along_x, along_y = self.kx * numpy.diff(self.w, axis=1), self.ky * numpy.diff(self.w, axis=0)
        force = numpy.zeros_like(self.w)
        force[:, :-1] += along_x
        force[:, 1:] -= along_x
        force[:-1] += along_y
        force[1:] -= along_y
        return force

    def kick(self, load, dt):
        force = load + self.bonds()
        self.v += dt * self.free * force / self.mass
        self.supports[2] -= dt * ((1.0 - self.free) * force).sum()

    def advance(self, force, window):
        load, before = force[:, 2].reshape(self.w.shape), self.w.copy()
        count = max(1, math.ceil(window / self.step))
        for _ in range(count):
            self.kick(load, 0.5 * window / count)
            self.w += window / count * self.v
            self.kick(load, 0.5 * window / count)
        self.steps += count
        self.received += window * force.sum(axis=0)
        self.supports[:2] -= window * force.sum(axis=0)[:2]  # it cannot move in its plane
        self.work += (load * (self.w - before)).sum()
        self.gap = max(self.gap, abs(self.kinetic() + self.elastic() - self.work))

    def kinetic(self):
        return 0.5 * (self.mass * self.v**2).sum()

    def elastic(self):
        return 0.5 * ((self.kx * numpy.diff(self.w, axis=1) ** 2).sum() + (self.ky * numpy.diff(self.w, axis=0) ** 2).sum())

    def motion(self):
        position, velocity = self.rest.copy(), numpy.zeros_like(self.rest)
        position[:, 2], velocity[:, 2] = self.w.ravel(), self.v.ravel()
        return position, velocity

    def row(self):
        return {"centre_deflection_m": -self.w[self.centre], "plate_kinetic_J": self.copies * self.kinetic(),
                "plate_elastic_J": self.copies * self.elastic(), "external_work_J": self.copies * self.work}

    def report(self, peak, peak_work, link):
        momentum = numpy.array([0.0, 0.0, (self.mass * self.v).sum()])
        residual = momentum - self.received - self.supports
        scale = sum(numpy.linalg.norm(p) for p in (momentum, self.received, self.supports))
        return {"results": {"peak_centre_deflection_m": peak},
                "conservation": {"momentum_residual_Ns": residual.tolist(), "impulse_scale_Ns": scale,
                                 "energy_error_structure": self.gap / peak_work if peak_work > 0.0 else 0.0},
                "counts": {"simulated_surface_nodes": len(self.rest), "structure_steps": self.steps},
                "timing": {"structure": {"compute_s": link.compute, "wait_s": link.wait}}}


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("--case", "--connect", "--token"):
        options.add_argument(name, required=True)
    given, _ = options.parse_known_args()  # --out and --threads: it writes no files and has one thread
    with open(given.case, "rb") as file:
        case = tomllib.load(file)

    def body(link):
        plate, interval = Membrane(case), number(case["observe"]["interval"])
        link.offer_surface(plate.rest, plate.quads, plate.mass)
        clock = link.ready(plate.step)
        peak = peak_work = 0.0
        rows = 1
        link.sample(0.0, plate.row())
        for grant, force in link.windows():
            plate.advance(force, clock.window)
            peak, peak_work = max(peak, -plate.w[plate.centre]), max(peak_work, plate.work)
            end = grant.begin + clock.window
            if not grant.drain and end + 0.5 * clock.window >= rows * interval:
                link.sample(end, plate.row())
                rows = int((end + 0.5 * clock.window) / interval) + 1
            link.advance(*plate.motion(), plate.received, plate.work)
        link.finish(json.dumps(plate.report(peak, peak_work, link)))

    return participant(body, given.connect, given.token)


if __name__ == "__main__":
    sys.exit(main())
