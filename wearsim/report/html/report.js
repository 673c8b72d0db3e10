"use strict";
(() => {
  const charts = JSON.parse(document.getElementById("charts").textContent);
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const paper = window.matchMedia("print");

  const colour = (name) =>
    getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

  function painted(trace) {
    const role = trace.meta.role;
    if (role === "between") {
      return { ...trace, fillcolor: `${colour("worn")}55` };
    }
    if (role === "body") {
      const line = { ...trace.line, color: colour("mate") };
      return { ...trace, line, fillcolor: colour("body") };
    }
    const own = { color: colour(role) };
    const error = trace.error_x && { ...trace.error_x, ...own, thickness: 2, width: 6 };
    return {
      ...trace,
      ...(trace.type === "bar" ? {} : { line: { ...trace.line, ...own } }),
      marker: { ...trace.marker, ...own },
      ...(error ? { error_x: error } : {}),
    };
  }

  function furnished(layout) {
    const found = { ...layout, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: colour("page") };
    const font = { color: colour("text"), size: 13, family: "system-ui, sans-serif" };
    found.font = font;
    found.hoverlabel = { bgcolor: colour("panel"), bordercolor: colour("line"), font };
    found.transition = still.matches ? { duration: 0 } : undefined;
    for (const key of Object.keys(layout).filter((name) => /^[xy]axis/.test(name))) {
      found[key] = {
        ...layout[key], gridcolor: colour("line"), linecolor: colour("mate"), zeroline: false,
        showline: true, mirror: true, showgrid: true, ticks: "outside", tickcolor: colour("mate"),
      };
    }
    return found;
  }

  // What the slider and the legend have changed is kept when colours change.
  function drawn(place, chart) {
    const data = chart.data.map((trace, index) => {
      const shown = place.data ? place.data[index] : {};
      const kept = {};
      for (const key of ["x", "y", "visible"]) {
        if (shown[key] !== undefined) {
          kept[key] = shown[key];
        }
      }
      return painted({ ...trace, ...kept });
    });
    return [data, furnished(chart.layout)];
  }

  const settings = {
    responsive: true, displaylogo: false,
    modeBarButtonsToRemove: ["lasso2d", "select2d", "autoScale2d"],
  };

  function reachable(place) {
    place.querySelectorAll(".legendtoggle").forEach((toggle) => {
      const item = toggle.closest(".traces");
      const trace = item.__data__[0].trace;
      toggle.setAttribute("tabindex", "0");
      toggle.setAttribute("role", "checkbox");
      toggle.setAttribute("aria-checked", String(trace.visible !== "legendonly"));
      toggle.setAttribute("aria-label", `show ${item.querySelector(".legendtext").textContent}`);
      toggle.onkeydown = (event) => {
        if (event.key !== "Enter" && event.key !== " ") {
          return;
        }
        event.preventDefault();
        const group = place.data.map((one, index) => [one, index])
          .filter(([one]) => trace.legendgroup && one.legendgroup === trace.legendgroup)
          .map(([, index]) => index);
        const visible = trace.visible === "legendonly" ? true : "legendonly";
        Plotly.restyle(place, { visible }, group.length ? group : [trace.index]);
      };
    });
  }

  // One coordinate of what is worn off, of the new flank, the worn one and its deepest point.
  function enlarged(start, shift, slider, factor) {
    const worn = start.map((value, index) => value + factor * shift[index]);
    return [start.concat(worn.slice().reverse()), start, worn, [worn[slider.deepest]]];
  }

  function enlarge(slider, factor) {
    return {
      x: enlarged(slider.x, slider.dx, slider, factor),
      y: enlarged(slider.y, slider.dy, slider, factor),
    };
  }

  function listen(place, chart) {
    const input = document.getElementById(`${place.id}-slider`);
    if (!input) {
      return;
    }
    const output = document.getElementById(`${place.id}-factor`);
    input.addEventListener("input", () => {
      output.textContent = `× ${input.value}`;
      input.setAttribute("aria-valuetext", `${input.value} times`);
      const flanks = [0, 1, 2, 3].map((index) => chart.slider.first + index);
      Plotly.restyle(place, enlarge(chart.slider, Number(input.value)), flanks);
    });
  }

  document.documentElement.classList.add("live");
  const places = [...document.querySelectorAll("[data-chart]")];
  for (const place of places) {
    const chart = charts[place.dataset.chart];
    if ("first" in chart.slider) {
      const { x, y } = enlarge(chart.slider, chart.slider.factor);
      x.forEach((values, index) =>
        Object.assign(chart.data[chart.slider.first + index], { x: values, y: y[index] }));
    }
    Plotly.newPlot(place, ...drawn(place, chart), settings);
    place.on("plotly_afterplot", () => reachable(place));
    reachable(place);
    listen(place, chart);
  }
  dark.addEventListener("change", () => {
    if (!paper.matches) {
      places.forEach((place) => Plotly.react(place, ...drawn(place, charts[place.id]), settings));
    }
  });
  let opened = [];
  window.addEventListener("beforeprint", () => {
    opened = [...document.querySelectorAll("details:not([open])")];
    opened.forEach((one) => one.setAttribute("open", ""));
  });
  window.addEventListener("afterprint", () => {
    opened.forEach((one) => one.removeAttribute("open"));
  });
})();
