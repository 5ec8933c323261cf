// The run as it is played: its position, and the buttons and keys that move it.

/** Bites a second to choose from. */
const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

/** A run is first played at a speed that brings it to its end within so many seconds. */
const SECONDS_AT_FIRST = 60;

/** Where the run is, and whether it plays; tells `changed` of every change. */
class Player {
  constructor(replay, changed) {
    this.replay = replay;
    this.changed = changed;
    this.position = 0;
    this.isPlaying = false;
    const wanted = replay.count / SECONDS_AT_FIRST;
    this.speed = SPEEDS.find((speed) => speed >= wanted) ?? SPEEDS[SPEEDS.length - 1];
  }

  go(position) {
    this.position = Math.max(0, Math.min(lastPosition(this.replay), Math.round(position)));
    this.changed();
  }

  /** By hand: a run that plays stops. */
  step(by) {
    this.pause();
    this.go(this.position + by);
  }

  jump(position) {
    this.pause();
    this.go(position);
  }

  toggle() {
    if (this.isPlaying) {
      this.pause();
      return;
    }
    if (this.position === lastPosition(this.replay)) this.position = 0;
    this.isPlaying = true;
    this.before = undefined;
    this.owed = 0;
    this.changed();
    requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    if (!this.isPlaying) return;
    this.isPlaying = false;
    this.changed();
  }

  /** Plays as many bites as are due; a page that was hidden does not catch up. */
  tick(now) {
    if (!this.isPlaying) return;
    const passed = Math.min(250, now - (this.before ?? now));
    this.before = now;
    this.owed += (passed * this.speed) / 1000;
    const due = Math.floor(this.owed);
    this.owed -= due;
    if (this.position + due >= lastPosition(this.replay)) {
      this.isPlaying = false;
      this.go(lastPosition(this.replay));
      return;
    }
    if (due) this.go(this.position + due);
    requestAnimationFrame((later) => this.tick(later));
  }

  /** The next faster or slower speed. */
  hurry(by) {
    const index = SPEEDS.indexOf(this.speed) + by;
    this.speed = SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, index))];
    this.changed();
  }
}

/** What each key does. */
function keys(player, pointer) {
  const { replay } = player;
  const slower = () => player.hurry(-1);
  const faster = () => player.hurry(1);
  return {
    ArrowLeft: (event) => player.step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => player.step(event.shiftKey ? 10 : 1),
    Home: () => player.jump(0),
    End: () => player.jump(lastPosition(replay)),
    " ": () => player.toggle(),
    n: () => player.jump(nextStep(replay, player.position)),
    p: () => player.jump(previousStep(replay, player.position)),
    "+": faster,
    "=": faster,
    "-": slower,
    "−": slower,
    z: () => zoomToBite(player, pointer),
    0: () => pointer.whole(),
  };
}

function zoomToBite(player, pointer) {
  const bite = biteAt(player.replay, player.position);
  if (bite >= 0) pointer.close(bite);
}

function listenToKeys(player, pointer) {
  const actions = keys(player, pointer);
  document.addEventListener("keydown", (event) => {
    const isForPage = !event.ctrlKey && !event.metaKey && !event.altKey && event.target.tagName !== "SELECT";
    const isForButton = event.key === " " && ["BUTTON", "SUMMARY"].includes(event.target.tagName);
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || !isForPage || isForButton) return;
    event.preventDefault();
    action(event);
  });
}

function listenToButtons(player, pointer) {
  const { replay } = player;
  const clicks = {
    "previous-step": () => player.jump(previousStep(replay, player.position)),
    back: () => player.step(-1),
    play: () => player.toggle(),
    forward: () => player.step(1),
    "next-step": () => player.jump(nextStep(replay, player.position)),
    closer: () => zoomToBite(player, pointer),
    whole: () => pointer.whole(),
  };
  for (const [id, click] of Object.entries(clicks)) element(id).addEventListener("click", click);
  element("slider").max = lastPosition(replay);
  element("slider").addEventListener("input", (event) => player.jump(Number(event.target.value)));
  element("speed").append(...SPEEDS.map((speed) => make("option", speed, { value: speed })));
  element("speed").addEventListener("change", (event) => {
    player.speed = Number(event.target.value);
  });
}

/** Joins everything, and draws at most once a frame. */
function start() {
  const replay = decode(JSON.parse(element("recording").textContent));
  const picture = new Picture(element("picture"), replay);
  let isDue = false;
  const draw = () => {
    isDue = false;
    const moment = momentAt(replay, player.position);
    picture.draw(moment, pointer.pointed);
    panel.show(moment);
  };
  const redraw = () => {
    if (!isDue) requestAnimationFrame(draw);
    isDue = true;
  };
  const player = new Player(replay, redraw);
  const pointer = new Pointer(picture, () => player.position, redraw);
  const panel = new Panel(replay, player);
  listenToKeys(player, pointer);
  listenToButtons(player, pointer);
  new ResizeObserver(() => pointer.whole()).observe(picture.canvas);
  const recolour = () => {
    picture.recolour();
    showLegend(replay, picture.colours, picture.ratio);
    redraw();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  recolour();
  player.go(Number(location.hash.slice(1)) || 0);
  // For whoever wants to look inside, such as the test of this page.
  window.replay = { replay, picture, player, pointer, draw };
}

start();
