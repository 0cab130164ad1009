"""The stored notebooks' solutions."""

import importlib.util
from collections.abc import Callable
from types import ModuleType

import pytest

from rkverify.paths import checkout


@pytest.fixture(scope="session")
def solutions() -> Callable[[str], ModuleType]:
    """solutions(NAME): the module notebooks/solutions/NAME.py."""

    def load(name: str) -> ModuleType:
        path = checkout().root / "notebooks" / "solutions" / f"{name}.py"
        spec = importlib.util.spec_from_file_location(f"solutions_{name}", path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return load
