"""Compiled once for all processes, and loaded by nobody who does not need it."""

import subprocess
import sys

from numba import types

from rkverify.solid.compiling import _stack_memory

SHAPE = """
import numpy as np
from rkverify.solid.cloud import cloud
from rkverify.solid.compiled_shape import derivative_stage, moment_stage
from rkverify.solid.compiled_weights import kernel_stage, offset_stage, weight_stage
from rkverify.solid.shape import shape

shape(cloud([[0, 0], [1, 0], [0, 1]], 2), np.array([[0.2, 0.2]]), 1)
stages = kernel_stage, offset_stage(2, False), weight_stage(2, False), moment_stage(2, 1), derivative_stage(2, 1)
print(sum(sum(s.stats.cache_hits.values()) for s in stages), sum(sum(s.stats.cache_misses.values()) for s in stages))
"""
ONE_DIMENSION = """
import sys
import rkverify, rkverify.cli, rkverify.solid.chain, rkverify.solid.cloud
import rkverify.cli.dispersion, rkverify.stability.layers
print("numba" in sys.modules)
"""


def said(program: str) -> list[str]:
    return subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True).stdout.split()


def test_a_second_process_compiles_nothing() -> None:
    """Decides that a command line waits for the compiler once and not at every call: five stages, all from the disk."""
    said(SHAPE)
    assert said(SHAPE) == ["5", "0"]


def test_one_dimension_does_not_load_the_compiler() -> None:
    assert said(ONE_DIMENSION) == ["False"]


def test_memory_of_a_known_size_alone_is_on_the_stack() -> None:
    """A size that is no constant must be refused when a function is compiled: memory would be taken for another number."""
    like = types.Array(types.complex128, 2, "C")
    assert _stack_memory(None, like, types.int64) is None
    signature, _ = _stack_memory(None, like, types.literal(3))
    assert signature.return_type == types.CPointer(types.complex128)
