// The direction of a map is turned here: six elements of the compliance and their covariance at each place, a quadratic form.
// Everything else, and the map of the first direction, comes from the server (report/predictions/section_plot.py).
"use strict";
(() => {
  const PAIRS = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];
  const SVG = "http://www.w3.org/2000/svg";
  const isNumber = (value) => value !== null && Number.isFinite(value);

  /** Weights of the six elements of the compliance along a unit direction. */
  const weightsOf = (e) => PAIRS.map(([i, j]) => e[i] * e[j] * (i === j ? 1 : 2)).map((w) => (Math.abs(w) > 1e-12 ? w : 0));

  /** The compliance along a direction and its U at one place [mm/N]; null where an element that it needs is not told. */
  function along(part, k, weights) {
    const used = weights.map((w) => w !== 0);
    const c = part.compliance_mm_per_N[k], v = part.covariance[k], f = part.coverage[k];
    if (used.some((u, i) => u && c[i] === null)) return null;
    let value = 0, variance = 0, brought = 0, factor = 0, at = 0, known = true;
    for (let i = 0; i < 6; i += 1) {
      value += used[i] ? c[i] * weights[i] : 0;
      for (let j = i; j < 6; j += 1, at += 1) {
        if (!used[i] || !used[j]) continue;
        known = known && v[at] !== null;
        variance += (i === j ? 1 : 2) * weights[i] * weights[j] * v[at];
        if (i === j) {
          brought += v[at] * weights[i] ** 2;
          factor += v[at] * weights[i] ** 2 * f[i] ** 2;
        }
      }
    }
    const half = known ? Math.sqrt((brought > 0 ? factor / brought : factor) * Math.max(variance, 0)) : null;
    return [value, half];
  }

  /** Stiffness [N/um], its U and on what it rests, at each place. */
  function fieldOf(section, direction) {
    const weights = weightsOf(direction);
    const count = section.along_mm[0].length * section.along_mm[1].length;
    const found = { stiffness: [], half: [], resting: [] };
    for (let k = 0; k < count; k += 1) {
      const told = along(section.told, k, weights);
      const one = told || (section.assumed && along(section.assumed, k, weights));
      const positive = one && one[0] > 0;
      found.stiffness.push(positive ? 1 / one[0] / 1000 : null);
      found.half.push(positive && isNumber(one[1]) ? one[1] / one[0] ** 2 / 1000 : null);
      found.resting.push(Boolean(!told && positive));
    }
    return found;
  }

  function levelsOf(values, most) {
    const known = values.filter(isNumber);
    if (!known.length) return [];
    const low = Math.min(...known), high = Math.max(...known);
    if (high - low <= 1e-9 * Math.abs(high)) return [];
    const power = 10 ** Math.floor(Math.log10((high - low) / most));
    const step = [1, 2, 5, 10, 20].map((one) => one * power).find((one) => (high - low) / one <= most);
    const found = [];
    for (let k = Math.floor(low / step) + 1; k * step < high; k += 1) if (k * step > low) found.push(k * step);
    return found;
  }

  /** The field at a place between its places: linear where all four corners are known, else that of the nearest. */
  function between(values, m, n, a, b) {
    const i = Math.min(Math.floor(a), n - 2), j = Math.min(Math.floor(b), m - 2), p = a - i, q = b - j;
    const at = (x, y) => values[(i + x) * m + j + y];
    const four = [at(0, 0), at(0, 1), at(1, 0), at(1, 1)];
    if (four.every(isNumber)) return (1 - p) * ((1 - q) * four[0] + q * four[1]) + p * ((1 - q) * four[2] + q * four[3]);
    return at(p >= 0.5 ? 1 : 0, q >= 0.5 ? 1 : 0);
  }

  const edge = (list, at) => {
    const i = Math.min(Math.floor(at), list.length - 2);
    return list[i] + (at - i) * (list[i + 1] - list[i]);
  };
  const px = (value) => String(Math.round(value * 10) / 10);

  /** Straight pieces where the field is at a level. */
  function contour(values, n, m, steps, level) {
    const rows = (n - 1) * steps + 1, columns = (m - 1) * steps + 1, pieces = [];
    const fine = [];
    for (let i = 0; i < rows; i += 1) for (let j = 0; j < columns; j += 1) fine.push(between(values, m, n, i / steps, j / steps));
    for (let i = 0; i < rows - 1; i += 1) {
      for (let j = 0; j < columns - 1; j += 1) {
        const ring = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        const corner = ring.map(([a, b]) => fine[a * columns + b]);
        if (!corner.every(isNumber)) continue;
        const cut = [];
        for (let k = 0; k < 4; k += 1) {
          const a = corner[k], b = corner[(k + 1) % 4], next = ring[(k + 1) % 4];
          if (a < level === b < level) continue;
          const t = (level - a) / (b - a);
          cut.push([(ring[k][0] + t * (next[0] - ring[k][0])) / steps, (ring[k][1] + t * (next[1] - ring[k][1])) / steps]);
        }
        for (let k = 0; k + 1 < cut.length; k += 2) pieces.push([cut[k], cut[k + 1]]);
      }
    }
    return pieces;
  }

  /** What the parts of the picture share: the field, where its places lie [px], the colour of a value. */
  function chartOf(section, found) {
    const frame = section.frame, [xs, ys] = section.along_mm, n = xs.length, m = ys.length;
    const wide = frame.width - frame.left - frame.right, levels = levelsOf(found.stiffness, frame.levels);
    return {
      frame, xs, ys, n, m, levels, values: found.stiffness,
      across: (v) => frame.left + ((v - xs[0]) / (xs[n - 1] - xs[0])) * wide,
      up: (v) => frame.top + ((ys[m - 1] - v) / (ys[m - 1] - ys[0])) * frame.height,
      colour: (v) => {
        if (!isNumber(v)) return "untold";
        if (!levels.length) return `s${frame.colours / 2}`;
        return `s${Math.round((levels.filter((level) => level <= v).length * (frame.colours - 1)) / levels.length)}`;
      },
    };
  }

  /** The outlines of the cells, one path a colour. */
  function cells({ frame, xs, ys, n, m, values, across, up, colour }) {
    const paths = {}, s = frame.cells;
    for (let j = 0; j < (m - 1) * s; j += 1) {
      const top = px(up(edge(ys, (j + 1) / s))), low = px(up(edge(ys, j / s)));
      let begin = 0, kind = null;
      for (let i = 0; i <= (n - 1) * s; i += 1) {
        const here = i < (n - 1) * s ? colour(between(values, m, n, (i + 0.5) / s, (j + 0.5) / s)) : "";
        if (here === kind) continue;
        if (kind) {
          const a = px(across(edge(xs, begin / s))), b = px(across(edge(xs, i / s)));
          paths[kind] = `${paths[kind] || ""}M${a} ${low}H${b}V${top}H${a}Z`;
        }
        [begin, kind] = [i, here];
      }
    }
    return paths;
  }

  function drawContours({ frame, xs, ys, n, m, levels, values, across, up }, add) {
    for (const level of levels) {
      const pieces = contour(values, n, m, frame.lines, level);
      if (!pieces.length) continue;
      const placed = pieces.map((piece) => piece.map(([a, b]) => [across(edge(xs, a)), up(edge(ys, b))]));
      add("path", { class: "p-contour", d: placed.map(([a, b]) => `M${px(a[0])} ${px(a[1])}L${px(b[0])} ${px(b[1])}`).join("") });
      const [x, y] = placed[Math.floor(placed.length / 2)][0];
      add("text", { class: "f-contour", x: px(x), y: px(y + 4), "text-anchor": "middle" }, number(level, 6));
    }
  }

  /** A triangle at a place; its point is below for a size above zero. */
  function drawMark({ xs, ys, m, across, up }, place, size, add) {
    const x = across(xs[Math.floor(place / m)]), y = up(ys[place % m]);
    add("path", { class: "f-ink", d: `M${px(x)} ${px(y + 1.2 * size)}L${px(x + 5)} ${px(y - size)}L${px(x - 5)} ${px(y - size)}Z` });
  }

  /** Draw the field into the picture; the places where it is known, softest first. */
  function draw(svg, section, found) {
    for (const old of svg.querySelectorAll("[class^='f-s'],.f-untold,.p-contour,.f-contour,.f-paper,.f-ink")) {
      if (old.tagName !== "text" || old.classList.contains("f-contour")) old.remove();
    }
    const first = svg.firstChild; // the axes stay, in front of all that is drawn anew
    const add = (tag, attributes, text) => {
      const element = document.createElementNS(SVG, tag);
      for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
      if (text) element.textContent = text;
      svg.insertBefore(element, first);
    };
    const chart = chartOf(section, found), { xs, ys, m, across, up } = chart;
    for (const [kind, d] of Object.entries(cells(chart))) add("path", { class: `f-${kind}`, d });
    found.resting.forEach((rests, k) => {
      if (rests) add("circle", { class: "f-paper", cx: px(across(xs[Math.floor(k / m)])), cy: px(up(ys[k % m])), r: 1.8 });
    });
    drawContours(chart, add);
    const known = found.stiffness.map((v, k) => [v, k]).filter(([v]) => isNumber(v)).sort((a, b) => a[0] - b[0]);
    if (known.length) {
      drawMark(chart, known[0][1], 5, add);
      drawMark(chart, known[known.length - 1][1], -5, add);
    }
    return known;
  }

  const number = (value, digits) => String(Number(value.toPrecision(digits))).replace("-", "−");

  /** A value and its U to two digits, the value to the same place (JCGM 100, 7.2.6). */
  function said(value, half) {
    if (!isNumber(half) || half <= 0) return number(value, 3);
    const short = Number(half.toExponential(1));
    const places = Math.max(0, 1 - Math.floor(Math.log10(short)));
    return `${value.toFixed(places)} ± ${short.toFixed(places)}`.replace("-", "−");
  }

  function setUp() {
    const figure = document.getElementById("map-figure"), form = document.getElementById("map-form");
    if (!figure || !form || figure.dataset.ready) return;
    figure.dataset.ready = "yes";
    const section = JSON.parse(figure.dataset.section), svg = figure.querySelector("svg");
    const azimuth = document.getElementById("map-azimuth"), elevation = document.getElementById("map-elevation");
    const [xs, ys] = section.along_mm;

    const where = (k) => {
      const at = { [section.axes[0]]: xs[Math.floor(k / ys.length)], [section.axes[1]]: ys[k % ys.length] };
      if (section.height.axis) at[section.height.axis] = section.height.mm;
      return `${Object.keys(at).sort().map((axis) => `${axis} ${number(at[axis], 6)}`).join(" ")} mm`;
    };

    function needle(e) {
      document.getElementById("map-needle").setAttribute("d", `M0 0L${px(50 * e[0])} ${px(-50 * e[1])}`);
    }

    /** What the section says along a direction, in the sentences of the server (report/predictions/section_view.py). */
    function answerOf(way, known, found) {
      if (!known.length) return `Nothing is known of the stiffness along ${way} in this section: none of these tests tells it, and nothing is guessed.`;
      const soft = known[0], stiff = known[known.length - 1], spot = ([v, k]) => `${said(v, found.half[k])} N/µm`;
      if (soft[1] === stiff[1]) return `Along ${way} the stiffness is ${spot(soft)} at ${where(soft[1])}, the only place known here.`;
      if (stiff[0] - soft[0] < 1e-9 * soft[0]) return `Along ${way} the stiffness is ${spot(soft)} at each of the ${known.length} places known.`;
      return `Along ${way} the machine is softest, ${spot(soft)}, at ${where(soft[1])}, and stiffest, ${spot(stiff)}, at ${where(stiff[1])}.`;
    }

    function toldOf(known, found) {
      const count = known.length - found.resting.filter(Boolean).length, places = found.stiffness.length;
      return count < places
        ? `The tests tell it ${count ? `at ${count} of ${places} places` : "at none of the places"} of this section; what is grey was never tested.`
        : "The tests tell it at every place of this section.";
    }

    function turn() {
      const a = (Number(azimuth.value) * Math.PI) / 180, b = (Number(elevation.value) * Math.PI) / 180;
      const e = [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)].map((v) => (Math.abs(v) < 1e-12 ? 0 : v));
      const found = fieldOf(section, e), known = draw(svg, section, found);
      const axis = e.findIndex((v) => Math.abs(v) > 1 - 1e-12), up = `${elevation.value.replace("-", "−")}°`;
      const way = axis >= 0 ? "XYZ"[axis] : `${azimuth.value}° from X to Y, ${up} up to Z`, answer = answerOf(way, known, found);
      azimuth.nextElementSibling.textContent = `${azimuth.value}°`;
      elevation.nextElementSibling.textContent = up;
      document.getElementById("map-direction").textContent = `stiffness along ${way}`;
      needle(e);
      document.getElementById("map-answer").textContent = answer;
      svg.setAttribute("aria-label", answer);
      const told = document.getElementById("map-told");
      if (told && !section.assumed) told.textContent = toldOf(known, found);
      window.elastogeoMap = found; // for the tests: the numbers that are drawn
    }

    const remember = () => {
      const query = new URLSearchParams(new FormData(form));
      history.replaceState(history.state, "", `${location.pathname}?${query}`);
    };
    for (const input of [azimuth, elevation]) {
      input.addEventListener("input", turn);
      input.addEventListener("change", remember);
    }
    for (const button of form.querySelectorAll("[data-azimuth]")) {
      button.addEventListener("click", (event) => {
        event.preventDefault();
        azimuth.value = button.dataset.azimuth;
        elevation.value = button.dataset.elevation;
        turn();
        remember();
      });
    }
    needle(section.direction);
  }

  document.addEventListener("DOMContentLoaded", setUp);
  for (const name of ["htmx:after:swap", "htmx:after:process"]) document.addEventListener(name, setUp);
  setUp();
})();
