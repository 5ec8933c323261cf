// The pointer: moves the view, and asks what is there.

/** Milliseconds without a gesture after which the layers are made to fit the view. */
const SETTLE_AFTER = 120;

/** How near, in pixels of the page, the pointer must come to a front vertex. */
const NEAR = 7;

/** Pixels that the radius of a bite has when the view is brought to it. */
const CLOSE = 70;

/** The view shows a domain from half its size to where a circle of this many units fills it. */
const ZOOM = { out: 0.5, in: 200 };

/** What the pointer is on: a front vertex, else the bitten circle whose centre is nearest for its size. */
function pointedAt(replay, position, view, x, y, near) {
  const bite = biteAt(replay, position);
  const waiting = bite < 0 ? [] : waitingBefore(replay, bite);
  const distance = (axisX, axisY, index) => Math.hypot(view.x(axisX[index]) - x, view.y(axisY[index]) - y);
  const { vertices } = replay;
  const close = waiting.filter((serial) => distance(vertices.x, vertices.y, serial) < near);
  const vertex = close.reduce(
    (best, serial) => (best < 0 || distance(vertices.x, vertices.y, serial) < distance(vertices.x, vertices.y, best) ? serial : best),
    -1,
  );
  if (vertex >= 0) return { vertex, waiting };
  let found = { bite: -1 };
  let least = 1;
  for (let other = 0; other < Math.min(position, replay.count); other += 1) {
    const share = distance(replay.x, replay.y, other) / (view.scale * replay.radius[other]);
    if (share < least) [found, least] = [{ bite: other }, share];
  }
  return found;
}

/** Drag, wheel and pinch move the view; pointing shows what is there. */
class Pointer {
  constructor(picture, position, redraw) {
    Object.assign(this, { picture, position, redraw, down: new Map(), pointed: {} });
    const { canvas } = picture;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.down.delete(event.pointerId));
    canvas.addEventListener("pointerleave", () => this.point(undefined));
    canvas.addEventListener("wheel", (event) => this.turn(event), { passive: false });
  }

  /** Where an event is, in pixels of the canvas. */
  place(event) {
    const { ratio } = this.picture;
    return { x: event.offsetX * ratio, y: event.offsetY * ratio };
  }

  press(event) {
    this.picture.canvas.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, this.place(event));
    this.point(event);
  }

  move(event) {
    const before = this.down.get(event.pointerId);
    if (!before) {
      this.point(event);
      return;
    }
    const now = this.place(event);
    const others = [...this.down].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    this.down.set(event.pointerId, now);
    if (others.length) this.pinch(before, now, others[0]);
    else this.look(this.picture.view.moved(now.x - before.x, now.y - before.y));
  }

  /** One of two fingers moves: the place under the other stays where it is. */
  pinch(before, now, other) {
    const apart = (place) => Math.max(1, Math.hypot(place.x - other.x, place.y - other.y));
    this.zoom(apart(now) / apart(before), (now.x + other.x) / 2, (now.y + other.y) / 2);
  }

  turn(event) {
    event.preventDefault();
    const { x, y } = this.place(event);
    const lines = event.deltaMode === 1 ? 30 : 1;
    this.zoom(Math.exp(-0.0015 * lines * event.deltaY), x, y);
  }

  zoom(factor, x, y) {
    const { view, replay, canvas } = this.picture;
    const whole = View.whole(replay.frame, canvas.width, canvas.height).scale;
    const most = canvas.width / ZOOM.in;
    const scale = Math.max(ZOOM.out * whole, Math.min(most, view.scale * factor));
    this.look(view.zoomed(scale / view.scale, x, y));
  }

  /** Changes the view, at first with the layers as they are. */
  look(view) {
    this.point(undefined);
    this.picture.look(view);
    clearTimeout(this.settling);
    this.settling = setTimeout(() => {
      this.picture.settle();
      this.redraw();
    }, SETTLE_AFTER);
    this.redraw();
  }

  /** Brings the view to a bite. */
  close(bite) {
    const { picture } = this;
    const { replay, ratio, canvas } = picture;
    const scale = (CLOSE * ratio) / replay.radius[bite];
    picture.look(new View(scale, canvas.width / 2 - scale * replay.x[bite], canvas.height / 2 + scale * replay.y[bite]));
    picture.settle();
    this.redraw();
  }

  whole() {
    this.picture.resize();
    this.redraw();
  }

  /** Shows in words what an event points at, or nothing. */
  point(event) {
    const hint = element("hint");
    const { picture } = this;
    const { replay } = picture;
    const before = JSON.stringify([this.pointed.bite, this.pointed.vertex]);
    this.pointed = {};
    if (event) {
      const { x, y } = this.place(event);
      this.pointed = pointedAt(replay, this.position(), picture.view, x, y, NEAR * picture.ratio);
    }
    const { bite = -1, vertex = -1, waiting } = this.pointed;
    hint.hidden = bite < 0 && vertex < 0;
    if (!hint.hidden) {
      hint.textContent = vertex >= 0 ? vertexInWords(replay, vertex, waiting) : biteInWords(replay, bite);
      this.putHint(hint, event);
    }
    if (JSON.stringify([this.pointed.bite, this.pointed.vertex]) !== before) this.redraw();
  }

  /** Beside the pointer, within the picture. */
  putHint(hint, event) {
    const { clientWidth, clientHeight } = this.picture.canvas;
    const left = Math.min(event.offsetX + 14, clientWidth - hint.offsetWidth - 4);
    const below = event.offsetY + 18;
    const top = below + hint.offsetHeight > clientHeight ? event.offsetY - hint.offsetHeight - 10 : below;
    hint.style.left = `${Math.max(4, left)}px`;
    hint.style.top = `${Math.max(4, top)}px`;
  }
}
