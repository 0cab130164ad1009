// The linearised equations on the uniform lattice h = rho = C = 1 and the printed relations, linear basis: numbers only.
//
// A jet is a Float64Array: a value and its partial derivatives. At a point p the jets' variables are p itself, the
// positions of the nodes around it, and their velocities; by translation one node and one edge give the whole stencil.
"use strict";

const rkverify = (() => {
  const kernels = JSON.parse(document.getElementById("explorer-data").textContent).kernels;

  // The derivative of the given order of phi(|y|/R) with respect to y, from phi = sum_t c (b - z)_+^p.
  function phi(terms, R, y, order) {
    const z = Math.abs(y) / R;
    let total = 0;
    for (const [c, b, p] of terms) {
      if (z >= b || order > p) continue;
      let factor = c;
      for (let k = 0; k < order; k++) factor *= -(p - k);
      total += factor * (b - z) ** (p - order);
    }
    return (total * (order % 2 && y < 0 ? -1 : 1)) / R ** order;
  }

  function jets(size) {
    const make = () => new Float64Array(size + 1);
    return {
      number(value) { const r = make(); r[0] = value; return r; },
      variable(value, place) { const r = make(); r[0] = value; r[place] = 1; return r; },
      add(a, b) { const r = make(); for (let i = 0; i <= size; i++) r[i] = a[i] + b[i]; return r; },
      sub(a, b) { const r = make(); for (let i = 0; i <= size; i++) r[i] = a[i] - b[i]; return r; },
      mul(a, b) { const r = make(); for (let i = 1; i <= size; i++) r[i] = a[i] * b[0] + a[0] * b[i]; r[0] = a[0] * b[0]; return r; },
      div(a, b) { const r = make(), q = a[0] / b[0]; for (let i = 1; i <= size; i++) r[i] = (a[i] - q * b[i]) / b[0]; r[0] = q; return r; },
      scale(a, f) { const r = make(); for (let i = 0; i <= size; i++) r[i] = a[i] * f; return r; },
      chain(value, slope, a) { const r = make(); for (let i = 1; i <= size; i++) r[i] = slope * a[i]; r[0] = value; return r; },
      sum(list) { const r = make(); for (const a of list) for (let i = 0; i <= size; i++) r[i] += a[i]; return r; },
    };
  }

  // Everything about one point: shape functions, their gradients in the readings, their rates.
  function around(terms, R, at, Q) {
    const reach = Math.floor(R) + 1, span = 2 * reach + 2, J = jets(1 + 2 * span);
    const low = -reach; // nodes low … low + span - 1
    const p = J.variable(at, 1);
    const nodes = [];
    for (let n = 0; n < span; n++) {
      const x = J.variable(low + n, 2 + n), y = J.sub(p, x), d = y[0];
      if (Math.abs(d) >= R) continue;
      const f = [0, 1, 2, 3].map((order) => phi(terms, R, d, order));
      nodes.push({
        offset: low + n, y, f, phi: J.chain(f[0], f[1], y), slope: J.chain(f[1], f[2], y),
        v: J.variable(Q * (low + n), 2 + span + n),
      });
    }
    const m0 = J.sum(nodes.map((a) => a.phi));
    const m1 = J.sum(nodes.map((a) => J.mul(a.y, a.phi)));
    const m2 = J.sum(nodes.map((a) => J.mul(a.y, J.mul(a.y, a.phi))));
    const det = J.sub(J.mul(m0, m2), J.mul(m1, m1));
    const b0 = J.div(m2, det), b1 = J.scale(J.div(m1, det), -1);
    for (const a of nodes) {
      a.C = J.add(b0, J.mul(b1, a.y));
      a.psi = J.mul(a.C, a.phi);
    }
    // The rate of every Psi where each y changes at the rate w: b' = -M^-1 M' b.
    function rates(w) {
      const d0 = J.sum(nodes.map((a, n) => J.mul(a.slope, w[n])));
      const d1 = J.sum(nodes.map((a, n) => J.mul(J.add(a.phi, J.mul(a.y, a.slope)), w[n])));
      const d2 = J.sum(nodes.map((a, n) => J.mul(J.mul(a.y, J.add(J.scale(a.phi, 2), J.mul(a.y, a.slope))), w[n])));
      const r0 = J.add(J.mul(d0, b0), J.mul(d1, b1)), r1 = J.add(J.mul(d1, b0), J.mul(d2, b1));
      const c0 = J.div(J.sub(J.mul(m1, r1), J.mul(m2, r0)), det), c1 = J.div(J.sub(J.mul(m1, r0), J.mul(m0, r1)), det);
      return nodes.map((a, n) => J.add(
        J.mul(J.add(J.add(c0, J.mul(c1, a.y)), J.mul(b1, w[n])), a.phi), J.mul(J.mul(a.C, a.slope), w[n])));
    }
    function gradients(reading) {
      if (reading === "full") return rates(nodes.map(() => J.number(1)));
      if (reading === "diffuse") return nodes.map((a) => J.mul(J.div(J.sub(m1, J.mul(m0, a.y)), det), a.phi));
      const frozen = nodes.map((a) => J.mul(a.C, a.slope));
      return reading === "frozen" ? frozen : frozen.map((g, n) => J.add(g, J.mul(b1, nodes[n].phi)));
    }
    // Partial derivatives with respect to positions and velocities as functions of the node; p moves as `share` says.
    function derivatives(jet, share) {
      const x = new Map(), v = new Map();
      for (let n = 0; n < span; n++) {
        x.set(low + n, jet[2 + n] + (share[low + n] || 0) * jet[1]);
        v.set(low + n, jet[2 + span + n]);
      }
      return { value: jet[0], x, v };
    }
    return { J, nodes, rates, gradients, derivatives, b0, b1 };
  }

  class Stencil {
    constructor() { this.c = new Map(); }
    add(map, shift, factor) {
      if (factor !== 0) for (const [n, value] of map) if (value !== 0) this.c.set(n + shift, (this.c.get(n + shift) || 0) + factor * value);
    }
    put(n, value) { this.c.set(n, (this.c.get(n) || 0) + value); }
    at(kh) {
      let re = 0, im = 0;
      for (const [n, c] of this.c) { re += c * Math.cos(n * kh); im += c * Math.sin(n * kh); }
      return [re, im];
    }
  }

  // What does not depend on the stress: v' = convX x + convV v + stress (force x) + carried (stress perturbation),
  // and L = strainX x + strainV v, with the base's L = Q.
  function parts(set) {
    const { R, Q } = set, terms = kernels[set.kernel];
    const node = around(terms, R, 0, Q), own = { 0: 1 };
    const psi = new Map(node.nodes.map((a) => [a.offset, node.derivatives(a.psi, own)]));
    const force = new Stencil(), carried = new Stencil(), convX = new Stencil(), convV = new Stencil();
    const strainX = new Stencil(), strainV = new Stencil();
    let mass = 0, strain = Q;
    for (const each of psi.values()) mass += each.value;
    if (set.integration === "scni") {
      const edge = around(terms, R, 0.5, Q), J = edge.J, half = { 0: 0.5, 1: 0.5 };
      for (const a of edge.nodes) {
        const d = edge.derivatives(a.psi, half), K = -a.offset;
        force.add(d.x, K, 1); // right edge of cell K
        force.add(d.x, K, -1); // left edge of cell K + 1, under the same uniform stress
        carried.put(K, d.value);
        carried.put(K + 1, -d.value);
      }
      const flux = edge.derivatives(J.sum(edge.nodes.map((a) => J.mul(a.psi, a.v))), half);
      const whole = edge.derivatives(J.sum(edge.nodes.map((a) => a.psi)), half);
      strainX.add(flux.x, 0, 1); strainX.add(flux.x, -1, -1); strainX.add(whole.x, -1, Q);
      strainV.add(flux.v, 0, 1); strainV.add(flux.v, -1, -1);
      strainX.put(1, -Q / 2); strainX.put(-1, Q / 2); // L = flux over the length of the cell
    } else {
      const B = node.gradients(set.derivative), J = node.J;
      node.nodes.forEach((a, n) => {
        const d = node.derivatives(B[n], own), K = -a.offset;
        force.add(d.x, K, 1);
        force.put(K + 1, d.value / 2); force.put(K - 1, -d.value / 2);
        carried.put(K, d.value);
      });
      const L = node.derivatives(J.sum(B.map((b, n) => J.mul(b, node.nodes[n].v))), own);
      strain = L.value; // Q, but for readings whose gradients are not those of linear fields
      strainX.add(L.x, 0, 1);
      strainV.add(L.v, 0, 1);
    }
    if (set.convective && Q !== 0) {
      const J = node.J, here = node.nodes.find((a) => a.offset === 0).v;
      const w = node.nodes.map((a) => J.sub(here, a.v));
      const rate = set.layer === "consistent" ? node.rates(w) : node.nodes.map((a, n) => J.mul(J.mul(a.C, a.slope), w[n]));
      const A = node.derivatives(J.sum(rate.map((r, n) => J.mul(r, node.nodes[n].v))), own);
      const S = node.derivatives(J.sum(rate), own);
      let base = 0;
      for (const [offset, each] of psi) {
        const K = -offset, acceleration = A.value + Q * K * S.value;
        base += each.value * acceleration;
        convX.add(each.x, K, -acceleration / mass);
        convX.add(A.x, K, -each.value / mass); convX.add(S.x, K, (-each.value * Q * K) / mass);
        convV.add(A.v, K, -each.value / mass); convV.add(S.v, K, (-each.value * Q * K) / mass);
      }
      for (const [offset, each] of psi) convX.add(each.x, -offset, base / mass ** 2);
    }
    return { mass, force, carried, convX, convV, strainX, strainV, strain, Q, truesdell: set.stress_law === "truesdell" };
  }

  function root2([a, b]) {
    const m = Math.hypot(a, b), re = Math.sqrt((m + Math.abs(a)) / 2);
    if (re === 0) return [0, 0];
    return a >= 0 ? [re, b / (2 * re)] : [Math.abs(b) / (2 * re), b < 0 ? -re : re];
  }

  // Roots of t^3 + (ar + i ai) t^2 + (br + i bi) t + (cr + i ci), by Cardano, then polished by Newton's method:
  // into `out` as re, im, re, im, re, im. Written out in reals, since a map solves ten thousand of them.
  const SIN = Math.sqrt(3) / 2;
  function cubic(ar, ai, br, bi, cr, ci, out) {
    const tr = ar / 3, ti = ai / 3, sr = tr * tr - ti * ti, si = 2 * tr * ti;
    const pr = br / 3 - sr, pi = bi / 3 - si;
    const qr = tr * sr - ti * si + (cr - (tr * br - ti * bi)) / 2, qi = tr * si + ti * sr + (ci - (tr * bi + ti * br)) / 2;
    const p2r = pr * pr - pi * pi, p2i = 2 * pr * pi;
    const dr = qr * qr - qi * qi + p2r * pr - p2i * pi, di = 2 * qr * qi + p2r * pi + p2i * pr;
    const m = Math.hypot(dr, di);
    let rr = Math.sqrt((m + Math.abs(dr)) / 2), ri = rr === 0 ? 0 : di / (2 * rr);
    if (dr < 0) { const old = rr; rr = Math.abs(ri); ri = di < 0 ? -old : old; }
    const sign = rr * qr + ri * qi > 0 ? -1 : 1; // the sum that loses no digits
    const vr = sign * rr - qr, vi = sign * ri - qi;
    const size = Math.cbrt(Math.hypot(vr, vi)), angle = Math.atan2(vi, vr) / 3;
    let ur = size * Math.cos(angle), ui = size * Math.sin(angle);
    const length = size * size;
    for (let k = 0; k < 6; k += 2) {
      let xr = ur - tr, xi = ui - ti;
      if (length > 0) { xr -= (pr * ur + pi * ui) / length; xi -= (pi * ur - pr * ui) / length; }
      for (let step = 0; step < 2; step++) {
        const er = xr + ar, ei = xi + ai, fr = er * xr - ei * xi + br, fi = er * xi + ei * xr + bi;
        const gr = fr * xr - fi * xi + cr, gi = fr * xi + fi * xr + ci;
        const hr = 3 * xr + 2 * ar, hi = 3 * xi + 2 * ai, lr = hr * xr - hi * xi + br, li = hr * xi + hi * xr + bi;
        const slope = lr * lr + li * li;
        if (slope < 1e-24) break;
        xr -= (gr * lr + gi * li) / slope; xi -= (gi * lr - gr * li) / slope;
      }
      out[k] = xr; out[k + 1] = xi;
      const old = ur;
      ur = -0.5 * ur - SIN * ui; ui = SIN * old - 0.5 * ui;
    }
  }

  function symbol(found, kh) {
    const { mass } = found, over = ([re, im]) => [re / mass, im / mass];
    return {
      force: over(found.force.at(kh)), carried: over(found.carried.at(kh)), convX: found.convX.at(kh),
      convV: found.convV.at(kh), strainX: found.strainX.at(kh), strainV: found.strainV.at(kh),
    };
  }

  // The rates lambda of the amplitudes of x, v and the stress: x' = v, v' = a x + b v + c stress, stress' = d x + e v + f stress.
  // Into `out`; returns how many there are. Without a velocity gradient the stress follows the positions.
  const eigen = new Float64Array(6);
  function rates(found, at, s) {
    const tangent = 1 + (found.truesdell ? s : 0), f = found.truesdell ? found.strain : 0;
    const ar = at.convX[0] - s * at.force[0], ai = at.convX[1] - s * at.force[1], [br, bi] = at.convV;
    const cr = -at.carried[0], ci = -at.carried[1], er = tangent * at.strainV[0], ei = tangent * at.strainV[1];
    const cer = cr * er - ci * ei, cei = cr * ei + ci * er;
    if (found.Q === 0) {
      const [re, im] = root2([ar + cer, ai + cei]);
      eigen.set([re, im, -re, -im]);
      return 2;
    }
    const dr = tangent * at.strainX[0], di = tangent * at.strainX[1];
    cubic(-br - f, -bi, br * f - cer - ar, bi * f - cei - ai, ar * f - cr * dr + ci * di, ai * f - cr * di - ci * dr, eigen);
    return 3;
  }

  // omega = -i lambda.
  function linearised(found, at, s) {
    const count = rates(found, at, s);
    return Array.from({ length: count }, (_, n) => [eigen[2 * n + 1], -eigen[2 * n]]);
  }

  function fastest(found, at, s) {
    const count = rates(found, at, s);
    return Math.max(eigen[0], eigen[2], count === 3 ? eigen[4] : 0);
  }

  // The numbers that (76), (82), (86) and (87) are written in.
  function printedValues(set) {
    const { R } = set, terms = kernels[set.kernel];
    const node = around(terms, R, 0, 0), next = around(terms, R, 1, 0), edge = around(terms, R, 0.5, 0);
    const of = (point) => point.nodes.findIndex((a) => a.offset === 0);
    const at = of(next), gradient = next.gradients(set.derivative)[at], a = next.nodes[at];
    const half = set.half_point === "literal" ? node : edge;
    const second = { frozen: a.C[0] * a.f[2], "frozen-b": a.C[0] * a.f[2] + 2 * next.b1[0] * a.f[1] }[set.derivative];
    return {
      C_h: node.b0[0] + node.b1[0], slope: phi(terms, R, 1, 1) * R,
      stiff: ((half.b0[0] + half.b1[0] / 2) * phi(terms, R, 0.5, 0)) ** 2,
      psi0: node.nodes[of(node)].psi[0], psi1: a.psi[0], x: gradient[0], xx: second ?? gradient[1],
    };
  }

  function printed(set, n, s, kh) {
    const { R, Q } = set, slope = (n.C_h * n.slope) / R;
    const convective = set.convective ? 1 : 0;
    const B = -2 * convective * Q * slope * (n.psi0 * Math.sin(kh) + n.psi1 * Math.sin(2 * kh));
    const inertia = -4 * convective * (Q * slope) ** 2 * (1 - Math.cos(kh));
    const C = set.integration === "scni"
      ? inertia - 2 * (1 + s) * n.stiff * (1 - Math.cos(2 * kh))
      : inertia + 2 * s * n.xx * (1 - Math.cos(kh)) - 4 * (1 + s) * n.x ** 2 * Math.sin(kh) ** 2;
    // Without N the sign of the constant is that of (86) and (87): omega^2 = …
    const r = root2([B * B / 4 - C, 0]);
    return [[r[0] - B / 2, -r[1]], [-r[0] - B / 2, r[1]]];
  }

  function lagrangian(set) {
    const terms = kernels[set.kernel], b = new Stencil();
    if (set.integration === "scni") {
      for (const a of around(terms, set.R, 0.5, 0).nodes) { b.put(-a.offset, a.psi[0]); b.put(1 - a.offset, -a.psi[0]); }
    } else {
      const node = around(terms, set.R, 0, 0), B = node.gradients(set.derivative);
      node.nodes.forEach((a, n) => b.put(-a.offset, B[n][0]));
    }
    return b;
  }

  const growth = (roots) => Math.max(-roots[0][1], -roots[1][1]);

  // The relation of a setting for any stress: prepared once, then at a wave, then for a stress the roots omega or the
  // fastest growth; null where the paper prints none.
  function relation(set) {
    if (set.formulation === "lagrangian") {
      if (set.layer === "printed" && set.integration === "dni") return null;
      const b = lagrangian(set);
      const roots = ([re, im], s) => { // C^SE F^2 + S of the unstretched bar, where F = 1 + sum_I b_I u_I = 1
        const r = root2([(1 + s) * (re * re + im * im), 0]);
        return [[r[0], -r[1]], [-r[0], r[1]]];
      };
      return { at: (kh) => b.at(kh), roots, growth: (at, s) => growth(roots(at, s)) };
    }
    if (set.layer === "printed") {
      const values = printedValues(set);
      const roots = (kh, s) => printed(set, values, s, kh);
      return { at: (kh) => kh, roots, growth: (kh, s) => growth(roots(kh, s)) };
    }
    const found = parts(set);
    return { at: (kh) => symbol(found, kh), roots: (at, s) => linearised(found, at, s), growth: (at, s) => fastest(found, at, s) };
  }

  function dispersion(set, waves) {
    const found = relation(set);
    return found && waves.map((kh) => found.roots(found.at(kh), set.s));
  }

  return { relation, dispersion };
})();
