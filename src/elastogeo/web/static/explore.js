// Draws the readings of a test with plotly: which runs, measured with model or the residual. The numbers come from the page's JSON.
"use strict";
(async () => {
  const card = document.getElementById("explore");
  if (!card || !window.Plotly) return;
  const drawing = document.getElementById("drawing"), state = document.getElementById("explore-state");
  const links = state.innerHTML, config = JSON.parse(card.dataset.config);
  state.textContent = "The readings are loaded …";
  let data;
  try {
    const answer = await fetch(card.dataset.source, { headers: { accept: "application/json" } });
    if (!answer.ok) throw new Error(String(answer.status));
    data = await answer.json();
  } catch (error) {
    state.textContent = "The readings could not be loaded; load the page again.";
    return;
  }
  const unit = data.unit === "urad" ? "µrad" : "µm";
  const along = data.along.unit === "deg" ? `${data.along.quantity} (°)` : `${data.along.quantity} (${data.along.unit})`;
  const boxes = [...document.querySelectorAll('input[name="run"]')];
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const shade = (k, of) => 0.45 + 0.55 * (of > 1 ? k / (of - 1) : 1);

  function traces(what) {
    const forces = [...new Set(data.runs.map((run) => run.force_N))].sort((a, b) => Math.abs(a) - Math.abs(b));
    return data.runs.flatMap((run, k) => {
      if (!boxes[k].checked) return [];
      const base = run.direction === "cw" ? colour("--orange") : colour("--blue");
      const opacity = shade(forces.indexOf(run.force_N), forces.length);
      const line = (name, y, more) => ({ x: run.along, y, name, type: "scatter", mode: "lines", opacity, line: { color: base, width: 1.4 }, ...more });
      if (what === "residual") {
        const left = run.predicted ? run.measured.map((value, i) => value - run.predicted[i]) : run.measured;
        return [line(run.run, left)];
      }
      const drawn = [line(run.run, run.measured)];
      if (run.predicted) drawn.push(line(`${run.run}, model`, run.predicted, { opacity: 1, line: { color: colour("--ink"), width: 1, dash: "dot" }, showlegend: false }));
      return drawn;
    });
  }

  function draw() {
    const what = document.querySelector('input[name="what"]:checked').value;
    const axis = { gridcolor: colour("--line"), zerolinecolor: colour("--soft"), automargin: true };
    const layout = {
      paper_bgcolor: colour("--paper"), plot_bgcolor: colour("--paper"), font: { color: colour("--ink"), size: 13 },
      margin: { l: 60, r: 15, t: 40, b: 50 }, hovermode: "closest", uirevision: what, showlegend: drawing.clientWidth > 600,
      xaxis: { ...axis, title: { text: along } },
      yaxis: axis,
      title: { text: what === "residual" ? `measured − model (${unit})` : `measured, model (${unit})`, x: 0, xanchor: "left", font: { size: 13 } },
    };
    window.Plotly.react(drawing, traces(what), layout, config);
  }

  for (const box of [...boxes, ...document.querySelectorAll('input[name="what"]')]) box.addEventListener("change", draw);
  const all = (checked) => () => { for (const box of boxes) box.checked = checked; draw(); };
  document.getElementById("all-runs").addEventListener("click", all(true));
  document.getElementById("no-runs").addEventListener("click", all(false));
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  draw();
  state.innerHTML = links.replace("The drawing needs JavaScript; the numbers", "The numbers");
})();
