"""Steps per second, updates included, of our sequential PPO and of SB3-contrib's
MaskablePPO on one problem, in turns.

    cargo build --release -p sonarfleet-learning --examples
    pip install sb3-contrib torch
    python scripts/compare_ppo.py target/release/examples/ppo_throughput INSTANCE.npz [THREADS]

Both run Table 1 of the paper: 16 environments x 256 steps, 10 epochs of minibatches of
512, the same network (900 -> 256 -> 256, shared, -> 900 + 1; the parameter counts are
compared), the same observations, masks, rewards and constants. SB3 builds separate
networks by default, so the shared layers are given to it as features extractor. Its
environment is one vectorised NumPy object, which spares it a Python call per
environment and step. Both use as many threads as are given, or as there are cores. The
first rollout of each turn is not counted. Wall time is what counts on a machine that is
idle, processor time (with one thread) on one that is not.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import gymnasium
import numpy as np
import torch
from sb3_contrib import MaskablePPO
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor
from stable_baselines3.common.vec_env import VecEnv

ENVIRONMENTS, STEPS = 16, 256
UPDATES, TURNS = 3, 3
MULTIPLIER = 5.0


class Placement(VecEnv):
    """The sequential process, all environments in one array; rewards as in Eq. (10)."""

    def __init__(self, tables):
        self.miss = 1.0 - tables["detection"]
        self.links = tables["links"]
        self.prior = tables["prior"]
        self.vehicles = int(tables["parameters"][0])
        self.threshold = tables["parameters"][1]
        cells = len(self.prior)
        super().__init__(
            ENVIRONMENTS,
            gymnasium.spaces.Box(0.0, 1.0, (cells,), np.float32),
            gymnasium.spaces.Discrete(cells),
        )
        self.layouts = np.zeros((ENVIRONMENTS, self.vehicles), np.int64)

    def reset(self):
        self.count = 0
        self.occupied = np.zeros((ENVIRONMENTS, len(self.prior)), np.float32)
        return self.occupied.copy()

    def step_async(self, actions):
        self.actions = actions

    def step_wait(self):
        everyone = np.arange(ENVIRONMENTS)
        assert not self.occupied[everyone, self.actions].any(), "a masked action"
        self.occupied[everyone, self.actions] = 1.0
        self.layouts[:, self.count] = self.actions
        self.count += 1
        rewards = np.zeros(ENVIRONMENTS, np.float32)
        infos = [{} for _ in everyone]
        ended = self.count == self.vehicles
        if ended:
            rewards[:] = [self.reward(layout) for layout in self.layouts]
            for info, observation in zip(infos, self.occupied):
                info["terminal_observation"] = observation
            observations = self.reset()
        else:
            observations = self.occupied.copy()
        return observations, rewards, np.full(ENVIRONMENTS, ended), infos

    def reward(self, layout):
        utility = self.prior @ (1.0 - self.miss[layout].prod(axis=0))
        weights = self.links[np.ix_(layout, layout)]
        laplacian = np.diag(weights.sum(axis=1)) - weights
        connectivity = np.linalg.eigvalsh(laplacian)[1]
        return utility - MULTIPLIER * max(0.0, self.threshold - connectivity)

    def env_method(self, name, *_arguments, **_keywords):
        assert name == "action_masks"
        return self.occupied == 0.0

    def has_attr(self, name):
        return name == "action_masks"

    def get_attr(self, name, indices=None):
        return [None] * ENVIRONMENTS

    def set_attr(self, name, value, indices=None):
        raise NotImplementedError

    def env_is_wrapped(self, wrapper, indices=None):
        return [False] * ENVIRONMENTS

    def close(self):
        pass


class Shared(BaseFeaturesExtractor):
    def __init__(self, space):
        super().__init__(space, 256)
        self.layers = torch.nn.Sequential(
            torch.nn.Linear(space.shape[0], 256), torch.nn.ReLU(),
            torch.nn.Linear(256, 256), torch.nn.ReLU(),
        )

    def forward(self, observations):
        return self.layers(observations)


def peer(tables):
    return MaskablePPO(
        "MlpPolicy", Placement(tables), n_steps=STEPS, batch_size=512, n_epochs=10,
        learning_rate=3e-4, gamma=0.99, gae_lambda=0.95, clip_range=0.2, ent_coef=0.01,
        vf_coef=0.5, max_grad_norm=0.5, device="cpu", seed=0,
        policy_kwargs={"net_arch": [], "features_extractor_class": Shared},
    )


def main():
    program, instance = sys.argv[1:3]
    threads = int(sys.argv[3]) if len(sys.argv) > 3 else os.cpu_count()
    torch.set_num_threads(threads)
    environment = os.environ | {"RAYON_NUM_THREADS": str(threads)}

    def run(*arguments):
        command = [program, instance, *map(str, arguments)]
        output = subprocess.run(command, check=True, capture_output=True, env=environment).stdout
        return json.loads(output)

    with tempfile.TemporaryDirectory() as folder:
        dumped = Path(folder) / "tables.npz"
        weights = run(1, dumped)["weights"]
        tables = dict(np.load(dumped))
    model = peer(tables)
    parameters = sum(weight.numel() for weight in model.policy.parameters())
    assert parameters == weights, (parameters, weights)
    print(f"{parameters} parameters on both sides, {threads} threads, torch {torch.__version__}")
    rollout = ENVIRONMENTS * STEPS
    steps = UPDATES * rollout
    turns = []
    for turn in range(TURNS):
        ours = run(UPDATES)
        model.learn(rollout, reset_num_timesteps=False)
        start, cpu_start = time.perf_counter(), time.process_time()
        model.learn(steps, reset_num_timesteps=False)
        theirs = (time.perf_counter() - start, time.process_time() - cpu_start)
        turns.append([steps / ours["seconds"], steps / theirs[0],
                      steps / ours["cpu_seconds"], steps / theirs[1]])
        print("turn {}: ours {:.0f} steps/s, MaskablePPO {:.0f}; per CPU-second {:.0f}, {:.0f}"
              .format(turn + 1, *turns[-1]), flush=True)
    for name, first in (("second", 0), ("CPU-second", 2)):
        ours, theirs = ([turn[first + side] for turn in turns] for side in (0, 1))
        ratios = [a / b for a, b in zip(ours, theirs)]
        print(f"median steps per {name}: ours {statistics.median(ours):.0f}, MaskablePPO "
              f"{statistics.median(theirs):.0f}, ratio {statistics.median(ratios):.2f} "
              f"({min(ratios):.2f} to {max(ratios):.2f})")


if __name__ == "__main__":
    main()
