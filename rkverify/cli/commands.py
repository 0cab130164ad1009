"""What commands there are: names, options, examples. What they do stands in modules that are imported on use."""

import importlib
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import dataclass

from rkverify.cli import bloch_options, options, own_options

Action = Callable[[Namespace], int]


@dataclass(frozen=True)
class Command:
    """One command of the command line."""

    name: str
    purpose: str
    description: str
    example: str
    add_options: Callable[[ArgumentParser], None]
    action: Action


def _later(module: str, function: str) -> Action:
    def act(given: Namespace) -> int:
        status: int = getattr(importlib.import_module(f"rkverify.cli.{module}"), function)(given)
        return status

    return act


COMMANDS = (
    Command(
        "shape",
        "shape functions and derivatives on your own nodes",
        "Psi_I of (4) and its gradient at every point, one row for each node that reaches it: point,node,psi,dpsi_dx,\n"
        "dpsi_dy,dpsi_dz; ids are 0-based row numbers. Numbers in the CSV files may be decimals or p/q. Distances in two\n"
        "and three dimensions are rational, as exact needs, with --window tensor.",
        "  rkverify shape --nodes nodes.csv --points points.csv --support 1.5 --order 1 --arithmetic exact",
        options.shape,
        _later("shape", "shape"),
    ),
    Command(
        "cells",
        "nodal cells: Voronoi cells clipped to a domain",
        "The points of the domain that are nearer to a node than to any other: node,ring,vertex,x,y, outer rings\n"
        "counter-clockwise, holes clockwise; or node,measure. Non-convex domains with holes in two dimensions; in three\n"
        "dimensions boxes, and measures alone. Ids are 0-based row numbers.",
        "  rkverify cells --nodes nodes.csv --box 0,0,2,1 --measures",
        options.cells,
        _later("cells", "cells"),
    ),
    Command(
        "gradients",
        "smoothed and direct gradients on your own nodes",
        "b_iI^L with grad u (x_L) = sum_I b_I^L u_I: the mean of grad Psi_I over the cell of node L, by a rule on its\n"
        "facets (scni), over a box of the cell's measure (snni), or grad Psi_I at the node (dni). One row for each pair\n"
        "with an entry that is not zero: cell,node,bx,by,bz; cells have the number of their node.",
        "  rkverify gradients --nodes nodes.csv --support 2.5 --integration scni --edge-rule trapezoid --box 0,0,2,1",
        options.gradients,
        _later("gradients", "gradients"),
    ),
    Command(
        "check",
        "what somebody else's shape functions or gradients are",
        "Which sums they satisfy, which derivative, edge rule, kernel, order and supports they have if not those that are\n"
        "claimed, which neighbours are missing, and where they differ most from ours. Options tell what is claimed.\n"
        "Status 0 if the numbers are that, 1 if not.",
        "  rkverify check shape --nodes nodes.csv --points points.csv --support 2.5 --values theirs.csv",
        options.check,
        _later("check", "check"),
    ),
    Command(
        "dispersion",
        "frequencies and growth of a plane wave on the uniform lattice",
        "Roots omega of the dispersion relation for a plane wave e^{i(kx + omega t)}; growth = -Im(omega); rho = 1,\n"
        "modulus 1. Columns kh,root,omega_re,omega_im,omega2_re,omega2_im,growth, and D where the paper defines it;\n"
        "a simulation adds growth_uncertainty and takes the nearest kh that fits on its periodic chain.",
        "  rkverify dispersion --formulation semi-lagrangian --integration dni --layer printed \\\n"
        "      --support-ratio 1.5 --stress-ratio 0.5 --kh 0.5 1 3",
        options.dispersion,
        _later("dispersion", "dispersion"),
    ),
    Command(
        "bloch",
        "frequencies and growth of waves on a stressed plane lattice",
        "omega^2 of plane waves e^{i(k.x + omega t)} on a lattice at rest under a uniform stress, semi-Lagrangian, nearest\n"
        "neighbours at distance 1, rho = 1, lumped mass, plane strain: the eigenvalues of K(k)/m. Columns\n"
        "mode,omega2_re,omega2_im,growth with growth = Re (-omega^2)^(1/2); kx,ky come first where several k are given.",
        "  rkverify bloch --lattice square --integration dni --support-ratio 1.6 --stress 0.2,0,0 --k 1,0.5 3,0",
        bloch_options.bloch,
        _later("bloch", "bloch"),
    ),
    Command(
        "list",
        "the studies and whether they are up to date",
        "Every study, its title, whether its results are current, and how long its last run took. Needs a checkout.",
        "  rkverify list",
        lambda parser: None,
        _later("studies", "show"),
    ),
    Command(
        "run",
        "run the studies that are not up to date",
        "Compute tables, figures and statements of the studies whose sources, parameters or environment changed and\n"
        "write what changed under reports/results. Needs a checkout.",
        "  rkverify run figure5 figure6 --jobs 2",
        options.run,
        _later("studies", "run"),
    ),
    Command(
        "verify",
        "recompute and compare with what is committed",
        "Recompute and compare with the committed results, writing nothing; status 1 and a list of what left its\n"
        "tolerance, and by how much, if anything did. Needs a checkout.",
        "  rkverify verify",
        options.verify,
        _later("studies", "verify"),
    ),
    Command(
        "recheck",
        "verify proof logs anew, with a checker of its own",
        "Repeat every step of the proofs in these logs (all of reports/results/theorems if none is named) in exact rationals,\n"
        "with code that shares nothing with the provers, and print what was verified; status 1 and one line for each\n"
        "log that is damaged or does not prove its claims.",
        "  rkverify recheck reports/results/theorems/tension.json",
        options.recheck,
        _later("recheck", "recheck"),
    ),
    Command(
        "reference",
        "reference values with certified digits",
        "Numbers against which a code can be checked: kernels, shape functions and derivatives, material rates, smoothed\n"
        "gradients, masses and forces, dispersion, waves in the plane; 30 digits, right to one unit of the last. With --json\n"
        "the exact inputs come as well. Without a family: the families and how many values they have (20 s).\n"
        "docs/reference_values.md has the format.",
        "  rkverify reference shape --json --out shape.json",
        options.reference,
        _later("reference", "reference"),
    ),
    Command(
        "ledger",
        "the state of every equation, figure and claim",
        "States of all 170 entries and grades of their evidence, computed from the studies' statements, or one entry\n"
        "with its evidence.\n"
        "Needs a checkout.",
        "  rkverify ledger C43",
        options.ledger,
        _later("ledger", "ledger"),
    ),
    Command(
        "report",
        "build the pages from finished studies",
        "Write reports/index.html and the pages it links to. Needs a checkout.",
        "  rkverify report",
        options.report,
        _later("report", "report"),
    ),
    Command(
        "new-study",
        "begin a study of your own",
        "Write studies/NAME.py and tests/studies/test_NAME.py, which run at once, add the study to the README's table, to\n"
        "a page of the report and, with --about, to the lists of these entries of the ledger. Nothing that exists is\n"
        "replaced, and where one file cannot be written none is. Needs a checkout.",
        "  rkverify new-study my_question --about C43",
        own_options.new_study,
        _later("new_study", "new_study"),
    ),
    Command(
        "export",
        "results for a paper, metadata for an archive",
        "--latex: tables of the studies as tabulars, states of all entries and every statement with its numbers as macros,\n"
        "such as \\rkvCfortythreeState, and an example that uses all of them. --ro-crate: ro-crate-metadata.json, which tells\n"
        "an archive what each file under reports is and how it was made (Process Run Crate). Needs a checkout.",
        "  rkverify export --latex turns stability_layers --out paper/rkverify",
        own_options.export,
        _later("export", "export"),
    ),
)
