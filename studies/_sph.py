"""What the study of SPH finds, as statements: each with the rule by which it is decided in its sentence."""

from collections.abc import Sequence
from typing import Any

from rkverify.workflow.study import Statement, Tables

LAW = "sigma' = (C + sigma) L"
NARROW = "1 < R < 2"


def listed(values: Any) -> str:
    """The values once each, in their order."""
    return ", ".join(dict.fromkeys(str(v) for v in values))


def key(text: str) -> str:
    """Text as part of a name."""
    return "".join(c if c.isalnum() else "_" for c in text.replace("'", "_rate")).strip("_").lower()


def narrow(frame: Any) -> Any:
    """The rows with 1 < R < 2, the range of the printed relations."""
    return frame[frame["support_ratio"].map(ratio) < 2]


def ratio(text: str) -> float:
    """A ratio such as 3/2 as a number."""
    top, _, bottom = str(text).partition("/")
    return float(top) / float(bottom or 1)


def tensile(p: Any, tables: Tables) -> list[Statement]:
    """C5: SPH by itself; C61: its criterion and the printed one."""
    compared, routes = tables["comparison"].frame, tables["relations"].frame
    measured, criterion = tables["measured"].frame, tables["criterion"].frame
    span = f"R = {listed(compared['support_ratio'])}; kernels {listed(compared['kernel'])}; |sigma/C| <= {p.largest}, kh = pi n/{p.samples}; {LAW}"
    found = []
    for name in dict.fromkeys(compared["relation"]):
        if not name.startswith("SPH, "):
            continue
        part, runs = compared[compared["relation"] == name], measured[measured["equations"] == name]
        tension_only = part["unstable"] == "tension"
        limit = float(part["tension_limit"].max())
        some = int((part["tension_limit"] < float("inf")).sum())
        enough = f"a tension of {limit:.2g} C is enough everywhere"
        if some < len(part):
            enough = f"in {len(part) - some} no tension makes a wave grow"
        found.append(
            Statement(
                f"tensile_{key(name)}",
                ("C5",),
                f"{name}: a wave grows in tension and none in compression, C + sigma > 0 throughout, in {int(tension_only.sum())} of {len(part)} pairs of kernel and R ({enough}). "
                f"The rule is all of them. Nonlinear runs at R = {listed(runs['support_ratio'])} and sigma/C = {listed(runs['stress_ratio'])} grow in {int((runs['quantity'] == 'growth').sum())} of {len(runs)}, at the computed rate to 1e-3 in {int(runs['agrees'].sum())}.",
                bool(tension_only.all() and runs["agrees"].all()),
                span,
                "sampled",
                reading=name,
            )
        )
    good = bool(criterion["comes_out"].all() and routes["agree"].all())
    inside = narrow(criterion)
    for reading in ("full", "diffuse", "frozen-b", "frozen"):
        same = inside[f"same_{reading}"]
        found.append(
            Statement(
                f"criterion_{key(reading)}",
                ("C61",),
                f"The linearised symmetric SPH has omega^2 = -8 m sigma W''(h)/rho^2 at kh = pi, so that it is unstable there exactly where sigma W''(h) > 0, as Swegle and co-authors state it. "
                f"Psi,xx(h) of the {reading} reading has the sign of W''(h) in {int(same.sum())} of {len(same)} pairs of kernel and R; the rule is all of them. "
                f"Its value is {(inside[f'Psi_xx_{reading}'] / inside['W_xx']).min():.3g} to {(inside[f'Psi_xx_{reading}'] / inside['W_xx']).max():.3g} times W''(h).",
                bool(same.all()) and good,
                f"R = {listed(inside['support_ratio'])}; kernels {listed(inside['kernel'])}",
                "sampled",
                float((inside[f"Psi_xx_{reading}"] / inside["W_xx"]).min()),
                "least Psi,xx(h) over W''(h), unit V",
                reading=f"{reading} derivative, {NARROW}",
            )
        )
    return found


def lagrangian_kernel(p: Any, tables: Tables) -> list[Statement]:
    """C6: the kernel kept in material coordinates."""
    frame, measured = tables["lagrangian_kernel"].frame, tables["measured"].frame
    stable, pulled = frame[frame["tangent"] > 0], frame[(frame["tangent"] > 0) & (frame["stress_ratio"].map(ratio) > 0)]
    runs = measured[measured["equations"] == "SPH, Lagrangian kernel"]
    cured = bool((stable["least_material"] >= 0).all() and (frame[frame["tangent"] < 0]["least_material"] < 0).all())
    sph = pulled[pulled["equations"].str.startswith("SPH")]
    return [
        Statement(
            "lagrangian_kernel",
            ("C6",),
            f"With the kernel in material coordinates the least omega^2 over kh is {stable['least_material'].min():.2g} where C F^2 + S > 0 and negative where C F^2 + S < 0, for SPH and for RK with DNI: omega^2 >= 0 exactly with the continuum. "
            f"With the kernel in space SPH is unstable in {int((sph['least_spatial'] < 0).sum())} of {len(sph)} of the same states in tension, omega^2 down to {sph['least_spatial'].min():.3g}. "
            f"Nonlinear runs with the material kernel grow in {int((runs['quantity'] == 'growth').sum())} of {len(runs)}. omega = 0 at kh = pi remains: what goes is the tensile instability, not the rank deficiency.",
            cured
            and bool((sph["least_spatial"] < 0).all())
            and bool((runs["quantity"] == "frequency").all() and runs["agrees"].all()),
            f"R = {listed(frame['support_ratio'])}, S/C = {listed(frame['stress_ratio'])}, F = 1, cubic kernel",
            "sampled",
            float(-sph["least_spatial"].max()),
            "least |omega^2| of the instability that the spatial kernel has, in units of C/(rho h^2)",
        )
    ]


def terms(p: Any, tables: Tables) -> list[Statement]:
    """C12, C63: SPH against (41) term by term on uneven nodes."""
    frame = tables["terms"].frame
    exact = bool(frame["equal"].all() and (frame["mass"] == 1).all())
    missing = float(frame["missing"].abs().max() / frame["force_sph"].abs().max())
    off = float((frame["rk"] - frame["corrected"]).abs().max() / frame["corrected"].abs().max())
    carried = float(frame["convective"].abs().max() / frame["force_sph"].abs().max())
    where = f"{len(frame)} inner ones of {p.nodes} uneven nodes, R = {p.term_ratio}, sigma/C = {p.term_stress} at the middle, cubic kernel"
    identity = (
        "with Psi_I = V_I W, V_I = m_I/rho_I and summation density, sum_K m_K Psi_I(x_K) is m_I and f_int of (41) is the SPH force "
        "-m_I sum_J m_J (sigma_I + sigma_J)/(rho_I rho_J) W' less V_I sigma_I sum_J V_J W'(x_J - x_I), to the last rational; that term vanishes on even nodes"
    )
    return [
        Statement(
            "semi_lagrangian_without_N",
            ("C12",),
            f"SPH depends on the current positions alone, and {identity} (here it is up to {missing:.2g} of the largest force). Nothing in SPH corresponds to N v, which in the same state is up to {carried:.3g} of the largest force. "
            "The rule: the other terms are equal and N v is not zero.",
            exact and carried > 0,
            where,
            "exact",
            carried,
            "largest |N v| over the largest force",
        ),
        Statement(
            "same_equation_with_sph_shapes",
            ("C63",),
            f"The equation without N is an SPH equation in the sense that {identity}.",
            exact,
            where,
            "exact",
            reading="Psi_I = V_I W",
        ),
        Statement(
            "not_the_same_with_rk_shapes",
            ("C63",),
            f"With the RK functions of order 1 the force differs from that of SPH with the corrected gradient, the nearest in its sums, by up to {off:.2g} of the largest force; the rule is equality to rounding.",
            off < 1e-12,
            where,
            "exact",
            -off,
            "minus the largest difference over the largest force",
            reading="Psi_I of RK, order 1",
        ),
    ]


def printed_equivalence(p: Any, tables: Tables) -> list[Statement]:
    """C55: (87) and the relations of SPH."""
    agreement, shapes = narrow(tables["agreement"].frame), tables["printed_with_sph_shapes"].frame
    found = []
    for name in dict.fromkeys(agreement["relation"]):
        if not name.startswith("(87)"):
            continue
        part = agreement[agreement["relation"] == name]
        found.append(
            Statement(
                f"printed_{key(name)}",
                ("C55",),
                f"{name} derivative of the RK function: the nearest of the SPH relations (symmetric, corrected, Galerkin; either density) is off by {part['least_difference'].min():.2g} to {part['least_difference'].max():.2g} of the largest omega^2. "
                "'Equivalent' is taken as the same omega^2 to rounding at every kernel, R, stress and kh.",
                bool((part["least_difference"] == 0).all()),
                f"R = {listed(part['support_ratio'])}; kernels {listed(part['kernel'])}; sigma/C = +-1/2, kh = pi n/{p.samples}; {LAW}",
                "sampled",
                -float(part["least_difference"].min()),
                "minus the least relative difference",
                reading=f"Psi of RK, {name.split(', ')[1]} derivative",
            )
        )
    inside, outside = shapes[shapes["support_ratio"].map(ratio) <= 2], shapes[shapes["support_ratio"].map(ratio) > 2]
    for (form, law), part in inside.groupby(["form", "law"], sort=False):
        beyond = outside[(outside["form"] == form) & (outside["law"] == law)]["difference"]
        words = f"{LAW}" if law == "truesdell" else "sigma' = C L"
        found.append(
            Statement(
                f"printed_with_sph_shapes_{key(form)}_{key(law)}",
                ("C55",),
                f"With Psi_I = V_I W in place of the RK function, so that Psi,x(h) = V W'(h) and Psi,xx(h) = V W''(h), (87) differs from SPH ({form} form) with {words} by "
                f"{part['difference'].min():.2g} to {part['difference'].max():.2g} of the largest omega^2 for R <= 2 (beyond, where W(2h) enters, by up to {beyond.max():.2g}). The rule is equality to rounding.",
                bool(part["equal"].all()),
                f"R = {listed(part['support_ratio'])}; kernels {listed(part['kernel'])}; sigma/C = +-1/2, kh = pi n/{p.samples}",
                "sampled",
                0.0 - float(part["difference"].min()),
                "minus the least relative difference",
                reading=f"Psi_I = V_I W, {form}, {words}, R <= 2",
            )
        )
    return found


def runs_of(part: Any) -> list[Any]:
    """Consecutive rows with the same verdict."""
    change = (part["as_symmetric"] != part["as_symmetric"].shift()).cumsum()
    return [group for _, group in part.groupby(change, sort=False)]


def resemblance(p: Any, tables: Tables) -> list[Statement]:
    """C3, C51, C72: which sign of the stress is unstable, in every layer."""
    agreement, measured = tables["agreement"].frame, tables["measured"].frame
    rule = f"'Resembles' is taken as: the same sign of the stress makes a wave grow within |sigma/C| <= {p.largest} at every R of the reading."
    waves = f"|sigma/C| <= {p.largest}, kh = pi n/{p.samples}; {LAW}; against symmetric SPH with continuity density"
    found = []
    for name in dict.fromkeys(agreement["relation"]):
        whole = agreement[agreement["relation"] == name]
        derivative = name.split(", ")[1]
        layers = ("printed",) if name.startswith("(87)") else ("as-defined", "consistent")
        same = " At rest N does nothing, so that the two linearised layers are one." if len(layers) == 2 else ""
        cubic, others = whole[whole["kernel"] == "cubic"], narrow(whole[whole["kernel"] != "cubic"])
        for layer in layers:
            about = ("C3", "C51", "C72") if layer == "as-defined" else ("C3", "C72")
            for part in runs_of(cubic):
                R = list(part["support_ratio"])
                span = f"R = {R[0]}" if len(R) == 1 else f"R from {R[0]} to {R[-1]}"
                found.append(
                    Statement(
                        f"resembles_{layer}_{key(name)}_{key(R[0])}",
                        about,
                        f"{name} derivative, {span}: unstable in {listed(part['unstable'])}, where SPH is in tension. {rule}{same}",
                        bool(part["as_symmetric"].all()),
                        f"cubic kernel, R = {listed(R)}; {waves}",
                        "sampled",
                        layer=layer,
                        reading=f"{derivative} derivative, cubic kernel, {span}",
                    )
                )
            apart = others[~others["as_symmetric"]]
            places = "; ".join(f"{k}: R = {listed(g['support_ratio'])}" for k, g in apart.groupby("kernel", sort=False))
            found.append(
                Statement(
                    f"resembles_{layer}_{key(name)}_others",
                    about,
                    f"{name} derivative with {listed(others['kernel'])}: the sign of SPH in {int(others['as_symmetric'].sum())} of {len(others)} pairs of kernel and R{'; another at ' + places if places else ''}. {rule}{same}",
                    bool(others["as_symmetric"].all()),
                    f"R = {listed(others['support_ratio'])}; {waves}",
                    "sampled",
                    layer=layer,
                    reading=f"{derivative} derivative, other kernels, {NARROW}",
                )
            )
    sph = measured[measured["equations"] == "SPH, symmetric, continuity density"]
    for name in [n for n in dict.fromkeys(measured["equations"]) if n.startswith("RK")]:
        for R, part in measured[measured["equations"] == name].groupby("support_ratio", sort=False):
            other = sph[sph["support_ratio"] == R]
            grow, grow_sph = (q[q["quantity"] == "growth"] for q in (part, other))
            rates = [
                f"{q['measured'].max():.4g} at sigma/C = {listed(q['stress_ratio'])}" if len(q) else "none"
                for q in (grow, grow_sph)
            ]
            found.append(
                Statement(
                    f"resembles_simulated_{key(name)}_{key(str(R))}",
                    ("C3", "C72"),
                    f"Measured growth in nonlinear runs at R = {R}: {name} derivative {rates[0]}, SPH {rates[1]}. 'Resembles' is taken as growth at the same stresses.",
                    bool(
                        list(grow["stress_ratio"]) == list(grow_sph["stress_ratio"])
                        and part["agrees"].all()
                        and other["agrees"].all()
                    ),
                    f"sigma/C = {listed(part['stress_ratio'])}, kh = {part['kh'].iloc[0]:.4g}, cubic kernel, without N",
                    "sampled",
                    layer="simulated",
                    reading=f"{name.split(', ')[1]} derivative, cubic kernel, R = {R}",
                )
            )
    return found


def improvements(p: Any, tables: Tables) -> list[Statement]:
    """C64, C73: strain smoothing and the convective term, singly and together."""
    return [*_linearised(p, tables), *_printed(p, tables), *_simulated(p, tables)]


FALLS = "The rule: it rises nowhere and falls somewhere."
SAME = 1e-5
SIGNS = {"Q = 0": "rest", "Q > 0": "stretching", "Q < 0": "shrinking"}


def _with(frame: Any, pairing: str, smoothing: str, convection: str) -> Any:
    part = frame[
        (frame["pairing"] == pairing) & (frame["smoothing"] == smoothing) & (frame["convection"] == convection)
    ]
    return part.set_index(["support_ratio", "stress_ratio", "Q"]).iloc[:, -1]


def _gradient(series: Any) -> Any:
    import pandas as pd

    return pd.Series(series.index.get_level_values("Q").map(ratio), index=series.index)


def _signed(series: Any, sign: str) -> Any:
    gradient = _gradient(series)
    return series[{"Q = 0": gradient == 0, "Q > 0": gradient > 0, "Q < 0": gradient < 0}[sign]]


def _counts(before: Any, after: Any) -> tuple[int, int]:
    """How many fall and how many rise by more than what six digits tell apart."""
    return int((after < before - SAME * abs(before)).sum()), int((after > before + SAME * abs(before)).sum())


def _change(before: Any, after: Any) -> str:
    falls, rises = _counts(before, after)
    return f"{before.min():.3g} to {before.max():.3g} becomes {after.min():.3g} to {after.max():.3g}; it falls in {falls} and rises in {rises} of {len(after)}"


def _improvement(
    name: str, says: str, before: Any, after: Any, tried: str, layer: str, reading: str, besides: str = ""
) -> Statement:
    falls, rises = _counts(before, after)
    return Statement(
        name,
        ("C64", "C73"),
        f"{says}: {_change(before, after)}.{besides} {FALLS}",
        rises == 0 and falls > 0,
        tried,
        "sampled",
        round(float(((before - after) / abs(before)).min()), 4) + 0.0,
        "least relative fall",
        layer=layer,
        reading=reading,
    )


def _linearised(p: Any, tables: Tables) -> list[Statement]:
    frame = tables["improvements"].frame
    cells = "strain and force over cells"
    plain = {pairing: _with(frame, pairing, "none", "none") for pairing in ("antisymmetric", "galerkin")}
    enough = {k: v[v > p.meaningful * _gradient(v).abs()] for k, v in plain.items()}
    span = f"R = {listed(frame['support_ratio'])}, sigma/C = {listed(frame['stress_ratio'])}; cubic kernel, kh = pi n/{p.samples}, continuity density"
    frozen = f"frozen growth where it is more than {p.meaningful:g} |Q| without the term, in the equation of the particle at x = 0"
    found = []
    for layer, convection in (("as-defined", "psi-star"), ("consistent", "true")):
        for smoothing in ("strain", "strain and force", cells):
            before, other = (_signed(plain[k], "Q = 0") for k in plain)
            after, also = (_signed(_with(frame, k, smoothing, "none"), "Q = 0") for k in plain)
            grows, others = before[before > 0].index, other[other > 0].index
            found.append(
                _improvement(
                    f"smoothing_{layer}_{key(smoothing)}",
                    f"Symmetric SPH at rest with {smoothing} smoothed, largest growth over kh where there is any without",
                    before[grows],
                    after[grows],
                    f"{span}; Q = 0",
                    layer,
                    f"smoothing alone: {smoothing}",
                    f" Where there is none without, it is at most {after[before == 0].max():.2g} with it. The weak form (Galerkin) in the same way: {_change(other[others], also[others])}.",
                )
            )
        for Q in dict.fromkeys(frame["Q"]):
            chosen = {k: v[v.index.get_level_values("Q") == Q] for k, v in enough.items()}
            changed = {k: _with(frame, k, "none", convection)[chosen[k].index] for k in plain}
            found.append(
                _improvement(
                    f"convective_{layer}_Q_{key(Q.replace('-', 'minus '))}",
                    f"Symmetric SPH with the convective term ({convection}), Q = {Q}, {frozen if ratio(Q) else 'largest growth over kh'}",
                    chosen["antisymmetric"],
                    changed["antisymmetric"],
                    span,
                    layer,
                    f"convective term alone, Q = {Q}",
                    f" The weak form (Galerkin) in the same way: {_change(chosen['galerkin'], changed['galerkin'])}.",
                )
            )
        pulled = enough["antisymmetric"][_gradient(enough["antisymmetric"]) != 0]
        found.append(
            _improvement(
                f"both_{layer}",
                f"Symmetric SPH made into the weak form over cells with the convective term ({convection}), Q not 0, {frozen}",
                pulled,
                _with(frame, "galerkin", cells, convection)[pulled.index],
                span,
                layer,
                f"both: {cells}, either sign of Q",
                " What is left is of the order of |Q|, where frozen coefficients say little.",
            )
        )
    return found


def _printed(p: Any, tables: Tables) -> list[Statement]:
    frame = tables["printed_growths"].frame.set_index(["support_ratio", "stress_ratio", "Q"])
    relation = {name: part["growth"] for name, part in frame.groupby("relation")}
    pulled = relation["(87)"][relation["(87)"] > 0]
    moving = pulled[_gradient(pulled) != 0]
    levels = [listed(frame.index.get_level_values(n)) for n in frame.index.names]
    tried = f"R = {levels[0]}, sigma/C = {levels[1]}, Q = {levels[2]}; full derivative, edge reading of C(h/2), kh = pi n/{p.samples}"
    return [
        _improvement(
            f"printed_improvement_{key(number)}",
            f"{words}: {number} against (87), which stands for SPH in the paper, largest growth over kh where (87) has any",
            level,
            relation[number][level.index],
            tried,
            "printed",
            reading,
        )
        for number, words, level, reading in (
            ("(86)", "Strain smoothing alone", pulled, "smoothing alone"),
            ("(82)", "The convective term alone, Q not 0", moving, "convective term alone, Q not 0"),
            ("(76)", "Both, Q not 0", moving, "both"),
        )
    ]


def _simulated(p: Any, tables: Tables) -> list[Statement]:
    import pandas as pd

    measured, packets = tables["measured"].frame, tables["packets"].frame
    cells = "strain and force over cells"
    runs = measured.assign(growth=measured["measured"].where(measured["quantity"] == "growth", 0.0))
    of = {name: part.set_index(["support_ratio", "stress_ratio"])["growth"] for name, part in runs.groupby("equations")}
    before = of["SPH, symmetric, continuity density"]
    grows = before[before > 0]
    found = [
        _improvement(
            "smoothing_simulated",
            "Measured growth of nonlinear runs at rest, symmetric SPH against the weak form smoothed over cells, where the first grows",
            grows,
            of["SPH, Galerkin, smoothed over cells"][grows.index],
            f"R = {listed(measured['support_ratio'])}, sigma/C = {listed(measured['stress_ratio'])}, kh = {measured['kh'].iloc[0]:.4g}",
            "simulated",
            f"smoothing alone: {cells}",
        )
    ]
    tried = f"R = {listed(packets['support_ratio'])}, sigma/C = {listed(packets['stress_ratio'])}, Q = {listed(packets['Q'])}; a packet of kh = pi over the time {p.packet.duration} h (rho/C)^(1/2)"
    plain = _with(packets, "antisymmetric", "none", "none")

    def twice(series: Any, pairing: str, smoothing: str) -> tuple[Any, Any]:
        """The packets without, and with N of either kind in place of it."""
        after = [_with(packets, pairing, smoothing, kind)[series.index] for kind in ("psi-star", "true")]
        return pd.concat([series, series], ignore_index=True), pd.concat(after, ignore_index=True)

    for sign, word in SIGNS.items():
        found.append(
            _improvement(
                f"convective_simulated_{word}",
                f"Log of the growth of a packet in nonlinear runs, symmetric SPH with the convective term (Psi*, true rate), {sign}",
                *twice(_signed(plain, sign), "antisymmetric", "none"),
                tried,
                "simulated",
                f"convective term alone, {sign}",
            )
        )
    found.append(
        _improvement(
            "both_simulated",
            "Log of the growth of a packet in nonlinear runs, symmetric SPH against the weak form over cells with the convective term (Psi*, true rate)",
            *twice(plain, "galerkin", cells),
            tried,
            "simulated",
            f"both: {cells}, either sign of Q",
        )
    )
    return found


def statements(p: Any, tables: Tables) -> Sequence[Statement]:
    """All of them."""
    rooms = (tensile, lagrangian_kernel, terms, printed_equivalence, resemblance, improvements)
    return [statement for room in rooms for statement in room(p, tables)]
