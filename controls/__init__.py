"""Deliberate faults and mutants, run in copies of the checkout: what the checks would not notice does not count as checked."""
