"""Time of one RK4 step of the reduced piston, compiled from Python by numba.

The same modes, start and steps as benches/reduced_piston.rs, the same prefix tables and cut cell:
what a careful Python programmer gets. Needs numpy and numba; run with

    python bench/numba_piston.py
"""

import time

import numpy as np
from numba import njit

NU, C_F, LENGTH, NODES = 0.2, 1.0, 1.1, 401
MASS, STIFFNESS, DAMPING, REST = 0.5, 39.5, 0.1, 0.95
SIGMA, BETA = 100.0, 50.0
STEPS, DT = 1000, 1e-4
MULTIPLIER, PENALTY, MAPPED = 0, 1, 2


def grid_modes(count):
    """Gram and Schmidt in the P1 mass matrix: a kink at 0.95 m and sines before it."""
    h = LENGTH / (NODES - 1)
    xi = np.minimum(np.arange(NODES) * h / 0.95, 1.0)

    def product(f, g):
        ends = 2 * (f[:-1] * g[:-1] + f[1:] * g[1:]) + f[:-1] * g[1:] + f[1:] * g[:-1]
        return h / 6 * ends.sum()

    modes = []
    for k in range(count):
        mode = xi.copy() if k == 0 else np.sin(k * np.pi * xi)
        for earlier in modes:
            mode -= product(earlier, mode) * earlier
        modes.append(mode / np.sqrt(product(mode, mode)))
    return np.array(modes).T.copy()


def pairs(n):
    return [(m, p) for m in range(n) for p in range(m, n)]


def grid_tables(count):
    """Values, int phi, int phi' phi' over all, and the prefix table of convection."""
    h, phi = LENGTH / (NODES - 1), grid_modes(count)
    left, rise = phi[:-1], np.diff(phi, axis=0)
    integral = np.vstack([np.zeros(count), np.cumsum(h * (left + rise / 2), axis=0)])
    convection = np.zeros((NODES, len(pairs(count)), count))
    for k, (m, p) in enumerate(pairs(count)):
        linear = left[:, m] * rise[:, p] + left[:, p] * rise[:, m]
        square = rise[:, m] * rise[:, p]
        cell = left * (linear + square)[:, None] + rise * (linear / 2 + 2 / 3 * square)[:, None]
        convection[1:, k] = np.cumsum((0.5 if m == p else 1.0) * cell, axis=0)
    return phi, integral, rise.T @ rise / h, convection


def reference_tensors(count, cells=800):
    """Moments, stiffness and convection of sines, interpolated on P1 elements."""
    h = 1 / cells
    nodes = np.linspace(0, 1, cells + 1)
    angle = np.pi * np.arange(1, count + 1)
    phi = np.sqrt(2 / ((2 + np.cos(angle * h)) / 3)) * np.sin(np.outer(nodes, angle))
    left, rise = phi[:-1], np.diff(phi, axis=0)
    start = nodes[:-1, None]
    moment = (h * (start * (left + rise / 2) + h * (left / 2 + rise / 3))).sum(axis=0)
    convection = np.zeros((len(pairs(count)), count))
    for k, (m, p) in enumerate(pairs(count)):
        linear = left[:, m] * rise[:, p] + left[:, p] * rise[:, m]
        square = rise[:, m] * rise[:, p]
        cell = left * (linear + square)[:, None] + rise * (linear / 2 + 2 / 3 * square)[:, None]
        convection[k] = (0.5 if m == p else 1.0) * cell.sum(axis=0)
    return moment, rise.T @ rise / h, convection


@njit(cache=False)
def contract(tensor, a, out):
    n = a.size
    for i in range(n):
        out[i] = 0.0
    k = 0
    for m in range(n):
        for p in range(m, n):
            q = a[m] * a[p]
            for i in range(n):
                out[i] -= q * tensor[k, i]
            k += 1


@njit(cache=False)
def grid_rates(kind, phi, integral, stiffness, convection, y, dy):
    n = y.size - 2
    x, v = y[n], y[n + 1]
    h = LENGTH / (phi.shape[0] - 1)
    cell = min(max(int(np.ceil(x / h)) - 1, 0), phi.shape[0] - 2)
    t = x / h - cell
    contract(convection[cell], y[:n], dy[:n])
    left, rise = 0.0, 0.0
    for i in range(n):
        left += y[i] * phi[cell, i]
        rise += y[i] * (phi[cell + 1, i] - phi[cell, i])
    flat = rise * t * (left + 0.5 * rise * t)
    slanted = rise * t * t * (0.5 * left + rise * t / 3)
    square, through, drive = 0.0, 0.0, 0.0
    for i in range(n):
        low, up = phi[cell, i], phi[cell + 1, i] - phi[cell, i]
        viscous = 0.0
        for m in range(n):
            viscous += stiffness[i, m] * y[m]
        dy[i] -= low * flat + up * slanted + NU * viscous
        at = low + t * up
        solid = integral[-1, i] - integral[cell, i] - h * t * (low + 0.5 * t * up)
        square += at * at
        through += at * solid
        drive += at * dy[i]
    free = (-STIFFNESS * (x - REST) - DAMPING * v) / MASS
    slip = left + t * rise - v
    if kind == MULTIPLIER:
        rate = drive + (through - 1) * free + v * rise / h + BETA * slip
        traction = -rate / (square + (1 - through) * C_F / MASS)
    else:
        traction = -SIGMA * slip
    acceleration = free - C_F * traction / MASS
    for i in range(n):
        low, up = phi[cell, i], phi[cell + 1, i] - phi[cell, i]
        solid = integral[-1, i] - integral[cell, i] - h * t * (low + 0.5 * t * up)
        dy[i] += acceleration * solid + traction * (low + t * up)
    dy[n], dy[n + 1] = v, acceleration


@njit(cache=False)
def mapped_rates(moment, stiffness, convection, y, dy):
    n = y.size - 2
    x, v = y[n], y[n + 1]
    contract(convection, y[:n], dy[:n])
    steady, square, own = 0.0, 0.0, 0.0
    for i in range(n):
        viscous = 0.0
        for m in range(n):
            viscous += stiffness[i, m] * y[m]
        dy[i] = (dy[i] - v * y[i]) / x - NU / (x * x) * viscous
        steady += moment[i] * (x * dy[i] + v * y[i]) - 0.5 * y[i] * y[i]
        square += moment[i] * moment[i]
    steady += NU * v / x
    force = -STIFFNESS * (x - REST) - DAMPING * v - C_F * steady
    acceleration = force / (MASS + C_F * x * (1 / 3 - square))
    for i in range(n):
        dy[i] -= acceleration * moment[i]
    dy[n], dy[n + 1] = v, acceleration


@njit(cache=False)
def march(kind, phi, integral, moment, stiffness, convection, y, steps, dt):
    k, total, stage = np.zeros(y.size), np.zeros(y.size), np.zeros(y.size)
    for _ in range(steps):
        for s in range(4):
            reach = 0.0 if s == 0 else (1.0 if s == 3 else 0.5)
            weight = 1.0 if s == 0 or s == 3 else 2.0
            for i in range(y.size):
                stage[i] = y[i] + reach * dt * k[i]
            if kind == MAPPED:
                mapped_rates(moment, stiffness, convection[0], stage, k)
            else:
                grid_rates(kind, phi, integral, stiffness, convection, stage, k)
            for i in range(y.size):
                total[i] = weight * k[i] + (0.0 if s == 0 else total[i])
        for i in range(y.size):
            y[i] += dt / 6 * total[i]


def case(kind, count):
    """Arguments of `march` for a projection and a number of modes."""
    if kind == MAPPED:
        moment, stiffness, convection = reference_tensors(count)
        return kind, np.zeros((2, count)), np.zeros((2, count)), moment, stiffness, convection[None]
    phi, integral, stiffness, convection = grid_tables(count)
    return kind, phi, integral, np.zeros(count), stiffness, convection


def main():
    for kind, name in [(MULTIPLIER, "multiplier"), (PENALTY, "penalty"), (MAPPED, "mapped")]:
        for count in (6, 10):
            arguments = case(kind, count)
            start = np.append(np.full(count, 0.01), [0.9, 0.0])
            times = []
            for _ in range(500):
                y = start.copy()
                begin = time.perf_counter()
                march(*arguments, y, STEPS, DT)
                times.append((time.perf_counter() - begin) / STEPS * 1e6)
            times.sort()
            print(f"{name:10} N = {count:2}: {times[0]:.3f} us a step at best, {times[250]:.3f} us "
                  f"in the middle, X({STEPS * DT:g} s) = {y[-2]:.12f} m")


if __name__ == "__main__":
    main()
