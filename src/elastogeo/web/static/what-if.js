// The what-if of a circular test: a slider a cause, the trace and its deviations as they would be, from the columns alone.
// `measured - sum (1 - f) column` would be measured; G and F follow as in ISO 230-4 (`identification/faults/circularity.py`).
"use strict";
(() => {
  const TURN = 2 * Math.PI, GAP = (10 * Math.PI) / 180 * (1 + 1e-9), SVG = "http://www.w3.org/2000/svg";
  const WAYS = ["ccw", "cw"], NAMES = ["g", "f"];
  let level = null, waiting = 0, heard = 0;

  const $ = (id) => document.getElementById(id);
  const sliders = () => [...document.querySelectorAll(".cause input[type=range]")];

  // Three significant digits, as the report writes them.
  function said(value) {
    if (!Number.isFinite(value)) return "–";
    const rounded = Number(value.toPrecision(3));
    if (rounded === 0) return "0";
    const places = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(rounded)) + 1e-12));
    return rounded.toFixed(Math.min(places, 9)).replace("-", "−");
  }
  const signed = (value) => (value > 0 ? "+" : "") + said(value);

  // The arc that readings cover: the full turn less their widest gap; exactly a turn if no gap is over 10 degrees.
  function arc(angle) {
    const sorted = angle.map((a) => ((a % TURN) + TURN) % TURN).sort((a, b) => a - b);
    let widest = sorted[0] + TURN - sorted[sorted.length - 1];
    for (let i = 1; i < sorted.length; i++) widest = Math.max(widest, sorted[i] - sorted[i - 1]);
    return widest <= GAP ? TURN : TURN - widest;
  }

  function prepared(name, run, radius) {
    const angle = run.deg.map((deg) => (deg * Math.PI) / 180);
    const order = angle.map((_, i) => i).sort((a, b) => ((angle[a] % TURN) + TURN) % TURN - (((angle[b] % TURN) + TURN) % TURN));
    return {
      name, way: run.direction, radius: 1000 * radius, angle, order, arc: arc(angle),
      cos: angle.map(Math.cos), sin: angle.map(Math.sin), measured: run.measured, columns: run.columns,
    };
  }

  function corrected(run, factors) {
    const left = Float64Array.from(run.measured);
    run.columns.forEach((column, k) => {
      const less = 1 - factors[k];
      if (less) for (let i = 0; i < left.length; i++) left[i] -= less * column[i];
    });
    return left;
  }

  // Share of the path that each reading stands for: the arc between it and its neighbours.
  function weights(run, dx, dy) {
    const n = dx.length, weight = new Float64Array(n);
    for (let k = 0; k < n; k++) {
      const i = run.order[k], j = run.order[(k + 1) % n];
      let gap = Math.atan2(dx[i] * dy[j] - dy[i] * dx[j], dx[i] * dx[j] + dy[i] * dy[j]);
      if (gap < 0) gap += TURN;
      if (gap > GAP) gap = 0;
      weight[i] += gap;
      weight[j] += gap;
    }
    return weight;
  }

  function solved(m, b) { // 3 equations, by Cramer
    const det = (p) => p[0] * (p[4] * p[8] - p[5] * p[7]) - p[1] * (p[3] * p[8] - p[5] * p[6]) + p[2] * (p[3] * p[7] - p[4] * p[6]);
    const whole = det(m);
    return [0, 1, 2].map((k) => det(m.map((value, i) => (i % 3 === k ? b[(i - k) / 3] : value))) / whole);
  }

  function leastSquares(value, ux, uy, weight) {
    const m = new Array(9).fill(0), b = [0, 0, 0];
    for (let i = 0; i < value.length; i++) {
      const row = [ux[i], uy[i], 1];
      for (let r = 0; r < 3; r++) {
        b[r] += weight[i] * row[r] * value[i];
        for (let c = 0; c < 3; c++) m[3 * r + c] += weight[i] * row[r] * row[c];
      }
    }
    return solved(m, b);
  }

  // The zone of four readings: centre, radius, half width; negative where they do not hold one.
  function zone(four, value, ux, uy) {
    const share = four.map((_, k) => {
      const [p, q, r] = four.filter((_, j) => j !== k);
      return (k % 2 ? -1 : 1) * (ux[p] * (uy[q] - uy[r]) - uy[p] * (ux[q] - ux[r]) + ux[q] * uy[r] - uy[q] * ux[r]);
    });
    const total = share.reduce((sum, s) => sum + Math.abs(s), 0);
    if (total < 1e-15) return [null, -1];
    const half = share.reduce((sum, s, k) => sum + s * value[four[k]], 0) / total;
    const out = share.reduce((best, s, k) => (Math.abs(s) > Math.abs(share[best]) ? k : best), 0);
    const kept = [0, 1, 2, 3].filter((k) => k !== out);
    const m = kept.flatMap((k) => [ux[four[k]], uy[four[k]], 1]);
    return [solved(m, kept.map((k) => value[four[k]] - (share[k] >= 0 ? 1 : -1) * half)), Math.abs(half)];
  }

  // Chebyshev's problem by an exchange of one reading at a time (Stiefel 1959).
  function minimumZone(value, ux, uy) {
    const n = value.length;
    let chosen = [0, n >> 2, n >> 1, (3 * n) >> 2], [x, half] = zone(chosen, value, ux, uy);
    for (let round = 0; round < 200 && x; round++) {
      let worst = 0, most = -1;
      for (let i = 0; i < n; i++) {
        const left = Math.abs(value[i] - ux[i] * x[0] - uy[i] * x[1] - x[2]);
        if (left > most) [worst, most] = [i, left];
      }
      if (most <= half + 1e-9) break;
      let best = null;
      for (let k = 0; k < 4; k++) {
        const four = [worst, ...chosen.filter((_, j) => j !== k)], found = zone(four, value, ux, uy);
        if (!best || found[1] > best[1][1]) best = [four, found];
      }
      [chosen, [x, half]] = best;
    }
    return x || [0, 0, 0];
  }

  // Least and greatest distance from the settled centre, less the nominal radius.
  function enclosed(run, radial, step, weighted) {
    const n = radial.length, px = new Float64Array(n), py = new Float64Array(n);
    for (let i = 0; i < n; i++) {
      px[i] = (run.radius + radial[i]) * run.cos[i];
      py[i] = (run.radius + radial[i]) * run.sin[i];
    }
    let cx = 0, cy = 0, last = Infinity;
    const dx = new Float64Array(n), dy = new Float64Array(n), value = new Float64Array(n), ux = new Float64Array(n), uy = new Float64Array(n);
    for (let round = 0; ; round++) {
      let least = Infinity, greatest = -Infinity, sum = 0;
      for (let i = 0; i < n; i++) {
        dx[i] = px[i] - cx;
        dy[i] = py[i] - cy;
        const d = Math.hypot(dx[i], dy[i]);
        ux[i] = dx[i] / d;
        uy[i] = dy[i] / d;
        value[i] = d - run.radius;
        sum += value[i];
        least = Math.min(least, value[i]);
        greatest = Math.max(greatest, value[i]);
      }
      const mean = sum / n, around = value.map((v) => v - mean);
      const move = step(around, ux, uy, weighted ? weights(run, dx, dy) : null), size = Math.hypot(move[0], move[1]);
      if (!(size < last / 2) || size < 1e-7 || round > 50) return [least, greatest];
      cx += move[0];
      cy += move[1];
      last = size;
    }
  }

  function deviations(run, radial) {
    const zoned = run.arc < Math.PI ? null : enclosed(run, radial, minimumZone, false);
    const fitted = run.arc < TURN ? null : enclosed(run, radial, leastSquares, true);
    return { g: zoned && zoned[1] - zoned[0], f: fitted };
  }

  const written = (name, found) =>
    found === null ? "–" : name === "g" ? `${said(found)} µm` : `${signed(found[0])} … ${signed(found[1])} µm`;

  function path(run, radial) {
    const n = radial.length, { centre, radius, per_um } = level.drawing;
    let a = 0, b = 0, c2 = 0, s2 = 0, cs = 0, m = 0, c = 0, s = 0;
    for (let i = 0; i < n; i++) {
      a += radial[i] * run.cos[i]; b += radial[i] * run.sin[i]; m += radial[i];
      c2 += run.cos[i] * run.cos[i]; s2 += run.sin[i] * run.sin[i]; cs += run.cos[i] * run.sin[i]; c += run.cos[i]; s += run.sin[i];
    }
    const [ex, ey] = solved([c2, cs, c, cs, s2, s, c, s, n], [a, b, m]); // the offset of the centre is not drawn
    let d = "";
    for (let i = 0; i < n; i++) {
      const r = Math.max(0, radius + per_um * (radial[i] - ex * run.cos[i] - ey * run.sin[i]));
      d += `${i ? "L" : "M"}${(centre[0] + r * run.cos[i]).toFixed(1)} ${(centre[1] - r * run.sin[i]).toFixed(1)}`;
    }
    return run.arc >= TURN ? d + "Z" : d;
  }

  function redraw() {
    waiting = 0;
    if (!level || !$("trace")) return;
    const began = performance.now(), factors = sliders().map((slider) => slider.value / 100);
    const changed = factors.some((factor) => factor !== 1), words = [];
    $("trace").classList.toggle("asked", changed);
    $("trace").querySelector(".legend .if").hidden = !changed;
    for (const run of level.runs) {
      const radial = corrected(run, factors), now = deviations(run, radial);
      run.line.setAttribute("d", changed ? path(run, radial) : "");
      for (const name of NAMES) {
        $(`${name}-${run.way}`).textContent = written(name, now[name]);
        $(`${name}-${run.way}-was`).textContent = changed ? `was ${written(name, run.was[name])}` : "as measured";
      }
      words.push(`${run.way.toUpperCase()} circular deviation ${written("g", now.g)}, radial ${written("f", now.f)}`);
    }
    performance.measure("what-if", { start: began, end: performance.now() });
    clearTimeout(heard);
    heard = setTimeout(() => { $("heard").textContent = changed ? words.join("; ") : ""; }, 700);
  }

  const soon = () => { waiting = waiting || requestAnimationFrame(redraw); };

  function told(slider) {
    document.querySelector(`output[for="${slider.id}"]`).textContent = `${slider.value} %`;
    slider.setAttribute("aria-valuetext", `${slider.value} % of what it is`);
  }

  async function begin(trace) {
    trace.dataset.begun = "yes";
    const answer = await fetch(trace.dataset.whatIf, { headers: { Accept: "application/json" }, credentials: "same-origin" });
    if (!answer.ok || !trace.isConnected) return;
    const document_ = await answer.json(), svg = trace.querySelector(".polar svg");
    const runs = Object.entries(document_.runs).map(([name, run]) => prepared(name, run, document_.radius_mm));
    for (const run of runs) {
      run.line = document.createElementNS(SVG, "path");
      run.line.setAttribute("class", "p-green what-if");
      run.line.setAttribute("stroke-width", "2.4");
      run.line.setAttribute("stroke-dasharray", run.way === "ccw" ? "8 4" : "3 3");
      svg.append(run.line);
      run.was = deviations(run, run.measured);
    }
    level = { runs, drawing: document_.drawing };
    for (const way of WAYS) {
      const there = runs.some((run) => run.way === way);
      for (const cell of document.querySelectorAll(`#deviations .${way}, #g-${way}, #f-${way}`)) (cell.closest("td, th") || cell).hidden = !there;
    }
    for (const one of document.querySelectorAll(".cause input, .cause .much, #reset, #deviations")) one.hidden = false;
    redraw();
  }

  const look = () => { for (const trace of document.querySelectorAll("[data-what-if]:not([data-begun])")) begin(trace); };

  document.addEventListener("input", (event) => {
    if (event.target.matches(".cause input[type=range]")) { told(event.target); soon(); }
  });
  document.addEventListener("click", (event) => {
    if (event.target.id !== "reset") return;
    for (const slider of sliders()) { slider.value = 100; told(slider); }
    soon();
  });
  new MutationObserver(look).observe(document.body, { childList: true, subtree: true });
  look();
})();
