// What happens at a position, in words of the paper.

/** A rank counts these. */
const RANK_UNIT = 1e-4;

/** A number to so many significant digits. */
function brief(value, digits = 3) {
  return Number(value.toPrecision(digits)).toString();
}

/** A length of the recording in the domain's own unit. */
function lengthOf(replay, units) {
  return brief(units * replay.frame.unit);
}

/** 1st, 2nd, 3rd, 4th … */
function ordinal(number) {
  const teens = number % 100 >= 11 && number % 100 <= 13;
  const ending = teens ? "th" : ({ 1: "st", 2: "nd", 3: "rd" }[number % 10] ?? "th");
  return `${number.toLocaleString("en")}${ending}`;
}

/** "1 bite", "2 bites". */
function some(number, noun) {
  const plural = noun.endsWith("x") ? `${noun.slice(0, -2)}ices` : `${noun}s`;
  return `${number.toLocaleString("en")} ${number === 1 ? noun : plural}`;
}

/** Angles from cosines, in degrees. */
function degrees(cosine) {
  return (Math.acos(Math.max(-1, Math.min(1, cosine))) * 180) / Math.PI;
}

/** What each order looks at: its rule, and what a rank says. */
const ORDERS = {
  fifo: { rule: "first come, first bitten" },
  lifo: { rule: "last come, first bitten" },
  random: { rule: "lots are drawn" },
  sharpest: {
    rule: "the narrowest uneaten wedge first",
    rank: (rank) => `a wedge of ${(180 - degrees(rank)).toFixed(1)}°`,
  },
  flattest: {
    rule: "the widest uneaten wedge first",
    rank: (rank) => `a wedge of ${(180 - degrees(-rank)).toFixed(1)}°`,
  },
  equilateral: {
    rule: "the triangle with its two centres nearest to equilateral first",
    rank: (rank) => `a triangle of shape ${(-rank * 2 * Math.sqrt(3)).toFixed(3)} (equilateral: 1)`,
  },
  smallest: { rule: "the smallest spacing first", rank: (rank) => `spacing f = ${brief(2 ** rank, 4)}` },
  largest: { rule: "the largest spacing first", rank: (rank) => `spacing f = ${brief(2 ** -rank, 4)}` },
};

/** What ranks a front vertex, or an empty text where its order has no ranks. */
function rankInWords(replay, serial) {
  const { ranks } = replay.vertices;
  const words = ORDERS[replay.about.order]?.rank;
  return words && ranks.length ? words(ranks[serial] * RANK_UNIT) : "";
}

/** The label of a bite, as the paper writes it. */
function labelInWords(replay, bite) {
  const letter = replay.reasons[bite];
  const parents = replay.labels.get(bite)?.parents ?? [];
  const names = parents.map((parent) => (parent < 0 ? "cut" : `bite ${parent + 1}`)).join(", ");
  const words = { V: "input vertex", C: "cut corner", B: `B(p₁), p₁ = ${names}`, M: `M(p₁, p₂) = ${names}`, F: "front vertex" };
  return words[letter];
}

/** A circle that a label names. */
function circleInWords(parent, name) {
  return parent < 0 ? "the cut of the corner" : `the circle of ${name} (bite ${parent + 1})`;
}

function inputVertexInWords() {
  return "Every input vertex is bitten first, in the order of the input, so that it is a mesh vertex.";
}

function cutCornerInWords() {
  return "An angle under 90°, which the theorems exclude, is cut off first (§5.1): this point of the cut is bitten instead of the corner.";
}

function progressiveInWords(replay, { bite }) {
  const { segment, parents } = replay.labels.get(bite);
  return (
    `q, on segment ${segment + 1}, is where ${circleInWords(parents[0], "p₁")} leaves it. ` +
    "Its circle does not reach what is covered at the other end of the gap, so q is bitten itself: a progressive circle."
  );
}

function middleInWords(replay, { bite }) {
  const { segment, parents, middles } = replay.labels.get(bite);
  const [first, second] = [circleInWords(parents[0], "p₁"), circleInWords(parents[1], "p₂")];
  const gap = Math.hypot(middles[0].x - middles[1].x, middles[0].y - middles[1].y);
  return (
    `Segment ${segment + 1} is uncovered between q₁, where ${first} leaves it, and q₂, where ${second} does; ` +
    `they are ${lengthOf(replay, gap)} apart. B(q₁) would reach across to q₂, and B(q₂) to q₁: ` +
    "so the middle q of q₁q₂ is bitten: a middle circle."
  );
}

/** Which place a chosen front vertex had, and why. */
function turnInWords(replay, serial, waiting) {
  const rule = ORDERS[replay.about.order]?.rule ?? replay.about.order;
  const place = placeAmong(replay, serial, waiting);
  const rank = rankInWords(replay, serial);
  const among = `of ${some(waiting.length, "vertex")} waiting`;
  const order = `Order of bites “${replay.about.order}”: ${rule}.`;
  const own = place === undefined ? `Drawn by lot out ${among}` : `${ordinal(place)} ${among}`;
  return `${own}${rank ? `, with ${rank}` : ""}. ${order}`;
}

function frontVertexInWords(replay, moment) {
  const { bite, waiting } = moment;
  const serial = replay.chosen[bite];
  const { since, circles } = replay.vertices;
  const next = nextInLine(replay, serial, waiting);
  const nextRank = next < 0 ? "" : rankInWords(replay, next);
  const others = takenAt(replay, moment).length - 1;
  return [
    turnInWords(replay, serial, waiting),
    nextRank && `Next of those that stay: vertex ${next + 1}, with ${nextRank}.`,
    `It lies on the circles of bites ${circles[2 * serial] + 1} and ${circles[2 * serial + 1] + 1}, and has waited since bite ${since[serial] + 1}.`,
    `The bite takes ${others ? some(others, "other vertex") : "no other vertex"} off the front and makes ${madeBy(replay, bite)}.`,
  ]
    .filter(Boolean)
    .join("\n");
}

function startInWords(replay) {
  const cut = replay.outline.corners.length;
  return (
    "The boundary of the domain is the first front. " +
    (cut ? `Small corners have been cut off, with ${some(cut, "triangle")}; they come back with the mesh. ` : "") +
    `Each bite removes the circle of radius c_b f(x) around a point x of the front, ${some(replay.count, "bite")} in all.`
  );
}

function triangulationInWords(replay) {
  const { min_angle_deg: angle, min_angle_bound_deg: bound } = replay.about;
  return (
    "Nothing is left to bite: the front is empty, and the circles cover the domain. The Delaunay triangulation of their centres is the mesh: " +
    `${some(replay.triangles.length, "triangle")} over ${some(replay.points.x.length, "vertex")}. ` +
    (replay.outline.corners.length ? "Corners that were cut off are back. " : "") +
    (angle === null ? "" : `Its smallest angle is ${angle.toFixed(2)}°, away from input angles under 60°; Theorem 6.8 has asin(1/2 − t) = ${bound.toFixed(2)}°.`)
  );
}

/** The reason of each kind of bite. */
const REASONS = {
  V: { title: "an input vertex", text: inputVertexInWords },
  C: { title: "a cut corner", text: cutCornerInWords },
  B: { title: "label B(p₁)", text: progressiveInWords },
  M: { title: "label M(p₁, p₂)", text: middleInWords },
  F: { title: "a front vertex", text: frontVertexInWords },
};

/**
 * What happens at a moment, and why.
 * @returns {{title: string, text: string}}
 */
function explain(replay, moment) {
  const { bite, position } = moment;
  if (bite >= 0) {
    const { title, text } = REASONS[replay.reasons[bite]];
    const radius = `Radius c_b f = ${lengthOf(replay, replay.radius[bite])}.`;
    return { title: `Bite ${bite + 1}: ${title}`, text: `${text(replay, moment)}\n${radius}` };
  }
  return position > replay.count
    ? { title: "The mesh", text: triangulationInWords(replay) }
    : { title: "Before the first bite", text: startInWords(replay) };
}

/** What the reader points at, in words: a bitten circle. */
function biteInWords(replay, bite) {
  return `Bite ${bite + 1}: ${labelInWords(replay, bite)}\nradius ${lengthOf(replay, replay.radius[bite])}`;
}

/** What the reader points at, in words: a front vertex that waits. */
function vertexInWords(replay, serial, waiting) {
  const place = placeAmong(replay, serial, waiting);
  const turn = place === undefined ? `one of ${waiting.length}` : `${ordinal(place)} of ${waiting.length}`;
  const rank = rankInWords(replay, serial);
  return `Front vertex ${serial + 1}, waiting\n${turn}${rank ? `: ${rank}` : ""}\nbitten away by bite ${replay.vertices.gone[serial] + 1}`;
}
