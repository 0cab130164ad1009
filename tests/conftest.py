"""Profiles of the property tests: dev (quick), ci (the same cases every time), fuzz (many, climbing), faults (few, not shrunk).

RKVERIFY_HYPOTHESIS=ci, fuzz or faults chooses one; dev is the default.
"""

import os

from hypothesis import HealthCheck, Phase, settings

slow_is_fine = (HealthCheck.too_slow, HealthCheck.filter_too_much)
settings.register_profile("dev", max_examples=25, deadline=None, suppress_health_check=slow_is_fine, database=None)
settings.register_profile(
    "ci", max_examples=60, deadline=None, suppress_health_check=slow_is_fine, database=None, derandomize=True
)
settings.register_profile(
    "faults",
    max_examples=25,
    deadline=None,
    suppress_health_check=slow_is_fine,
    database=None,
    derandomize=True,
    phases=(Phase.explicit, Phase.generate),
)
settings.register_profile(
    "fuzz",
    max_examples=2000,
    deadline=None,
    suppress_health_check=slow_is_fine,
    phases=(Phase.explicit, Phase.reuse, Phase.generate, Phase.target, Phase.shrink),
)
settings.load_profile(os.environ.get("RKVERIFY_HYPOTHESIS", "dev"))
