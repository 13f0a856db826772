"use strict";
// Draws the figures of the page with Vega, without `eval`, and lets sliders move them. The SVG pictures stay where this fails, and for paper.
(() => {
  const { figures } = JSON.parse(document.getElementById("data").textContent);
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const colors = { "#222222": "--ink", "#DDDDDD": "--line", "#888888": "--muted", white: "--page" };
  const painted = /^(background|stroke|fill|[a-zA-Z]*[cC]olor)$/;
  const tip = document.getElementById("tip");

  const themed = (spec) => {
    const style = getComputedStyle(document.documentElement);
    // Texts are left alone: a scene may be called `white`.
    return JSON.parse(JSON.stringify(spec), (key, value) => (painted.test(key) && Object.hasOwn(colors, value) ? style.getPropertyValue(colors[value]).trim() : value));
  };

  // Texts of the input are set as text, never as HTML.
  const show = (value, left, top) => {
    tip.hidden = value === null || value === undefined;
    if (tip.hidden) return;
    const lines = typeof value === "object" ? Object.entries(value) : [["", String(value)]];
    tip.replaceChildren(...lines.map(([name, text]) => {
      const line = document.createElement("div");
      line.textContent = name ? `${name}: ${text}` : text;
      return line;
    }));
    tip.style.left = `${Math.max(4, Math.min(left + 12, innerWidth - tip.offsetWidth - 4))}px`;
    tip.style.top = `${top + 16 + tip.offsetHeight > innerHeight ? top - tip.offsetHeight - 8 : top + 16}px`;
  };
  const tooltip = (handler, event, item, value) => show(event ? value : null, event?.clientX, event?.clientY);

  // One tab stop per figure; arrow keys go from point to point.
  const marks = (place) => [...place.querySelectorAll("[role=graphics-symbol]")].filter((mark) => mark.__data__ && mark.__data__.tooltip);
  const reachable = (place) => marks(place).forEach((mark, number) => mark.setAttribute("tabindex", number ? "-1" : "0"));
  const steps = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };
  const keys = (place) => {
    place.addEventListener("keydown", (event) => {
      if (event.key === "Escape") show(null);
      const all = marks(place), at = all.indexOf(event.target);
      if (at < 0 || !steps[event.key]) return;
      event.preventDefault();
      const next = all[(at + steps[event.key] + all.length) % all.length];
      all[at].setAttribute("tabindex", "-1");
      next.setAttribute("tabindex", "0");
      next.focus();
    });
    place.addEventListener("focusin", (event) => {
      const box = event.target.getBoundingClientRect();
      if (event.target.__data__) show(event.target.__data__.tooltip, box.left, box.top);
    });
    place.addEventListener("focusout", () => show(null));
  };

  const rows = (columns) => {
    const names = Object.keys(columns);
    return names.length ? columns[names[0]].map((_, n) => Object.fromEntries(names.filter((name) => columns[name][n] !== null).map((name) => [name, columns[name][n]]))) : [];
  };

  const move = async (box, figure, view, number) => {
    const state = figure.states[number], input = box.querySelector("input");
    input.value = number;
    input.setAttribute("aria-valuetext", state.label);
    box.querySelector("[data-label]").textContent = state.label;
    box.querySelector("[data-base]").textContent = state.base;
    box.querySelector("[data-take]").textContent = state.take;
    box.querySelector("[data-reasons]").replaceChildren(...state.reasons.map((text) => {
      const item = document.createElement("li");
      item.textContent = text;
      return item;
    }));
    if (!view) return;
    figure.data.forEach((name, n) => view.data(name, rows(state.rows[n])));
    await view.runAsync();
    reachable(box);
  };

  const draw = async (box) => {
    const figure = figures[Number(box.dataset.figure)], place = box.querySelector(".drawing");
    const options = { mode: "vega-lite", renderer: "svg", ast: true, actions: false, defaultStyle: false, tooltip };
    if (box.result) box.result.finalize();
    box.result = await vegaEmbed(place, themed(figure.spec), options);
    box.classList.add("drawn");
    reachable(box);
    if (figure.states) await move(box, figure, box.result.view, Number(box.querySelector("input").value));
  };

  const boxes = [...document.querySelectorAll("[data-figure]")];
  const drawAll = async () => {
    for (const box of boxes) await draw(box);
    document.documentElement.dataset.drawn = boxes.length;
  };
  for (const box of boxes) {
    const figure = figures[Number(box.dataset.figure)];
    keys(box.querySelector(".drawing"));
    if (!figure.states) continue;
    const go = (number) => move(box, figure, box.result && box.result.view, number);
    box.querySelector("input").addEventListener("input", (event) => go(Number(event.target.value)));
    for (const button of box.querySelectorAll("button")) button.addEventListener("click", () => go(Number(button.value)));
  }
  dark.addEventListener("change", drawAll);
  drawAll();
})();
