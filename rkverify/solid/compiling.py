"""Functions compiled when first called, one source specialised for dimension and order, kept on disk for later processes.

What a factory's arguments fix are constants of the compiled code: its short loops unroll and its small arrays live in
registers. Compiled functions run for doubles and for complex doubles, and decide on real parts. The cache on disk looks
at the file of a function and at what its factory fixed, not at other files: a compiled function calls none of another file
but the ones here. With NUMBA_DISABLE_JIT=1 the same lines are run by Python, as mutation tests do.
Long loops count in unsigned numbers (np.uintp): a signed index may be negative, and to look whether each one is costs as
much as the arithmetic.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import carray as viewed
from numba import config, njit, types
from numba.core import cgutils
from numba.extending import intrinsic

OPTIONS = {"nogil": True, "error_model": "numpy"}


def compiled(function: Callable[..., Any], **options: Any) -> Callable[..., Any]:
    """The function compiled when first called, and kept on disk for other processes where a cache can be written."""
    try:
        return njit(function, cache=True, **OPTIONS, **options)
    except RuntimeError:
        return njit(function, **OPTIONS, **options)


def _stack_memory(typing: Any, like: Any, size: Any) -> Any:
    """Memory of the calling function's own frame for `size` numbers of the type of an array's entries."""
    if not isinstance(size, types.IntegerLiteral):
        return None

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = context.get_data_type(signature.args[0].dtype)
        return cgutils.alloca_once(builder, kind, size=size.literal_value)

    return types.CPointer(like.dtype)(like, size), code


def _in_python(like: Any, size: int) -> Any:
    return np.empty(size, like.dtype)


def _as_it_is(memory: Any, size: int) -> Any:
    return memory


stack_memory: Any = _in_python if config.DISABLE_JIT else intrinsic(prefer_literal=True)(_stack_memory)
carray: Any = _as_it_is if config.DISABLE_JIT else viewed
