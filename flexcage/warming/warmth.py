"""What a bearing settles at, or does not: its iterations, as a frozen value with its table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import pi
from typing import Any

from flexcage.case import StaticCase
from flexcage.core.listing import aligned, wrapped
from flexcage.geometry.heat.network import TITLES, Network
from flexcage.system.statics.solution import StaticSolution

FORMAT = 1
ZERO = 273.15  # K, of degC
SETTLED, RUNAWAY, UNSETTLED = "settled", "runaway", "not settled"


@dataclass(frozen=True)
class Iteration:
    """Losses [W] by place at ``temperatures`` [K] by body, and the temperatures ``towards`` which
    the network then goes. ``film`` [K] is the oil's in contacts, ``viscosity`` [Pa s] its there;
    ``clearance`` [m] in operation; ``out`` [W] the heat that leaves by way; ``power`` [W] what
    drive and given sources put in."""

    temperatures: Mapping[str, float]
    towards: Mapping[str, float]
    film: float
    viscosity: float
    clearance: float
    losses: Mapping[str, float]
    out: Mapping[str, float]
    power: float

    @property
    def loss(self) -> float:
        """All losses [W]."""
        return float(sum(self.losses.values()))

    @property
    def change(self) -> float:
        """Largest change [K] that the network asks for."""
        return max(abs(self.towards[n] - t) for n, t in self.temperatures.items())

    @property
    def imbalance(self) -> float:
        """Heat that leaves less losses, over these, each counted positive."""
        moved = sum(map(abs, self.losses.values()))
        return (sum(self.out.values()) - self.loss) / moved if moved else 0.0


@dataclass(frozen=True, eq=False)
class Warmth:
    """What a bearing settles at. ``verdict`` is "settled", "runaway" or "not settled", ``sentence``
    says it in words; ``case`` is the one at the last temperatures, ``solution`` its static
    solution; ``network`` the last one; ``notes`` are sentences on what was left out."""

    name: str
    verdict: str
    sentence: str
    iterations: tuple[Iteration, ...]
    case: StaticCase
    solution: StaticSolution
    network: Network
    notes: tuple[str, ...] = field(default=())

    @property
    def settled(self) -> bool:
        return self.verdict == SETTLED

    @property
    def last(self) -> Iteration:
        return self.iterations[-1]

    @property
    def temperatures(self) -> Mapping[str, float]:
        """Temperatures [K] of the bodies at the end."""
        return self.last.temperatures

    def table(self, width: int = 0) -> str:
        """Iterations, losses and heat as text, in lines of at most ``width`` characters (0: as the
        terminal is wide)."""
        parts = [
            wrapped(f"{self.name}: {self.sentence}", width=width),
            aligned(iteration_lines(self), sides="r", heads=True, width=width),
            aligned(loss_lines(self), sides="lr", heads=True, width=width),
            aligned(heat_lines(self), sides="lr", heads=True, width=width),
        ]
        parts += [wrapped(f"Note: {note}", width=width) for note in self.notes]
        parts += [wrapped(f"Warning: {text}", width=width) for text in self.solution.warnings]
        return "\n\n".join(parts)

    __str__ = table

    def to_dict(self) -> dict[str, Any]:
        """Plain values in SI; temperatures in K."""
        end, lives = self.last, self.solution.lives
        return {
            "format": FORMAT, "name": self.name, "verdict": self.verdict,
            "sentence": self.sentence, "speed": self.solution.speed,
            "torque": end.power / abs(self.solution.speed),
            "conductances": {" - ".join(pair): g for pair, g in self.network.conductances.items()},
            "surroundings": dict(self.network.given),
            "life_hours": None if lives is None else lives.here.hours,
            "kappa": None if lives is None else lives.here.kappa,
            "notes": list(self.notes), "warnings": list(self.solution.warnings),
            "iterations": [
                {
                    "temperatures": dict(i.temperatures), "towards": dict(i.towards),
                    "film": i.film, "viscosity": i.viscosity, "clearance": i.clearance,
                    "losses": dict(i.losses), "out": dict(i.out), "power": i.power,
                    "change": i.change, "imbalance": i.imbalance,
                }
                for i in self.iterations
            ],
        }  # fmt: skip


def iteration_lines(warmth: Warmth) -> list[list[str]]:
    """Rows of the iterations, the first of them heads."""
    bodies = list(warmth.temperatures)
    heads = ["iteration", *(f"{TITLES[b]}, degC" for b in bodies), "oil in contacts, degC",
             "viscosity, mPa s", "clearance, um", "losses, W", "change, K"]  # fmt: skip
    rows = [
        [
            str(k + 1), *(f"{i.temperatures[b] - ZERO:.1f}" for b in bodies),
            f"{i.film - ZERO:.1f}", f"{1e3 * i.viscosity:.3g}", f"{1e6 * i.clearance:.2f}",
            f"{i.loss:.4g}", f"{i.change:.2f}",
        ]
        for k, i in enumerate(warmth.iterations)
    ]  # fmt: skip
    return [heads, *rows]


def loss_lines(warmth: Warmth) -> list[list[str]]:
    """Rows of the losses by place at the end."""
    end, speed = warmth.last, abs(warmth.solution.speed)
    rows = [
        [place, f"{loss:.4g}", f"{100.0 * loss / end.loss:.3g}" if end.loss else "-"]
        for place, loss in end.losses.items()
    ]
    torque = f"torque {1e3 * end.power / speed:.4g} N mm at {speed * 30.0 / pi:.6g} rpm"
    return [["losses", "W", "%"], *rows, [f"all; {torque}", f"{end.loss:.4g}", "100"]]


def heat_lines(warmth: Warmth) -> list[list[str]]:
    """Rows of the heat that leaves at the end."""
    end = warmth.last
    rows = [[way, f"{flow:.4g}"] for way, flow in end.out.items()]
    share = f"all, {100.0 * end.imbalance:+.2f} % of the losses"
    return [["heat that leaves", "W"], *rows, [share, f"{sum(end.out.values()):.4g}"]]
