// The explorer's page: controls, curve, map.
"use strict";

(() => {
  const root = document.getElementById("explorer"), form = root.querySelector("form");
  const curve = document.getElementById("curve"), map = document.getElementById("map");
  const WAVES = Array.from({ length: 200 }, (_, n) => ((n + 1) * Math.PI) / 200);
  const RATIOS = Array.from({ length: 31 }, (_, n) => 1.05 + (n * 2.95) / 30);
  const STRESSES = Array.from({ length: 41 }, (_, n) => -2 + n / 10);
  const MAP_WAVES = Array.from({ length: 16 }, (_, n) => ((n + 1) * Math.PI) / 16);
  // Growth in c/h from which a shade begins: on a base that moves, everything may grow at rates of the order of Q.
  const levels = (Q) => [1e-6, 3 * Math.abs(Q) + 1e-6, 3 * Math.abs(Q) + 0.5];
  const SHADES = ["#ffffff", "#f4d3b8", "#e08a4c", "#8a3a00"];
  const NUMBERS = ["R", "s", "Q"];
  const MEASURED = JSON.parse(document.getElementById("explorer-data").textContent).measured;
  // Waves that were measured at rest with what is chosen, whatever R and sigma/C are.
  const measured = (set) => (set.Q !== 0 ? [] : MEASURED.filter((wave) =>
    wave.formulation === set.formulation && wave.integration === set.integration && wave.kernel === set.kernel
    && (wave.integration === "scni" || wave.derivative === set.derivative)));

  function setting() {
    const set = {};
    for (const name of ["formulation", "integration", "layer", "kernel", "derivative", "half_point", "stress_law"]) set[name] = form[name].value;
    for (const name of NUMBERS) set[name] = form[name].valueAsNumber;
    set.convective = form.convective.value === "yes";
    if (set.formulation === "lagrangian") set.Q = 0;
    return set;
  }

  const round = (value) => Number(value.toPrecision(4));
  const line = (x1, y1, x2, y2) => `<line x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}" stroke="#bbb"/>`;
  const text = (x, y, words, more = "") => `<text x="${x}" y="${y}" ${more}>${words}</text>`;

  function frame(box, ticks, label) {
    let out = `<rect x="${box.x}" y="${box.y}" width="${box.w}" height="${box.h}" fill="none" stroke="#555"/>`;
    for (const [value, words] of ticks) out += line(box.x, value, box.x + box.w, value) + text(box.x - 6, value + 4, words, 'text-anchor="end"');
    return out + text(box.x, box.y - 7, label);
  }

  const ring = (x, y, radius, fill) => `<circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${radius}" fill="${fill}" stroke="#000" stroke-width="2"/>`;

  function panel(box, low, high, label, dots, dashes, rings) {
    if (high - low < 1e-9) { high += 0.5; low -= low < 0 ? 0.5 : 0; }
    const y = (value) => box.y + box.h - ((value - low) / (high - low)) * box.h;
    const x = (kh) => box.x + (kh / Math.PI) * box.w;
    const path = (points) => points.map(([kh, value]) => `M${x(kh).toFixed(1)} ${y(value).toFixed(1)}h0`).join("");
    const ticks = [...new Set([low, 0, high])].filter((value) => value >= low && value <= high).map((value) => [y(value), round(value)]);
    return frame(box, ticks, label)
      + `<path d="${path(dots)}" stroke="#6cb2e0" stroke-width="5" stroke-linecap="round" fill="none"/>`
      + `<path d="${path(dashes)}" stroke="#000" stroke-width="2.5" stroke-linecap="round" fill="none"/>`
      + rings.map((wave) => ring(x(wave.kh), y(wave.value), 7, "none")).join("");
  }

  function dotted(relation, s) {
    const frequency = [], growth = [];
    for (const kh of relation ? WAVES : []) {
      for (const [re, im] of relation.roots(relation.at(kh), s)) {
        if (re >= -1e-9) frequency.push([kh, Math.abs(re)]);
        growth.push([kh, -im]);
      }
    }
    return { frequency, growth };
  }

  function drawCurve(set) {
    const own = rkverify.relation(set), printed = set.layer === "printed" ? null : rkverify.relation({ ...set, layer: "printed" });
    const dots = dotted(own, set.s), other = dotted(printed, set.s);
    const sparse = (list) => list.filter(([kh]) => Math.round((kh / Math.PI) * 200) % 8 < 4);
    const here = measured(set).filter((wave) => Math.abs(wave.R - set.R) < 1e-9 && Math.abs(wave.s - set.s) < 1e-9);
    const [frequencies, growths] = ["frequency", "growth"].map((quantity) => here.filter((wave) => wave.quantity === quantity));
    const tops = [...dots.frequency, ...other.frequency].map(([, value]) => value).concat(frequencies.map((wave) => wave.value));
    const sides = [...dots.growth, ...other.growth].map(([, value]) => value).concat(growths.map((wave) => wave.value));
    const box = { x: 70, w: 550, h: 160 };
    const high = Math.max(0.1, ...sides), low = Math.min(0, ...sides);
    let out = panel({ ...box, y: 24 }, 0, Math.max(1e-3, ...tops), "frequency |Re ω| h/c", dots.frequency, sparse(other.frequency), frequencies);
    out += panel({ ...box, y: 222 }, low, high, "growth −Im ω h/c", dots.growth, sparse(other.growth), growths);
    for (const [n, words] of [[0, "0"], [0.25, "π/4"], [0.5, "π/2"], [0.75, "3π/4"], [1, "π"]]) out += text(70 + n * 550, 400, words, 'text-anchor="middle"');
    out += text(345, 416, "wave number times spacing kh", 'text-anchor="middle"');
    curve.innerHTML = out;
    const fastest = dots.growth.reduce((best, point) => (point[1] > best[1] ? point : best), [0, 0]);
    const where = `R = ${set.R}, sigma/C = ${set.s}, Q = ${set.Q}, ${set.layer}`;
    document.getElementById("explorer-says").textContent = !own
      ? `${where}: the paper prints no Lagrangian relation with DNI.`
      : fastest[1] > levels(set.Q)[0]
        ? `${where}: the fastest growth is ${round(fastest[1])} c/h, at kh = ${round(fastest[0])}${fastest[1] > levels(set.Q)[1] ? "" : ", not faster than 3|Q|"}.`
        : `${where}: no wave grows.`;
    for (const wave of here) document.getElementById("explorer-says").textContent += ` Measured at kh = ${round(wave.kh)}: ${wave.quantity} ${round(wave.value)} c/h.`;
    const shown = set.formulation === "lagrangian" ? `lagrangian-${set.integration}` : `semi-${set.integration}${set.convective ? "" : "-without"}`;
    let any = false;
    for (const each of root.querySelectorAll("[data-relation]")) {
      each.hidden = each.dataset.relation !== shown;
      any ||= !each.hidden;
    }
    document.getElementById("no-relation").hidden = any;
    document.getElementById("command").textContent = command(set);
    document.getElementById("simulated").textContent = `${command({ ...set, layer: "simulated" })} --kh ${round(here.length ? here[0].kh : fastest[0] || 3)}`;
  }

  function command(set) {
    let words = `rkverify dispersion --formulation ${set.formulation} --integration ${set.integration} --layer ${set.layer} --support-ratio ${set.R} --stress-ratio ${set.s} --kernel ${set.kernel}`;
    if (set.Q !== 0) words += ` --velocity-gradient ${set.Q}`;
    if (set.integration === "dni") words += ` --derivative ${set.derivative}`;
    else if (set.layer === "printed" && set.formulation !== "lagrangian") words += ` --half-point ${set.half_point}`;
    if (set.layer !== "printed" && set.formulation !== "lagrangian") words += ` --stress-law ${set.stress_law}`;
    return words + (set.convective ? "" : " --no-convective");
  }

  let mapKey = "", mapCells = "";
  const mx = (R) => 70 + ((R - 1.05) / 2.95) * 550, my = (s) => 290 - ((s + 2) / 4) * 260;

  function drawMap(set) {
    const { R, s, ...rest } = set, key = JSON.stringify(rest);
    if (key !== mapKey) {
      mapKey = key;
      const shades = levels(set.Q);
      const wide = 550 / (RATIOS.length - 1), tall = 260 / (STRESSES.length - 1), paths = SHADES.map(() => "");
      for (const ratio of RATIOS) {
        const relation = rkverify.relation({ ...rest, R: ratio });
        if (!relation) break;
        const waves = MAP_WAVES.map(relation.at);
        for (const stress of STRESSES) {
          let fastest = 0;
          for (const at of waves) fastest = Math.max(fastest, relation.growth(at, stress));
          const shade = shades.filter((level) => fastest > level).length;
          if (shade) paths[shade] += `M${(mx(ratio) - wide / 2).toFixed(1)} ${(my(stress) - tall / 2).toFixed(1)}h${wide.toFixed(2)}v${tall.toFixed(2)}h${-wide.toFixed(2)}z`;
        }
      }
      mapCells = paths.map((d, n) => (d ? `<path d="${d}" fill="${SHADES[n]}"/>` : "")).join("");
    }
    let out = `<clipPath id="inside"><rect x="70" y="30" width="550" height="260"/></clipPath><g clip-path="url(#inside)">${mapCells}</g>`;
    out += frame({ x: 70, y: 30, w: 550, h: 260 }, [-2, -1, 0, 1, 2].map((value) => [my(value), value]), "sigma/C");
    for (const ratio of [1.5, 2, 2.5, 3, 3.5, 4]) out += text(mx(ratio), 308, ratio, 'text-anchor="middle"');
    out += text(345, 308, "", "") + text(600, 22, "R = a/h →", 'text-anchor="end"');
    for (const wave of measured(set)) out += ring(mx(wave.R), my(wave.s), 4, wave.quantity === "growth" ? "#000" : "#fff");
    out += `<path d="M${mx(R) - 9} ${my(s)}h18M${mx(R)} ${my(s) - 9}v18" stroke="#fff" stroke-width="6"/><path d="M${mx(R) - 9} ${my(s)}h18M${mx(R)} ${my(s) - 9}v18" stroke="#000" stroke-width="2.5"/>`;
    const words = ["no growth", "up to 3|Q|", "up to 3|Q| + 0.5", "faster"];
    words.forEach((each, n) => { out += `<rect x="${70 + n * 140}" y="318" width="16" height="14" fill="${SHADES[n]}" stroke="#555"/>` + text(92 + n * 140, 330, each); });
    map.innerHTML = out;
  }

  function redraw() {
    const start = performance.now(), set = setting();
    if (NUMBERS.some((name) => !form[name].checkValidity() || !Number.isFinite(form[name].valueAsNumber))) return;
    drawCurve(set);
    drawMap(set);
    rkverify.took = performance.now() - start;
  }

  for (const name of NUMBERS) {
    form[`${name}-slide`].addEventListener("input", (event) => { form[name].value = event.target.value; });
    form[name].addEventListener("input", (event) => { form[`${name}-slide`].value = event.target.value; });
  }
  form.measured?.addEventListener("input", () => {
    const wave = MEASURED[form.measured.value];
    if (!wave) return;
    for (const name of ["formulation", "integration", "derivative", "kernel"]) form[name].value = wave[name];
    for (const name of ["R", "s"]) { form[name].value = wave[name]; form[`${name}-slide`].value = wave[name]; }
    form.Q.value = 0;
    form["Q-slide"].value = 0;
  });
  form.addEventListener("input", redraw);
  form.addEventListener("submit", (event) => event.preventDefault());
  map.addEventListener("click", (event) => {
    const area = map.getBoundingClientRect(), x = ((event.clientX - area.left) / area.width) * 640, y = ((event.clientY - area.top) / area.height) * 340;
    const R = Math.min(4, Math.max(1.05, 1.05 + ((x - 70) / 550) * 2.95)), s = Math.min(2, Math.max(-2, ((290 - y) / 260) * 4 - 2));
    for (const [name, value] of [["R", R], ["s", s]]) { form[name].value = value.toFixed(2); form[`${name}-slide`].value = value.toFixed(2); }
    redraw();
  });
  root.hidden = false;
  redraw();
})();
