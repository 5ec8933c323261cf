// What is so after k bites, and why: functions without side effects on a decoded recording.
//
// A position counts what the slider counts: 0 is the domain before the first bite; at k the bite k − 1 is being bitten, all
// before it have been; after the last comes the triangulation.

/** The steps of §5.1, and the letters of the bites they take. */
const STEPS = [
  { name: "Domain", paper: "Step 2", bites: "" },
  { name: "Vertex protection", paper: "Step 3", bites: "V" },
  { name: "Edge protection", paper: "Step 4", bites: "CBM" },
  { name: "Interior biting", paper: "Step 5", bites: "F" },
  { name: "Delaunay triangulation", paper: "Step 6", bites: "" },
];

/** Letters of bites, and what they stand for. */
const KINDS = {
  V: "Input vertices",
  C: "Points of cut corners",
  B: "Progressive circles, B(p₁)",
  M: "Middle circles, M(p₁, p₂)",
  F: "Front vertices bitten",
};

/** x and y by turns, taken apart. */
function places(flat) {
  const count = flat.length / 2;
  const place = { x: new Float64Array(count), y: new Float64Array(count) };
  for (let i = 0; i < count; i += 1) {
    place.x[i] = flat[2 * i];
    place.y[i] = flat[2 * i + 1];
  }
  return place;
}

/**
 * The labels of edge protection, by bite.
 * @returns {Map<number, {segment: number, parents: number[], middles: {x: number, y: number}[]}>}
 */
function labels(bites) {
  const byBite = new Map();
  let segment = 0;
  let parent = 0;
  let middle = 0;
  for (let bite = 0; bite < bites.reasons.length; bite += 1) {
    const ends = { B: 1, M: 2 }[bites.reasons[bite]];
    if (!ends) continue;
    const label = { segment: bites.segments[segment], parents: bites.parents.slice(parent, parent + ends), middles: [] };
    for (let end = 0; ends === 2 && end < 2; end += 1) {
      label.middles.push({ x: bites.middles[middle], y: bites.middles[middle + 1] });
      middle += 2;
    }
    byBite.set(bite, label);
    segment += 1;
    parent += ends;
  }
  return byBite;
}

/** The front vertices: where they are, with which bite they appear (`since`) and with which they go. */
function frontVertices(queue) {
  const count = queue.gone.length;
  const since = new Int32Array(count);
  /** How many have appeared before each bite. */
  const before = new Int32Array(queue.appearing.length + 1);
  let serial = 0;
  queue.appearing.forEach((appearing, bite) => {
    since.fill(bite, serial, serial + appearing);
    serial += appearing;
    before[bite + 1] = serial;
  });
  const { x, y } = places(queue.points);
  const { circles, ranks, turns } = queue;
  return { count, x, y, since, before, gone: Int32Array.from(queue.gone), circles, ranks, turns };
}

/** The front vertex that each bite is centred on, −1 where it is none. */
function chosenVertices(bites) {
  let next = 0;
  return Int32Array.from(bites.reasons, (letter) => {
    if (letter !== "F") return -1;
    next += 1;
    return bites.chosen[next - 1];
  });
}

/** Groups the sides of notches by the bite they stand in the way of. */
function shadowsByBite(shadows) {
  const byBite = new Map();
  for (const [bite, vertex, end] of shadows) {
    byBite.set(bite, [...(byBite.get(bite) ?? []), [vertex, end]]);
  }
  return byBite;
}

/** For each of KINDS, how many there are among the first k bites. */
function countKinds(reasons) {
  const counts = {};
  for (const letter of Object.keys(KINDS)) {
    counts[letter] = new Int32Array(reasons.length + 1);
    for (let bite = 0; bite < reasons.length; bite += 1) {
      counts[letter][bite + 1] = counts[letter][bite] + (reasons[bite] === letter ? 1 : 0);
    }
  }
  return counts;
}

/** A recording as the page carries it, made ready for questions. */
function decode(recording) {
  const { bites } = recording;
  const points = places(recording.points);
  const pick = (axis) => Float64Array.from(bites.centres, (vertex) => axis[vertex]);
  return {
    about: recording.about,
    frame: recording.frame,
    outline: recording.outline,
    points,
    triangles: recording.triangles,
    count: bites.reasons.length,
    reasons: bites.reasons,
    counts: countKinds(bites.reasons),
    x: pick(points.x),
    y: pick(points.y),
    radius: Float64Array.from(bites.radii),
    labels: labels(bites),
    chosen: chosenVertices(bites),
    vertices: frontVertices(recording.queue),
    shadows: shadowsByBite(recording.outline.shadows),
  };
}

/** The last position: the triangulation. */
function lastPosition(replay) {
  return replay.count + 1;
}

/** The bite being bitten at a position, −1 where there is none. */
function biteAt(replay, position) {
  return position >= 1 && position <= replay.count ? position - 1 : -1;
}

/** How many bites have been bitten before what is happening at a position. */
function bittenAt(replay, position) {
  return position > replay.count ? replay.count : Math.max(0, position - 1);
}

/** Which of STEPS the run is in. */
function stepAt(replay, position) {
  if (position > replay.count) return STEPS.length - 1;
  const bite = biteAt(replay, position);
  return bite < 0 ? 0 : STEPS.findIndex((step) => step.bites.includes(replay.reasons[bite]));
}

/** The first position of each of STEPS, −1 where a step takes no bite. */
function stepStarts(replay) {
  return STEPS.map((step, index) => {
    if (index === 0) return 0;
    if (index === STEPS.length - 1) return lastPosition(replay);
    return 1 + Array.from(replay.reasons).findIndex((letter) => step.bites.includes(letter)) || -1;
  });
}

/** The first position of the next step of the algorithm, or the last position. */
function nextStep(replay, position) {
  const later = stepStarts(replay).filter((start) => start > position);
  return later.length ? Math.min(...later) : lastPosition(replay);
}

/** The first position of the step before, or of this one where that lies behind. */
function previousStep(replay, position) {
  return Math.max(0, ...stepStarts(replay).filter((start) => start < position));
}

/** The front vertices that wait before a bite, by serial number; before the bite after the last, none. */
function waitingBefore(replay, bite) {
  const { before, gone } = replay.vertices;
  const waiting = [];
  const end = before[Math.min(bite, replay.count)];
  for (let serial = 0; serial < end; serial += 1) {
    if (gone[serial] >= bite) waiting.push(serial);
  }
  return waiting;
}

/** What is so at a position, found once for all who ask. */
function momentAt(replay, position) {
  const bite = biteAt(replay, position);
  return {
    position,
    /** The bite being bitten, −1 where there is none. */
    bite,
    /** How many have been bitten before. */
    bitten: bittenAt(replay, position),
    /** Which of STEPS this is. */
    step: stepAt(replay, position),
    /** The front vertices that wait. */
    waiting: bite < 0 ? [] : waitingBefore(replay, bite),
  };
}

/** The front vertices that the bite at hand takes away, the one it is centred on included. */
function takenAt(replay, { bite, waiting }) {
  return waiting.filter((serial) => replay.vertices.gone[serial] === bite);
}

/** How many front vertices a bite makes. */
function madeBy(replay, bite) {
  const { before } = replay.vertices;
  return before[bite + 1] - before[bite];
}

/** The place of a front vertex among those that wait, counted from 1; undefined where lots are drawn. */
function placeAmong(replay, serial, waiting) {
  const { turns } = replay.vertices;
  if (!turns.length) return undefined;
  return 1 + waiting.filter((other) => turns[other] < turns[serial]).length;
}

/** The front vertex that comes after `serial` among those that wait and that its bite does not take; −1 if none. */
function nextInLine(replay, serial, waiting) {
  const { turns, gone } = replay.vertices;
  let next = -1;
  for (const other of turns.length ? waiting : []) {
    const stays = gone[other] !== gone[serial];
    if (stays && turns[other] > turns[serial] && (next < 0 || turns[other] < turns[next])) next = other;
  }
  return next;
}

/** How many bites of a kind have been made when the bite at a position is done. */
function countOf(replay, letter, position) {
  return replay.counts[letter][Math.min(position, replay.count)];
}

/** The smallest angle of a triangle of the mesh, in degrees. */
function smallestAngle(replay, triangle) {
  const corners = triangle.map((vertex) => ({ x: replay.points.x[vertex], y: replay.points.y[vertex] }));
  const angles = corners.map((corner, index) => {
    const one = corners[(index + 1) % 3];
    const other = corners[(index + 2) % 3];
    const [ux, uy, vx, vy] = [one.x - corner.x, one.y - corner.y, other.x - corner.x, other.y - corner.y];
    return Math.abs(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy));
  });
  return (Math.min(...angles) * 180) / Math.PI;
}
