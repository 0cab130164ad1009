"""Plane waves in a uniformly stressed plane: the semi-discrete semi-Lagrangian equations (45)-(47) at rest on periodic node sets.

    m_I u_I'' = - sum_J (df_I/dx_J) u_J,   f_iI = sum_L a_L b_jI^L sigma_ij(x_L),   u_J = u e^{i k . x_J}

Nodes move with their own coefficients, x_I' = v_I, so that df_I is the change of the gradients b and the measures a in the
stress that is there (the geometric part) and the change of the stress on the gradients that are there (the material part).
N v of (41) is of second order at rest. omega^2 are the eigenvalues of K(k)/m with K_IJ(k) = sum over the copies of J of
(df_I/dx_J) e^{i k . (x_J - x_I)}; density 1, lumped masses, plane strain.

`lattices` periodic node sets; `scheme`, `loading` what there is to choose; `cell_integrals` a_L b_I^L on a patch; `linearised`
their derivatives by complex steps, `linearised_paper` by duals through `paper/`; `symbol` K(k) and its modes; `continuum` what
small k should give; `degenerate` cells that meet four in a point; `zero_energy` modes without strain; `zones` wave vectors;
`clouds` finite irregular node sets; `measured` growth in nonlinear computations.
"""
