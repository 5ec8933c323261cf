// The picture at a position: the layers of what has been bitten, and over them what changes with every bite.

/** The pixels of a canvas are at most so many times those of the page. */
const MOST_PIXELS_A_PIXEL = 2;

/** A path of many more dots is slow to fill. */
const DOTS_A_PATH = 100;

/** Dots of a smaller radius, in pixels of the canvas, are squares. */
const SQUARE = 1.5;

/** Colours of the page, by the names they have in its style. */
function readColours() {
  const style = getComputedStyle(document.documentElement);
  const names = ["page", "ink", "remaining", "bitten", "bitten-line", "vertex", "boundary", "front", "chosen", "chosen-fill", "gone",
    "corner", "parent", "triangle", "triangle-bad", "triangle-good"];
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** Draws a replay on a canvas. */
class Picture {
  constructor(canvas, replay) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.replay = replay;
    this.layers = new Layers(replay);
    this.domain = polygonsPath(replay.points, replay.outline.rings);
    this.segments = linesPath(replay.points, replay.outline.segments);
    this.corners = polygonsPath(replay.points, replay.outline.corners.map((triangle) => replay.triangles[triangle]));
    this.colours = readColours();
    this.resize();
  }

  /** Takes the size of the canvas on the page, and shows the whole domain. */
  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    this.ratio = Math.min(MOST_PIXELS_A_PIXEL, window.devicePixelRatio || 1);
    this.canvas.width = Math.max(1, Math.round(clientWidth * this.ratio));
    this.canvas.height = Math.max(1, Math.round(clientHeight * this.ratio));
    this.view = View.whole(this.replay.frame, this.canvas.width, this.canvas.height);
    this.settle();
  }

  /** Takes the colours of the page again. */
  recolour() {
    this.colours = readColours();
    this.settle();
  }

  /** Moves the view; until `settle` the layers are only moved and stretched. */
  look(view) {
    this.view = view;
  }

  /** Makes the layers fit the view. */
  settle() {
    this.layers.reset(this.canvas.width, this.canvas.height, this.ratio, this.view, this.colours);
  }

  /** Draws a moment, and a circle or front vertex pointed at. */
  draw(moment, pointed = {}) {
    const { context, canvas, replay } = this;
    context.clearRect(0, 0, canvas.width, canvas.height);
    this.layers.show(moment.bitten);
    this.drawDomain(moment);
    this.drawWaiting(moment);
    if (moment.bite >= 0) this.drawBite(moment.bite);
    if (moment.position > replay.count) this.drawMesh();
    if (pointed.bite >= 0) this.outline(pointed.bite, this.colours.ink);
    if (pointed.vertex >= 0) this.ringAt(pointed.vertex);
  }

  /** The domain, what has been bitten, and the front. */
  drawDomain({ bite, position }) {
    const { context, view, colours, replay } = this;
    const hasFront = position <= replay.count;
    view.inUnits(context, () => {
      context.fillStyle = colours.remaining;
      context.fill(this.domain, "evenodd");
      context.clip(this.domain, "evenodd");
      if (bite >= 0) this.fillBite(bite);
      if (hasFront) this.copy("rim");
      this.copy("bitten");
      context.fillStyle = colours.corner;
      context.fill(this.corners);
      this.copy("marks");
    });
    view.inUnits(context, (pixel) => {
      context.strokeStyle = colours.boundary;
      context.lineWidth = WIDTH.boundary * this.ratio * pixel;
      context.stroke(this.segments);
    });
    if (hasFront) this.copy("edge");
  }

  /** Copies a layer, which may have been made for another view. */
  copy(name) {
    const { context, view, layers } = this;
    const factor = view.scale / layers.view.scale;
    context.save();
    context.setTransform(factor, 0, 0, factor, view.left - factor * layers.view.left, view.bottom - factor * layers.view.bottom);
    context.drawImage(layers.contexts[name].canvas, 0, 0);
    context.restore();
  }

  /** The circle of a bite, of which what has been bitten will hide all but what it takes; in units. */
  fillBite(bite) {
    const { context, replay, colours } = this;
    context.fillStyle = colours["chosen-fill"];
    circlePath(context, replay.x[bite], replay.y[bite], replay.radius[bite]);
    context.fill();
  }

  outline(bite, colour, width = WIDTH.bite) {
    const { context, view, replay } = this;
    context.strokeStyle = colour;
    context.lineWidth = width * this.ratio;
    circlePath(context, view.x(replay.x[bite]), view.y(replay.y[bite]), view.scale * replay.radius[bite]);
    context.stroke();
  }

  dot(x, y, radius, fill, line) {
    const { context, view } = this;
    circlePath(context, view.x(x), view.y(y), radius * this.ratio);
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (line) {
      context.strokeStyle = line;
      context.lineWidth = 1.3 * this.ratio;
      context.stroke();
    }
  }

  /** The front vertices that wait; hollow those that the bite at hand takes. */
  drawWaiting(moment) {
    const { context, colours, replay } = this;
    const { x, y, gone } = replay.vertices;
    context.fillStyle = colours.front;
    const stay = moment.waiting.filter((serial) => gone[serial] !== moment.bite);
    for (let start = 0; start < stay.length; start += DOTS_A_PATH) {
      context.beginPath();
      for (const serial of stay.slice(start, start + DOTS_A_PATH)) this.addDot(serial);
      context.fill();
    }
    for (const serial of takenAt(replay, moment)) this.dot(x[serial], y[serial], this.dotSize(serial), colours.page, colours.gone);
  }

  /** Adds a front vertex to the path, if it can be seen: a square where no one would see that it is none. */
  addDot(serial) {
    const { context, view, canvas, ratio } = this;
    const [x, y] = [view.x(this.replay.vertices.x[serial]), view.y(this.replay.vertices.y[serial])];
    if (x < 0 || y < 0 || x > canvas.width || y > canvas.height) return;
    const size = this.dotSize(serial) * ratio;
    if (size < SQUARE) {
      context.rect(x - size, y - size, 2 * size, 2 * size);
    } else {
      context.moveTo(x + size, y);
      context.arc(x, y, size, 0, 2 * Math.PI);
    }
  }

  /** The radius of a front vertex in pixels of the page: smaller where circles are small. */
  dotSize(serial) {
    const { replay, view, ratio } = this;
    const room = (view.scale * replay.radius[replay.vertices.circles[2 * serial]]) / ratio;
    return Math.max(0.8, Math.min(3.2, 0.2 * room));
  }

  /** The bite at hand, with the points of its label. */
  drawBite(bite) {
    const { colours, replay, view } = this;
    this.drawLabel(bite);
    this.outline(bite, colours.chosen);
    const onScreen = (view.scale * replay.radius[bite]) / this.ratio;
    this.dot(replay.x[bite], replay.y[bite], Math.max(2.2, Math.min(4.5, 0.3 * onScreen)), colours.chosen, colours.page);
    if (onScreen < 9) this.dot(replay.x[bite], replay.y[bite], 14, undefined, colours.chosen);
  }

  /** The circles and points that labels of edge protection name. */
  drawLabel(bite) {
    const { colours, replay, view } = this;
    const label = replay.labels.get(bite);
    if (!label) return;
    const parents = label.parents.filter((parent) => parent >= 0);
    for (const parent of parents) this.outline(parent, colours.parent, 1.4);
    const names = label.parents.map((parent, index) => ({ parent, name: `p${index ? "₂" : "₁"}` }));
    const side = this.sideOf(label.segment, bite);
    const room = (view.scale * replay.radius[bite]) / this.ratio;
    for (const { parent, name } of names.filter(({ parent: known }) => known >= 0)) {
      this.dot(replay.x[parent], replay.y[parent], Math.min(3, 0.25 * room), colours.parent, colours.page);
      this.write(name, replay.x[parent], replay.y[parent], side, colours.parent, room);
    }
    this.write("q", replay.x[bite], replay.y[bite], { x: -side.x, y: -side.y }, colours.chosen, room);
    label.middles.forEach((middle, index) => this.drawMiddle(middle, index, bite, side, room));
  }

  /** q₁ or q₂, its name beside the segment and away from q. */
  drawMiddle(middle, index, bite, side, room) {
    const { colours, replay } = this;
    this.dot(middle.x, middle.y, 2.2, colours.ink, colours.page);
    const [x, y] = [middle.x - replay.x[bite], replay.y[bite] - middle.y];
    const length = Math.hypot(x, y) || 1;
    const way = { x: x / length - 0.7 * side.x, y: y / length - 0.7 * side.y };
    this.write(`q${index ? "₂" : "₁"}`, middle.x, middle.y, way, colours.ink, room);
  }

  /** The unit vector across a segment on the canvas, downward, or to the right if it is upright. */
  sideOf(segment) {
    const { points, outline } = this.replay;
    const [from, to] = outline.segments[segment];
    const [x, y] = [points.x[to] - points.x[from], points.y[to] - points.y[from]];
    const length = Math.hypot(x, y) || 1;
    const side = { x: y / length, y: x / length };
    return side.y < -0.01 || (side.y < 0.01 && side.x < 0) ? { x: -side.x, y: -side.y } : side;
  }

  /** Writes a name beside a place, if its circle has room. */
  write(text, x, y, way, colour, room) {
    if (room < 12) return;
    const { context, view, ratio, colours } = this;
    const away = 15 * ratio;
    context.font = `italic 600 ${14 * ratio}px Georgia, "DejaVu Serif", serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = 3.5 * ratio;
    context.strokeStyle = colours.page;
    context.fillStyle = colour;
    const place = [view.x(x) + away * way.x, view.y(y) + away * way.y];
    context.strokeText(text, ...place);
    context.fillText(text, ...place);
  }

  ringAt(serial) {
    const { x, y } = this.replay.vertices;
    this.dot(x[serial], y[serial], 6, undefined, this.colours.ink);
  }

  /** The triangulation over what has been bitten, in another colour where an angle is under 30°. */
  drawMesh() {
    const { context, view, colours } = this;
    this.mesh ??= this.meshPaths();
    view.inUnits(context, (pixel) => {
      context.globalAlpha = 0.85;
      context.fillStyle = colours["triangle-good"];
      context.fill(this.mesh.good);
      context.fillStyle = colours["triangle-bad"];
      context.fill(this.mesh.bad);
      context.globalAlpha = 1;
      context.strokeStyle = colours.triangle;
      context.lineWidth = this.triangleLine() * this.ratio * pixel;
      context.lineJoin = "round";
      context.stroke(this.mesh.all);
    });
  }

  /** All triangles as a path in units, and those with and without an angle under 30°. */
  meshPaths() {
    const { points, triangles } = this.replay;
    const isBad = triangles.map((triangle) => smallestAngle(this.replay, triangle) < 30);
    return {
      all: polygonsPath(points, triangles),
      good: polygonsPath(points, triangles.filter((_, index) => !isBad[index])),
      bad: polygonsPath(points, triangles.filter((_, index) => isBad[index])),
    };
  }

  /** The width of the lines between triangles in pixels of the page: thinner where they would be all there is to see. */
  triangleLine() {
    const { replay, view, ratio } = this;
    const [width, height] = replay.frame.size;
    const edge = (view.scale * Math.sqrt((width * height) / replay.triangles.length)) / ratio;
    return Math.max(0.2, Math.min(WIDTH.triangle, 0.06 * edge));
  }
}
