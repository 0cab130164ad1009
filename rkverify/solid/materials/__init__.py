"""Constitutive laws at many points at once: deformation gradients F (n, d, d) to stresses, tangents and energies.

One law per module, all with the protocol of `law`: hyperelastic (`saint_venant_kirchhoff`, `neo_hookean`,
`linear_elastic`), incremental (`small_strain`, `jaumann`, `truesdell`) and plastic (`j2`, over any incremental law). In two
dimensions plane strain and in one dimension uniaxial strain: what is not in F stays undeformed. Only `linear_elastic` offers
plane stress. All take complex F, for complex steps; decisions look at the real part.
"""
