"""The semi-discrete equations (18)-(22) and (41)-(46) in the plane, the weak forms (7), (37) and (24), in exact arithmetic."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rkverify.certify import index_convention, mass_exchange, semi_balances, solid_balances, weak_form_checks
from rkverify.certify.plates import Plate
from rkverify.workflow.compare import Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

ROUNDED = Numeric(1e-11, 0, "exact rationals, rounded once when they are printed")
DOUBLES = Numeric(1e-9, 1e-11, "sums of some hundred products in double precision, conditioned by moment matrices")
BALANCE = [
    ("equation", "", "equation"),
    ("check", "", "what is compared"),
    ("apart", "energy, force or mass", "the difference"),
    ("size", "energy, force or mass", "size of what is compared"),
    ("exact", "", "whether the difference is 0 exactly"),
]
ORDERS = {
    "first": "P in (22) is the first Piola-Kirchhoff stress",
    "nominal": "P in (22) is the nominal stress of (7), (24)",
}


@dataclass(frozen=True)
class Parameters:
    """Nodes per side of the rational plate and of the moving one, seed, random cases, digits, steps in time."""

    per_side: int = 3
    moving_per_side: int = 5
    seed: int = 5
    cases: int = 25
    digits: int = 30
    steps: int = 40
    end: float = 0.5


def compute(p: Parameters) -> Tables:
    """Forces against energy slopes, weak forms against strong forms, balances, and rates of nodal mass."""
    plate, moving = Plate(p.per_side, p.seed), Plate(p.moving_per_side, p.seed)
    return {
        "convention": table(
            index_convention.convention_rows(plate),
            [
                ("law", "", "stored energy"),
                ("integration", "", "gradients"),
                ("state", "", "deformation"),
                ("order", "", "what stands in the vector of (22)"),
                ("force", "force", "largest derivative of the stored energy with respect to a coefficient"),
                ("relative", "1", "largest distance of (21) from it, over the largest"),
                ("agrees", "", "whether the distance is 0 exactly"),
                ("moment", "force length", "moment of the internal forces at the deformed nodes"),
            ],
            "Internal force (21) with (22) against the derivative of the stored energy, by duals over rationals.",
            ROUNDED,
        ),
        "strong_form": table(
            weak_form_checks.strong_form_rows(),
            [
                ("equation", "", "weak form"),
                ("stress", "", "order of the stress's indices"),
                ("tests", "1", "test functions up to degree 2"),
                ("left", "energy", "largest residual for fields that satisfy the strong form"),
            ],
            "(7) and (37) on the unit square with polynomial fields of no symmetry, integrated exactly.",
            Exact(),
        ),
        "work": table(
            weak_form_checks.work_rows(p.seed, p.cases),
            [
                ("dimension", "1", "space dimensions"),
                ("count", "1", "random F, stresses and test gradients"),
                ("push_back", "energy/volume", "largest distance of both sides, with P = S F^T, sigma = F S F^T/J"),
                ("push_forward", "energy/volume", "largest distance of both sides, with P from sigma"),
                ("energy", "energy/volume", "largest distance of the right side from the derivative of an energy"),
                ("largest", "energy/volume", "largest work"),
            ],
            "The two integrands of (24).",
            ROUNDED,
        ),
        "push_forward": table(
            weak_form_checks.push_forward_rows(p.seed, p.cases),
            [
                ("dimension", "1", "space dimensions"),
                ("points", "1", "points with random F, stress and test gradient"),
                ("work", "energy", "what (7) gives"),
                ("apart", "energy", "(7) less (37) over the same points"),
            ],
            "(7) pushed forward to the current configuration.",
            ROUNDED,
        ),
        "lagrangian": table(
            solid_balances.lagrangian_rows(plate), BALANCE, "(18)-(21) with smoothed gradients.", ROUNDED
        ),
        "semi_lagrangian": table(
            semi_balances.semi_lagrangian_rows(plate), BALANCE, "(41)-(46), with smoothed gradients and Psi*.", ROUNDED
        ),
        "frames": table(
            semi_balances.frame_rows(plate),
            [
                ("convection", "", "rate in N"),
                ("speed", "velocity", "size of a velocity added to all nodes"),
                ("frame", "force", "largest change of N v where it is added"),
                ("mass", "mass/time", "largest difference of N's column sum from the rate of a nodal mass"),
                ("total_mass", "mass/time", "sum of all N_IJ"),
                ("momentum", "force", "rate of the momentum that (41) leaves unbalanced"),
                ("largest_mass_rate", "mass/time", "largest rate of a nodal mass"),
                ("balances", "", "whether frame, mass and momentum are exact"),
            ],
            "What N of (43) does to a uniform velocity, to mass and to momentum.",
            ROUNDED,
        ),
        "flows": table(
            mass_exchange.flow_rows(moving, p.digits),
            [
                ("flow", "", "velocities of the nodes"),
                ("rate", "1/time", "largest |dm_J/dt|/m_J"),
                ("total", "mass/time", "sum of dm_J/dt"),
                ("true_apart", "mass/time", "largest distance of N's column sums with the true rate from dm_J/dt"),
                ("star_apart", "mass/time", "the same with Psi*"),
                ("star_total", "mass/time", "sum of all N_IJ with Psi*"),
            ],
            "Rates of nodal masses in given flows, radial support.",
            ROUNDED,
        ),
        "nodes": table(
            mass_exchange.node_rows(moving),
            [
                ("node", "", "node J"),
                ("mass", "mass", "m_J"),
                ("rate", "mass/time", "dm_J/dt by duals in time"),
                ("true", "mass/time", "sum_I N_IJ with the true rate"),
                ("star", "mass/time", "sum_I N_IJ with Psi*"),
            ],
            "Every node in the random flow.",
            DOUBLES,
        ),
        "in_time": table(
            mass_exchange.time_rows(moving, p.steps, p.end),
            [
                ("time", "time", "t"),
                ("total", "mass", "sum of all nodal masses"),
                *((f"m_{J}", "mass", f"mass of node {J}") for J in range(p.moving_per_side**2)),
            ],
            "Nodal masses in the random flow.",
            DOUBLES,
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Nodal masses in time; N's column sums against the rates of nodal mass."""
    nodes, in_time = tables["nodes"].frame, tables["in_time"].frame
    figure = new_figure(7.4, 3.7)
    left, right = figure.subplots(1, 2)
    for J in nodes["node"]:
        left.plot(in_time["time"], in_time[f"m_{J}"] / in_time[f"m_{J}"][0], color="#8A8A8A", linewidth=0.8)
    left.plot([], [], color="#8A8A8A", linewidth=0.8, label="one node")
    left.plot(in_time["time"], in_time["total"] / in_time["total"][0], label="all nodes", **LINES[0])
    left.set(xlabel="time  (length/velocity)", ylabel="mass over mass at t = 0  (1)")
    ends = [nodes["rate"].min(), nodes["rate"].max()]
    right.plot(ends, ends, color="#808080", linewidth=1, label="equal")
    right.plot(nodes["rate"], nodes["true"], "o", color=LINES[1]["color"], markersize=4, label="N with the true rate")
    right.plot(nodes["rate"], nodes["star"], "x", color=LINES[2]["color"], markersize=5, label="N with Ψ*")
    right.set(xlabel="rate of the nodal mass  (mass/time)", ylabel="column sum of N  (mass/time)")
    figure.legend(loc="outside lower center", ncols=5)
    caption = (
        f"Nodal masses of {p.moving_per_side} by {p.moving_per_side} jittered nodes with random velocities (ours), cells' masses kept; "
        "cubic kernel, order 1, radial support 5/2 spacings (ours). Left: in time. Right: at t = 0, node by node."
    )
    span = in_time.drop(columns=["time", "total"]).div(in_time.drop(columns=["time", "total"]).iloc[0])
    total = float((in_time["total"] / in_time["total"].iloc[0] - 1).abs().max())
    size = float(nodes["rate"].abs().max())
    true, star = (float((nodes[name] - nodes["rate"]).abs().max() / size) for name in ("true", "star"))
    alternative = (
        f"Single nodal masses drift to between {span.min().min():.2g} and {span.max().max():.2g} of what they were, their total by {rounding(total) if total < 1e-9 else f'{total:.1g}'} at most. "
        f"Column sums of N are off the masses' rates by {rounding(true) if true < 1e-9 else f'{true:.1g}'} of the largest rate at most with the true rate, and by up to {star:.2g} of it with Psi-star."
    )
    return {"masses": Drawing(figure, caption, alternative)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What holds, and which of two stresses (22) needs."""
    return [*_convention(p, tables), *_weak_forms(p, tables), *_balances(p, tables), *_masses(p, tables)]


def _convention(p: Parameters, tables: Tables) -> list[Statement]:
    rows = tables["convention"].frame
    tried = f"{p.per_side} by {p.per_side} jittered rational nodes; {', '.join(rows['law'].unique())}; SCNI and DNI; {', '.join(rows['state'].unique())}"
    found = []
    blind = sorted(
        set(rows[(rows["order"] == "nominal") & rows["agrees"]]["state"]) - set(rows[~rows["agrees"]]["state"])
    )
    for order, reading in ORDERS.items():
        own = rows[rows["order"] == order]
        wrong = own[~own["agrees"]]
        # Only an objective law has a symmetric F P, and no moment.
        moment = float(own[own["law"] == "St. Venant-Kirchhoff"]["moment"].abs().max())
        says = (
            "The force is the exact derivative of the stored energy in every state; with an objective law the forces have no moment at the deformed nodes."
            if wrong.empty
            else f"In shear the force is off the derivative of the stored energy by {wrong['relative'].min():.3g} to {wrong['relative'].max():.3g} of the "
            f"largest, and has a moment of up to {moment:.3g}; {', '.join(blind)} cannot tell, nor can linear elasticity: there P is symmetric."
        )
        least = 0.0 if wrong.empty else -float(wrong["relative"].min())
        means = "minus the least relative difference in a state that tells" if least else "exact"
        holds = wrong.empty and moment == 0
        found.append(Statement(f"order_{order}", ("E22",), says, holds, tried, "exact", least, means, "", reading, ("energy by duals", "moment")))  # fmt: skip
    first = rows[rows["order"] == "first"]
    found.append(
        Statement(
            "internal_force",
            ("E21",),
            "(21) is the exact derivative of the stored energy with respect to every coefficient, P in (22) read with the axis of space first.",
            bool(first["agrees"].all()),
            tried,
            "exact",
            routes=("energy by duals",),
        )
    )
    return found


def _weak_forms(p: Parameters, tables: Tables) -> list[Statement]:
    strong, work, forward = (tables[name].frame for name in ("strong_form", "work", "push_forward"))
    left = {(r["equation"], r["stress"]): r["left"] for r in strong.to_dict("records")}
    zero = bool((work[["push_back", "push_forward", "energy"]] == "0").all().all())
    pushed = bool((forward["apart"] == "0").all())
    cases = f"{p.cases} random rational F, stresses and test gradients each in 1, 2 and 3 dimensions"
    square = "polynomial fields without symmetry on the unit square, test functions up to degree 2"
    turned = left["(7)", "transposed"]
    return [
        Statement(
            "order_in_7",
            ("E7",),
            "(7) vanishes exactly for fields that satisfy the strong form with dP_ji/dX_j and N_j P_ji, material axis first: P is the nominal stress"
            + (", and with P transposed it does not." if turned != "0" else "; transposed it vanishes too."),
            left["(7)", "as printed"] == "0" and turned != "0",
            square,
            "exact",
            routes=("strong form", "energy by duals"),
        ),
        Statement(
            "weak_form_37",
            ("E37",),
            "(37) vanishes exactly for fields that satisfy the strong form, and is (7) pushed forward, volume by volume.",
            left["(37)", "as printed"] == "0" and pushed,
            f"{square}; {cases}",
            "exact",
            routes=("strong form", "(7) pushed forward"),
        ),
        Statement(
            "two_forms",
            ("E24", "C21"),
            "Both integrands of (24) are equal, exactly, and are the derivative of a stored energy; P there is the nominal stress J F^-1 sigma.",
            zero,
            cases,
            "exact",
        ),
    ]


def _exact(frame: Any, equation: str, without: str = "nothing") -> bool:
    own = frame[(frame["equation"] == equation) & ~frame["check"].str.contains(without)]
    return bool(len(own)) and bool(own["exact"].all())


def _balances(p: Parameters, tables: Tables) -> list[Statement]:
    lagrangian, semi = tables["lagrangian"].frame, tables["semi_lagrangian"].frame
    tried = f"{p.per_side} by {p.per_side} jittered rational nodes, Voronoi cells, tensor window, random coefficients, loads and stresses"
    dni = semi[semi["check"].str.contains("DNI")].iloc[0]
    loads = "The nodal forces have the total of the loads and their work in u = X, exactly."
    masses = (
        "The mass matrix is symmetric, has the total mass and is the second derivative of the kinetic energy, exactly."
    )
    plain: list[tuple[str, str, bool, str, tuple[str, ...]]] = [
        ("E18", "lagrangian", _exact(lagrangian, "(18)", "nominal"), "(18) does the work of (7) for all test coefficients, exactly, with (22) as E22 needs it.", ("(7) at the nodes",)),
        ("E19", "mass", _exact(lagrangian, "(19)"), masses, ("kinetic energy by duals", "total")),
        ("E20", "loads", _exact(lagrangian, "(20)"), loads, ("total", "virtual work")),
        ("E42", "current_mass", _exact(semi, "(42)"), masses, ("kinetic energy by duals", "total")),
        ("E43", "convective", _exact(semi, "(43)"), "N does the power of Psi*_J v_J, exactly, with Psi* from duals in time.", ("duals in time",)),
        ("E44", "current_loads", _exact(semi, "(44)"), loads, ("total", "virtual work")),
        ("E45", "stress", _exact(semi, "(45)", "DNI"), f"(45) does the power of the stress, has neither total nor moment, turns with the body, and leaves of a uniform stress what acts on the boundary, exactly with SCNI; with DNI {dni['apart'] / dni['size']:.2g} of the largest force is left.", ()),
        ("E46", "voigt", _exact(semi, "(46)"), "B^T Xi is b_j sigma_ij, exactly, for symmetric stress.", ("full contraction",)),
        ("E41", "derivation", _exact(semi, "(41)"), "(41) does the work of (37) with (38) and (39) for all test coefficients, exactly.", ()),
    ]  # fmt: skip
    return [
        Statement(name, (entry,), says, holds, tried, "exact", routes=routes)
        for entry, name, holds, says, routes in plain
    ]


def _masses(p: Parameters, tables: Tables) -> list[Statement]:
    frames, flows = tables["frames"].frame, tables["flows"].frame
    plate = f"{p.per_side} by {p.per_side} jittered rational nodes with random velocities, cells' masses kept"
    found = []
    for row in frames.to_dict("records"):
        says = (
            "N v does not see a uniform velocity added to all nodes, N's column sums are the rates of the nodal masses, and momentum is balanced, exactly."
            if row["balances"]
            else f"N v changes by {row['frame']:.3g} with a uniform velocity of {row['speed']:.3g}, N's column sums are off the rates of the nodal masses by {row['mass']:.3g} "
            f"(largest rate {row['largest_mass_rate']:.3g}), and a force of {row['momentum']:.3g} stays unbalanced: the Psi*_J do not sum to 0."
        )
        margin = 0.0 if row["balances"] else -row["mass"] / row["largest_mass_rate"]
        reading = f"N with {row['convection']}"
        found.append(Statement(f"balance_{'true' if 'true' in reading else 'star'}", ("E41",), says, bool(row["balances"]), plate, "exact", margin, "minus the largest defect over the largest mass rate" if margin else "exact", "", reading))  # fmt: skip
    rigid = flows[flows["flow"].isin(["translation", "rotation"])]
    straining = flows.drop(rigid.index)
    kept = bool((flows["total"] == 0).all())
    least, most = float(straining["rate"].min()), float(straining["rate"].max())
    total = tables["in_time"].frame["total"]
    drift = float((total / total[0] - 1).abs().max())
    found.append(
        Statement(
            "nodal_mass",
            ("C11",),
            f"In flows that strain the fastest nodal mass changes at {least:.3g} to {most:.3g} of itself per unit of time, in rigid ones none does; their total is kept (followed in time, to {rounding(drift)}).",
            least > 0 and kept and bool((rigid["rate"] == 0).all()),
            f"{p.moving_per_side} by {p.moving_per_side} jittered nodes, velocities up to about 1, radial support, {p.digits} digits; masses of the cells kept",
            "sampled",
            least,
            "least over the straining flows of the largest relative rate (1/time)",
        )
    )
    return found


STUDY = Study(
    "The semi-discrete equations in the plane",
    Parameters(),
    Parameters(per_side=2, moving_per_side=3, cases=5, digits=20, steps=4),
    compute,
    judge,
    draw,
)
