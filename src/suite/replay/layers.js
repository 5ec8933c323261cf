// What has been bitten, kept in layers to which a bite adds its circle.
//
// The front is what is left around the union of the circles. So the layer `rim` has all circles a little too large, in the
// front's colour, and the layer `bitten` over it has them as they are: what shows of the rim is the front. The layer `edge` has
// the segments of the first front, out of which every circle is erased. The layer `marks` has what is to be seen of old bites.

/** Widths in pixels. */
const WIDTH = { front: 2.2, boundary: 1.2, bite: 2, circle: 0.8, triangle: 0.8 };

/** Going back redraws only the boxes of the circles that go, if they are so few. */
const FEW = 12;

/** A full circle as a new path. */
function circlePath(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}

/** Where units of the recording are on the canvas: `scale` pixels a unit, the frame's lower left corner at (left, bottom). */
class View {
  constructor(scale, left, bottom) {
    this.scale = scale;
    this.left = left;
    this.bottom = bottom;
  }

  /** The whole frame within a canvas. */
  static whole(frame, width, height) {
    const margin = 0.04 * Math.min(width, height) + 4;
    const [frameWidth, frameHeight] = frame.size;
    const scale = Math.min((width - 2 * margin) / frameWidth, (height - 2 * margin) / frameHeight);
    return new View(scale, (width - scale * frameWidth) / 2, (height + scale * frameHeight) / 2);
  }

  x(units) {
    return this.left + this.scale * units;
  }

  y(units) {
    return this.bottom - this.scale * units;
  }

  moved(right, down) {
    return new View(this.scale, this.left + right, this.bottom + down);
  }

  /** Nearer by a factor, with the pixel (x, y) staying where it is. */
  zoomed(factor, x, y) {
    return new View(this.scale * factor, x + factor * (this.left - x), y + factor * (this.bottom - y));
  }

  /** Lets `draw` give coordinates in units, and widths in units too. */
  inUnits(context, draw) {
    context.save();
    context.setTransform(this.scale, 0, 0, -this.scale, this.left, this.bottom);
    draw(1 / this.scale);
    context.restore();
  }
}

/** Straight lines between mesh vertices, as a path in units. */
function linesPath(points, lines) {
  const path = new Path2D();
  for (const [from, ...others] of lines) {
    path.moveTo(points.x[from], points.y[from]);
    for (const vertex of others) path.lineTo(points.x[vertex], points.y[vertex]);
  }
  return path;
}

/** Polygons of mesh vertices, as a path in units. */
function polygonsPath(points, polygons) {
  return linesPath(points, polygons.map((polygon) => [...polygon, polygon[0]]));
}

/** Makes a box hold another. */
function widen(box, other) {
  box.left = Math.min(box.left, other.left);
  box.right = Math.max(box.right, other.right);
  box.top = Math.min(box.top, other.top);
  box.bottom = Math.max(box.bottom, other.bottom);
}

/** What has been bitten, in layers as large as the canvas. */
class Layers {
  constructor(replay) {
    this.replay = replay;
    this.firstFront = linesPath(replay.points, replay.outline.front);
    this.contexts = {};
    const blank = () => document.createElement("canvas").getContext("2d");
    for (const name of ["rim", "bitten", "edge", "marks"]) this.contexts[name] = blank();
    this.uncut = blank();
    this.scratch = blank();
    /** How many bites they show; −1 before they show anything. */
    this.done = -1;
  }

  /** Throws away what is there. */
  reset(width, height, ratio, view, colours) {
    for (const context of [...Object.values(this.contexts), this.uncut]) {
      context.canvas.width = width;
      context.canvas.height = height;
    }
    Object.assign(this, { width, height, ratio, view, colours, done: -1 });
    this.drawFirstFront();
  }

  /** Makes them show the first `bites`. */
  show(bites) {
    if (this.done > bites && this.done - bites <= FEW) {
      while (this.done > bites) this.take(this.done - 1);
    } else if (this.done > bites || this.done < 0) {
      for (const [name, context] of Object.entries(this.contexts)) this.begin(name, context);
      this.done = 0;
    }
    for (; this.done < bites; this.done += 1) this.add(this.done);
  }

  /** Draws the segments of the first front, of which layers take copies. */
  drawFirstFront() {
    const { uncut, view } = this;
    view.inUnits(uncut, (pixel) => {
      uncut.strokeStyle = this.colours.front;
      uncut.lineCap = "round";
      uncut.lineWidth = WIDTH.front * this.ratio * pixel;
      uncut.stroke(this.firstFront);
    });
  }

  /** A layer before the first bite, or the part of it from (left, top) on. */
  begin(name, context, left = 0, top = 0) {
    context.clearRect(0, 0, context.canvas.width, context.canvas.height);
    if (name === "edge") context.drawImage(this.uncut.canvas, -left, -top);
  }

  /**
   * Takes the last bite back: its box is drawn again without it. That is done on a small canvas with room for what is to be seen
   * of whole circles, since a circle drawn through a clip has other pixels along its edge than it had before.
   */
  take(bite) {
    this.done = bite;
    const { left, right, top, bottom } = this.seen(this.boxOf(bite));
    if (left >= right || top >= bottom) return;
    const near = [];
    const room = { left, right, top, bottom };
    for (let other = 0; other < bite; other += 1) {
      if (this.meets(other, { left, right, top, bottom })) {
        near.push(other);
        widen(room, this.seen(this.boxOf(other)));
      }
    }
    const view = this.view.moved(-room.left, -room.top);
    const area = [right - left, bottom - top];
    this.scratch.canvas.width = room.right - room.left;
    this.scratch.canvas.height = room.bottom - room.top;
    for (const [name, context] of Object.entries(this.contexts)) {
      this.begin(name, this.scratch, room.left, room.top);
      for (const other of near) this.addTo(name, this.scratch, other, view);
      context.clearRect(left, top, ...area);
      context.drawImage(this.scratch.canvas, left - room.left, top - room.top, ...area, left, top, ...area);
    }
  }

  /** The part of a box that is on the canvas. */
  seen({ left, right, top, bottom }) {
    return {
      left: Math.max(0, left),
      right: Math.min(this.width, right),
      top: Math.max(0, top),
      bottom: Math.min(this.height, bottom),
    };
  }

  /** The whole pixels that a bite may have touched. */
  boxOf(bite) {
    const { replay, view } = this;
    const [x, y] = [view.x(replay.x[bite]), view.y(replay.y[bite])];
    const reach = view.scale * replay.radius[bite] + 3 * WIDTH.front * this.ratio;
    return {
      left: Math.floor(x - reach),
      right: Math.ceil(x + reach),
      top: Math.floor(y - reach),
      bottom: Math.ceil(y + reach),
    };
  }

  /** Whether a bite can show in a box. */
  meets(bite, box) {
    const { left, right, top, bottom } = this.boxOf(bite);
    return left < box.right && right > box.left && top < box.bottom && bottom > box.top;
  }

  /** Adds a bite's circle to all layers, if it can be seen. */
  add(bite) {
    if (!this.meets(bite, { left: 0, top: 0, right: this.width, bottom: this.height })) return;
    for (const [name, context] of Object.entries(this.contexts)) this.addTo(name, context, bite, this.view);
  }

  /** Adds a bite's circle to a layer, but for what its centre cannot see. */
  addTo(name, context, bite, view) {
    const { replay } = this;
    const circle = [view.x(replay.x[bite]), view.y(replay.y[bite]), view.scale * replay.radius[bite]];
    const shadows = replay.shadows.get(bite) ?? [];
    if (shadows.length) this.clipShadows(context, bite, shadows, view);
    if (name === "marks") this.mark(context, ...circle);
    else this.fill(name, context, ...circle);
    if (shadows.length) context.restore();
  }

  fill(name, context, x, y, radius) {
    const { colours, ratio } = this;
    // Lines are erased to their full width: circles may be smaller than that.
    const more = { rim: WIDTH.front, bitten: 0, edge: 0.5 * WIDTH.front }[name];
    circlePath(context, x, y, radius + more * ratio);
    context.globalCompositeOperation = name === "edge" ? "destination-out" : "source-over";
    context.fillStyle = name === "rim" ? colours.front : colours.bitten;
    context.fill();
    context.globalCompositeOperation = "source-over";
  }

  /** The circle, thin, and its centre. */
  mark(context, x, y, radius) {
    const { colours, ratio } = this;
    context.strokeStyle = colours["bitten-line"];
    context.lineWidth = WIDTH.circle * ratio;
    circlePath(context, x, y, radius);
    context.stroke();
    context.fillStyle = colours.vertex;
    circlePath(context, x, y, Math.min(1.8 * ratio, 0.15 * radius));
    context.fill();
  }

  /** Leaves out what the centre cannot see behind sides of notches. */
  clipShadows(context, bite, shadows, view) {
    const { replay } = this;
    const { width, height } = context.canvas;
    const [centreX, centreY] = [view.x(replay.x[bite]), view.y(replay.y[bite])];
    context.save();
    for (const side of shadows) {
      const ends = side.map((vertex) => [view.x(replay.points.x[vertex]), view.y(replay.points.y[vertex])]);
      const far = ends.map(([x, y]) => {
        const stretch = (4 * view.scale * replay.radius[bite]) / Math.max(1e-9, Math.hypot(x - centreX, y - centreY));
        return [x + stretch * (x - centreX), y + stretch * (y - centreY)];
      });
      context.beginPath();
      context.rect(-1, -1, width + 2, height + 2);
      [ends[0], ends[1], far[1], far[0]].forEach(([x, y], index) => (index ? context.lineTo(x, y) : context.moveTo(x, y)));
      context.closePath();
      context.clip("evenodd");
    }
  }
}
