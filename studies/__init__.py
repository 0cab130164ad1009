"""The studies: one file for each figure or group of equations; parameters, compute, draw, judge."""
