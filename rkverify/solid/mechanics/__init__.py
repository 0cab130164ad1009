"""Solids made of nodes: the Lagrangian and the semi-Lagrangian equations in one to three dimensions, statics and dynamics.

Vectors of nodal values have the shape (N, d). Matrices act on them component after component, `flat` (d N,).
"""
