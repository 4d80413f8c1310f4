"""Our particle swarm and genetic algorithm beside pyswarms' and pymoo's.

    cargo build --release -p sonarfleet-cli
    cargo build --release -p sonarfleet --example starting_layouts
    python compare_metaheuristics.py TARGET/release INSTANCE.npz… [--seeds 3] [--share 1]

Everybody gets the paper's settings, the same starting layouts (of the example
`starting_layouts`), the same number of evaluated layouts and the same score,
R = J_d - 30 max(0, tau - lambda_2). The score is computed here from the file's
losses with NumPy, independently of the program, and each layout that the program
returns is checked against it. Kept is the best feasible layout or, where none
was seen, that with the highest R. Prints a table in Markdown: medians over the seeds.

`--share 0.1` runs a tenth of the paper's iterations. Needs numpy, scipy, pyswarms, pymoo.
"""

import argparse
import json
import logging
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from pymoo.algorithms.soo.nonconvex.ga import GA
from pymoo.core.problem import Problem
from pymoo.core.repair import Repair
from pymoo.core.survival import Survival
from pymoo.operators.crossover.sbx import SBX
from pymoo.operators.crossover.ux import UX
from pymoo.operators.mutation.bitflip import BitflipMutation
from pymoo.operators.mutation.pm import PM
from pymoo.optimize import minimize
from pyswarms.single import GlobalBestPSO
from pyswarms.utils import Reporter
from scipy.special import erfc, erfcinv

MULTIPLIER = 30.0
PARTICLES, ITERATIONS = 30, 2000
POPULATION, GENERATIONS, CROSSOVER, MUTATION, ELITISM = 100, 500, 0.8, 0.15, 0.1

# The program's λ₂ and ours, both exact to rounding.
TOLERANCE = 1e-8


class Placement:
    """The problem of an instance file, Eqs. (3) to (10), for many layouts at a time."""

    def __init__(self, path):
        archive = np.load(path)
        loss_db, self.prior = archive["tl"].astype(float), archive["prior"].ravel()
        p = json.loads(bytes(archive["params"]))
        self.columns, self.rows, self.vehicles, self.threshold = p["nx"], p["ny"], p["G"], p["tau"]
        snr_db = p["SL"] - loss_db - p["NL"] + p.get("DI", 0.0)
        shift = np.sqrt(2 * 10 ** (snr_db / 10))
        argument = np.sqrt(2) * erfcinv(2 * p["P_FA"]) - shift
        with np.errstate(divide="ignore"):
            self.log_miss = np.log1p(-0.5 * erfc(argument / np.sqrt(2)))
        ratio = 10 ** ((p["SLc"] - loss_db - p["NLc"]) / 10)
        success = (1 - 0.5 * erfc(np.sqrt(ratio))) ** p["packet_bits"]
        self.link = np.minimum(success, success.T)
        np.fill_diagonal(self.link, 0)
        # For each cell all cells, the nearest first.
        column, row = np.meshgrid(np.arange(self.columns), np.arange(self.rows))
        at = np.stack([column.ravel(), row.ravel()], axis=1)
        distance = ((at[:, None] - at[None]) ** 2).sum(axis=2)
        self.nearest = np.argsort(distance, axis=1, kind="stable")
        self.centre = at + 0.5

    def evaluate(self, layouts):
        """J_d and λ₂ of each layout, [layout, vehicle]."""
        missed = np.exp(self.log_miss[layouts].sum(axis=1))
        utility = (self.prior * (1 - missed)).sum(axis=1)
        weights = self.link[layouts[:, :, None], layouts[:, None, :]]
        laplacian = -weights
        index = np.arange(self.vehicles)
        laplacian[:, index, index] = weights.sum(axis=2)
        return utility, np.maximum(np.linalg.eigvalsh(laplacian)[:, 1], 0)

    def layouts(self, coordinates):
        """Cells of coordinates [layout, 2 · vehicle]; taken ones give way to the nearest."""
        at = coordinates.reshape(len(coordinates), self.vehicles, 2)
        column = np.clip(at[:, :, 0].astype(int), 0, self.columns - 1)
        row = np.clip(at[:, :, 1].astype(int), 0, self.rows - 1)
        cells = row * self.columns + column
        for layout in cells:
            if len(set(layout)) < self.vehicles:
                taken = np.zeros(len(self.prior), bool)
                for vehicle, cell in enumerate(layout):
                    if taken[cell]:
                        order = self.nearest[cell]
                        layout[vehicle] = cell = order[~taken[order]][0]
                    taken[cell] = True
        return cells


class Judge:
    """Scores layouts and keeps the best one."""

    def __init__(self, placement):
        self.placement, self.evaluations, self.best = placement, 0, None

    def costs(self, layouts):
        utility, connectivity = self.placement.evaluate(layouts)
        reward = utility - MULTIPLIER * np.maximum(0, self.placement.threshold - connectivity)
        feasible = connectivity >= self.placement.threshold
        self.evaluations += len(layouts)
        k = np.lexsort([reward, feasible])[-1]
        found = (bool(feasible[k]), reward[k], utility[k], connectivity[k])
        if self.best is None or found > self.best:
            self.best = found
        return -reward


def pyswarms(placement, starts, seed, share):
    judge = Judge(placement)
    np.random.seed(seed)
    size = np.tile([placement.columns, placement.rows], placement.vehicles).astype(float)
    swarm = GlobalBestPSO(
        n_particles=PARTICLES,
        dimensions=len(size),
        options={"w": 0.9, "c1": 0.5, "c2": 0.3},
        bounds=(np.zeros_like(size), size),
        init_pos=placement.centre[starts[:PARTICLES]].reshape(PARTICLES, -1),
    )
    cost = lambda positions: judge.costs(placement.layouts(positions))
    swarm.optimize(cost, iters=int(ITERATIONS * share), verbose=False)
    return judge


class Elite(Survival):
    """The best tenth of the parents and the best of their children."""

    def __init__(self):
        super().__init__(filter_infeasible=False)

    def _do(self, problem, pop, n_survive=None, algorithm=None, **kwargs):
        cost, age = pop.get("F")[:, 0], pop.get("n_gen")
        order = np.argsort(cost, kind="stable")
        if algorithm is not None and algorithm.n_iter is not None and algorithm.n_iter > 1:
            young = age == algorithm.n_iter
            elite = order[~young[order]][: int(ELITISM * n_survive)]
            order = np.concatenate([elite, order[young[order]]])
        chosen = order[:n_survive]
        return pop[chosen[np.argsort(cost[chosen], kind="stable")]]


def pymoo(placement, judge, seed, share, starts, costs, **operators):
    class Layouts(Problem):
        def _evaluate(self, x, out, *args, **kwargs):
            out["F"] = costs(x)[:, None]

    limits = operators.pop("limits")
    problem = Layouts(n_var=starts.shape[1], n_obj=1, xl=limits[0], xu=limits[1])
    algorithm = GA(pop_size=POPULATION, sampling=starts, survival=Elite(), **operators)
    termination = ("n_eval", int(POPULATION * GENERATIONS * share))
    minimize(problem, algorithm, termination, seed=seed, verbose=False)
    return judge


def pymoo_coordinates(placement, starts, seed, share):
    """pymoo's operators for real variables, on the vehicles' coordinates."""
    judge = Judge(placement)
    limits = np.tile([placement.columns, placement.rows], placement.vehicles) - 1e-9
    return pymoo(
        placement,
        judge,
        seed,
        share,
        placement.centre[starts].reshape(len(starts), -1),
        lambda positions: judge.costs(placement.layouts(positions)),
        limits=(np.zeros(len(limits)), limits),
        crossover=SBX(prob=CROSSOVER),
        mutation=PM(prob=MUTATION),
    )


def pymoo_mask(placement, starts, seed, share):
    """pymoo's operators for binary variables, on the cells; as many as vehicles."""
    judge = Judge(placement)
    random = np.random.default_rng(seed)

    class Count(Repair):
        def _do(self, problem, masks, **kwargs):
            masks = masks.astype(bool)
            for mask in masks:
                surplus = mask.sum() - placement.vehicles
                changed = np.flatnonzero(mask if surplus > 0 else ~mask)
                mask[random.choice(changed, abs(surplus), replace=False)] ^= True
            return masks

    masks = np.zeros((len(starts), len(placement.prior)), bool)
    np.put_along_axis(masks, starts, True, axis=1)
    layouts = lambda masks: np.nonzero(masks)[1].reshape(len(masks), -1)
    return pymoo(
        placement,
        judge,
        seed,
        share,
        masks,
        lambda masks: judge.costs(layouts(masks)),
        limits=(0, 1),
        crossover=UX(prob=CROSSOVER),
        mutation=BitflipMutation(prob=MUTATION),
        repair=Count(),
    )


def ours(placement, method, path, seed, evaluations, programs):
    command = [programs / "sonarfleet", "place", path, "--method", method, "--seed", str(seed)]
    command += ["--samples", str(evaluations), "--json"]
    said = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    judge = Judge(placement)
    judge.costs(np.array([said["cells"]]))
    _, _, utility, connectivity = judge.best
    if not np.allclose(
        [utility, connectivity],
        [said["detection_utility"], said["algebraic_connectivity"]],
        rtol=TOLERANCE,
        atol=TOLERANCE,
    ):
        sys.exit(f"{path}: NumPy says {utility}, {connectivity}; the program {said}")
    judge.evaluations = said["evaluations"]
    return judge


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", type=Path)
    parser.add_argument("instances", type=Path, nargs="+")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--share", type=float, default=1.0)
    arguments = parser.parse_args()
    logging.disable(logging.WARNING)
    Reporter()  # sets up logging, which would otherwise be done in the first trial

    swarm = int(PARTICLES * ITERATIONS * arguments.share)
    genetic = int(POPULATION * GENERATIONS * arguments.share)
    print("| instance | starts | program | J_d | λ₂ | R | feasible | evaluations | seconds |")
    print("|---|---|---|---|---|---|---|---|---|")
    for path in arguments.instances:
        placement = Placement(path)
        for start in ("random", "feasible"):
            suffix = "-paper" if start == "random" else ""
            trials = {
                f"`particle-swarm{suffix}`": lambda starts, seed: ours(
                    placement, f"particle-swarm{suffix}", path, seed, swarm, arguments.programs
                ),
                "pyswarms, global best": lambda starts, seed: pyswarms(
                    placement, starts, seed, arguments.share
                ),
                f"`genetic{suffix}`": lambda starts, seed: ours(
                    placement, f"genetic{suffix}", path, seed, genetic, arguments.programs
                ),
                "pymoo, GA on coordinates": lambda starts, seed: pymoo_coordinates(
                    placement, starts, seed, arguments.share
                ),
                "pymoo, GA on cells": lambda starts, seed: pymoo_mask(
                    placement, starts, seed, arguments.share
                ),
            }
            for name, trial in trials.items():
                found, seconds = [], []
                for seed in range(1, arguments.seeds + 1):
                    command = [arguments.programs / "examples" / "starting_layouts", path, start]
                    command += [str(POPULATION), str(seed)]
                    said = subprocess.run(command, check=True, capture_output=True, text=True)
                    starts = np.array(json.loads(said.stdout))
                    started = time.perf_counter()
                    found.append(trial(starts, seed))
                    seconds.append(time.perf_counter() - started)
                feasible, reward, utility, connectivity = zip(*(judge.best for judge in found))
                evaluations = max(judge.evaluations for judge in found)
                print(
                    f"| {path.stem} | {start} | {name} | {statistics.median(utility):.2f}"
                    f" | {statistics.median(connectivity):.3f} | {statistics.median(reward):.2f}"
                    f" | {sum(feasible)}/{len(feasible)} | {evaluations}"
                    f" | {statistics.median(seconds):.1f} |",
                    flush=True,
                )


main()
