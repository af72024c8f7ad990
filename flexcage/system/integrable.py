"""What integrators advance: compiled functions over one tuple of data (bearing or machine)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from numba import types

from flexcage.core.jit import OPTIONS, allocating_kernel, compiled, entry_of
from flexcage.core.kernel_values import KernelType
from flexcage.solve import runge_kutta
from flexcage.solve.contract import Integrator
from flexcage.solve.oscillators import Oscillators

ITERATIONS = 40  # of the spectral radius
NUDGE = 5e-12  # [m] over which it takes differences
REAL, COUNT = types.float64, types.int64
VECTOR, MATRIX = types.Array(types.float64, 1, "C"), types.Array(types.float64, 2, "C")


class Integrable(ABC):
    """A problem whose functions are compiled when an integrator first asks for them.

    ``data_type`` is numba's type of ``args``, what the functions take as their data; ``modes`` are
    the unknowns that swing by themselves, ``quads`` so many powers that are integrated.
    """

    data_type: Any
    quads: int

    @property
    @abstractmethod
    def size(self) -> int:
        """So many unknowns."""

    @abstractmethod
    def work_weights(self, length: float) -> np.ndarray:
        """1/(allowed local error) of the work of every power for a position error of ``length``."""

    @abstractmethod
    def cheaper(self, step: float, least: float) -> str:
        """The integrator that "auto" takes where explicit steps up to ``step`` [s] are stable;
        ``least`` is ``solver.stable_step``."""

    @abstractmethod
    def corners(self, begin: float, end: float) -> np.ndarray:
        """Times in [begin, end) at which the slope of what drives the problem jumps."""

    def __init__(self) -> None:
        self._functions: dict[str, Any] = {}
        self._advance: dict[str, Any] = {}
        self._radius: Any = None

    @property
    @abstractmethod
    def args(self) -> tuple:
        """What the compiled functions take as their data."""

    @property
    @abstractmethod
    def modes(self) -> Oscillators:
        """Which unknowns are linear oscillators but for what drives them."""

    @abstractmethod
    def source(self, name: str) -> Callable[..., Any]:
        """The function of that name, in Python."""

    @abstractmethod
    def types_of(self, name: str) -> tuple[Any, ...]:
        """numba's types of its result and its arguments; None: the data."""

    @abstractmethod
    def error_weights(self, length: float, *, implicit: bool = False) -> np.ndarray:
        """1/(allowed local error) of y for a position error of ``length`` [m]; 0: not tested."""

    def signature(self, name: str) -> Any:
        """numba's signature of a function."""
        result, *arguments = self.types_of(name)
        return result(*(self.data_type if a is None else a for a in arguments))

    def function(self, name: str) -> Any:
        """A function, compiled when first asked for."""
        if name not in self._functions:
            self._functions[name] = compiled(self.source(name), self.signature(name))
        return self._functions[name]

    def functions(self, integrator: Integrator) -> tuple[Any, ...]:
        """The functions that an integrator takes, in its order."""
        return tuple(self.function(name) for name in integrator.functions)

    def function_types(self, integrator: Integrator) -> Any:
        """numba's type of that tuple."""
        return types.Tuple(tuple(KernelType(self.signature(name)) for name in integrator.functions))

    def advance(self, integrator: Integrator, state, options, t_end, times, ys, yds, first, log,
                quads) -> tuple[int, int, int]:  # fmt: skip
        """``integrator.advance``, compiled for this problem when first called."""
        function = self.advance_of(integrator, state, options)
        return function(
            self.functions(integrator), self.args, state, options, t_end, times, ys, yds, first,
            log, quads,
        )  # fmt: skip

    def advance_of(self, integrator: Integrator, state, options) -> Any:
        """It, compiled for a state and options of these types."""
        if integrator.name not in self._advance:
            signature = types.Tuple((COUNT, COUNT, COUNT))(
                self.function_types(integrator), self.data_type, numba.typeof(state),
                numba.typeof(options), REAL, VECTOR, MATRIX, MATRIX, COUNT, MATRIX, MATRIX,
            )  # fmt: skip
            self._advance[integrator.name] = self._compiled(integrator, "advance", signature)
        return self._advance[integrator.name]

    def stable_step(self, t: float, y: np.ndarray, yd: np.ndarray) -> float:
        """Largest step [s] that the explicit method bears at (t, y)."""
        method = runge_kutta.EXPLICIT_METHOD
        weight = self.error_weights(NUDGE)
        state = method.new_state(
            t, y, yd, weight=weight, h0=1.0, quad_weight=np.zeros(self.quads), modes=self.modes
        )
        function = self.radius_of(state)
        radius = function(self.functions(method), self.args, state, ITERATIONS, 1.0)
        return runge_kutta.REACH / radius if radius > 0.0 else np.inf

    def radius_of(self, state) -> Any:
        """The spectral radius's function, compiled for a state of this type."""
        if self._radius is None:
            method = runge_kutta.EXPLICIT_METHOD
            signature = REAL(
                self.function_types(method), self.data_type, numba.typeof(state), COUNT, REAL
            )
            self._radius = self._compiled(method, "spectral_radius", signature)
        return self._radius

    def _compiled(self, integrator: Integrator, name: str, signature: Any) -> Any:
        """A function of an integrator's module, compiled after those that it calls.

        The integrator is plain Python that knows no compiler; so each of its helpers is replaced in
        its module by the compiled one, which a caller then finds under its name.
        """
        module = integrator.advance.__globals__
        function = integrator.advance if name == "advance" else module[name]
        for helper in integrator.helpers:
            if not hasattr(module[helper], "py_func"):
                module[helper] = allocating_kernel(module[helper])
        return entry_of(compiled(getattr(function, "py_func", function), signature, OPTIONS))
