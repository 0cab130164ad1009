"""Dispersion relations and stability, layer by layer: printed, as-defined, consistent, simulated."""
