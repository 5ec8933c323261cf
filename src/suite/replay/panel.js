// The words, numbers and legend beside the picture.

function element(id) {
  return document.getElementById(id);
}

function make(tag, text, attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

/** Writes a text, with the b of c_b lowered. */
function tell(place, text) {
  const parts = text.split("c_b");
  place.replaceChildren(...parts.flatMap((part, index) => (index ? ["c", make("sub", "b"), part] : [part])));
}

/** A step has its name on the timeline if it takes more than this share of it. */
const LEAST_SHARE = 0.1;

/** The words and numbers beside the picture. */
class Panel {
  constructor(replay, player) {
    this.replay = replay;
    this.player = player;
    this.starts = stepStarts(replay);
    this.kinds = Object.keys(KINDS).filter((letter) => replay.reasons.includes(letter));
    this.describe();
    this.listSteps();
    this.listCounts();
  }

  describe() {
    const { about } = this.replay;
    document.title = `Biting ${about.domain}: a replay`;
    element("title").textContent = `Biting ${about.domain}`;
    tell(
      element("subtitle"),
      `spacing ${about.spacing}, c_b = ${brief(about.c_b)}, t = α c_b = ${brief(about.t)}, order of bites ${about.order}, ` +
        `${some(this.replay.count, "bite")}`,
    );
    element("command").textContent = about.command;
  }

  listSteps() {
    STEPS.forEach((step, index) => {
      const start = this.starts[index];
      if (start < 0) return;
      const button = make("button", `${step.paper}: ${step.name}`, { type: "button", "data-step": index });
      button.addEventListener("click", () => this.player.jump(start));
      const item = make("li", "");
      item.append(button);
      element("steps").append(item);
      if (index === 0) return;
      const later = this.starts.slice(index + 1).find((other) => other >= 0) ?? lastPosition(this.replay);
      const share = (later - start) / lastPosition(this.replay);
      const name = share > LEAST_SHARE ? step.name : "";
      element("bands").append(make("span", name, { style: `flex: ${later - start} 0 0`, title: step.name }));
    });
  }

  listCounts() {
    this.cells = {};
    const rows = [...this.kinds.map((letter) => [letter, KINDS[letter]]), ["waiting", "Front vertices waiting now"]];
    for (const [key, name] of rows) {
      const row = make("tr", "");
      this.cells[key] = make("td", "");
      row.append(make("th", name, { scope: "row" }), this.cells[key]);
      element("counts").tBodies[0].append(row);
    }
  }

  show(moment) {
    const { replay, player, cells } = this;
    for (const button of element("steps").querySelectorAll("button")) {
      if (Number(button.dataset.step) === moment.step) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    }
    const { title, text } = explain(replay, moment);
    element("why").setAttribute("aria-live", player.isPlaying ? "off" : "polite");
    element("why-title").textContent = title;
    tell(element("why-text"), text);
    for (const letter of this.kinds) cells[letter].textContent = countOf(replay, letter, moment.position).toLocaleString("en");
    cells.waiting.textContent = moment.waiting.length.toLocaleString("en");
    this.showControls(moment.position, STEPS[moment.step].name, title);
  }

  showControls(position, step, title) {
    const { replay, player } = this;
    const slider = element("slider");
    slider.value = position;
    slider.setAttribute("aria-valuetext", `${step}, ${title}`);
    element("picture").setAttribute("aria-label", `${replay.about.domain}: ${step}. ${title}`);
    element("position").textContent = `${Math.min(position, replay.count).toLocaleString("en")} of ${some(replay.count, "bite")}`;
    element("speed").value = player.speed;
    element("play").setAttribute("aria-pressed", player.isPlaying);
    element("play").setAttribute("aria-label", player.isPlaying ? "Pause" : "Play");
    element("back").disabled = element("previous-step").disabled = position === 0;
    element("forward").disabled = element("next-step").disabled = position === lastPosition(replay);
    element("closer").disabled = biteAt(replay, position) < 0;
  }
}

/** Small pictures of what is to be seen, each with its words. */
const LEGEND = [
  ["what is left of the domain", (draw, colours) => draw.box(colours.remaining)],
  ["bitten, with circles and their centres", (draw, colours) => draw.bitten(colours)],
  ["the front: arcs, and segments not yet covered", (draw, colours) => draw.line(colours.front, 2.5)],
  ["the circle being bitten, round the point chosen", (draw, colours) => draw.bite(colours)],
  ["front vertices that wait", (draw, colours) => draw.dot(3.2, colours.front)],
  ["those the bite takes", (draw, colours) => draw.dot(3.2, colours.page, colours.gone)],
  ["p₁, p₂ of a label, and their circles", (draw, colours) => draw.ring(colours.parent)],
  ["corner cut off", (draw, colours) => draw.box(colours.corner), (replay) => replay.outline.corners.length > 0],
  ["triangle of the mesh", (draw, colours) => draw.box(colours["triangle-good"], colours.triangle)],
  ["triangle with an angle under 30°", (draw, colours) => draw.box(colours["triangle-bad"], colours.triangle)],
];

/** Draws one entry of the legend. */
class Sample {
  constructor(canvas, ratio) {
    canvas.width = 34 * ratio;
    canvas.height = 22 * ratio;
    this.context = canvas.getContext("2d");
    this.context.scale(ratio, ratio);
  }

  paint(fill, line, width = 1.3) {
    const { context } = this;
    context.lineWidth = width;
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (line) {
      context.strokeStyle = line;
      context.stroke();
    }
  }

  box(fill, line) {
    this.context.beginPath();
    this.context.rect(2, 3, 30, 16);
    this.paint(fill, line);
  }

  line(colour, width) {
    this.context.beginPath();
    this.context.arc(17, 40, 28, -2.1, -1.04);
    this.paint(undefined, colour, width);
  }

  dot(radius, fill, line) {
    circlePath(this.context, 17, 11, radius);
    this.paint(fill, line);
  }

  ring(colour) {
    circlePath(this.context, 17, 11, 9);
    this.paint(undefined, colour);
    this.dot(2.5, colour);
  }

  bitten(colours) {
    this.box(colours.bitten);
    circlePath(this.context, 17, 11, 7);
    this.paint(undefined, colours["bitten-line"]);
    this.dot(1.8, colours.vertex);
  }

  bite(colours) {
    circlePath(this.context, 17, 11, 9);
    this.paint(colours["chosen-fill"], colours.chosen, 2);
    this.dot(3, colours.chosen);
  }
}

function showLegend(replay, colours, ratio) {
  const wanted = LEGEND.filter(([, , applies]) => !applies || applies(replay));
  const items = wanted.map(([words, draw]) => {
    const canvas = make("canvas", "", { "aria-hidden": "true" });
    draw(new Sample(canvas, ratio), colours);
    const item = make("li", "");
    item.append(canvas, make("span", words));
    return item;
  });
  element("legend").replaceChildren(...items);
}
